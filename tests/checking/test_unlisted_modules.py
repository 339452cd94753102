# SPDX-License-Identifier: Apache-2.0
"""Modules that programs load, and that packages= of setup.py does not install."""

from __future__ import annotations

from pathlib import Path

import pytest

from haros_ci.api.testing import said
from haros_ci.checking.page import Example
from haros_ci.registry import checks
from haros_ci.results.result import Result
from haros_ci.results.rule import Level

MANIFEST = (
    '<package format="3"><name>heron</name><version>1.0.0</version><description>d</description><maintainer email="a@b.cd">m</maintainer>'
    "<license>Apache-2.0</license><exec_depend>rclpy</exec_depend><export><build_type>{}</build_type></export></package>\n"
)
SETUP = (
    "from setuptools import setup\n\npackage_name = 'heron'\n"
    "setup(\n    name=package_name,\n    version='1.0.0',\n    packages=[package_name],\n"
    "    data_files=[('share/ament_index/resource_index/packages', ['resource/heron']), ('share/heron', ['package.xml'])],\n"
    "    entry_points={'console_scripts': ['swim = heron.swim:main']},\n)\n"
)
SWIM = "import rclpy\n{}\n\n\ndef main():\n    rclpy.init()\n"
AMENT = {
    "package.xml": MANIFEST.format("ament_python"),
    "setup.cfg": "[install]\ninstall_scripts=$base/lib/heron\n[develop]\nscript_dir=$base/lib/heron\n",
    "resource/heron": "",
    "heron/__init__.py": "",
    "heron/fins/__init__.py": "",
    "heron/fins/tail.py": "WIDTH = 1\n",
}


def found(imports: str, folder: Path, more: dict[str, str] | None = None, setup: str = SETUP) -> list[Result]:
    files = {**AMENT, "setup.py": setup, "heron/swim.py": SWIM.format(imports), **(more or {})}
    check = next(check for check in checks() if check.id == "python-package-incomplete")
    return list(said(check, Example("", True, files), folder))


IMPORTS = [
    "from heron.fins.tail import WIDTH",
    "import heron.fins.tail",
    "import heron.fins.tail as tail",
    "from heron.fins import tail",
    "from heron import fins",
    "from .fins.tail import WIDTH",
    "from .fins import tail",
    "from . import fins",
    "import json, heron.fins",
]


@pytest.mark.parametrize("imports", IMPORTS)
def test_a_part_of_the_package_that_the_list_lacks(imports: str, tmp_path: Path) -> None:
    (result,) = found(imports, tmp_path)
    assert result.message.rstrip(".") == (
        "setup.py of package heron does not install heron.fins, which packages= does not name: program swim stops with "
        "ModuleNotFoundError, except after colcon build --symlink-install; write packages=find_packages(exclude=['test']), or add "
        "'heron.fins' to the list"
    )
    assert result.level is Level.WARNING and result.location.path == "setup.py"


@pytest.mark.parametrize(
    ("imports", "more", "names"),
    [
        ("from heron import arm", {"heron/arm.py": "import heron.fins.tail\n"}, "heron.fins"),
        ("import heron.fins.tail", {"heron/fins/tail.py": "from .scales import a\n"}, "heron.fins"),
        (
            "import heron.fins.tail",
            {"heron/fins/tail.py": "from .bones.long import a\n", "heron/fins/bones/long.py": "a = 1\n"},
            "heron.fins and heron.fins.bones",
        ),
        (
            "import heron.fins.tail\nimport heron.eyes.left",
            {"heron/eyes/left.py": ""},
            "heron.eyes and heron.fins",
        ),
    ],
)
def test_what_other_modules_import(imports: str, more: dict[str, str], names: str, tmp_path: Path) -> None:
    first = found(imports, tmp_path, more)[-1]
    assert f"does not install {names}, which" in first.message


def test_the_program_is_in_it(tmp_path: Path) -> None:
    (result,) = found(
        "", tmp_path, {"heron/fins/tail.py": SWIM.format("")}, SETUP.replace("heron.swim", "heron.fins.tail")
    )
    assert "does not install heron.fins" in result.message and "program swim stops" in result.message


def test_a_directory_that_is_no_package_for_find_packages(tmp_path: Path) -> None:
    (result,) = found("import heron.eyes.left", tmp_path, {"heron/eyes/left.py": ""})
    assert result.message.rstrip(".").endswith("; add 'heron.eyes' to the list")


@pytest.mark.parametrize(
    ("more", "remedy"),
    [
        (
            {"plumage/__init__.py": "", "plumage/grey.py": "A = 1\n"},
            "write packages=find_packages(exclude=['test']), or add 'plumage' to the list",
        ),
        ({"plumage.py": "grey = 1\n"}, "write py_modules=['plumage'], or move plumage.py into the Python package"),
    ],
)
def test_what_lies_beside_the_package(more: dict[str, str], remedy: str, tmp_path: Path) -> None:
    (result,) = found("from plumage import grey", tmp_path, more)
    assert (
        "does not install plumage, which packages= does not name: program swim stops with ModuleNotFoundError;"
        in result.message
    )
    assert result.message.rstrip(".").endswith(remedy) and result.level is Level.ERROR


FINS = "from heron.fins.tail import WIDTH"
LISTS = [
    "packages=[package_name, 'heron.fins'],",
    "packages=[package_name, package_name + '.fins'],",
    "packages=[package_name, f'{package_name}.fins'],",
    "packages=['heron', 'heron/fins'],",
    "packages=('heron', 'heron.fins'),",
    "packages=find_packages(exclude=['test']),",
    "packages=[package_name] + find_packages(),",
    "packages=[package_name] + parts,",
    "packages=[package_name], **more(find_packages()),",
    "packages=[package_name, *parts],",
    "packages=[package_name, part()],",
    "packages=names,",
    "packages=[package_name], package_dir={'': '.'},",
    "packages=[package_name], package_data={'heron': ['fins/*.py']},",
    "packages=[package_name], include_package_data=True,",
    "packages=[package_name], py_modules=['heron.fins.tail'],",
    "packages=[package_name], cmdclass={'install': Install},",
    "",
]


@pytest.mark.parametrize("line", LISTS)
def test_quiet_where_the_list_has_it_or_may_have_it(line: str, tmp_path: Path) -> None:
    setup = SETUP.replace("packages=[package_name],", line).replace("setup(\n", "names = ['heron']\nsetup(\n")
    assert [one for one in found(FINS, tmp_path, setup=setup) if "does not install" in one.message] == []


QUIET = [
    ("", {}),
    ("from heron.arm import a", {"heron/arm.py": "a = 1\n"}),
    (f"try:\n    {FINS}\nexcept ImportError:\n    pass", {}),
    (f"if True:\n    {FINS}", {}),
    (f"def late():\n    {FINS}", {}),
    (f"# {FINS}", {}),
    (f"'''\n{FINS}\n'''", {}),
    (f"import sys\nsys.path.append('/opt/heron')\n{FINS}", {}),
    (f"import importlib\n{FINS}", {}),
    ("from heron import fins", {"heron/__init__.py": "fins = 1\n"}),
    ("from heron import fins", {"heron/fins/__init__.py": "", "heron/__init__.py": "def fins():\n    pass\n"}),
    ("import heron.msg", {}),
    ("import fins", {}),
    ("from plumage import grey", {"plumage/__init__.py": "grey = 1\n", "requirements.txt": "plumage==1.0\n"}),
    ("import json", {"json.py": ""}),
    ("import serial", {"serial/__init__.py": ""}),
    ("from heron.arm import a", {"heron/arm.py": "a = 1\n", "heron/spare.py": f"{FINS}\n"}),
    (FINS, {"setup.cfg": f"{AMENT['setup.cfg']}[options.package_data]\nheron = fins/*.py\n"}),
    (FINS, {"setup.cfg": f"{AMENT['setup.cfg']}[options]\ninclude_package_data = True\n"}),
    (FINS, {"pyproject.toml": "[tool.setuptools]\npackages = ['heron', 'heron.fins']\n"}),
]


@pytest.mark.parametrize(("imports", "more"), QUIET)
def test_quiet_on_what_is_not_loaded_or_may_be_there(imports: str, more: dict[str, str], tmp_path: Path) -> None:
    assert [one for one in found(imports, tmp_path, more) if "does not install" in one.message] == []


@pytest.mark.parametrize(
    "data",
    [
        "data_files=[('lib/python3.12/site-packages/heron/fins', ['heron/fins/tail.py']), ",
        "data_files=[('lib/heron/heron/fins', ['heron/fins/tail.py', 'heron/fins/__init__.py']), ",
        "data_files=[(get_python_lib() + '/heron', glob('heron/*/*.py')), ",
    ],
)
def test_quiet_where_data_files_bring_it(data: str, tmp_path: Path) -> None:
    setup = SETUP.replace("data_files=[", data)
    assert [one for one in found(FINS, tmp_path, setup=setup) if "does not install" in one.message] == []


def test_a_share_directory_brings_no_module(tmp_path: Path) -> None:
    setup = SETUP.replace("data_files=[", "data_files=[('share/heron/fins', ['heron/fins/tail.py']), ")
    assert len(found(FINS, tmp_path, setup=setup)) == 1


def test_a_directory_that_the_list_names_in_vain_is_one_finding(tmp_path: Path) -> None:
    (result,) = found(FINS, tmp_path, setup=SETUP.replace("[package_name]", "[package_name, 'heron.fin']"))
    assert "heron.fin" in result.message and "does not exist" in result.message


LINKED = "```\ncolcon build --symlink-install\n```\n"


@pytest.mark.parametrize(
    ("pages", "level"),
    [
        ({"README.md": LINKED}, Level.NOTE),
        ({"README.md": "colcon build \\\n  --packages-up-to heron \\\n  --symlink-install\n"}, Level.NOTE),
        (
            {"README.md": LINKED, "build.sh": "colcon build --symlink-install --packages-select a && ros2 run a b\n"},
            Level.NOTE,
        ),
        ({}, Level.WARNING),
        ({"README.md": "A heron.\n"}, Level.WARNING),
        ({"README.md": "colcon build\n"}, Level.WARNING),
        ({"README.md": f"{LINKED}Or `colcon build`.\n"}, Level.WARNING),
        ({"README.md": LINKED, "Dockerfile": "RUN colcon build\n"}, Level.WARNING),
        ({"README.md": LINKED, ".gitlab-ci.yml": "run: colcon build --merge-install\n"}, Level.WARNING),
        ({"README.md": LINKED, "release.sh": "bloom-release heron\n"}, Level.WARNING),
        ({"README.md": "ln --symlink-install\ncatkin_make\n"}, Level.WARNING),
    ],
)
def test_levels(pages: dict[str, str], level: Level, tmp_path: Path) -> None:
    assert [result.level for result in found(FINS, tmp_path, pages)] == [level]


def test_a_change_alone_tells_of_no_links(tmp_path: Path) -> None:
    files = {**AMENT, "setup.py": SETUP, "heron/swim.py": SWIM.format(FINS), "README.md": LINKED}
    check = next(check for check in checks() if check.id == "python-package-incomplete")
    for base, level in (("A heron.\n", Level.WARNING), (LINKED, Level.NOTE)):
        example = Example("", True, files, base={"README.md": base})
        assert [result.level for result in said(check, example, tmp_path / level.value)] == [level]


def test_programs_that_load_the_same(tmp_path: Path) -> None:
    setup = SETUP.replace("heron.swim:main'", "heron.swim:main', 'dive = heron.dive:main', 'wade = heron.wade:main'")
    more = {
        "heron/dive.py": SWIM.format(
            "from heron import wade\nimport sys\nsys.path.append('/opt')\nimport heron.eyes.left"
        ),
        "heron/wade.py": SWIM.format("from heron import swim\nimport heron.beak.tip"),
        "heron/eyes/left.py": "",
        "heron/beak/tip.py": "",
    }
    (result,) = found(FINS, tmp_path, more, setup)
    assert "does not install heron.beak and heron.fins, which" in result.message
    assert "programs wade and swim stop with" in result.message


def test_many_programs_that_load_each_other(tmp_path: Path) -> None:
    count = 60
    programs = "".join(f", 's{number} = heron.s{number}:main'" for number in range(count))
    imports = "".join(f"import heron.s{number}\n" for number in range(count))
    more = {f"heron/s{number}.py": SWIM.format(imports) for number in range(count)}
    setup = SETUP.replace("heron.swim:main'", f"heron.swim:main'{programs}")
    assert len(found(FINS, tmp_path, more, setup)) == 1
