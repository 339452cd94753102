# SPDX-License-Identifier: Apache-2.0
"""Sources that no target compiles, though what is compiled calls what they define."""

from __future__ import annotations

import posixpath
import re
from collections.abc import Iterator

from haros_ci.api import Check, Finding, Level, Location, Project, ProjectPackage, regex
from haros_ci.api.packages import SUFFIXES, Target, loose

_ASIDE = regex(
    r"(?:^|[/_-])(?:tests?|gtest|testing|examples?|demos?|samples?|benchmarks?|old|deprecated|unused|backup|windows|win32)(?:$|[/_.-])"
)
_COMMENT = regex(r"//[^\n]*|/\*.*?(?:\*/|\Z)", re.DOTALL)
#: Libraries that are committed as they were built: ``libarm.a``, ``libarm.so.2``, ``arm.lib``.
_PREBUILT = regex(r"(?:^|/)(?:lib)?([^/]{1,200}?)\.(?:a|lib|dylib|so(?:\.\d{1,8}){0,4})$")
#: Commands that find or link a library by its name or file.
_LINKING = frozenset(
    "find_library link_libraries set_property set_target_properties target_link_libraries target_link_options".split()
)
#: The classes of one package that are looked for, and the largest file.
MAX_CLASSES, MAX_TEXT = 200, 500_000


def check(project: Project) -> Iterator[Finding]:
    for package in project.packages:
        yield from _of(package)


def _of(package: ProjectPackage) -> Iterator[Finding]:
    aside = loose(package)
    aside = [path for path in aside if not _ASIDE.search(path.removeprefix(package.path).lower())]
    if not aside or len(aside) > MAX_CLASSES or _links_prebuilt(package):
        return
    every = frozenset(file.path for file in package.files if file.language == "cpp")
    for path in aside:
        yield from _needed(package, path, every)


def _links_prebuilt(package: ProjectPackage) -> bool:
    """Whether *package* finds or links a library that is committed as a file, which may have any symbol: ``find_library(ARM libarm.a lib)``."""
    files = [found for path in package.project.workspace.names if (found := _PREBUILT.search(path)) is not None]
    if not files:
        return False
    words = {
        posixpath.basename(part).removeprefix("-l")
        for command in package.build.commands
        if command.name in _LINKING
        for word in command.arguments
        for part in word.split(";")
    }
    named = {posixpath.basename(found.string) for found in files}
    made = {target.name for target in package.build.targets if target.kind != "imported"}
    return not words.isdisjoint(named | ({found[1] for found in files} - made))


def _needed(package: ProjectPackage, path: str, every: frozenset[str]) -> Iterator[Finding]:
    """A target that calls a method which *path* alone defines, by the header that is called like it."""
    project = package.project
    program = project.programs.get(path)
    stem = posixpath.splitext(posixpath.basename(path))[0]
    headers = {
        item
        for item in every
        if posixpath.splitext(posixpath.basename(item))[0] == stem and not item.endswith(SUFFIXES)
    }
    if program is None or len(headers) != 1:
        return
    defined = {
        (function.owner.replace("::", ".").rpartition(".")[2], function.name.replace("::", ".").rpartition(".")[2])
        for function in program.functions
        if function.body is not None and function.owner
    }
    elsewhere = {
        (function.owner.replace("::", ".").rpartition(".")[2], function.name.replace("::", ".").rpartition(".")[2])
        for other, facts in project.programs.items()
        if other != path and other in every
        for function in facts.functions
        if function.body is not None and function.owner
    }
    own = sorted(defined - elsewhere)
    header = headers.pop()
    for target in package.build.targets if own else ():
        found = _caller(package, target, header, own)
        if found is not None:
            place, name = found
            yield Finding(
                at=target.location,
                message=f"{target.name} uses {name}, which {path} defines, but no target compiles that file: the linker reports "
                f"{name} as undefined; add {posixpath.relpath(path, posixpath.dirname(target.location.path))} to the "
                f"sources of {target.name}, or of a library that it links",
                about=(package.name, path),
                apart=(path,),
                related=((Location(path, 1), "no target compiles it"), (place, f"{name} is used here")),
            )
            return


def _caller(
    package: ProjectPackage, target: Target, header: str, own: list[tuple[str, str]]
) -> tuple[Location, str] | None:
    """Where a source of an executable that includes *header* makes an object of a class of it, or calls a method by its full name."""
    if target.kind != "executable" or target.is_test or target.is_conditional:
        return None
    for source in target.sources:
        if source in target.conditional_sources or not _includes(package, source, header):
            continue
        text = package.project.text(source)[:MAX_TEXT]
        plain = _COMMENT.sub(lambda match: re.sub(r"[^\n]", " ", match[0]), text)
        for owner, name in own:
            made = rf"(?:new\s+|make_shared<\s*|make_unique<\s*|^[ \t]*)(?:\w+::)*{re.escape(owner)}\b\s*(?:>\s*\(|\(|\w+\s*[;({{])"
            used = made if name == owner else rf"\b{re.escape(owner)}::{re.escape(name)}\s*\("
            match = re.search(used, plain, re.MULTILINE)
            if match is not None:
                return Location(source, plain.count("\n", 0, match.end()) + 1), f"{owner}::{name}"
    return None


def _includes(package: ProjectPackage, source: str, header: str) -> bool:
    program = package.project.programs.get(source)
    names = (include.strip('<>"') for include in program.includes) if program is not None else ()
    return any(package.included.own(name, source) == header for name in names)


CHECK = Check(
    id="source-not-built",
    summary="Source file that no target compiles although its definitions are used.",
    level=Level.ERROR,
    tags=("build", "code"),
    project=check,
)
