# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from pathlib import Path

import pytest
import yaml as pyyaml

from haros_ci.config.project import read_project
from haros_ci.registry import LINTERS
from haros_ci.starting.files import project, workflow
from haros_ci.starting.files import yaml as scalar
from haros_ci.starting.seen import CONFIGURED, GENERATED, Seen, look
from haros_ci.workspace.discover import discover

NOTHING = Seen(packages=(), lines=(("cpp", 0), ("python", 0)))


def seen(root: Path, *paths: str, tops: dict[str, str] | None = None) -> Seen:
    for path in paths:
        (root / path).parent.mkdir(parents=True, exist_ok=True)
        (root / path).write_text("int a;\n")
    tops = tops or {}
    return look(discover(root, (".",)), tops.keys(), lambda name: tops[name])


@pytest.mark.parametrize(
    ("path", "directory"),
    [
        ("src/third_party/a.cpp", "src/third_party"),
        ("vendor/lib/vendor/a.py", "vendor"),
        ("x/ThirdParty/a.hpp", "x/ThirdParty"),
        ("3rdparty/a/b/c.c", "3rdparty"),
    ],
)
def test_other_peoples_code_is_left_out(tmp_path: Path, path: str, directory: str) -> None:
    assert seen(tmp_path, path, "src/own.cpp").vendored == (directory,)


@pytest.mark.parametrize(
    "path",
    [
        "src/vendor.cpp",
        "src/vendor_tools/a.cpp",
        "external/a.cpp",
        "third_party/README.md",
        "party/a.py",
        "my_vendor/a.py",
    ],
)
def test_own_code_is_not_left_out(tmp_path: Path, path: str) -> None:
    assert seen(tmp_path, path, "src/own.cpp").vendored == ()


@pytest.mark.parametrize(
    ("path", "globs"),
    [
        ("a/x_pb2.py", ("*_pb2.py",)),
        ("a/ui_panel.h", ("ui_*.h",)),
        ("a/pb2.py", ()),
        ("a/gui_panel.h", ()),
        ("vendor/x_pb2.py", ()),
        ("a/x_generated.txt", ()),
    ],
)
def test_generated_code_is_left_out_where_there_is_some(tmp_path: Path, path: str, globs: tuple[str, ...]) -> None:
    assert seen(tmp_path, path).generated == globs


@pytest.mark.parametrize(
    ("tops", "tools"),
    [
        ({".clang-format": ""}, ["clang-format"]),
        ({"setup.cfg": "[flake8]\nmax-line-length = 99\n"}, ["flake8"]),
        ({"pyproject.toml": "[tool.black]\n[tool.isort]\n"}, ["black", "isort"]),
        ({"setup.cfg": "[metadata]\nname = x\n"}, []),
        ({"pyproject.toml": "[build-system]\n"}, []),
        ({"package.xml": "<package/>"}, []),
    ],
)
def test_tools_with_settings(tmp_path: Path, tops: dict[str, str], tools: list[str]) -> None:
    assert [tool for tool, _ in seen(tmp_path, "a.cpp", tops=tops).tools] == tools


def test_every_tool_that_is_named_can_be_asked_for() -> None:
    assert {tool for tool, _, _ in CONFIGURED} <= {linter.NAME for linter in LINTERS}


def test_a_summary_in_words() -> None:
    assert NOTHING.in_words() == "no package.xml"
    both = Seen(packages=((2, 3), (1, 1), (None, 1)), lines=(("cpp", 40), ("python", 0)))
    assert Seen(((2, 3),), ()).in_words() == "3 packages of ROS 2"
    assert Seen(((None, 1),), ()).in_words() == "1 package"
    assert both.in_words() == "5 packages (3 of ROS 2, 1 of ROS 1), 40 lines of C++"


@pytest.mark.parametrize(
    "branch", ["main", "rolling", "ros2/humble", "release-1.0", "1.0", "on", "a,b]", "a: b", "ü", "#x", "'", '"']
)
def test_a_branch_of_any_name_is_one_text(branch: str) -> None:
    told = pyyaml.safe_load(workflow(branch))[True]["push"]["branches"]  # YAML 1.1: on is True
    assert told == [branch] and pyyaml.safe_load(f"- {scalar(branch)}") == [branch]


def test_the_copies_in_the_documentation_are_what_is_written() -> None:
    docs = Path(__file__).resolve().parents[2] / "docs" / "workflows"
    from haros_ci.starting.files import pre_commit

    assert workflow("main") == (docs / "haros-ci.yml").read_text(encoding="utf-8")
    assert pre_commit() == (docs / "pre-commit-config.yaml").read_text(encoding="utf-8")


@pytest.mark.parametrize("tools_on", [False, True])
def test_the_project_file_is_one(tools_on: bool) -> None:
    full = Seen(
        ((2, 1),),
        (("cpp", 9),),
        vendored=("a: b/vendor", "vendor"),
        generated=GENERATED,
        tools=(("ruff", "ruff.toml"),),
    )
    text = project(full)
    if tools_on:
        text = text.replace("# linters:", "linters:").replace("#   ruff", "  ruff")
    settings = read_project(text.encode(), ".haros-ci.yaml", trust_config=False)
    assert settings.values["profile"] == "ros" and settings.notes == ()
    assert settings.values["exclude"] == ("a: b/vendor", "vendor", *GENERATED)
    assert bool(settings.values.get("linters")) is tools_on
