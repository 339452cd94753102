# SPDX-License-Identifier: Apache-2.0
"""``p->m`` and ``(*p).m`` of objects whose own class has ``operator->`` or ``operator*``: smart pointers that the workspace writes itself.

As ``->`` and ``.`` are not distinguished, a member that the class has itself is that.
"""

from __future__ import annotations

from haros_ci.follow import activation, methods
from haros_ci.follow.frames import Frame
from haros_ci.follow.walk import Walk
from haros_ci.values.abstract import Object, Value

#: The operators that lead to what such an object points to; where both are there they lead to the same.
OPERATORS = ("operator->", "operator*")


def led(walk: Walk, frame: Frame, value: Value) -> Object | None:
    """What an object that has no member of some name leads to by its own operator; None if that is not known, or it has none."""
    if not isinstance(value, Object) or value.definition is None or value.definition[0].separator != "::":
        return None
    every = (methods.method_of(walk, value, name, ()) for name in OPERATORS)
    method = next((one for one in every if one is not None and not one.function.parameters), None)
    found = activation.invoke(walk, frame, method, ()) if method is not None else None
    return found if isinstance(found, Object) and found is not value else None
