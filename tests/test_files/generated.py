# SPDX-License-Identifier: Apache-2.0
"""Generated monitors for tests, made of texts in HPL."""

from __future__ import annotations

from functools import cache
from typing import Any

from haros_ci.behaviour.parser import parse_property
from haros_ci.monitor_files.classes import Described
from haros_ci.monitor_files.core import IMPORTS, core_text
from haros_ci.monitoring.patterns import monitor_of


@cache
def monitor_class(text: str) -> Any:
    """The class of the generated monitor of a property."""
    core, _ = core_text([Described(monitor_of(parse_property(text)), text, text)])
    names: dict[str, Any] = {"__name__": "monitors"}
    exec(compile(f"from __future__ import annotations\n{IMPORTS}\n{core}", "monitors.py", "exec"), names)
    return names["Property1"]
