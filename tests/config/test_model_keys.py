# SPDX-License-Identifier: Apache-2.0
"""What a project file says for the architecture: API rows, known nodes, arguments and environment of launch files."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from haros_ci.config.describe import describe
from haros_ci.config.load import load
from haros_ci.config.project import read_project
from haros_ci.errors import UserError
from haros_ci.model.api import load_row

FILE = """\
configurations:
  hall:
    launch: [agv/launch/all.launch]
    args: {vehicle: agv_3, speed: 1.5, sim: true}
    environment: {ROBOT: agv}
    hints: {nodes: {/base: {args: -v}}}
  depot: [agv/launch/depot.launch]
nodes: {agv/base: {fix: {advertise@name1: /odom}}}
apis:
  - call: agv::advertise
    args: [2]
    when: {1: std::string}
    makes:
      - {kind: publishers, name: "status/{1}", type: "{<0>}", queue_size: 1, latched: true, namespace: "{0}"}
  - {class: agv::Nodelet, bases: [nodelet::Nodelet], entry: [onInit]}
known_nodes:
  acme_arm: {arm_driver: {publishers: [{name: joint_states, type: sensor_msgs/JointState}]}}
"""


@pytest.mark.parametrize("name", ["haros.yaml", ".haros-ci.yaml"])
def test_the_data_is_kept_as_it_stands(name: str) -> None:
    read = read_project(FILE.encode(), name)
    assert read.notes == ()
    project = read.values["project"]
    assert project["configurations"]["hall"]["args"] == {"vehicle": "agv_3", "speed": 1.5, "sim": True}
    assert project["configurations"]["hall"]["environment"] == {"ROBOT": "agv"}
    assert project["configurations"]["depot"] == ["agv/launch/depot.launch"]
    assert project["known_nodes"]["acme_arm"]["arm_driver"]["publishers"][0]["name"] == "joint_states"
    assert [load_row(row).call for row in project["apis"]] == ["agv::advertise", "agv::Nodelet"]


def test_the_settings_show_what_the_model_is_made_with(tmp_path: Path) -> None:
    (tmp_path / "haros.yaml").write_text(FILE, encoding="utf-8")
    lines = describe(load(tmp_path)).splitlines()
    start = lines.index('configurations: ["hall", "depot"]  # haros.yaml:1')
    assert lines[start + 1 : start + 4] == [
        'nodes: ["agv/base"]  # haros.yaml:8',
        'known_nodes: ["acme_arm"]  # haros.yaml:16',
        'apis: ["agv::advertise", "agv::Nodelet"]  # haros.yaml:9',
    ]


ROW = "docs/adding-an-api.md has examples"
ARGS = "write args: {robot: kobuki}, and '' for an empty text"


@pytest.mark.parametrize(
    ("text", "message", "help"),
    [
        (
            "apis: {call: a}",
            "1: 'apis' must be a list, not a map",
            "write apis: [{call: 'robot::advertise', args: [1], makes: […]}]",
        ),
        ("apis:\n  - a", "2: row 1 of 'apis': a row is a map with a 'call', not a text", ROW),
        ("apis:\n  - {call: a}\n  -", "3: row 2 of 'apis': a row is a map with a 'call', not empty", ROW),
        (
            "apis:\n  - args: [1]",
            "2: row 1 of 'apis': a row names either a 'call' (function, method or constructor) or a 'class'",
            ROW,
        ),
        ("apis:\n  - call: a\n    args: [x]", "3: row 1 of 'apis': 'args' is a list of numbers of arguments", ROW),
        (
            "apis:\n  - call: a\n    makes:\n      - kind: node\n      - kind: publishers\n        name: {0}",
            "5: row 1 of 'apis': 'name' is text; put it in quotes",
            ROW,
        ),
        (
            "apis:\n  - call: a\n    makes: [{kind: publisher}]",
            "3: row 1 of 'apis': 'kind' is one of publishers, subscribers, servers, clients, action_servers, "
            "action_clients, getters, setters, parameters, handle, node, rate, timer",
            ROW,
        ),
        (
            "apis:\n  - call: a\n    returns: '{}'",
            "3: row 1 of 'apis': '' selects nothing; write for example {0}, {<0>}, {latch?false}, {callback(2)}",
            ROW,
        ),
        ("apis: [{call: a, makes: [{1: a, b: c}]}]", "1: row 1 of 'apis': key 1 must be text", ROW),
        ("apis: [{call: a, 1: b, c: d}]", "1: row 1 of 'apis': key 1 must be text", ROW),
        (
            f"apis: [{{call: a, returns: {'|' * 501!r}}}]",
            "1: row 1 of 'apis': a text has more than 500 characters",
            ROW,
        ),
        (
            f"apis: [{{call: a, sets: {{{'x' * 501}: b}}}}]",
            "1: row 1 of 'apis': a key has more than 500 characters",
            ROW,
        ),
        ("apis: [" + "{call: a}," * 1001 + "]", "1: 'apis' has more than 1000 rows", "leave out what is not called"),
        (
            "known_nodes: [a]",
            "1: 'known_nodes' must be a map, not a list",
            "write known_nodes: {package: {executable: {publishers: […]}}}",
        ),
        (
            "configurations:\n  a:\n    launch: [p/x]\n    args:\n      robot:",
            "5: 'robot' in 'args' of configuration 'a' must be text, a number, true or false, not empty",
            ARGS,
        ),
        (
            "configurations: {a: {launch: [p/x], args: {robot: [b]}}}",
            "1: 'robot' in 'args' of configuration 'a' must be text, a number, true or false, not a list",
            ARGS,
        ),
        (
            "configurations: {a: {launch: [p/x], environment: copy}}",
            "1: 'environment' of configuration 'a' must be a map, not a text",
            "write environment: {ROBOT: kobuki}",
        ),
    ],
)
@pytest.mark.parametrize("name", ["haros.yaml", ".haros-ci.yaml"])
def test_wrong(name: str, text: str, message: str, help: str) -> None:
    with pytest.raises(UserError) as caught:
        read_project(text.encode(), name)
    assert (caught.value.message, caught.value.help) == (f"{name}:{message}", help)


def test_a_misspelt_key_of_a_configuration() -> None:
    text = b"configurations: {a: {launch: [p/x], arg: {b: c}}}"
    with pytest.raises(UserError) as caught:
        read_project(text, ".haros-ci.yaml")
    assert (caught.value.message, caught.value.help) == (".haros-ci.yaml:1: unknown key 'arg'", "did you mean 'args'?")


@pytest.mark.parametrize("page", ["adding-an-api.md", "known-nodes.md"])
def test_the_examples_of_other_pages_are_read(page: str) -> None:
    text = (Path(__file__).parents[2] / "docs" / page).read_text(encoding="utf-8")
    examples = re.findall(r"```yaml\n(.*?)```", text, re.DOTALL)
    assert examples
    for example in examples:
        assert read_project(example.encode(), ".haros-ci.yaml").notes == ()
