# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import pytest
from in_memory import MANIFEST, workspace_of

from haros_ci.workspace.setup_py import Setup, read_setup
from haros_ci.workspace.tree import PathTree

FILES = ("arm/talker.py", "arm/__init__.py", "src/core/node.py", "launch/b.launch.py", "launch/a.launch.py", "bin/tool")


def read(text: str, root: str = "pkgs/arm/") -> Setup:
    files = {f"{root}package.xml": MANIFEST.format("arm"), f"{root}setup.py": text}
    files |= {f"{root}{path}": "#!/usr/bin/env python3\n" for path in FILES}
    workspace = workspace_of(files)
    setup = read_setup(PathTree(workspace), workspace.packages[0])
    if not text.startswith("#bad"):
        assert setup.problems == ()
    return setup


@pytest.mark.parametrize(
    ("text", "roots"),
    [
        ("setup(name='arm', packages=['arm'])", [("", "pkgs/arm")]),
        ("setup(package_dir={'': 'src'})", [("", "pkgs/arm/src")]),
        ("setup(package_dir={'core': 'src/core', 'x': 'y'})", [("core", "pkgs/arm/src/core"), ("x", "pkgs/arm/y")]),
        (
            "d = generate_distutils_setup(packages=['core'], package_dir={'': 'src'})\nsetup(**d)",
            [("", "pkgs/arm/src")],
        ),
        ("d = dict(package_dir={'': 'src'})\nsetup(**d)", [("", "pkgs/arm/src")]),
        ("d = {'package_dir': {'': 'src'}}\nsetup(**d)", [("", "pkgs/arm/src")]),
        ("d = generate_distutils_setup()\nd['package_dir'] = {'': 'src'}\nsetup(**d)", [("", "pkgs/arm/src")]),
        ("setup(**generate_distutils_setup(package_dir={'': 'src'}))", [("", "pkgs/arm/src")]),
        ("setup(name='a', **generate_distutils_setup(**dict(package_dir={'': 'src'})))", [("", "pkgs/arm/src")]),
        ("setup(**{'package_dir': {'': 'src'}})", [("", "pkgs/arm/src")]),
        ("setup(**dict(generate_distutils_setup(package_dir={'': 'src'}), name='a'))", [("", "pkgs/arm/src")]),
        ("setup(**{**generate_distutils_setup(package_dir={'': 'src'})})", [("", "pkgs/arm/src")]),
        (
            "from catkin_pkg.python_setup import generate_distutils_setup as g\nd = g(package_dir={'': 'src'})\n",
            [("", "pkgs/arm/src")],
        ),
        ("import setuptools as s\ns.setup(package_dir={'': 'src'})", [("", "pkgs/arm/src")]),
        ("d = dict()\nd.update(package_dir={'': 'src'})\nsetup(**d)", [("", "pkgs/arm/src")]),
        ("try:\n  setup(package_dir={'': 'src'})\nexcept E:\n  pass", [("", "pkgs/arm/src")]),
        ("setup(**" + "dict(**" * 60 + "dict(package_dir={'': 'src'})" + ")" * 61, [("", "pkgs/arm")]),
        ("setup(**other(package_dir={'': 'src'}))", [("", "pkgs/arm")]),
        ("update(package_dir={'': 'src'})", [("", "pkgs/arm")]),
        ("S = 'src'\nif __name__ == '__main__':\n  setuptools.setup(package_dir={'': S})", [("", "pkgs/arm/src")]),
        ("def main():\n  setup(package_dir={'': 'src'})\nmain()", [("", "pkgs/arm/src")]),
        ("setup(package_dir={'': '../../..'})", [("", "pkgs/arm")]),
        ("print 'python 2'\nsetup(package_dir={'': 'src'})", [("", "pkgs/arm/src")]),
        ("x = 1", [("", "pkgs/arm")]),
    ],
)
def test_roots(text: str, roots: list[tuple[str, str]]) -> None:
    assert list(read(text).roots) == roots


@pytest.mark.parametrize(
    ("text", "rows"),
    [
        ("setup(scripts=['bin/tool'])", [("bin/tool", "program", "bin", "tool")]),
        ("from glob import glob\nsetup(scripts=glob('bin/*'))", [("bin/tool", "program", "bin", "tool")]),
        (
            "import os, glob\nname = 'arm'\nsetup(data_files=[(os.path.join('share', name), ['package.xml']),\n"
            " ('share/' + name + '/launch', glob.glob('launch/*.launch.py')), ('lib/' + name, ['bin/tool'])])",
            [
                ("package.xml", "file", "share/arm", "package.xml"),
                ("launch/a.launch.py", "file", "share/arm/launch", "a.launch.py"),
                ("launch/b.launch.py", "file", "share/arm/launch", "b.launch.py"),
                ("bin/tool", "program", "lib/arm", "tool"),
            ],
        ),
        (
            "from glob import glob\nsetup(data_files=[('share/arm', ['a'] + glob(os.path.join('launch', '*a.*')))])",
            [("a", "file", "share/arm", "a"), ("launch/a.launch.py", "file", "share/arm", "a.launch.py")],
        ),
        ("setup(scripts=['../../../etc/passwd', '/etc/passwd'])", []),
        ("setup(scripts=[], data_files=[])", []),
        ("run(scripts=['bin/tool'])", []),
    ],
)
def test_installed(text: str, rows: list[tuple[str, str, str, str]]) -> None:
    found = read(text).installed
    assert [(i.path.removeprefix("pkgs/arm/"), i.kind, i.destination, i.name) for i in found] == rows


GROWN = """
from glob import glob
import os
files = []
files.append(("share/arm", glob("launch/*.launch.py", recursive=True)))
def more(directory, files):
    for path, _, names in os.walk(directory):
        for name in names:
            files.append(("share/arm/" + path, [os.path.join(path, name)]))
    return files
{}
setup(data_files=files)
"""


@pytest.mark.parametrize(
    ("line", "paths"),
    [
        ("files = more('bin/', files)", ["launch/a.launch.py", "launch/b.launch.py"]),
        ("files = more('bin/', files)\nfiles = more('src/', files)", ["launch/a.launch.py", "launch/b.launch.py"]),
        ("files = more('bin/', files)\nfiles.append(('x', ['bin/tool']))", ["launch/a.launch.py", "launch/b.launch.py", "bin/tool"]),
        ("files = more('bin/', [])", []),
        ("files = [('x', ['bin/tool'])]", ["bin/tool"]),
        ("files = other", []),
    ],
)  # fmt: skip
def test_a_list_that_a_function_adds_to_keeps_what_it_has(line: str, paths: list[str]) -> None:
    found = read("#bad" + GROWN.format(line))
    assert [one.path.removeprefix("pkgs/arm/") for one in found.installed] == paths
    assert any(problem.message.startswith("data_files is computed") for problem in found.problems)


@pytest.mark.parametrize(
    ("text", "rows"),
    [
        (
            "setup(entry_points={'console_scripts': ['talker = arm.talker:main',\n 'node=core.node:Node.main', "
            "'x = gone:f']},\n package_dir={'core': 'src/core', '': '.'})",
            [
                ("talker", "arm.talker", "main", "pkgs/arm/arm/talker.py", 1),
                ("node", "core.node", "Node.main", "pkgs/arm/src/core/node.py", 2),
                ("x", "gone", "f", "", 2),
            ],
        ),
        (
            "setup(entry_points='''\n[console_scripts]\na = arm:main\n[other]\nb = arm:x\n''')",
            [("a", "arm", "main", "pkgs/arm/arm/__init__.py", 1)],
        ),
        ("setup(entry_points={'launch_frontend': ['a = b:c']})", []),
        ("setup(entry_points={'console_scripts': ['nonsense', 'a = b']})", []),
    ],
)
def test_entry_points(text: str, rows: list[tuple[str, str, str, str, int]]) -> None:
    found = read(text).entry_points
    assert [(e.name, e.module, e.function, e.path, e.location.line) for e in found] == rows


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("setup(scripts=find())", "scripts is computed when setup.py runs; what it names is missing here"),
        ("setup(package_dir=find())", "package_dir is computed when setup.py runs; what it names is missing here"),
        ("setup(entry_points=find())", "entry_points is computed when setup.py runs; what it names is missing here"),
        (
            "setup(data_files=[(find(), [])])",
            "a destination in data_files is computed when setup.py runs; what it names is missing here",
        ),
        ("setup(", "not Python that can be read (line 2: '(' was never closed); what it installs is missing"),
    ],
)
def test_problems(text: str, message: str) -> None:
    assert [problem.message for problem in read(f"#bad\n{text}").problems] == [message]


@pytest.mark.parametrize(
    ("text", "names", "is_whole"),
    [
        ("setup(packages=['a', 'a.b'])", ["a", "a.b"], True),
        ("setup(packages=('a',))", ["a"], True),
        ("n = 'a'\nsetup(packages=[n, n + '.b', f'{n}.c'])", ["a", "a.b", "a.c"], True),
        ("setup(**dict(packages=['a']))", ["a"], True),
        ("setup(packages=[])", [], True),
        ("p = ['a']\np += more()\nsetup(packages=p)", ["a"], False),
        ("setup(packages=['a'] + ['b'])", ["a", "b"], False),
        ("setup(packages=['a', 1])", ["a"], False),
        ("setup(packages=['a', *more()])", [], False),
        ("setup(packages=find_packages())", [], False),
        ("setup(packages=['a'] + find_packages())", [], False),
        ("setup()", [], False),
    ],
)
def test_packages(text: str, names: list[str], is_whole: bool) -> None:
    found = read(text)
    assert [name for name, _ in found.packages] == names
    assert found.are_packages_all == is_whole


def test_at_the_root() -> None:
    setup = read("setup(package_dir={'': 'src'}, scripts=['bin/tool'])", "")
    assert setup.roots == (("", "src"),)
    assert [thing.path for thing in setup.installed] == ["bin/tool"]


@pytest.mark.parametrize(
    "text",
    [
        "y = 'a'\n" + "y = y + y\n" * 60 + "setup(name=y)",
        "y = 'a'\n" + "y = os.path.join(y, y)\n" * 60 + "setup(name=y)",
        "y = ['a']\n" + "y = y + y\n" * 60 + "setup(packages=y, scripts=y)",
    ],
)
def test_texts_that_double_are_not_made(text: str) -> None:
    found = read(f"#bad\nimport os\n{text}")
    assert found.distribution is None and len(found.packages) < 10_000 and len(found.installed) < 10_000


@pytest.mark.parametrize("text", ["setup(scripts=" + "[" * 150 + "]" * 150 + ")", "setup(" + "a." * 5000 + "b)", "x\0"])
def test_deep_input_ends(text: str) -> None:
    read(f"#bad\n{text}")


@pytest.mark.parametrize(
    ("text", "name"),
    [
        ('setup(name="arm-tools")', "arm-tools"),
        ('package_name = "arm"\nsetup(name=package_name, version="1")', "arm"),
        ('package_name = "arm"\nsetup(name=package_name + "_tools")', "arm_tools"),
        ("setup(name=read())", None),
        ("setup(**generate_distutils_setup(packages=[]))", None),
        ('print(name="arm")', None),
    ],
)
def test_the_name_of_what_is_installed(text: str, name: str | None) -> None:
    found = read(text).distribution
    assert (found.name if found is not None else None) == name
    assert found is None or found.location.path == "pkgs/arm/setup.py"
