# SPDX-License-Identifier: Apache-2.0
"""Security policies of ROS 2 (SROS2) that forbid what a node does, or allow what it never does."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from functools import cache, partial

from haros_ci.api import Check, End, Finding, Level, Project, System, SystemNode
from haros_ci.api.security import NodeProfile, Permission, Policy, Rules, enclave_of, is_common, read_policy

#: What a node does that a rule is about, as an order.
DOES = {
    "publishers": "publishes",
    "subscribers": "subscribes to",
    "servers": "serves",
    "clients": "calls",
    "action_servers": "serves the action",
    "action_clients": "calls the action",
}


def check(project: Project) -> Iterator[Finding]:
    policies = tuple(_policies(project))
    if not policies:
        return
    running: dict[str, list[tuple[System, SystemNode]]] = {}
    for system in project.systems:
        for node in system.nodes:
            if node.ros == 2 and node.known and node.kind != "library":
                running.setdefault(node.name, []).append((system, node))
    for policy in policies:
        rules = cache(partial(_rules, policy))
        for name in dict.fromkeys(profile.node for profile in policy.profiles):
            nodes = _governed(project, policy, running.get(name, []))
            if nodes:
                yield from _forbidden(policy, name, nodes, rules)
                yield from _unused(policy, name, nodes)


def _rules(policy: Policy, enclave: str) -> Rules:
    return Rules(policy.rules(enclave))


def _policies(project: Project) -> Iterator[Policy]:
    for path in sorted(project.workspace.names):
        if path.endswith(".xml") and "<enclaves" in project.text(path):
            policy = read_policy(path, project.element)
            if policy is not None:
                yield policy


def _governed(project: Project, policy: Policy, found: list[tuple[System, SystemNode]]) -> list[SystemNode]:
    """The nodes that the policy is about: its package has them, or starts them; outside of any package it is for all."""
    owners = [p for p in project.packages if p.path == "." or policy.path.startswith(f"{p.path}/")]
    if not owners:
        return [node for _, node in found]
    own = max(owners, key=lambda package: len(package.path)).name
    return [
        node for system, node in found if node.package == own or any(p.startswith(f"{own}/") for p in system.launch)
    ]


def _forbidden(policy: Policy, name: str, nodes: list[SystemNode], rules: Callable[[str], Rules]) -> Iterator[Finding]:
    """What is not allowed in any enclave that the node may be in."""
    reported: set[tuple[str, str]] = set()
    profiles = policy.of(name)
    for node in nodes:
        enclave = enclave_of(node.raw)
        enclaves = [enclave] if enclave is not None else list(dict.fromkeys(profile.enclave for profile in profiles))
        here = [profile for profile in profiles if profile.enclave in enclaves]
        if not here or not all(policy.is_told(enclave) and rules(enclave).is_whole for enclave in enclaves):
            continue
        for end in node.ends:
            if end.implicit or not end.known or end.kind not in DOES or (end.kind, end.name) in reported:
                continue
            verdicts = {rules(enclave).verdict(end.kind, end.name) for enclave in enclaves}
            if "allowed" not in verdicts:
                reported.add((end.kind, end.name))
                yield _refusal(policy, here[0], end, verdicts)


def _refusal(policy: Policy, profile: NodeProfile, end: End, verdicts: set[str]) -> Finding:
    effect = "denies this" if verdicts == {"denied"} else "does not allow it"
    return Finding(
        at=profile.location,
        message=f"{profile.node} {DOES[end.kind]} {end.name}, but the policy of its enclave {profile.enclave} {effect}: "
        f"with security enforced the node stops at this call; add {end.name} to its profile",
        about=(policy.path, profile.enclave, profile.node, end.kind, end.name),
        related=((end.location, str(end)),),
        apart=(end.kind, end.name),
    )


def _unused(policy: Policy, name: str, nodes: list[SystemNode]) -> Iterator[Finding]:
    """What the profile allows by name, and the node is known never to do."""
    if not all(node.complete and all(end.known for end in node.ends) for node in nodes):
        return
    used = {(end.kind, end.name) for node in nodes for end in node.ends}
    for profile in policy.of(name):
        for rule in profile.rules:
            if not rule.allows or rule.is_pattern or rule.is_included or _is_spare(rule, used):
                continue
            yield Finding(
                at=rule.location,
                message=f"the policy allows {name} to {_WORDS[rule.kind]} {rule.name}, which its code never does: an attacker in "
                "the node could use it; remove the permission",
                about=(policy.path, profile.enclave, name, rule.kind, rule.name, "unused"),
                level=Level.NOTE,
                apart=(rule.kind, rule.name),
            )


def _is_spare(rule: Permission, used: set[tuple[str, str]]) -> bool:
    """Whether the rule is used, is part of an action, or is about what every node has."""
    return (rule.kind, rule.name) in used or "/_action/" in rule.name or is_common(rule.kind, rule.name)


_WORDS = {
    "publishers": "publish",
    "subscribers": "subscribe to",
    "servers": "serve",
    "clients": "call",
    "action_servers": "serve the action",
    "action_clients": "call the action",
}

CHECK = Check(
    id="security-policy-mismatch",
    summary="Security policy that denies what a node does, or permits what it never does.",
    level=Level.WARNING,
    catalogue="S01",
    tags=("security",),
    project=check,
)
