# SPDX-License-Identifier: Apache-2.0
"""The Python tools that are asked for, as installed, on a few lines: what they find, which settings hold, what runs."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import pytest
from linter_samples import MemoryStore, everything, workspace
from test_isolation import marks, trap

from haros_ci.linters import bandit, black, codespell, flake8, isort, mypy, vulture
from haros_ci.linters.linter import Linter, LintOptions, When
from haros_ci.linters.run import lint
from haros_ci.model.package import Package
from haros_ci.results.result import Run

TOOLS: tuple[Linter, ...] = (bandit, black, codespell, flake8, isort, mypy, vulture)
IDS = [tool.NAME for tool in TOOLS]
#: One defect for each of them.
SAMPLE = """import sys, os
import re as regex  # teh
def go(speed: int = 'fast'):
    os.system("ls " + sys.argv[1])
    return speed
    go()
"""
FOUND = {
    bandit: ("B605", "robot/go.py:4:5"),
    black: ("would-reformat", "robot/go.py:3"),
    codespell: ("misspelling", "robot/go.py:2:23"),
    flake8: ("F401", "robot/go.py:2:1"),
    isort: ("unsorted-imports", "robot/go.py:1"),
    mypy: ("assignment", "robot/go.py:3:21"),
    vulture: ("unused-import", "robot/go.py:2:14"),
}
PACKAGE = Package("robot", "robot", ros=2)


@pytest.fixture(autouse=True)
def _installed(request: pytest.FixtureRequest) -> None:
    asked = request.node.callspec.params.get("tool") if hasattr(request.node, "callspec") else None
    if asked is not None and asked.locate(LintOptions()) is None:
        pytest.skip(f"{asked.NAME} is not installed")


def run(
    root: Path, tool: Linter, files: dict[str, str | bytes], packages: tuple[Package, ...] = (PACKAGE,), **more: bool
) -> Run:
    options = LintOptions(enabled=frozenset({tool.NAME}), **more)  # type: ignore[arg-type]
    (only,) = lint(workspace(root, files, packages), [tool], options, MemoryStore(), everything)
    assert only.successful, only.notifications
    return only


def rules(done: Run) -> set[tuple[str, str]]:
    return {(r.rule, str(r.location)) for r in done.results}


NAMES = [
    "-rcfile.py",
    "--config=x.py",
    "two words.py",
    "100%.py",
    "::error::.py",
    "ü.py",
    "a'b.py",
    "[a]*.py",
    "a:1: b.py",
]
SOUND = '"""Go."""\n\nimport sys\n\n\ndef go(speed: int = 3) -> int:\n    """Go."""\n    return speed + len(sys.argv)\n'
DEFECTS: dict[str, str | bytes] = dict.fromkeys(("robot/go.py", *(f"robot/{name}" for name in NAMES)), SAMPLE)
CALM: dict[str, str | bytes] = {"calm/go.py": SOUND, "calm/empty.py": "", "calm/__init__.py": ""}


@pytest.mark.parametrize("tool", TOOLS, ids=IDS)
def test_it_finds_its_defect_under_any_name_and_else_stays_quiet(tmp_path: Path, tool: Linter) -> None:
    done = run(tmp_path, tool, {**DEFECTS, **CALM}, packages=(PACKAGE, Package("calm", "calm")))
    assert tool.WHEN is When.ASKED and done.tool.version[0].isdigit()
    assert FOUND[tool] in rules(done)
    assert {r.location.path for r in done.results if r.rule == FOUND[tool][0]} == set(DEFECTS)
    assert not [r for r in done.results if r.location.path in CALM]
    assert done.analysed == {*DEFECTS, *CALM}
    assert str(tmp_path) not in repr(done) and not done.notifications


UNREAD: dict[str, str | bytes] = {
    "robot/old.py": "import os\nprint 'x'\n",
    "robot/nul.py": b"x = 1\0\n",
    "robot/latin.py": b"x = '\xe9'\n",
    "robot/declared.py": b"# -*- coding: latin-1 -*-\nx = '\xe9'\n",
    "robot/unknown.py": b"# -*- coding: no-such -*-\nx = 1\n",
    "robot/deep.py": "x = " + "(" * 5000 + ")" * 5000 + "\n",
    "robot/open.py": "def f(:\n",
}


@pytest.mark.parametrize("tool", TOOLS, ids=IDS)
def test_one_file_costs_only_itself(tmp_path: Path, tool: Linter) -> None:
    files = {**UNREAD, "robot/go.py": SAMPLE, "robot/user.py": "import old, latin, open\n"}
    if tool is flake8 and sys.version_info < (3, 11):
        del files["robot/nul.py"]  # ends flake8 there; a workspace's files are known to have no such byte
    done = run(tmp_path, tool, files)
    assert FOUND[tool] in rules(done)
    if tool not in (codespell, isort, flake8):
        assert {"robot/old.py", "robot/open.py"} <= {note.path for note in done.notifications}
    if tool not in (codespell, isort):
        told = {note.path: note.message for note in done.notifications}
        assert told["robot/old.py"].endswith("it is Python 2")
        assert "robot/old.py" not in {r.location.path for r in done.results}


#: Settings that hold: the tool, the files, and whether its defect is still told of.
SETTINGS: list[tuple[Linter, dict[str, str], bool]] = [
    (bandit, {".bandit": "[bandit]\nskips = B605,B607\n"}, False),
    (bandit, {"pyproject.toml": '[tool.bandit]\nskips = ["B605"]\n'}, False),
    (bandit, {"pyproject.toml": '[tool.bandit]\nexclude_dirs = ["robot"]\n'}, False),
    (bandit, {"../.bandit": "[bandit]\nskips = B605\n"}, True),
    (bandit, {".bandit": "[bandit]\ntargets = /\nrecursive = true\nbaseline = /x\noutput = stolen\n"}, True),
    (black, {"pyproject.toml": '[tool.black]\nexclude = "robot"\n'}, False),
    (black, {"pyproject.toml": '[tool.black]\nextend-exclude = "go"\nexclude = "x"\n'}, False),
    (black, {"robot/pyproject.toml": "[tool.black]\nline-length = 99\nworkers = 9\nrequired-version = '1'\n"}, True),
    (isort, {"pyproject.toml": "[tool.isort\n"}, True),
    (codespell, {".codespellrc": "[codespell]\nignore-words-list = teh\n"}, False),
    (codespell, {"setup.cfg": "[codespell]\nskip = ./robot\n"}, False),
    (codespell, {"pyproject.toml": '[tool.codespell]\nskip = "*.cpp,go.py"\n'}, False),
    (codespell, {".codespellrc": "[codespell]\nignore-words = words\n", "words": "teh\n"}, False),
    (codespell, {"pyproject.toml": '[tool.codespell]\nignore-words = "words"\n', "words": "teh\n"}, False),
    (codespell, {".codespellrc": "[codespell]\nignore-words = ../words\n", "../words": "teh\n"}, True),
    (codespell, {".codespellrc": "[codespell]\nwrite-changes =\ninteractive = 3\nsummary =\ncount =\n"}, True),
    (flake8, {".flake8": "[flake8]\nignore =\n    F401\n"}, False),
    (flake8, {"setup.cfg": "[flake8]\nper-file-ignores = robot/*.py:F401\n"}, False),
    (flake8, {"tox.ini": "[flake8]\nexclude = robot\n"}, False),
    (flake8, {"robot/setup.cfg": "[flake8]\nper-file-ignores = other/*.py:F401\n"}, True),
    (
        flake8,
        {"setup.cfg": "[flake8]\nformat = pylint\noutput-file = out\nrequire-plugins = x\njobs = 99\ncount = 1\n"},
        True,
    ),
    (isort, {".isort.cfg": "[settings]\nskip = robot\n"}, False),
    (isort, {"setup.cfg": "[isort]\nskip_glob = robot/*\n"}, False),
    (isort, {"pyproject.toml": '[tool.isort]\nprofile = "black"\nvirtual_env = "."\nformatter = "evil"\n'}, True),
    (mypy, {"mypy.ini": "[mypy]\ndisable_error_code = assignment\n"}, False),
    (mypy, {"setup.cfg": "[mypy]\n[mypy-go]\nignore_errors = True\n"}, False),
    (
        mypy,
        {"pyproject.toml": '[tool.mypy]\n[[tool.mypy.overrides]]\nmodule = ["x", "go"]\nignore_errors = true\n'},
        False,
    ),
    (
        mypy,
        {"mypy.ini": "[mypy]\npython_executable = /evil\ncustom_typeshed_dir = .\npretty = True\njunit_xml = x\n"},
        True,
    ),
    (mypy, {"mypy.ini": "[mypy]\n[mypy-go]\n[mypy-go]\nignore_errors = True\n[mypy\n"}, True),
    (vulture, {"pyproject.toml": '[tool.vulture]\nignore_names = ["regex"]\n'}, False),
    (vulture, {"pyproject.toml": "[tool.vulture]\nmin_confidence = 100\n"}, False),
    (vulture, {"pyproject.toml": '[tool.vulture]\nexclude = ["go.py"]\n'}, False),
    (
        vulture,
        {"pyproject.toml": '[tool.vulture]\npaths = ["/"]\nmake_whitelist = true\nverbose = true\nnew = 1\n'},
        True,
    ),
]


@pytest.mark.parametrize(("tool", "settings", "told"), SETTINGS)
def test_settings_of_the_workspace(tmp_path: Path, tool: Linter, settings: dict[str, str], told: bool) -> None:
    root = tmp_path / "root"
    done = run(root, tool, {"robot/go.py": SAMPLE, **settings})
    assert (FOUND[tool] in rules(done)) == told
    assert (root / "robot/go.py").read_text() == SAMPLE
    assert not [path for name in ("out", "stolen", "x") for path in root.rglob(name)]


def hostile(root: Path) -> dict[str, str | bytes]:
    """A workspace in which every name that a tool may import, and every setting that runs code, leaves a mark."""
    names = "json re ast tokenize sitecustomize usercustomize mypy flake8 bandit black isort vulture codespell_lib evil".split()
    files = {f"{where}{name}.py": trap(root, name) for name in names for where in ("", "robot/")}
    files |= {
        f"{name}/__init__.py": trap(root, name) for name in ("yaml", "stevedore", "pycodestyle", "pyflakes", "click")
    }
    settings = {
        ".flake8": "[flake8]\nenable-extensions = X\nrequire-plugins = evil\n[flake8:local-plugins]\nextension =\n"
        "    X = evil:Plugin\nreport =\n    default = evil:Plugin\npaths = .\n",
        "mypy.ini": "[mypy]\nplugins = evil, ./evil.py\nmypy_path = .\n",
        ".bandit": "[bandit]\nconfigfile = evil.yaml\nprofile = evil\n",
        "evil.yaml": "!!python/object/apply:os.system ['touch marks']\n",
        ".isort.cfg": "[settings]\nformatter = evil\nsort_order = evil\nvirtual_env = .\nskip_gitignore = true\n",
        "pyproject.toml": '[tool.black]\npython-cell-magics = ["x"]\ncode = "x"\n[tool.vulture]\npaths = ["."]\n',
    }
    return {**files, **settings, "robot/go.py": SAMPLE}


@pytest.mark.parametrize("tool", TOOLS, ids=IDS)
def test_nothing_of_the_workspace_runs(tmp_path: Path, tool: Linter) -> None:
    done = run(tmp_path, tool, hostile(tmp_path))
    assert marks(tmp_path) == "" and not (tmp_path / "marks").exists()
    assert FOUND[tool] in rules(done)


@pytest.mark.parametrize("tool", [flake8, mypy], ids=["flake8", "mypy"])
def test_the_trap_works_where_settings_are_trusted(tmp_path: Path, tool: Linter) -> None:
    plugin = (
        trap(tmp_path, "evil") + "class Plugin:\n    def __init__(self, tree): pass\n    def run(self): return []\n"
    )
    plugin += "def plugin(version):\n    from mypy.plugin import Plugin as P\n    return P\n"
    settings = {
        ".flake8": "[flake8:local-plugins]\nextension =\n    X = evil:Plugin\npaths = .\n",
        "mypy.ini": "[mypy]\nplugins = evil.py\n",
    }
    files: dict[str, str | bytes] = {**settings, "evil.py": plugin, "robot/go.py": SAMPLE}
    done = run(tmp_path, tool, files, trust_config=True)
    assert "evil" in marks(tmp_path) and FOUND[tool] in rules(done)


def test_vulture_knows_what_ros_calls(tmp_path: Path) -> None:
    code = """def main(args=None): pass
def generate_launch_description(): pass
class Arm:
    def on_configure(self, state): pass
    def scan_callback(self, message): pass
def entry(): pass
def left_over(): pass
class TestArm:
    def test_it(self): pass
"""
    files: dict[str, str | bytes] = {
        "pyproject.toml": "[tool.vulture]\nmin_confidence = 60\n",
        "robot/robot/arm.py": code,
        "robot/robot/user.py": "from robot.arm import Arm\nprint(Arm)\n",
        "robot/setup.py": "setup(entry_points={'console_scripts': ['go = robot.arm:entry']})\n",
        "other/arm.py": "left_over = 1\nprint(left_over)\n",
    }
    if vulture.locate(LintOptions()) is None:
        pytest.skip("vulture is not installed")
    done = run(tmp_path, vulture, files, packages=(PACKAGE, Package("other", "other")))
    assert {r.message for r in done.results if r.rule != "unused-variable"} == {"unused function 'left_over'"}


MYPY_LAYOUTS: list[tuple[dict[str, str], set[tuple[str, str]]]] = [
    (  # a directory without __init__.py is no module, so that ROS's launch is unknown rather than wrong
        {"robot/launch/a.py": "from launch import LaunchDescription\nx: int = ''\n"},
        {("import-not-found", "robot/launch/a.py:1:1"), ("assignment", "robot/launch/a.py:2:10")},
    ),
    (  # modules of one name
        {f"robot/{d}/go.py": "x: int = ''\n" for d in ("launch", "scripts", "test")},
        {("assignment", f"robot/{d}/go.py:1:10") for d in ("launch", "scripts", "test")},
    ),
    (  # types across the package
        {
            "robot/robot/__init__.py": "",
            "robot/robot/a.py": "def f() -> str: return ''\n",
            "robot/s/b.py": "from robot.a import f\nx: int = f()\n",
        },
        {("assignment", "robot/s/b.py:2:10")},
    ),
    (  # another package may well have the same names
        {"robot/setup.py": "x: int = ''\n", "setup.py": "x: int = 1\n", "other/setup.py": "x: int = ''\n"},
        {("assignment", "robot/setup.py:1:10"), ("assignment", "other/setup.py:1:10")},
    ),
    (  # nor are equal files with different imports the same
        {
            "other/go.py": "import part\nx: int = part.x\n",
            "other/part.py": "x = 1\n",
            "robot/go.py": "import part\nx: int = part.x\n",
            "robot/part.py": "x = ''\n",
        },
        {("assignment", "robot/go.py:2:10")},
    ),
    (
        {"other/go.py": "x: int = ''\n", "robot/go.py": "x: int = ''\n"},
        {("assignment", "robot/go.py:1:10"), ("assignment", "other/go.py:1:10")},
    ),
    (  # names that mypy refuses
        {
            "robot/my-dir/__init__.py": "",
            "robot/my-dir/a.py": "x: int = ''\n",
            "robot/s/types.py": "",
            "robot/s/c.py": "",
            "robot/b.py": "x: int = ''\n",
        },
        {("assignment", "robot/b.py:1:10")},
    ),
    (  # an import of what cannot be read
        {
            "robot/a.py": "import b\nimport c\nx: int = ''\n",
            "robot/b.py": "print 'x'\n",
            "robot/c.py": "def f(x):\n  # type: (int -> str\n  pass\n",
        },
        {("assignment", "robot/a.py:3:10")},
    ),
]


def test_mypy_on_packages_as_ros_has_them(tmp_path: Path) -> None:
    """Each layout in a directory of its own: mypy reads the types of the standard library once."""
    if mypy.locate(LintOptions()) is None:
        pytest.skip("mypy is not installed")
    files: dict[str, str | bytes] = {}
    packages: list[Package] = []
    expected: dict[int, set[tuple[str, str]]] = {}
    for number, (layout, said) in enumerate(MYPY_LAYOUTS):
        files |= {f"l{number}/{path}": text for path, text in layout.items()}
        packages += [Package(f"{name}_{number}", f"l{number}/{name}", ros=2) for name in ("robot", "other")]
        expected[number] = {(rule, f"l{number}/{place}") for rule, place in said}
    found = {row for row in rules(run(tmp_path, mypy, files, packages=tuple(packages))) if row[0] != "syntax"}
    assert {n: {row for row in found if row[1].startswith(f"l{n}/")} for n in expected} == expected


def test_a_package_s_file_is_checked_anew_when_another_changes(tmp_path: Path) -> None:
    if mypy.locate(LintOptions()) is None:
        pytest.skip("mypy is not installed")
    store, options = MemoryStore(), LintOptions(enabled=frozenset({"mypy"}))
    told = []
    for result in ("''", "1"):
        kind = "str" if result == "''" else "int"
        files = {"robot/a.py": f"def f() -> {kind}: return {result}\n", "robot/b.py": "import a\nx: int = a.f()\n"}
        (done,) = lint(workspace(tmp_path, files, [PACKAGE]), [mypy], options, store, everything)
        told.append([r.location.path for r in done.results])
    assert told == [["robot/b.py"], []]


def test_the_trap_works_where_flake8_is_started_plainly(tmp_path: Path) -> None:
    workspace(tmp_path, {name: text for name, text in hostile(tmp_path).items() if name != "pyproject.toml"})
    command = [sys.executable, "-m", "flake8", "robot/go.py"]
    subprocess.run(command, cwd=tmp_path, capture_output=True, check=False, timeout=60, env={"HOME": str(tmp_path)})
    assert marks(tmp_path) != ""
