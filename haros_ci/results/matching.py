# SPDX-License-Identifier: Apache-2.0
"""The state of every result against what is known (SARIF §3.27.24), and why."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from haros_ci.model.location import Location
from haros_ci.results.known import ComparedFiles, KnownFinding, identity_of
from haros_ci.results.pairing import pair
from haros_ci.results.result import BaselineState, Identity, Result
from haros_ci.results.rule import Level
from haros_ci.results.same_cause import KnownLines, parts_of, split


def match(new: Sequence[Result], known: Sequence[KnownFinding], sides: ComparedFiles) -> tuple[Result, ...]:
    """The results with ``state`` and ``reason`` set, in their order, then the absent ones, sorted.

    Against a revision, a result that was put together of findings of one cause is two where some of those are known and others not.

    *new* are fingerprinted; suppressed ones take part. A result is *updated* when its text, message, level, metric
    or file has changed, *unchanged* when only its line has. A known finding is *absent* when its tool answered for
    its file in this run, or the file is gone; of a file that was not looked at nothing is said.
    """
    is_apart = sides.base is not None
    now = [(part, i) for i, result in enumerate(new) for part in (parts_of(result) if is_apart else (result,))]
    then = [(part, i) for i, one in enumerate(known) for part in ((is_apart and one.parts) or (one,))]
    pairs = {found.new: found for found in pair([part for part, _ in now], [part for part, _ in then], sides)}
    past, lines = _KnownBefore(known, sides), KnownLines((part for part, _ in then), sides)
    members: list[list[int]] = [[] for _ in new]
    for n, (_, i) in enumerate(now):
        members[i].append(n)
    found: list[Result] = []
    for result, ours in zip(new, members, strict=True):
        old = [n for n in ours if n in pairs]
        kept = [n - ours[0] for n in ours if n in pairs or (old and lines.have(now[n][0]))]
        if not old and result.suppressions and is_apart:  # what a comment silenced is not known
            kept = [i for i, part in enumerate(result.parts) if part.suppressions or not lines.is_brought(part)]
        seen, added = split(result, kept) if kept and is_apart and result.parts else (result, None)
        if old:
            found.append(_matched(seen, known[then[pairs[old[0]].old][1]], pairs[old[0]].evidence))
        for one in filter(None, (None if old else seen, added)):
            found.append(replace(one, state=BaselineState.NEW, reason=past.why_new(one)))
    paired = {then[one.old][1] for one in pairs.values()}
    removed = [_absent(k, sides) for i, k in enumerate(known) if i not in paired and sides.answered(k)]
    return (*found, *sorted(removed, key=lambda result: result.sort_key))


class _KnownBefore:
    """What the baseline knew, to say why a result is new."""

    def __init__(self, known: Sequence[KnownFinding], sides: ComparedFiles) -> None:
        self.rules: set[str] = set()
        self.files: set[tuple[str, str]] = set()
        self.texts: set[tuple[str, str, str]] = set()
        self.named: dict[str, set[str]] = {}  # the digests of names by rule
        for entry in known:
            rule = sides.rule(entry)
            path = sides.renames.get(entry.path, entry.path)
            self.rules.add(rule)
            self.files.add((rule, path))
            self.texts.add((rule, path, entry.text))
            if entry.names:
                self.named.setdefault(rule, set()).add(entry.names)

    def why_new(self, result: Result) -> str:
        rule, path = result.full_id, result.location.path
        if identity_of(result).names and rule in self.named:
            return self.why_new_name(rule, result)
        text = identity_of(result).text
        if rule not in self.rules:
            return f"new: the baseline has no '{result.rule}'"
        if (rule, path) not in self.files:
            return f"new: no earlier '{result.rule}' in this file"
        if (rule, path, text) not in self.texts:
            return f"new: no earlier '{result.rule}' in this file has this text"
        return f"new: every earlier '{result.rule}' with this text stands elsewhere or is matched to another result"

    def why_new_name(self, rule: str, result: Result) -> str:
        names = ", ".join(f"'{name}'" for name in sorted(result.subject)) or "these names"
        if identity_of(result).names in self.named[rule]:
            return f"new: every earlier '{result.rule}' about {names} stands elsewhere or is matched to another result"
        return f"new: no earlier '{result.rule}' is about {names}, or about names that gave way to them"


def _matched(result: Result, known: KnownFinding, evidence: str) -> Result:
    now, place = identity_of(result), result.location
    changes = []
    if known.path != place.path:
        changes.append("file changed")
    if known.text and known.text != now.text:
        changes.append("text changed")
    if known.names and now.names and known.names != now.names:
        changes.append(_renamed(result, known))
    if known.template.rstrip(". ") != now.template.rstrip(". "):  # a message in SARIF is a full sentence
        changes.append("message changed")
    if known.level not in (None, result.level):
        changes.append(f"level {known.level.value if known.level else ''} → {result.level.value}")
    if known.value is not None and result.value is not None and known.value != result.value:
        changes.append(f"value {known.value:g} → {result.value:g}")
    if (name := f"{known.tool}:{known.rule}") != result.full_id:
        changes.append(f"rule was {name}")
    state = BaselineState.UPDATED if changes else BaselineState.UNCHANGED
    return replace(result, state=state, reason="; ".join((evidence + _way(known, place), *changes)))


def _way(known: KnownFinding, place: Location) -> str:
    """From where to where, as far as the baseline tells."""
    if known.path != place.path:
        return f" ({Location(known.path, known.line)} → {Location(place.path, place.line)})"
    if known.line is None or place.line is None:
        return ""
    return f" (line {place.line})" if known.line == place.line else f" ({known.line} → {place.line})"


def _renamed(result: Result, known: KnownFinding) -> str:
    """Which names gave way to which."""
    old, new = sorted({*known.subject} - {*result.subject}), sorted({*result.subject} - {*known.subject})
    if old and not new:
        return f"names mended: {', '.join(old)}"
    return f"names changed: {', '.join(old) or '?'} → {', '.join(new) or '?'}"


def _absent(known: KnownFinding, sides: ComparedFiles) -> Result:
    now = sides.renames.get(known.path, known.path)
    return Result(
        tool=known.tool,
        rule=known.rule,
        level=known.level or Level.WARNING,
        message=known.message or known.template,
        location=Location(known.path, known.line),
        scope=known.scope,
        value=known.value,
        subject=known.subject,
        graph=known.graph,
        identity=Identity(
            scope=known.scope,
            text=known.text,
            shape=known.shape,
            before=known.before,
            after=known.after,
            template=known.template,
            occurrence=known.occurrence,
            names=known.names,
            roles=known.roles,
        ),
        state=BaselineState.ABSENT,
        reason=f"gone: '{known.rule}' is no longer found here" if sides.exists(now) else "gone with its file",
    )
