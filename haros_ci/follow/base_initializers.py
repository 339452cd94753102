# SPDX-License-Identifier: Apache-2.0
"""The initialisers of a constructor of C++ that are meant for base classes."""

from __future__ import annotations

from haros_ci import syntax
from haros_ci.follow.frames import Frame
from haros_ci.follow.walk import Walk
from haros_ci.syntax import Class, Function


def by_another_name(walk: Walk, inner: Frame, definition: Class, base: str) -> syntax.Initializer | None:
    """The initialiser of a *base* under an alias or macro: ``Base(name)`` where ``using Base = rclcpp::Node``."""
    members = {member.name for member in definition.fields}
    for init in inner.function.inits if inner.function is not None else ():
        written = init.type if init.type.name else syntax.Type(init.name)
        if init.name not in members and walk.type_in(written, inner).name == base:
            return init
    return None


def is_of_base(walk: Walk, inner: Frame, function: Function, name: str) -> bool:
    """Whether what a constructor initialises under the last part of its own class's *name* is a base of that name."""
    last = name.rpartition("::")[2]
    written = next(init for init in function.inits if init.name.rpartition("::")[2] == last)
    qualified = written.name if "::" in written.name else written.type.name
    head = qualified.rpartition("::")[0].partition("<")[0]
    if head.rpartition("::")[2] == last:  # C::C, C<T>::C
        qualified = head
    return "::" in qualified and walk.type_in(syntax.Type(qualified), inner).name != name
