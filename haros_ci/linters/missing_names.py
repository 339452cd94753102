# SPDX-License-Identifier: Apache-2.0
"""Names that Python files take from modules of the workspace, or of Python's own, and that these do not have: notes where a change brings them.

pylint's ``no-name-in-module`` is in no profile, as it does not know what a build makes, nor what is installed under the same name, nor
which Python runs on the robot: of Python's own modules a name is missing here if no version has it, on no system.
"""

from __future__ import annotations

import re
import sys
from collections.abc import Iterator
from functools import cache, cached_property
from typing import NamedTuple

from haros_ci.knowledge.facts import PYTHON, Facts
from haros_ci.linters.changed_code import notes
from haros_ci.linters.taken_names import taken
from haros_ci.model.package import SourceFile
from haros_ci.model.submodules import absent, is_below
from haros_ci.model.workspace import Workspace
from haros_ci.regex import regex
from haros_ci.results.module_names import EXTENSIONS, names_of
from haros_ci.results.result import Notification

#: Names that are mentioned; the rest is counted. Longer files are not looked at.
MOST = 20
MAX_TEXT = 300_000
#: What the build makes in a package of Python.
_MADE = frozenset(("msg", "srv", "action", "cfg", "parameters"))
_WORD = regex(r"(?<![\w.])\w+")
#: What gives a module a name that it does not have: the module, or what is called like it, and the name.
_GIVES = regex(r"\b(\w+)\.(\w+)[ \t]*=(?!=)|\bsetattr[ \t]*\(\s*(?:\w+\.)?(\w+)[ \t]*,\s*[\"'](\w+)")
_PATHS = regex(r"\bsys\.(?:path|modules|meta_path)\b|\b__path__\b|\bimportlib\b|\baddsitedir\b")


class Missing(NamedTuple):
    """A *name* that *module* does not have, at *line*."""

    module: str
    name: str
    line: int


def notifications(head: Workspace, base: Workspace | None) -> tuple[Notification, ...]:
    """A note for each such name of *head* that *base* does not lack in the same file; none without a base."""
    if base is None:
        return ()
    old = {file.path: file.digest for file in base.files if file.language == "python"}
    now = {file.path: file.digest for file in head.files if file.language == "python"}
    edited = {path for path in old.keys() | now.keys() if old.get(path) != now.get(path)}
    if not edited:
        return ()
    stems = {part for path in edited for part in path.removesuffix(".py").split("/")[-2:]} - {"__init__"}
    word = re.compile(rf"(?<!\w)(?:{'|'.join(sorted(map(re.escape, stems)))})(?!\w)")
    after, before = _Modules(head), _Modules(base)
    new: list[tuple[str, Missing]] = []
    known: set[tuple[str, str]] | None = None
    for file in head.files:
        if file.language != "python" or file.third_party or not head.reports_on(file.path):
            continue
        if file.path not in edited and not (stems and word.search(head.text(file.path))):
            continue
        found = tuple(after.missing(file))
        if found and known is None:
            known = {(it.module, it.name) for path in edited & old.keys() for it in before.of(path)}
        was = {(it.module, it.name) for it in before.of(file.path)} | (known or set()) if found else set()
        new += ((file.path, one) for one in found if (one.module, one.name) not in was)
    places = [(path, one.line, _message(one)) for path, one in new]
    return notes(places, MOST, "names are taken from modules that do not have them, since this change")


def _message(one: Missing) -> str:
    lacks = f"since this change it takes {one.name} from {one.module}"
    if names_of_python(one.module) is not None:
        return f"{lacks}, a module of Python's own, which has no such name in any version; write another one"
    return f"{lacks}, which has no such name; define it there, or write another one"


def names_of_python(module: str) -> frozenset[str] | None:
    """The public names that *module* of Python's standard library has in any version, on any system; None for other modules."""
    return _facts().words("modules", module)


@cache
def _facts() -> Facts:
    return Facts(PYTHON)


class _Modules:
    """The modules of Python that a *workspace* has, and what files take from them in vain."""

    def __init__(self, workspace: Workspace) -> None:
        self.workspace = workspace

    def of(self, path: str) -> tuple[Missing, ...]:
        """What the file at *path* lacks."""
        file = self._by_path.get(path)
        return () if file is None else tuple(self.missing(file))

    @cached_property
    def _by_path(self) -> dict[str, SourceFile]:
        return {file.path: file for file in self.workspace.files if file.language == "python"}

    def missing(self, file: SourceFile) -> Iterator[Missing]:
        """The names that the file takes from modules, or from packages, that do not have them: each once."""
        text = self.workspace.text(file.path)
        if "import" not in text or len(text) > MAX_TEXT:
            return
        seen: set[tuple[str, str]] = set()
        is_searching = _PATHS.search(text) is not None
        for module, name, line in taken(text):
            if (module, name) not in seen and self._lacks(file, module, name, is_searching):
                yield Missing(module, name, line)
            seen.add((module, name))

    def _lacks(self, file: SourceFile, module: str, name: str, is_searching: bool) -> bool:
        if name.startswith("_") or name in _MADE or name == "*":
            return False
        if (own := names_of_python(module)) is not None and module.partition(".")[0] not in self._by_name:
            return name not in own and (module.rpartition(".")[2], name) not in self._given
        places = self._places(file, module, is_searching)
        if not places or any(name in self.folders.get(place, ()) for place in places):
            return False
        for place in places:
            path = f"{place}.py" if f"{place}.py" in self.paths else f"{place}/__init__.py"
            known = names_of(self.workspace.text(path)) if path in self.python else None
            if known is None or name in known or is_below(f"{place}/{name}", self._absent):
                return False
            if path.endswith("/__init__.py") and self._has_extensions(place):
                return False
        return name not in self._built

    def _places(self, file: SourceFile, module: str, is_searching: bool) -> list[str]:
        """The modules or packages that *module* may be in that file, without ``.py``; none where that may be another one."""
        above = len(module) - len(module.lstrip("."))
        parts = module.lstrip(".").split(".") if module.strip(".") else []
        if above:
            folder = file.path.split("/")[:-above]
            place = "/".join((*folder, *parts))
            return [place] if self._is_module(place) and len(file.path.split("/")) > above else []
        if parts[0] in sys.stdlib_module_names:
            return []
        tail = "/".join(parts)
        found = [place for place in self._by_name.get(parts[-1], ()) if f"/{place}".endswith(f"/{tail}")]
        tops = [place.removesuffix(tail) + parts[0] for place in found]
        return [place for place, top in zip(found, tops, strict=True) if self._is_searched(file, top, is_searching)]

    def _is_searched(self, file: SourceFile, top: str, is_searching: bool) -> bool:
        """Whether Python may find the outermost module there: a package that is in no other one, or what lies beside the file, or above it."""
        folder = top.rpartition("/")[0]
        if f"{top}/__init__.py" in self.paths and f"{folder}/__init__.py".lstrip("/") not in self.paths:
            return True
        return not is_searching and (not folder or is_below(file.path, (folder,)))

    def _is_module(self, place: str) -> bool:
        return f"{place}.py" in self.paths or f"{place}/__init__.py" in self.paths

    @cached_property
    def paths(self) -> frozenset[str]:
        return frozenset(self.workspace.names)

    @cached_property
    def python(self) -> frozenset[str]:
        return frozenset(file.path for file in self.workspace.files if file.language == "python")

    @cached_property
    def folders(self) -> dict[str, set[str]]:
        """What lies in each directory, without what stands behind the first dot."""
        found: dict[str, set[str]] = {}
        for path in self.paths:
            while path:
                folder, _, name = path.rpartition("/")
                inside = found.setdefault(folder, set())
                stem = name.partition(".")[0]
                if stem in inside and name == stem:
                    break
                inside.add(stem)
                path = folder
        return found

    @cached_property
    def _by_name(self) -> dict[str, list[str]]:
        """Where modules and packages of a name are."""
        found: dict[str, list[str]] = {}
        for path in sorted(self.paths):
            if path.endswith("/__init__.py"):
                place = path.removesuffix("/__init__.py")
            elif path.endswith(".py"):
                place = path.removesuffix(".py")
            else:
                continue
            found.setdefault(place.rpartition("/")[2], []).append(place)
        return found

    def _has_extensions(self, place: str) -> bool:
        """Whether a build file in a directory around *place* makes modules of C or C++, whose names it may put together."""
        return any(
            EXTENSIONS.search(text) for folder, text in self._build_files if not folder or is_below(place, (folder,))
        )

    @cached_property
    def _build_files(self) -> list[tuple[str, str]]:
        files = (file.path for file in self.workspace.files if file.language in ("cmake", "setup"))
        return [(path.rpartition("/")[0], self.workspace.text(path)) for path in files]

    @cached_property
    def _built(self) -> frozenset[str]:
        """All words of build files, which may make a module of that name."""
        return frozenset(word for _, text in self._build_files for word in _WORD.findall(text))

    @cached_property
    def _given(self) -> frozenset[tuple[str, str]]:
        """What some file gives to an object of such a name: a module of Python's own can have it from there."""
        found = (one for path in self.python for one in _GIVES.findall(self.workspace.text(path)))
        return frozenset((owner or other, name or of_other) for owner, name, other, of_other in found)

    @cached_property
    def _absent(self) -> frozenset[str]:
        return absent(self.workspace)
