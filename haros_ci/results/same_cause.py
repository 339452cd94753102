# SPDX-License-Identifier: Apache-2.0
"""Findings of one cause as one, and as they were before: against a base revision each of them is known, or new, by itself."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Callable, Iterable, Sequence
from dataclasses import replace

from haros_ci.regex import regex
from haros_ci.results.comments import bare, lines_of, syntax
from haros_ci.results.fingerprint import digest, message_template
from haros_ci.results.known import ComparedFiles, KnownFinding, identity_of
from haros_ci.results.line_map import line_mapper
from haros_ci.results.result import Related, Result

#: Rules that speak once of each use of a name that is not there: those of one name in one file have one cause.
OF_A_NAME = frozenset("pylint:undefined-variable ruff:F821 flake8:F821 mypy:name-defined".split())

_QUOTED = regex(r"'\w+'|\"\w+\"|`\w+`")
#: Names that a message has beside the first.
_SHOWN = 3


def put_together(first: Result, others: Sequence[Result]) -> Result:
    """*first* with the places of *others*; its level is the worst of theirs."""
    places = tuple(Related(other.location, f"Of the same cause: {other.message}") for other in others)
    level = min((first.level, *(other.level for other in others)), key=lambda level: level.rank)
    return replace(
        first,
        level=level,
        related=(*first.related, *places),
        message=_message(first, others),
        parts=(first, *others),
    )


def _message(first: Result, others: Sequence[Result]) -> str:
    """What *first* says; of several names that a file does not define, the others as well."""
    own = _QUOTED.search(first.message) if first.full_id in OF_A_NAME else None
    if own is None:
        return first.message
    names = dict.fromkeys(name[0] for other in others for name in [_QUOTED.search(other.message)] if name is not None)
    names.pop(own[0], None)
    if not names:
        return first.message
    shown = [*names][:_SHOWN]
    more = ", …" if len(names) > _SHOWN else ""
    return (
        f"{first.message.rstrip('.')}; {len(names)} more names are not defined in this file: {', '.join(shown)}{more}"
    )


def parts_of(result: Result) -> tuple[Result, ...]:
    """What *result* was put together of; itself where it stands for itself."""
    return result.parts or (result,)


class KnownLines:
    """The lines of *known* findings as they stand now, to tell that one more finding in such a line is the same cause again.

    A call that lacks two arguments is one defect, as is a template that is wrong for one more type. A name that is not there is its own.
    """

    def __init__(self, known: Iterable[KnownFinding], sides: ComparedFiles) -> None:
        self._sides = sides
        self._old_paths = {now: before for before, now in sides.renames.items()}
        self._known: dict[tuple[str, str], list[KnownFinding]] = defaultdict(list)
        self._maps: dict[tuple[str, str], Callable[[int], int | None]] = {}
        for one in known:
            self._known[sides.rule(one), sides.renames.get(one.path, one.path)].append(one)

    def have(self, part: Result) -> bool:
        """Whether a finding of the same rule was known in the line of *part*, which reads as it did."""
        path, text = part.location.path, identity_of(part).text
        if part.full_id in OF_A_NAME or self._sides.base is None:
            return False
        same = (one for one in self._known.get((part.full_id, path), ()) if one.text == text and one.line)
        return any(self._mapped(one, path) == part.location.line for one in same)

    def is_brought(self, part: Result) -> bool:
        """Whether the line of *part* was not in the old file, in the place that it has now."""
        path, line = part.location.path, part.location.line
        if self._sides.base is None or line is None:
            return False
        then = self._old_paths.get(path, path)
        before, kind = lines_of(self._sides.base(then)), syntax(self._sides.language(path), path)
        text = identity_of(part).text
        same = (n for n, old in enumerate(before, 1) if digest(bare(old, kind)) == text)
        return all(self._place(then, path, n) != line for n in same)

    def _mapped(self, known: KnownFinding, path: str) -> int | None:
        return self._place(known.path, path, known.line or 0)

    def _place(self, old: str, path: str, line: int) -> int | None:
        if (old, path) not in self._maps and self._sides.base is not None:
            self._maps[old, path] = line_mapper(self._sides.base(old), self._sides.head(path))
        return self._maps[old, path](line)


def split(result: Result, kept: Sequence[int]) -> tuple[Result, Result | None]:
    """*result* of its parts at *kept* alone, some of them, and what is left of it, which is set aside by settings alone, and by comments of its own."""
    left = [part for i, part in enumerate(result.parts) if i not in kept]
    if not left:
        return result, None
    settings = tuple(suppression for suppression in result.suppressions if suppression.kind == "external")
    rest = _again(left)
    own = tuple(suppression for suppression in rest.suppressions if suppression not in settings)
    first = replace(_again([result.parts[i] for i in kept]), suppressions=result.suppressions, also=result.also)
    return (
        replace(first, level=result.level),
        replace(rest, level=result.level, suppressions=(*own, *settings)),
    )


def _again(parts: Sequence[Result]) -> Result:
    """*parts* as one."""
    first, *others = parts
    one = put_together(first, others) if others else first
    template = message_template(one.message, keep_names=one.location.line is None)
    return replace(one, identity=replace(identity_of(one), template=template))
