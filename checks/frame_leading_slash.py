# SPDX-License-Identifier: Apache-2.0
"""Frame ids with a leading slash (tf2 migration: "tf2 does not accept frame ids starting with /")."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Sequence

from haros_ci.api import Check, Decidability, Finding, Level, Location, System, SystemNode, regex
from haros_ci.api.launch import is_end_of_longer
from haros_ci.api.robots import FrameUse, frames_in, listeners_of_tf

#: Parameters that hold the name of a frame.
_PARAMETER = regex(r"(?:^|[_./:])(?:frame|frame_id|frameid|[a-z0-9]+_frame|[a-z0-9_]+_frame_id)$")
_ENDS = ("frame", "frame_id", "frameid")
_FRAME = regex(r"/[A-Za-z]\w*(?:/\w+)*")
#: What takes a leading slash off: of a variable, which comes first, or of whatever is there.
_STRIPPING = (
    r"(?:\[\s*1\s*:\s*\]|\[\s*0\s*\]\s*[!=]=\s*[\"']/|\.\s*front\s*\(\s*\)\s*[!=]=\s*'/|\.\s*at\s*\(\s*0\s*\)\s*[!=]=\s*'/"
    r"|\.\s*(?:l?strip|removeprefix|startswith|starts_with|replace)\s*\(\s*[\"']/"
    r"|\.\s*(?:erase\s*\(\s*(?:0\s*,\s*1\b|\w+\s*\.\s*c?begin\s*\(\s*\)\s*\))|substr\s*\(\s*1\b))"
)
_STRIPS = regex(_STRIPPING + r"|\bstrip_?(?:leading_?)?slash\b", re.IGNORECASE)
_STRIPPED = regex(r"\b(\w+)\s*" + _STRIPPING)
_WORD = regex(r"[A-Za-z_]\w*")
_TEXTS = regex(r"\"[^\"\n]*\"|'[^'\n]*'")
_CALLED = regex(r"\b([A-Za-z_]\w*)\s*\(")
#: A function that is defined here: its name, up to its body.
_DEFINED = regex(r"\b(?:def\s+)?([A-Za-z_]\w*)\s*\([^;{}()]{0,400}\)\s*(?:const\s*)?(?:->\s*\w+\s*)?[{:]")
#: Words of a statement that reads a parameter, which are not its own.
_NOT_ITS_OWN = frozenset(
    "this self node std string auto const get_parameter declare_parameter get_parameter_or as_string value string_value "
    "get_parameter_value get_value get get_param param getParam getParameter rclcpp rclpy rospy ros if return str".split()
)
#: Lines of a launch file in which what a node is given stands.
_LINES = 20
#: Characters of a function's body that are looked at.
_BODY = 1500
_CODE = ("cpp", "python")
#: The package of the broadcasters: who receives what they send takes the slash off, if it is tf2, so they get no more than a note.
_BROADCASTERS = "tf2_ros"


#: Files by path and digest with the frames in them.
_seen: dict[tuple[str, str], tuple[FrameUse, ...]] = {}


def check(system: System) -> Iterator[Finding]:
    reported: set[Location] = set()
    for found in (*_parameters(system), *_broadcasters(system), *_code(system)):
        if found.at not in reported:
            reported.add(found.at)
            yield found


def _uses_tf2(package: str, ros: int, system: System) -> bool:
    """ROS 2 has tf2 alone; in ROS 1 the package has to depend on tf2_ros, and not on tf, which takes a slash for tf_prefix."""
    if ros == 2:
        return True
    found = system.packages.get(package)
    needs = {dependency.name for dependency in found.dependencies} if found is not None else set()
    return "tf2_ros" in needs and "tf" not in needs


def _is_named(name: str) -> bool:
    """Whether a parameter of this *name* holds a frame."""
    return name.endswith(_ENDS) and _PARAMETER.search(name) is not None


def _parameters(system: System) -> Iterator[Finding]:
    by_name = {parameter.name: parameter for parameter in system.parameters if _is_named(parameter.name)}
    readers: dict[str, SystemNode] = {}
    places: dict[str, set[Location]] = {}
    for node in system.nodes:
        for end in node.of("getters", "parameters"):
            if _is_named(end.name) and end.in_source:
                places.setdefault(end.name, set()).add(end.location)
    for node in system.nodes:
        if node.package == _BROADCASTERS or not _uses_tf2(node.package, node.ros, system):
            continue
        for end in node.of("getters", "parameters"):
            if not end.known or not _is_named(end.name):
                continue
            readers.setdefault(end.name, node)
            is_default = end.name not in by_name and end.in_source and _is_frame(end.raw.value)
            if is_default and not _is_stripped(system, places[end.name]):
                yield _finding(end.location, end.raw.value, f"the parameter {end.name}", node)
    for name, parameter in by_name.items():
        owner = readers.get(name) or _owner(name, system)
        place = parameter.origin or parameter.location
        is_told = owner is not None and place is not None and _is_frame(parameter.value) and not parameter.unknowns
        if (
            is_told
            and not _is_stripped(system, places.get(name, ()))
            and not _is_put_together(system, parameter.location, str(parameter.value))
        ):
            assert owner is not None and place is not None
            yield _finding(place, parameter.value, f"the parameter {name}", owner)


def _is_put_together(system: System, place: Location | None, frame: str) -> bool:
    """Whether the launch file has an empty argument before the slash: wherever that is not empty, there is no leading slash."""
    if system.workspace is None or place is None or not place.line:
        return False
    lines = system.workspace.text(place.path).split("\n")[place.line - 1 :]
    return is_end_of_longer("\n".join(lines[:_LINES]), frame)


def _is_stripped(system: System, places: Iterable[Location]) -> bool:
    """Whether the code that reads the parameter at one of *places* takes the slash off: there, of the variable, or in a function that it is given to."""
    if system.workspace is None:
        return False
    for place in places:
        text = system.workspace.text(place.path)
        statement = _statement(text, place)
        if _STRIPS.search(statement):
            return True
        read = {word for word in _WORD.findall(_TEXTS.sub(" ", statement)) if word not in _NOT_ITS_OWN}
        if any(found[1] in read for found in _STRIPPED.finditer(text)):
            return True
        called = {word for word in _CALLED.findall(statement) if word not in _NOT_ITS_OWN}
        if called and any(
            _strips(file.path, system, called) for file in system.workspace.files if file.language in _CODE
        ):
            return True
    return False


def _statement(text: str, place: Location) -> str:
    """The statement of C++ at a place, or the lines of Python to the last bracket."""
    lines = text.split("\n")
    first = (place.line or 1) - 1
    if place.path.endswith(".py"):
        end = first + 1
        while end < min(len(lines), first + 10) and _is_open("\n".join(lines[first:end])):
            end += 1
        return "\n".join(lines[first:end])
    before = "\n".join(lines[max(0, first - 5) : first])
    after = "\n".join(lines[first : first + 10])
    return re.split(r"[;{}]", before)[-1] + "\n" + after.partition(";")[0]


def _is_open(text: str) -> bool:
    return sum(map(text.count, "([{")) > sum(map(text.count, ")]}"))


def _strips(path: str, system: System, names: set[str]) -> bool:
    """Whether a function of *names* that the file defines takes a slash off."""
    text = system.workspace.text(path) if system.workspace is not None else ""
    for found in _DEFINED.finditer(text):
        if found[1] in names and _STRIPS.search(text, found.end(), found.end() + _BODY):
            return True
    return False


def _owner(name: str, system: System) -> SystemNode | None:
    """The ROS 2 node that a parameter is set for, if it is there and tells nothing of its own parameters."""
    full = name.partition(":")[0]
    nodes = (node for node in system.nodes if node.ros == 2 and node.name == full)
    return next((node for node in nodes if not node.complete and node.package != _BROADCASTERS), None)


def _is_frame(value: object) -> bool:
    return isinstance(value, str) and _FRAME.fullmatch(value) is not None


def _broadcasters(system: System) -> Iterator[Finding]:
    frames = [parameter for parameter in system.parameters if _is_named(parameter.name) and _is_frame(parameter.value)]
    for node in system.nodes:
        if node.package != _BROADCASTERS:
            continue
        words = [word for word in re.split(r"[\s=]+", node.raw.arguments) if _is_frame(word)]
        words += [str(frame.value) for frame in frames if frame.name.startswith(f"{node.name}:")]
        if words:
            yield Finding(
                at=node.location,
                message=_stripped(words[0]),
                about=(node,),
                level=Level.NOTE,
            )


def _code(system: System) -> Iterator[Finding]:
    if system.workspace is None:
        return
    owners = {node.package: node for node in reversed(system.nodes) if node.package in system.packages}
    used = {name for name, node in owners.items() if _needs_tf2(name, node.ros, system)}
    for file in system.workspace.files if used else ():
        if file.package not in used or file.language not in ("cpp", "python"):
            continue
        key = (file.path, file.digest)
        if key not in _seen:
            _seen[key] = tuple(frames_in(file.path, system.workspace.text(file.path)))
        if not _seen[key]:
            continue
        package = file.package or ""
        runner = _runs(file.path, package, system)
        if runner is None and any(
            _runs(file.path, package, other_system) is not None for other_system in system.whole.systems
        ):
            continue  # reported for a system that runs the file
        yield from _of_file(_seen[key], runner or owners[package], runner or package, system)


def _of_file(uses: Sequence[FrameUse], node: SystemNode, about: SystemNode | str, system: System) -> Iterator[Finding]:
    """What there is to say of the *uses* in one file of the package of *node*."""
    sent: list[FrameUse] = []
    is_asked = node.ros == 1 and any(use.asked for use in uses)
    of_tf = listeners_of_tf(node.package, system) if is_asked else frozenset()
    for use in uses:
        if use.kind == "look-up" and use.asked in of_tf:
            continue  # tf::Transformer takes the slash off
        if use.kind == "marker" and node.ros == 1:
            yield _marker(use, about)
        elif use.kind in ("look-up", "message"):
            yield _finding(use.place, use.frame, f"a {use.kind}", about)
        elif use.kind == "transform":
            sent.append(use)
    if sent:
        yield Finding(
            at=sent[0].place,
            message=_stripped(*dict.fromkeys(use.frame for use in sent)),
            about=(node.package, *sorted({use.frame for use in sent})),
            related=tuple((use.place, f"{use.frame}, too") for use in sent[1:]),
            level=Level.NOTE,
        )


def _runs(path: str, package: str, system: System) -> SystemNode | None:
    """A node of the *package* that runs the file: an end of it is made there, or its program is called like the file."""
    nodes = [node for node in system.nodes if node.package == package]
    stem = path.rpartition("/")[2].partition(".")[0]
    makes = (node for node in nodes if any(end.in_source and end.location.path == path for end in node.ends))
    return next(makes, None) or next((node for node in nodes if node.raw.type.partition(".")[0] == stem), None)


def _needs_tf2(package: str, ros: int, system: System) -> bool:
    needs = {dependency.name for dependency in system.packages[package].dependencies}
    return _uses_tf2(package, ros, system) and any(name.startswith("tf2") for name in needs)


def _marker(use: FrameUse, node: SystemNode | str) -> Finding:
    return Finding(
        at=use.place,
        message=f"frame {use.frame} of a marker has a leading slash: rviz of Noetic looks it up by tf2, which has no such frame; write "
        f"{use.frame.lstrip('/')}",
        about=(node, use.frame),
        level=Level.NOTE,
    )


def _stripped(*frames: str) -> str:
    """What is to be said of frames that a broadcaster sends."""
    names = ", ".join(frames)
    plain = ", ".join(f'"{frame.lstrip("/")}"' for frame in frames)
    return f"frame {names} of a transform that is sent: tf2 strips the leading slash; write {plain}"


def _finding(place: Location, frame: str, where: str, node: SystemNode | str) -> Finding:
    return Finding(
        at=place,
        message=f"frame {frame} of {where} has a leading slash: tf2 has no such frame, so the look-up fails; write "
        f"{frame.lstrip('/')}",
        about=(node, frame),
    )


CHECK = Check(
    id="frame-leading-slash",
    summary="Frame id with a leading slash.",
    level=Level.WARNING,
    decidability=Decidability.HEURISTIC,
    catalogue="N03",
    tags=("tf", "parameters"),
    run=check,
)
