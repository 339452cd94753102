# SPDX-License-Identifier: Apache-2.0
"""Code that nothing uses: C++ sources that no target compiles, superseded Python modules that nothing names."""

from __future__ import annotations

import posixpath
import re
from collections import defaultdict
from collections.abc import Collection, Iterable
from functools import cached_property

from haros_ci.model.former_names import is_archived, mention, superseded
from haros_ci.model.package import SourceFile
from haros_ci.model.python_names import as_python_reads
from haros_ci.model.unbuilt import SUFFIXES, is_cmake, not_included, uncompiled
from haros_ci.regex import regex
from haros_ci.workspace.judged import Judged

_INCLUDE = regex(r"^[ \t]*#[ \t]*include[ \t]*[<\"]([^>\"\n]+)", re.MULTILINE)
#: Builds other than CMake, in whose directory, or below it, nothing is known.
_OTHER_BUILDS = frozenset(
    "makefile gnumakefile platformio.ini build build.bazel meson.build sconstruct sdkconfig library.properties .project".split()
)
_OTHER_PROJECTS = (".pro", ".ino", ".vcxproj", ".mk", ".bazel", ".gyp", ".ioc", ".ld", ".uvprojx", ".cproject")
#: Files that build a package.
_OF_BUILDS = frozenset(("CMakeLists.txt", "setup.cfg", "setup.py"))
#: Files that may compile a source: a Python extension, a script.
_BUILDING = ("setup", "python", "shell", "dockerfile", "yaml")
#: Names of Python files that tools find by their names.
_FOUND = regex(r"(?:__\w+__|setup|conf|conftest|noxfile|fabfile|manage|test_.*|.*_test|.*\.launch|launch_.*)")
#: Words in the names of directories that hold what somebody has tried out.
_SKETCHES = frozenset(
    "drafts experiments notes playground sandbox scratch scratchpad temp testing tmp trials tryout".split()
)
#: Names of packages that are there to try things out.
_TRIALS = frozenset("drafts playground sandbox scratch scratchpad tryout".split())
#: Names of files that hold what somebody has tried out.
_TRIED = regex(
    r"(?:drafts?|scratch(?:[_-]?(?:pad|paper))?|playground|sandbox|scribbles?|te?mp|trial|tryout|untitled)[_-]?\d{0,3}"
)
_ARCHIVED_TEST = regex(r"test_.*|.*_test")
#: The first comments and text of a Python file, and what they say of one that is kept for reference.
_HEAD = 2_000
_FIRST = regex(
    r"(?:[ \t]*#[^\n]*\n|[ \t]*\n)*(?:[rRuU]?\"\"\"(?:(?!\"\"\").)*\"\"\"|[rRuU]?'''(?:(?!''').)*''')?", re.DOTALL
)
_GIVEN_UP = regex(
    r"^\W*(?:\w+\W+)?DEPRECATED\b|\b(?:this|the) (?:script|file|module|node|program|version) is (?:now )?(?:deprecated|obsolete|superseded|no longer (?:used|maintained))"
    r"|\b(?:deprecated|obsolete)\b[^.\n]{0,80}\b(?:do not use|don't use|kept for reference|use \S+ instead)|\bkept (?:only )?for reference only\b",
    re.IGNORECASE | re.MULTILINE,
)
_OF_TOOLS = frozenset("test tests launch cfg doc docs plugins plugin".split())
#: What imports modules whose names stand nowhere.
_DYNAMIC = regex(
    r"\bimport_module\s*\(|\b__import__\s*\(|\bpkgutil(?:[ \t]+as\b|[ \t]*\.[ \t]*(?!get_data\b)\w)|\bfrom[ \t]+pkgutil\b|\biter_modules\b|\bspec_from_file_location\b|\bload_source\s*\("
    r"|\bSourceFileLoader\b|\brun_path\s*\(|\brunpy\b|\bexecfile\s*\(|\*\.py\b|\blistdir\s*\(\s*os\.path\.dirname"
)
#: What names a module comes first: most modules are named by one of a few files.
_ORDER = {language: place for place, language in enumerate(("setup", "cmake", "launch", "package", "xml", "python"))}


class Unused(Judged):
    """Which files nothing uses."""

    def _judge(self, files: Collection[SourceFile]) -> Iterable[str]:
        return {*self._uncompiled(files), *self._unnamed(files)}

    def _uncompiled(self, files: Iterable[SourceFile]) -> list[str]:
        paths_by_package: dict[str, list[str]] = defaultdict(list)
        for file in files:
            if file.package and file.path.endswith(SUFFIXES):
                paths_by_package[file.package].append(file.path)
        if not paths_by_package:
            return []
        from haros_ci.workspace.build import build_of  # most runs have no finding to ask for

        packages = {package.name: package for package in reversed(self._workspace.packages)}
        left: list[str] = []
        for name, paths in paths_by_package.items():
            package = packages[name]
            inside = "" if package.path == "." else f"{package.path}/"
            own = [path for path in self._workspace.names if path.startswith(inside)]
            around = {_directory(path) for path in own if _is_other_build(path)}
            mine = [path for path in paths if path.startswith(inside) and around.isdisjoint(_above(path))]
            if mine:
                texts = [self._workspace.text(path) for path in own if is_cmake(path)]
                left += uncompiled(build_of(self._workspace, package), package, mine, texts)
        left = not_included(left, self._included) if left else []
        return [path for path in left if not self._is_named(path.rpartition("/")[2])]

    def _is_named(self, name: str) -> bool:
        files = (file.path for file in self._workspace.files if file.language in _BUILDING)
        return any(name in self._workspace.text(path) for path in files)

    @cached_property
    def _included(self) -> frozenset[str]:
        """The last parts of all names that C++ files of the workspace include."""
        texts = (self._workspace.text(file.path) for file in self._workspace.files if file.language == "cpp")
        return frozenset(posixpath.basename(name.strip()) for text in texts for name in _INCLUDE.findall(text))

    def _unnamed(self, files: Iterable[SourceFile]) -> list[str]:
        """The Python modules among *files* that are superseded copies and that only their own files name."""
        candidates = [file for file in files if file.language == "python" and self._may_be_left(file)]
        asked = frozenset(file.path for file in candidates)
        if any(self._is_set_aside(file) for file in candidates):  # one of them may be used by another that is used
            candidates += (file for file in self._aside if file.path not in asked)
        left = {file.path: _called(file) for file in candidates}
        for other in self._by_order:
            if asked.isdisjoint(left):
                return []
            left = self._without_named(left, other, is_used=not self._is_set_aside(other) or self._is_built(other))
        return [path for path in self._without_used(left, asked) if path in asked]

    def _without_used(self, left: dict[str, str], asked: frozenset[str]) -> dict[str, str]:
        """*left* without what files that are set aside name, themselves, or by others like them, named by a file that is not; as long as one *asked* for is left."""
        waiting = [file for file in self._aside if file.path not in left]
        while waiting and not asked.isdisjoint(left):
            before = left
            left = self._without_named(left, waiting.pop(), is_used=True)
            named = sorted(before.keys() - left.keys()) if left is not before else ()
            waiting += (self._files[path] for path in named if self._is_set_aside(self._files[path]))
        return left

    def _without_named(self, left: dict[str, str], other: SourceFile, *, is_used: bool) -> dict[str, str]:
        """*left*, paths with their stems, without those that *other* names. What is set aside together names each other, unless *other* is used."""
        text = as_python_reads(self._workspace.text(other.path))
        open_to = {path for path in left if is_used or not self._is_set_aside(self._files[path])}
        named: set[str] = set()
        if other.language in ("python", "launch", "setup", "cmake") and _DYNAMIC.search(text):
            named = {
                path
                for path in open_to
                if self._files[path].package == other.package and " " not in left[path]  # no module has such a name
            }
        for path in open_to - named - {other.path}:
            if left[path] in text and re.search(self._naming(self._files[path], left[path]), text):
                named.add(path)
        return {path: stem for path, stem in left.items() if path not in named} if named else left

    @cached_property
    def _aside(self) -> list[SourceFile]:
        """The Python modules, launch files and CMake files that are set aside, in order."""
        languages = ("python", "launch", "cmake")
        return [file for file in self._by_order if file.language in languages and self._is_set_aside(file)]

    @cached_property
    def _homes(self) -> frozenset[str]:
        """The directories of the packages."""
        return frozenset(package.path for package in self._workspace.packages)

    def _is_built(self, file: SourceFile) -> bool:
        """Whether *file* is what builds a package, which is built wherever it lies."""
        return posixpath.basename(file.path) in _OF_BUILDS and _directory(file.path) in self._homes

    def _naming(self, file: SourceFile, stem: str) -> str:
        """The pattern of what names *file*: its *stem* as a word, but one word (``controller``, ``CBF``) of a file that is set aside as a module or a file alone."""
        name = mention(file.path, stem)
        if file.language == "cmake":
            return rf"\badd_subdirectory\s*\([^()]{{0,300}}(?<!\w){re.escape(stem)}(?!\w)"
        if self._is_set_aside(file) and stem.isalnum():
            return (
                rf"(?m){name}\.py(?!\w)|(?:(?<=[\"'/])|(?<=\w\.)){name}[:\"']|^[ \t]*{name}[ \t]*,?[ \t]*$"
                rf"|\bimport[ \t(][^\n]{{0,200}}?{name}|\bfrom[ \t]+[\w.]{{0,200}}?{name}"
            )
        return name

    @cached_property
    def _by_order(self) -> list[SourceFile]:
        return sorted(self._workspace.files, key=lambda file: (_ORDER.get(file.language, len(_ORDER)), file.path))

    def _may_be_left(self, file: SourceFile) -> bool:
        """Whether a Python file is a superseded copy, or archived: any other one may be started by hand, or imported from elsewhere."""
        stem, directory = _stem(file.path), _directory(file.path)
        if not file.path.endswith(".py"):
            return False
        if is_archived(file.path) and _ARCHIVED_TEST.fullmatch(stem):
            return True
        if _FOUND.fullmatch(stem) or _OF_TOOLS.intersection(directory.split("/")):
            return False
        if _TRIED.fullmatch(stem.lower()):
            return True
        return self._is_set_aside(file) or self._is_superseded(stem, directory) or self._is_given_up(file.path)

    def _is_set_aside(self, file: SourceFile) -> bool:
        return is_archived(file.path) or self._is_sketch(file)

    def _is_sketch(self, file: SourceFile) -> bool:
        """Whether the file is beside packages, in a directory of notes or trials by its name, or in a package that is called so."""
        if file.package is not None:
            return file.package.lower() in _TRIALS and len(self._workspace.packages) > 1
        words = re.split(r"[^a-z0-9]+", _directory(file.path).lower())
        return bool(self._workspace.packages) and not _SKETCHES.isdisjoint(words)

    def _is_given_up(self, path: str) -> bool:
        """Whether the first comment or text of the file says that it is not to be used any more."""
        text = self._workspace.text(path)[:_HEAD]
        head = _FIRST.match(text)
        return head is not None and _GIVEN_UP.search(head[0]) is not None

    def _is_superseded(self, stem: str, directory: str) -> bool:
        base = superseded(stem)
        if not base:
            return False
        beside = (_stem(path) for path in self._beside.get(directory, ()))
        return any(name == base or (name != stem and name.startswith(f"{base}_")) for name in beside)

    @cached_property
    def _beside(self) -> dict[str, list[str]]:
        found: dict[str, list[str]] = defaultdict(list)
        for path in self._workspace.names:
            if path.endswith(".py"):
                found[_directory(path)].append(path)
        return found


def _is_other_build(path: str) -> bool:
    name = path.rpartition("/")[2].lower()
    return name in _OTHER_BUILDS or name.endswith(_OTHER_PROJECTS)


def _above(path: str) -> Iterable[str]:
    """The directories around the file at *path*, the innermost first."""
    while path != ".":
        path = _directory(path)
        yield path


def _called(file: SourceFile) -> str:
    """What others call *file*: the name without its ending; of what CMake reads, the directory."""
    return posixpath.basename(_directory(file.path)) if file.language == "cmake" else _stem(file.path)


def _stem(path: str) -> str:
    return posixpath.splitext(posixpath.basename(path))[0]


def _directory(path: str) -> str:
    return path.rpartition("/")[0] or "."
