# SPDX-License-Identifier: Apache-2.0
"""Python: context managers that ``contextlib.contextmanager`` makes of functions that yield."""

from __future__ import annotations

from haros_ci import syntax
from haros_ci.syntax import Function

MANAGER = "contextmanager"
#: What a generator returns as it is read: the list of what it yields.
YIELDED = syntax.Name("[yielded]")


def is_manager(decorator: str, function: Function) -> bool:
    """Whether a decorator of that name makes a context manager of a generator that is read as one that returns what it yields."""
    last = function.body[-1] if function.body else None
    return decorator == MANAGER and isinstance(last, syntax.Return) and last.value == YIELDED
