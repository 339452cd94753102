# SPDX-License-Identifier: Apache-2.0
"""Which directories beside the packages hold a whole project of somebody else."""

from __future__ import annotations

from pathlib import Path

import pytest

from haros_ci.analysis.public_copies import quiet
from haros_ci.config.settings import Settings
from haros_ci.workspace.discover import discover

ADA = '<maintainer email="ada@robots.org">Ada Lovage</maintainer>'
MANIFEST = '<package format="3"><name>demo</name><version>1.0.0</version><description>d</description>{}<license>BSD</license></package>\n'
LICENCE = "MIT License\n\nCopyright (c) 2017 Grete Stromberg\n\nPermission is hereby granted\n"
GPL = "GNU GENERAL PUBLIC LICENSE\n\nCopyright (C) 2007 Free Software Foundation, Inc. <https://fsf.org/>\n"
HEAD = "/* Copyright 2014 Grete Stromberg */\n"
OWN = {"src/demo/package.xml": MANIFEST.format(ADA), "src/demo/src/a.cpp": "int main() { return 0; }\n"}
SOLVER = {"src/solver/LICENSE": LICENCE, "src/solver/README.md": "A solver.\n", "src/solver/lib/a.cpp": "int a();\n"}


def of_licence(text: str) -> dict[str, str]:
    return {**OWN, **SOLVER, "src/solver/LICENSE": text}


FIRES = [
    {**OWN, **SOLVER},
    {**OWN, **SOLVER, "src/solver/README.md": "", "src/solver/CMakeLists.txt": "project(solver)\n"},
    {**of_licence(GPL), "src/solver/lib/a.cpp": HEAD},
    {**of_licence("Apache License\nCopyright [yyyy] [name of copyright owner]\n"), "src/solver/lib/a.cpp": HEAD},
    {**OWN, **SOLVER, "LICENSE": LICENCE.replace("Grete Stromberg", "Ada Lovage")},
    {**OWN, **SOLVER, "src/solver/setup.py": "setup(name='solver', author='G. Stromberg', version='1.0')\n"},
    {**OWN, **SOLVER, "src/solver/setup.cfg": "[metadata]\nname = solver\n"},
    {**OWN, **SOLVER, "src/solver/deps/more/LICENSE": LICENCE, "src/solver/deps/more/README": ""},
    {
        **OWN,
        **SOLVER,
        **{f"src/solver/lib/{i}.cpp": "int a();\n" for i in range(12)},
        "src/solver/lib/ros.cpp": '#include "ros/ros.h"\n',
    },
]
QUIET = [
    OWN,
    {name: text for name, text in (OWN | SOLVER).items() if not name.endswith("README.md")},
    {**OWN, **SOLVER, "src/demo/package.xml": MANIFEST.format(ADA.replace("Ada Lovage", "G. Stromberg"))},
    {**OWN, **SOLVER, "src/demo/package.xml": MANIFEST.format("")},
    {**OWN, **SOLVER, "src/demo/package.xml": MANIFEST.format('<maintainer email="todo@todo.todo">todo</maintainer>')},
    {**OWN, **SOLVER, "src/demo/src/a.cpp": HEAD + "int main() { return 0; }\n"},
    {**OWN, **SOLVER, "LICENSE": LICENCE},
    {**OWN, **SOLVER, "src/COPYING": LICENCE},
    {**OWN, **SOLVER, "src/solver/ros/package.xml": MANIFEST.format(ADA).replace("demo", "solver")},
    {**OWN, **SOLVER, "src/solver/package.xml": MANIFEST.format(ADA).replace("demo", "solver")},
    {**OWN, **SOLVER, "src/solver/lib/a.cpp": '#include "rclcpp/rclcpp.hpp"\n'},
    {**OWN, **SOLVER, "src/solver/lib/a.py": "from std_msgs.msg import String\n"},
    {**OWN, **SOLVER, "src/solver/setup.py": "setup(name='solver', author='Someone Else', version='1.0')\n"},
    {**OWN, **SOLVER, "src/solver/setup.cfg": "[metadata]\nauthor = Someone Else\n"},
    {**OWN, **SOLVER, "src/solver/pyproject.toml": '[project]\nauthors = [{name = "Someone Else"}]\n'},
    of_licence(GPL),
    of_licence("Do what you like.\n"),
    of_licence("Copyright (c) 2020 The Authors\n"),
    {**OWN, **{name.replace("LICENSE", "license.cpp"): text for name, text in SOLVER.items()}},
    {name.replace("src/solver/", ""): text for name, text in (OWN | SOLVER).items()},
]


def copies(root: Path, files: dict[str, str], settings: Settings | None = None) -> set[str]:
    for name, text in files.items():
        (root / name).parent.mkdir(parents=True, exist_ok=True)
        (root / name).write_text(text)
    workspace = quiet(discover(root, (".",)), settings or Settings(root=root))
    return {file.third_party for file in workspace.files} - {""}


@pytest.mark.parametrize("files", FIRES)
def test_a_project_of_somebody_else(tmp_path: Path, files: dict[str, str]) -> None:
    assert copies(tmp_path, files) == {"src/solver"}


@pytest.mark.parametrize("files", QUIET)
def test_what_is_the_teams_own(tmp_path: Path, files: dict[str, str]) -> None:
    assert "src/solver" not in copies(tmp_path, files)


def test_where_something_is_compared_it_has_findings(tmp_path: Path) -> None:
    assert copies(tmp_path, {**OWN, **SOLVER}, Settings(root=tmp_path, baseline_rev="HEAD")) == set()


def test_many_licences_are_looked_up_by_their_directory(tmp_path: Path) -> None:
    """Each of 300 projects is one of its own: what is asked of one does not go through the others."""
    many = {f"src/p{i}/{name[11:]}": text for i in range(300) for name, text in SOLVER.items()}
    assert copies(tmp_path, {**OWN, **many}) == {f"src/p{i}" for i in range(300)}
