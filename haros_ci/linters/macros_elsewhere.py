# SPDX-License-Identifier: Apache-2.0
"""Macros of headers that cppcheck is not given: those of other packages of the workspace, of directories that it does not look in, of what a build makes of a template, and headers that a build puts before each source.

It takes such a macro for a name or a call of a function that it does not know, and what it stands for is compiled and has no findings.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator
from typing import NamedTuple

from haros_ci.linters.dead_text import dead, is_in, joined
from haros_ci.linters.meanings import gives_code, is_word_for_a_word
from haros_ci.model.package import SourceFile
from haros_ci.model.workspace import Workspace
from haros_ci.regex import regex
from haros_ci.results.code_alone import without_comments

#: Headers that are looked at for one file.
_MOST = 300
_INCLUDE = regex(r"^[ \t]*(?:#|%:)[ \t]*(?:include(?:_next)?|import)[ \t]*[\"<]([^\">\n]{1,300})", re.M)
#: A macro with its words, over several lines, too.
DEFINED = regex(
    r"^[ \t]*(?:#|%:)[ \t]*(?:define|cmakedefine)[ \t]+([A-Za-z_]\w{0,100})\b((?:[^\n\\]|\\\r?\n|\\.){0,8000})", re.M
)
_UNDEFINED = regex(r"^[ \t]*(?:#|%:)[ \t]*undef[ \t]+([A-Za-z_]\w{0,100})", re.M)
_TESTED = regex(
    r"^[ \t]*(?:#|%:)[ \t]*(?:ifn?def[ \t]+([A-Za-z_]\w*)|(?:el)?if\b[^\n]{0,400}?\bdefined\b[ \t(]*([A-Za-z_]\w*))",
    re.M,
)
_WORD = regex(r"[A-Za-z_]\w*")
#: A function with its body: a macro of its name is what is called in its place. Words before brackets that are no functions.
_FUNCTION = regex(
    r"\b([a-z_]\w*)\)?\s*\((?:[^(){};]|\([^(){};]{0,200}\)){0,400}\)\s*(?:(?:const|noexcept|override|final)\s*){0,4}\{"
)
_CONTROL = frozenset("if for while switch catch constexpr sizeof return".split())
#: What makes a header of a template, with its name; what is put before each source of a target; what a variable is given.
_CONFIGURED = regex(r"\bconfigure_file\s*\(\s*\"?([^\s()\"]{1,400})\"?\s+\"?([^\s()\"]{1,400})\"?", re.I)
_FORCED = regex(
    r"\btarget_precompile_headers\s*\(([^()]{1,8000})\)|(?<![\w-])-{1,2}(?:include|imacros)[\s;]+([^\s;\"()]{1,400})",
    re.I,
)
_MAY_MAKE = regex(r"configure_file|precompile_headers|-include|-imacros", re.I)
_SET = regex(r"\bset\s*\(\s*(\w{1,100})\s+\"?([A-Za-z_]\w{0,100})\"?\s*\)", re.I)
_PLACE = regex(r"@(\w{1,100})@|\$\{(\w{1,100})\}")
_TEMPLATE = regex(r"(.+\.(?:h|hh|hpp|hxx|h\+\+|inl|ipp|tpp|txx))\.(?:in|em|template|tmpl|tpl|j2|jinja2?)", re.I)
_HEADER = regex(r"[\w.+-]+\.(?:h|hh|hpp|hxx|h\+\+|inl|ipp|tpp|txx)\b", re.I)


class Macro(NamedTuple):
    """What stands for a *name*, blanks made one; *is_odd* where a tool that does not know it reads other code than the compiler."""

    name: str
    meaning: str
    is_odd: bool


class _Look(NamedTuple):
    included: tuple[str, ...]
    macros: tuple[Macro, ...]


class MacrosElsewhere:
    """The headers of *workspace* by their names, and the macros that they define; each header is read once."""

    def __init__(self, workspace: Workspace) -> None:
        self._workspace = workspace
        self._homes = {
            package.name: "" if package.path == "." else f"{package.path}/" for package in workspace.packages
        }
        self._by_name: dict[str, list[str]] = {}
        for file in workspace.files:
            if file.language == "cpp":
                self._by_name.setdefault(file.path.rpartition("/")[2], []).append(file.path)
        self._read: dict[str, _Look] = {}
        self._values: dict[str, str] = {}
        #: The templates of headers, by the names of these; the headers that a build puts before sources, by package.
        self.templates: dict[str, list[str]] = {}
        self.forced: dict[str | None, dict[str, None]] = {}
        self._look_at_builds()

    def _look_at_builds(self) -> None:
        named: dict[str, set[str]] = {}
        for file in self._workspace.files:
            if file.language != "cmake":
                continue
            text = self._workspace.text(file.path)
            if not _MAY_MAKE.search(text):
                continue
            text = without_comments(text, "cmake")
            for source, target in _CONFIGURED.findall(text):
                if _HEADER.fullmatch(target.rpartition("/")[2]):
                    named.setdefault(source.rpartition("/")[2], set()).add(target.rpartition("/")[2])
            for words, flag in _FORCED.findall(text):
                for name in _HEADER.findall(words or flag):
                    self.forced.setdefault(file.package, {})[name] = None
            self._values |= dict(_SET.findall(text)) if "configure_file" in text.lower() else {}
        for path in sorted(self._workspace.names):
            name = path.rpartition("/")[2]
            own = _TEMPLATE.fullmatch(name)
            for target in {*named.get(name, ()), *([own[1]] if own else ())}:
                self.templates.setdefault(target, []).append(path)

    def used(self, file: SourceFile) -> Iterator[tuple[str, str]]:
        """What *file* uses of them, in words, and its meaning: by the headers that it includes, that these do, and that come before it."""
        words: frozenset[str] | None = None
        tested: frozenset[str] = frozenset()
        defined: frozenset[str] = frozenset()
        for path in self.unseen(file):
            macros = self.look(path).macros
            if macros and words is None:
                text = without_comments(self._workspace.text(file.path), "c")
                words = frozenset(_WORD.findall(text))
                tested = frozenset(one or other for one, other in _TESTED.findall(text))
                defined = frozenset(_FUNCTION.findall(text)) - _CONTROL
            for macro in macros:
                if macro.name in (words or ()) and (macro.is_odd or macro.name in tested or macro.name in defined):
                    yield f"the macro {macro.name} of {path}", macro.meaning

    def given(self, file: SourceFile) -> list[Macro]:
        """All macros that come to *file* by headers that cppcheck is not given."""
        return [macro for path in self.unseen(file) for macro in self.look(path).macros]

    def reached(self, file: SourceFile) -> list[str]:
        """The headers of the workspace that *file* includes, those that cppcheck is given and those that it is not."""
        seen = {file.path}
        self._follow([(file.path, True)], file, seen, [])
        return sorted(seen - {file.path})

    def unseen(self, file: SourceFile) -> list[str]:
        """The headers that the compiler finds by the names in *file*, or puts before it, and cppcheck does not."""
        unseen: list[str] = []
        seen = {file.path}
        self._follow([(file.path, True)], file, seen, unseen)
        forced = self.forced.get(file.package, {})
        first = [path for name in forced for path in self.others(name) if path not in seen]
        seen.update(first)
        unseen += first
        self._follow([(path, False) for path in first], file, seen, unseen)
        return unseen

    def _follow(self, waiting: list[tuple[str, bool]], file: SourceFile, seen: set[str], unseen: list[str]) -> None:
        home = self._homes.get(file.package or "", "")
        while waiting and len(seen) < _MOST:
            path, is_given = waiting.pop()
            for name in self.look(path).included:
                beside = f"{path.rpartition('/')[0]}/{name}".lstrip("/")
                places = (beside, f"{home}include/{name}", f"{home}src/{name}", f"{home}{name}")
                own = next((place for place in places if place in self._workspace.names), None) if is_given else None
                for found in [own] if own else self.others(name):
                    if found not in seen:
                        seen.add(found)
                        waiting.append((found, own is not None))
                        unseen += [] if own else [found]

    def others(self, name: str) -> list[str]:
        """The headers that may be meant by *name*, and the templates of which one is made that is called so."""
        last = name.rpartition("/")[2]
        found = [other for other in self._by_name.get(last, ()) if f"/{other}".endswith(f"/{name}")]
        return [*found, *self.templates.get(last, ())]

    def look(self, path: str) -> _Look:
        """What the file at *path* includes, and the macros that it defines or takes back."""
        found = self._read.get(path)
        if found is None:
            text = joined(self._workspace.text(path))
            hidden = dead(text)
            names = (match[1] for match in _INCLUDE.finditer(text) if not is_in(match.start(), hidden))
            macros = self._macros(path, without_comments(text, "c")) if "define" in text or "undef" in text else ()
            found = self._read[path] = _Look(tuple(dict.fromkeys(names)), tuple(dict.fromkeys(macros)))
        return found

    def _macros(self, path: str, text: str) -> Iterator[Macro]:
        is_template = any(path in paths for paths in self.templates.values())  # few have any
        for name, words in DEFINED.findall(text):
            if is_template:
                words = _PLACE.sub(lambda place: self._values.get(place[1] or place[2], "1"), words)
            yield Macro(name, " ".join(words.split()), gives_code(words) or is_word_for_a_word(name, words))
        yield from (Macro(name, "#undef", True) for name in _UNDEFINED.findall(text))


def brought(
    after: MacrosElsewhere, before: MacrosElsewhere, changed: Iterable[SourceFile], old: dict[str, SourceFile]
) -> frozenset[str]:
    """The names of macros that *changed* files and templates bring to those that cppcheck is not given, with another meaning than *before*: files that use them are looked at though they are as they were."""
    new: set[Macro] = set()
    for file in changed:
        new |= {*after.look(file.path).macros, *after.given(file)}
        if file.path in old:
            new -= {*before.look(file.path).macros, *before.given(old[file.path])}
    known = {path for paths in before.templates.values() for path in paths}
    for path in {path for paths in after.templates.values() for path in paths}:
        new |= {*after.look(path).macros} - ({*before.look(path).macros} if path in known else set())
    for package, names in after.forced.items():
        for name in names.keys() - before.forced.get(package, {}).keys():
            new |= {macro for path in after.others(name) for macro in after.look(path).macros}
    return frozenset(macro.name for macro in new)
