# SPDX-License-Identifier: Apache-2.0
"""The environment variables that a shell script sets where it is sourced, read off its text; nothing is run.

Understood are assignments, ``export``, ``unset``, ``: ${NAME:=value}``, and what tests of these variables decide. Names that are set in any other
way are lost.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Mapping

from haros_ci.records import dataclass, field
from haros_ci.workspace.shell_values import ShellState, names_set
from haros_ci.workspace.shell_words import Operator, Token, UnreadableScript, Word, tokens

#: Commands and blocks within each other.
MAX_DEPTH = 40
_BLOCKS = {"case": "esac", "for": "done", "while": "done", "until": "done", "select": "done"}
_EXPORTING = ("export", "declare", "typeset", "readonly", "local")
_READING = ("read", "mapfile", "readarray", "getopts", "printf", "let", "eval")


@dataclass(frozen=True, slots=True)
class Variables:
    """*values* are what the script exports, *lost* the names of what it exports, or may export, with values that are not known."""

    values: Mapping[str, str]
    lost: frozenset[str] = frozenset()


def read_script(script: str, inherited: Mapping[str, str | None] | None = None, stuck: Iterable[str] = ()) -> Variables:
    """The environment variables that *script* leaves behind.

    *inherited* are those that are set before (None: to what is not known); others are taken not to be set, but for those that a shell, the system
    and ROS set. *stuck* are names of which nothing is known, whatever the script says.
    """
    reader = _ShellReader(script, dict(inherited or {}), set(stuck), inherited=frozenset(inherited or ()))
    try:
        reader.lose(reader.stuck)
        reader.tokens = tokens(script)
        reader.sequence(())
    except (UnreadableScript, RecursionError):
        return Variables({}, names_set(script) | reader.stuck)
    seen = reader.exported | reader.stuck
    values = {name: value for name in reader.exported if (value := reader.known(name)) is not None}
    return Variables(values, frozenset(name for name in seen if name not in values and name not in reader.removed))


@dataclass(slots=True)
class _ShellReader(ShellState):
    tokens: list[Token] = field(default_factory=list)
    at: int = 0
    depth: int = 0

    # --- what stands between commands

    def sequence(self, ends: tuple[str, ...]) -> bool | None:
        """Commands up to one of the words *ends*, which is passed over; how the last of them ended."""
        self.depth += 1
        if self.depth > MAX_DEPTH:
            raise UnreadableScript
        status: bool | None = True
        while self.at < len(self.tokens):
            token = self.tokens[self.at]
            if isinstance(token, Operator):
                if token.text == ")" and ")" in ends:
                    break
                if token.text in (";", "\n", "&"):
                    self.at += 1
                    continue
                if token.text != "(":
                    raise UnreadableScript
                status = self.chain()
                continue
            if token.text in ends and not token.is_quoted:
                break
            status = self.chain()
        else:
            if ends:
                raise UnreadableScript
        self.depth -= 1
        return status

    def chain(self) -> bool | None:
        """Commands between ``&&`` and ``||``."""
        status = self.piped(None)
        while self.at < len(self.tokens):
            token = self.tokens[self.at]
            if not isinstance(token, Operator) or token.text not in ("&&", "||"):
                break
            self.at += 1
            while isinstance(self.tokens[self.at], Operator) and self.tokens[self.at].start < len(self.script):
                if self.operator() != "\n":
                    raise UnreadableScript
                self.at += 1
            follows = None if status is None else status is (token.text == "&&")
            made = self.piped(follows if follows is not True else None, is_doubtful=follows is None)
            status = made if follows else status if follows is False else None
        return status

    def piped(self, follows: bool | None, is_doubtful: bool = False) -> bool | None:
        """One command, or several with ``|`` between them, of which none sets anything here."""
        start = self.at
        before = (dict(self.values), set(self.exported), set(self.stuck))
        self.skipped += follows is False
        self.doubts += is_doubtful
        status = self.command()
        is_pipe = self.operator() in ("|", "&")
        while self.operator() == "|":
            self.at += 1
            self.command()
        if is_pipe:
            self.values, self.exported, self.stuck = before
            status = None
            assert self.at > start
        self.skipped -= follows is False
        self.doubts -= is_doubtful
        return status

    def operator(self) -> str:
        token = self.tokens[self.at] if self.at < len(self.tokens) else None
        return token.text if isinstance(token, Operator) else ""

    # --- commands

    def command(self) -> bool | None:
        token = self.tokens[self.at] if self.at < len(self.tokens) else None
        if isinstance(token, Operator):
            if token.text != "(":
                raise UnreadableScript
            self.pass_subshell()  # what a subshell sets stays in it
            return None
        if token is None:
            raise UnreadableScript
        name = token.text if not token.is_quoted else None
        if name == "if":
            return self.condition()
        if name == "{":
            self.at += 1
            status = self.sequence(("}",))
            self.at += 1
            return status
        if name == "!":
            self.at += 1
            status = self.command()
            return None if status is None else not status
        if name in _BLOCKS or name == "function" or self.is_function():
            self.lose_block(_BLOCKS.get(name or "", "}"))
            return None
        return self.simple()

    def is_function(self) -> bool:
        """Whether a parenthesis follows the word here, as behind the name of a function."""
        following = self.tokens[self.at + 1] if self.at + 1 < len(self.tokens) else None
        return isinstance(following, Operator) and following.text == "("

    def pass_subshell(self) -> None:
        """Go behind the parenthesis that closes the one here."""
        depth = 0
        while self.at < len(self.tokens):
            word = self.operator()
            depth += (word == "(") - (word == ")")
            self.at += 1
            if not depth:
                return
        raise UnreadableScript

    def lose_block(self, end: str) -> None:
        """Go behind a loop, a choice or a function; what it sets is not known from there on."""
        start, opened = self.tokens[self.at].start, 0
        opens = {"esac": ("case",), "done": ("for", "while", "until", "select"), "}": ("{",)}[end]
        while self.at < len(self.tokens):
            token = self.tokens[self.at]
            self.at += 1
            if isinstance(token, Word) and not token.is_quoted:
                opened += token.text in opens
                if token.text == end:
                    opened -= 1
                    if opened <= 0:
                        if not self.skipped:
                            self.lose(names_set(self.script[start : token.end]))
                            loop = re.match(r"\s*(?:for|select)\s+([A-Za-z_]\w*)", self.script[start : start + 200])
                            self.lose({loop[1]} if loop and loop[1] in self.values else set())
                        return
        raise UnreadableScript

    def condition(self) -> bool | None:
        """``if … fi``: the branch that holds, or all that may hold, in doubt."""
        decided: bool | None = False
        word: str | None = "if"
        while word in ("if", "elif"):
            self.at += 1
            self.skipped += decided is True
            self.doubts += decided is None
            holds = self.sequence(("then",))
            self.skipped -= decided is True
            self.doubts -= decided is None
            self.at += 1
            self.branch(decided, holds)
            decided = True if True in (decided, holds) else None if None in (decided, holds) else False
            word = self.word()
        if word == "else":
            self.at += 1
            self.branch(decided, True)
        if self.word() != "fi":
            raise UnreadableScript
        self.at += 1
        return None

    def branch(self, before: bool | None, holds: bool | None) -> None:
        """Commands that are done if no condition *before* holds and the own one *holds*."""
        is_skipped = before is True or holds is False
        is_doubtful = not is_skipped and (before is None or holds is None)
        self.skipped += is_skipped
        self.doubts += is_doubtful
        self.sequence(("elif", "else", "fi"))
        self.skipped -= is_skipped
        self.doubts -= is_doubtful

    def word(self) -> str | None:
        token = self.tokens[self.at] if self.at < len(self.tokens) else None
        return token.text if isinstance(token, Word) else None

    def words(self) -> list[Word]:
        """Go behind the words of one command, which are returned; redirections are left out."""
        words: list[Word] = []
        while self.at < len(self.tokens):
            token = self.tokens[self.at]
            if isinstance(token, Word):
                words.append(token)
            elif token.text == ">":
                following = self.tokens[self.at + 1]
                is_whole = self.script[token.end - 1] in "-0123456789"
                self.at += isinstance(following, Word) and not is_whole  # and the file behind it
            else:
                break
            self.at += 1
        return words

    def simple(self) -> bool | None:
        """Assignments, or a command with its words."""
        words = self.words()
        if self.skipped or self.is_ended:
            return None
        assignments = 0
        while assignments < len(words) and self.assignment(words[assignments]) is not None:
            assignments += 1
        if assignments == len(words):
            for word in words:
                self.assign(word)
            return True if words else None
        if assignments:  # they hold for the command alone
            return None
        name = words[0].text
        run = _COMMANDS.get(name or "")
        if run is not None:
            return run(self, words[1:])
        self.colon(words)  # ${NAME:=value} sets NAME wherever it stands
        return None

    # --- commands that matter

    def bracket(self, words: list[Word]) -> bool | None:
        return self.test(words[:-1]) if words and words[-1].text in ("]", "]]") else None

    def reads(self, words: list[Word]) -> bool | None:
        """Commands that set the variables they are given by name, and ``eval``."""
        for word in words:
            text = self.script[word.start : word.end]
            self.lose(names_set(text) | ({text} & self.values.keys()))
        return None

    def source(self, words: list[Word]) -> bool | None:
        """Another script: what has been set so far may be set anew, and anything may be set."""
        self.is_open = True
        for name in self.values:
            self.values[name] = None
        return None

    def end(self, words: list[Word]) -> bool | None:
        """``return`` and ``exit``; where it may be done, all that follows is in doubt."""
        if self.doubts:
            self.doubts += 1_000
        else:
            self.is_ended = True
        return None

    def option(self, words: list[Word]) -> bool | None:
        texts = [word.text for word in words]
        if {"-a", "+a", "allexport"}.intersection(texts):
            self.is_exporting_all = (texts[0] or "").startswith("-")
        return True

    def colon(self, words: list[Word]) -> bool | None:
        for word in words:
            self.expand(word.parts, is_test=True)
        return True

    def nothing(self, words: list[Word]) -> bool | None:
        return True


_Command = Callable[[_ShellReader, list[Word]], "bool | None"]
_COMMANDS: Mapping[str, _Command] = {
    "[": _ShellReader.bracket,
    "[[": _ShellReader.bracket,
    "test": _ShellReader.test,
    "export": _ShellReader.export,
    "unset": _ShellReader.unset,
    "set": _ShellReader.option,
    ":": _ShellReader.colon,
    "true": _ShellReader.nothing,
    "source": _ShellReader.source,
    ".": _ShellReader.source,
    "return": _ShellReader.end,
    "exit": _ShellReader.end,
    **dict.fromkeys(_EXPORTING[1:], _ShellReader.declare),
    **dict.fromkeys(_READING, _ShellReader.reads),
}
