# SPDX-License-Identifier: Apache-2.0
"""Parameters in YAML and launch files that the node which gets them does not declare."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from haros_ci.api import Check, Finding, Given, Level, System, misplaced, near, taken


def check(system: System) -> Iterator[Finding]:
    used = taken(system) | system.whole.taken
    groups: dict[tuple[str, str, str], list[Given]] = {}
    for each in system.given:
        if each.place not in used and misplaced(each) is None:
            groups.setdefault((each.node.name, each.at.path, _section(each)), []).append(each)
    for (_, _, section), group in groups.items():
        lines = {each.place: each for each in group}
        if section and len(lines) > 1:
            yield _finding(min(group, key=lambda each: each.at.sort_key), section, [key for _, key in lines])
        else:
            for each in lines.values():
                yield _finding(each, "", [each.key])


def _section(given: Given) -> str:
    """What stands before the key of which no parameter of the node has anything; "" if there is none."""
    names = given.node.names
    known = [*names.declared, *names.set]
    parts = given.key.split(".")
    for count in range(1, len(parts)):
        head = ".".join(parts[:count])
        if not any(name.startswith(f"{head}.") for name in known):
            return head
    return ""


def _finding(given: Given, section: str, keys: Sequence[str]) -> Finding:
    node = given.node
    free = [name for name in node.names.declared if not any(each.key == name for each in node.given)]
    if section:
        what = f"is given {len(keys)} parameters below {section}, but {node.type} declares none there"
        meant = near(section, {head for name in free for head in _heads(name)})
    else:
        what = f"is given the parameter {given.key}, but {node.type} does not declare it"
        meant = near(given.key, free)
    told = f"{meant}." if section and meant else meant
    return Finding(
        at=given.at,
        message=f"{node} {what}: what is said here has no effect" + (f"; did you mean {told}?" if meant else ""),
        about=(node, section or given.key),
        flow=((given.tag, f"{node} is given the parameters"), (given.at, "this one is not declared")),
    )


def _heads(name: str) -> Iterator[str]:
    parts = name.split(".")
    for count in range(1, len(parts)):
        yield ".".join(parts[:count])


CHECK = Check(
    id="parameter-not-declared",
    summary="A node declares the parameters that it is given.",
    level=Level.WARNING,
    catalogue="P01",
    tags=("parameters",),
    run=check,
)
