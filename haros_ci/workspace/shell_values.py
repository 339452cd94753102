# SPDX-License-Identifier: Apache-2.0
"""The variables of a shell script while its text is followed: their values, what tests of them decide, and which are exported."""

from __future__ import annotations

import re
from collections.abc import Sequence
from collections.abc import Set as AbstractSet

from haros_ci.records import dataclass, field
from haros_ci.regex import regex
from haros_ci.workspace.shell_words import HOLE, Part, ShellVariable, UnreadableScript, Word

#: Characters of one value, and how many variables there may be.
MAX_VALUE, MAX_NAMES = 4_000, 500

#: Variables that the shell, the system, ROS or the simulator has set before: nobody knows to what.
_TAKEN = regex(
    r"(?:HOME|USER|LOGNAME|PATH|PWD|OLDPWD|SHELL|HOSTNAME|HOST|LANG|LC_\w+|TERM|DISPLAY|SHLVL|UID|EUID|TMPDIR|RANDOM|PPID|EDITOR"
    r"|LD_LIBRARY_PATH|PYTHONPATH|PKG_CONFIG_PATH|CMAKE_\w+|AMENT_\w+|COLCON_\w+|CATKIN_\w+|_CATKIN\w*|GAZEBO_\w+|GZ_\w+|IGN_\w+|XDG_\w+|SSH_\w+|BASH\w*"
    r"|ZSH\w*|ROS_(?:DISTRO|VERSION|PYTHON_VERSION|ROOT|PACKAGE_PATH|MASTER_URI|ETC_DIR|IP|HOSTNAME))\Z"
)
_SET = regex(r"(?<![\w$-])([A-Za-z_]\w*)\+?=|\$\{([A-Za-z_]\w*):?=")
_NAME = regex(r"[A-Za-z_]\w*\Z")
_ASSIGNMENT = regex(r"([A-Za-z_]\w*)(\+?)=")


def names_set(text: str) -> frozenset[str]:
    """The names that *text* seems to set."""
    return frozenset(found[1] or found[2] for found in _SET.finditer(text))


@dataclass(slots=True)
class ShellState:
    """What is known of the variables at one place of a script."""

    script: str
    values: dict[str, str | None]
    #: Names of which nothing is known any more.
    stuck: set[str]
    exported: set[str] = field(default_factory=set)
    removed: set[str] = field(default_factory=set)
    #: How many conditions around that do not hold, and that may hold.
    skipped: int = 0
    doubts: int = 0
    is_exporting_all: bool = False
    #: Whether another script has been sourced, which may have set anything.
    is_open: bool = False
    is_ended: bool = False
    #: What is set before the script.
    inherited: frozenset[str] = frozenset()

    def known(self, name: str) -> str | None:
        return None if name in self.stuck else self.values.get(name)

    def assignment(self, word: Word) -> re.Match[str] | None:
        first = word.parts[0] if word.parts else None
        return _ASSIGNMENT.match(first) if isinstance(first, str) else None

    def assign(self, word: Word) -> str:
        """Do an assignment; the name."""
        found = self.assignment(word)
        assert found is not None and isinstance(word.parts[0], str)
        rest: tuple[Part, ...] = (word.parts[0][found.end() :], *word.parts[1:])
        value = self.expand(rest, is_test=False)
        if isinstance(rest[0], str) and rest[0].startswith("~"):
            value = None
        if found[2]:
            before = self.values.get(found[1])
            value = None if before is None or value is None else before + value
        self.put(found[1], value)
        return found[1]

    def put(self, name: str, value: str | None) -> None:
        if self.skipped:
            return
        if self.doubts:
            self.lose({name})
        if value is not None and (len(value) > MAX_VALUE or HOLE in value):
            value = None
        self.values[name] = value
        self.removed.discard(name)
        if len(self.values) > MAX_NAMES:
            raise UnreadableScript
        if self.is_exporting_all or name in self.inherited:
            self.exported.add(name)

    def lose(self, names: AbstractSet[str]) -> None:
        """Nothing is known of *names* any more."""
        self.stuck |= names
        if len(self.stuck) > MAX_NAMES:
            raise UnreadableScript

    def expand(self, parts: Sequence[Part], *, is_test: bool) -> str | None:
        """The text of *parts*, None if it is not known or too long; a variable that is not set is empty in a test, and not known in a value."""
        found = [part if isinstance(part, str) else self.part(part, is_test) for part in parts]
        known = [text for text in found if text is not None]
        return None if len(known) < len(found) or sum(map(len, known)) > MAX_VALUE else "".join(known)

    def part(self, part: ShellVariable | None, is_test: bool) -> str | None:
        if part is None:
            return None
        is_unset, value = self.look(part.name)
        if not part.operator or part.operator[-1] == "?":
            return "" if is_unset and is_test and not part.operator else value
        other = self.expand(part.other, is_test=is_test)
        if is_unset or value is not None:
            return self.choice(part, value, other)
        if part.operator[-1] == "=":
            self.put(part.name, None)
        return None

    def choice(self, part: ShellVariable, value: str | None, other: str | None) -> str | None:
        """What ``${NAME:-other}`` and its like stand for, where NAME has *value*, or is not set (None)."""
        is_there = value is not None and (bool(value) or ":" not in part.operator)
        if part.operator[-1] == "+":
            return other if is_there else ""
        if is_there:
            return value
        if part.operator[-1] == "=":
            self.put(part.name, other)
        return other

    def look(self, name: str) -> tuple[bool, str | None]:
        """Whether a variable is not set, and its value where that is known."""
        if name in self.stuck:
            return False, None
        if name in self.values:
            return False, self.values[name]
        return (False, None) if self.is_open or _TAKEN.match(name) else (True, None)

    def test(self, words: list[Word]) -> bool | None:
        """``[ … ]`` of texts, with ``!`` before it; None for anything else."""
        negations = 0
        while negations < len(words) and words[negations].text == "!":
            negations += 1
        holds = self.comparison(words[negations:])
        return None if holds is None else holds is (negations % 2 == 0)

    def comparison(self, words: list[Word]) -> bool | None:
        operands = [self.expand(word.parts, is_test=True) for word in words]
        plain = [word.text for word in words]
        if len(words) == 1:
            return None if operands[0] is None else operands[0] != ""
        if len(words) == 2 and plain[0] in ("-z", "-n") and operands[1] is not None:
            return (operands[1] == "") == (plain[0] == "-z")
        if len(words) == 3 and plain[1] in ("=", "==", "!="):
            is_same = _is_same(operands[0], operands[2], words[2].is_quoted)
            return None if is_same is None else is_same == (plain[1] != "!=")
        return None

    # --- commands that say what the environment gets

    def export(self, words: list[Word]) -> bool | None:
        options = "".join(word.text for word in words if word.text and word.text.startswith("-"))
        for word in words:
            if (word.text or "").startswith("-"):
                continue
            name = self.assign(word) if self.assignment(word) is not None else word.text
            if name is not None and _NAME.match(name):
                self.mark(name, options)
        return True

    def mark(self, name: str, options: str) -> None:
        """Export a variable, or no longer, as the *options* of ``export`` say."""
        if "f" in options:  # a function
            return
        if "n" in options:
            self.exported.discard(name)
        elif name in self.values or name in self.stuck:
            self.exported.add(name)

    def declare(self, words: list[Word]) -> bool | None:
        if any("x" in (word.text or "") for word in words if (word.text or "").startswith("-")):
            return self.export(words)
        for word in words:
            if self.assignment(word) is not None:
                self.assign(word)
        return True

    def unset(self, words: list[Word]) -> bool | None:
        for word in words:
            name = word.text or ""
            if self.doubts:
                self.lose({name})
            elif name not in self.stuck:
                self.values.pop(name, None)
                self.exported.discard(name)
                self.removed.add(name)
        return True


def _is_same(left: str | None, right: str | None, is_quoted: bool) -> bool | None:
    """Whether two texts are the same; None if one is not known, or the right one may be a pattern."""
    if left is None or right is None or (not is_quoted and re.search(r"[*?[]", right)):
        return None
    return left == right
