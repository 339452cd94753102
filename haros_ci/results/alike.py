# SPDX-License-Identifier: Apache-2.0
"""Findings of one rule that say the same of one place or of one file: one finding, which names the others.

A launch file with six arguments that nothing reads, and a manifest that lacks three dependencies, are each mended at once. As with
copies (``haros_ci.results.copied``) only reports that a person reads join them, and what is new and what is known are never joined.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import replace

from haros_ci.regex import regex
from haros_ci.results.result import BaselineState, Related, Result
from haros_ci.results.rule import Level

#: A finding names no more other places than this.
MOST = 40
#: Names, and lines, that the message lists; a name is to be written by whoever mends it, a line is a note as well.
NAMED, LINES = 12, 5
#: States of findings that are joined, each with its like.
UNITED = (None, BaselineState.NEW, BaselineState.UNCHANGED)

#: Rules on names that are not there: a missing import, or a declaration that is missing or stands too low, shows at each use. Those of lines that are no further apart
#: than NEAR have one cause.
OF_NAMES = frozenset(
    """
    flake8:F821 haros-ci:parameter-read-undeclared haros-ci:undefined-attribute haros-ci:undefined-field haros-ci:undefined-interface haros-ci:undefined-name
    haros-ci:unset-launch-argument pylint:undefined-variable ruff:F821
    """.split()
)
NEAR = 3

#: Errors of one file that have one cause if they begin alike, up to the mark: a file that several nodes are given and that is not there, and a
#: construct that is wrong in the same way at each of its places.
OF_ONE_CAUSE = {"haros-ci:parameter-file-missing": ": ", "haros-ci:malformed-launch-file": "\n"}

#: Errors of one file that have one cause if they say the same but for names: elements of a robot's description that all lack the prefix of xacro, joints that all
#: lack the same, targets of which none waits for the same generation, directories that git has not kept.
OF_ONE_SHAPE = {
    "haros-ci:undefined-in-xacro": " has the name of a macro, but ",
    "haros-ci:broken-robot-model": ": urdfdom rejects the whole robot",
    "haros-ci:generation-not-awaited": ", but does not depend on the generation",
    "haros-ci:missing-install-source": ": git stores no directory that is empty",
}

_WORD = regex(r"\w+")
_BRACKETS = regex(r"[ ]?\((?:[^()]|\([^()]*\)){0,300}\)")
#: Further things that a finding counts and does not name.
_COUNTED = regex(r" and \d+ more(?= of them|,| are | is )")
_TOKEN = regex(r"[\w./:-]*\w|[^\w\s]")


def joined(results: Sequence[Result]) -> tuple[Result, ...]:
    """*results* with those that are alike as one, at the place of the first.

    Those of one rule, level, state and line are alike whatever they say; warnings and notes also if they say the same, but for
    names, of one file. Errors at two lines stay two, as each is mended by itself, unless they say the same of the same subject: that has
    one cause, as with a program that two branches of a launch file start; or the same, but for names that are not there, of neighbouring lines. Those that stand
    for copies already are joined at one line, or, where they are no errors, with those in the same copies.
    """
    groups: dict[tuple[object, ...], list[int]] = defaultdict(list)
    for i, result in enumerate(results):
        if result.state in UNITED and not result.suppressions and result.value is None:
            key = (result.tool, result.rule, result.level, result.state, result.location.path, bool(result.copies))
            groups[key].append(i)
    heads: dict[int, list[Result]] = {}
    dropped: set[int] = set()
    for indexes in groups.values():
        for first, *others in _alike(indexes, results):
            heads[first] = [results[i] for i in others]
            dropped.update(others)
    kept = (i for i in range(len(results)) if i not in dropped)
    return tuple(_with(results[i], heads[i]) if i in heads else results[i] for i in kept)


def _alike(indexes: Sequence[int], results: Sequence[Result]) -> Iterator[list[int]]:
    """The groups of two findings or more among those of one rule and file."""
    by_line: dict[int, list[int]] = defaultdict(list)
    for i in indexes:
        line = results[i].location.line
        if line is not None:
            by_line[line].append(i)
    by_shape: dict[tuple[str, ...], list[int]] = defaultdict(list)
    found_near = _neighbours(by_line, results)
    near = {i for group in found_near for i in group}
    for found in by_line.values():
        if len(found) > 1 and near.isdisjoint(found):
            yield found
        if len(found) > 1:
            continue
        result = results[found[0]]
        if (mark := OF_ONE_SHAPE.get(result.full_id)) and mark in result.message:
            shape = _shape(_COUNTED.sub("", result.message.partition("; ")[0]).replace(", which are ", ", which is "))
            by_shape[(shape, *(copy.location.path for copy in result.copies))].append(found[0])
            continue
        if result.level is not Level.ERROR:
            others = sorted({copy.location.path for copy in result.copies})
            by_shape[(_WORD.sub("_", result.message), *others)].append(found[0])
            continue
        if result.copies:
            continue
        if result.full_id in OF_ONE_CAUSE:
            by_shape[(result.message.partition(OF_ONE_CAUSE[result.full_id])[0],)].append(found[0])
        elif result.subject:  # what follows the first semicolon is advice, and the configuration that shows it
            by_shape[(result.message.partition("; ")[0].rstrip("."), *result.subject)].append(found[0])
    yield from found_near
    for group in by_shape.values():
        rest = [i for i in group if i not in near]
        if len(rest) > 1:
            yield rest


def _neighbours(by_line: Mapping[int, Sequence[int]], results: Sequence[Result]) -> list[list[int]]:
    """The groups of errors on names that are not there, of lines that follow each other closely, which say the same but for the names."""
    shapes, last = {""}, 0
    groups: list[tuple[int, list[int]]] = []
    for line, here in sorted(by_line.items()):
        if not all(_is_of_a_name(results[i]) for i in here):
            continue
        now = {_shape(results[i].message.partition("; ")[0].rstrip(".")) for i in here}
        if groups and now == shapes and line - last <= NEAR:
            groups[-1] = (groups[-1][0] + 1, [*groups[-1][1], *here])
        else:
            groups.append((1, [*here]))
        shapes, last = now, line
    return [group for lines, group in groups if lines > 1]


def _is_of_a_name(result: Result) -> bool:
    """Whether it is an error on a name that is not there, which stands for itself."""
    return not result.copies and result.level is Level.ERROR and result.full_id in OF_NAMES


def _with(first: Result, others: Sequence[Result]) -> Result:
    """*first*, which also stands for *others*."""
    names = [_different(first.message, other.message) for other in others]
    subjects = [_only_other(first.subject, other.subject) for other in others]
    if _are_names(names):
        rest = f"the same of {_listed(map(str, names))}"
    elif _are_names(subjects):
        rest = f"the same of {_listed(map(str, subjects))}"
    else:
        rest = f"{len(others)} more like it"
    lines = list(dict.fromkeys(str(other.location.line) for other in others))
    if all(other.message == first.message and other.location == first.location for other in others):
        rest = ""  # the notes have the places
    if lines != [str(first.location.line)]:
        rest += f" ({'lines' if len(lines) > 1 else 'line'} {_listed(lines, LINES)})"
    related = dict.fromkeys((*first.related, *_places(first, others, names if _are_names(names) else None)))
    return replace(
        first,
        message=f"{first.message.rstrip('.')}; and {rest}" if rest else first.message,
        related=(*first.related, *[place for place in related if place not in first.related][:MOST]),
        copies=(*first.copies, *(copy for other in others for copy in (other, *other.copies))),
    )


def _are_names(names: Sequence[str | None]) -> bool:
    """Whether each finding has a name, and one of its own."""
    return None not in names and len({*names}) == len(names)


def _only_other(one: Sequence[str], other: Sequence[str]) -> str | None:
    """The element of *other* that *one* has not, if there is one and the rest is the same; subjects are sorted, so it may stand at another place."""
    added = sorted({*other} - {*one})
    return added[0] if len(one) == len(other) and len(added) == len({*one} - {*other}) == 1 else None


def _places(first: Result, others: Sequence[Result], names: Sequence[str | None] | None) -> Iterator[Related]:
    """Where the *others* are and what each says; of those that differ in a name alone, or in names at the same place, what shows it."""
    for i, other in enumerate(others):
        is_renamed = other.location == first.location and _plain(other.message) == _plain(first.message)
        if names is None and not (is_renamed and other.related):
            yield Related(other.location, other.message)
        else:
            yield from other.related or (Related(other.location, f"The same of {names[i] if names else ''}."),)


def _plain(message: str) -> str:
    """The first sentence of *message* without names and without what stands in brackets, which the places show."""
    return _shape(_BRACKETS.sub("", message.partition("; ")[0]).rstrip("."))


def _shape(message: str) -> str:
    """*message* without its names: ``yaml-cpp`` and ``robot.width`` are one name each."""
    return _TOKEN.sub(lambda word: "_" if word[0][-1].isalnum() or word[0][-1] == "_" else word[0], message)


def _different(one: str, other: str) -> str | None:
    """The word of *other* in whose place *one* has another one, everywhere; None if they differ in more, or in nothing."""
    here, there = _TOKEN.findall(one), _TOKEN.findall(other)
    if len(here) != len(there):
        return None
    pairs = {pair for pair in zip(here, there) if pair[0] != pair[1]}
    return pairs.pop()[1] if len(pairs) == 1 else None


def _listed(items: Iterable[str], most: int = NAMED) -> str:
    words = [*items]
    if len(words) > most:
        return f"{', '.join(words[:most])} and {len(words) - most} more"
    return " and ".join(filter(None, (", ".join(words[:-1]), words[-1])))
