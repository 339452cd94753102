# SPDX-License-Identifier: Apache-2.0
"""Places of a Python launch file that only some ROS distributions reach: the file asks for ``ROS_DISTRO`` before."""

from __future__ import annotations

import ast
from functools import lru_cache

from haros_ci.checking.branches import Span, branches, is_in, parsed
from haros_ci.model.location import Location

_VARIABLE = "ROS_DISTRO"


def depends_on_distribution(text: str, location: Location) -> bool:
    """Whether the line of *location* in the Python file *text* stands in a branch or under a ``condition=`` that compares ``ROS_DISTRO``.

    ROS sets the variable to the name of the distribution (REP 149).
    """
    return is_in(_spans(text), location)


@lru_cache(maxsize=64)
def _spans(text: str) -> tuple[Span, ...]:
    tree = parsed(text) if _VARIABLE in text else None
    return () if tree is None else branches(tree, _is_variable)


def _is_variable(node: ast.AST) -> bool:
    return isinstance(node, ast.Constant) and node.value == _VARIABLE
