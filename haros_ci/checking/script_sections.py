# SPDX-License-Identifier: Apache-2.0
"""What setup.cfg says of where programs are put, under a misspelt section or key (setuptools, "Configuring setuptools using setup.cfg files")."""

from __future__ import annotations

from haros_ci.checking.likeness import is_slip
from haros_ci.records import dataclass
from haros_ci.regex import regex
from haros_ci.results.fix import Edit, Fix

_HEADER = regex(r"\[([^\]\n]{1,60})\]")
_KEY = regex(r"([\w-]{1,60})[ \t]*[=:]")
#: Lines of a setup.cfg that are looked at.
_MOST = 2_000


@dataclass(frozen=True, slots=True)
class Misspelt:
    """*wrong* in place of *right*, both as written, at *line* and *column* (from 1)."""

    wrong: str
    right: str
    line: int
    column: int

    def fix(self, path: str) -> Fix:
        """The right word in the file at *path*."""
        start, end = (self.line, self.column), (self.line, self.column + len(self.wrong))
        return Fix(f"write {self.right}", (Edit(path, start, end, self.right),))


def misspelt(text: str, section: str, key: str) -> Misspelt | None:
    """The misspelt header of *section* in the text of a setup.cfg that has none, or else of the *key* in it; None where nothing is nearly called so."""
    near: Misspelt | None = None
    in_section: Misspelt | None = None
    here, is_there = "", False
    for number, line in enumerate(text.splitlines()[:_MOST], start=1):
        header, entry = _HEADER.match(line), _KEY.match(line)
        if header is not None:
            here = header[1].strip()
            is_there = is_there or here == section
            if near is None and _is_nearly(here, section):
                near = Misspelt(header[0], f"[{section}]", number, 1)
        elif entry is not None and here == section and in_section is None:
            if _is_nearly(entry[1].replace("-", "_"), key):
                in_section = Misspelt(entry[1], key, number, 1)
    return in_section if is_there else near


def _is_nearly(name: str, right: str) -> bool:
    return name != right and (name.lower() == right.lower() or is_slip(name, right))
