# SPDX-License-Identifier: Apache-2.0
"""What launch files and parameter files say: remapping rules, launch arguments, and the values of parameters."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from typing import Any

from haros_ci.changes.change import ADDED, CHANGED, REMOVED, Difference, shown
from haros_ci.changes.endpoints import Moved, NodePair
from haros_ci.changes.names import is_known, relative
from haros_ci.model.architecture import Architecture, Configuration, Node, Parameter, RemapRule
from haros_ci.model.launch_facts import ArgumentDeclaration
from haros_ci.model.location import Location
from haros_ci.records import dataclass

#: If at least so many values of one node come from another file now, they are reported as one change.
MANY = 5


@dataclass(frozen=True, slots=True)
class ParameterValue:
    """What a parameter file gives to the nodes that *pattern* matches. *text* is None where it is not known."""

    pattern: str
    name: str
    text: str | None
    location: Location


def compare_remaps(sides: NodePair) -> Iterator[Difference]:
    """The remapping rules of a node, as they are written."""
    base, head = _rules(sides.base), _rules(sides.head)
    for key in [key for key in (*base, *head) if key in base and key in head and base[key].target == head[key].target]:
        base.pop(key, None)
        head.pop(key, None)
    for key in dict.fromkeys((*base, *head)):
        old, new = base.get(key), head.get(key)
        rule = new or old
        assert rule is not None
        if not all(
            is_known(remap_rule.source + remap_rule.target) for remap_rule in (old, new) if remap_rule is not None
        ):
            continue
        action = CHANGED if old and new else ADDED if new else REMOVED
        yield sides.difference(
            "remapping",
            action,
            rule.source,
            aspect="target" if action == CHANGED else "",
            before=old.target if old else None,
            after=new.target if new else None,
            base=old.location if old else None,
            head=new.location if new else None,
        )


def _rules(node: Node) -> dict[tuple[str, str], RemapRule]:
    """By source, the first counts. Rules that set the node's own name (``__node``) are no remapping of a topic."""
    found: dict[tuple[str, str], RemapRule] = {}
    for rule in node.rules:
        if not rule.source.startswith("__"):
            source = rule.source_name or rule.source
            found.setdefault((relative(source, node.name), rule.node and relative(rule.node, node.name)), rule)
    return found


def compare_arguments(base: Architecture, head: Architecture, moved: Moved) -> Iterator[Difference]:
    """The arguments that launch files declare, and their defaults."""
    left = {(moved(path), name): fact for (path, name), fact in _arguments(base).items()}
    right = _arguments(head)
    files = {path for path, _ in left} & {path for path, _ in right}
    seen = _launched(base, moved), _launched(head, lambda path: path)
    for key in sorted({*left, *right}):
        old, new = left.get(key), right.get(key)
        if key[0] not in files and not (key[0] in seen[0] and key[0] in seen[1]):
            continue  # the file is read on one side alone
        if old and new and old.default == new.default:
            continue
        action = CHANGED if old and new else ADDED if new else REMOVED
        yield Difference(
            what="launch argument",
            action=action,
            name=key[1],
            aspect="default" if action == CHANGED else "",
            before=(old.default if old.default is not None else "required") if old else None,
            after=(new.default if new.default is not None else "required") if new else None,
            base=old.location if old else None,
            head=new.location if new else None,
            program=key[0],
        )


def _arguments(architecture: Architecture) -> dict[tuple[str, str], ArgumentDeclaration]:
    found: dict[tuple[str, str], ArgumentDeclaration] = {}
    for configuration in architecture.configurations:
        for fact in configuration.launch_facts:
            if isinstance(fact, ArgumentDeclaration):
                found.setdefault((fact.location.path, fact.name), fact)
    return found


def _launched(architecture: Architecture, moved: Moved) -> set[str]:
    """The files that launch facts stand in."""
    return {
        moved(fact.location.path)
        for configuration in architecture.configurations
        for fact in configuration.launch_facts
    }


def compare_values(
    base: Configuration, head: Configuration, renamed: Mapping[str, str], removed: frozenset[str], new: frozenset[str], moved: Moved
) -> Iterator[Difference]:  # fmt: skip
    """The values that nodes on both sides are given. *renamed* are new names of nodes, *removed* and *new* nodes of one side."""
    left = _given(base, renamed)
    right = _given(head, {})
    found: list[tuple[str, Difference, tuple[str, str]]] = []
    for key in sorted({*left, *right}):
        old, new_one = left.get(key), right.get(key)
        node = key[0]
        if node in removed or node in new or not is_known("".join(key)):
            continue
        if any(_is_unknown(parameter) for parameter in (old, new_one)):
            continue
        before = shown(old.value) if old else None
        after = shown(new_one.value) if new_one else None
        if before == after:
            continue
        action = CHANGED if old and new_one else ADDED if new_one else REMOVED
        places = _place(old), _place(new_one)
        difference = Difference(
            what="value", action=action, name=(new_one or old).name, aspect="given" if action == CHANGED else "",  # type: ignore[union-attr]  # one of the two is there
            before=before, after=after, node=node, configuration=head.name, base=places[0], head=places[1],
        )  # fmt: skip
        files = tuple(moved(p.path) if p is places[0] and p else p.path if p else "" for p in places)
        found.append((node, difference, (files[0], files[1])))
    groups: dict[tuple[str, tuple[str, str]], list[Difference]] = {}
    for node, difference, files in found:
        groups.setdefault((node, files), []).append(difference)
    for (node, files), group in groups.items():
        if (
            len(group) < MANY
            or files[0] == files[1]
            or any(difference.action == CHANGED for difference in group)
            and not all(files)
        ):
            yield from group
        else:
            yield _from_elsewhere(node, files, group, head.name)


def _from_elsewhere(node: str, files: tuple[str, str], group: list[Difference], configuration: str) -> Difference:
    old, new = files
    count = f"{len(group)} values"
    return Difference(
        what="value",
        action=CHANGED if old and new else ADDED if new else REMOVED,
        name=f"{node}:*",
        aspect="file",
        before=f"{count} from {old}" if old else None,
        after=f"{count} from {new}" if new else None,
        node=node,
        configuration=configuration,
        base=Location(old) if old else None,
        head=Location(new) if new else None,
        details=tuple(
            f"{difference.name}: {difference.before or '—'} → {difference.after or '—'}" for difference in group
        ),
    )


def _given(configuration: Configuration, renamed: Mapping[str, str]) -> dict[tuple[str, str], Parameter]:
    """By node and name within it, the last counts; ROS 1 has no nodes in parameter names."""
    found = {}
    for parameter in configuration.parameters:
        node, colon, name = parameter.name.partition(":")
        key = (renamed.get(node, node), name) if colon else ("", parameter.name)
        if not (colon and name == "use_sim_time"):
            found[key] = parameter
    return found


def _is_unknown(parameter: Parameter | None) -> bool:
    return parameter is not None and bool(parameter.unknowns)


def _place(parameter: Parameter | None) -> Location | None:
    return None if parameter is None else parameter.origin or parameter.location


def compare_files(
    base: Mapping[str, Iterable[ParameterValue]],
    head: Mapping[str, Iterable[ParameterValue]],
    moved: Moved,
    users: Mapping[str, int],
) -> Iterator[Difference]:
    """Parameter files on both sides; and new ones and removed ones, as one difference each. *users* are their configurations."""
    left = {moved(path): values for path, values in base.items()}
    for path in sorted({*left, *head}):
        if path not in left or path not in head:
            values = list(left.get(path, ())) or list(head.get(path, ()))
            if values:
                yield _file(ADDED if path in head else REMOVED, path, values)
            continue
        old, new = ({(v.pattern, v.name): v for v in side} for side in (left[path], head[path]))
        for key in sorted({*old, *new}):
            before, after = old.get(key), new.get(key)
            texts: list[Any] = [value.text for value in (before, after) if value is not None]
            if None in texts or (len(texts) == 2 and texts[0] == texts[1]):
                continue
            action = CHANGED if before and after else ADDED if after else REMOVED
            yield Difference(
                what="value",
                action=action,
                name=f"{key[0]}:{key[1]}",
                aspect="given" if action == CHANGED else "",
                before=before.text if before else None,
                after=after.text if after else None,
                program=path,
                base=before.location if before else None,
                head=after.location if after else None,
                details=(_read_in(users.get(path, 0)),),
            )


def _read_in(number: int) -> str:
    """Who is given what a parameter file says."""
    if not number:
        return "no launch file of the workspace is seen to give it to a node"
    return f"given to nodes in {number} configuration{'' if number == 1 else 's'}"


def _file(action: str, path: str, values: list[ParameterValue]) -> Difference:
    text = f"{len(values)} value{'' if len(values) == 1 else 's'}"
    nodes = sorted({value.pattern for value in values})
    return Difference(
        what="value",
        action=action,
        name=path,
        aspect="file",
        before=text if action == REMOVED else None,
        after=text if action == ADDED else None,
        base=Location(path) if action == REMOVED else None,
        head=Location(path) if action == ADDED else None,
        details=tuple(nodes),
    )
