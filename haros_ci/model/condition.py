# SPDX-License-Identifier: Apache-2.0
"""Conditions of manifests (REP 149, "Conditional attributes"): ``$ROS_VERSION == 2 and $ROS_DISTRO != "rolling"``."""

from __future__ import annotations

import re
from collections.abc import Mapping

from haros_ci.regex import regex

MAX_LENGTH = 1_000
MAX_DEPTH = 20

_TOKEN = regex(r"""\s*(?:(==|!=|<=|>=|<|>|\(|\))|\$(\w+)|"([^"]*)"|'([^']*)'|([\w-]+)|(\S))""")
_COMPARE = {
    "==": lambda a, b: a == b,
    "!=": lambda a, b: a != b,
    "<": lambda a, b: a < b,
    "<=": lambda a, b: a <= b,
    ">": lambda a, b: a > b,
    ">=": lambda a, b: a >= b,
}


def evaluate(condition: str, environment: Mapping[str, str]) -> bool | None:
    """Whether *condition* holds; None if it depends on a variable that *environment* lacks, or is malformed.

    Values are compared as text; ``and`` binds closer than ``or``.
    """
    if len(condition) > MAX_LENGTH:
        return None
    parser = _Parser(condition, environment)
    try:
        verdict = parser.disjunction(0)
        return verdict if parser.peek() == ("", "") else None
    except _Malformed:
        return None


class _Malformed(Exception):
    pass


class _Parser:
    """Recursive descent over (kind, text) tokens; kinds are ``operator``, ``variable``, ``text``, ``word``, ``other``."""

    def __init__(self, condition: str, environment: Mapping[str, str]) -> None:
        self._tokens = [_token(match) for match in _TOKEN.finditer(condition)][::-1]
        self._environment = environment

    def peek(self) -> tuple[str, str]:
        return self._tokens[-1] if self._tokens else ("", "")

    def accept(self, *token: str) -> bool:
        if self.peek() != token:
            return False
        self._tokens.pop()
        return True

    def disjunction(self, depth: int) -> bool | None:
        verdict = self.conjunction(depth)
        while self.accept("word", "or"):
            other = self.conjunction(depth)
            verdict = True if verdict or other else (None if None in (verdict, other) else False)
        return verdict

    def conjunction(self, depth: int) -> bool | None:
        verdict = self.comparison(depth)
        while self.accept("word", "and"):
            other = self.comparison(depth)
            verdict = False if False in (verdict, other) else (None if None in (verdict, other) else True)
        return verdict

    def comparison(self, depth: int) -> bool | None:
        if self.accept("operator", "("):
            if depth >= MAX_DEPTH:
                raise _Malformed
            verdict = self.disjunction(depth + 1)
            if not self.accept("operator", ")"):
                raise _Malformed
            return verdict
        left = self.value()
        kind, operator = self.peek()
        if kind != "operator" or operator not in _COMPARE:
            raise _Malformed
        self._tokens.pop()
        right = self.value()
        return None if left is None or right is None else _COMPARE[operator](left, right)

    def value(self) -> str | None:
        kind, text = self.peek()
        if kind not in ("variable", "text", "word"):
            raise _Malformed
        self._tokens.pop()
        return self._environment.get(text) if kind == "variable" else text


def _token(match: re.Match[str]) -> tuple[str, str]:
    operator, variable, double, single, word, other = match.groups()
    if operator is not None:
        return "operator", operator
    if variable is not None:
        return "variable", variable
    if double is not None or single is not None:
        return "text", double if double is not None else single
    return ("word", word) if word is not None else ("other", other)
