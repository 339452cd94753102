# SPDX-License-Identifier: Apache-2.0
"""Parameters ``qos_overrides.<topic>.<end>.<policy>`` that override nothing, or that say what no policy can be."""

from __future__ import annotations

from collections.abc import Iterator

from haros_ci.api import Check, End, Finding, Given, Level, Location, System, SystemNode, alternatives, equally_near

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
    for parameters in _by_place(system).values():
        used = [parameter for parameter in parameters if _declares(parameter)]
        if used:
            yield from _value(used[0])
            continue
        findings = [
            _unused(parameter.node, parameter.key) if parameter.node.names.is_whole else None
            for parameter in parameters
        ]
        if all(findings) and not _is_used_elsewhere(system, parameters[0]):
            first, (text, end) = parameters[0], findings[0] or ("", None)
            yield Finding(
                at=first.at,
                message=f"the QoS override {first.key} of {first.node} has no effect: {text}",
                about=(first.node, first.key) if end is None else (first.node, end, first.key),
                related=((end.location, f"{end}"),) if end is not None else (),
                flow=((first.tag, f"{first.node} is given the parameters"), (first.at, "this one has no effect")),
            )


def _by_place(system: System) -> dict[tuple[Location, str], list[Given]]:
    """The overrides of *system*, those of one line together: it may go to several nodes, and is of use if one uses it."""
    found: dict[tuple[Location, str], list[Given]] = {}
    for parameter in system.given:
        if parameter.key.startswith(HEAD):
            found.setdefault(parameter.place, []).append(parameter)
    return found


def _declares(parameter: Given) -> bool:
    return parameter.key in parameter.node.names.declared


def _is_used_elsewhere(system: System, override: Given) -> bool:
    """Whether a node of another system uses what is said here."""
    return any(
        parameter.place == override.place and _declares(parameter)
        for other in system.whole.systems
        for parameter in other.given
    )


def _value(parameter: Given) -> Iterator[Finding]:
    policy = parameter.key.rpartition(".")[2]
    words = WORDS.get(policy)
    if words is not None and isinstance(parameter.value, str) and parameter.value not in words:
        yield Finding(
            at=parameter.at,
            message=(
                f"{parameter.node} stops with an exception: {policy} must be one of {', '.join(words)}, not "
                f"{parameter.value!r}{_like(parameter.value, words)}"
            ),
            about=(parameter.node, parameter.key),
            level=Level.ERROR,
        )


def _unused(node: SystemNode, key: str) -> tuple[str, End | None] | None:
    """Why *node* has no parameter *key*, with the end that it is about; None if that is not known for sure."""
    parts = key.removeprefix(HEAD).split(".")
    if len(parts) != 3:
        return f"its name does not have the form {HEAD}<topic>.<publisher or subscription>.<policy>", None
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
        return f"only {others[0]} can be overridden", alike[0]
    if any(unknown.field == "qos" for end in alike for unknown in end.raw.unknowns):
        return None
    return f"the {word} of {topic} is created without overriding options; pass QosOverridingOptions", alike[0]


def _other_topic(topic: str, ends: tuple[End, ...]) -> str:
    for end in ends:
        if end.original_name == topic:
            return f", which is remapped to {end.name}"
    names = sorted({end.name for end in ends})
    for name in names:
        if name.endswith(f"/{topic.strip('/')}"):
            return f", and the key must contain the full name {name}"
    return _like(topic, names)


def _like(word: str, words: tuple[str, ...] | list[str]) -> str:
    found = alternatives(equally_near(word, words))
    return f" (did you mean {found}?)" if found else ""


CHECK = Check(
    id="unused-qos-override",
    summary="Quality of service override that has no effect.",
    level=Level.WARNING,
    catalogue="Q10",
    tags=("topics", "qos", "parameters"),
    run=check,
)
