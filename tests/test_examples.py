# SPDX-License-Identifier: Apache-2.0
"""The examples' table of seeded defects, held against what the command reports, both ways."""

from __future__ import annotations

import json
import re
import shutil
from pathlib import Path
from typing import Any

import pytest
from commandline import haros

EXAMPLES = Path(__file__).resolve().parent.parent / "examples"
WORKSPACES = ("warehouse_ws", "legacy_ws")
#: The tools that haros-ci brings along. Others that happen to be installed would find more, so they are turned off.
OPTIONAL_TOOLS = "ruff,clang-tidy,catkin_lint"

Row = tuple[str, int, str, tuple[str, ...]]  # file, line, tool:rule, the same from other tools


def documented(workspace: str) -> dict[str, list[Row]]:
    """The rows of the workspace's tables in examples/README.md, by what is to become of them: reported, suppressed."""
    text = (EXAMPLES / "README.md").read_text(encoding="utf-8")
    section = re.split(r"^## ", text, flags=re.MULTILINE)
    [body] = [part for part in section if part.startswith(f"`{workspace}`")]
    rows: dict[str, list[Row]] = {"reported": [], "suppressed": []}
    for line in body.splitlines():
        cells = [cell.strip() for cell in line.strip().strip("|").split("|")]
        if len(cells) == 4 and (place := re.fullmatch(r"`([^`]+)`", cells[0])) and cells[1].isdigit():
            first, *also = re.findall(r"`([^`]+)`", cells[3])
            fate = "suppressed" if "suppressed" in cells[3] else "reported"
            rows[fate].append((place[1], int(cells[1]), first, tuple(also)))
    return {fate: sorted(found) for fate, found in rows.items()}


@pytest.fixture(scope="module", params=WORKSPACES)
def example(request: pytest.FixtureRequest, tmp_path_factory: pytest.TempPathFactory) -> tuple[str, Path]:
    """A copy of one workspace, outside git."""
    copy = tmp_path_factory.mktemp("examples") / request.param
    shutil.copytree(EXAMPLES / request.param, copy)
    return request.param, copy


def check(workspace: Path, *arguments: str) -> tuple[int, dict[str, Any]]:
    done = haros("check", "--output", "json", "--ignore", OPTIONAL_TOOLS, *arguments, cwd=workspace)
    assert done.stdout, done.stderr
    report: dict[str, Any] = json.loads(done.stdout)
    return done.returncode, report


def rows(report: dict[str, Any], *, open: bool) -> list[Row]:
    return sorted(
        (r["path"], r["line"], f"{r['tool']}:{r['rule']}", tuple(r["also"]))
        for r in report["results"]
        if r["open"] is open
    )


def test_the_table_is_what_is_reported(example: tuple[str, Path]) -> None:
    name, copy = example
    code, report = check(copy)
    table = documented(name)
    assert rows(report, open=True) == table["reported"]
    assert rows(report, open=False) == table["suppressed"]
    assert code == 1
    assert [run["tool"] for run in report["runs"] if not run["successful"]] == []


def test_every_suppression_of_a_rule_gives_its_reason(example: tuple[str, Path]) -> None:
    _, report = check(example[1])
    for result in report["results"]:
        for suppression in result["suppressions"]:
            line = (example[1] / result["path"]).read_text(encoding="utf-8")
            assert suppression["justification"] or "haros:ignore-line" in line


def test_the_known_findings_can_be_recorded(example: tuple[str, Path], tmp_path: Path) -> None:
    """Day one of a team with findings: one command, and only what is added from then on counts."""
    copy = tmp_path / example[0]
    shutil.copytree(example[1], copy)
    created = haros("baseline", "create", "--ignore", OPTIONAL_TOOLS, cwd=copy)
    assert created.returncode == 0, created.stderr
    code, report = check(copy)
    assert (code, report["counts"]["open"]) == (0, 0)
    assert report["counts"]["unchanged"] == len(documented(example[0])["reported"])


def test_tool_configuration_is_honoured(tmp_path: Path) -> None:
    """CPPLINT.cfg turns ``runtime/int`` off for the driver; without it the register's C long is reported."""
    copy = tmp_path / "warehouse_ws"
    shutil.copytree(EXAMPLES / "warehouse_ws", copy)
    select = ("--select", "cpplint:runtime/int")
    quiet = rows(check(copy, *select)[1], open=True)
    (copy / "src/conveyor_driver/CPPLINT.cfg").unlink()
    loud = rows(check(copy, *select)[1], open=True)
    gained = set(loud) - set(quiet)
    assert {row[0] for row in gained} == {
        "src/conveyor_driver/include/conveyor_driver/modbus_frame.hpp",
        "src/conveyor_driver/src/modbus_frame.cpp",
    }
    assert {row[2] for row in gained} == {"cpplint:runtime/int"}


def test_the_project_file_is_honoured(tmp_path: Path) -> None:
    """haros.yaml leaves the directory with the vendor's sample and one rule out; without it, and with the rule asked for, both findings are back."""
    copy = tmp_path / "legacy_ws"
    shutil.copytree(EXAMPLES / "legacy_ws", copy)
    known = rows(check(copy)[1], open=True)
    isolated = rows(
        check(
            copy,
            "--isolated",
            "--select",
            "runtime/printf,runtime/explicit,noExplicitConstructor,build/namespaces_headers",
        )[1],
        open=True,
    )
    assert {(row[0], row[2]) for row in set(isolated) - set(known)} == {
        ("src/agv_base/include/agv_base/can_bus.h", "cpplint:build/namespaces_headers"),
        ("src/agv_base/src/sample/can_bus.cpp", "cpplint:runtime/printf"),
    }
