# SPDX-License-Identifier: Apache-2.0
"""``haros-ci explain``: a rule on one screen, or its whole page."""

from __future__ import annotations

import os
import re
import sys
import textwrap
from collections.abc import Iterable, Iterator
from pathlib import Path

import click

from haros_ci.commands.common import Flags
from haros_ci.commands.rules import documented_rules
from haros_ci.errors import UserError
from haros_ci.regex import regex
from haros_ci.results.rule import Rule

#: The most lines of the short form, and the widest.
LINES, COLUMNS = 30, 100
#: The most lines of a paragraph in the short form.
PARAGRAPH = 5
#: How levels look on a terminal.
COLORS = {"error": "red", "warning": "yellow", "note": "cyan"}
_MARK = regex(r"\s*(?:#|//|<!--)\s*expect: [^\n]*?(?:-->)?\s*$")


def explain(name: str, flags: Flags) -> int:
    """``haros-ci explain RULE``: what the rule says, why it matters, how to mend and how to silence it."""
    found = rules_named(name, list(documented_rules(flags)))
    color = sys.stdout.isatty() and "NO_COLOR" not in os.environ
    if flags.get("full"):
        text = "\n".join(whole(tool, rule) for tool, rule in found)
    else:
        text = "\n".join(short(*found[0], others=[f"{tool}:{rule.id}" for tool, rule in found[1:]])) + "\n"
    click.echo(painted(text) if color else text, nl=False, color=color)
    return 0


def rules_named(name: str, known: list[tuple[str, Rule]]) -> list[tuple[str, Rule]]:
    """The rules of that id, alias or catalogue id with their tools; UserError, with the nearest names, if there is none."""
    names = [((r.id, f"{tool}:{r.id}", *r.aliases, *r.deprecated_ids), tool, r) for tool, r in known]
    found = [(tool, rule) for own, tool, rule in names if name in own]
    if not found:  # G06 and g06 are one
        expected = name.casefold()
        found = [(tool, rule) for own, tool, rule in names if expected in map(str.casefold, own)]
    if found:
        return found
    from difflib import get_close_matches

    from haros_ci.commands.limits import LIMITS

    if limits := [limit.rule for limit in LIMITS if limit.metric == expected.replace("_", "-")]:
        raise UserError(f"'{name}' is a metric, no rule", help=f"the rules on it: {', '.join(limits)}")
    near = get_close_matches(name, [word for own, _, _ in names for word in own], 3)
    raise UserError(
        f"unknown rule '{name}'", help=f"did you mean {' or '.join(near)}?" if near else "see haros-ci rules"
    )


# -- the whole page ----------------------------------------------------------------------------------------------


def whole(tool: str, rule: Rule) -> str:
    """Everything that is known of a rule: its page, what the tool itself says, an example, names and tags."""
    parts = [f"{tool}:{rule.id} ({rule.level.value})", rule.summary, _page(rule), _own_words(tool, rule)]
    pair = _pair(rule)
    if pair is not None:
        parts += [f"Bad:\n\n{pair[0]}", f"Good:\n\n{pair[1]}"]
    facts = [f"Profiles: {', '.join((*rule.profiles, 'all'))}"]
    facts += [f"Aliases: {', '.join(rule.aliases)}"] if rule.aliases else []
    facts += [f"Tags: {', '.join(rule.tags)}"] if rule.tags else []
    facts += [f"See: {rule.help_uri}"] if rule.help_uri else []
    return "\n\n".join(part for part in (*parts, "\n".join(facts)) if part) + "\n"


def _page(rule: Rule) -> str:
    return rule.help.removeprefix(f"# {rule.id}\n").removeprefix(f"**{rule.id}**: {rule.summary}").strip()


# -- one screen --------------------------------------------------------------------------------------------------


def short(tool: str, rule: Rule, others: Iterable[str] = ()) -> list[str]:
    """At most LINES lines: what, why and how to mend, one bad and one good example, how to silence, where there is more."""
    page = _page(rule)
    name = f"{tool}:{rule.id}"
    if "\n## " in f"\n{page}":
        paragraphs = [
            _labelled("What", _section(page, "What it finds")),
            _labelled("Why", _section(page, "Why it matters")),
        ]
        bad = _example(page, "Bad")
        good = _example(page, "Good", bad[0].rpartition(", ")[2])
        silence = _labelled("Silence", _how_to_silence(name, rule))
    else:
        advice, _, suppress = page.rpartition("*Suppress*")
        words = _own_words(tool, rule)
        label = "Why/fix" if has_reason(rule.id) else "Fix"  # a text of its own says both
        paragraphs = [_labelled("What", words.partition("\n\n## Preview")[0]), _labelled(label, advice)]
        pair = _pair(rule)
        bad, good = (("", pair[0]), ("", pair[1])) if pair is not None else (("", ""), ("", ""))
        silence = _labelled("Silence", suppress or _how_to_silence(name, rule))
    summary = "" if rule.summary.startswith("Finding of ") and paragraphs[0] else rule.summary
    head = [f"{name} ({rule.level.value})", *textwrap.wrap(summary, COLUMNS)]
    more = [f"Profiles: {', '.join((*rule.profiles, 'all'))}"]
    more += [f"Also: {', '.join(others)}"] if others else []
    more.append(f"More: haros-ci explain {name} --full")
    more += [f"See: {rule.help_uri}"] if rule.help_uri else []
    body = [line for paragraph in paragraphs if paragraph for line in ("", *paragraph)]
    room = LINES - len(head) - len(body) - len(silence) - len(more) - 2  # blank lines
    examples = list(_shown(bad, good, room))
    return [*head, *body, *examples, "", *silence, *more]


def _labelled(label: str, text: str) -> list[str]:
    """The first paragraph of *text* behind its label, PARAGRAPH lines at most."""
    parts = [part for part in re.split(r"\n\s*\n", text.strip()) if not part.startswith("#")]
    paragraph = " ".join(parts[: 2 if parts and parts[0].endswith(":") else 1])
    plain = re.sub(r"\[([^\]\n]{1,200})\]\([^()\n]{1,300}\)", r"\1", " ".join(paragraph.split()))
    if not plain:
        return []
    whole_words = f"{label + ':':<9}{plain}".replace("haros: ignore", "haros:\0ignore")  # to be copied from one line
    lines = textwrap.wrap(whole_words, COLUMNS, subsequent_indent=" " * 9, break_on_hyphens=False)
    lines = [line.replace("\0", " ") for line in lines]
    return lines if len(lines) <= PARAGRAPH else _cut(lines[:PARAGRAPH])


def _cut(lines: list[str]) -> list[str]:
    """*lines* up to the last sentence, or part of one, that ends in them; if none does, dots say that it goes on."""
    ends = [(row, end.start()) for row, line in enumerate(lines) for end in re.finditer(r"[.;](?= |$)", line)]
    if not ends:
        return [*lines[:-1], f"{lines[-1][: COLUMNS - 4]} ..."]
    row, end = ends[-1]
    return [*lines[:row], f"{lines[row][:end]}."]


def _how_to_silence(name: str, rule: Rule) -> str:
    return f"haros: ignore[{rule.id}] reason, in a comment on the line; for a run, --ignore {name}"


def _section(page: str, title: str) -> str:
    found = re.search(rf"^## {title}\n(.*?)(?=^## |\Z)", page, re.M | re.S)
    return found[1] if found else ""


def _example(page: str, title: str, like: str = "") -> tuple[str, str]:
    """A file of the section's examples, with its names: the first with a mark, or the first that ends as *like* does, else the first."""
    section = _section(page, title)
    files = [
        (", ".join(filter(None, (heading, name))), code)
        for heading, example in re.findall(r"^(?:### )?([^\n]*)\n(.*?)(?=^### |\Z)", section, re.M | re.S)
        for name, code in re.findall(r"^```\w* title=\"([^\"\n]*)\"\n(.*?)^```$", example, re.M | re.S)
        if code.strip()
    ]
    ending = like.rpartition(".")[2]
    fitting = (file for file in files if "expect: " in file[1] or (ending and file[0].endswith(f".{ending}")))
    return next(fitting, files[0] if files else ("", ""))


def has_reason(rule: str) -> bool:
    """Whether the rule of a linter has a text of its own, rather than the advice of its group."""
    from haros_ci.linters.catalogue.clang_tidy_texts import TEXTS
    from haros_ci.linters.catalogue.reasons import BY_RULE

    return rule in BY_RULE or rule in TEXTS


def _pair(rule: Rule) -> tuple[str, str] | None:
    from haros_ci.linters.catalogue.examples import BY_RULE

    pair = BY_RULE.get(rule.id)
    return None if pair is None else (pair.bad, pair.good)


def _shown(bad: tuple[str, str], good: tuple[str, str], room: int) -> Iterator[str]:
    """Both examples, so that they have *room* lines at most; the good one from where it is most like the marked line."""
    examples = [(label, title, code) for label, (title, code) in (("Bad", bad), ("Good", good)) if code.strip()]
    marked = next((line for line in bad[1].splitlines() if "expect: " in line), "")
    for label, title, code in examples:
        yield ""
        yield f"{label}: {title}".rstrip(": ") + ":"
        yield from (f"  {line}"[:COLUMNS].rstrip() for line in _around(marked, code, room // len(examples) - 2))


def _around(marked: str, code: str, most: int) -> list[str]:
    """*most* lines of *code* around the line that is most like *marked*."""
    from difflib import SequenceMatcher

    lines = code.strip("\n").splitlines()
    if len(lines) > most:
        likeness = [SequenceMatcher(None, line, marked).ratio() for line in lines] if marked else [0.0]
        at = likeness.index(max(likeness))
        start = max(0, min(at - most // 2, len(lines) - most))
        lines = lines[start : start + most]
    return [_MARK.sub("  <-- here", line) for line in lines]


def _own_words(tool: str, rule: Rule) -> str:
    from haros_ci.linters.own_words import own_words

    return own_words(tool, rule.id, Path.cwd())


# -- on a terminal -----------------------------------------------------------------------------------------------


def painted(text: str) -> str:
    """Heads and labels bold, the level in its color."""
    text = re.sub(
        r"^(\S+) \((error|warning|note)\)$",
        lambda m: f"{click.style(m[1], bold=True)} ({click.style(m[2], fg=COLORS[m[2]])})",
        text,
        flags=re.M,
    )
    label = r"^(What|Why|Why/fix|Fix|Bad|Good|Silence|Profiles|Also|More|See|Tags|Aliases)(?=:)"
    text = re.sub(label, lambda m: click.style(m[1], bold=True), text, flags=re.M)
    return re.sub(r"^#{1,3} .*$", lambda m: click.style(m[0], bold=True), text, flags=re.M)
