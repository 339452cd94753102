# SPDX-License-Identifier: Apache-2.0
"""Remapping rules of a name that the node does not use."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field

from haros_ci.api import Check, End, Finding, Level, Location, RemapRule, System, SystemNode, is_slip, may_be

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


@dataclass(slots=True)
class _Used:
    """A rule as it stands in the launch file, with the nodes that have it."""

    rule: RemapRule
    nodes: list[tuple[SystemNode, RemapRule]] = field(default_factory=list)


def check(system: System) -> Iterator[Finding]:
    rules: dict[tuple[Location, str], _Used] = {}
    for node in system.nodes:
        for rule in node.raw.rules:
            rules.setdefault((rule.location, rule.source), _Used(rule)).nodes.append((node, rule))
    for used in rules.values():
        if all(_is_idle(node, rule) for node, rule in used.nodes):
            yield _finding(used)


def _is_idle(node: SystemNode, rule: RemapRule) -> bool:
    """Whether it is certain that the node has no name that the rule is for."""
    source = rule.source_name
    is_told = node.complete or (node.type in WELL_KNOWN and bool(node.ends))
    if source is None or source == rule.target_name or not is_told or not node.known or node.kind == "library":
        return False
    if source.rpartition("/")[2] in COMMON or not node.is_launched:
        return False
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


def _finding(used: _Used) -> Finding:
    node, rule = used.nodes[0]
    meant = _meant(node, rule)
    more = f" (and {len(used.nodes) - 1} more nodes have none either)" if len(used.nodes) > 1 else ""
    hint = ""
    if meant is not None:
        written = (
            f", written as {meant.raw.written} in the code"
            if meant.raw.written not in (None, meant.original_name)
            else ""
        )
        hint = f"; it has the {meant.word} {meant.original_name}{written}"
        if (meant.raw.written or "").startswith("/"):
            hint += ", a global name that relative rules do not match"
    return Finding(
        at=rule.location,
        message=(
            f"{node} has no topic or service {rule.source_name}{more}: the remapping of {rule.source} to "
            f"{rule.target} has no effect{hint}"
        ),
        about=(node, rule.source_name or rule.source),
        related=(
            (node.location, f"{node} is started here"),
            *(((meant.location, f"{meant.word} {meant.original_name}"),) if meant is not None else ()),
        ),
    )


def _meant(node: SystemNode, rule: RemapRule) -> End | None:
    """The end that the rule may have been meant for: of the same last part, or nearly."""
    ends = [end for end in node.ends if not end.implicit and end.kind not in (*PARAMETERS, "parameters")]
    last = (rule.source_name or "").rpartition("/")[2]
    for fits in (str.__eq__, is_slip):
        for end in ends:
            if fits(end.original_name.rpartition("/")[2], last):
                return end
    return None


CHECK = Check(
    id="ineffective-remap",
    summary="Remapping of a name that the node does not use.",
    level=Level.WARNING,
    catalogue="G05",
    tags=("remappings", "launch"),
    run=check,
)
