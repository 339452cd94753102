# SPDX-License-Identifier: Apache-2.0
"""``haros-ci rules`` and ``haros-ci explain``: what is documented of every rule, as lists, as tables and as text."""

from __future__ import annotations

import json
from collections.abc import Iterator
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
    """``haros-ci rules``: every documented rule, marked when the profile turns it on."""
    profile = flags["profile"]
    if profile not in PROFILES:
        raise UserError(f"unknown profile '{profile}'", help=f"one of {', '.join(PROFILES)}")
    rows = [
        {
            "id": f"{tool}:{rule.id}",
            "level": rule.level.value,
            "enabled": profile == "all" or profile in rule.profiles,
            "summary": rule.summary,
            "aliases": list(rule.aliases),
            "catalogue": rule.catalogue or None,
            "tags": list(rule.tags),
        }
        for tool, rule in documented_rules(flags)
    ]
    if flags["as_json"]:
        click.echo(json.dumps(rows, indent=1, ensure_ascii=False))
        return 0
    for row in rows:
        click.echo(f"{'+' if row['enabled'] else ' '} {row['level']:<8} {row['id']:<48} {row['summary']}")
    return 0


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


def explain(name: str, flags: Flags) -> int:
    """``haros-ci explain RULE``: what the rule says, why it matters, how to turn it off."""
    known = list(documented_rules(flags))
    names = [((r.id, f"{tool}:{r.id}", *r.aliases, *r.deprecated_ids), tool, r) for tool, r in known]
    found = [(tool, rule) for own, tool, rule in names if name in own]
    if not found:  # G06 and g06 are one
        expected = name.casefold()
        found = [(tool, rule) for own, tool, rule in names if expected in map(str.casefold, own)]
    if not found:
        from difflib import get_close_matches

        from haros_ci.commands.limits import LIMITS

        if limits := [limit.rule for limit in LIMITS if limit.metric == expected.replace("_", "-")]:
            raise UserError(f"'{name}' is a metric, no rule", help=f"the rules on it: {', '.join(limits)}")
        near = get_close_matches(name, [word for own, _, _ in names for word in own], 3)
        raise UserError(
            f"unknown rule '{name}'", help=f"did you mean {' or '.join(near)}?" if near else "see haros-ci rules"
        )
    for tool, rule in found:
        on = ", ".join((*rule.profiles, "all"))
        lines = [
            f"{tool}:{rule.id} ({rule.level.value})",
            "",
            rule.summary,
            "",
            rule.help.removeprefix(f"# {rule.id}\n").removeprefix(f"**{rule.id}**: {rule.summary}").strip() or None,
            "" if rule.help else None,
        ]
        lines.append(f"Profiles: {on}")
        lines.append(f"Aliases: {', '.join(rule.aliases)}" if rule.aliases else None)
        lines.append(f"Tags: {', '.join(rule.tags)}" if rule.tags else None)
        lines.append(f"See: {rule.help_uri}" if rule.help_uri else None)
        click.echo("\n".join(line for line in lines if line is not None) + "\n")
    return 0
