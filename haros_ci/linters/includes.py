# SPDX-License-Identifier: Apache-2.0
"""Which C++ files of the workspace include which, by the text of their #include lines, and what their analysis depends on."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from posixpath import dirname, normpath

from haros_ci.linters.dead_text import dead, is_in, joined
from haros_ci.model.package import SourceFile
from haros_ci.model.workspace import Store, Workspace
from haros_ci.own_sources import OF_LINTERS, digest
from haros_ci.regex import regex

#: Stands in a list of names for one that only the preprocessor can tell (``#include MACRO``).
COMPUTED = "*"
#: Stands before a name that is only asked for (``__has_include``), or included where no compiler reads it (``#if 0``).
PROBED = "?"
#: Stands before one in angle brackets, which is not looked for beside the file.
ANGLED = "<"

_INCLUDE = regex(r'^[ \t]*#[ \t]*(?:include(?:_next)?|import)[ \t]*(?:"([^">\n]+)|(<[^">\n]+))', re.MULTILINE)
_ANY_INCLUDE = regex(
    r"^(?:[ \t\f\v]|/\*(?:[^*\n]|\*(?!/))*\*/)*(?:#|%:|\?\?=)(?:[ \t\f\v]|/\*(?:[^*\n]|\*(?!/))*\*/)*(?:include|import|embed)",
    re.MULTILINE,
)
_PROBE = regex(r'__has_(?:include(?:_next)?|embed)[ \t]*\(?[ \t]*(?:["<]([^">\n]+))?')


def written(workspace: Workspace, files: Iterable[SourceFile], store: Store) -> dict[str, tuple[str, ...]]:
    """For every file what its #include lines name, as written, with COMPUTED and PROBED names last.

    One entry of the store, from content digests to lists, holds them for all files and so says what it is valid for.
    """
    files = tuple(files)
    stored = store.get("includes", "", digest(OF_LINTERS))
    known = stored if isinstance(stored, dict) else {}
    found: dict[str, tuple[str, ...]] = {}
    fresh: dict[str, list[str]] = {}
    for file in files:
        names = known.get(file.digest)
        if not isinstance(names, list) or not all(isinstance(name, str) for name in names):
            names = fresh[file.digest] = list(dict.fromkeys(_names(workspace.text(file.path))))
        found[file.path] = tuple(names)
    if fresh:
        store.put("includes", "", digest(OF_LINTERS), {file.digest: list(found[file.path]) for file in files})
    return found


def direct(workspace: Workspace, search: Sequence[str]) -> dict[str, tuple[str, ...]]:
    """For every C++ file the files that it includes directly, if all have the *search* directories; not cached."""
    paths = [file.path for file in workspace.files if file.language == "cpp"]
    names = {path: ["".join(found) for found in _INCLUDE.findall(workspace.text(path))] for path in paths}
    return resolve(names, dict.fromkeys(paths, search))


def name_of(written: str) -> str:
    """The name of what is *written* in a list, without what stands before it."""
    return written.removeprefix(PROBED).removeprefix(ANGLED)


def resolve(directives: Mapping[str, Sequence[str]], search: Mapping[str, Sequence[str]]) -> dict[str, tuple[str, ...]]:
    """For every file the files that it includes directly: beside itself, but for names in angle brackets, else in its *search* directories."""
    resolved = {}
    basenames = {path.rpartition("/")[2] for path in directives}
    for path, names in directives.items():
        hits: dict[str, None] = {}
        for name in names:
            if name_of(name).rpartition("/")[2] in basenames:  # most are headers of other packages or of the system
                beside = () if name.startswith(ANGLED) else (dirname(path),)
                candidates = (_at(place, name_of(name)) for place in (*beside, *search.get(path, ())))
                hit = next((candidate for candidate in candidates if candidate in directives), path)
                if hit != path:
                    hits[hit] = None
        resolved[path] = tuple(hits)
    return resolved


def _at(directory: str, name: str) -> str:
    path = f"{directory}/{name}" if directory not in ("", ".") else name
    return normpath(path) if "./" in path or "//" in path else path


def needs(
    directives: Mapping[str, Sequence[str]], search: Mapping[str, Sequence[str]]
) -> Callable[[str], tuple[str, ...]]:
    """What tells the files that the analysis of a file can depend on, sorted, without itself.

    These are more than it includes: every file that one of its names could mean, if another one were not there; those that it only
    asks for; and all files, where a name is computed.
    """
    meant: dict[str, tuple[str, ...]] = {}
    basenames = {path.rpartition("/")[2] for path in directives}
    for path, names in directives.items():
        hits: dict[str, None] = {}
        for name in map(name_of, names):
            if name.rpartition("/")[2] in basenames:
                hits |= dict.fromkeys(_at(place, name) for place in (dirname(path), *search.get(path, ())))
        meant[path] = tuple(hit for hit in hits if hit in directives and hit != path)
    everything = tuple(sorted(directives))
    computed = {path for path, names in directives.items() if COMPUTED in names}

    def of(path: str) -> tuple[str, ...]:
        found = closure(path, meant)
        if computed and (path in computed or not computed.isdisjoint(found)):
            return tuple(other for other in everything if other != path)
        return tuple(sorted(found))

    return of


def _names(text: str) -> Iterator[str]:
    """What *text* includes, lines that a backslash continues joined."""
    text = joined(text)
    hidden = dead(text)
    found = [(match[1] or match[2], is_in(match.start(), hidden)) for match in _INCLUDE.finditer(text)]
    plain = [name for name, _ in found]
    used = {name for name, is_dead in found if not is_dead}
    yield from (name for name in plain if name in used)
    probed = _PROBE.findall(text) if "__has_" in text else []
    probed += [name for name in plain if name not in used]
    if "" in probed or len(_ANY_INCLUDE.findall(text)) > len(plain):
        yield COMPUTED
    yield from (PROBED + name for name in probed if name)


def closure(start: str, direct: Mapping[str, Sequence[str]]) -> frozenset[str]:
    """All files that *start* includes, directly or not, without itself."""
    seen, waiting = {start}, [start]
    while waiting:
        for path in direct.get(waiting.pop(), ()):
            if path not in seen:
                seen.add(path)
                waiting.append(path)
    return frozenset(seen - {start})
