# SPDX-License-Identifier: Apache-2.0
"""``haros-ci rules``: what is documented of every rule, as lists and as tables."""

from __future__ import annotations

import json
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path

import click

from haros_ci.commands.common import Flags, plugins_of
from haros_ci.config.settings import PROFILES
from haros_ci.errors import UserError
from haros_ci.results.rule import Rule


def documented_rules(flags: Flags) -> Iterator[tuple[str, Rule]]:
    """Every documented rule, those of plug-ins included, with its tool's name."""
    from haros_ci.config.load import load
    from haros_ci.registry import registry

    settings = load(Path.cwd(), isolated=True, command_line={"plugins": plugins_of(flags)})
    return registry(settings).documented_rules()


def rules(flags: Flags) -> int:
    """``haros-ci rules [FILTER]``: every documented rule that fits, marked when the profile turns it on."""
    profile = flags["profile"]
    if profile not in PROFILES:
        raise UserError(f"unknown profile '{profile}'", help=f"one of {', '.join(PROFILES)}")
    known = list(documented_rules(flags))
    tools = sorted({tool for tool, _ in known})
    unknown = [name for name in flags["tool"] if name not in tools]
    if unknown:
        raise UserError(f"unknown tool '{unknown[0]}'", help=f"one of {', '.join(tools)}")
    rows = [
        row_of(tool, rule, profile)
        for tool, rule in known
        if (not flags["tool"] or tool in flags["tool"]) and fits(flags["filter"], tool, rule)
    ]
    if flags["only_enabled"]:
        rows = [row for row in rows if row["enabled"]]
    click.echo(json.dumps(rows, indent=1, ensure_ascii=False) if flags["as_json"] else table(rows, profile))
    return 0


def row_of(tool: str, rule: Rule, profile: str) -> dict[str, object]:
    """What ``--json`` has of a rule; ``enabled`` is whether *profile* turns it on."""
    return {
        "id": f"{tool}:{rule.id}",
        "level": rule.level.value,
        "enabled": profile == "all" or profile in rule.profiles,
        "summary": rule.summary,
        "aliases": list(rule.aliases),
        "catalogue": rule.catalogue or None,
        "tags": list(rule.tags),
    }


def fits(pattern: str | None, tool: str, rule: Rule) -> bool:
    """Whether a rule is one that the FILTER means: a glob or a part of ``tool:id`` or of a name, a tag, or a part of the summary; case does not count."""
    if not pattern:
        return True
    expected = pattern.casefold()
    names = [name.casefold() for name in (f"{tool}:{rule.id}", rule.id, *rule.aliases)]
    if any(sign in expected for sign in "*?["):
        from fnmatch import fnmatchcase

        return any(fnmatchcase(name, expected) for name in names)
    return (
        any(expected in name for name in names)
        or expected in map(str.casefold, rule.tags)
        or expected in rule.summary.casefold()
    )


def table(rows: Sequence[Mapping[str, object]], profile: str) -> str:
    """Columns under a head, and how many there are."""
    width = min(56, max([len(str(row["id"])) for row in rows], default=0) or 4)
    lines = [f"{'on':<3}{'level':<9}{'rule':<{width}}  what it finds"] if rows else []
    lines += [
        f"{'+' if row['enabled'] else '':<3}{row['level']:<9}{row['id']:<{width}}  {row['summary']}" for row in rows
    ]
    enabled = sum(bool(row["enabled"]) for row in rows)
    return "\n".join([*lines, "", f"{len(rows)} rules, {enabled} of them on in the profile {profile}"]).lstrip("\n")


def standards_table() -> int:
    """``haros-ci rules --standards``: docs/standards.md."""
    from haros_ci.registry import built_in
    from haros_ci.report.standards_table import render

    click.echo(render(built_in().documented_rules()), nl=False)
    return 0


def check_table() -> int:
    """``haros-ci rules --checks``: docs/checks.md."""
    from haros_ci.registry import built_in
    from haros_ci.report.check_table import render

    click.echo(render(rule for _, rule in built_in().documented_rules() if "architecture" in rule.tags), nl=False)
    return 0
