# SPDX-License-Identifier: Apache-2.0
"""Programs that a package installs from outside of its directory: they are programs of it."""

from __future__ import annotations

import subprocess
from pathlib import Path

import pytest

from haros_ci.analysis.architecture import architecture
from haros_ci.config.settings import Settings
from haros_ci.workspace.cache import MemoryCache
from haros_ci.workspace.discover import discover

AMENT = '<package format="3"><name>demo</name><export><build_type>ament_cmake</build_type></export></package>'
TALK = (
    "#!/usr/bin/env python3\nimport rclpy\nfrom std_msgs.msg import String\ndef main():\n    rclpy.init()\n"
    "    node = rclpy.create_node('talker')\n    node.create_publisher(String, 'chatter', 1)\n"
    "if __name__ == '__main__':\n    main()\n"
)


def found(root: Path, install: str, runnable: bool | None = None) -> tuple[list[str], bool]:
    """The configurations, and whether a program is said to lie in no package."""
    files = {
        "pkg/package.xml": AMENT,
        "pkg/CMakeLists.txt": f"project(demo)\nfind_package(ament_cmake REQUIRED)\n{install}\n",
        "scripts/talk.py": TALK,
    }
    for path, text in files.items():
        (root / path).parent.mkdir(parents=True, exist_ok=True)
        (root / path).write_text(text)
    if runnable is not None:
        (root / "scripts/talk.py").chmod(0o755 if runnable else 0o644)
        for words in (["init", "-q"], ["add", "-A"]):
            subprocess.run(["git", *words], cwd=root, check=True)
    workspace = discover(root, ())
    made = architecture(workspace, Settings(root=root), MemoryCache())
    return [each.name for each in made.configurations], any(
        "in no package" in each.message for each in workspace.problems
    )


@pytest.mark.parametrize(
    "install",
    [
        "install(PROGRAMS ../scripts/talk.py DESTINATION lib/demo)",
        "install(PROGRAMS ${CMAKE_CURRENT_SOURCE_DIR}/../scripts/talk.py DESTINATION lib/${PROJECT_NAME})",
        "install(DIRECTORY ../scripts/ DESTINATION lib/demo USE_SOURCE_PERMISSIONS)",
        "install(DIRECTORY ../scripts DESTINATION lib/${PROJECT_NAME} USE_SOURCE_PERMISSIONS)",
    ],
)
def test_programs_from_outside(tmp_path: Path, install: str) -> None:
    assert found(tmp_path, install) == (["demo/talk.py"], False)


@pytest.mark.parametrize(
    "install",
    [
        "",
        "install(DIRECTORY ../scripts/ DESTINATION lib/demo)",
        "install(DIRECTORY ../scripts/ DESTINATION share/demo USE_SOURCE_PERMISSIONS)",
        "install(DIRECTORY ../scripts/ DESTINATION lib/leg USE_SOURCE_PERMISSIONS)",
        'install(DIRECTORY ../scripts/ DESTINATION lib/demo USE_SOURCE_PERMISSIONS FILES_MATCHING PATTERN "*.sh")',
        "install(DIRECTORY ../other/ DESTINATION lib/demo USE_SOURCE_PERMISSIONS)",
        "install(FILES ../scripts/talk.py DESTINATION lib/demo)",
        "install(PROGRAMS ../scripts/walk.py DESTINATION lib/demo)",
        "# install(PROGRAMS ../scripts/talk.py DESTINATION lib/demo)",
    ],
)
def test_what_is_no_program(tmp_path: Path, install: str) -> None:
    configurations, is_said = found(tmp_path, install)
    assert (configurations, is_said) == ([], True)


@pytest.mark.parametrize(("runnable", "expected"), [(True, (["demo/talk.py"], False)), (False, ([], True))])
def test_only_what_is_runnable_is_a_program(tmp_path: Path, runnable: bool, expected: tuple[list[str], bool]) -> None:
    install = "install(DIRECTORY ../scripts/ DESTINATION lib/demo USE_SOURCE_PERMISSIONS)"
    assert found(tmp_path, install, runnable) == expected
