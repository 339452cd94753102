# SPDX-License-Identifier: Apache-2.0
"""``on_violation`` of a project file: what it says, and what is said of mistakes in it."""

from __future__ import annotations

import pytest

from haros_ci.config.on_violation import MOST_ACTIONS, actions_in
from haros_ci.config.project import read_project
from haros_ci.errors import UserError

HEAD = "configurations:\n  robot:\n    launch: [p/x.launch]\n    hpl:\n"


def read(text: str, name: str = "haros.yaml") -> dict[str, list[dict[str, object]]]:
    return actions_in(read_project((HEAD + text).encode(), name).values["project"], "robot")


@pytest.mark.parametrize("name", [".haros-ci.yaml", "haros.yaml"])
def test_actions_are_data(name: str) -> None:
    text = (
        "      on_violation:\n        stops:\n          - publish: /off\n            type: std_msgs/Bool\n"
        "            message: {data: true}\n        '*': [{log: fatal}, {call: /motors/off}]\n        none: []\n"
    )
    assert read(text, name) == {
        "stops": [{"publish": "/off", "type": "std_msgs/Bool", "message": {"data": True}}],
        "*": [{"log": "fatal"}, {"call": "/motors/off"}],
        "none": [],
    }


@pytest.mark.parametrize("text", ["      properties: []\n", "      on_violation:\n", "      on_violation: {}\n"])
def test_nothing_is_no_action(text: str) -> None:
    assert read(text) == {}


def test_other_configurations_have_their_own() -> None:
    project = read_project((HEAD + "      on_violation: {'*': [{log: info}]}\n").encode(), "haros.yaml").values[
        "project"
    ]
    assert actions_in(project, "other") == {}


@pytest.mark.parametrize("name", [".haros-ci.yaml", "haros.yaml"])
@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("[a]", "'on_violation' of configuration 'robot' must be a map, not a list"),
        ("{a: {log: warn}}", "'a' in 'on_violation' must have a list, not a map"),
        ("{a: [log]}", "an action of 'a' in 'on_violation' must be a map, not a text"),
        ("{a: [{}]}", "an action of 'a' in 'on_violation' must have one of publish, call, log"),
        ("{a: [{publish: /b, call: /c}]}", "an action of 'a' in 'on_violation' must have one of publish, call, log"),
        ("{a: [{publsh: /b}]}", "unknown key 'publsh' in an action of 'a' in 'on_violation'"),
        ("{a: [{publish: b}]}", "'publish' of an action of 'a' in 'on_violation' must be a full name"),
        ("{a: [{call: /b//c}]}", "'call' of an action of 'a' in 'on_violation' must be a full name"),
        ("{a: [{call: '/b\\n'}]}", "'call' of an action of 'a' in 'on_violation' must be a full name"),
        ("{a: [{publish: 3}]}", "'publish' of an action of 'a' in 'on_violation' must be a full name"),
        ("{a: [{log: loud}]}", "'log' of an action of 'a' in 'on_violation' must be info, warn, error, fatal, and alone"),
        ("{a: [{log: warn, type: b/C}]}", "'log' of an action of 'a' in 'on_violation' must be info, warn, error, fatal, and alone"),
        ("{a: [{publish: /b, type: Empty}]}", "'type' of an action of 'a' in 'on_violation' must be a type"),
        ("{a: [{publish: /b, message: [1]}]}", "'message' of an action of 'a' in 'on_violation' must be a map of fields"),
        (f"{{a: [{', '.join(['{log: info}'] * (MOST_ACTIONS + 1))}]}}", f"'on_violation' of configuration 'robot' has more than {MOST_ACTIONS} actions"),
    ],
)  # fmt: skip
def test_mistakes(text: str, message: str, name: str) -> None:
    with pytest.raises(UserError) as caught:
        read(f"      on_violation: {text}\n", name)
    assert str(caught.value).partition(": ")[2] == message
    assert str(caught.value).startswith(f"{name}:5")
