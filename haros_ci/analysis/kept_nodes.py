# SPDX-License-Identifier: Apache-2.0
"""Where what nodes make is kept between runs (docs/decisions/0009)."""

from __future__ import annotations

from typing import Any

from haros_ci.index.trace import XML_FILES
from haros_ci.keeping.kept import Earlier, begun, digest_of
from haros_ci.model.workspace import Store, Workspace
from haros_ci.own_sources import OF_FACTS, OF_FOLLOWED, digest
from haros_ci.syntax import Program
from haros_ci.syntax.codec import decoded
from haros_ci.systems.keeping import Keeper

#: Records of which a new state of the files may begin with one, and characters of the digests by which the nearest is chosen.
RECENT, SHORT = 4, 12


def _is_state(row: Any) -> bool:
    """Whether *row*, read from the cache, is a state with the digests of its files."""
    return (
        isinstance(row, list)
        and len(row) == 2
        and isinstance(row[0], str)
        and isinstance(row[1], dict)
        and all(isinstance(item, str) for item in row[1].values())
    )


def keeper(
    workspace: Workspace, store: Store, records: dict[str, Earlier | None] | None = None, macros: str = ""
) -> Keeper:
    """Where what nodes make is kept between runs: in *store*, beside the facts of the files, which *macros* of headers are part of.

    *records* has, and gets, those that have been read, for the other revision of a change.

    Each state of the files has a record of its own, so that a branch and its base do not drive out each other's; a new state begins
    with that of the last few records of whose files the fewest differ.
    """
    files = {file.path: file.digest for file in workspace.files if file.language in ("cpp", "python")}
    known = [(file.path, file.digest if file.path.endswith(".xml") else "") for file in workspace.files]
    files[XML_FILES] = digest_of(known)  # directories are listed, too
    languages = {file.path: file.language for file in workspace.files}

    def program(path: str, bytes_: str) -> Program | None:
        return decoded(store.get_text(f"facts-{languages[path]}", path, f"{digest(OF_FACTS)} {bytes_}"))

    state = digest_of(sorted(files.items()))
    code = f"{digest(OF_FOLLOWED)} {macros}"
    short = {path: found[:SHORT] for path, found in files.items()}

    def recent(key: str) -> list[tuple[str, dict[str, str]]]:
        """The states that were written last, with the digests of their files."""
        found = store.get("linked", "last", f"{code} {key}")
        rows = found if isinstance(found, list) else []
        return [(row[0], row[1]) for row in rows if _is_state(row)][-RECENT:]

    known_records = {} if records is None else records

    def record(name: str, key: str) -> Earlier | None:
        if f"{name} {key}" not in known_records:
            known_records[f"{name} {key}"] = begun(store.get("linked", f"nodes {name}", f"{code} {key}"))
        return known_records[f"{name} {key}"]

    def get(key: str) -> Earlier | None:
        own = record(state, key)
        states = recent(key) if own is None else []
        if not states:
            return own
        return record(min(reversed(states), key=lambda state: len(state[1].items() ^ short.items()))[0], key)

    def put(key: str, data: Any) -> None:
        store.put("linked", f"nodes {state}", f"{code} {key}", data)
        known_records.pop(f"{state} {key}", None)
        others = [[name, digests] for name, digests in recent(key) if name != state]
        store.put("linked", "last", f"{code} {key}", [*others, [state, short]][-RECENT:])

    return Keeper(files, get, put, program)
