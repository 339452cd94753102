# SPDX-License-Identifier: Apache-2.0
"""Whether a word can be a rule of a tool whose tables are not complete: newer versions and plug-ins bring rules of their own."""

from __future__ import annotations

import re
from functools import cache
from types import MappingProxyType
from typing import Final

from haros_ci.linters.catalogue import TOOLS, rules_of
from haros_ci.model.slips import nearly

_WORDS = r"[a-z][a-z0-9]*(-[a-z0-9]+)*"
#: How the ids of a tool are formed.
_FORMS: Final = MappingProxyType(
    {
        "bandit": r"B[0-9]{3}",
        "catkin_lint": r"[A-Za-z]+(_[A-Za-z0-9]+)*",
        "clang-tidy": r"[a-z]+(-[A-Za-z0-9_+.=]+)+",
        "cppcheck": r"[A-Za-z][A-Za-z0-9_.-]*",
        "flake8": r"[A-Z]{1,4}[0-9]{1,4}",
        "flawfinder": r"FF[0-9]{4}",
        "hadolint": r"(DL|SC)[0-9]{4}",
        "mypy": _WORDS,
        "pylint": _WORDS,
        "ruff": r"[A-Z]+[0-9]{3,4}",
        "shellcheck": r"SC[0-9]{4}",
    }
)
#: Tools whose ids are words, of which one that is nearly another is a slip; of two numbers that cannot be said.
_NAMED: Final = frozenset({"catkin_lint", "clang-tidy", "cppcheck", "mypy", "pylint"})
#: Tools whose plug-ins bring codes of any letters.
_PLUGGED: Final = frozenset({"flake8"})
#: Beginnings behind which anything may stand: the warnings of a compiler.
_OPEN: Final = MappingProxyType({"clang-tidy": "clang-diagnostic-"})
#: What to say of ids in another form, where there is no near miss.
_BY: Final = MappingProxyType(
    {
        "pylint": "pylint's rules go by their symbols, as in 'pylint:unused-import'",
        "ruff": "ruff's rules go by their codes, as in 'ruff:F401'",
        "flake8": "flake8's rules go by their codes, as in 'flake8:F401'",
    }
)
_LETTERS = "ABCDEFGHIJKLMNOPQRSTUVWXYZ"


@cache
def identifiers(tool: str) -> frozenset[str]:
    """Every id of *tool* that is known: those of its table, and of the list of the tool itself, where the table is a part of it."""
    known = frozenset(rules_of(tool)) if tool in TOOLS else frozenset()
    if tool == "ruff":
        from haros_ci.linters.catalogue.ruff_codes import CODES

        return known | CODES
    if tool == "clang-tidy":
        from haros_ci.linters.catalogue.clang_tidy_names import NAMES

        return known | NAMES
    return known | {name.upper() for name in known} if tool == "catkin_lint" else known


def doubt(tool: str, identifier: str) -> tuple[bool, str] | None:
    """What is to be said against *identifier* as a rule of *tool*: whether it must be a mistake, and a help text or "".

    None where nothing is: it is known, or nothing is known of the tool. A mistake is what has not the form of the tool's ids, and a
    word that is nearly a known one. Anything else may be a rule of a version or plug-in that the lists do not have.
    """
    known = identifiers(tool)
    form = _FORMS.get(tool)
    if form is None or identifier in known or identifier.startswith(_OPEN.get(tool, "\n")):
        return None
    if not re.fullmatch(form, identifier):
        return True, _help(tool, identifier, known)
    if tool == "ruff" and _family(identifier) not in _families():
        return True, _help(tool, identifier, known)
    if tool in _PLUGGED:
        return None
    near = nearly(identifier, known) if tool in _NAMED else None
    if near is not None:
        return True, f"did you mean '{tool}:{near}'?"
    if any(name.startswith((f"{identifier}-", f"{identifier}_")) for name in known):
        return True, _help(tool, identifier, known)
    return False, ""


def _family(code: str) -> tuple[str, int]:
    letters = code.rstrip("0123456789")
    return letters, len(code) - len(letters)


@cache
def _families() -> frozenset[tuple[str, int]]:
    return frozenset(map(_family, identifiers("ruff")))


def _help(tool: str, identifier: str, known: frozenset[str]) -> str:
    if len(identifier) > 1 or tool == "ruff":
        if any(name.startswith(identifier) for name in known):
            return f"'{tool}:{identifier}*' names all whose id begins so"
    same = (
        n for n in sorted(known) if identifier and (n.lower() == identifier.lower() or n.lstrip(_LETTERS) == identifier)
    )
    near = next(same, None) or nearly(identifier, known)
    return f"did you mean '{tool}:{near}'?" if near else _BY.get(tool, "")


__all__ = ["doubt", "identifiers"]
