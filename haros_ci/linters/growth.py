# SPDX-License-Identifier: Apache-2.0
"""What little text becomes much for a tool: how many ways lead up from a class through its bases, and how far; to how many tokens a macro expands.

A tool that walks each way, or makes each token, does not end on a text of a kilobyte; so it is not asked about one. What is counted here is what is
written: names are taken for what they are called, wherever they are defined. Nothing is executed, and counting takes time in proportion to the text.
"""

from __future__ import annotations

import ast
import re
from collections.abc import Callable, Collection, Iterable, Iterator, Mapping
from collections.abc import Set as AbstractSet

from haros_ci.linters.class_height import MOST_HEIGHT, Derived, too_high
from haros_ci.linters.linter import Unit
from haros_ci.linters.macro_growth import MOST_TOKENS, expanding
from haros_ci.model.workspace import Workspace
from haros_ci.regex import regex

#: Ways through bases above which no class is looked at: pylint takes two seconds for so many, and the square for twice.
MOST_WAYS = 10_000
#: How often all classes are looked at.
_ROUNDS = 60
#: Template arguments in one another that are read.
_DEEPEST = 60

#: Why a tool is not asked.
MANY_WAYS = f"its classes have more than {MOST_WAYS:,} ways up through their bases"
HIGH = f"more than {MOST_HEIGHT} of its classes are derived one from another"
LARGE_EXPANSION = f"its macros expand to more than {MOST_TOKENS:,} tokens"

_CLASS = regex(r"\b(?:class|struct)\s+([^;{}()=]{1,300}?)(?<!:):(?!:)([^;{}]{1,1000})\{")
_ARGUMENTS = regex(r"<[^<>]*>")
_WORD = regex(r"[A-Za-z_]\w*")

#: What derives a class, and what can give one several bases: so the text is read first, as most files have few of either.
_DERIVES = regex(r"^[ \t]*class\b[^\n:]*[(\\]|\btype[ \t]*\(", re.MULTILINE)
_SEVERAL = regex(r"^[ \t]*class\b[^\n]*,|\btype[ \t]*\(", re.MULTILINE)
#: So often, with two bases each, in less than MOST_WAYS ways.
_FEW = 6


def cpp_bases(text: str) -> Iterator[Derived]:
    """The classes of C++ that *text* derives from others, each with the last words of its bases' names."""
    for match in _CLASS.finditer(text):
        names = _WORD.findall(_ARGUMENTS.sub("", match[1]))
        names = [name for name in names if name != "final"]
        listed = match[2]
        for _ in range(_DEEPEST):
            shorter = _ARGUMENTS.sub("", listed)
            if shorter == listed:
                break
            listed = shorter
        bases = [words[-1] for words in map(_WORD.findall, listed.split(",")) if words]
        if names and bases:
            yield Derived(names[-1], tuple(bases))


def python_bases(text: str) -> Iterator[Derived]:
    """The classes of Python in *text* with the last words of their bases' names; ``B = A`` and ``B = type("B", (A,), {})`` count."""
    try:
        tree = ast.parse(text)
    except (SyntaxError, ValueError, RecursionError, MemoryError):
        return  # pylint cannot read it, either
    for node in ast.walk(tree):
        if isinstance(node, ast.ClassDef):
            yield Derived(node.name, tuple(_last_words(node.bases)))
        elif isinstance(node, ast.Assign):
            made, is_class = tuple(_made_of(node.value)), isinstance(node.value, ast.Call)
            yield from (Derived(it.id, made, is_class) for it in node.targets if made and isinstance(it, ast.Name))


def _made_of(value: ast.expr) -> Iterator[str]:
    if (
        isinstance(value, ast.Call)
        and isinstance(value.func, ast.Name)
        and value.func.id == "type"
        and len(value.args) > 1
    ):
        bases = value.args[1]
        yield from _last_words(bases.elts if isinstance(bases, ast.Tuple) else [bases])
    elif isinstance(value, (ast.Name, ast.Attribute)):
        yield from _last_words([value])


def _last_words(nodes: Iterable[ast.expr]) -> Iterator[str]:
    for node in nodes:
        if isinstance(node, ast.Subscript):
            node = node.value
        if isinstance(node, ast.Name):
            yield node.id
        elif isinstance(node, ast.Attribute):
            yield node.attr


def with_many_ways(classes: Iterable[Derived]) -> frozenset[str]:
    """The names of *classes* from which more than MOST_WAYS ways lead up through their bases."""
    several = [(one.name, [base for base in one.bases if base != one.name]) for one in classes]
    ways: dict[str, int] = {}
    for _ in range(min(len(several), _ROUNDS)):
        grown = False
        for name, bases in several:
            found = min(1 + sum(ways.get(base, 1) for base in bases), 2 * MOST_WAYS)
            if found > ways.get(name, 1):
                ways[name], grown = found, True
        if not grown:
            break
    return frozenset(name for name, found in ways.items() if found > MOST_WAYS)


def why_not_cpp(workspace: Workspace, units: Iterable[Unit]) -> dict[str, str]:
    """For those of *units* that a tool for C++ is not asked about the reason, by path."""
    units = list(units)
    texts = {path: workspace.text(path) for unit in units for path in (unit.file.path, *unit.dependencies)}
    found = dict.fromkeys(expanding(units, texts), LARGE_EXPANSION)
    beyond = _beyond(units, {path: list(cpp_bases(text)) for path, text in texts.items()}, with_many_ways)
    return found | dict.fromkeys(beyond, MANY_WAYS)


def why_not_python(workspace: Workspace, units: Iterable[Unit]) -> dict[str, str]:
    """For those of *units* that a tool which follows the bases of classes is not asked about the reason, by path."""
    units = list(units)
    texts = {path: workspace.text(path) for unit in units for path in (unit.file.path, *unit.dependencies)}
    is_high = sum(len(_DERIVES.findall(text)) for text in texts.values()) >= MOST_HEIGHT
    has_several = sum(len(_SEVERAL.findall(text)) for text in texts.values()) > _FEW
    if not is_high and not has_several:
        return {}
    classes = {path: list(python_bases(text)) for path, text in texts.items()}
    high = dict.fromkeys(_beyond(units, classes, too_high), HIGH)
    return high | dict.fromkeys(_beyond(units, classes, with_many_ways), MANY_WAYS)


def _beyond(
    units: Collection[Unit],
    classes: Mapping[str, Collection[Derived]],
    beyond: Callable[[Iterable[Derived]], AbstractSet[str]],
) -> Iterator[str]:
    """The paths of *units* that have a class *beyond* a bound, of their own *classes* and those of their dependencies.

    All are looked at together first: a name that is not beyond it then is not in any unit, and most often there is no other.
    """
    names = beyond(one for found in classes.values() for one in found)
    places = {path for path, found in classes.items() if any(one.name in names for one in found)}
    for unit in units if places else ():
        paths = (unit.file.path, *unit.dependencies)
        if not places.isdisjoint(paths) and beyond(one for path in paths for one in classes[path]):
            yield unit.file.path
