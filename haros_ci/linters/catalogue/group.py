# SPDX-License-Identifier: Apache-2.0
"""Groups of rules as the tables give them, and how a rule is made of a row."""

from __future__ import annotations

from collections.abc import Mapping

from haros_ci.linters.catalogue.reasons import BY_RULE
from haros_ci.records import dataclass
from haros_ci.results.rule import Level, Rule

#: What a row's second column stands for. Each letter enables the profiles after it too, so that
#: bugs-only ⊆ ros ⊆ strict holds by construction; ``-`` is only in ``all``, ``G`` (alone or after another) in
#: ``google``.
PROFILES: Mapping[str, tuple[str, ...]] = {
    "B": ("bugs-only", "ros", "strict"),
    "R": ("ros", "strict"),
    "S": ("strict",),
    "-": (),
}

MAX_TAGS = 10  # GitHub shows no more


@dataclass(frozen=True, slots=True)
class Group:
    """Rules that one piece of advice fits. *rows* are (id, profile letters, summary)."""

    advice: str
    tags: tuple[str, ...]
    rows: tuple[tuple[str, str, str], ...]
    level: Level | None = None
    precision: str = "high"


def profiles(letters: str) -> tuple[str, ...]:
    """The profiles that *letters* of a row stand for."""
    google = ("google",) if "G" in letters else ()
    return PROFILES[letters[0]] + google if letters[0] in PROFILES else google


def level_of(letters: str, usual: Level) -> Level:
    """What ``ros`` shows is at least a warning; beyond that the tool's own judgement stands."""
    return Level.WARNING if usual is Level.NOTE and letters[0] in "BR" else usual


def help_text(rule: str, summary: str, advice: str, suppress: str, tool: str = "") -> str:
    """The help of a rule as Markdown: what, why and how to fix, how to suppress, where CODE stands for the rule.

    Rules that are met often have an *advice* of their own instead of their group's. *tool* is named where a rule of another tool has the
    same id and finds something else.
    """
    advice = BY_RULE.get(f"{tool}:{rule}") or BY_RULE.get(rule, advice)
    parts = [f"**{rule}**: {summary}"]
    if advice:
        parts.append(advice)
    parts.append(
        f"*Suppress* one finding with {suppress.replace('CODE', rule)}, or `haros: ignore[{rule}] reason` in a comment."
    )
    return "\n\n".join(parts)


def tags_of(*tags: str) -> tuple[str, ...]:
    """*tags* once each, in order, as many as GitHub shows."""
    return tuple(dict.fromkeys(tags))[:MAX_TAGS]


def words(identifier: str) -> str:
    """A rule id as words: ``uninitMemberVar`` and ``uninit-member-var`` become ``uninit member var``."""
    spaced = "".join(f" {c.lower()}" if c.isupper() else c for c in identifier)
    return " ".join(spaced.replace("-", " ").replace("_", " ").replace("/", " ").split())


__all__ = ["Group", "Level", "Rule", "help_text", "level_of", "profiles", "tags_of", "words"]
