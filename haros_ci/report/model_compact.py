# SPDX-License-Identifier: Apache-2.0
"""The architecture as compact JSON: what several configurations have stands once, in tables, and everything on one line.

``expand`` makes the plain document of it, byte for byte. What a key means is said by ``model_json``.
"""

from __future__ import annotations

import json
from collections.abc import Mapping
from typing import Any

from haros_ci.model.architecture import KINDS, Architecture
from haros_ci.report.channels import CHANNELS
from haros_ci.report.escape import no_command
from haros_ci.report.model_json import document_of, laid_out

#: The version of this form; that of what it says is ``schema_version``.
COMPACT = 1
ENDPOINTS = "endpoints"
#: Lists of a configuration that hold places in the table of their name.
SHARED = ("nodes", "parameters", *CHANNELS)


class Table:
    """Values, each once, in the order in which they were first asked for."""

    def __init__(self) -> None:
        self.texts: dict[str, int] = {}
        self._places: dict[int, int] = {}

    def place(self, value: Mapping[str, Any]) -> int:
        """Where *value*, which is not changed and outlives the table, stands."""
        found = self._places.get(id(value))
        if found is None:
            text = _ENCODE(value)
            found = self._places[id(value)] = self.texts.setdefault(text, len(self.texts))
        return found

    def text(self) -> str:
        """The table as a JSON list."""
        return f"[{','.join(self.texts)}]"


def render(architecture: Architecture) -> str:
    """The document on one line; ASCII, with a final newline. It has the same bytes for the same architecture."""
    document = document_of(architecture)
    tables = {name: Table() for name in (ENDPOINTS, *SHARED)}
    configurations = []
    for configuration in document["configurations"]:
        short = dict(configuration)  # the whole document lives on: tables know values by their identity
        for node in short["nodes"]:
            node.update((kind, [tables[ENDPOINTS].place(end) for end in node[kind]]) for kind in KINDS)
        for name in SHARED:
            short[name] = [tables[name].place(item) for item in short[name]]
        configurations.append(short)
    head = _ENCODE({"schema_version": document["schema_version"], "compact": COMPACT})
    rest = {key: value for key, value in document.items() if key not in ("schema_version", "configurations")}
    whole = ",".join(f"{_ENCODE(name)}:{table.text()}" for name, table in tables.items())
    tail = _ENCODE({"configurations": configurations, **rest})
    return no_command(f'{head[:-1]},"tables":{{{whole}}},{tail[1:]}') + "\n"


def expand(text: str | bytes) -> str:
    """The plain document, as ``haros-ci model --format json`` writes it, of a compact one.

    Raises ValueError for what is none: another form, a list that names no place of its table.
    """
    document = json.loads(text)
    try:
        if document.pop("compact") != COMPACT:
            raise ValueError(f"this reads form {COMPACT} of compact models")
        tables = document.pop("tables")
        for node in tables["nodes"]:
            for kind in KINDS:
                node[kind] = _looked_up(tables[ENDPOINTS], node[kind])
        for configuration in document["configurations"]:
            for name in SHARED:
                configuration[name] = _looked_up(tables[name], configuration[name])
    except (AttributeError, KeyError, TypeError) as err:
        raise ValueError("not a compact model") from err
    return laid_out(document)


def _looked_up(table: list[Any], places: list[int]) -> list[Any]:
    if any(place.__class__ is not int or not 0 <= place < len(table) for place in places):
        raise ValueError("not a compact model: a place is not in its table")
    return [table[place] for place in places]


_ENCODE = json.JSONEncoder(ensure_ascii=True, allow_nan=False, separators=(",", ":")).encode
