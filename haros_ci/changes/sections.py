# SPDX-License-Identifier: Apache-2.0
"""How the fields and constants of one part of an interface differ from what they were."""

from __future__ import annotations

from bisect import bisect_left
from collections.abc import Iterator, Sequence
from dataclasses import replace

from haros_ci.interfaces.definitions import FieldType, field_type
from haros_ci.model.build import InterfaceField
from haros_ci.records import dataclass


@dataclass(frozen=True, slots=True)
class SectionDifference:
    """*what* as in ``InterfaceChange``; *name* before (after, if it is added); *line* after, for what is gone that of what stood before it.

    *is_other_value*: a constant's value is another one, not only written in another way.
    """

    what: str
    name: str
    before: str = ""
    after: str = ""
    line: int = 0
    is_other_value: bool = True


def differences(
    before: Sequence[InterfaceField], after: Sequence[InterfaceField], ros: int | None
) -> Iterator[SectionDifference]:
    """What one must know who has code or nodes made with *before*; nothing for changes that neither code nor the wire sees."""
    for is_constant, noun in ((False, "field"), (True, "constant")):
        old = [field for field in before if field.is_constant == is_constant]
        new = [field for field in after if field.is_constant == is_constant]
        yield from _of_one_kind(old, new, noun, ros)


def _of_one_kind(
    old: Sequence[InterfaceField], new: Sequence[InterfaceField], noun: str, ros: int | None
) -> Iterator[SectionDifference]:
    was, now = {field.name: field for field in old}, {field.name: field for field in new}
    renamed = dict(_renamed(old, new))
    line = 1
    for name, field in was.items():
        if name in renamed:
            line = now[renamed[name]].line
            yield SectionDifference(f"{noun}-renamed", name, name, renamed[name], line)
        elif name not in now:
            yield SectionDifference(f"{noun}-removed", name, before=_shown(field), line=line)
        else:
            line = now[name].line
            yield from _of_one(field, now[name], noun, ros)
    for name, field in now.items():
        if name not in was and name not in renamed.values():
            yield SectionDifference(f"{noun}-added", name, after=_shown(field), line=field.line)
    if noun == "field" or ros == 1:
        for name in _moved([n for n in was if n in now], [n for n in now if n in was]):
            yield SectionDifference(f"{noun}-moved", name, line=now[name].line)


def _of_one(was: InterfaceField, now: InterfaceField, noun: str, ros: int | None) -> Iterator[SectionDifference]:
    """The differences of a field or constant that kept its name."""
    made = SectionDifference("", now.name, line=now.line)
    one, other = _type(was, ros), _type(now, ros)
    if one != other or (one is None and was.type != now.type):
        is_bound = one is not None and other is not None and _unbounded(one) == _unbounded(other)
        yield replace(made, what="bound" if is_bound else f"{noun}-retyped", before=was.type, after=now.type)
    if noun == "constant":
        if was.default != now.default or (ros == 1 and was.value != now.value):
            is_other = was.default != now.default
            yield replace(made, what="constant-value", before=was.value, after=now.value, is_other_value=is_other)
    elif was.default != now.default:
        yield replace(made, what="default", before=was.value, after=now.value)


def _type(field: InterfaceField, ros: int | None) -> FieldType | None:
    """Its type on the wire: ``char`` is an uint8 in ROS 2."""
    kind = field_type(field.type)
    return replace(kind, base="uint8") if kind is not None and ros == 2 and kind.base == "char" else kind


def _unbounded(kind: FieldType) -> FieldType:
    """The type without its upper bounds; the length of a fixed array is not a bound."""
    return FieldType(kind.base, 0, "sequence") if kind.form == "bounded" else replace(kind, length=0)


def _renamed(old: Sequence[InterfaceField], new: Sequence[InterfaceField]) -> Iterator[tuple[str, str]]:
    """Fields of one type between the same neighbours, and constants of one value: the same one under another name."""
    was, now = {field.name for field in old}, {field.name for field in new}
    gaps: dict[str, list[InterfaceField]] = {}
    last = ""
    for field in old:
        last = field.name if field.name in now else last
        if field.name not in now:
            gaps.setdefault(last, []).append(field)
    fresh: dict[str, list[InterfaceField]] = {}
    last = ""
    for field in new:
        last = field.name if field.name in was else last
        if field.name not in was:
            fresh.setdefault(last, []).append(field)
    for after, fields in gaps.items():
        if len(fields) == len(fresh.get(after, ())):
            for one, other in zip(fields, fresh[after]):
                if one.type == other.type and (not one.is_constant or one.default == other.default):
                    yield one.name, other.name


def _moved(before: Sequence[str], after: Sequence[str]) -> Iterator[str]:
    """The names that left their order: those outside of a longest run that kept it."""
    places = {name: index for index, name in enumerate(before)}
    order = [places[name] for name in after]
    tails: list[int] = []
    lengths = []
    for place in order:
        at = bisect_left(tails, place)
        tails[at : at + 1] = [place]
        lengths.append(at + 1)
    expected, limit = len(tails), len(before)
    kept = set()
    for place, length in zip(reversed(order), reversed(lengths)):
        if length == expected and place < limit:
            kept.add(place)
            expected, limit = expected - 1, place
    yield from (name for name in after if places[name] not in kept)


def _shown(field: InterfaceField) -> str:
    return f"{field.type} = {field.value}" if field.is_constant else field.type
