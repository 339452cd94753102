# SPDX-License-Identifier: Apache-2.0
"""Files that take the place of another one of the same name, where a change brings that: which of them is used, nobody here can tell for certain.

A header by the order of include directories, a package by standing beside a module, a program by being installed last. The one that
is not used is analysed as if it were, by those who look it up by its name.
"""

from __future__ import annotations

import re
import sys
from collections.abc import Collection, Iterable, Iterator

from haros_ci.model.package import SourceFile
from haros_ci.model.workspace import Problem, Workspace
from haros_ci.regex import regex
from haros_ci.workspace.cmake_parse import ParsedCommand, parse_cmake
from haros_ci.workspace.cut import cut
from haros_ci.workspace.selection import parents

#: Notes of one run, and includes that are held against pairs of headers of one name.
MOST = 20
_MOST_LOOKS = 500_000
_HEADERS = (".h", ".hh", ".hpp", ".hxx", ".h++", ".inl", ".ipp", ".tpp", ".txx")
_INCLUDES = regex(r"^[ \t]*(?:#|%:)[ \t]*(?:include|import)[ \t]*([\"<])([^\">\n]{1,300})", re.M)
_PATHS = frozenset(("include_directories", "target_include_directories"))
#: Shared libraries by whose names Python imports them before a module in source.
_EXTENSION = regex(r"(.+?)(?:\.cpython-[\w.-]+|\.abi3)?\.so")
#: Directories that are called so everywhere, and that nobody imports from Python.
_USUAL = frozenset(("test", "lib2to3", "this", "site"))
#: Headers of C that C++ has by these names, too ([depr.c.headers]), and of POSIX.
_OF_C = frozenset(
    """
    assert.h complex.h ctype.h errno.h fenv.h float.h inttypes.h iso646.h limits.h locale.h math.h setjmp.h signal.h stdalign.h stdarg.h stdatomic.h
    stdbool.h stddef.h stdint.h stdio.h stdlib.h string.h tgmath.h time.h uchar.h wchar.h wctype.h unistd.h fcntl.h pthread.h
    """.split()
)
_KEYWORDS = frozenset(
    "DESTINATION RENAME COMPONENT PERMISSIONS CONFIGURATIONS OPTIONAL TYPE EXPORT RUNTIME LIBRARY ARCHIVE INCLUDES EXCLUDE_FROM_ALL".split()
)


def shadowed(head: Workspace, base: Workspace) -> tuple[Problem, ...]:
    """What takes the place of another file in *head*, and did not in *base*; behind MOST of it the rest is one."""
    old = {file.path: file.digest for file in base.files}
    changed = [file for file in head.files if old.get(file.path) != file.digest and not file.third_party]
    problems = (
        *_headers(head, base, [file for file in changed if file.language == "cpp"], changed),
        *_decoys(head, base, [file for file in changed if file.language == "cpp"]),
        *_modules(head.names, base.names),
        *_turned(head, base),
        *_programs(head, base, [file for file in changed if file.language == "cmake"]),
    )
    return cut((problem for problem in problems if head.reports_on(problem.path)), MOST)


def _headers(
    head: Workspace, base: Workspace, sources: Iterable[SourceFile], changed: Iterable[SourceFile]
) -> Iterator[Problem]:
    """One for each new header, or header of a package whose include directories have changed, that an include may mean in place of another one."""
    every: dict[str, list[SourceFile]] = {}
    for file in head.files:
        if file.language == "cpp" and file.path.endswith(_HEADERS):
            every.setdefault(_name(file.path), []).append(file)
    there = {file.path for file in base.files}
    searched = {file.package for file in changed if file.language == "cmake" and _searches_anew(file, head, base)}
    suspects = {
        file.path: file for file in sources if file.path not in there and len(every.get(_name(file.path), ())) > 1
    }
    for files in every.values() if searched else ():
        suspects |= {file.path: file for file in files if len(files) > 1 and file.package in searched}
    if not suspects:
        return
    names = {_name(path) for path in suspects}
    written: dict[str, list[tuple[SourceFile, str, str]]] = {}
    for file in head.files:
        for quote, name in _included(head.text(file.path), names) if file.language == "cpp" else ():
            written.setdefault(_name(name), []).append((file, quote, name))
    named: set[frozenset[str]] = set()
    left = _MOST_LOOKS
    for path, file in sorted(suspects.items()):
        for other in every[_name(path)]:
            pair = frozenset((path, other.path))
            users = written.get(_name(path), [])
            left -= len(users) + 1
            if left < 0:
                yield Problem(
                    path,
                    f"so many headers are called {_name(path)} that it is not looked up which of them takes another's place",
                )
                return
            name = "" if other.path == path or pair in named else _both(file, other, users)
            if name:
                named.add(pair)
                yield Problem(
                    path,
                    f"{name} may mean this file or {other.path}, by the order of include directories: look which of them is compiled",
                )


def _decoys(head: Workspace, base: Workspace, sources: Iterable[SourceFile]) -> Iterator[Problem]:
    """One for each new header that linters find by the name of one of another package, or of C, which a compiler may have from elsewhere."""
    homes = {package.name: package for package in head.packages}
    for file in sources:
        package = homes.get(file.package or "")
        if package is None or file.path in base.names or not file.path.endswith(_HEADERS):
            continue
        inside = file.path if package.path == "." else file.path.removeprefix(f"{package.path}/")
        others = {dependency.name for dependency in package.dependencies} - {package.name}
        for name in dict.fromkeys((inside, inside.removeprefix("src/"), inside.removeprefix("include/"))):
            first, _, rest = name.partition("/")
            if (rest and first in others) or (not rest and name in _OF_C):
                yield Problem(
                    file.path, f"linters take this for {name}, by which a compiler may find a header that is installed"
                )


def _both(file: SourceFile, other: SourceFile, users: Iterable[tuple[SourceFile, str, str]]) -> str:
    """The name by which some file of *users* includes one of the two, and may mean either; "" without one."""
    for user, quote, name in users:
        is_near = user.package == file.package == other.package
        if not is_near and ("/" not in name or user.package not in (file.package, other.package)):
            continue
        if not all(f"/{one.path}".endswith(f"/{name}") for one in (file, other)):
            continue
        beside = f"{user.path.rpartition('/')[0]}/{name}".lstrip("/")
        if quote == "<" or beside not in (file.path, other.path):
            return name
    return ""


def _included(text: str, names: Iterable[str]) -> list[tuple[str, str]]:
    """The quote and name of what *text* includes under one of the *names*."""
    return [(quote, name) for quote, name in _INCLUDES.findall(text) if _name(name) in names and ".." not in name]


def _searches_anew(file: SourceFile, head: Workspace, base: Workspace) -> bool:
    """Whether the CMake *file* has include directories, or an order of them, that it did not have in *base*."""
    before = _paths(base.text(file.path)) if file.path in base.names else []
    return any(command not in before for command in _paths(head.text(file.path)))


def _paths(text: str) -> list[tuple[str, ...]]:
    return [
        tuple(argument.text for argument in command.arguments) for command in _commands(text) if command.name in _PATHS
    ]


def _modules(names: Iterable[str], before: Iterable[str]) -> Iterator[Problem]:
    """One for each package of Python, or shared library, that stands beside a module of its name since then, or is called as one of Python's own."""
    names, before = frozenset(names), frozenset(before)
    for path in sorted(names):
        if path.endswith(".py") and path not in before and (module := _of_python(path, names)):
            yield Problem(
                path,
                f"linters take this for the module {module} of Python's own, which is called so, in all files that import that",
            )
        if path.endswith("/__init__.py"):
            module = f"{path.removesuffix('/__init__.py')}.py"
        elif path.endswith(".so") and (extension := _EXTENSION.fullmatch(path)):
            module = f"{extension[1]}.py"
        else:
            continue
        if module in names and not (path in before and module in before):
            yield Problem(path, f"Python imports this in place of {module}, which is called so as well")


def _of_python(path: str, names: Collection[str]) -> str:
    """The module of Python's own that the file at *path*, which lies in no package, is called like, itself or as a package; "" without one."""
    stem = path.removesuffix("/__init__.py").removesuffix(".py")
    folder, _, module = stem.rpartition("/")
    is_top = (f"{folder}/__init__.py" if folder else "__init__.py") not in names
    return module if is_top and module in sys.stdlib_module_names and module not in _USUAL else ""


def _turned(head: Workspace, base: Workspace) -> Iterator[Problem]:
    """One for each symbolic link, by a name of code or to a directory with some, that leads to something else than before, or stands in place of a file.

    Where it led to that has moved, or is as it was, nothing is said.
    """
    before = dict(base.links)
    files = {file.path: file for file in base.files}
    now = {file.path: file for file in head.files}
    directories = {above for path in now for above in parents(path)} if head.links else set()
    for path, target in head.links:
        was = before.get(path, path if path in files else target)
        if was == target:
            continue
        new, old = now.get(target), files.get(was)
        if new is None:
            is_seen = target in directories and was in directories
        else:
            is_seen = old is None or new.digest != old.digest
        if is_seen:
            led = f"leads to {target}, and was a file" if was == path else f"leads to {target}, no longer to {was}"
            yield Problem(path, f"this symbolic link {led}: look what stands there")


def _programs(head: Workspace, base: Workspace, changed: Iterable[SourceFile]) -> Iterator[Problem]:
    """One for each program that CMake installs under the name of another one, in the same directory."""
    for file in changed:
        before = _installed_twice(base.text(file.path)) if file.path in base.names else {}
        for (directory, name), sources in _installed_twice(head.text(file.path)).items():
            if before.get((directory, name)) != sources:
                yield Problem(
                    file.path, f"{' and '.join(sources)} are installed as {directory}/{name}: the last one is used"
                )


def _installed_twice(text: str) -> dict[tuple[str, str], tuple[str, ...]]:
    found: dict[tuple[str, str], dict[str, None]] = {}
    for command in _commands(text):
        words = [argument.text for argument in command.arguments]
        what = words[0].upper() if words else ""
        is_python = command.name == "catkin_install_python"
        if not is_python and (command.name != "install" or what not in ("PROGRAMS", "FILES", "TARGETS")):
            continue
        directory = words[at].rstrip("/") if (at := _after(words, "DESTINATION")) else ""
        renamed = words[at] if (at := _after(words, "RENAME")) else ""
        for word in words[1:]:
            if word.upper() in _KEYWORDS:
                break
            if "$" not in _name(word):
                found.setdefault((directory, renamed or _name(word)), {})[word] = None
    return {key: tuple(sources) for key, sources in found.items() if len(sources) > 1 and key[0]}


def _after(words: list[str], keyword: str) -> int:
    """The index of the word behind *keyword*; 0 without one."""
    at = words.index(keyword) + 1 if keyword in words else 0
    return at if at < len(words) else 0


def _commands(text: str) -> Iterator[ParsedCommand]:
    pending = list(reversed(parse_cmake(text).commands))
    while pending:
        command = pending.pop()
        yield command
        for _, body in reversed(command.branches):
            pending += reversed(body)


def _name(path: str) -> str:
    return path.rpartition("/")[2]
