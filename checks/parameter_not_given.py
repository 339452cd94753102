# SPDX-License-Identifier: Apache-2.0
"""Parameters that a node declares or reads without a value, and that nothing gives it: it throws, or ends, when it starts."""

from __future__ import annotations

import re
from collections.abc import Iterator

from haros_ci.api import Check, End, Finding, Level, System, SystemNode, near, regex, spelled_out

#: ``if (!node.getParam("x", x)) {`` …, and what ends the program in there. Of the text behind the call so much is looked at.
_FAILS = regex(
    r"\s*if\s*\(\s*(?:!\s*|false\s*==\s*)[\w.>\-()]{0,80}?(?:getParam|param::get)\s*\((?:[^;{}&]|&(?!&)){0,200}?\)\s*(?:==\s*false\s*)?\)\s*\{?"
)
_ENDS = regex(
    r"\bexit\s*\(|\bthrow\b|\bros::(?:requestS|s)hutdown\s*\(|\bROS_BREAK\b|\breturn\s+(?:-\s*1|1|EXIT_FAILURE)\s*;|\babort\s*\("
)
#: A read of another parameter.
_READS = regex(r"\b(?:getParam(?:Cached)?|param::\w+|param)\s*(?:<[^<>;]{0,80}>\s*)?\(")
_MAX_TEXT = 1_000
#: Files with commands that set parameters: documentation and scripts.
_PAGES = (".md", ".rst", ".txt", ".sh", ".bash", ".yml")


def check(system: System) -> Iterator[Finding]:
    yield from _declared(system)
    yield from _read(system)


def _declared(system: System) -> Iterator[Finding]:
    for node in system.nodes:
        missing = _lacking(node)
        if missing:
            keys = [key for key, _ in missing]
            end = missing[0][1]
            alike = _alike(system, node, missing)
            if any(
                other_node.is_default and (not node.is_default or _at(other_node) < _at(node)) for other_node in alike
            ):
                continue  # reported there
            files = _files(node)
            shared = f"set it in {files[0]}" if len(files) == 1 else "set it in one of the files that they share"
            where = shared if alike else "set it here"
            in_file = {parameter.key for parameter in node.given}
            meant = near(keys[0], [key for key in in_file if key not in node.names.declared])
            yield Finding(
                at=node.location,
                message=(
                    (
                        f"{node} does not get {_listed(keys)}, which {node.type} declares without a default: the node throws at "
                        f"start; {where}"
                    )
                    + (f"; {meant} is set, but not declared" if meant else "")
                ),
                about=(node, *(end for _, end in missing)),
                apart=tuple(keys),
                related=(
                    (end.location, f"{keys[0]} is declared without a default"),
                    *((other_node.location, f"{other_node} does not get it, either") for other_node in alike),
                ),
            )


def _lacking(node: SystemNode) -> list[tuple[str, End]]:
    """What a node of ROS 2 declares without a value and does not get."""
    if node.ros != 2 or not node.is_launched or not node.known or node.raw.conditions:
        return []
    keys = {parameter.key for parameter in node.given}
    return [
        (key, end)
        for key, ends in node.names.declared.items()
        for end in ends
        if key not in keys and _is_needed(end, key) and not node.names.set.get(key)
    ]


def _alike(system: System, node: SystemNode, missing: list[tuple[str, End]]) -> list[SystemNode]:
    """The nodes of other launch files, of the same class and with the same files of parameters, that lack the same: one file is to be mended."""
    found: dict[tuple[object, ...], SystemNode] = {}
    files, missing_here = _files(node), [(key, end.location) for key, end in missing]
    for other_system in system.whole.systems if files else ():
        for other in other_system.nodes:
            if _at(other) == _at(node) or _at(other) in found or other.location.path in other_system.refused:
                continue
            if _files(other) == files and [(key, end.location) for key, end in _lacking(other)] == missing_here:
                found[_at(other)] = other
    return [found[place] for place in sorted(found)]


def _at(node: SystemNode) -> tuple[object, ...]:
    return node.location.sort_key


def _files(node: SystemNode) -> list[str]:
    return sorted({parameter.at.path for parameter in node.given if parameter.at.path.endswith((".yaml", ".yml"))})


def _read(system: System) -> Iterator[Finding]:
    """Private parameters of ROS 1 nodes that no launch file which starts them sets."""
    for node in system.nodes:
        if node.ros != 1 or not node.is_launched or not node.known or node.raw.conditions or not node.is_default:
            continue
        begin = f"{node.name}/"
        missing: dict[str, End] = {}
        for end in node.of("getters"):
            key = end.name.removeprefix(begin)
            if not end.name.startswith(begin) or not end.known or key in missing or not _fails(system, end):
                continue
            if not _may_have(system, node, key):
                missing[key] = end
        if missing:
            keys = list(missing)
            end = missing[keys[0]]
            configured = [
                parameter.name.removeprefix(begin)
                for parameter in system.parameters
                if parameter.name.startswith(begin)
            ]
            meant = near(
                keys[0],
                [item for item in configured if item not in {e.name.removeprefix(begin) for e in node.ends}],
                dot="/",
            )
            effect = (
                "rospy raises KeyError there"
                if end.location.path.endswith(".py") or end.raw.is_strict
                else "the node ends there"
            )
            yield Finding(
                at=node.location,
                message=f"{node} does not get {_listed(keys, 'private parameter')}, which {node.type} reads without a default: {effect}; set it here"
                + (f"; {meant} is set, but not read" if meant else ""),
                about=(node, *missing.values()),
                related=((end.location, f"{keys[0]} is read without a default"),),
            )


def _fails(system: System, end: End) -> bool:
    """Whether the node cannot go on without the parameter that *end* reads."""
    if (
        end.conditions
        or end.raw.value is not None
        or not end.in_source
        or end.raw.unknowns
        and any(u.field == "name" for u in end.raw.unknowns)
    ):
        return False
    if system.workspace is None or end.location.line is None:
        return False
    lines = system.workspace.text(end.location.path).split("\n")
    at = end.location.line - 1
    if end.location.path.endswith(".py") or end.raw.is_strict:
        return end.raw.is_strict and not _is_tried(lines[: at + 1]) and not _is_chosen(lines[at : at + 2])
    return _ends_without("\n".join(lines[at : at + 21])[:_MAX_TEXT])


def _ends_without(text: str) -> bool:
    """Whether *text*, of C++, begins with a condition that asks for one parameter, and ends the program without it."""
    start = _FAILS.match(text)
    if start is None or _has_alternative(start[0]):
        return False
    body = text[start.end() :].partition("}" if start[0].endswith("{") else ";\n")[0]
    ending = _ENDS.search(f"{body};")
    return ending is not None and _READS.search(body, 0, ending.start()) is None


def _has_alternative(condition: str) -> bool:
    """Whether the program ends only if more is the case than that this parameter is not there, as where one of two names is enough."""
    return (
        "&&" in condition
        or re.search(r"\band\b", condition) is not None
        or (re.search(r"(?:!|==)\s*\(", condition) is not None and re.search(r"\|\||\bor\b", condition) is not None)
    )


def _is_tried(lines: list[str]) -> bool:
    """Whether the last of *lines*, of Python, stands in a ``try`` of its function, or of the module."""
    margin = len(lines[-1]) - len(lines[-1].lstrip()) if lines else 0
    for line in reversed(lines[:-1]):
        inner = line.lstrip()
        if inner and not inner.startswith("#") and len(line) - len(inner) < margin:
            if inner.startswith("try:"):
                return True
            if inner.startswith(("def ", "class ")):
                return False
            margin = len(line) - len(inner)
    return False


def _is_chosen(lines: list[str]) -> bool:
    """Whether the first of *lines*, of Python, may read what it reads as a part of ``… if … else …``, or behind an ``or`` or ``and``."""
    first, *rest = (line.partition("#")[0].strip() for line in lines)
    if re.search(r"\bif\b[^:]{0,300}\belse\b|^(?:if|else)\b[^:]*$|\b(?:or|and)\b.{0,300}\bget_param\w*\s*\(", first):
        return True
    return any(re.match(r"if\b[^:]*$", line) for line in rest)


def _may_have(system: System, node: SystemNode, key: str) -> bool:
    """Whether something may set the parameter: a launch file that starts a node of the type, another node, a command in the documentation."""
    for other_system in system.whole.systems:
        for other in other_system.nodes:
            if other.type == node.type and _may_be_set(other_system, other, key):
                return True
    last = key.rpartition("/")[2]
    return any(f"_{key}:=" in text or (last in text and "rosparam set" in text) for text in _pages(system))


def _may_be_set(system: System, node: SystemNode, key: str) -> bool:
    name = f"{node.name}/{key}"
    if "?" in node.name or f"_{key}:=" in node.raw.arguments or "?" in node.raw.arguments or "$(" in node.raw.arguments:
        return True
    for parameter in system.parameters:
        other_name = parameter.name
        if "?" in other_name:
            shape = ".*".join(map(re.escape, other_name.split("?")))
            begin = other_name.partition("?")[
                0
            ]  # of a file that is not known, in a namespace: that is read as a dictionary, too
            if re.fullmatch(shape, name) or name.startswith(begin) or begin.startswith(f"{name}/"):
                return True
        elif other_name == name or name.startswith(f"{other_name.rstrip('/')}/") or other_name.startswith(f"{name}/"):
            return True
    return any(end.name == name or "?" in end.name for end in system.ends if end.kind == "setters")


def _pages(system: System) -> Iterator[str]:
    if system.workspace is not None:
        for path in system.workspace.names:
            if path.lower().endswith(_PAGES):
                yield system.workspace.text(path)


def _is_needed(end: End, key: str) -> bool:
    raw = end.raw
    if not raw.is_strict or raw.unknowns or end.conditions or "?" in key or raw.is_dynamic or end.type is None:
        return False
    return raw.value is None and raw.effective is None


def _listed(keys: list[str], word: str = "parameter") -> str:
    return f"the {word}{'s' if len(keys) > 1 else ''} {spelled_out(keys)}"


CHECK = Check(
    id="parameter-not-given",
    summary="Parameter without a default that the launch file does not set.",
    level=Level.ERROR,
    tags=("parameters",),
    run=check,
)
