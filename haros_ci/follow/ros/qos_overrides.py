# SPDX-License-Identifier: Apache-2.0
"""Quality of service that parameters may override: ``qos_overrides.<topic>.<publisher or subscription>[_<id>].<policy>``.

A publisher or subscription that is given overriding options declares these parameters, with its own policies as their
defaults, and has the policies that they hold then (rclcpp/detail/qos_parameters.hpp, rclpy/qos_overriding_options.py).
What such a parameter says of an end without these options changes nothing.
"""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

from haros_ci.follow.made import MadeEntity, make
from haros_ci.follow.ros.qos import DURATIONS, overridden, override_id, override_policies
from haros_ci.follow.ros.ros2_nodes import remapped
from haros_ci.graph.parameters import Perhaps
from haros_ci.model.architecture import Qos
from haros_ci.model.location import Location
from haros_ci.values.abstract import Known, Opaque, Value
from haros_ci.values.state import Held

if TYPE_CHECKING:
    from haros_ci.follow.ros.selectors import Applied
    from haros_ci.graph.ros2_process import RosNode

ENDS = {"publishers": "publisher", "subscribers": "subscription"}
#: The policies of each kind of end, in the order in which they are declared.
ALLOWED = {
    "publishers": ("deadline", "durability", "history", "depth", "lifespan", "liveliness", "lease", "reliability"),
    "subscribers": ("deadline", "durability", "history", "depth", "liveliness", "lease", "reliability"),
}
LEASE = "liveliness_lease_duration"
#: Policies that are asked for where it is not known which may be overridden.
USUAL = ("durability", "history", "depth", "reliability")
UNTOLD = "whether parameters may override it is not known"


def apply(
    applied: Applied, kind: str, node: RosNode, name: str, options: Value | None, qos: Qos, place: Location
) -> tuple[Qos, list[tuple[str, str, Location | None]]]:
    """*qos* of an end with the absolute *name* after overrides, and what is unknown of it; parameters are declared at *place*.

    A parameter that nothing seen sets counts as not set, also where a file is not seen.
    """
    policies, suffix = override_policies(options), override_id(options)
    if policies == () or "?" in name:
        return qos, []
    final = remapped(applied.walk, node.whole, name)
    if policies == () or "?" in final:
        return qos, []
    head = f"qos_overrides.{final}.{ENDS[kind]}"
    if policies is None or suffix is None:
        provided = tuple(policy for policy in USUAL if _current_value(applied, node, f"{head}.{policy}") is not None)
        blank = replace(qos, **dict.fromkeys(provided, "?"))
        return blank, [("qos", UNTOLD, applied.location)] if provided else []
    head += f"_{suffix}" if suffix else ""
    chosen = {"lease" if policy == LEASE else policy for policy in policies}
    unknowns: list[tuple[str, str, Location | None]] = []
    rules: dict[str, Value] = {}
    held: dict[str, Held] = {}
    for policy in ALLOWED[kind]:
        if policy in chosen:
            full = f"{head}.{LEASE if policy == 'lease' else policy}"
            default = _default(policy, getattr(qos, policy))
            value = _current_value(applied, node, full)
            if value is not None:
                rules[policy] = value
            held[f"{node.whole.name}:{full}"] = _declare(applied, node, full, policy, default, value, place)
    changed = overridden(qos, rules)
    for policy, value in rules.items():
        if getattr(changed, policy) == "?":
            why = value if isinstance(value, Opaque) else None
            reason = why.reason if why else f"a parameter overrides {policy} with what it cannot be"
            unknowns.append(("qos", reason, (why and why.location) or applied.location))
    own = applied.walk.declared.value
    if held and not isinstance(own, Opaque):
        applied.walk.state.write(applied.walk.declared, {**own, **held})
    return changed, unknowns


def _current_value(applied: Applied, node: RosNode, name: str) -> Value | None:
    """What the parameter has by now: what another end has declared it with, else what the node is given; None for nothing."""
    from haros_ci.follow.ros.ros2_parameters import parameter

    found = parameter(applied, node, name, is_declared=True)
    return None if isinstance(found, Perhaps) and name not in found.reason else found


def _default(policy: str, value: object) -> Value:
    """A policy as the parameter for it holds it: a word, a number of messages, nanoseconds."""
    if value == "?":
        return Opaque("the quality of service is not known")
    if policy in DURATIONS or policy == "depth":
        if not isinstance(value, (int, float)):
            return Opaque("the profile does not tell it")
        return Known(round(value * 1_000_000_000) if policy in DURATIONS else value)
    return Known("system_default" if value is None else value)


def _declare(
    applied: Applied, node: RosNode, name: str, policy: str, default: Value, value: Value | None, place: Location
) -> Held:
    walk = applied.walk
    unknowns: list[tuple[str, str, Location | None]] = []
    if isinstance(default, Opaque):
        unknowns.append(("value", default.reason, applied.location))
    if isinstance(effective := default if value is None else value, Opaque):
        unknowns.append(("effective", effective.reason, effective.location or applied.location))
    make(
        walk,
        MadeEntity(
            kind="parameters",
            name=f"{node.whole.name}:{name}",
            type="int" if policy in DURATIONS or policy == "depth" else "str",
            location=place,
            conditions=tuple(walk.conditions),
            value=default.value if isinstance(default, Known) else None,
            implicit=True,
            is_exact=applied.is_exact,
            unknowns=tuple(unknowns),
            node=node.whole,
            effective=effective.value if isinstance(effective, Known) else None,
            read_only=True,
        ),
    )
    return Held(effective)
