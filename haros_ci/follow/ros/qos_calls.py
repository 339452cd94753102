# SPDX-License-Identifier: Apache-2.0
"""The quality of service that a call gives, unless its arguments are of no overload that is known."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

from haros_ci.follow.ros.qos import UNKNOWN, Why, qos_of
from haros_ci.model.architecture import Qos
from haros_ci.values.abstract import NONE, Known, Library, Object, Pointer

if TYPE_CHECKING:
    from haros_ci.follow.ros.selectors import Applied
    from haros_ci.follow.walk import Walk
    from haros_ci.model.api import Entry

#: Why it is not known what a call gives.
NO_OPTIONS = (
    "the call has an argument that is no options of a publisher or subscription: which function it calls is not known"
)
TOO_MANY = "the call has more arguments than the function of rclpy"
NOT_GIVEN = "it is not given"
CHANGED = "the program changes the profile that everybody shares"
#: Positional arguments of methods of ``rclpy.node.Node``; all others are keywords.
MOST = {"publishers": 3, "subscribers": 4}


def of_call(applied: Applied, entry: Entry) -> tuple[Qos | None, Why | None]:
    """The quality of service of what *entry* makes, and why a part of it is not known; None where the row has none."""
    from haros_ci.follow.ros.selectors import value_at

    if "qos" not in entry.values:
        return None, None
    profile = value_at(applied, entry.values["qos"])
    why = _no_overload(applied, entry) or (NOT_GIVEN if profile is None else None)
    if why is None and isinstance(profile, Library) and _short(profile.name) in changed(applied.walk):
        why = CHANGED
    return qos_of(profile) if why is None and profile is not None else (UNKNOWN, (why or NOT_GIVEN, None))


def _no_overload(applied: Applied, entry: Entry) -> str | None:
    from haros_ci.follow.ros.selectors import value_of

    if applied.row.call.startswith("rclpy.node.Node."):
        positional = [argument for argument in applied.args if not argument.keyword]
        return TOO_MANY if len(positional) > MOST.get(entry.kind, len(positional)) else None
    options = value_of(applied, entry.values["options"]) if "options" in entry.values else None
    if isinstance(options, Pointer):
        options = options.cell.value
    if applied.frame.source.separator == "::" and (_is_other(options) or _has_flag(applied)):
        return NO_OPTIONS
    return None


def _has_flag(applied: Applied) -> bool:
    """Whether a function of rclcpp is given true or false, which none of them takes."""
    if not applied.row.call.startswith("rclcpp::") or "create_" not in applied.row.call:
        return False
    return any(isinstance(given.value, Known) and given.value.kind is bool for given in applied.args)


def _is_other(options: object) -> bool:
    """Whether an argument in the place of options is plain data, or a quality of service."""
    if isinstance(options, Known):
        return options != NONE and not issubclass(options.kind, (list, tuple, dict, str))
    if isinstance(options, (Library, Object)):
        return re.search(r"(?:^|::)rmw_qos_profile_|^rclcpp::\w*QoS$", options.name) is not None
    return False


def changed(walk: Walk) -> set[str]:
    """The profiles of rclpy of which the program has changed a policy, for all who use them from then on."""
    found: set[str] = walk.found.setdefault("profiles", set())
    return found


def change(walk: Walk, profile: Library) -> None:
    """A member of a library's object is assigned to; where that is a profile, it is another one now."""
    if walk.context.process is not None and "qos" in profile.name.lower():
        changed(walk).add(_short(profile.name))


def _short(name: str) -> str:
    return name.removesuffix(".value").rpartition(".")[2]
