# SPDX-License-Identifier: Apache-2.0
"""Parameters in YAML and launch files that the node which gets them does not declare."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from haros_ci.api import (
    Check,
    Finding,
    Given,
    Level,
    System,
    SystemNode,
    is_mentioned,
    is_read_besides,
    is_slip,
    misplaced,
    near,
)

#: So many parameters that several nodes of a launch file are given alike are one set for all of them.
_SET = 3


def check(system: System) -> Iterator[Finding]:
    groups: dict[tuple[str, str, str, str], list[Given]] = {}
    found = list(_undeclared(system))
    in_sets = _in_sets(system, [parameter for parameter, _ in found])
    for parameter, section in found:
        if id(parameter) in in_sets:
            continue
        name = "" if section else _meant(parameter) or (parameter.key if "." not in parameter.key else "")
        groups.setdefault(
            (parameter.node.name, parameter.at.path, section or parameter.key.rpartition(".")[0], name), []
        ).append(parameter)
    for (_, _, section, _), group in groups.items():
        lines = {parameter.place: parameter for parameter in group}
        keys = sorted({key for _, key in lines})
        yield _finding(
            min(group, key=lambda parameter: parameter.at.sort_key), section, keys, _declaring(system, group[0], keys)
        )


def _undeclared(system: System) -> Iterator[tuple[Given, str]]:
    """What nodes are given and do not declare, with the section of which nothing is declared."""
    for parameter in system.given:
        if (
            parameter.place not in system.taken
            and parameter.place not in system.whole.taken
            and misplaced(parameter) is None
        ):
            section = _section(parameter)
            is_spare = bool(section) and _is_spare(parameter.node, section)
            if not (
                is_spare
                or is_mentioned(system, parameter.node, section or parameter.key)
                or is_read_besides(system, parameter)
                or _is_shared(system, parameter)
            ):
                yield parameter, section


def _in_sets(system: System, undeclared: Sequence[Given]) -> set[int]:
    """Which of *undeclared* are of a set that a launch file gives to several nodes: three or more, each with the same value for a node that declares it."""
    by_node: dict[tuple[int, str], list[Given]] = {}
    for parameter in undeclared:
        if parameter.raw.origin is None:
            by_node.setdefault((id(parameter.node), parameter.at.path), []).append(parameter)
    taken = {
        (given.at.path, given.key, repr(given.value))
        for node in system.nodes
        for given in node.given
        if given.raw.origin is None and given.key in node.names.declared
    }
    found: set[int] = set()
    for (_, path), group in by_node.items():
        shared = [given for given in group if (path, given.key, repr(given.value)) in taken]
        if len({given.key for given in shared}) >= _SET:
            found.update(map(id, shared))
    return found


def _section(parameter: Given) -> str:
    """The section of the key in which the node declares nothing at all; "" if there is none."""
    parts = parameter.key.split(".")
    for count in range(1, len(parts)):
        head = ".".join(parts[:count])
        if head not in parameter.node.names.sections:
            return head
    return ""


def _is_spare(node: SystemNode, section: str) -> bool:
    """Whether values choose among sections, and this one is not chosen: ``plugins: [a]`` where ``b`` has parameters, too."""
    above, _, last = section.rpartition(".")
    found = {text for text in node.names.texts if (f"{above}.{text}" if above else text) in node.names.sections}
    return bool(found) and not any(is_slip(last, text) for text in found)


def _is_shared(system: System, parameter: Given) -> bool:
    """Whether one file is given to several nodes as a whole, and another one declares the key, which it is given a second time elsewhere.

    All that this node is given by the file the other one is given by it, too, but for what the tag of that one sets itself.
    """
    path, node = parameter.at.path, parameter.node
    if parameter.raw.origin is None:
        return False
    places = {given.place for given in node.given if given.at.path == path}
    for other in system.nodes:
        if other is node or parameter.key not in other.names.declared:
            continue
        theirs = {given.place for given in other.given if given.at.path == path}
        elsewhere = {given.key for given in other.given if given.at.path != path}
        if theirs and all(place in theirs or place[1] in elsewhere for place in places):
            return True
    return False


def _meant(parameter_given: Given) -> str:
    """A parameter of the node that nothing else gives, and that is called nearly the same."""
    own = {parameter.key for parameter in parameter_given.node.given}
    return near(parameter_given.key, [name for name in parameter_given.node.names.declared if name not in own]) or ""


def _declaring(system: System, parameter: Given, keys: Sequence[str]) -> str:
    """The one other node that declares all *keys*, which have words of their own (no ``rate``); "" if there is none, or several do."""
    if not all("_" in key for key in keys):
        return ""
    found = [
        node
        for node in system.nodes
        if node is not parameter.node and node.names.is_whole and all(key in node.names.declared for key in keys)
    ]
    return str(found[0]) if len(found) == 1 else ""


def _finding(parameter: Given, section: str, keys: Sequence[str], declaring: str) -> Finding:
    node = parameter.node
    meant = _meant(parameter) if len(keys) == 1 else ""
    if len(keys) == 1:
        what = f"is given the parameter {keys[0]}, but {node.type} does not declare it"
    else:
        names = ", ".join(key.removeprefix(f"{section}.") for key in keys[:4]) + (", …" if len(keys) > 4 else "")
        what = f"is given {len(keys)} parameters below {section} that {node.type} does not declare ({names})"
    return Finding(
        at=parameter.at,
        message=f"{node} {what}: the value has no effect"
        + (
            f"; did you mean {meant}?"
            if meant
            else f"; {declaring} declares {'it' if len(keys) == 1 else 'them'}: give {'it' if len(keys) == 1 else 'them'} to that node"
            if declaring
            else "; correct the name, or remove it"
        ),
        about=(node, section if len(keys) > 1 else keys[0]),
        flow=((parameter.tag, f"{node} is given the parameters"), (parameter.at, "this one is not declared")),
        presence=parameter.presence,
    )


CHECK = Check(
    id="parameter-not-declared",
    summary="Parameter set for a node that does not declare it.",
    level=Level.WARNING,
    catalogue="P01",
    tags=("parameters",),
    run=check,
)
