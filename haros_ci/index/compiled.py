# SPDX-License-Identifier: Apache-2.0
"""Which branches of ``#if`` a build compiles: by the macros that it defines for a source file, and those that the file has.

A source file is gone through with the headers of the workspace that it includes, line by line, as a preprocessor does ([cpp.cond]).
A macro that nobody is seen to define is not known: an option of the compiler or a header outside may define it.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence

from haros_ci.index.index import Index
from haros_ci.model.preprocessor_conditions import LONGEST, holds, is_defined
from haros_ci.records import dataclass, field
from haros_ci.syntax import Directive

#: Directives of one source file with its headers, headers inside headers, and source files of which a header is asked for.
MOST, DEEPEST, UNITS = 40_000, 30, 24
_OPENING = frozenset(("if", "ifdef", "ifndef"))
_FURTHER = frozenset(("elif", "elifdef", "elifndef", "else"))


@dataclass(frozen=True, slots=True)
class CompiledAs:
    """A source file as *target* (``package/name``) compiles it.

    *macros* are the definitions of which the build leaves no doubt, a value None if it is not known; *undefined* those that it
    makes for other targets and not for this one; all others may be defined.
    """

    target: str
    macros: tuple[tuple[str, str | None], ...] = ()
    undefined: tuple[str, ...] = ()


def is_compiled(index: Index, path: str, line: int, files: frozenset[str], target: str = "") -> bool | None:
    """Whether the branch of the directive at *line* of a file is compiled into a node of *files*; None if that is not known.

    *target* is the one that counts where several compile a file. What is in a header is known if all of *files* that include it agree.
    """
    verdicts = {unit.branches.get((path, line)) for unit in _units(index, path, files, target)}
    return verdicts.pop() if len(verdicts) == 1 else None


def value_of(index: Index, name: str, path: str, files: frozenset[str], target: str = "") -> str | None:
    """The one text that a macro stands for in all of a file; None where that is not known."""
    values = {unit.values.get(name) for unit in _units(index, path, files, target)}
    return values.pop() if len(values) == 1 else None


@dataclass(slots=True)
class _Unit:
    """What is known of a source file with its headers: by path and line whether branches are compiled, and macros' values."""

    branches: dict[tuple[str, int], bool | None] = field(default_factory=dict)
    values: dict[str, str] = field(default_factory=dict)


def _units(index: Index, path: str, files: frozenset[str], target: str) -> list[_Unit]:
    """The source files whose compilation decides what is compiled of the file at *path*, as each target that counts compiles it."""
    paths = [path]
    if path not in index.compiled:
        paths = sorted(other for other in files if path in index.reach(other)) or [path]
    found: list[_Unit] = []
    for other in paths:
        ways = index.compiled.get(other, ())
        own = [way for way in ways if way.target == target]
        for macros, undefined in dict.fromkeys((way.macros, way.undefined) for way in own or ways) or {((), ()): None}:
            if len(found) >= UNITS:
                return [_Unit()]
            found.append(_unit(index, other, macros, undefined))
    return found


def _unit(index: Index, path: str, macros: tuple[tuple[str, str | None], ...], undefined: tuple[str, ...]) -> _Unit:
    cache = index.caches.setdefault("compiled", {})
    key = (path, macros, undefined)
    found: _Unit | None = cache.get(key)
    if found is None:
        reader = _Preprocessor(index, dict(macros), set(undefined))
        reader.file(path, 0)
        found = cache[key] = reader.result()
    return found


@dataclass(slots=True)
class _Open:
    """An ``#if`` that is not closed: whether what is around it is compiled, and one of its branches so far; and the one that is read."""

    around: bool | None
    is_taken: bool | None
    current: bool | None
    #: The macro of ``#ifndef``, and whether it is defined inside: a default for it.
    default: str = ""
    is_default: bool = False


class _Preprocessor:
    """A source file and its headers being gone through; ``macros`` and ``undefined`` are what is known at the line that is read."""

    def __init__(self, index: Index, macros: dict[str, str | None], undefined: set[str]) -> None:
        self.index = index
        self.macros = macros
        self.undefined = undefined
        self.given = frozenset(macros)
        self.unit = _Unit()
        self.defined: dict[str, str | None] = {}
        self.open: list[_Open] = []
        self.once: set[str] = set()
        self.left = MOST

    def result(self) -> _Unit:
        """What has been found; nothing where there was too much."""
        if self.left < 0:
            return _Unit()
        known = {**{name: self.macros.get(name) for name in self.given}, **self.defined}
        self.unit.values = {name: text for name, text in known.items() if text is not None}
        return self.unit

    @property
    def live(self) -> bool | None:
        return self.open[-1].current if self.open else True

    def file(self, path: str, depth: int) -> None:
        """Go through a file."""
        source = self.index.sources.get(path)
        if source is None or path in self.once:
            return
        if depth > DEEPEST:
            self.left = -1
            return
        directives = source.program.directives
        guard = _guard(directives)
        if guard and guard in self.macros:
            return
        around = len(self.open)
        for number, directive in enumerate(directives):
            self.left -= 1
            if self.left < 0:
                return
            if directive.word == "include":
                self.include(path, directive.text, depth)
            elif directive.word == "pragma":
                self.once |= {path} if self.live is not False else set()
            elif directive.word == "lost":
                self.left = -1
                return
            else:
                self.line(path, directive, guard if number == 0 else "", around)
        del self.open[around:]

    def include(self, path: str, text: str, depth: int) -> None:
        if self.live is False or not text or text[0] not in '<"':
            return
        targets = self.index.included_files(text.strip('<>" '), path)
        if len(targets) == 1 and self.live:
            self.file(targets[0], depth + 1)
        else:  # one of several, or perhaps: what they define may be defined
            for target in targets:
                for other in (target, *sorted(self.index.reach(target))):
                    self.doubt(other)

    def doubt(self, path: str) -> None:
        """What a file defines or takes back may or may not be."""
        self.left -= 1
        source = self.index.sources.get(path) if self.left >= 0 else None
        for directive in source.program.directives if source is not None else ():
            self.left -= 1
            if directive.word in ("define", "undef"):
                self.forget(_name(directive.text))

    def line(self, path: str, directive: Directive, guard: str, around: int) -> None:
        """A directive but an include; *guard* if it opens the file's include guard, *around* are the ``#if`` of other files."""
        word = directive.word
        if word in _OPENING:
            verdict = True if guard else self.condition(directive)
            self.begin(path, directive, self.live, verdict)
            if guard:
                self.undefined.add(guard)
        elif word in ("define", "undef"):
            self.change(directive)
        elif len(self.open) <= around:
            self.left = -1  # as nothing is open
        elif word in _FURTHER:
            self.next(path, directive)
        else:
            self.end()

    def condition(self, directive: Directive) -> bool | None:
        """Whether the condition of a directive holds by itself."""
        word, text = directive.word.removeprefix("el"), directive.text
        if word == "se":
            return True
        if len(text) > LONGEST:
            return None
        if word == "if":
            return holds(text, self.macros, self.undefined)
        found = is_defined(_name(text), self.macros, self.undefined)
        return None if found is None else found is (word == "ifdef")

    def begin(self, path: str, directive: Directive, around: bool | None, verdict: bool | None) -> None:
        default = _name(directive.text) if directive.word == "ifndef" and around else ""
        self.open.append(_Open(around, verdict, _both(around, verdict), default))
        self.note(path, directive.line, around, verdict)

    def next(self, path: str, directive: Directive) -> None:
        """``#elif`` and ``#else``: compiled where none before is, and its own condition holds."""
        opened = self.open[-1]
        own = None if opened.is_taken else self.condition(directive)
        verdict = _both(None if opened.is_taken is None else not opened.is_taken, own)
        opened.default = ""
        opened.current = _both(opened.around, verdict)
        opened.is_taken = True if opened.is_taken or own else False if opened.is_taken is own is False else None
        self.note(path, directive.line, opened.around, verdict)

    def end(self) -> None:
        opened = self.open.pop()
        if (
            opened.is_default and opened.default and opened.current is None
        ):  # it is defined now, as this or as something else
            self.macros[opened.default] = None

    def note(self, path: str, line: int, around: bool | None, verdict: bool | None) -> None:
        """What an ``#if`` inside of one that is not compiled would be says nothing."""
        if around is False:
            return
        place = (path, line)
        known = self.unit.branches.get(place, verdict)
        self.unit.branches[place] = verdict if known == verdict else None

    def change(self, directive: Directive) -> None:
        """``#define`` and ``#undef``."""
        live, name = self.live, _name(directive.text)
        if live is False or not name:
            return
        text = directive.text[len(name) :].strip() if directive.word == "define" else None
        if text is not None and directive.text[len(name) : len(name) + 1] == "(":
            text = None  # a macro with parameters
        if name in self.given or self.defined.get(name, text) != text or live is None or directive.word == "undef":
            self.defined[name] = None
        else:
            self.defined[name] = text
        if live is None:
            self.forget(name)
            self.open[-1].is_default = self.open[-1].is_default or (text is not None and name == self.open[-1].default)
        elif directive.word == "undef":
            self.macros.pop(name, None)
            self.undefined.add(name)
        else:
            self.macros[name] = text
            self.undefined.discard(name)

    def forget(self, name: str) -> None:
        """A macro that may be another now."""
        self.macros.pop(name, None)
        self.undefined.discard(name)
        self.defined[name] = None


def _both(around: bool | None, verdict: bool | None) -> bool | None:
    """Whether both hold, as far as that is known."""
    return False if False in (around, verdict) else True if around and verdict else None


def _name(text: str) -> str:
    """The name at the beginning of a directive's text."""
    end = 0
    while end < len(text) and (text[end].isalnum() or text[end] == "_"):
        end += 1
    return text[:end]


def _guard(directives: Iterable[Directive]) -> str:
    """The macro of a file's include guard: ``#ifndef A``, ``#define A`` and all else up to the ``#endif`` that is the last; "" without."""
    found = [directive for directive in directives if directive.word != "pragma"]
    if len(found) < 3 or (found[1].word, found[-1].word) != ("define", "endif"):
        return ""
    name = _tested(found[0])
    if found[1].text != name and not name.rstrip("_").endswith(("_H", "_HPP", "_HH", "_HXX", "_INCLUDED", "_GUARD")):
        return ""  # a default, which the build may replace
    if _name(found[1].text) != name or not name:
        return ""
    return name if _is_one_block(found) else ""


def _tested(directive: Directive) -> str:
    """The macro that is not defined where ``#ifndef A`` or ``#if !defined(A)`` holds; "" of another directive."""
    text = directive.text.replace(" ", "")
    if directive.word == "ifndef":
        return _name(text)
    return text[len("!defined") :].strip("()") if directive.word == "if" and text.startswith("!defined") else ""


def _is_one_block(found: Sequence[Directive]) -> bool:
    """Whether the last of the directives ends what the first begins, and that has one branch."""
    depth = 0
    for directive in found[:-1]:
        depth += (directive.word in _OPENING) - (directive.word == "endif")
        if not depth or (depth == 1 and directive.word in _FURTHER):
            return False
    return depth == 1
