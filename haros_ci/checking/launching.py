# SPDX-License-Identifier: Apache-2.0
"""What checks of launch files have in common: who owns a file, how launch gets to a place in it."""

from __future__ import annotations

import re
from dataclasses import replace
from functools import lru_cache

from haros_ci.checking.system import System
from haros_ci.checking.wording import alternatives
from haros_ci.model.launch_facts import LaunchFact, PackageUse
from haros_ci.model.location import Location
from haros_ci.model.package import Package
from haros_ci.regex import regex

#: A comment of a launch file, in XML, Python or YAML.
_COMMENT = regex(r"<!--.*?(?:-->|\Z)|(?:^|(?<=\s))#[^\n]*", re.DOTALL)
#: What stands between the beginning of a text that is put together and its end: in a sum, in a list, behind an argument.
_BEGUN = regex(r"[)\]\w][ \t]*\+\s*f?[\"']\Z|\)[ \t]*,\s*f?[\"']\Z|[)}]\Z")
_BEFORE = 60


def owner(system: System, location: Location) -> Package | None:
    """The innermost package that the file at *location* lies in."""
    folder = location.path
    while folder:
        folder = folder.rpartition("/")[0]
        found = system.packages_by_path.get(folder or ".")
        if found is not None:
            return found
    return None


def is_nested(location: Location, package: Package, system: System) -> bool:
    """Whether the file at *location* lies in a directory inside *package*, its owner, that has a manifest of its own: no build finds a package there."""
    names = system.workspace.names if system.workspace is not None else frozenset[str]()
    folder = location.path.rpartition("/")[0]
    while folder and folder != package.path:
        if f"{folder}/package.xml" in names:
            return True
        folder = folder.rpartition("/")[0]
    return False


def said_by(use: PackageUse, system: System) -> PackageUse:
    """*use* where it is written: at the include that passes it as an argument, if the package is named there and not in the file itself."""
    if system.workspace is None or not use.included:
        return use
    text = system.workspace.text
    if _is_named(use.package, text(use.location.path)):
        return use
    for depth in range(len(use.included) - 1, -1, -1):
        place = use.included[depth]
        if place.path != use.location.path and _is_named(use.package, text(place.path), in_code=True):
            return replace(use, location=place, included=use.included[:depth])
    return use


def is_end_of_longer(text: str, piece: str) -> bool:
    """Whether *text*, of a launch file, has *piece* behind what gives its beginning, an argument or a sum, and nowhere alone."""
    found = [
        text[max(0, at.start() - _BEFORE) : at.start()] for at in re.finditer(rf"{re.escape(piece)}(?![\w/])", text)
    ]
    return bool(found) and all(_BEGUN.search(before) for before in found)


@lru_cache(maxsize=4096)
def _is_named(package: str, text: str, in_code: bool = False) -> bool:
    """Whether a text names *package*; *in_code*, outside of comments."""
    if package not in text:
        return False
    written = _COMMENT.sub("", text) if in_code else text
    return re.search(rf"(?<![\w-]){re.escape(package)}(?![\w-])", written) is not None


def included_by(fact: LaunchFact) -> tuple[tuple[Location, str], ...]:
    """The includes that lead to *fact*, and its own place, as a flow; () if the launched file itself says it."""
    if not fact.included:
        return ()
    return (*((place, "includes a launch file") for place in fact.included), (fact.location, "which says this"))


def meant(similar: tuple[str, ...]) -> str:
    """A hint at what may be meant: ``; did you mean 'x' or 'y'?``; none where too many are equally near. A file that is not in the package is no other word for this one."""
    if similar and similar[0].startswith("../"):
        return f"; a file like it lies outside of the package, at {similar[0]!r}: name the package that has it, or add the file"
    names = alternatives([repr(name) for name in similar])
    return f"; did you mean {names}?" if names else ""
