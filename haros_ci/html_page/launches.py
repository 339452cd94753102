# SPDX-License-Identifier: Apache-2.0
"""The tree of launch files of a configuration: what each includes, declares and starts."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

from haros_ci.html_page.pool import Pool, presence_text
from haros_ci.model.architecture import Configuration
from haros_ci.model.launch_facts import ArgumentDeclaration, IncludeUse
from haros_ci.model.location import Location

#: Includes and arguments of one configuration that are shown.
MOST = 2_000


def launch_tree(pool: Pool, one: Configuration) -> dict[str, Any]:
    """``includes``: place, text, path, passed arguments, presence, and the index of the include around it; ``declared`` arguments.

    A node is started by the file of its location: the page joins them.
    """
    facts = one.launch_facts
    includes = _once((fact for fact in facts if isinstance(fact, IncludeUse)), lambda f: (f.included, f.location))
    ways = {(*include.included, include.location): number for number, include in enumerate(includes)}
    declared = _once((fact for fact in facts if isinstance(fact, ArgumentDeclaration)), lambda f: (f.location, f.name))
    return {
        "includes": [
            (
                pool.place(include.location),
                pool.text(include.text),
                pool.text(include.path),
                pool.texts(tuple(dict.fromkeys(passed.name for passed in include.passed))),
                pool.text(presence_text(include.presence)),
                ways.get(include.included, -1),
            )
            for include in includes
        ],
        "declared": [
            (
                pool.place(item.location),
                pool.text(item.name),
                pool.text(item.default),
                pool.texts(item.choices[:20]),
            )
            for item in declared
        ],
    }


def _once(facts: Iterable[Any], key: Any) -> list[Any]:
    """The first of those with the same key, in order, up to ``MOST``."""
    found: dict[tuple[Location, ...], Any] = {}
    for fact in facts:
        found.setdefault(key(fact), fact)
    return list(found.values())[:MOST]
