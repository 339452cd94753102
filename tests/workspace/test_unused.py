# SPDX-License-Identifier: Apache-2.0
"""Which files nothing uses, and which of them was used before."""

from __future__ import annotations

from pathlib import Path

import pytest

from haros_ci.workspace.discover import discover
from haros_ci.workspace.unused import Unused

MANIFEST = (
    '<package format="3"><name>demo</name><version>1.0.0</version><buildtool_depend>ament_cmake</buildtool_depend>'
    "<export><build_type>ament_cmake</build_type></export></package>"
)
CMAKE = "find_package(ament_cmake REQUIRED)\nadd_executable(walk src/walk.cpp)\n{}\nament_package()\n"
NODE = "def main():\n    pass\n\nif __name__ == '__main__':\n    main()\n"
MODULE = '"""Says something."""\nimport os\n\nLIMIT = 3\n\ndef pick():\n    return os.sep\n'


def unused(root: Path, path: str, files: dict[str, str]) -> bool:
    for name, text in files.items():
        (root / name).parent.mkdir(parents=True, exist_ok=True)
        (root / name).write_text(text)
    return path in Unused(discover(root, (".",))).among([path])


def cpp(more: str = "", **files: str) -> dict[str, str]:
    return {
        "package.xml": MANIFEST,
        "CMakeLists.txt": CMAKE.format(more),
        "src/walk.cpp": "int main() { return 0; }\n",
        "src/trial.cpp": "int main() { return 1; }\n",
        **files,
    }


FIRES_CPP = [
    cpp(),
    cpp("# add_executable(trial src/trial.cpp)"),
    cpp("add_executable(other src/other.cpp)"),
    cpp(**{"Dockerfile": "FROM ros:humble\n", "README.md": "See src/trial.cpp\n"}),
    cpp(**{"firmware/Makefile": "all:\n"}),
]
QUIET_CPP = [
    cpp("add_executable(trial src/trial.cpp)"),
    cpp("if(WITH_TRIAL)\n  add_executable(trial src/trial.cpp)\nendif()"),
    cpp("file(GLOB all src/*.cpp)\nadd_library(all ${all})"),
    cpp("foreach(each walk trial)\n  add_executable(${each}_node src/${each}.cpp)\nendforeach()"),
    cpp("some_macro_of_another_package()\ninclude(cmake/more.cmake)"),
    cpp("add_subdirectory(elsewhere)"),
    cpp("aux_source_directory(src all)"),
    cpp(**{"src/more.cpp": '#include "trial.cpp"\n'}),
    cpp(**{"src/Makefile": "trial: trial.cpp\n"}),
    cpp(**{"platformio.ini": "[env]\n"}),
    cpp(**{"src/board.ioc": "Mcu=1\n"}),
    cpp(**{"setup.py": "from setuptools import Extension\ne = Extension('demo', ['src/trial.cpp'])\n"}),
    cpp(**{"build.sh": "#!/bin/sh\ng++ src/trial.cpp\n"}),
    {"src/trial.cpp": "int main() { return 1; }\n"},
    {"package.xml": MANIFEST, "src/trial.cpp": "int main() { return 1; }\n"},
]


@pytest.mark.parametrize("files", FIRES_CPP)
def test_a_source_that_no_target_compiles(tmp_path: Path, files: dict[str, str]) -> None:
    assert unused(tmp_path, "src/trial.cpp", files)


@pytest.mark.parametrize("files", QUIET_CPP)
def test_a_source_that_may_be_compiled(tmp_path: Path, files: dict[str, str]) -> None:
    assert not unused(tmp_path, "src/trial.cpp", files)


TRIALS = {
    "src/sandbox/package.xml": MANIFEST.replace("demo", "sandbox"),
    "src/demo/package.xml": MANIFEST,
}
FIRES_PYTHON = [
    ("demo/pick_old.py", {"demo/pick_old.py": NODE, "demo/pick.py": NODE, "demo/__init__.py": ""}),
    ("demo/draft.py", {"demo/draft.py": NODE}),
    ("demo/untitled1.py", {"demo/untitled1.py": NODE}),
    ("demo/scratch_paper.py", {"demo/scratch_paper.py": NODE}),
    ("demo/scribble.py", {"demo/scribble.py": NODE}),
    ("demo/old version/pick.py", {"demo/old version/pick.py": NODE}),
    ("previous_versions/pick.py", {"previous_versions/pick.py": NODE}),
    ("demo/tmp.py", {"demo/tmp.py": MODULE}),
    ("scripts/2_uneeded_scripts/pick.py", {"scripts/2_uneeded_scripts/pick.py": NODE}),
    ("scripts/unused-stuff/pick.py", {"scripts/unused-stuff/pick.py": NODE}),
    ("demo/pick copy.py", {"demo/pick copy.py": NODE, "demo/pick.py": NODE}),
    (
        "demo/pick copy.py",
        {"demo/pick copy.py": NODE, "demo/pick.py": "import importlib\nimportlib.import_module(name)\n"},
    ),
    ("src/sandbox/src/pick.py", {"src/sandbox/src/pick.py": NODE, **TRIALS}),
    (
        "src/sandbox/src/pick.py",
        {"src/sandbox/src/pick.py": NODE, "src/sandbox/src/walk.py": "import pick\n", **TRIALS},
    ),
    (
        "src/sandbox/go2dock.py",
        {"src/sandbox/go2dock.py": NODE, **TRIALS, "src/demo/a.py": "rospy.Publisher('/go2dock/x', A)\ngo2dock = 1\n"},
    ),
    ("demo/pick copy 2.py", {"demo/pick copy 2.py": NODE, "demo/pick.py": NODE}),
    ("demo/pick - Copy (2).py", {"demo/pick - Copy (2).py": NODE, "demo/pick.py": NODE}),
    ("demo/pick (1).py", {"demo/pick (1).py": NODE, "demo/pick.py": NODE}),
    ("demo/pick(1).py", {"demo/pick(1).py": NODE, "demo/pick.py": NODE}),
    ("demo/Copy of pick.py", {"demo/Copy of pick.py": NODE, "demo/pick.py": NODE}),
    ("demo/pick_fast_old.py", {"demo/pick_fast_old.py": NODE, "demo/pick_fast.py": NODE}),
    ("demo/pick_old.py", {"demo/pick_old.py": NODE, "demo/pick_fast.py": NODE}),
    ("scripts/archive/walk.py", {"scripts/archive/walk.py": NODE, "scripts/pick.py": NODE}),
    ("demo/legacy/walk.py", {"demo/legacy/walk.py": NODE, "demo/legacy/load.py": "import_module(name)\n"}),
    ("demo/legacy_ros1/walk.py", {"demo/legacy_ros1/walk.py": NODE}),
    ("demo/old_scripts/walk.py", {"demo/old_scripts/walk.py": NODE}),
    ("demo/nodes-deprecated/walk.py", {"demo/nodes-deprecated/walk.py": NODE}),
    (
        "legacy/scripts/walk.py",
        {
            "package.xml": MANIFEST,
            "CMakeLists.txt": "add_subdirectory(new)\n",
            "legacy/scripts/walk.py": NODE,
            "legacy/CMakeLists.txt": "install(PROGRAMS scripts/walk.py DESTINATION bin)\n",
        },
    ),
    (
        "demo/legacy/walk.py",
        {"demo/legacy/walk.py": NODE, "demo/legacy/pick.py": "import walk\n", "go.py": "from demo import pickle\n"},
    ),
    ("demo/old2/walk.py", {"demo/old2/walk.py": NODE, "demo/legacy/load.py": "__import__(name)\n"}),
    ("Old/walk.py", {"Old/walk.py": NODE}),
    # what is named is a module or file of another directory, whether it is there or not
    ("demo/old/walk_on.py", {"demo/old/walk_on.py": NODE, "setup.py": "x = ['walk = demo.walk_on:main']\n"}),
    ("demo/old/walk.py", {"demo/old/walk.py": NODE, "setup.py": "x = ['walk_node = demo.walk:main']\n"}),
    ("demo/old/walk_on.py", {"demo/old/walk_on.py": NODE, "go.py": "from demo.walk_on import main\n"}),
    ("demo/old/walk_on.py", {"demo/old/walk_on.py": NODE, "README.md": "Run demo/walk_on.py\n"}),
    ("demo/old/walk_on.py", {"demo/old/walk_on.py": NODE, "go.py": "self.walk_on()\n"}),
    ("demo/old/CBF.py", {"demo/old/CBF.py": NODE, "README.md": "with the CBF-enabled control\n"}),
    ("demo/old/Walk.py", {"demo/old/Walk.py": NODE, "go.py": "class Walk:\n    pass\n"}),
    ("demo/old/walk_on.py", {"demo/old/walk_on.py": NODE, "go.py": "import pkgutil\n"}),
    ("demo/old/walk_on.py", {"demo/old/walk_on.py": NODE, "go.py": "import pkgutil\npkgutil.get_data('a', 'b')\n"}),
    ("demo/pick-backup2.py", {"demo/pick-backup2.py": "#!/usr/bin/env python3\n" + NODE, "demo/pick.py": NODE}),
    ("demo/old_pick.py", {"demo/old_pick.py": MODULE, "demo/pick.py": MODULE}),
    ("notes/archive/test_pick.py", {"notes/archive/test_pick.py": NODE}),
    ("notes/archive/pick_test.py", {"notes/archive/pick_test.py": NODE}),
    ("archive/pick.py", {"archive/pick.py": NODE, "archive/walk.py": "from pick import main\n"}),
    (
        "a_uneeded_b/pick.py",
        {"a_uneeded_b/pick.py": NODE, "README.md": "how to pick\n", "go.py": "pub('/pick/up')\npick = 1\n"},
    ),
    (
        "notes/pick.py",
        {"notes/pick.py": NODE, "notes/archive/walk.py": "from pick import main\n", "src/demo/package.xml": MANIFEST},
    ),
    ("my_notes/pick.py", {"my_notes/pick.py": NODE, "src/demo/package.xml": MANIFEST}),
    ("code_for_testing/gui/pick.py", {"code_for_testing/gui/pick.py": NODE, "src/demo/package.xml": MANIFEST}),
    ("demo/pick.py", {"demo/pick.py": f'"""DEPRECATED: kept for reference, do not use."""\n{NODE}'}),
    ("demo/pick.py", {"demo/pick.py": f"#!/usr/bin/env python3\n# This script is deprecated, see walk.py.\n\n{NODE}"}),
    ("demo/pick.py", {"demo/pick.py": f"#!/usr/bin/env python3\n'''\n** Deprecated **\nPicks.\n'''\n{NODE}"}),
]
QUIET_PYTHON = [
    ("demo/pick_old.py", {"demo/pick_old.py": NODE, "demo/pick.py": "from demo import pick_old\n"}),
    ("demo/pick_old.py", {"demo/pick_old.py": NODE, "demo/pick.py": NODE, "setup.py": "x = 'demo.pick_old:main'\n"}),
    ("demo/pick_old.py", {"demo/pick_old.py": NODE, "demo/pick.py": NODE, "README.md": "Run pick_old.py\n"}),
    (
        "demo/pick_old.py",
        {"demo/pick_old.py": NODE, "demo/pick.py": NODE, "start.sh": "#!/bin/sh\npython3 demo/pick_old.py\n"},
    ),
    ("demo/pick_old.py", {"demo/pick_old.py": NODE, "demo/pick.py": NODE, "a.launch": "<node type='pick_old.py'/>\n"}),
    ("demo/pick_old.py", {"demo/pick_old.py": NODE, "demo/walk.py": NODE}),
    ("archive/walk.py", {"archive/walk.py": NODE, "start.sh": "#!/bin/sh\npython3 archive/walk.py\n"}),
    ("archive/walk.py", {"archive/walk.py": NODE, "README.md": "The archive has walk.py\n"}),
    ("archive/walk.py", {"archive/walk.py": NODE, "go.py": "import os, walk\n"}),
    ("archive/walk.py", {"archive/walk.py": NODE, "go.py": "from archive import (\n    walk,\n)\n"}),
    ("archive/walk.py", {"archive/walk.py": NODE, "go.py": "load('walk')\n"}),
    ("archive/walk.py", {"archive/walk.py": NODE, "go.sh": "python archive/walk.py\n"}),
    ("archive/walk_on.py", {"archive/walk_on.py": NODE, "README.md": "how to walk_on\n"}),
    ("walk_old.py", {"walk_old.py": NODE, "walk.py": NODE, "README.md": "how to walk_old\n"}),
    ("archives_of_data/walk.py", {"archives_of_data/walk.py": NODE}),
    ("legacy_arm/walk.py", {"legacy_arm/walk.py": NODE}),
    ("demo/old_town/walk.py", {"demo/old_town/walk.py": NODE}),
    ("demo/ros1/walk.py", {"demo/ros1/walk.py": NODE}),
    ("demo/legacy/walk.py", {"demo/legacy/walk.py": NODE, "demo/load.py": "import_module(name)\n"}),
    ("demo/legacy_ros1/walk.py", {"demo/legacy_ros1/walk.py": NODE, "demo/a.launch": "<node type='walk.py'/>\n"}),
    ("demo/legacy/walk.py", {"demo/legacy/walk.py": NODE, "demo/go.py": "from demo.legacy.walk import main\n"}),
    (
        "demo/legacy/walk.py",
        {
            "demo/legacy/walk.py": NODE,
            "demo/legacy/pick.py": "import walk\n",
            "go.py": "from demo.legacy import pick\n",
        },
    ),
    (
        "demo/legacy/walk.py",
        {
            "demo/legacy/walk.py": NODE,
            "demo/legacy/pick.py": "import turn_on\n",
            "demo/legacy/turn_on.py": "import walk\n",
            "demo/a.launch": "<node type='pick.py'/>\n",
        },
    ),
    (
        "demo/legacy/walk.py",
        {
            "demo/legacy/walk.py": NODE,
            "demo/legacy/pick.py": "import_module(name)\n",
            "demo/go.py": "from demo.legacy import pick\n",
        },
    ),
    (
        "legacy/demo/demo/walk.py",
        {
            "legacy/demo/demo/walk.py": NODE,
            "legacy/demo/package.xml": MANIFEST,
            "legacy/demo/setup.py": "setup(entry_points={'console_scripts': ['walk = demo.walk:main']})\n",
        },
    ),
    (
        "demo/legacy/walk.py",
        {"demo/legacy/walk.py": NODE, "setup.py": "x = ['walk = demo.legacy.walk:main']\n"},
    ),
    ("demo/legacy/walk.py", {"demo/legacy/walk.py": NODE, "go.py": "load('demo.legacy.walk')\n"}),
    (
        "legacy/scripts/walk.py",
        {
            "package.xml": MANIFEST,
            "CMakeLists.txt": "add_subdirectory(legacy)\n",
            "legacy/scripts/walk.py": NODE,
            "legacy/CMakeLists.txt": "install(PROGRAMS scripts/walk.py DESTINATION bin)\n",
        },
    ),
    (
        "legacy/demo/scripts/walk.py",
        {
            "legacy/demo/scripts/walk.py": NODE,
            "legacy/demo/package.xml": MANIFEST,
            "legacy/demo/CMakeLists.txt": "install(PROGRAMS scripts/walk.py DESTINATION bin)\n",
        },
    ),
    ("archive/pick.py", {"archive/pick.py": NODE, "walk.py": "from archive.pick import main\n"}),
    ("src/sandbox/a.py", {"src/sandbox/a.py": NODE, "package.xml": MANIFEST.replace("demo", "sandbox")}),
    ("src/sandbox/pick.py", {"src/sandbox/pick.py": NODE, **TRIALS, "src/demo/a.launch": "<node type='pick.py'/>\n"}),
    (
        "src/sandbox/pick.py",
        {"src/sandbox/pick.py": NODE, **TRIALS, "src/sandbox/CMakeLists.txt": "install(PROGRAMS pick.py)\n"},
    ),
    ("src/demo/pick.py", {"src/demo/pick.py": NODE, **TRIALS}),
    ("demo/version of old/pick.py", {"demo/version of old/pick.py": NODE}),
    ("previous/pick.py", {"previous/pick.py": NODE}),
    ("demo/scribbled.py", {"demo/scribbled.py": NODE}),
    ("demo/old/CBF.py", {"demo/old/CBF.py": NODE, "go.py": "from demo.old.CBF import CBF\n"}),
    ("demo/old/CBF.py", {"demo/old/CBF.py": NODE, "README.md": "python3 old/CBF.py\n"}),
    ("archive/conftest.py", {"archive/conftest.py": NODE}),
    *(
        ("demo/old/walk_on.py", {"demo/old/walk_on.py": NODE, "go.py": text})
        for text in (
            "import pkgutil\npkgutil.walk_packages(p)\n",
            "import pkgutil as p\np.walk_packages(a)\n",
            "from pkgutil import walk_packages\n",
        )
    ),
    ("demo/old/walk_on.py", {"demo/old/walk_on.py": NODE, "setup.py": "x = ['walk = demo.old.walk_on:main']\n"}),
    ("demo/old/walk.py", {"demo/old/walk.py": NODE, "setup.py": "x = ['walk_node = demo.old.walk:main']\n"}),
    ("demo/old/walk_on.py", {"demo/old/walk_on.py": NODE, "go.py": "from demo.old import walk_on\n"}),
    ("demo/old/walk_on.py", {"demo/old/walk_on.py": NODE, "demo/go.py": "from .walk_on import main\n"}),
    ("demo/old/walk_on.py", {"demo/old/walk_on.py": NODE, "demo/go.py": "sys.path.append('old')\nimport walk_on\n"}),
    ("demo/old/walk_on.py", {"demo/old/walk_on.py": NODE, "go.sh": "cd demo/old && ./walk_on.py\n"}),
    ("demo/old/walk_on.py", {"demo/old/walk_on.py": NODE, "demo/a.launch": "<node type='walk_on.py'/>\n"}),
    ("notes/pick.py", {"notes/pick.py": NODE}),
    ("notes/pick.py", {"notes/pick.py": NODE, "src/demo/package.xml": MANIFEST, "README.md": "Run notes/pick.py\n"}),
    ("src/demo/testing/pick.py", {"src/demo/testing/pick.py": NODE, "src/demo/package.xml": MANIFEST}),
    ("server/pick.py", {"server/pick.py": NODE, "src/demo/package.xml": MANIFEST}),
    ("notebook/pick.py", {"notebook/pick.py": NODE, "src/demo/package.xml": MANIFEST}),
    ("demo/pick.py", {"demo/pick.py": f'"""Picks; without deprecated calls."""\n{NODE}'}),
    ("demo/pick.py", {"demo/pick.py": f'"""Lists the names that are deprecated."""\n{NODE}'}),
    ("demo/pick.py", {"demo/pick.py": f'{NODE}# DEPRECATED\ndef other():\n    """DEPRECATED"""\n'}),
    ("demo/pick.py", {"demo/pick.py": f'"""DEPRECATED"""\n{NODE}', "demo/walk.py": "from demo import pick\n"}),
    (
        "archive/walk.py",
        {"archive/walk.py": NODE, "CMakeLists.txt": "install(PROGRAMS archive/walk.py DESTINATION bin)\n"},
    ),
    ("demo/draft.py", {"demo/draft.py": NODE, "demo/go.launch": "<node type='draft.py'/>\n"}),
    ("demo/draft_board.py", {"demo/draft_board.py": NODE}),
    ("demo/temperature.py", {"demo/temperature.py": NODE}),
    ("scripts/2_uneeded_scripts/pick.py", {"scripts/2_uneeded_scripts/pick.py": NODE, "README.md": "Run pick.py\n"}),
    ("scripts/needed_scripts/pick.py", {"scripts/needed_scripts/pick.py": NODE}),
    ("demo/pick copy.py", {"demo/pick copy.py": NODE, "demo/walk.py": NODE}),
    ("demo/pick copy.py", {"demo/pick copy.py": NODE, "demo/pick.py": NODE, "a.sh": "python3 'demo/pick copy.py'\n"}),
    ("demo/pick(one).py", {"demo/pick(one).py": NODE, "demo/pick.py": NODE}),
    ("demo/photocopy.py", {"demo/photocopy.py": NODE, "demo/photo.py": NODE}),
    ("demo/threshold.py", {"demo/threshold.py": NODE, "demo/thresh.py": NODE}),
    (
        "demo/pick_old.py",
        {"demo/pick_old.py": NODE, "demo/pick.py": "import importlib\nimportlib.import_module(name)\n"},
    ),
    ("demo/pick.py", {"demo/pick.py": MODULE, "demo/__init__.py": ""}),
    ("bin/pick.py", {"package.xml": MANIFEST, "bin/pick.py": MODULE, "setup.py": "s = glob('bin/*.py')\n"}),
    ("bin/pick.py", {"package.xml": MANIFEST, "bin/pick.py": MODULE, "CMakeLists.txt": "file(GLOB all bin/*.py)\n"}),
    ("demo/pick.py", {"demo/pick.py": MODULE + "\npick()\n"}),
    ("demo/pick.py", {"demo/pick.py": NODE}),
    ("demo/pick.py", {"demo/pick.py": "#!/usr/bin/env python3\n" + MODULE}),
    ("demo/pick.py", {"demo/pick.py": MODULE, "demo/walk.py": "from pick import LIMIT\n"}),
    ("demo/pick.py", {"demo/pick.py": MODULE, "CMakeLists.txt": "install(PROGRAMS demo/pick.py DESTINATION lib)\n"}),
    ("demo/pick.py", {"demo/pick.py": "def (:\n"}),
    ("demo/pick.py", {"demo/pick.py": "LIMIT = 3\n"}),
    ("scripts/chooser.py", {"scripts/chooser.py": MODULE, "scripts/walk.py": NODE}),
    ("control.py", {"control.py": MODULE}),
    ("test/test_pick.py", {"test/test_pick.py": MODULE}),
    ("test/helper_old.py", {"test/helper_old.py": MODULE, "test/helper.py": MODULE}),
    ("demo/conftest.py", {"demo/conftest.py": MODULE}),
    ("launch/pick.launch.py", {"launch/pick.launch.py": MODULE}),
    ("setup.py", {"setup.py": MODULE}),
    ("plugins/pick.py", {"plugins/pick.py": MODULE}),
]


@pytest.mark.parametrize(("path", "files"), FIRES_PYTHON)
def test_a_module_that_nothing_names(tmp_path: Path, path: str, files: dict[str, str]) -> None:
    assert unused(tmp_path, path, files)


@pytest.mark.parametrize(("path", "files"), QUIET_PYTHON)
def test_a_module_that_something_may_use(tmp_path: Path, path: str, files: dict[str, str]) -> None:
    assert not unused(tmp_path, path, files)


def test_only_what_was_unused_before(tmp_path: Path) -> None:
    files = {"pick_old.py": NODE, "pick.py": NODE, "walk.py": NODE}
    for name in ("before", "now"):
        (tmp_path / name).mkdir()
        for path, text in files.items():
            (tmp_path / name / path).write_text(text)
    before, now = (discover(tmp_path / name, (".",)) for name in ("before", "now"))
    asked = Unused(now, Unused(before))
    assert asked.among(["pick_old.py", "walk.py"]) == {"pick_old.py"} == {*asked.found}
    assert not Unused(now, is_known=False).among(["pick_old.py"])
    (tmp_path / "before" / "README.md").write_text("Run pick_old.py\n")
    assert not Unused(now, Unused(discover(tmp_path / "before", (".",)))).among(["pick_old.py"])
    (tmp_path / "before" / "README.md").unlink()
    (tmp_path / "before" / "pick_old.py").rename(tmp_path / "before" / "pick_backup.py")
    before = discover(tmp_path / "before", (".",))
    assert not Unused(now, Unused(before)).among(["pick_old.py"])
    assert Unused(now, Unused(before), {"pick_backup.py": "pick_old.py"}).among(["pick_old.py"])


def test_a_file_that_is_not_there(tmp_path: Path) -> None:
    asked = Unused(discover(tmp_path, (".",)))
    assert not asked.among(["gone.py"]) and asked.found == ()
