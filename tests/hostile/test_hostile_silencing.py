# SPDX-License-Identifier: Apache-2.0
"""A change that brings, alters or removes settings of linters silences nothing, and a note says what it tries to switch off."""

from __future__ import annotations

import shutil
import sys
from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path

import pytest
from hostile_kit import Outcome, Trap, assert_harmless

from haros_ci.linters import silencing

TOOLS = (
    *("cppcheck", "cpplint", "pylint", "lizard", "radon", "ruff", "clang-tidy", "catkin_lint", "bandit", "black"),
    *("clang-format", "cmake-lint", "cmakelint", "codespell", "flake8", "hadolint", "isort", "mypy", "shellcheck"),
    *("vulture", "yamllint"),
)


@dataclass(frozen=True)
class Silencer:
    """A finding of *tool* in *text* at *path*, the settings that silence it, and what the note says that they turn off.

    *base* are settings that lie there before.
    """

    tool: str
    rule: str
    path: str
    text: str
    settings: Mapping[str, str | None]
    says: str
    base: Mapping[str, str] = field(default_factory=dict)
    name: str = ""


UNUSED = '"""A module."""\nimport os\n'
SH = "#!/bin/bash\necho $1\n"
STYLE = {".clang-format": "BasedOnStyle: LLVM\n"}
YAML = "a:   1\n"
SILENCERS = [
    Silencer("bandit", "B602", "a.py", "import subprocess\n\nsubprocess.Popen('x' + input(), shell=True)\n",
             {".bandit": "[bandit]\nskips: B602\n"}, "bandit:B602"),
    Silencer("black", "would-reformat", "a.py", "x = [ 1 ]\n", {"pyproject.toml": "[tool.black]\nexclude = 'a.py'\n"},
             "black as `exclude` says: a.py"),
    Silencer("clang-format", "formatting", "a.cpp", "int  x ;\n", {".clang-format": "DisableFormat: true\n"},
             "clang-format as `DisableFormat` says: true", STYLE),
    Silencer("clang-format", "formatting", "a.cpp", "int  x ;\n", {".clang-format": None}, "clang-format:*", STYLE, "removed"),
    Silencer("clang-format", "formatting", "a.cpp", "int  x ;\n", {".clang-format-ignore": "*.cpp\n"},
             "clang-format as `a line` says: *.cpp", STYLE, "ignored"),
    Silencer("cmake-lint", "C0301", "x.cmake", f"set(x {'a' * 90})\n",
             {".cmake-format.yaml": "lint:\n  disabled_codes: [C0301]\n"}, "cmake-lint:C0301"),
    Silencer("cmakelint", "whitespace/tabs", "x.cmake", "\tset(x 1)\n", {".cmakelintrc": "filter=-whitespace/tabs\n"},
             "cmakelint:whitespace/tabs"),
    Silencer("codespell", "misspelling", "a.py", "# teh\n", {".codespellrc": "[codespell]\nignore-words-list = teh\n"},
             "codespell as `ignore-words-list` says: teh"),
    Silencer("codespell", "misspelling", "a.py", "# teh\n", {"words.txt": "teh\n"}, "codespell as `ignore-words` says: teh",
             {".codespellrc": "[codespell]\nignore-words = words.txt\n", "words.txt": "x\n"}, "named"),
    Silencer("cpplint", "whitespace/tab", "a.cpp", "// Copyright x\n\tint x;\n", {"CPPLINT.cfg": "filter=-whitespace/tab\n"},
             "cpplint:whitespace/tab"),
    Silencer("cpplint", "whitespace/tab", "a.cpp", "// Copyright x\n\tint x;\n", {"CPPLINT.cfg": "exclude_files=a.*\n"},
             "cpplint as `exclude_files` says: a.*", {"CPPLINT.cfg": "linelength=90\n"}, "excluded"),
    Silencer("flake8", "F401", "a.py", UNUSED, {".flake8": "[flake8]\nextend-ignore = F401\n"}, "flake8:F401"),
    Silencer("flake8", "F401", "a.py", UNUSED, {"setup.cfg": "[flake8]\nper-file-ignores = a.py:F401\n"},
             "flake8 as `per-file-ignores` says: a.py:F401", {"setup.cfg": "[flake8]\nmax-line-length = 90\n"}, "one file"),
    Silencer("hadolint", "DL3006", "Dockerfile", "FROM debian\n", {".hadolint.yaml": "ignored: [DL3006]\n"},
             "hadolint:DL3006"),
    Silencer("isort", "unsorted-imports", "a.py", "import sys\nimport os\n", {".isort.cfg": "[settings]\nskip = a.py\n"},
             "isort as `skip` says: a.py"),
    Silencer("mypy", "assignment", "a.py", "x: int = ''\n", {"mypy.ini": "[mypy]\ndisable_error_code = assignment\n"},
             "mypy:assignment"),
    Silencer("mypy", "assignment", "a.py", "x: int = ''\n", {"mypy.ini": "[mypy]\n[mypy-a]\nignore_errors = True\n"},
             "mypy as `[a] ignore-errors` says: true", {"mypy.ini": "[mypy]\n"}, "one module"),
    Silencer("pylint", "unused-import", "a.py", UNUSED, {"pylintrc": "[MAIN]\ndisable=unused-import\n"},
             "pylint:unused-import"),
    Silencer("pylint", "unused-import", "p/a.py", UNUSED, {"p/pyproject.toml": "[tool.pylint.main]\nignore = ['a.py']\n"},
             "pylint as `ignore` says: a.py", {"pylintrc": "[MAIN]\nmax-args=9\n"}, "nearer"),
    Silencer("ruff", "F401", "a.py", UNUSED, {"ruff.toml": "[lint]\nignore = ['F401']\n"}, "ruff:F401"),
    Silencer("ruff", "F401", "a.py", UNUSED, {"shared.toml": "lint.per-file-ignores = {'a.py' = ['F401']}\n"},
             "ruff as `per-file-ignores` says: a.py: F401",
             {"ruff.toml": "extend = 'shared.toml'\n", "shared.toml": "lint.select = ['F']\n"}, "extended"),
    Silencer("shellcheck", "SC2086", "x.sh", SH, {".shellcheckrc": "disable=SC2086\n"}, "shellcheck:SC2086"),
    Silencer("vulture", "unused-import", "a.py", UNUSED, {"pyproject.toml": "[tool.vulture]\nignore_names = ['os']\n"},
             "vulture as `ignore-names` says: os"),
    Silencer("yamllint", "colons", "a.yaml", YAML, {".yamllint": "extends: default\nrules: {colons: disable}\n"},
             "yamllint:colons"),
    Silencer("yamllint", "colons", "a.yaml", YAML, {"ci/y.yaml": "rules: {colons: disable}\n"}, "yamllint:colons",
             {".yamllint": "extends: ci/y.yaml\n", "ci/y.yaml": "extends: default\n"}, "extended"),
]  # fmt: skip


def run(trap: Trap, tool: str, *arguments: str) -> Outcome:
    outcome = trap.run(f"--select={tool}", *arguments)
    assert_harmless(trap, outcome)
    return outcome


def found(outcome: Outcome, silencer: Silencer) -> bool:
    return any(
        (r["tool"], r["rule"], r["path"]) == (silencer.tool, silencer.rule, silencer.path)
        for r in outcome.report["results"]
    )


def plant(trap: Trap, files: Mapping[str, str | None]) -> None:
    for name, text in files.items():
        if text is None:
            (trap.root / name).unlink()
        else:
            trap.write(name, text)


def needs(tool: str) -> None:
    program = Path(sys.executable).with_name(tool)
    if tool in ("clang-format", "hadolint", "ruff", "shellcheck") and not (program.exists() or shutil.which(tool)):
        pytest.skip(f"{tool} is not installed")


@pytest.mark.parametrize("silencer", SILENCERS, ids=lambda s: f"{s.tool}-{s.name}" if s.name else s.tool)
def test_settings_silence_nothing(silencer: Silencer, trap: Trap) -> None:
    """With a base the finding is told and the note names what is turned off; without one, the same settings do silence it."""
    needs(silencer.tool)
    off = ", ".join(f"{tool}: {'true' if tool == silencer.tool else 'false'}" for tool in TOOLS)
    trap.write("haros.yaml", f"linters: {{{off}}}\n")
    plant(trap, silencer.base)
    trap.commit()
    trap.git("checkout", "-q", "-b", "head")
    trap.write(silencer.path, silencer.text)
    plant(trap, silencer.settings)
    trap.commit()
    outcome = run(trap, silencer.tool, "--baseline-rev=main")
    assert found(outcome, silencer), outcome.notes()
    assert {r["state"] for r in outcome.report["results"] if r["path"] == silencer.path} == {"new"}
    (changed,) = silencer.settings
    (note,) = [message for path, message in outcome.notes() if path == changed]
    assert silencer.says in note.partition("turns off: ")[2], note
    how = "is removed here" if silencer.settings[changed] is None else (
        "differs from" if changed in silencer.base else "is not in the base revision"
    )  # fmt: skip
    assert note.startswith(f"{changed} {how}")
    alone = run(trap, silencer.tool)
    assert not found(alone, silencer), "the settings are no silencer"


def test_every_row_of_the_table_is_tried() -> None:
    assert {silencer.tool for silencer in SILENCERS} == {row.tool for row in silencing.SETTINGS}


def test_clang_tidy_has_no_settings_of_the_workspace(trap: Trap) -> None:
    """Row clang-tidy: its checks are ours, whatever a .clang-tidy says."""
    if not shutil.which("clang-tidy"):
        pytest.skip("clang-tidy is not installed")
    trap.write(".clang-tidy", "Checks: '-*'\n")
    trap.write("a.cpp", "int f() { int x; return x; }\n")
    database = f'[{{"directory": "{trap.root}", "file": "a.cpp", "arguments": ["c++", "-c", "a.cpp"]}}]'
    trap.write("build/compile_commands.json", database)
    off = ", ".join(f"{tool}: false" for tool in TOOLS if tool != "clang-tidy")
    trap.write("haros.yaml", f"linters: {{{off}}}\n")
    outcome = run(trap, "clang-tidy")
    assert {r["path"] for r in outcome.report["results"] if r["tool"] == "clang-tidy"} == {"a.cpp"}


def test_a_tracked_file_is_analysed_whatever_gitignore_says(trap: Trap) -> None:
    trap.use_cheap_control()
    trap.commit()
    trap.git("checkout", "-q", "-b", "head")
    trap.write("a.cpp", "int g(int x) { int *unset = 0; return *unset + x; }\n")
    trap.git("add", "a.cpp")
    trap.write(".gitignore", "*.cpp\n")
    trap.write(".gitattributes", "*.cpp linguist-generated export-ignore -diff\n")
    trap.write(".editorconfig", "[*]\nexclude = true\n")
    trap.commit()
    outcome = trap.run("--baseline-rev=main")
    assert_harmless(trap, outcome)
    assert ("a.cpp", 1, "nullPointer") in outcome.findings()


MANIFEST = """<package format="3">
  <name>p</name><version>0.1.0</version><description>d</description>
  <maintainer email="a@example.org">m</maintainer><license>MIT</license>
  <buildtool_depend>ament_cmake</buildtool_depend>
  <export><build_type>ament_cmake</build_type></export>
</package>
"""


@pytest.mark.parametrize("is_of_base", [True, False])
def test_gitignore_of_the_change_lowers_no_finding(is_of_base: bool, trap: Trap) -> None:
    """A launch file that git ignores is made elsewhere, so its absence is a note; only the base revision can say so."""
    trap.use_cheap_control()
    trap.write("p/package.xml", MANIFEST)
    trap.write(
        "p/CMakeLists.txt", "project(p)\nfind_package(ament_cmake)\ninstall(DIRECTORY launch DESTINATION share/p)\n"
    )
    trap.write("p/launch/a.launch.xml", "<launch/>\n")
    trap.write(".gitignore", "made.launch.xml\n" if is_of_base else "other\n")
    trap.commit()
    trap.git("checkout", "-q", "-b", "head")
    trap.write(
        "p/launch/a.launch.xml", '<launch>\n  <include file="$(find-pkg-share p)/launch/made.launch.xml"/>\n</launch>\n'
    )
    trap.write(".gitignore", "made.launch.xml\n")
    trap.commit()
    outcome = trap.run("--baseline-rev=main")
    assert_harmless(trap, outcome)
    levels = {r["level"] for r in outcome.report["results"] if r["rule"] == "missing-launch-file"}
    assert ("error" in levels) is not is_of_base  # notes are not shown by default


def test_without_the_base_revision_no_settings_count(trap: Trap) -> None:
    trap.write("pylintrc", "[MAIN]\ndisable=all\n")
    trap.commit()
    outcome = trap.run("--baseline-rev=nowhere", "--no-require-baseline")
    assert_harmless(trap, outcome)
    assert ("control.py", 6, "undefined-variable") in outcome.findings()
    assert outcome.says("Settings files of linters do not count in this run")


def test_settings_that_are_the_same_are_not_told(trap: Trap) -> None:
    """Nor are changes of other parts of the same files."""
    toml = "[project]\nversion = '1'\n[tool.pylint.main]\nmax-args = 9\n"
    trap.write("pyproject.toml", toml)
    trap.write("setup.cfg", "[metadata]\nversion = 1\n[flake8]\nignore = E1\n")
    trap.write("words.txt", "teh\n")
    trap.commit()
    trap.git("checkout", "-q", "-b", "head")
    trap.write("pyproject.toml", toml.replace("'1'", "'2'") + "[tool.other]\nignore = ['F401']\n")
    trap.write("setup.cfg", "[metadata]\nversion = 2\n[flake8]\nignore = E1\n")
    trap.write("words.txt", "other\n")
    trap.write("tox.ini", "[tox]\n")
    trap.commit()
    outcome = trap.run("--baseline-rev=main")
    assert_harmless(trap, outcome)
    assert outcome.notes() == [] and outcome.code == 0


def test_many_settings_files_are_counted(trap: Trap) -> None:
    trap.commit()
    trap.git("checkout", "-q", "-b", "head")
    for number in range(25):
        trap.write(f"d{number:02}/x.py", "")
        trap.write(f"d{number:02}/pylintrc", "[MAIN]\ndisable=" + ",".join(f"rule-{n:02}" for n in range(30)) + "\n")
    trap.write("d00/pylintrc", "[MAIN]\ndisable=\x1b[31m::error::" + "x" * 500 + "\n")
    trap.commit()
    outcome = trap.run("--baseline-rev=main")
    assert_harmless(trap, outcome)
    told = [(path, message) for path, message in outcome.notes() if "base revision" in message]
    assert {path for path, _ in told} == {None, *(f"d{number:02}/pylintrc" for number in range(20))}
    notes = dict(told)
    assert notes[None].startswith("5 more settings files of linters differ")
    assert (notes["d01/pylintrc"] or "").endswith("pylint:rule-19 and 10 more.")
    assert all(len(message) < 2_000 for _, message in told)


def test_settings_that_cannot_be_read_are_named(trap: Trap) -> None:
    trap.write("ruff.toml", "lint.select = ['F']\n")
    trap.commit()
    trap.git("checkout", "-q", "-b", "head")
    trap.write("ruff.toml", "lint.select = [\n")
    trap.write(".yamllint", "a: [\n")
    trap.commit()
    outcome = trap.run("--baseline-rev=main")
    assert_harmless(trap, outcome)
    notes = dict(outcome.notes())
    assert "cannot be read, so the rules that they turn off are unknown" in notes["ruff.toml"]
    assert "cannot be read, so the rules that they turn off are unknown" in notes[".yamllint"]


DATABASE = '[{"directory": ".", "file": "a.cpp", "arguments": ["c++", "-Dint=static int", "-c", "a.cpp"]}]'
DANGLING = "int & pick()\n{\n  int local = 1;\n  return local;\n}\n"


@pytest.mark.parametrize("brought", ["build/compile_commands.json", "cfg/compile_commands.json", "altered", ""])
def test_a_compile_database_of_the_change_is_not_read(brought: str, trap: Trap) -> None:
    """Its definitions make other code of a file for cppcheck alone; that of the base, and one that a build has made, are read."""
    trap.use_cheap_control()
    trap.write("a.cpp", "int a;\n")
    if brought in ("altered", ""):
        trap.write("build/compile_commands.json", DATABASE.replace("=static int", "=long") if brought else DATABASE)
    trap.commit()
    trap.git("checkout", "-q", "-b", "head")
    trap.write("a.cpp", DANGLING)
    if brought:
        trap.write("build/compile_commands.json" if brought == "altered" else brought, DATABASE)
    if brought.startswith("cfg"):
        (trap.root / "build").symlink_to("cfg")
    trap.commit()
    outcome = trap.run("--baseline-rev=main", "--ignore=cpplint,metrics")
    assert_harmless(trap, outcome)
    assert (("a.cpp", 4, "returnReference") in outcome.findings()) is bool(brought)
    assert outcome.says("a compile database that the change brings is not read") is bool(brought)
