# SPDX-License-Identifier: Apache-2.0
"""Messages of pylint that the text around them refutes.

Pylint does not see what a decorator does that is not installed, nor why a name stands alone.
"""

from __future__ import annotations

import re

#: Decorators that leave a function's parameters as they are, by their last name.
_HARMLESS = frozenset(
    "staticmethod classmethod property abstractmethod override final overload cache cached_property lru_cache wraps contextmanager"
    " asynccontextmanager total_ordering deprecated".split()
)
_CALLEE = re.compile(r"(\w+)[ \t]*\(")
_DECORATED = re.compile(r"^([ \t]*)@[ \t]*([\w.]+)")
_DEFINITION = re.compile(r"^[ \t]*(?:async[ \t]+)?def[ \t]+(\w+)")
#: The idiom of ROS 2's tutorials: ``self.subscription  # prevent unused variable warning``.
_KEPT = re.compile(r"#.*\b(?:unused|warnings?|lint\w*|pylint|flake8|noqa|keep|reference)\b", re.IGNORECASE)
#: What is evaluated to see whether it raises.
_RAISING = re.compile(
    r"\s*(?:async\s+)?with\b.*\b(?:raises|assertRaises\w*|warns|assertWarns\w*|suppress|deprecated_call)\b|\s*try\s*:"
)


def is_refuted(rule: str, line: int, column: int, text: str) -> bool:
    """Whether the *text* refutes what pylint says by *rule* at *line*, counted from 1, and *column*, from 0."""
    if rule == "no-value-for-parameter":
        return _is_decorated(text, line, column)
    if rule == "pointless-statement":
        return _is_on_purpose(text, line)
    return False


def _is_decorated(text: str, line: int, column: int) -> bool:
    """Whether the function that is called there has a decorator here that may give it arguments (click, hydra, mock)."""
    lines = text.split("\n")
    called = _CALLEE.search(lines[line - 1], column) if 0 < line <= len(lines) else None
    if called is None:
        return False
    waiting: list[str] = []
    for each in lines:
        decorator, definition = _DECORATED.match(each), _DEFINITION.match(each)
        if decorator:
            waiting.append(decorator[2].rpartition(".")[2])
        elif definition:
            if definition[1] == called[1] and not _HARMLESS.issuperset(waiting):
                return True
            waiting = []
        elif each.lstrip().startswith("class "):
            waiting = []
    return False


def _is_on_purpose(text: str, line: int) -> bool:
    """Whether a comment says so, or a block around it waits for what is raised."""
    lines = text.split("\n")
    if not 0 < line <= len(lines):
        return False
    here = lines[line - 1]
    if _KEPT.search(here):
        return True
    indent = len(here) - len(here.lstrip())
    for above in reversed(lines[max(line - 50, 0) : line - 1]):
        if above.strip() and len(above) - len(above.lstrip()) < indent:
            return bool(_RAISING.match(above))
    return False
