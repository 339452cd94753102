# SPDX-License-Identifier: Apache-2.0
"""Names that stand as strings in Python code whose classes inherit from what is not in the workspace: they may make topics of them."""

from __future__ import annotations

import re
from collections.abc import Iterator
from weakref import WeakKeyDictionary

from haros_ci.checking.system import System, SystemNode
from haros_ci.checking.whole import Whole
from haros_ci.regex import regex

#: Of all systems that are seen together, by package the strings and the parts of formats in what _texts() found, none if nothing there
#: inherits from a foreign class.
_STRINGS: WeakKeyDictionary[Whole, dict[str, tuple[frozenset[str], tuple[list[str], ...]]]] = WeakKeyDictionary()
#: What is read of a file, of how many files, and how long a string may be.
_MOST, _FILES = 400_000, 300
_CLASS = regex(r"^[ \t]{0,40}class[ \t]+(\w+)[ \t]*\(([^()]{1,400})\)[ \t]*:", re.MULTILINE)
_FUNCTION = regex(r"^[ \t]{1,40}def\s+__init__\b", re.MULTILINE)
_IMPORT = regex(r"^[ \t]*(?:from|import)[ \t]+(\w+)", re.MULTILINE)
_COMMENT = regex(r"^[ \t]*#[^\n]*", re.MULTILINE)
_STRING = regex(r"""(f?)(["'])([^"'\n]{2,200}?)\2""")
_HOLE = regex(r"\{[^{}]{0,100}\}|%(?:\(\w{1,60}\))?[-+#0 ]{0,3}\d{0,3}(?:\.\d{1,3})?[sdifgxr]")
#: Bases that make no topics of what they are given, and nodes, whose calls are followed.
_PLAIN = regex(
    r"object|Node|LifecycleNode|\w*Exception|\w*Error|\w*Enum|IntFlag|Flag|ABC|Protocol|NamedTuple|TypedDict|Generic|dict|list|set|tuple|str|int"
    r"|float|Thread|Process|TestCase|NodeVisitor|Q[A-Z]\w*|\w*Widget|Plugin|Module|Dataset|\w*Env|\w*Handler|\w*Server|\w*Parser|\w*Action|State|StateMachine"
)


def is_written(node: SystemNode, names: set[str], system: System) -> bool:
    """Whether one of *names* is a string of the code of *node*, or fits a format there, where a class inherits from one that is not here.

    Its code is that of its package and of the packages of the workspace that its Python files import.
    """
    kept = _STRINGS.setdefault(system.whole, {})
    if node.package not in kept:
        texts = _texts(node.package, system)
        written = {found[3].lstrip("~/") for text in texts for found in _STRING.finditer(text)}
        formats = tuple(_HOLE.split(item) for item in sorted(written) if "{" in item or "%" in item)
        kept[node.package] = frozenset(written), formats
    strings, formats = kept[node.package]
    return not strings.isdisjoint(names) or any(_fits(parts, name) for parts in formats for name in names)


def _texts(package: str, system: System) -> Iterator[str]:
    if system.workspace is None:
        return
    files = [file for file in system.workspace.files if file.language in ("cpp", "python")]
    own = [file for file in files if file.package == package]
    python = [system.workspace.text(file.path)[:_MOST] for file in own if file.language == "python"][:_FILES]
    imported = {match[1] for text in python for match in _IMPORT.finditer(text)} - {package}
    near = [file for file in files if file.package in imported]
    others = [system.workspace.text(file.path)[:_MOST] for file in near if file.language == "python"][:_FILES]
    bases = {name for text in (*python, *others) for name in _bases(text)}
    if not bases or bases <= _defined(bases, system):
        return
    for file in [*own, *near][:_FILES]:
        yield _COMMENT.sub("", system.workspace.text(file.path)[:_MOST])


def _bases(text: str) -> Iterator[str]:
    """The last parts of the names of base classes that may be foreign, of classes in a file that has a constructor."""
    if _FUNCTION.search(text) is None:
        return
    for match in _CLASS.finditer(text):
        for base in match[2].split(","):
            name = base.strip().rpartition(".")[2]
            if name.isidentifier() and "=" not in base and not _PLAIN.fullmatch(name):
                yield name


def _defined(names: set[str], system: System) -> set[str]:
    """Those of *names* that are classes of a Python file of the workspace."""
    found: set[str] = set()
    for file in system.workspace.files if system.workspace is not None else ():
        if file.language == "python" and system.workspace is not None and not names <= found:
            text = system.workspace.text(file.path)[:_MOST]
            found |= {name for name in names - found if re.search(rf"^[ \t]*class\s+{name}\b", text, re.MULTILINE)}
    return found


def _fits(parts: list[str], name: str) -> bool:
    """Whether *name* is made of *parts* with something in between; not for a format of nothing but what is filled in."""
    if len(parts) < 2 or not any(letter.isalnum() for part in parts for letter in part):
        return False
    first, *middle, last = parts
    if not name.startswith(first) or not name.endswith(last):
        return False
    at, end = len(first), len(name) - len(last)
    for part in middle:
        found = name.find(part, at, max(end, 0))
        if found < 0:
            return False
        at = found + len(part)
    return at <= end
