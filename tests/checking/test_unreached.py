# SPDX-License-Identifier: Apache-2.0
"""undeclared-import is a note for what only modules import that nothing reaches, and for what the package leaves to pip on purpose."""

from __future__ import annotations

from pathlib import Path

import pytest

from haros_ci.api.testing import said
from haros_ci.checking.page import Example
from haros_ci.registry import checks
from haros_ci.results.rule import Level

PACKAGE = (
    '<package format="3"><name>demo</name><version>1.0.0</version><description>d</description>'
    '<maintainer email="a@example.org">m</maintainer><license>MIT</license>{0}</package>\n'
)
ROS2 = PACKAGE.format("<depend>rclpy</depend><export><build_type>ament_python</build_type></export>")
ROS1 = PACKAGE.format("<buildtool_depend>catkin</buildtool_depend><depend>rospy</depend>")
SETUP = (
    'from setuptools import setup\nsetup(name="demo", version="1.0.0", packages=["demo"], {}'
    'entry_points={{"console_scripts": ["demo = demo.main:main"]}})\n'
)
MAIN = "import rclpy\n{}\n\ndef main():\n    rclpy.init()\n"
USE = "import scipy\n"


def results(files: dict[str, str], tmp_path: Path, base: dict[str, str] | None = None) -> list[tuple[Level, str]]:
    whole = {"package.xml": ROS2, "setup.py": SETUP.format(""), "demo/__init__.py": "", **files}
    check = next(check for check in checks() if check.id == "undeclared-import")
    example = Example("", True, whole, base=None if base is None else {**whole, **base})
    return [(result.level, result.message) for result in said(check, example, tmp_path)]


@pytest.mark.parametrize(
    ("files", "expected"),
    [
        ({"demo/main.py": MAIN.format(""), "demo/old/filters.py": USE}, Level.NOTE),
        ({"demo/main.py": MAIN.format("# from demo.old import filters"), "demo/old/filters.py": USE}, Level.NOTE),
        ({"demo/main.py": MAIN.format("from demo.old import filters"), "demo/old/filters.py": USE}, Level.ERROR),
        ({"demo/main.py": MAIN.format("from .old.filters import a"), "demo/old/filters.py": USE}, Level.ERROR),
        # another module of the same name is no import of it
        (
            {
                "demo/main.py": MAIN.format("from demo import filters"),
                "demo/filters.py": "",
                "demo/old/filters.py": USE,
            },
            Level.NOTE,
        ),
        (
            {
                "demo/main.py": MAIN.format(""),
                "demo/old/a.py": "from demo.old import filters\n",
                "demo/old/filters.py": USE,
            },
            Level.NOTE,
        ),
        (
            {
                "demo/main.py": MAIN.format("from demo.old import a"),
                "demo/old/a.py": "from . import filters\n",
                "demo/old/filters.py": USE,
            },
            Level.ERROR,
        ),
        ({"demo/main.py": MAIN.format("from demo.tools import filters"), "demo/tools/filters.py": USE}, Level.ERROR),
        ({"demo/main.py": MAIN.format(""), "demo/tools/filters.py": USE}, Level.NOTE),
        ({"demo/main.py": MAIN.format(""), "demo/filters.py": USE}, Level.NOTE),
        ({"demo/main.py": MAIN.format(""), "demo/filters.py": USE, "README.md": "Import filters.\n"}, Level.ERROR),
        ({"demo/main.py": MAIN.format("from demo import filters"), "demo/filters.py": USE}, Level.ERROR),
        ({"demo/main.py": MAIN.format(""), "demo/filters.py": f"#!/usr/bin/env python3\n{USE}"}, Level.ERROR),
        ({"demo/main.py": MAIN.format(""), "demo/old/filters.py": f"#!/usr/bin/env python3\n{USE}"}, Level.NOTE),
        ({"demo/main.py": MAIN.format("import scipy"), "demo/old/filters.py": USE}, Level.ERROR),
        ({"demo/old/main.py": USE, "demo/main.py": MAIN.format("import scipy")}, Level.ERROR),
    ],
)
def test_levels(files: dict[str, str], expected: Level, tmp_path: Path) -> None:
    ((level, message),) = results(files, tmp_path)
    assert level is expected and ("nothing here starts or imports" in message) == (expected is Level.NOTE)


def test_a_library_without_programs(tmp_path: Path) -> None:
    files = {
        "setup.py": 'from setuptools import setup\nsetup(name="demo", packages=["demo"])\n',
        "demo/filters.py": USE,
    }
    ((level, _),) = results(files, tmp_path)
    assert level is Level.ERROR  # it is there for others


def test_modules_that_catkin_finds_and_nothing_imports(tmp_path: Path) -> None:
    files = {
        "package.xml": ROS1,
        "CMakeLists.txt": "cmake_minimum_required(VERSION 3.0)\nproject(demo)\nfind_package(catkin REQUIRED)\ncatkin_python_setup()\ncatkin_package()\n",
        "setup.py": "from setuptools import setup\nsetup(packages=['demo'], package_dir={'': 'src'})\n",
        "src/demo/__init__.py": "",
        "src/demo/node.py": "import rospy\nimport cv2\n",
        "src/trials/filter.py": USE,
    }
    found = results(files, tmp_path)
    assert sorted(level.value for level, _ in found) == ["error", "note"]
    assert "filter.py" in next(message for level, message in found if level is Level.NOTE)
    files["src/demo/node.py"] += "from trials import filter\n"
    assert [level for level, _ in results(files, tmp_path / "again")] == [Level.ERROR]


NODE = {"demo/main.py": MAIN.format("import scipy")}


@pytest.mark.parametrize(
    ("files", "expected"),
    [
        ({"setup.py": SETUP.format('install_requires=["setuptools", "scipy"], ')}, Level.NOTE),
        ({"setup.py": SETUP.format('install_requires=["httpx[http2]",\n# why\n "scipy"], ')}, Level.NOTE),
        ({"setup.cfg": "[options]\ninstall_requires =\n    setuptools\n    scipy\n"}, Level.NOTE),
        ({"pyproject.toml": '[project]\nname = "demo"\ndependencies = [\n  "scipy",\n]\n'}, Level.NOTE),
        ({"pyproject.toml": '[tool.poetry.dependencies]\nscipy = "*"\n'}, Level.NOTE),
        ({"requirements.txt": "numpy\nscipy\n", "README.md": "pip install -r requirements.txt\n"}, Level.NOTE),
        (
            {
                "requirements.txt": "scipy",
                "docker/Dockerfile": "RUN pip3 install --user \\\n -r /tmp/requirements.txt\n",
            },
            Level.NOTE,
        ),
        ({"README.md": "# demo\n\n- rclpy\n- SciPy is optional, and is not installed by rosdep.\n"}, Level.NOTE),
        ({"README.md": "Plots need scipy,\nwhich is managed by the container. Nothing else is.\n"}, Level.NOTE),
        ({"README.md": "The launch file takes optional arguments. It needs scipy.\n"}, Level.ERROR),
        ({"README.md": "- optional: rviz2\n- scipy\n"}, Level.ERROR),
        ({"README.md": "Optional: rviz2\n\nscipy\n"}, Level.ERROR),
        ({"README.md": "Install scipy before you start.\n"}, Level.ERROR),
        ({"docs/a.md": "scipy is optional.\n"}, Level.ERROR),
        ({"requirements.txt": "scipy", "ci/setup.sh": "python3 -m pip install -r requirements.txt\n"}, Level.NOTE),
        ({"requirements.txt": "scikit-learn\n", "README.md": "pip install -r requirements.txt\n"}, Level.NOTE),
        ({"setup.py": SETUP.format('install_requires=["scikit_image>=0.20"], ')}, Level.NOTE),
        ({"requirements.txt": "scikit-learn>=1.0\n"}, Level.NOTE),
        ({"requirements.txt": "scikit-learn\n"}, Level.ERROR),
        ({"README.md": "Optional: scikit-learn\n"}, Level.ERROR),
        ({"setup.py": SETUP.format('install_requires=["numpy"], ')}, Level.ERROR),
        ({"requirements.txt": "scipy\n"}, Level.ERROR),
        ({"requirements.txt": "scipy\n", "README.md": "pip install -r docs/requirements-docs.txt\n"}, Level.ERROR),
        ({"requirements.txt": "scipy-extras\n", "README.md": "pip install -r requirements.txt\n"}, Level.ERROR),
        ({"setup.py": SETUP.format('install_requires=["setuptools"], ')}, Level.ERROR),
        ({"setup.py": SETUP.format('install_requires=[\n# "scipy",\n"setuptools"], ')}, Level.ERROR),
        ({"setup.py": SETUP.format('extras_require={"test": ["scipy"]}, ')}, Level.ERROR),
        ({"setup.py": SETUP.format("install_requires=[], ")}, Level.ERROR),
        ({"setup.py": SETUP.format("install_requires=[, ")}, Level.ERROR),
        ({"setup.cfg": "[options]\ninstall_requires =\n"}, Level.ERROR),
        ({"pyproject.toml": "dependencies = [\n"}, Level.ERROR),
    ],
)
def test_what_is_left_to_pip(files: dict[str, str], expected: Level, tmp_path: Path) -> None:
    found = results({**NODE, **files}, tmp_path)
    assert [level for level, _ in found] == [expected] or "[, " in files.get("setup.py", "")
    assert all(("unless pip is to install it, as" in message) == (level is Level.NOTE) for level, message in found)


def test_packages_of_ros_are_not_left_to_pip(tmp_path: Path) -> None:
    files = {
        "demo/main.py": MAIN.format("import cv_bridge"),
        "setup.py": SETUP.format('install_requires=["cv_bridge"], '),
    }
    ((level, _),) = results(files, tmp_path)
    assert level is Level.ERROR


def test_a_change_alone_leaves_nothing_to_pip(tmp_path: Path) -> None:
    setup = SETUP.format('install_requires=["scipy"], ')
    for number, (before, expected) in enumerate(((SETUP.format(""), Level.ERROR), (setup, Level.NOTE))):
        found = results({**NODE, "setup.py": setup}, tmp_path / str(number), {**NODE, "setup.py": before})
        assert [level for level, _ in found] == [expected]


def test_a_package_in_a_directory(tmp_path: Path) -> None:
    files = {
        "src/demo/package.xml": ROS2,
        "src/demo/setup.py": SETUP.format('install_requires=["cv2"], '),
        "src/demo/demo/__init__.py": "",
        "src/demo/demo/main.py": MAIN.format("from demo.tools import plots"),
        "src/demo/demo/old/filters.py": USE,
        "src/demo/demo/tools/plots.py": "import matplotlib\n",
        "src/demo/demo/tools/filters.py": USE,
    }
    check = next(check for check in checks() if check.id == "undeclared-import")
    found = {result.level: result.message for result in said(check, Example("", True, files), tmp_path)}
    assert set(found) == {Level.ERROR, Level.NOTE}
    assert "imports matplotlib" in found[Level.ERROR] and "imports scipy" in found[Level.NOTE]


@pytest.mark.parametrize(
    ("requirements", "expected"),
    [
        ("scipy\nmatplotlib\n", ", unless pip is to install them, as requirements.txt:1 and requirements.txt:2 say"),
        (
            "scipy==1.9\nmatplotlib\n",
            ", unless pip is to install them, as requirements.txt:1 and requirements.txt:2 say",
        ),
        ("scipy==1.9\nmatplotlib==3.5\n", ", unless pip is to install it: requirements.txt:2 asks for a version"),
    ],
)
def test_what_pip_may_install_is_told_once(requirements: str, expected: str, tmp_path: Path) -> None:
    files = {"requirements.txt": requirements, "README.md": "pip install -r requirements.txt\n"}
    ((level, message),) = results({"demo/main.py": MAIN.format("import scipy\nimport matplotlib"), **files}, tmp_path)
    assert level is Level.NOTE and expected in message and ("asks for" in message) == ("asks for" in expected)


OLDER = "#!/usr/bin/env python{}\nimport {}\nimport rospy\n\nrospy.init_node('n')\n"
PRINTS = OLDER + "print 'n'\n"
CATKIN = (
    "cmake_minimum_required(VERSION 3.0)\nproject(demo)\nfind_package(catkin REQUIRED)\ncatkin_package()\n"
    "catkin_install_python(PROGRAMS a.py b.py DESTINATION ${CATKIN_PACKAGE_BIN_DESTINATION})\n"
)


@pytest.mark.parametrize(
    ("first", "second", "words"),
    [
        (OLDER.format("2.7", "scipy"), OLDER.format("2", "scipy"), "add <exec_depend>python-scipy</exec_depend>"),
        (
            OLDER.format("2.7", "serial"),
            OLDER.format("2", "serial"),
            "</exec_depend> (of Python 3); no such key of Python 2",
        ),
        (OLDER.format("3", "scipy"), OLDER.format("2", "scipy"), "add <exec_depend>python3-scipy</exec_depend>."),
        (OLDER.format("", "scipy"), OLDER.format("", "scipy"), "add <exec_depend>python3-scipy</exec_depend>."),
        (OLDER.format("", "serial"), OLDER.format("", "serial"), "add <exec_depend>python3-serial</exec_depend>."),
        (PRINTS.format("", "scipy"), PRINTS.format("", "scipy"), "add <exec_depend>python-scipy</exec_depend>."),
        (
            PRINTS.format("", "serial"),
            PRINTS.format("", "serial"),
            "</exec_depend> (of Python 3); no such key of Python 2",
        ),
        (PRINTS.format("", "scipy"), OLDER.format("", "scipy"), "add <exec_depend>python3-scipy</exec_depend>."),
        (OLDER.format("3", "scipy"), PRINTS.format("", "scipy"), "add <exec_depend>python3-scipy</exec_depend>."),
    ],
)
def test_scripts_of_python_2(first: str, second: str, words: str, tmp_path: Path) -> None:
    files = {"package.xml": ROS1, "CMakeLists.txt": CATKIN, "a.py": first, "b.py": second}
    check = next(check for check in checks() if check.id == "undeclared-import")
    (found,) = said(check, Example("", True, files), tmp_path)
    assert words in f"{found.message}."


@pytest.mark.parametrize(
    ("page", "start", "key"),
    [
        ("For ROS Indigo.", "", "python-scipy"),
        ("Tried with Kinetic and Melodic.", "", "python-scipy"),
        ("Tried with Melodic and Noetic.", "", "python3-scipy"),
        ("For Noetic, as it is called.", "", "python3-scipy"),
        ("For ROS 1.", "", "python3-scipy"),
        ("A fork of the melodic-devel branch.", "", "python3-scipy"),
        ("See https://example.org/kinetic/scan.", "", "python3-scipy"),
        ("For ROS Indigo.", "3", "python3-scipy"),
        ("For ROS Indigo.", " -u", "python-scipy"),
    ],
)
def test_scripts_of_any_python_for_old_distributions(page: str, start: str, key: str, tmp_path: Path) -> None:
    script = OLDER.format(start, "scipy")
    files = {"package.xml": ROS1, "CMakeLists.txt": CATKIN, "a.py": script, "b.py": script, "README.md": page + "\n"}
    check = next(check for check in checks() if check.id == "undeclared-import")
    (found,) = said(check, Example("", True, files), tmp_path)
    assert f"add <exec_depend>{key}</exec_depend>" in found.message
