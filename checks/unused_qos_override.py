# SPDX-License-Identifier: Apache-2.0
"""Parameters ``qos_overrides.<topic>.<end>.<policy>`` that override nothing, or that say what no policy can be."""

from __future__ import annotations

from collections.abc import Iterator
from difflib import get_close_matches

from haros_ci.api import Check, End, Finding, Level, Location, Parameter, System, SystemNode

#: What the key says, and the ends that it is about (rclcpp/detail/qos_parameters.hpp, rclpy/qos_overriding_options.py).
KINDS = {"publisher": "publishers", "subscription": "subscribers"}
SLIPS = {"subscriber": "subscription", "sub": "subscription", "pub": "publisher"}
WORDS = {
    "reliability": ("reliable", "best_effort", "system_default", "best_available"),
    "durability": ("volatile", "transient_local", "system_default", "best_available"),
    "history": ("keep_last", "keep_all", "system_default"),
    "liveliness": ("automatic", "manual_by_topic", "system_default", "best_available"),
}
HEAD = "qos_overrides."


def check(system: System) -> Iterator[Finding]:
    given = [each for each in system.parameters if f":{HEAD}" in each.name and "?" not in each.name]
    if not given:
        return
    nodes: dict[str, list[SystemNode]] = {}
    for node in system.nodes:
        nodes.setdefault(node.name, []).append(node)
    by_line: dict[tuple[Location, str], list[tuple[Parameter, list[SystemNode]]]] = {}
    for each in given:
        name, _, key = each.name.partition(":")
        place = each.origin or each.location
        if place is not None:
            by_line.setdefault((place, key), []).append((each, nodes.get(name, [])))
    for (place, key), told in by_line.items():
        yield from _line(place, key, told)


def _line(place: Location, key: str, told: list[tuple[Parameter, list[SystemNode]]]) -> Iterator[Finding]:
    """What there is to say of one line, which may go to several nodes: it is of use if one of them uses it."""
    nodes = [node for _, some in told for node in some]
    for parameter, some in told:
        if any(_declares(node, key) for node in some):
            yield from _value(place, key, parameter, some[0])
            return
    if not nodes or any(not node.complete or not node.known or node.ros != 2 for node in nodes):
        return
    said = [_unused(node, key) for node in nodes]
    if all(said):
        text, end = said[0] or ("", None)
        yield Finding(
            at=place,
            message=f"the QoS override {key} of {nodes[0]} does nothing: {text}",
            about=(nodes[0], key) if end is None else (nodes[0], end, key),
            related=((end.location, f"{end}"),) if end is not None else (),
        )


def _declares(node: SystemNode, key: str) -> bool:
    return any(end.name == f"{node.name}:{key}" for end in node.of("parameters"))


def _value(place: Location, key: str, parameter: Parameter, node: SystemNode) -> Iterator[Finding]:
    policy = key.rpartition(".")[2]
    words = WORDS.get(policy)
    if words is not None and isinstance(parameter.value, str) and parameter.value not in words:
        yield Finding(
            at=place,
            message=(
                f"{node} stops with an exception: {policy} is one of {', '.join(words)}, "
                f"not {parameter.value!r}{_like(parameter.value, words)}"
            ),
            about=(node, key),
            level=Level.ERROR,
        )


def _unused(node: SystemNode, key: str) -> tuple[str, End | None] | None:
    """Why *node* has no parameter *key*, with the end that it is about; None if that is not known for sure."""
    parts = key.removeprefix(HEAD).split(".")
    if len(parts) != 3:
        return f"its name is not {HEAD}<topic>.<publisher or subscription>.<policy>", None
    topic, entity, policy = parts
    word, _, suffix = entity.partition("_")
    if word not in KINDS:
        return f"{entity} is neither publisher nor subscription{_like(SLIPS.get(word, word), tuple(KINDS))}", None
    ends = node.of(KINDS[word])
    alike = [end for end in ends if end.name == topic]
    if any(not end.known for end in ends) or any(end.implicit or not end.in_source for end in alike):
        return None
    if not alike:
        return f"{node} has no {word} of {topic}{_other_topic(topic, ends)}", None
    declared = [end.name.partition(f":{HEAD}{topic}.")[2] for end in node.of("parameters")]
    policies = sorted(name.partition(".")[2] for name in declared if name.startswith(f"{entity}."))
    if policies:
        return f"only {', '.join(policies)} may be overridden there{_like(policy, policies)}", alike[0]
    others = sorted({name.partition(".")[0] for name in declared if name.startswith(word)})
    if others:
        return f"it is {others[0]} that may be overridden", alike[0]
    if any(unknown.field == "qos" for end in alike for unknown in end.raw.unknowns):
        return None
    return f"the {word} of {topic} is made without overriding options; give it QosOverridingOptions", alike[0]


def _other_topic(topic: str, ends: tuple[End, ...]) -> str:
    for end in ends:
        if end.original_name == topic:
            return f", it is remapped to {end.name}"
    names = sorted({end.name for end in ends})
    for name in names:
        if name.endswith(f"/{topic.strip('/')}"):
            return f", the key needs the whole name, {name}"
    return _like(topic, names)


def _like(word: str, words: tuple[str, ...] | list[str]) -> str:
    found = get_close_matches(word, words, 1, 0.75)
    return f" (did you mean {found[0]})" if found else ""


CHECK = Check(
    id="unused-qos-override",
    summary="A parameter that overrides quality of service is one that its node has.",
    level=Level.WARNING,
    catalogue="Q10",
    tags=("topics", "qos", "parameters"),
    run=check,
)
