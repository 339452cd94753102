# SPDX-License-Identifier: Apache-2.0
"""Where another install() goes, and how it is written."""

from __future__ import annotations

from pathlib import Path

import pytest

from haros_ci.checking.installing import install_directory, install_line, landings
from haros_ci.checking.project import Project, ProjectPackage
from haros_ci.results.fix import applied
from haros_ci.workspace.build import builds
from haros_ci.workspace.discover import discover

MANIFEST = (
    "<package format='3'><name>arm</name><version>1.0.0</version><description>.</description>"
    "<maintainer email='a@example.org'>A</maintainer><license>MIT</license><buildtool_depend>{tool}</buildtool_depend>"
    "<export><build_type>{tool}</build_type></export></package>"
)


def package(root: Path, cmake: str, tool: str = "ament_cmake", *paths: str) -> ProjectPackage:
    (root / "package.xml").write_text(MANIFEST.format(tool=tool))
    (root / "CMakeLists.txt").write_bytes(f"project(arm)\n{cmake}".encode())
    for path in paths:
        (root / path).parent.mkdir(parents=True, exist_ok=True)
        (root / path).write_text("x")
    workspace = discover(root, (".",))
    found = Project(workspace, builds(workspace), {}).package("arm")
    assert found is not None
    return found


def after(made: ProjectPackage, directory: str) -> str:
    fix = install_directory(made, directory)
    assert fix is not None
    return applied(made.project.text("CMakeLists.txt"), fix.edits).partition("\n")[2]


SHARE = "share/${PROJECT_NAME}"


@pytest.mark.parametrize(
    ("cmake", "expected"),
    [
        (
            f"install(DIRECTORY launch DESTINATION {SHARE})\nament_package()\n",
            f"install(DIRECTORY launch config DESTINATION {SHARE})\nament_package()\n",
        ),
        (
            f"install(\n  DIRECTORY\n    launch\n    urdf\n  DESTINATION {SHARE}/\n)\nament_package()\n",
            f"install(\n  DIRECTORY\n    launch\n    urdf\n    config\n  DESTINATION {SHARE}/\n)\nament_package()\n",
        ),
        ("ament_package()\n", f"install(DIRECTORY config DESTINATION {SHARE})\n\nament_package()\n"),
        ("ament_package()\r\n", f"install(DIRECTORY config DESTINATION {SHARE})\r\n\r\nament_package()\r\n"),
        (
            f"install(DIRECTORY launch/ DESTINATION {SHARE})\nament_package()\n",
            f"install(DIRECTORY launch/ DESTINATION {SHARE})\ninstall(DIRECTORY config DESTINATION {SHARE})\n\nament_package()\n",
        ),
        (
            f'install(DIRECTORY launch DESTINATION {SHARE} PATTERN "*.bak" EXCLUDE)\nament_package()\n',
            f'install(DIRECTORY launch DESTINATION {SHARE} PATTERN "*.bak" EXCLUDE)\n'
            f"install(DIRECTORY config DESTINATION {SHARE})\n\nament_package()\n",
        ),
        (
            f"if(BUILD_TESTING)\n  install(DIRECTORY launch DESTINATION {SHARE})\nendif()\nament_package()\n",
            f"if(BUILD_TESTING)\n  install(DIRECTORY launch DESTINATION {SHARE})\nendif()\n"
            f"install(DIRECTORY config DESTINATION {SHARE})\n\nament_package()\n",
        ),
    ],
)
def test_a_directory_is_installed_beside_its_like(cmake: str, expected: str, tmp_path: Path) -> None:
    assert after(package(tmp_path, cmake), "config") == expected


@pytest.mark.parametrize("end", ["", "\n"])
def test_catkin_has_no_last_command(end: str, tmp_path: Path) -> None:
    made = package(tmp_path, f"catkin_package(){end}", "catkin")
    line = "install(DIRECTORY config DESTINATION ${CATKIN_PACKAGE_SHARE_DESTINATION})"
    assert after(made, "config") == f"catkin_package()\n\n{line}\n"


@pytest.mark.parametrize("cmake", ["", "if(A)\n", "if(A)\nament_package()\nelse()\nament_package(X)\nendif()\n"])
def test_no_place_is_certain(cmake: str, tmp_path: Path) -> None:
    assert install_line(package(tmp_path, cmake), "install(TARGETS a DESTINATION lib)", "install a") is None


def test_where_files_land(tmp_path: Path) -> None:
    cmake = f"install(DIRECTORY launch DESTINATION {SHARE})\ninstall(DIRECTORY config/ DESTINATION {SHARE}/params)\n"
    cmake += f"install(FILES a.rviz DESTINATION {SHARE} RENAME b.rviz)\n"
    made = package(tmp_path, cmake, "ament_cmake", "launch/x/a.launch", "config/a.yaml", "a.rviz", "launcher/a")
    assert landings(made, "launch/x/a.launch") == ("share/arm/launch/x/a.launch",)
    assert landings(made, "launch") == ("share/arm/launch",)
    assert landings(made, "config/a.yaml") == ("share/arm/params/a.yaml",)
    assert landings(made, "a.rviz") == ("share/arm/b.rviz",)
    assert landings(made, "launcher/a") == landings(made, "b.rviz") == ()
