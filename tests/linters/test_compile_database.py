# SPDX-License-Identifier: Apache-2.0
"""The compile database of a checkout: a link that leads out of it is not followed; devices and pipes are not opened."""

from __future__ import annotations

import json
import os
from pathlib import Path

import pytest
from linter_samples import workspace

from haros_ci.linters.compile_db import flags_by_file
from haros_ci.linters.linter import LintOptions


def database(place: Path, root: Path) -> Path:
    entry = {"directory": str(root), "file": "a.cpp", "arguments": ["c++", "-DX=1", "a.cpp"]}
    place.parent.mkdir(parents=True, exist_ok=True)
    place.write_text(json.dumps([entry]))
    return place


@pytest.mark.parametrize(
    ("name", "given"),
    [
        ("build/compile_commands.json", None),
        ("compile_commands.json", "compile_commands.json"),
        ("out/x/compile_commands.json", "out/x"),
        ("../elsewhere/compile_commands.json", "../elsewhere"),
    ],
)
def test_a_database_is_read(name: str, given: str | None, tmp_path: Path) -> None:
    root = tmp_path / "checkout"
    space = workspace(root, {"a.cpp": "int a;\n"})
    database(root / name, root)
    assert flags_by_file(space, LintOptions(compile_database=given)) == {"a.cpp": ("-DX=1",)}


def test_a_link_inside_of_the_checkout_is_followed(tmp_path: Path) -> None:
    root = tmp_path / "checkout"
    space = workspace(root, {"a.cpp": "int a;\n"})
    database(root / "out/db.json", root)
    (root / "build").mkdir()
    (root / "build/compile_commands.json").symlink_to("../out/db.json")
    assert flags_by_file(space, LintOptions()) == {"a.cpp": ("-DX=1",)}


@pytest.mark.parametrize("is_directory", [False, True])
@pytest.mark.parametrize("given", [None, "build"])
def test_a_link_out_of_the_checkout_is_not(given: str | None, is_directory: bool, tmp_path: Path) -> None:
    root = tmp_path / "checkout"
    space = workspace(root, {"a.cpp": "int a;\n"})
    out = database(tmp_path / "secret/compile_commands.json", root)
    if is_directory:
        (root / "build").symlink_to(out.parent)
    else:
        (root / "build").mkdir()
        (root / "build/compile_commands.json").symlink_to(out)
    assert flags_by_file(space, LintOptions(compile_database=given)) == {}


def test_a_pipe_is_not_waited_for(tmp_path: Path) -> None:
    root = tmp_path / "checkout"
    space = workspace(root, {"a.cpp": "int a;\n"})
    (root / "build").mkdir()
    os.mkfifo(root / "build/compile_commands.json")
    assert flags_by_file(space, LintOptions()) == {}
