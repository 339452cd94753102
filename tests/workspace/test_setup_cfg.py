# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import pytest

from haros_ci.workspace.setup_cfg import project_scripts, script_directories


def test_where_programs_go() -> None:
    text = "[develop]\nscript_dir=$base/lib/arm\n[install]\ninstall_scripts = $base/lib/leg\n"
    assert script_directories(text) == {"develop": ("$base/lib/arm", 2), "install": ("$base/lib/leg", 4)}


def test_the_older_names_count_too() -> None:
    text = "[develop]\nscript-dir=$base/lib/arm\n[install]\ninstall-scripts=$base/lib/arm\n"
    assert script_directories(text) == {"develop": ("$base/lib/arm", 2), "install": ("$base/lib/arm", 4)}


@pytest.mark.parametrize(
    "text", ["", "[install]\n", "install_scripts=$base/lib/arm\n", "[develop]\ninstall_scripts=$base\n"]
)
def test_elsewhere_it_says_nothing(text: str) -> None:
    assert script_directories(text) == {}


def test_the_scripts_of_a_project() -> None:
    text = '[project]\nname = "arm"\n[project.scripts]\nmove = "arm.move:main"\n\'stop\' = "arm.stop:main"  # now\n[tool.x]\na = "b:c"\n'
    assert project_scripts(text) == [("move = arm.move:main", 4, 1), ("stop = arm.stop:main", 5, 2)]


@pytest.mark.parametrize(
    "text",
    [
        "",
        "[project]\nmove = 'a:b'\n",
        "[project.scripts]\n# move = 'a:b'\nmove\n",
        "[project.gui-scripts]\na = 'b:c'\n",
    ],
)
def test_what_is_no_script(text: str) -> None:
    assert project_scripts(text) == []
