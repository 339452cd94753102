# SPDX-License-Identifier: Apache-2.0
"""Launch files with constructs of the other ROS version."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence

from haros_ci.api import Check, Finding, Level, Location, System, regex
from haros_ci.api.launch import ConstructUse, included_by, owner
from haros_ci.api.packages import Package, serves_both

#: Words of names by which a launch file is meant for the ROS of that number.
_MEANT = {
    1: regex(r"(?<![a-z0-9])(?:ros_?1|roslaunch|indigo|kinetic|melodic|noetic)(?![a-z0-9])"),
    2: regex(
        r"(?<![a-z0-9])(?:ros_?2|dashing|eloquent|foxy|galactic|humble|iron|jazzy|kilted|lyrical|rolling)(?![a-z0-9])"
    ),
}


#: So many launch files of the other ROS in one package are one finding, whatever others it has.
_MANY = 3


def check(system: System) -> Iterator[Finding]:
    files: dict[str, list[ConstructUse]] = {}
    for use in system.facts(ConstructUse):
        if use.kind == "foreign":
            files.setdefault(use.location.path, []).append(use)
    files = {path: uses for path, uses in files.items() if not _serves_both(path, system)}
    leftovers = [path for path, uses in files.items() if _is_whole(uses, _other(uses))]
    owners = [package for path in leftovers if (package := owner(system, Location(path, 1))) is not None]
    unported: set[str] = set()
    for package in {package.path: package for package in owners}.values():
        found = _unported(package, system)
        unported |= found.keys() & set(leftovers)
        if found and min(found) in leftovers:
            yield _of_package(package, found, system)
    for path, uses in files.items():
        if path not in unported:
            yield _of_file(path, uses, owner(system, Location(path, 1)))


def _is_meant(path: str, package: Package | None, other: int) -> bool:
    """Whether the name of the file, or of a directory that it is in inside its package, says that it is for the *other* ROS."""
    inner = path if package is None or package.path == "." else path.removeprefix(f"{package.path}/")
    return _MEANT[other].search(inner.lower()) is not None


def _serves_both(path: str, system: System) -> bool:
    """Whether the launch file is of a package for both, where the other ROS starts it."""
    package = owner(system, Location(path, 1))
    return package is not None and system.workspace is not None and serves_both(package, system.workspace.text)


def _of_file(path: str, uses: Sequence[ConstructUse], package: Package | None) -> Finding:
    uses = sorted(uses, key=lambda use: (not use.stops, not use.matters))  # the gravest is named; else in their order
    first = uses[0]
    texts = list(dict.fromkeys(use.text for use in uses))
    other = _other(uses)
    is_whole = _is_whole(uses, other)
    is_aside = (other == 1 and first.is_installed is False) or (is_whole and _is_meant(path, package, other))
    is_aside = is_aside or not (first.stops or first.matters)
    if not first.stops:
        message = _passed_over(first, texts)
    else:
        message = _leftover(texts, other) if is_whole else _half_ported(first, texts, other)
    return Finding(
        at=first.location,
        message=message,
        about=(path,),
        related=tuple((use.location, f"{use.text}, too") for use in uses[1:20]),
        flow=included_by(first),
        level=Level.NOTE if is_aside else None,
    )


def _unported(package: Package, system: System) -> Mapping[str, Sequence[ConstructUse]]:
    """The launch files of *package* that are of the other ROS if they are several and all that it has, or many, else none: then one finding stands for them.

    A file in XML that starts and includes nothing is of no ROS.
    """
    files = {path for path in system.whole.launch_files if _is_in(path, package)}
    every = system.whole.foreign_constructs
    found = {path: uses for path, uses in every.items() if _is_in(path, package) and _is_whole(uses, _other(uses))}
    others = {_other(uses) for uses in found.values()}
    is_one = len(found) >= _MANY or (len(found) > 1 and files <= found.keys())
    return found if is_one and len(others) == 1 else {}


def _of_package(package: Package, found: Mapping[str, Sequence[ConstructUse]], system: System) -> Finding:
    first, *rest = sorted(found)
    other = _other(found[first])
    is_aside = other == 1 and all(uses[0].is_installed is False for uses in found.values())
    is_aside = is_aside or all(_is_meant(path, package, other) for path in found)
    is_all = all(path in found for path in system.whole.launch_files if _is_in(path, package))
    return Finding(
        at=found[first][0].location,
        message=f"{'all ' if is_all else ''}{len(found)} launch files of {package.name}, a ROS {3 - other} package, are written for ROS {other}: "
        f"`{_LAUNCH[3 - other]}` rejects them; port them or delete them",
        about=(package.name, f"ROS {other}"),
        related=tuple((found[path][0].location, f"{found[path][0].text} of ROS {other}") for path in rest[:20]),
        level=Level.NOTE if is_aside else None,
    )


def _is_in(path: str, package: Package) -> bool:
    return package.path == "." or path.startswith(package.path + "/")


#: What starts the launch files of each ROS version.
_LAUNCH = {1: "roslaunch", 2: "ros2 launch"}


def _is_whole(uses: Sequence[ConstructUse], other: int) -> bool:
    """Whether the whole file is of the *other* ROS: it is read as such, or starts nodes as that does."""
    return uses[0].ros == other or any(use.text == "exec= of <node>" and use.stops for use in uses)


def _leftover(texts: list[str], other: int) -> str:
    several = f"{len(texts)} construct{'s' if len(texts) > 1 else ''}"
    return (
        f"ROS {other} launch file in a ROS {3 - other} package ({several}, first {texts[0]}): "
        f"`{_LAUNCH[3 - other]}` rejects it; port it or delete it"
    )


def _half_ported(first: ConstructUse, texts: list[str], other: int) -> str:
    return f"{first.text}{_more(texts)} of ROS {other}: `{_LAUNCH[3 - other]}` rejects the whole file{_instead(first)}"


def _passed_over(first: ConstructUse, texts: list[str]) -> str:
    """What roslaunch says a warning of, and goes on without: tags and attributes of ROS 2 beside all that it needs."""
    it, they = ("it", "it says") if len(texts) == 1 else ("them", "they say")
    loss = f", so what {they} does not take effect" if first.matters else ""
    return f"{first.text}{_more(texts)} of ROS 2: `roslaunch` ignores {it}, with a warning{loss}{_instead(first)}"


def _more(texts: list[str]) -> str:
    return f" and {len(texts) - 1} more construct{'s' if len(texts) > 2 else ''}" if len(texts) > 1 else ""


def _instead(first: ConstructUse) -> str:
    return f"; write {first.instead}" if first.instead else ""


def _other(uses: Sequence[ConstructUse]) -> int:
    """The ROS that the constructs of a file are of."""
    return 1 if _is_ros1(uses[0]) else 2


def _is_ros1(use: ConstructUse) -> bool:
    """Whether *use* is a construct of ROS 1: one word of each tells."""
    words: tuple[str, ...] = (
        "type=",
        "ns=",
        "doc=",
        "rosparam",
        "find ",
        "arg ",
        "optenv",
        "machine",
        "clear_params",
        "pass_all",
        "<test",
    )
    words += ("required=", "textfile=", "binfile=", "command=", "<master")
    return any(word in use.text for word in words)


CHECK = Check(
    id="foreign-launch-construct",
    summary="Launch file written for the other ROS version.",
    level=Level.WARNING,
    catalogue="L12",
    tags=("launch",),
    run=check,
    of_refused=True,
)
