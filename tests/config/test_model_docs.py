# SPDX-License-Identifier: Apache-2.0
"""docs/model.md and docs/features.md: what they show of ``haros-ci model`` is what it prints for examples/legacy_ws."""

from __future__ import annotations

import json
import re
import shlex
import shutil
import sqlite3
import subprocess
from pathlib import Path

import pytest
from commandline import haros

from haros_ci.config.load import load

ROOT = Path(__file__).resolve().parents[2]
PAGE = (ROOT / "docs" / "model.md").read_text(encoding="utf-8")
FEATURES = (ROOT / "docs" / "features.md").read_text(encoding="utf-8")


def fences(marker: str, page: str = PAGE) -> list[tuple[str, str]]:
    """(argument, text of the fence below it) for each ``<!-- marker: argument -->``."""
    return re.findall(rf"<!-- {marker}: (.+?) -->\n```\w*\n(.*?)```", page, re.S)


@pytest.fixture(scope="module")
def workspace(tmp_path_factory: pytest.TempPathFactory) -> Path:
    copy = tmp_path_factory.mktemp("model") / "ws"
    shutil.copytree(ROOT / "examples" / "legacy_ws", copy)
    for name, text in fences("file"):
        (copy / name).write_text(text, encoding="utf-8")
    return copy


def run(command: str, workspace: Path) -> subprocess.CompletedProcess[str]:
    words = shlex.split(command)
    assert words[:2] == ["haros-ci", "model"]
    return haros(*words[1:], cwd=workspace)


SHOWN = [
    *((command, text, 0) for command, text in fences("run")),
    *((command.partition(" (")[0], text, 0) for command, text in fences("model", FEATURES)),
    *((command, text, 1) for command, text in fences("run 1")),
]


@pytest.mark.parametrize(("command", "text", "code"), SHOWN, ids=[command for command, _, _ in SHOWN])
def test_what_is_shown_is_what_is_printed(command: str, text: str, code: int, workspace: Path) -> None:
    done = run(command, workspace)
    assert (done.stdout, done.stderr, done.returncode) == (text, "", code)


@pytest.mark.parametrize(("command", "text"), fences("stderr"))
def test_what_is_warned_of(command: str, text: str, workspace: Path) -> None:
    assert run(command, workspace).stderr == text


def test_the_query(workspace: Path) -> None:
    ((name, query),) = fences("sql")
    ((_, rows),) = fences("rows")
    run(f"haros-ci model --format sqlite --output {name}", workspace)
    database = sqlite3.connect(workspace / name)
    try:
        assert [row for (row,) in database.execute(query)] == rows.splitlines()
    finally:
        database.close()


def test_the_project_files_are_right(tmp_path: Path) -> None:
    for name, text in fences("file"):
        if name != "expected.yaml":
            (tmp_path / name).write_text(text, encoding="utf-8")
            assert load(tmp_path, project=tmp_path / name).notes == ()


def a_condition(place: Path) -> object:
    """A condition as it is printed."""
    (place / "package.xml").write_text("<package><name>p</name><version>1.0.0</version></package>")
    script = """#!/usr/bin/env python3
import sys
import rospy
rospy.init_node("n")
if sys.platform:
    rospy.Publisher("a", None, queue_size=1)
"""
    (place / "node").write_text(script)
    document = json.loads(run("haros-ci model --format json", place).stdout)
    return document["configurations"][0]["nodes"][0]["publishers"][0]["conditions"][0]


def test_the_table_has_the_keys_as_printed(workspace: Path, tmp_path: Path) -> None:
    document = json.loads(run("haros-ci model --format json --project hints.yaml", workspace).stdout)
    table = dict(re.findall(r"^\| (\w[^|]*) \| (`.*`) \|$", PAGE[PAGE.index("## JSON") :], re.M))
    configuration = document["configurations"][0]
    node = configuration["nodes"][0]
    shown = {
        "the document": document,
        "a configuration": configuration,
        "a node": node,
        "a parameter": configuration["parameters"][0],
        "a topic": configuration["topics"][0],
        "a condition": a_condition(tmp_path),
        "a location": node["location"],
        "a package": document["packages"][0],
    }
    for what, found in shown.items():
        assert re.findall(r"`(\w+)`", table[what]) == list(found), what
    ends = re.search(r"^\| an endpoint \| (.*) \|$", PAGE, re.M)
    assert ends
    common = re.findall(r"`(\w+)`", ends[1].partition(";")[0])
    assert set(node["publishers"][0]) == {*common, "queue_size", "latched", "qos"}
    assert set(node["subscribers"][0]) == {*common, "queue_size", "qos"}
    assert set(node["getters"][0]) == {*common, "value"}


def test_the_environment_of_a_configuration(workspace: Path) -> None:
    ours = json.loads(run("haros-ci model --format json --project depot.yaml", workspace).stdout)
    (speed,) = (p for p in ours["configurations"][0]["parameters"] if p["name"] == "/agv_9/teleop/max_speed")
    assert speed["value"] == 1.2
