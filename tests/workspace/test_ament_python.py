# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import pytest
from in_memory import workspace_of

from haros_ci.model.build import Build
from haros_ci.workspace.build import builds

MANIFEST = "<package format='3'><name>arm</name><export><build_type>ament_python</build_type></export></package>"
FILES = ("arm/__init__.py", "arm/talker.py", "src/core/node.py", "launch/a.launch.py", "launch/deep/b.launch.py")


def read(setup: str, cfg: str = "", **texts: str) -> Build:
    files = {"p/package.xml": MANIFEST, "p/setup.py": setup, "p/setup.cfg": cfg}
    files |= {f"p/{path}": "x = 1\n" for path in FILES}
    files |= {f"p/{name.replace('__', '/').replace('_yaml', '.yaml')}": text for name, text in texts.items()}
    return builds(workspace_of({path: text for path, text in files.items() if text}))["arm"]


def installed(build: Build) -> list[tuple[str, str]]:
    return [(each.path, each.destination) for each in build.installed]


A = ("p/launch/a.launch.py", "share/arm/launch")
B = ("p/launch/deep/b.launch.py", "share/arm")
HEAD = "import os\nfrom glob import glob\nfrom setuptools import setup\npackage_name = 'arm'\n"


@pytest.mark.parametrize(
    ("setup", "expected"),
    [
        (
            "setup(data_files=[(os.path.join('share', package_name, 'launch'), "
            "glob(os.path.join('launch', '*launch.[pxy][yma]*')))])",
            [A],
        ),
        ("setup(data_files=[('share/' + package_name + '/launch', glob('launch/*.launch.py'))])", [A]),
        ("setup(data_files=[(f'share/{package_name}/launch', glob('launch/*'))])", [A]),
        ("files = [('share/arm/launch', glob('launch/*'))]\nsetup(data_files=files)", [A]),
        ("files = []\nfiles.append(('share/arm/launch', glob('launch/*')))\nsetup(data_files=files)", [A]),
        ("files = []\nfiles.extend([('share/arm/launch', ['launch/a.launch.py'])])\nsetup(data_files=files)", [A]),
        ("files = []\nfiles += [('share/arm/launch', ['launch/a.launch.py'])]\nsetup(data_files=files)", [A]),
        ("files = []\nfiles = files + [('share/arm/launch', ['launch/a.launch.py'])]\nsetup(data_files=files)", [A]),
        (
            "setup(data_files=[('share/arm/launch', glob('launch/*.py'))] + [('share/arm', glob('launch/deep/*'))])",
            [A, B],
        ),
        ("setup(data_files=[('share/arm', glob('launch/**/b*.py', recursive=True))])", [B]),
        ("setup(data_files=[('share/arm', glob('launch/**/b*.py'))])", [B]),
        ("setup(data_files=[('share/arm', glob('../*'))])", []),
        ("setup(data_files=[])", []),
        ("setup()", []),
    ],
)
def test_data_files(setup: str, expected: list[tuple[str, str]]) -> None:
    build = read(HEAD + setup)
    assert (installed(build), build.problems) == (expected, ())


@pytest.mark.parametrize(
    "setup",
    [
        "setup(data_files=find_data())",
        "setup(data_files=[(d, glob(d + '/*')) for d in os.listdir('.')])",
        "files = files\nsetup(data_files=files)",
        "files = other()\nfiles += files\nsetup(data_files=files)",
        "setup(data_files=missing)",
    ],
)
def test_data_files_that_are_computed(setup: str) -> None:
    build = read(HEAD + setup)
    assert installed(build) == []
    assert {p.message for p in build.problems} == {
        "data_files is computed when setup.py runs; what it names is missing here"
    }


@pytest.mark.parametrize(
    "setup",
    [
        "for d in os.listdir('.'):\n  files.append((d, [d + '/a']))\n",
        "for d, _, names in os.walk('resource'):\n  for name in names:\n    files += [(d, [name])]\n",
        "while more():\n  files.extend(next_ones())\n",
        "[files.append((d, [d])) for d in os.listdir('.')]\n",
        "def fill():\n  files.append(('share/arm/launch', glob('launch/*')))\nfill()\n",
        "def fill(to):\n  to.append(('share/arm/launch', glob('launch/*')))\nfill(files)\n",
        "more = []\nfor name in os.listdir('.'):\n  more.append(name)\nfiles.append(('share/arm/more', more))\n",
    ],
)
def test_data_files_that_something_fills(setup: str) -> None:
    """What is written out is known all the same."""
    text = f"files = [('share/arm/launch', glob('launch/*.launch.py'))]\n{setup}setup(data_files=files)"
    build = read(HEAD + text)
    assert installed(build) == [A]
    assert {p.message.partition(" is ")[2] for p in build.problems} == {
        "computed when setup.py runs; what it names is missing here"
    }


@pytest.mark.parametrize(
    "setup",
    [
        "for d in os.listdir('.'):\n  others.append(d)\n",
        "def main():\n  files.append(('share/arm', []))\nmain()\n",
        "print(files)\n",
        "count = len(files)\n",
    ],
)
def test_data_files_that_nothing_else_fills(setup: str) -> None:
    text = f"files = [('share/arm/launch', glob('launch/*.launch.py'))]\n{setup}setup(data_files=files)"
    build = read(HEAD + text)
    assert (installed(build), build.problems) == ([A], ())


def test_lists_that_refer_to_each_other_come_to_an_end() -> None:
    text = "a = []\nb = []\n" + "a += b\nb += a\n" * 400 + "setup(data_files=a)"
    assert [p.message.partition(" ")[0] for p in read(HEAD + text).problems[:1]] == ["data_files"]


CFG = """\
[metadata]
name = arm

[options]
packages = find:
package_dir =
    = src
    other = lib

# programs
[options.entry_points]
console_scripts =
    talk = core.node:main
    ; not = this:one
    gone = core.gone:main [extra]
    broken
gui_scripts =
    other = core.node:main
[develop]
script_dir=$base/lib/arm
"""


def test_entry_points_of_setup_cfg() -> None:
    build = read("from setuptools import setup\nsetup()\n", CFG)
    assert [
        (e.name, e.module, e.function, e.path, e.location.path, e.location.line, e.location.column)
        for e in build.entry_points
    ] == [
        ("talk", "core.node", "main", "p/src/core/node.py", "p/setup.cfg", 13, 5),
        ("gone", "core.gone", "main", "", "p/setup.cfg", 15, 5),
    ]
    assert build.python_roots == (("", "p/src"), ("other", "p/lib"))


@pytest.mark.parametrize(
    ("setup", "cfg", "expected"),
    [
        ("setup(entry_points={'console_scripts': ['t = arm.talker:main']})", CFG, ["t"]),
        ("setup(entry_points={})", CFG, []),
        ("setup()", "[options.entry_points]\nconsole_scripts = t = arm.talker:main\n", ["t"]),
        ("setup()", "[options.entry_points]\nconsole_scripts:\n\tt = arm.talker:main\n", ["t"]),
        ("setup()", "[options.entry_points]\nlaunch.frontend =\n  t = arm.talker:main\n", []),
        ("setup()", "[other]\nconsole_scripts =\n  t = arm.talker:main\n", []),
        ("setup()", "console_scripts =\n  t = arm.talker:main\n", []),
        ("setup()", "[[[\n" + "=" * 2_000 + "\n = \n", []),
    ],
)
def test_where_entry_points_come_from(setup: str, cfg: str, expected: list[str]) -> None:
    assert [e.name for e in read(HEAD + setup, cfg).entry_points] == expected


MODULE = "from generate_parameter_library_py.setup_helper import generate_parameter_module\n"


@pytest.mark.parametrize(
    "setup",
    [
        "generate_parameter_module('params', 'arm/p.yaml')",
        "generate_parameter_module('params', 'arm/p.yaml', validation_module='arm.check')",
        "generate_parameter_module(module_name='params', yaml_file='arm/p.yaml')",
        "name = 'params'\nif len(sys.argv) >= 2:\n  generate_parameter_module(name, package_name + '/p.yaml')",
        "from x.setup_helper import generate_parameter_module as g\ng('params', 'arm/p.yaml')",
    ],
)
def test_parameter_modules(setup: str) -> None:
    build = read(HEAD + MODULE + setup, arm__p_yaml="ns: {a: {type: int}}")
    (found,) = build.parameter_libraries
    assert (found.name, found.package, found.path, found.language) == ("params", "arm", "p/arm/p.yaml", "python")
    assert (found.location.path, build.problems) == ("p/setup.py", ())


@pytest.mark.parametrize(
    ("setup", "said"),
    [
        (
            "generate_parameter_module('params', 'gone.yaml')",
            "params: the parameters in gone.yaml are not among the files; they are missing",
        ),
        (
            "generate_parameter_module(name(), 'arm/p.yaml')",
            "a parameter module is computed when setup.py runs; what it names is missing here",
        ),
        (
            "generate_parameter_module()",
            "a parameter module is computed when setup.py runs; what it names is missing here",
        ),
    ],
)
def test_parameter_modules_that_are_not_known(setup: str, said: str) -> None:
    build = read(HEAD + MODULE + setup, arm__p_yaml="ns: {a: {type: int}}")
    assert (build.parameter_libraries, [p.message for p in build.problems]) == ((), [said])
