# SPDX-License-Identifier: Apache-2.0
"""What docs/generated-monitor.md shows is what is written and read."""

from __future__ import annotations

import re
from pathlib import Path

from monitor_files.test_core import text_of

from haros_ci.behaviour.parser import parse_property
from haros_ci.config.on_violation import actions_in
from haros_ci.config.project import read_project
from haros_ci.monitor_files.classes import Described, class_text
from haros_ci.monitoring.patterns import monitor_of

PAGE = (Path(__file__).resolve().parents[2] / "docs" / "generated-monitor.md").read_text(encoding="utf-8")


def test_the_class() -> None:
    (shown,) = re.findall(r"```python\n(.*?)```", PAGE, re.DOTALL)
    text = "globally: /stop {data} causes /wheels {data = 0} within 200 ms"
    assert class_text("Property1", Described(monitor_of(parse_property(text)), "stops", text)) == shown


def test_the_actions() -> None:
    (shown,) = re.findall(r"```yaml\n(.*?)```", PAGE, re.DOTALL)
    actions = actions_in(read_project(shown.encode(), "haros.yaml").values["project"], "robot")
    assert {name: [sorted(action) for action in every] for name, every in actions.items()} == {
        "stops": [["publish", "type"], ["log"]],
        "*": [["call", "type"]],
    }


def test_the_core_has_what_the_page_names() -> None:
    made = text_of("globally: no /a")
    named = re.findall(r"`(\w+)\((?:topic, message, )?(?:time)?\)`", PAGE)
    assert {"start", "on_message", "on_timer", "deadline", "finish"} <= {*named}
    assert all(f"def {name}(self" in made for name in named)
