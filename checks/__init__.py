# SPDX-License-Identifier: Apache-2.0
"""ROS architecture checks, one module and one page each; installed as haros_ci_checks. Each module offers a ``CHECK``."""

from __future__ import annotations

from importlib import import_module
from pkgutil import iter_modules

from haros_ci.api import Check

#: All checks, by name of their modules.
CHECKS: tuple[Check, ...] = tuple(
    import_module(f"{__name__}.{name}").CHECK for name in sorted(module.name for module in iter_modules(__path__))
)
