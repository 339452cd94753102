# SPDX-License-Identifier: Apache-2.0
"""The architecture of a whole revision, kept in the cache: that of the base of a change is read, and so is that of what only moves lines of it."""

from __future__ import annotations

import zlib
from base64 import b64decode, b64encode
from binascii import Error
from collections.abc import Callable, Mapping
from functools import cache

import msgspec

from haros_ci.analysis.architecture_codec import LineLost, Lines, decoded, encoded
from haros_ci.analysis.kept_runs import GROUP, MAX_OUTPUT, MAX_PACKED, key_of
from haros_ci.analysis.programs import programs
from haros_ci.model.architecture import Architecture, Configuration
from haros_ci.model.workspace import Store, Workspace
from haros_ci.records import dataclass
from haros_ci.report.escape import multiline
from haros_ci.systems.link import Linked
from haros_ci.timing import timed
from haros_ci.workspace.build import builds

NAME, LACKING = "systems", "lacking"
Make = Callable[[], Linked]


@dataclass(frozen=True, slots=True)
class KeptArchitectures:
    """Architectures in *store*, under *settings*, a digest of all that they depend on besides the files; *processes* read programs."""

    settings: str
    store: Store
    processes: int = 1

    def get(self, workspace: Workspace, make: Make, base: Workspace, lines: Lines | None = None) -> Linked | None:
        """What *make* makes of *workspace*, if that of *base* is kept: the same workspace, or one of which code has only moved to *lines*.

        Its programs and builds are read; what its configurations are under other launch arguments is made when it is asked for.
        """
        found = self._read(base, workspace, lines)
        if found is None:
            return None
        linked = cache(make)

        def under(name: str, arguments: Mapping[str, str]) -> Configuration | None:
            return linked().under(name, arguments)

        built = builds(workspace)
        return Linked(found, under, built, programs(workspace, built, self.store, [], self.processes))

    @timed("cache")
    def put(self, workspace: Workspace, found: Architecture) -> None:
        """Keep what was made of *workspace*, unless it would not come back as it is."""
        key = self._key(workspace)
        data = encoded(found) if found.packages == workspace.packages else None
        packed = zlib.compress(data, 1) if data is not None and len(data) <= MAX_OUTPUT else b""
        if packed and len(packed) <= MAX_PACKED:
            self.store.put(GROUP, f"{NAME} {key}", key, b64encode(packed).decode())

    def sentences(self, workspace: Workspace) -> tuple[str, ...] | None:
        """What is kept of what the architecture of *workspace* lacks; None if nothing is."""
        key = key_of(LACKING, self.settings, workspace)
        kept = self.store.get(GROUP, f"{LACKING} {key}", key)
        is_text = isinstance(kept, list) and all(isinstance(sentence, str) for sentence in kept)
        return tuple(map(multiline, kept)) if is_text and isinstance(kept, list) else None

    def put_sentences(self, workspace: Workspace, sentences: tuple[str, ...]) -> None:
        """Keep what the architecture of *workspace* lacks."""
        key = key_of(LACKING, self.settings, workspace)
        self.store.put(GROUP, f"{LACKING} {key}", key, list(sentences))

    @timed("cache")
    def _read(self, base: Workspace, workspace: Workspace, lines: Lines | None) -> Architecture | None:
        key = self._key(base)
        text = self.store.get(GROUP, f"{NAME} {key}", key)
        if not isinstance(text, str):
            return None
        unpacker = zlib.decompressobj()
        try:
            data = unpacker.decompress(b64decode(text, validate=True), MAX_OUTPUT)
            return decoded(data, workspace.packages, lines) if unpacker.eof else None
        except (Error, ValueError, IndexError, RecursionError, zlib.error, msgspec.MsgspecError, LineLost):
            return None

    def _key(self, workspace: Workspace) -> str:
        return key_of(NAME, self.settings, workspace)
