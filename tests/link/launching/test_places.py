# SPDX-License-Identifier: Apache-2.0
"""Files by the places they are installed in, and nothing outside of the workspace."""

from __future__ import annotations

import pytest
from launching_kit import workspace

from haros_ci.launch.ros2.places import Places
from haros_ci.model.build import Build, Installed
from haros_ci.model.location import Location
from haros_ci.model.workspace import Problem

FILES = {"bot/launch/a.xml": "<launch/>", "bot/src/cfg/b.yaml": "b", "bot/one.yaml": "o", "bot/config/c.yaml": "c"}
HERE = Location("bot/CMakeLists.txt", 1)


def places() -> Places:
    installed = (
        Installed(path="bot/src/cfg", kind="directory", package="bot", destination="share/bot/params", location=HERE),
        Installed(
            path="bot/one.yaml", kind="file", package="bot", destination="share/bot", name="1.yaml", location=HERE
        ),
    )
    return Places(workspace(FILES), {"bot": Build(package="bot", installed=installed)})


@pytest.mark.parametrize(
    ("text", "path"),
    [
        ("$(find-pkg-share bot)/launch/a.xml", "bot/launch/a.xml"),
        ("$(find-pkg-share bot)/launch/../launch//a.xml", "bot/launch/a.xml"),
        ("$(find-pkg-share bot)/params/b.yaml", "bot/src/cfg/b.yaml"),
        ("$(find-pkg-share bot)/1.yaml", "bot/one.yaml"),
        ("$(find-pkg-prefix bot)/share/bot/params/b.yaml", "bot/src/cfg/b.yaml"),
        ("$(workspace bot/launch)/../config/c.yaml", "bot/config/c.yaml"),
        ("$(find-pkg-share bot)", "bot"),
    ],
)
def test_found(text: str, path: str) -> None:
    assert places().find(text).path == path


@pytest.mark.parametrize(
    ("text", "outside"),
    [
        ("$(find-pkg-share other)/a", True),
        ("$(find-pkg-share bot)/../../etc/passwd", True),
        ("$(workspace .)/../x", True),
        ("/etc/passwd", True),
        ("~/x", True),
        ("file:///x", True),
        ("$(find-pkg-prefix bot)/lib/bot/x", True),
        ("launch/a.xml", False),
        ("$(find-pkg-share bot)a.xml", False),
        ("", False),
    ],
)
def test_not_found(text: str, outside: bool) -> None:
    place = places().find(text)
    assert (place.path, place.outside) == (None, outside)
    assert place.reason


def test_read() -> None:
    assert places().read("$(find-pkg-share bot)/params/b.yaml") == ("bot/src/cfg/b.yaml", "b", "")
    path, text, reason = places().read("$(find-pkg-share bot)/no.yaml")
    assert (path, text, reason) == (None, "", "'bot/no.yaml' is no text file of the workspace")


def computed(problem: Problem, *more: str) -> Places:
    """Of two packages, in one of which setup.py has the *problem*."""
    files = {**FILES, "cat/launch/d.xml": "<launch/>", **dict.fromkeys(more, "<launch/>")}
    return Places(workspace(files), {"bot": Build(package="bot", problems=(problem,)), "cat": Build(package="cat")})


@pytest.mark.parametrize(
    ("problem", "path", "may_be"),
    [
        (Problem("bot/setup.py", "data_files is computed when setup.py runs", 3), "bot/a.xml", True),
        (Problem("bot/setup.py", "a list in data_files is computed when setup.py runs", 3), "bot/config/a.xml", True),
        (Problem("bot/setup.py", "data_files is computed when setup.py runs", 3), "bot/gone.xml", False),
        (Problem("bot/setup.py", "data_files is computed when setup.py runs", 3), "bot/d.xml", False),
        (Problem("bot/setup.py", "data_files is computed when setup.py runs", 3), "cat/d.xml", False),
        (Problem("bot/setup.py", "data_files is computed when setup.py runs", 3), "a.xml", False),
        (Problem("bot/setup.py", "entry_points is computed when setup.py runs", 3), "bot/a.xml", False),
        (Problem("bot/CMakeLists.txt", "data_files_of() is not known", 3), "bot/a.xml", False),
    ],
)
def test_what_setup_py_may_install(problem: Problem, path: str, may_be: bool) -> None:
    assert computed(problem).may_be_installed(path) is may_be
    if path.startswith("bot/"):
        words = "'%s' is what setup.py may install" if may_be else "'%s' is no text file of the workspace"
        assert computed(problem).read(f"$(find-pkg-share bot)/{path[4:]}")[2].startswith(words % path)
