# SPDX-License-Identifier: Apache-2.0
"""Parameters that a node reads under one name and that are given under another, which is nearly the same."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping

from haros_ci.api import Check, End, Finding, Level, Location, Parameter, System, SystemNode, is_moved, is_slip, regex

#: Names that a message lists.
_SHOWN = 5
#: What gets the namespace of a node or handle in C++, and a variable that takes it.
_NAMESPACE = regex(r"(?:\b(\w+)\s*(?:=|\{|\()[^;={}\n]{0,200})?\bgetNamespace\s*\(\s*\)(\s*\.\s*(?:substr|erase)\b)?")


def check(system: System) -> Iterator[Finding]:
    reads = [end for end in system.ends if end.kind in ("getters", "setters") and end.node.ros == 1]
    vague = sorted({".*".join(map(re.escape, end.name.split("?"))) for end in reads if "?" in end.name})
    perhaps = re.compile("|".join(vague)) if vague else None
    parameters = [
        parameter for parameter in system.parameters if "?" not in parameter.name and ":" not in parameter.name
    ]
    named = {part for end in reads for part in _around(end.name)}
    read = {end.name for end in reads}
    used = {part for parameter in parameters for part in _around(parameter.name)}
    names = {parameter.name for parameter in parameters}
    sure = _Sure(system)
    unread = [
        parameter
        for parameter in parameters
        if parameter.name not in named
        and not any(part in read for part in _around(parameter.name))
        and not (perhaps is not None and perhaps.fullmatch(parameter.name))
        and sure.of(parameter)
    ]
    by_last: dict[str, list[Parameter]] = {}
    for parameter in unread:
        by_last.setdefault(parameter.name.rpartition("/")[0], []).append(parameter)
    moved: dict[tuple[SystemNode, str], list[tuple[End, Parameter, Location]]] = {}
    for end in _missing(reads, used, names):
        if _is_of_stripped_namespace(end, system):
            continue
        for parameter in _meant(end, by_last, unread):
            at = parameter.origin or parameter.location
            if at is not None and end.name.rpartition("/")[2] == parameter.name.rpartition("/")[2]:
                moved.setdefault((end.node, at.path), []).append((end, parameter, at))
            elif at is not None:
                yield _finding(end, parameter, at)
    for group in moved.values():  # the same slip with the namespace for all parameters of a <node>
        yield _finding(*group[0], tuple(group[1:]))


def _missing(reads: list[End], used: set[str], names: set[str]) -> Iterator[End]:
    """What is read and not given, neither itself nor a part of it nor what it is a part of."""
    written = {end.name for end in reads if end.kind == "setters"}
    for end in reads:
        above = set(_around(end.name))
        if end.kind == "getters" and end.known and end.name not in used and not above & names and not above & written:
            yield end


def _is_of_stripped_namespace(end: End, system: System) -> bool:
    """Whether the file cuts something off what getNamespace() gives, which begins with two slashes in old versions of roscpp."""
    if system.workspace is None or end.location.path.endswith(".py"):
        return False
    text = system.workspace.text(end.location.path)
    found = list(_NAMESPACE.finditer(text)) if "getNamespace" in text else []
    if any(match[2] for match in found):
        return True
    names = "|".join(sorted({match[1] for match in found if match[1]}))
    cut = rf"\b(?:{names})\s*\.\s*(?:substr|erase|replace)\b|\btrim\w*\s*\(\s*(?:{names})\b|\b(?:{names})\s*\.\s*(?:begin|cbegin)\s*\(\s*\)\s*\+"
    return bool(names) and re.search(cut, text) is not None


def _meant(end: End, spaces: Mapping[str, list[Parameter]], unread: list[Parameter]) -> Iterator[Parameter]:
    space, _, last = end.name.rpartition("/")
    for parameter in spaces.get(space, ()):
        if is_slip(last, parameter.name.rpartition("/")[2]):
            yield parameter
    for parameter in unread:
        own = f"{end.node.name}/"
        is_own = end.name.startswith(own) != parameter.name.startswith(own)
        if is_own and parameter.name.rpartition("/")[2] == last and is_moved(end.name, parameter.name):
            yield parameter


def _finding(
    end: End, parameter: Parameter, at: Location, others: tuple[tuple[End, Parameter, Location], ...] = ()
) -> Finding:
    """The finding; *others* are parameters that are given in the same file with the same slip."""
    names = [name for name in dict.fromkeys(other.name for other, _, _ in others) if name != end.name]
    shown = ", ".join(names[:_SHOWN]) + (f" and {len(names) - _SHOWN} more" if len(names) > _SHOWN else "")
    likewise = f"; likewise {shown}" if names else ""
    return Finding(
        at=at,
        message=(
            f"{end.node} reads the parameter {end.name}, which is never set, while {parameter.name} is set, which no node "
            f"reads: the value has no effect; set {end.name} here{likewise}"
        ),
        about=(end, parameter.name, *names),
        apart=(parameter.name, *(other.name for _, other, _ in others)),
        related=(
            (end.location, f"{end.name} is read here"),
            *dict.fromkeys(
                (place, f"{other.name} is set here") for _, other, place in others if other is not parameter
            ),
        ),
    )


class _Sure:
    """Whether nobody can read a parameter who is not seen to: its node is complete, or for a shared one all are."""

    def __init__(self, system: System) -> None:
        self.nodes: dict[str, bool] = {}
        for node in system.nodes:
            whole = node.complete and node.known and all(end.known for end in node.of("getters"))
            self.nodes[node.name] = whole and self.nodes.get(node.name, True)
        self.all = all(self.nodes.values())

    def of(self, parameter: Parameter) -> bool:
        above = [part for part in _around(parameter.name) if part != parameter.name and part in self.nodes]
        return all(self.nodes[part] for part in above) if above else self.all


def _around(name: str) -> Iterator[str]:
    """The name itself and the namespaces that it is in."""
    while name:
        yield name
        name = name.rpartition("/")[0]


CHECK = Check(
    id="parameter-near-miss",
    summary="Misspelt parameter: set under one name, read under a similar one.",
    level=Level.WARNING,
    catalogue="P02",
    tags=("parameters",),
    run=check,
)
