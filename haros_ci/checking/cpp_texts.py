# SPDX-License-Identifier: Apache-2.0
"""How checks come by the texts of C++ files, so that what they asked for can be noted (``checking.unseen``)."""

from __future__ import annotations

from collections.abc import Callable

from haros_ci.records import dataclass, field


@dataclass(frozen=True, slots=True)
class CppTexts:
    """Two ways to a text by its path: *glance* for looking up words and includes alone, *read* for all of it; *words* are those looked up."""

    glance: Callable[[str], str]
    read: Callable[[str], str]
    words: set[str] = field(default_factory=set)
