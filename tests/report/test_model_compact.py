# SPDX-License-Identifier: Apache-2.0
"""The compact model: it says what the plain one says, byte for byte once it is expanded."""

from __future__ import annotations

import json
from dataclasses import replace
from pathlib import Path

import pytest
from commandline import haros
from interface_samples import SYSTEM
from test_model_json import HOSTILE, ODOM, SAMPLE

from haros_ci.api.reports import expand_model
from haros_ci.model.architecture import Architecture, Configuration, Endpoint, Node
from haros_ci.report import model_compact, model_json

EXAMPLES = Path(__file__).resolve().parents[2] / "examples"


def node(*ends: Endpoint) -> Node:
    """A node with these endpoints."""
    return Node(name="/n", kind="node", package="p", type="t", location=None, endpoints=ends)


def read(value: object) -> Endpoint:
    """A getter with this default."""
    return Endpoint(kind="getters", name="/n/x", original_name="/n/x", type=None, location=None, value=value)


@pytest.mark.parametrize("example", [path.name for path in sorted(EXAMPLES.iterdir()) if path.is_dir()])
def test_an_example_is_expanded_to_the_same_bytes(example: str, tmp_path: Path) -> None:
    plain, compact = tmp_path / "plain.json", tmp_path / "compact.json"
    for path, more in ((plain, []), (compact, ["--compact"])):
        done = haros("model", "--isolated", "--format", "json", *more, "--output", str(path), cwd=EXAMPLES / example)
        assert done.returncode == 0, done.stderr
    assert expand_model(compact.read_bytes()).encode() == plain.read_bytes()
    assert compact.read_bytes().count(b"\n") == 1 and len(compact.read_bytes()) <= len(plain.read_bytes()) + 200


@pytest.mark.parametrize(
    "architecture",
    [
        SYSTEM,
        SAMPLE,
        Architecture(configurations=()),
        Architecture(configurations=(Configuration(name=HOSTILE, nodes=(node(replace(ODOM, name=HOSTILE)),)),)),
        Architecture(configurations=tuple(Configuration(name=name, nodes=SAMPLE.configurations[0].nodes) for name in "ab")),
    ],
)  # fmt: skip
def test_a_model_is_expanded_to_the_same_bytes(architecture: Architecture) -> None:
    text = model_compact.render(architecture)
    assert expand_model(text) == model_json.render(architecture)
    assert text.isascii() and "##[" not in text


def test_what_two_configurations_have_stands_once() -> None:
    both = Architecture(configurations=tuple(Configuration(name=name, nodes=(node(ODOM),)) for name in "ab"))
    document = json.loads(model_compact.render(both))
    assert [each["nodes"] for each in document["configurations"]] == [[0], [0]]
    assert [each["topics"] for each in document["configurations"]] == [[0], [0]]
    assert len(document["tables"]["nodes"]) == len(document["tables"]["endpoints"]) == 1
    assert document["tables"]["nodes"][0]["publishers"] == [0]
    assert (document["schema_version"], document["compact"]) == (1, 1)


def test_values_that_are_equal_and_not_the_same_stay_apart() -> None:
    values = [1, 1.0, True, 0.0, -0.0, 0, False, "1", None, [1], [True], {"a": 1}, {"a": 1.0}]
    made = Architecture(configurations=(Configuration(name="a", nodes=tuple(node(read(value)) for value in values)),))
    (configuration,) = json.loads(model_json.render(made))["configurations"]
    assert [repr(each["getters"][0]["value"]) for each in configuration["nodes"]] == list(map(repr, values))
    assert expand_model(model_compact.render(made)) == model_json.render(made)


@pytest.mark.parametrize("text", ["{", "[]", "{}", '{"compact": 2}', '{"compact": 1}', "3"])
def test_what_is_no_compact_model_is_refused(text: str) -> None:
    with pytest.raises(ValueError, match="."):
        expand_model(text)


@pytest.mark.parametrize("place", [-1, 1, True, "0"])
def test_a_place_that_is_in_no_table_is_refused(place: object) -> None:
    document = json.loads(
        model_compact.render(Architecture(configurations=(Configuration(name="a", nodes=(node(ODOM),)),)))
    )
    document["configurations"][0]["nodes"] = [place]
    with pytest.raises(ValueError, match="place"):
        expand_model(json.dumps(document))


def test_compact_is_for_json(tmp_path: Path) -> None:
    done = haros("model", "--compact", cwd=EXAMPLES / "legacy_ws")
    assert done.returncode == 2 and "--compact is for json, not text" in done.stderr
