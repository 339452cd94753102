# SPDX-License-Identifier: Apache-2.0
"""The messages that a property still needs: of those that are alike only one, none that is too old, and no more than a fixed number."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any

#: Messages of one property.
MOST_KEPT = 10_000
#: Items of arrays and characters of texts that they have altogether.
MOST_ITEMS = 4_000_000


class Record:
    """A message at its place in the recording; *message* itself or, where others may need it for long, only its *slots* are kept."""

    __slots__ = ("message", "number", "slots", "time", "topic", "weight")

    def __init__(
        self, topic: str, message: Any, time: int, number: int, slots: Mapping[str, Any] | None = None
    ) -> None:
        self.topic, self.message, self.time, self.number, self.slots = topic, message, time, number, slots
        self.weight = 0 if slots is None else sum(len(slot) for slot in slots.values() if hasattr(slot, "__len__"))


class Pool:
    """Records in order of time. Of two with the same values the first (*keeps_first*) or the last stays: what answers one answers the other.

    *overflowed* if one was left out because there were too many.
    """

    __slots__ = ("keeps_first", "limit", "overflowed", "records", "weight")

    def __init__(self, keeps_first: bool, limit: int = MOST_KEPT) -> None:
        self.keeps_first = keeps_first
        self.limit = limit
        self.overflowed = False
        self.records: dict[Any, Record] = {}
        self.weight = 0

    def __len__(self) -> int:
        return len(self.records)

    def __iter__(self) -> Iterator[Record]:
        return iter(self.records.values())

    @property
    def first(self) -> Record:
        """The oldest; there must be one."""
        return next(iter(self.records.values()))

    def add(self, record: Record) -> None:
        """Take *record*, which is not older than those that are there."""
        key = self._key(record)
        if key in self.records:
            if self.keeps_first:
                return
            self._forget(key)
        while self.records and (len(self.records) >= self.limit or self.weight + record.weight > MOST_ITEMS):
            self.overflowed = True
            if self.keeps_first:
                return
            self._forget(next(iter(self.records)))
        self.records[key] = record
        self.weight += record.weight

    def _forget(self, key: Any) -> None:
        self.weight -= self.records.pop(key).weight

    def _key(self, record: Record) -> Any:
        if record.slots is None:
            return None
        key = (record.topic, *record.slots.values())
        try:
            hash(key)
        except TypeError:
            return record.number
        return key

    def remove(self, record: Record) -> None:
        """Take *record* out, which is there."""
        self._forget(self._key(record))

    def drop_until(self, time: int) -> None:
        """Forget what is of *time*, or older."""
        while self.records and self.first.time <= time:
            self._forget(next(iter(self.records)))

    def clear(self) -> None:
        """Forget all."""
        self.records.clear()
        self.weight = 0
