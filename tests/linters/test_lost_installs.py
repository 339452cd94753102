# SPDX-License-Identifier: Apache-2.0
"""Installations that a usual build leaves out are named where a change brings them."""

from __future__ import annotations

from pathlib import Path

import pytest
from linter_samples import workspace

from haros_ci.linters.lost_installs import lost_installs, notifications

FIRES = {
    "install(TARGETS a DESTINATION lib/${PROJECT_NAME} EXCLUDE_FROM_ALL)\n": "EXCLUDE_FROM_ALL",
    "install(TARGETS a CONFIGURATIONS Never DESTINATION lib/a)\n": "CONFIGURATIONS",
    "INSTALL (TARGETS a\n  CONFIGURATIONS Debug\n  DESTINATION lib/a)\n": "CONFIGURATIONS",
    "install(DIRECTORY launch DESTINATION share/a\n  EXCLUDE_FROM_ALL)\n": "EXCLUDE_FROM_ALL",
    "install(TARGETS a # all\n  CONFIGURATIONS Never)\n": "CONFIGURATIONS",
}
QUIET = [
    "install(TARGETS a DESTINATION lib/${PROJECT_NAME})\n",
    "install(TARGETS a CONFIGURATIONS Release RelWithDebInfo Debug DESTINATION lib/a)\n",
    "# install(TARGETS a EXCLUDE_FROM_ALL)\n",
    "#[[ install(TARGETS a EXCLUDE_FROM_ALL) ]]\n",
    "add_executable(a EXCLUDE_FROM_ALL a.cpp)\ninstall(TARGETS b DESTINATION lib/b)\n",
    "add_subdirectory(lib EXCLUDE_FROM_ALL)\n",
    "foreach(c IN LISTS CMAKE_CONFIGURATION_TYPES CONFIGURATIONS)\nendforeach()\n",
    "my_install(TARGETS a CONFIGURATIONS Never)\n",
    "install(DIRECTORY launch DESTINATION share/a PATTERN EXCLUDE)\n",
    "set(CONFIGURATIONS Never)\ninstall(TARGETS a DESTINATION lib/a)\n",
]


@pytest.mark.parametrize("text", FIRES)
def test_fires(text: str) -> None:
    assert [what for _, what, _ in lost_installs(text)] == [FIRES[text]]


@pytest.mark.parametrize("text", QUIET)
def test_stays_quiet(text: str) -> None:
    assert list(lost_installs(text)) == []


def test_what_a_change_brings(tmp_path: Path) -> None:
    def said(place: str, base: str, head: str) -> list[int | None]:
        sides = [
            workspace(tmp_path / place / side, {"CMakeLists.txt": text}) for side, text in (("b", base), ("h", head))
        ]
        assert notifications(sides[1], None) == ()
        return [note.line for note in notifications(sides[1], sides[0])]

    text = next(iter(FIRES))
    assert said("1", QUIET[0], f"\n{text}") == [2]
    assert said("2", text, f"\n{text}") == []


def test_a_long_text_takes_linear_time() -> None:
    assert list(lost_installs("install(" * 50_000 + "CONFIGURATIONS")) == []
    assert list(lost_installs("install(CONFIGURATIONS " * 20_000)) == []
