# SPDX-License-Identifier: Apache-2.0
"""The same finding on one thing in several files: one finding at the first place, which names the others.

A node that does not declare a parameter which four launch files give it, and a program that nothing builds and three launch files start, have
one cause. As with copies (``haros_ci.results.copied``) only reports that a person reads join them, and what is new and what is known are never joined.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Sequence
from dataclasses import replace

from haros_ci.results.alike import UNITED
from haros_ci.results.result import Related, Result

#: Rules on a thing that launch files name and that is wrong, or not there, wherever they name it; and on what a version of launch has no more.
OF_ONE_CAUSE = frozenset(
    f"haros-ci:{rule}"
    for rule in (
        "deprecated-launch-keyword",
        "ineffective-remap",
        "missing-launch-file",
        "parameter-file-missing",
        "parameter-not-declared",
        "unknown-executable",
    )
)
#: Rules on a thing that is not there by the name that files use: one renaming, or one file that is brought back, mends all its uses, several of one file, too.
OF_A_THING = frozenset(("haros-ci:undefined-interface", "haros-ci:unknown-package"))
#: Parts of a message, after a semicolon, that tell the configuration which shows the finding, or count other places of the file.
_SEEN = ("in ", "seen with ", "so has ", "so have ", "the other node is at ")
#: A finding names no more other places than this; the message names NAMED files.
MOST, NAMED = 40, 2


def across(results: Sequence[Result]) -> tuple[Result, ...]:
    """*results* with those of OF_ONE_CAUSE as one that say the same of the same subject in several files, but for the configuration that shows them."""
    groups: dict[tuple[object, ...], dict[str, int]] = defaultdict(dict)
    for i, one in enumerate(results):
        is_open = one.state in UNITED and not one.suppressions and not one.copies
        if is_open and one.subject and one.full_id in OF_ONE_CAUSE:
            groups[one.full_id, one.level, one.state, one.subject, cause(one.message)].setdefault(one.location.path, i)
    heads: dict[int, list[Result]] = {}
    for first, *others in (tuple(places.values()) for places in groups.values()):
        if others:
            heads[first] = [results[i] for i in others]
    dropped = {id(other) for others in heads.values() for other in others}
    return tuple(
        _joined(one, heads[i]) if i in heads else one for i, one in enumerate(results) if id(one) not in dropped
    )


def uses(results: Sequence[Result]) -> tuple[Result, ...]:
    """*results* with those of OF_A_THING as one that say the same of the same subject, where they are in several files."""
    groups: dict[tuple[object, ...], list[int]] = defaultdict(list)
    for i, one in enumerate(results):
        is_open = one.state in UNITED and not one.suppressions and not one.copies
        if is_open and one.subject and one.full_id in OF_A_THING:
            groups[one.full_id, one.level, one.state, one.subject, cause(one.message)].append(i)
    heads: dict[int, tuple[list[Result], int]] = {}
    for first, *others in groups.values():
        files = {results[i].location.path for i in others} - {results[first].location.path}
        if files:
            elsewhere = sorted(others, key=lambda i: results[i].location.path == results[first].location.path)
            heads[first] = [results[i] for i in elsewhere], len(files)
    dropped = {id(other) for others, _ in heads.values() for other in others}
    return tuple(
        _joined(one, *heads[i]) if i in heads else one for i, one in enumerate(results) if id(one) not in dropped
    )


def cause(message: str) -> tuple[str, ...]:
    """The parts of *message* that do not tell where it was seen."""
    return tuple(part for part in message.rstrip(".").split("; ") if not part.startswith(_SEEN))


def standing_for(first: Result, others: Sequence[Result], where: str) -> Result:
    """*first*, which says in words (*where*: ``2 copies``) that it stands for *others*, and has their places."""
    words, places = places_named(others, where, first.location.path)
    return replace(
        first,
        message=f"{first.message.rstrip('.')}; {words}",
        related=(*first.related, *places),
        copies=tuple(others),
    )


def places_named(others: Sequence[Result], where: str, own: str = "") -> tuple[str, tuple[Related, ...]]:
    """What a finding in the file *own* says of *others* (*where*: ``2 copies``), and their places."""
    paths = [path for path in dict.fromkeys(other.location.path for other in others) if path != own]
    names = ", ".join(paths[:NAMED])
    more = ", …" if len(paths) > NAMED else ""
    places = tuple(Related(other.location, f"The same in {other.location.path}.") for other in others[:MOST])
    return f"and the same in {where} ({names}{more})", places


def _joined(first: Result, others: Sequence[Result], files: int | None = None) -> Result:
    files = len(others) if files is None else files
    return standing_for(first, others, "1 other file" if files == 1 else f"{files} other files")
