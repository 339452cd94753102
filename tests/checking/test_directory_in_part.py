# SPDX-License-Identifier: Apache-2.0
"""Files of a directory that is installed in part: the message names those that lack."""

from __future__ import annotations

from pathlib import Path

import pytest

from haros_ci.api.testing import said
from haros_ci.checking.page import Example
from haros_ci.registry import checks

MANIFEST = (
    '<package format="3"><name>demo</name><version>1.0.0</version><description>d</description><maintainer email="a@b.cd">m</maintainer>'
    "<license>MIT</license>{}<export><build_type>{}</build_type></export></package>\n"
)
SETUP = (
    "from glob import glob\nfrom setuptools import setup\n\nsetup(\n    name='demo',\n    packages=['demo'],\n    data_files=[\n"
    "        ('share/ament_index/resource_index/packages', ['resource/demo']),\n        ('share/demo', ['package.xml']),\n"
    "        ('share/demo/launch', glob('launch/*')),\n{}    ],\n)\n"
)
CMAKE = "project(demo)\nfind_package(ament_cmake REQUIRED)\ninstall(DIRECTORY launch DESTINATION share/demo)\n{}ament_package()\n"
SHOW = '<launch><node pkg="rviz2" exec="rviz2" args="-d $(find-pkg-share demo)/config/{}"/></launch>\n'


def messages(build: dict[str, str], folder: Path, *named: str) -> list[str]:
    is_cmake = "CMakeLists.txt" in build
    kind = "ament_cmake" if is_cmake else "ament_python"
    files = {
        "package.xml": MANIFEST.format("<buildtool_depend>ament_cmake</buildtool_depend>" if is_cmake else "", kind),
        **({} if is_cmake else {"resource/demo": "", "demo/__init__.py": ""}),
        **build,
        "config/a.yaml": "a: 1\n",
        "config/a.rviz": "Panels:\n",
        "config/b.rviz": "Panels:\n",
        **{f"launch/{at}.launch.xml": SHOW.format(name) for at, name in enumerate(named)},
    }
    check = next(check for check in checks() if check.id == "directory-not-installed")
    return [result.message for result in said(check, Example("", True, files), folder)]


YAML = "        ('share/demo/config', glob('config/*.yaml')),\n"


@pytest.mark.parametrize(
    ("build", "named", "begin", "end"),
    [
        (
            {"setup.py": SETUP.format(YAML)},
            ("a.rviz",),
            "the file config/a.rviz of demo is not installed, but",
            " needs it; install it with the other files of config",
        ),
        (
            {"setup.py": SETUP.format(YAML)},
            ("a.rviz", "b.rviz"),
            "the files config/a.rviz and config/b.rviz of demo are not installed, but",
            " need them; install them with the other files of config",
        ),
        (
            {"CMakeLists.txt": CMAKE.format("install(FILES config/a.yaml DESTINATION share/demo/config)\n")},
            ("a.rviz",),
            "the file config/a.rviz of demo is not installed, but",
            " needs it; add it to install(FILES ...)",
        ),
        # nothing of it is installed
        (
            {"setup.py": SETUP.format("")},
            ("a.rviz",),
            "the directory config of demo is not installed, but",
            " needs it; install it",
        ),
        (
            {"CMakeLists.txt": CMAKE.format("")},
            ("a.rviz",),
            "the directory config of demo is not installed, but",
            " needs it; add it to install(DIRECTORY ...)",
        ),
        # all of it is, elsewhere
        (
            {"CMakeLists.txt": CMAKE.format("install(DIRECTORY config/ DESTINATION share/demo/cfg)\n")},
            ("a.rviz",),
            "the directory config of demo is installed to share/demo/cfg/a.rviz, but used from",
            "correct the destination",
        ),
    ],
)
def test_what_lacks(build: dict[str, str], named: tuple[str, ...], begin: str, end: str, tmp_path: Path) -> None:
    (message,) = messages(build, tmp_path, *named)
    assert message.startswith(begin) and message.endswith(end), message


@pytest.mark.parametrize(
    "build",
    [
        {"setup.py": SETUP.format("        ('share/demo/config', glob('config/*')),\n")},
        {"CMakeLists.txt": CMAKE.format("install(DIRECTORY config DESTINATION share/demo)\n")},
        {"CMakeLists.txt": CMAKE.format("install(FILES config/a.rviz DESTINATION share/demo/config)\n")},
    ],
)
def test_what_is_installed_is_quiet(build: dict[str, str], tmp_path: Path) -> None:
    assert messages(build, tmp_path, "a.rviz") == []


CATKIN = (
    '<package format="2"><name>demo</name><version>1.0.0</version><description>d</description><maintainer email="a@b.cd">m</maintainer>'
    "<license>MIT</license><buildtool_depend>catkin</buildtool_depend><depend>nodelet</depend>"
    '<export><nodelet plugin="${prefix}/nodelets.xml"/></export></package>\n'
)
BUILT = "project(demo)\nfind_package(catkin REQUIRED nodelet)\ncatkin_package()\nadd_library(demo SHARED demo.cpp)\n"
LIBRARY = "install(TARGETS demo LIBRARY DESTINATION ${CATKIN_PACKAGE_LIB_DESTINATION})\n"
FILE = "install(FILES {} DESTINATION ${{CATKIN_PACKAGE_SHARE_DESTINATION}})\n"
NODELETS = (
    '<library path="lib/libdemo"><class name="demo/N" type="demo::N" base_class_type="nodelet::Nodelet"/></library>\n'
)
#: A page that uses the workspace from its devel space.
PAGE = "Build it: `catkin_make`, then `source devel/setup.bash`\n"


@pytest.mark.parametrize(
    ("installs", "files", "level"),
    [
        (LIBRARY, {}, "warning"),
        (LIBRARY, {"README.md": PAGE}, "warning"),
        (LIBRARY + FILE.format("nodelet.xml"), {"README.md": PAGE}, "note"),  # missing-install-source speaks of it
        (FILE.format("package.xml"), {"README.md": PAGE}, None),  # target-not-installed does
        (LIBRARY + FILE.format("nodelets.xml"), {}, None),
        (LIBRARY + FILE.format("nodelets.xml"), {"README.md": PAGE}, None),
    ],
)
def test_a_description_of_a_library_that_is_installed(
    installs: str, files: dict[str, str], level: str | None, tmp_path: Path
) -> None:
    every = {
        "package.xml": CATKIN,
        "CMakeLists.txt": BUILT + installs,
        "demo.cpp": "",
        "nodelets.xml": NODELETS,
        **files,
    }
    check = next(check for check in checks() if check.id == "directory-not-installed")
    assert [result.level.value for result in said(check, Example("", True, every), tmp_path)] == (
        [level] if level else []
    )
