# SPDX-License-Identifier: Apache-2.0
"""How checks come by the texts of C++ where not all of them are seen (``checking.unseen``)."""

from __future__ import annotations

from collections.abc import Callable

from haros_ci.records import dataclass, field


@dataclass(frozen=True, slots=True)
class Doors:
    """How texts of C++ are had where not all of them are seen: *glance* is for the words and includes of one, *read* for all of it; *words* are those asked for."""

    glance: Callable[[str], str]
    read: Callable[[str], str]
    words: set[str] = field(default_factory=set)
