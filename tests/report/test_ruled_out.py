# SPDX-License-Identifier: Apache-2.0
"""What cannot be made as things are: marked where each endpoint stands, and in no count, topic or drawing."""

from __future__ import annotations

import sqlite3
from dataclasses import replace
from pathlib import Path

import pytest
from test_model_json import BASE, ODOM, ROBOT

from haros_ci.model.architecture import Architecture, Configuration
from haros_ci.report import channels, model_dot, model_json, model_mermaid, model_sqlite, model_text


def configuration(is_ruled_out: bool) -> Configuration:
    ends = (replace(ODOM, is_ruled_out=is_ruled_out), replace(ODOM, name="/always", original_name="/always"))
    return replace(ROBOT, nodes=(replace(BASE, endpoints=ends),))


@pytest.mark.parametrize(
    ("is_ruled_out", "names", "count"), [(False, ["/always", ODOM.name], 2), (True, ["/always"], 1)]
)
def test_it_connects_nothing_and_is_not_counted(is_ruled_out: bool, names: list[str], count: int) -> None:
    found = configuration(is_ruled_out)
    assert [each.name for each in channels.channels(found)] == names
    assert model_text.gaps(found).endpoints == count
    assert f"{count} publisher" in model_text.render(Architecture(configurations=(found,)))


@pytest.mark.parametrize("render", [model_dot.render, model_mermaid.render])
def test_it_is_not_drawn(render: object) -> None:
    drawn = [render(Architecture(configurations=(configuration(each),))) for each in (False, True)]  # type: ignore[operator]
    assert [ODOM.name in text for text in drawn] == [True, False]


def test_it_is_marked_as_data(tmp_path: Path) -> None:
    found = Architecture(configurations=(configuration(True),))
    assert model_json.render(found).count('"ruled_out": true') == 1
    file = tmp_path / "model.db"
    file.write_bytes(model_sqlite.render(found))
    database = sqlite3.connect(file)
    try:
        rows = database.execute("SELECT name, ruled_out FROM endpoints ORDER BY name").fetchall()
    finally:
        database.close()
    assert rows == [("/always", 0), (ODOM.name, 1)]
