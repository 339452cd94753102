# SPDX-License-Identifier: Apache-2.0
"""The parts of a program: types, expressions, statements; and ways through them."""

from haros_ci import syntax as _syntax
from haros_ci.syntax import *  # noqa: F403 - the public name of the whole room
from haros_ci.syntax.walk import Part, below, everything, preorder

__all__ = ["Part", "below", "everything", "preorder"]
__all__ += _syntax.__all__
