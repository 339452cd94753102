# SPDX-License-Identifier: Apache-2.0
"""Generated monitors for tests, made of texts in HPL."""

from __future__ import annotations

from functools import cache
from typing import Any

from haros_ci.behaviour.parser import parse_property
from haros_ci.monitor_files.classes import Described
from haros_ci.monitoring.patterns import monitor_of
from haros_ci.test_files.monitors import module_of


@cache
def monitor_class(text: str) -> Any:
    """The class of the generated monitor of a property."""
    module = module_of([Described(monitor_of(parse_property(text)), text, text)])
    names: dict[str, Any] = {"__name__": "monitors"}
    exec(compile(module, "monitors.py", "exec"), names)
    return names["Property1"]
