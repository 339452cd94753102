# SPDX-License-Identifier: Apache-2.0
"""What the settings of a tool switch off, as a value, and what a change of them switches off besides."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping

from haros_ci.linters import settings_files
from haros_ci.records import dataclass, field

#: Characters of a word of a settings file that are shown.
LONGEST_WORD = 60


@dataclass(frozen=True, slots=True)
class Switches:
    """The settings of one tool that can suppress a finding.

    ``off`` are rules that are off, ``only`` those that alone are on (None: the tool's own choice), ``more`` those that are on beside
    the tool's own choice, and ``strict`` options that make the tool report more. ``words`` are pairs of an option and a word that restricts what is reported, such as a glob of files or an
    ignored name. ``limits`` are numbers of which a larger one suppresses more findings. ``runs`` is False where the tool does nothing.
    """

    off: frozenset[str] = frozenset()
    only: frozenset[str] | None = None
    more: frozenset[str] = frozenset()
    strict: frozenset[str] = frozenset()
    words: frozenset[tuple[str, str]] = frozenset()
    limits: Mapping[str, float] = field(default_factory=dict)
    runs: bool = True


@dataclass(frozen=True, slots=True)
class Keys:
    """Which options do what, by their names with ``-``; ``flags`` narrow where they are true, ``stricter`` where they are not.

    ``limits`` have the tool's own value, None if it has none. ``is_all`` tells whether the tool's own choice of rules is all of them.
    """

    off: tuple[str, ...] = ()
    only: tuple[str, ...] = ()
    more: tuple[str, ...] = ()
    words: tuple[str, ...] = ()
    flags: tuple[str, ...] = ()
    stricter: tuple[str, ...] = ()
    limits: Mapping[str, float | None] = field(default_factory=dict)
    is_all: bool = True


def switches(options: Mapping[str, object], keys: Keys, section: str = "") -> Switches:
    """What *options* switch off by *keys*; *section* is put before the options of a part of the workspace."""
    normalized = {key.strip().lower().replace("_", "-"): value for key, value in options.items()}

    def of(names: Iterable[str]) -> frozenset[str]:
        return frozenset(
            f"{section}{word}" for name in names if name in normalized for word in _words(normalized[name])
        )

    only = of(keys.only) if any(name in normalized for name in keys.only) else None
    words = {(section + name, word) for name in keys.words if name in normalized for word in _words(normalized[name])}
    words |= {(section + name, "true") for name in keys.flags if _is_true(normalized.get(name))}
    strict = frozenset(section + name for name in keys.stricter if _is_true(normalized.get(name)))
    limits = {section + name: number for name in keys.limits if (number := _number(normalized.get(name))) is not None}
    return Switches(of(keys.off), only, of(keys.more), strict, frozenset(words), limits)


def joined(parts: Iterable[Switches]) -> Switches:
    """All *parts* together; the last one that says what alone is on counts, and the last limit of a name."""
    found = Switches()
    for part in parts:
        found = Switches(
            found.off | part.off,
            found.only if part.only is None else part.only,
            found.more | part.more,
            found.strict | part.strict,
            found.words | part.words,
            {**found.limits, **part.limits},
            found.runs and part.runs,
        )
    return found


def turned_off(tool: str, before: Switches, after: Switches, keys: Keys) -> list[str]:
    """What *after* switches off that *before* does not, in words, sorted; *keys* have what the tool does by itself."""
    if not after.runs:
        return [f"{tool}:*"] if before.runs else []
    found = {f"{tool}:{shown(rule)}" for rule in (after.off - before.off) | (before.more - after.more - after.off)}
    if before.only is not None and after.only is not None:
        found |= {f"{tool}:{shown(rule)}" for rule in before.only - after.only - after.more}
    elif before.only is not None and not keys.is_all:
        found |= {f"{tool}:{shown(rule)} (unless it is on by default)" for rule in before.only - after.more}
    elif after.only is not None:
        found.add(f"{tool}:* but {', '.join(map(shown, sorted(after.only)[:10])) or 'nothing'}")
    found |= {f"{tool} as `{shown(name)}` says: {shown(word)}" for name, word in after.words - before.words}
    found |= {f"{tool} without `{shown(name)}`" for name in before.strict - after.strict}
    found |= set(_raised(tool, before.limits, after.limits, keys.limits))
    return sorted(found)


def shown(word: str) -> str:
    """A word of a settings file, fit for a line of text."""
    clean = "".join(character if character.isprintable() else "?" for character in word)
    return clean if len(clean) <= LONGEST_WORD else f"{clean[:LONGEST_WORD]}…"


def _raised(
    tool: str, before: Mapping[str, float], after: Mapping[str, float], own: Mapping[str, float | None]
) -> Iterator[str]:
    for name in before.keys() | after.keys():
        old, new = (side.get(name, own.get(name)) for side in (before, after))
        if new is not None and old is not None and new > old:
            yield f"{tool} up to `{shown(name)}` {new:g} (before: {old:g})"
        elif new is None and old is not None:
            yield f"{tool} above `{shown(name)}` {old:g} (now without a limit)"


def _words(value: object) -> list[str]:
    if isinstance(value, dict):
        return [f"{key}: {settings_files.as_text(item)}" for key, item in value.items()]
    text = value if isinstance(value, list) else str(value)
    return [word for word in settings_files.words(text) if word]


def _is_true(value: object) -> bool:
    return value is True or str(value).strip().lower() in ("true", "yes", "on", "1")


def _number(value: object) -> float | None:
    try:
        number = float(str(value))
    except ValueError:
        return None
    return number if abs(number) < 1e15 else 1e15
