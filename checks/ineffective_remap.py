# SPDX-License-Identifier: Apache-2.0
"""Remapping rules of a name that the node does not use."""

from __future__ import annotations

from bisect import bisect_right
from collections.abc import Iterator
from itertools import accumulate

from haros_ci.api import (
    Check,
    End,
    Finding,
    Level,
    Location,
    RemapRule,
    System,
    SystemNode,
    dataclass,
    field,
    is_given_away,
    is_idle,
    is_slip,
    regex,
)

#: Parameters can be remapped in ROS 1 alone.
PARAMETERS = ("getters", "setters")


_NODE = regex(r"<(/?)node\b[^<>]*>")
_INCLUDE = regex(r"<include\b[^<>]*?\bfile\s*=\s*[\"']([^\"'<>]*)")
_FOUND = regex(r"\$\((?:find|find-pkg-share|dirname)\b\s*([\w-]*)\)")


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
    # rules of the same nodes for one name, and copies of a list of rules in one file, are one slip
    alike: dict[tuple[str, ...], list[_Used]] = {}
    texts: dict[str, _Text] = {}
    for used in rules.values():
        path = used.rule.location.path
        if path not in texts:
            texts[path] = _Text(system, path)
        if not texts[path].reaches_others(used.rule) and all(
            is_idle(node, rule) and not is_given_away(node, rule, system) for node, rule in used.nodes
        ):
            kinds = sorted({f"{node.package}/{node.type}" for node, _ in used.nodes})
            alike.setdefault((path, used.rule.source, *kinds), []).append(used)
    for group in alike.values():
        yield _finding(group)


def _finding(group: list[_Used]) -> Finding:
    """One finding at the first of the rules; the others are related places."""
    (node, rule), others = group[0].nodes[0], group[1:]
    meant = _meant(node, rule)
    nodes = {node.name: node for used in group for node, _ in used.nodes}
    more = f" (and {len(nodes) - 1} more nodes have none either)" if len(nodes) > 1 else ""
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
    else:
        hint = "; correct the name, or remove the remapping"
    return Finding(
        at=rule.location,
        message=(
            f"{node} has no topic or service {rule.source_name}{more}: the remapping of {rule.source} to "
            f"{rule.target} has no effect{hint}"
        ),
        about=(node, *(name for name in nodes if name != node.name), rule.source_name or rule.source),
        apart=(rule.source,),
        related=(
            *(
                (used.rule.location, f"remaps {used.rule.source} to {used.rule.target}, also without effect")
                for used in others
            ),
            (node.location, f"{node} is started here"),
            *(((meant.location, f"{meant.word} {meant.original_name}"),) if meant is not None else ()),
        ),
    )


class _Text:
    """The text of a launch file, in which all of its rules are looked up."""

    def __init__(self, system: System, path: str) -> None:
        text = system.workspace.text(path) if system.workspace is not None else ""
        self.lines = text.split("\n") if text.lstrip().startswith("<") else []
        self.starts = [0, *accumulate(len(line) + 1 for line in self.lines)]
        #: Where tags of nodes end, and whether one is open behind them.
        self.nodes = [(tag.end(), not tag[1] and not tag[0].endswith("/>")) for tag in _NODE.finditer(text)]
        here = {*system.packages}
        files = ((include.start(), include[1]) for include in _INCLUDE.finditer(text))
        #: Where the last file of another workspace is included.
        self.last = max(
            (at for at, file in files if not here.issuperset(filter(None, _FOUND.findall(file)))), default=-1
        )

    def reaches_others(self, rule: RemapRule) -> bool:
        """Whether the rule stands before a file of another workspace that is included in its scope: nodes there may use the name."""
        line = rule.location.line or 0
        if not 0 < line <= len(self.lines):
            return False
        before = bisect_right(self.nodes, (self.starts[line - 1] + (rule.location.column or 1) - 1, True))
        is_in_node = before > 0 and self.nodes[before - 1][1]
        return not is_in_node and self.last >= self.starts[line - 1]


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
