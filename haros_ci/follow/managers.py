# SPDX-License-Identifier: Apache-2.0
"""Python: context managers, whose methods a ``with`` calls."""

from __future__ import annotations

from haros_ci.follow import activation, call_arguments, methods
from haros_ci.follow.frames import Frame
from haros_ci.follow.walk import Walk
from haros_ci.values.abstract import NONE, Known, Object, Sequence, Value

#: What a ``with`` calls at its beginning, and at its end.
METHODS = frozenset(("__enter__", "__exit__"))


def called(walk: Walk, frame: Frame, receiver: Value, name: str) -> Value:
    """The beginning or end of a ``with``: what the class of the workspace does there; anything else is there itself.

    What a function with ``@contextmanager`` yields is the list of it here.
    """
    method = methods.method_of(walk, receiver, name) if isinstance(receiver, Object) else None
    if method is not None:
        args = tuple(call_arguments.PassedArgument(NONE) for _ in method.function.parameters)
        return activation.invoke(walk, frame, method, args)
    if (
        name == "__enter__"
        and isinstance(receiver, Known)
        and isinstance(receiver.value, list)
        and len(receiver.value) == 1
    ):
        return Known(receiver.value[0])
    cells = receiver.content.value if isinstance(receiver, Sequence) else ()
    if name == "__enter__" and isinstance(cells, tuple) and len(cells) == 1:
        found: Value = cells[0].value
        return found
    return receiver
