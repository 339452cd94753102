# SPDX-License-Identifier: Apache-2.0
"""Headers of which a tool that takes one path through the preprocessor may see nothing in the files that include them.

Such a tool reads a header as the file says that includes it: it may define the header's guard, or another macro that the header asks for, or include it
under a condition. A header that no file includes without all that is analysed by itself, too: the compiler may be given other definitions.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Mapping, Sequence
from typing import NamedTuple

from haros_ci.linters.dead_text import joined, without_raw_texts
from haros_ci.linters.includes import closure
from haros_ci.model.package import SourceFile
from haros_ci.model.workspace import Store, Workspace
from haros_ci.own_sources import OF_LINTERS, digest
from haros_ci.regex import regex
from haros_ci.results.code_alone import without_comments

_GAP = r"(?:[ \t\f\v]|/\*(?:[^*\n]|\*(?!/)){0,200}\*/)*"
_DIRECTIVE = regex(
    rf"^{_GAP}(?:#|%:){_GAP}(if|ifdef|ifndef|elif|elifdef|elifndef|else|endif|define|include|import)\b[ \t]*([^\n]*)",
    re.MULTILINE,
)
_WORD = regex(r"[A-Za-z_]\w*")
_NAME = regex(r'"([^">\n]+)|(<[^">\n]+)')


class Sight(NamedTuple):
    """What a file includes under conditions alone, as written, and the macros that it defines and asks for."""

    conditional: tuple[str, ...]
    defined: tuple[str, ...]
    asked: tuple[str, ...]


def sights(workspace: Workspace, files: Iterable[SourceFile], store: Store) -> dict[str, Sight]:
    """That of every file, by path; one entry of the store holds them by the files' contents."""
    stored = store.get("sights", "", digest(OF_LINTERS))
    known = stored if isinstance(stored, dict) else {}
    found: dict[str, Sight] = {}
    is_fresh = False
    kept = {}
    for file in files:
        view = _from_row(known.get(file.digest))
        if view is None:
            view, is_fresh = sight(workspace.text(file.path)), True
        kept[file.digest] = [list(part) for part in view]
        found[file.path] = view
    if is_fresh:
        store.put("sights", "", digest(OF_LINTERS), kept)
    return found


def _from_row(row: object) -> Sight | None:
    """What was kept; None for what has another shape."""
    if not isinstance(row, list) or len(row) != len(Sight._fields):
        return None
    if not all(isinstance(part, list) and all(isinstance(word, str) for word in part) for part in row):
        return None
    conditional, defined, asked = map(tuple, row)
    return Sight(conditional, defined, asked)


def sight(text: str) -> Sight:
    """That of *text*; the guard around a whole file is no condition, what stands in its ``#else`` is under one. What ``#import`` names a tool may not read. Takes linear time."""
    text = without_raw_texts(joined(text))
    if "/*" in text:
        text = without_comments(text, "c")
    plain: dict[str, None] = {}
    conditional: dict[str, None] = {}
    defined: dict[str, None] = {}
    asked: dict[str, None] = {}
    depth = top = 0
    guard, is_first = "", True
    for match in _DIRECTIVE.finditer(text):
        word, rest = match[1], match[2]
        if word.startswith(("if", "elif")):
            asked |= dict.fromkeys(_WORD.findall(rest))
            depth += word.startswith("if")
            top = min(top, depth - word.startswith("elif"))
            guard = rest.split()[0] if is_first and word == "ifndef" and rest.split() else ""
        elif word == "define":
            name = _WORD.match(rest)
            defined |= {name[0]: None} if name else {}
            top = 1 if name and name[0] == guard and depth == 1 else top
        elif word == "else":
            top = min(top, depth - 1)
        elif word == "endif":
            depth -= 1
            top = min(top, max(depth, 0))
        elif name := _NAME.match(rest):
            (conditional if depth > max(top, 0) or word == "import" else plain)[name[1] or name[2]] = None
        is_first = False
    asked.pop("defined", None)
    return Sight(tuple(name for name in conditional if name not in plain), tuple(defined), tuple(asked))


def unseen(
    direct: Mapping[str, Sequence[str]],
    conditional: Mapping[str, Sequence[str]],
    views: Mapping[str, Sight],
    is_source: Callable[[str], bool],
) -> frozenset[str]:
    """The headers that some source includes, and none as a tool sees it by itself: *direct* has what files include, *conditional* what of that they do under conditions alone."""
    plain = {
        path: tuple(name for name in names if name not in conditional.get(path, ())) for path, names in direct.items()
    }
    places: dict[str, set[str]] = {}
    for path, view in views.items():
        for macro in view.defined:
            places.setdefault(macro, set()).add(path)
    decided = {path: definers for path, view in views.items() if (definers := _definers(path, view, places, direct))}
    reached: set[str] = set()
    seen: set[str] = set()
    for path in filter(is_source, direct):
        every, sure = closure(path, direct), closure(path, plain)
        reached |= every
        around = every | {path}
        seen |= {header for header in sure if header not in decided or decided[header].isdisjoint(around)}
    return frozenset(header for header in reached - seen if not is_source(header))


def _definers(path: str, view: Sight, places: Mapping[str, set[str]], direct: Mapping[str, Sequence[str]]) -> set[str]:
    """The files that define a macro that *path* asks for, but for itself and what it includes."""
    found = {place for macro in view.asked for place in places.get(macro, ())} - {path}
    return found - closure(path, direct) if found else found
