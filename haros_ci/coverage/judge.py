# SPDX-License-Identifier: Apache-2.0
"""What the model says of each call site: an endpoint, no API call, code that nothing runs, or nothing."""

from __future__ import annotations

import re
from bisect import bisect_right
from collections.abc import Iterable, Iterator, Mapping

from haros_ci import syntax
from haros_ci.code import calls, classes, kinds
from haros_ci.code.body import Call as Called
from haros_ci.code.codebase import Codebase, Routine
from haros_ci.coverage.names import Names
from haros_ci.coverage.pieces import Piece, last_name
from haros_ci.coverage.search import TextCall
from haros_ci.index.index import Source
from haros_ci.records import dataclass, field
from haros_ci.regex import regex
from haros_ci.syntax import Type

#: Libraries without ROS: namespaces and modules whose methods are never calls of ROS.
_OTHERS = frozenset(
    "std boost YAML cv pcl Eigen mqtt zmq Json nlohmann rapidjson ompl fcl grpc sol websocketpp fmt tinyxml2 octomap "
    "paho redis asyncio aiohttp requests pika smbus serial numpy cv2 torch tensorflow yaml json websocket socketio flask "
    "tornado argparse subprocess threading queue kivy tkinter matplotlib".split()
)
#: Scopes of a file in which a name is looked up.
_MOST_SCOPES = 20
#: Library classes whose methods have such names, and make nothing in the node that calls them.
#: A loader of nodelets that is asked not to provide services (nodelet/loader.h).
_WITHOUT_SERVICES = regex(r"(?:nodelet::)?Loader\b[\w \t]{0,100}[({]\s*false\s*[)}]")
_QUIET = {
    "rclcpp::AsyncParametersClient": "it asks through the client's own services",
    "rclcpp::SyncParametersClient": "it asks through the client's own services",
    "rclcpp::Parameter": "a parameter's value",
    "dynamic_reconfigure::Config": "a message",
}


@dataclass(frozen=True, slots=True)
class TextSite:
    """A call of a file as text, at its place."""

    source: Source
    call: TextCall
    line: int
    column: int
    start_line: int
    start_column: int
    #: Of the bracket before its arguments: ``Name<T>`` and the variable may stand on two lines.
    opening_line: int


def found_in(code: Codebase, source: Source, text: str, names: Names, found: Iterable[TextCall]) -> Iterator[TextSite]:
    """The call sites of a file with *text*, of what ``calls_in`` has *found* in it."""
    lines = [0, *(match.end() for match in re.finditer(r"\n", text))]
    for call in found:
        if call.made and not _is_api_class(code, source, call, names):
            continue
        line, first = bisect_right(lines, call.offset), bisect_right(lines, call.start)
        column, start = call.offset - lines[line - 1] + 1, call.start - lines[first - 1] + 1
        yield TextSite(source, call, line, column, first, start, bisect_right(lines, call.opening))


def _scopes(code: Codebase, source: Source) -> list[str]:
    """The classes and namespaces that functions of a C++ file stand in: those in which a name is looked up."""
    key = ("scopes", source.path)
    if key not in code.kept:
        code.kept[key] = sorted({function.name.rpartition("::")[0] for function in source.program.functions})[
            :_MOST_SCOPES
        ]
    found: list[str] = code.kept[key]
    return found


def _is_api_class(code: Codebase, source: Source, call: TextCall, names: Names) -> bool:
    known = names.classes[call.name]
    if source.separator == ".":
        return classes.dotted_name(source, call.made).replace(".", "::") in known
    if call.made.removeprefix("::") in known:
        return True
    kind = Type(call.made)
    return any(classes.resolved(code, kind, scope, source).name in known for scope in _scopes(code, source))


@dataclass(slots=True)
class Syntax:
    """The calls of a file by where they begin, each with the routine that it stands in."""

    code: Codebase
    _files: dict[str, dict[tuple[int, int], list[tuple[Routine, Called]]]] = field(default_factory=dict)

    def of(self, found: TextSite) -> tuple[Routine, Called] | None:
        """The call that a site is in the program; None where no front end has it."""
        here = self.at(found.source.path, found.start_line, found.start_column)
        return next((item for item in here if last_name(item[1].name) == found.call.name), None)

    def at(self, path: str, line: int, column: int) -> list[tuple[Routine, Called]]:
        """The calls whose expressions begin at a place, the outer ones first."""
        if path not in self._files:
            table: dict[tuple[int, int], list[tuple[Routine, Called]]] = {}
            for routine in self.code.routines(path):
                for call in self.code.body(routine).calls:
                    table.setdefault((call.line, call.column), []).append((routine, call))
            self._files[path] = table
        return self._files[path].get((line, column), [])


@dataclass(slots=True)
class Places:
    """Where the model has endpoints and parameters, by file."""

    exact: frozenset[tuple[str, int, int]]
    lines: frozenset[tuple[str, int]]

    def has(self, found: TextSite) -> bool:
        """Whether one stands at the call: where its expression, its name or its arguments begin."""
        path = found.source.path
        if (path, found.start_line, found.start_column) in self.exact:
            return True
        return any((path, line) in self.lines for line in (found.line, found.start_line, found.opening_line))


def places_of(locations: Iterable[tuple[str, int, int]]) -> Places:
    """*locations* as they are looked up."""
    every = frozenset(locations)
    return Places(every, frozenset((path, line) for path, line, _ in every))


@dataclass(frozen=True, slots=True)
class Seen:
    """What the model has: *places*, *wrappers* (functions whose endpoints it has at the places where they are called), all *sites* by function."""

    places: Places
    wrappers: Mapping[Routine, str]
    sites: Mapping[Routine, tuple[TextSite, ...]]

    def lacks(self, code: Codebase, found: TextSite, target: Routine) -> bool:
        """Whether a call runs a function of the workspace that makes what the model does not have."""
        inner = [
            (site, routine)
            for routine, _ in calls.reached(code, target, depth=2)
            for site in self.sites.get(routine, ())
            if site is not found
        ]
        if inner and found.call.name in WRAPPERS and code.ros_of(found.source) == 2:
            return True  # the model would have at this place what the function makes
        return any(not self.places.has(match) and routine not in self.wrappers for match, routine in inner)


def by_routine(
    code: Codebase, sites: Iterable[tuple[TextSite, Piece | None]]
) -> Mapping[Routine, tuple[TextSite, ...]]:
    """The sites that stand in each function."""
    found: dict[Routine, list[TextSite]] = {}
    for site, piece in sites:
        routine = routine_of(code, site, piece)
        if routine is not None:
            found.setdefault(routine, []).append(site)
    return {routine: tuple(item) for routine, item in found.items()}


def routine_of(code: Codebase, site: TextSite, piece: Piece | None) -> Routine | None:
    """The function that a site stands in."""
    return code.routine(site.source, piece.function) if piece is not None and piece.function is not None else None


def other(code: Codebase, where: Syntax, found: TextSite, seen: Seen) -> tuple[str, str] | None:
    """Why a call is none of a ROS API, and of what it is one; None where that is not known."""
    if found.source.path in code.firmware:
        return "code of a microcontroller", ""
    if found.call.made:
        if _WITHOUT_SERVICES.match(code.text(found.source.path), found.call.start):
            return "a library call that makes nothing here", "nodelet::Loader: it provides no services"
        made = _class_here(code, found)
        return ("a class of the workspace", made) if made else None
    placed = where.of(found)
    if placed is None:
        return None
    routine, call = placed
    targets = calls.function_meant(code, routine, call.callee)
    if call.receiver is None and not routine.is_python and (not targets or code.ros_of(found.source) == 1):
        message = _is_of_no_node(code, routine, call.callee)
        if message:
            return message, ""
    if targets:
        if any(seen.lacks(code, found, target) for target in targets):
            return None
        return "a function of the workspace", f"{targets[0].title} at {targets[0].location}"
    return _of_library(code, routine, call.receiver)


def _of_library(code: Codebase, routine: Routine, receiver: syntax.Expression | None) -> tuple[str, str] | None:
    """Why a method of *receiver* is none of a ROS API: its class is of a library without ROS, or makes nothing here."""
    if isinstance(receiver, (syntax.This, type(None))):
        return None
    name = _receiver(code, routine, receiver)
    head = re.split(r"::|\.", name, maxsplit=1)[0]
    if name and (head in _OTHERS or re.fullmatch(r"Q[A-Z]\w+", head)):
        return "a function of a library without ROS", name
    if name in _QUIET:
        return "a library call that makes nothing here", f"{name}: {_QUIET[name]}"
    return None


def _is_of_no_node(code: Codebase, routine: Routine, callee: syntax.Expression) -> str:
    """Why a C++ function that is called by its name alone is no method of a node or node handle; "" where it may be one.

    Such a method is called by its name in a class that has it from a library; what has a namespace in front is a function.
    """
    if not isinstance(callee, syntax.Name) or last_name(callee.name) in FREE:
        return ""
    space = callee.name.removeprefix("::").rpartition("::")[0]
    if space:
        known = space.split("::")[0].startswith(ROS) or space in code.cpp.classes or space.startswith("this")
        return "" if known else "a function of a library that is not here"
    while routine.outer is not None:
        routine = routine.outer
    owner = routine.function.owner
    classes_here = code.cpp.classes.get(owner, ()) if owner else ()
    names = {name for class_ in classes_here for name in classes.base_names(code, class_)}
    if any(name.removeprefix("::") not in code.cpp.classes for name in names):
        return ""
    return "a function that is called without a node"


def _class_here(code: Codebase, found: TextSite) -> str:
    """The class of the workspace that is constructed, where it has the name of a library's; "" if it is the library's."""
    source, made = found.source, found.call.made
    every = _python_classes(code, source, made) if source.separator == "." else _cpp_classes(code, source, made)
    return f"{every[0][1].name} at {every[0][0].path}:{every[0][1].line}" if every else ""


def _python_classes(code: Codebase, source: Source, written: str) -> list[classes.Owner]:
    """The classes of the workspace that a name *written* in a Python file can mean."""
    name = classes.dotted_name(source, written)
    owner = classes.class_named(code, name, source)
    last = last_name(name)
    every = [owner] if owner is not None else []
    every += [(s, c) for s in code.sources if s.separator == "." for c in s.program.classes if c.name == last]
    root = name.partition(".")[0]
    return [
        definition for definition in every if definition[0].module.partition(".")[0] == root or definition[0] is source
    ]


def _cpp_classes(code: Codebase, source: Source, written: str) -> list[classes.Owner]:
    """The classes of the workspace that a name *written* in a C++ file can mean."""
    name = written.removeprefix("::")
    names = {classes.resolved(code, Type(name), scope, source).name for scope in _scopes(code, source)} | {name}
    return [class_ for one in sorted(names) for class_ in code.cpp.classes.get(one, ())]


def _receiver(code: Codebase, routine: Routine, receiver: syntax.Expression) -> str:
    name = kinds.type_name(code, routine, receiver)
    if not name and routine.is_python:
        name = kinds.dotted(code, routine, receiver)
        return name if "." in name or name in _OTHERS else ""
    return name


def wrapped(code: Codebase, where: Syntax, places: Places) -> Mapping[Routine, str]:
    """The functions of the workspace whose endpoints the model has at the places where they are called, with one such place."""
    found: dict[Routine, str] = {}
    done: set[Routine] = set()
    for path, line, column in sorted(places.exact):
        for routine, call in where.at(path, line, column):
            for target in calls.function_meant(code, routine, call.callee):
                if target in done or last_name(target.function.name) not in WRAPPERS:
                    continue
                done.add(target)
                for inner, _ in calls.reached(code, target, depth=3):
                    found.setdefault(inner, f"{path}:{line}:{column}")
    return found


#: How names of namespaces begin whose functions make endpoints, and functions that are no methods.
ROS = tuple(
    "ros rcl tf action message_filters image_transport point_cloud_transport nodelet dynamic_reconfigure nav2 autoware "
    "tier4 realtime_tools controller moveit rviz diagnostic".split()
)
FREE = frozenset(("create_server", "create_client", "create_timer", "create_subscription", "create_publisher"))
#: Names of functions that wrap an API.
WRAPPERS = frozenset(
    "create_publisher create_lifecycle_publisher create_subscription create_service create_client create_server "
    "create_generic_publisher create_generic_subscription create_generic_service create_generic_client "
    "create_action_server create_action_client declare_parameter declare_parameter_if_not_declared "
    "declare_or_get_parameter get_or_declare_parameter get_parameter get_parameter_or set_parameter "
    "declareParameter declare_param getParameter getParam get_param readParameter read_parameter".split()
)
