# SPDX-License-Identifier: Apache-2.0
"""The remapping rule that an end has its name from, where one goes to change the name, and rules that are for no name of a node."""

from __future__ import annotations

from haros_ci.checking.check import Place
from haros_ci.checking.likeness import may_be
from haros_ci.checking.system import End, SystemNode
from haros_ci.model.architecture import RemapRule
from haros_ci.model.location import Location

#: What libraries use inside nodes, seen or not.
COMMON = frozenset(
    {"tf", "tf_static", "clock", "rosout", "parameter_events", "diagnostics", "bond", "robot_description"}
)
#: Names that image_transport and point_cloud_transport put below the topic that a rule is for.
TRANSPORTS = frozenset({"compressed", "compressedDepth", "theora", "ffmpeg", "zstd", "zlib", "draco", "cloudini"})
#: Programs of which the names have been the same for years, so that the data on them can be taken for complete.
WELL_KNOWN = frozenset(
    {
        "robot_state_publisher/robot_state_publisher",
        "joint_state_publisher/joint_state_publisher",
        "joint_state_publisher_gui/joint_state_publisher_gui",
        "tf2_ros/static_transform_publisher",
    }
)
#: Parameters can be remapped in ROS 1 alone.
PARAMETERS = ("getters", "setters")


def rule_of(end: End) -> RemapRule | None:
    """The rule that renamed *end*; None if it has the name that its code gives it, or where the rule stands is not known."""
    if end.name == end.original_name:
        return None
    names = (end.original_name, end.name)
    return next((rule for rule in end.node.raw.rules if (rule.source_name, rule.target_name) == names), None)


def named_at(end: End) -> Location:
    """Where *end* gets its name: at the remapping rule if there is one, else at its call."""
    rule = rule_of(end)
    return end.location if rule is None else rule.location


def way_to(end: End) -> tuple[Place, ...]:
    """From the start of the node over the remapping rule to the call, as far as their places are known."""
    rule = rule_of(end)
    steps = [(end.node.location, f"{end.node} is started")] if end.node.is_launched else []
    if rule is not None:
        steps.append((rule.location, f"{end.original_name} is remapped to {end.name}"))
    if end.in_source:
        steps.append((end.location, f"{end.word} {end.original_name}"))
    return tuple(steps) if len(steps) > 1 else ()


def is_idle(node: SystemNode, rule: RemapRule) -> bool:
    """Whether it is certain that the node has no name that the rule is for (ineffective-remap)."""
    source = rule.source_name
    is_told = node.complete or (node.type in WELL_KNOWN and bool(node.ends))
    if source is None or source == rule.target_name or not is_told or not node.known or node.kind == "library":
        return False
    if source.rpartition("/")[2] in COMMON or not node.is_launched:
        return False
    if node.ros == 1 and (
        source == node.name or any(end.raw.original_name.startswith(f"{source}/") for end in node.ends)
    ):
        return False  # roscpp remaps the namespace of a node handle, too, by its whole name (``NodeHandle::construct``)
    if any(end.name == rule.target_name for end in node.ends):
        return False  # the code may have resolved the name itself, and used what came out
    return not any(_may_be(end, source) for end in node.ends)


def _may_be(end: End, source: str) -> bool:
    if end.kind in PARAMETERS and end.node.ros == 2:
        return False
    name = end.raw.original_name
    base, _, last = name.rpartition("/")
    if last in TRANSPORTS and base == source:
        return True
    below = ""
    while len(source) > 1:
        if may_be(name, source) and (not below or "?" in name or _is_below(end, below)):
            return True
        source, _, last = source.rpartition("/")
        below = f"{last}/{below}"
    return False


def _is_below(end: End, rest: str) -> bool:
    """Whether *end* may bring a name that goes on with *rest*: ``compressed/`` of an image, ``_action/send_goal/``, a parameter's parts."""
    if end.kind in ("publishers", "subscribers"):
        return rest.partition("/")[0] in TRANSPORTS or (end.node.ros == 1 and "image" in (end.type or "image").lower())
    return end.kind not in ("servers", "clients") or rest.startswith("_")
