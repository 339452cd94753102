# SPDX-License-Identifier: Apache-2.0
"""Measuring in a process of its own while the systems are made: following the code of nodes keeps one processor busy, and others idle."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from functools import partial
from typing import TYPE_CHECKING

from haros_ci.config.settings import Settings
from haros_ci.forks import meanwhile
from haros_ci.model.workspace import Store, Workspace
from haros_ci.timing import stage

if TYPE_CHECKING:
    from haros_ci.analysis.architectures import Architectures

#: What a store was given: the group, the path, the key and the value.
Put = tuple[str, str, str, object]


class _Noted:
    """A store that lists what is put into it."""

    def __init__(self, store: Store) -> None:
        self.get, self.get_text, self._store = store.get, store.get_text, store
        self.values: list[Put] = []
        self.texts: list[tuple[str, str, str, str]] = []

    def put(self, group: str, path: str, key: str, value: object) -> None:
        self.values.append((group, path, key, value))
        self._store.put(group, path, key, value)

    def put_text(self, group: str, path: str, key: str, text: str) -> None:
        self.texts.append((group, path, key, text))
        self._store.put_text(group, path, key, text)


@contextmanager
def measured_meanwhile(workspace: Workspace, architectures: Architectures, *, is_head: bool) -> Iterator[None]:
    """What is measured of single files is in the store when the block ends, if an output wants all values (``is_measured``) and the block made the systems of *workspace*.

    Otherwise nothing is begun, or it is left: with an unchanged workspace nothing is measured. Without another process, and where it failed, it is
    measured when it is asked for.
    """
    settings, store = architectures.settings, architectures.store
    if not is_head or not settings.is_measured or settings.jobs < 2 or architectures.has_made(workspace):
        yield
        return
    with meanwhile(partial(_measured, workspace, settings, store)) as found:
        yield
        if architectures.has_made(workspace):
            with stage("structure"):
                values, texts = found() or ((), ())
                for value in values:
                    store.put(*value)
                for text in texts:
                    store.put_text(*text)


def _measured(
    workspace: Workspace, settings: Settings, store: Store
) -> tuple[list[Put], list[tuple[str, str, str, str]]]:
    """What measuring puts into the store."""
    from haros_ci.measuring.measures import file_facts, tool_values

    noted = _Noted(store)
    tool_values(workspace, settings, noted)
    file_facts(workspace, noted, 1)
    return noted.values, noted.texts
