# SPDX-License-Identifier: Apache-2.0
"""Workspaces that would like to run something: modules, tool configuration, planted programs, compile databases."""

from __future__ import annotations

import json
import os
import shutil
import sys
from collections.abc import Callable
from dataclasses import dataclass

import pytest
from hostile_kit import Outcome, Trap, assert_harmless, assert_the_rest_is_analysed

AFRESH = True
#: Names that the command, its tools, their interpreters or their libraries import.
MODULES = """
    json re os typing encodings site sitecustomize usercustomize conftest setup runpy glob tokenize curses
    astroid pylint cpplint lizard radon yaml click sarif_om mando isort haros_ci haros_ci_checks ruff catkin_lint
    evil_plugin evil_extension
""".split()
PROGRAMS = "git cppcheck ruff clang-tidy python python3 sh bash env cpplint pylint lizard radon catkin_lint".split()

PYTHON = '"""A module."""\nX = undefined_here\n'
CPP = "int f(int x) { int *unset = 0; return *unset + x; }\n"


@dataclass(frozen=True)
class Case:
    """What is planted; *path* is a file beside it whose *rule* must be reported all the same."""

    name: str
    build: Callable[[Trap], object]
    path: str
    rule: str = "undefined-variable"


def module(name: str, place: str) -> Case:
    """A module that betrays itself when it is imported."""
    path = f"{place}{name}.py"
    return Case(path, lambda t: t.write(path, f"{t.python(path.replace('/', '-'))}\n{PYTHON}"), path)


def package(name: str, place: str) -> Case:
    path = f"{place}{name}/__init__.py"
    return Case(path, lambda t: t.write(path, f"{t.python(path.replace('/', '-'))}\n{PYTHON}"), path)


def pylint_settings(directory: str, name: str, text: str) -> Case:
    """A configuration of pylint that runs code in every way it can; the file beside it is checked without."""

    def build(t: Trap) -> None:
        hook = t.python(directory)
        t.write(f"{directory}/{name}", text.format(hook=hook, quoted=json.dumps(hook)))
        t.write(
            f"{directory}/evil_plugin.py",
            f"{t.python(directory + '-plugin')}\ndef register(linter): {t.python(directory)}\n",
        )
        t.write(f"{directory}/beside.py", PYTHON + "import evil_extension\n")

    return Case(f"{directory}/{name}", build, f"{directory}/beside.py")


INI = "init-hook={hook}\nload-plugins=evil_plugin\nextension-pkg-allow-list=evil_extension\nunsafe-load-any-extension=yes\n"
TOML = 'init-hook = {quoted}\nload-plugins = ["evil_plugin"]\nextension-pkg-allow-list = ["evil_extension"]\n'
PYLINT = [
    pylint_settings("rc1", ".pylintrc", "[MAIN]\n" + INI),
    pylint_settings("rc2", "pylintrc", "[MASTER]\n" + INI.replace("-", "_")),
    pylint_settings("rc3", "pyproject.toml", "[tool.pylint.main]\n" + TOML),
    pylint_settings("rc4", "setup.cfg", "[pylint.main]\n" + INI),
    pylint_settings("rc5", "tox.ini", "[pylint]\n" + INI),
    pylint_settings(
        "rc6",
        ".pylintrc",
        "[MAIN]\ndisable=invalid-name\n   [MAIN]\n   init-hook={hook}\n   load-plugins=evil_plugin\n",
    ),
    pylint_settings("rc7", ".pylintrc", "[MAIN\x00\ninit-hook={hook}\n::error::x\n"),
    pylint_settings(
        "rc8",
        ".pylintrc",
        "[MAIN]\ndisable=\nevaluation=__import__('os')\nimport-graph=graph.dot\noutput-format=text:{hook}\n",
    ),
]


def cpp_settings(directory: str, name: str, text: str) -> Case:
    """A configuration of a C++ tool beside a file with one defect."""

    def build(t: Trap) -> None:
        t.write(f"{directory}/{name}", text.format(payload=t.touch(directory), script=t.root / "evil_plugin.py"))
        t.write(f"{directory}/beside.cpp", CPP)

    return Case(f"{directory}/{name}", build, f"{directory}/beside.cpp", "nullPointer")


def at_root(name: str, text: str) -> Case:
    return Case(
        name,
        lambda t: t.write(name, text.format(payload=t.touch("root"), script=t.root / "evil_plugin.py")),
        "top.cpp",
        "nullPointer",
    )


def planted(name: str) -> Case:
    """A program that betrays itself, in a directory of the workspace that is on PATH."""

    def build(t: Trap) -> None:
        for path in (f"bin/{name}", name):
            t.write(path, f"#!/bin/sh\n{t.touch('bin-' + name)}\necho 9.9.9\n").chmod(0o755)

    return Case(f"bin/{name}", build, "top.cpp", "nullPointer")


def compile_database(entry: dict[str, object] | str) -> Case:
    """A database in the one place that is looked into without being told."""

    def build(t: Trap) -> None:
        t.write("top.cpp", CPP)
        t.write("build/evil.rsp", "-fplugin=evil.so\n")
        t.write("build/compile_commands.json", entry if isinstance(entry, str) else json.dumps([entry]))

    return Case("compile database", build, "top.cpp", "nullPointer")


FLAGS = [
    *("sh", "-c", "touch sentinel", "-fplugin=./evil.so", "-Xclang", "-load", "-Xclang", "./evil.so", "@evil.rsp"),
    *(
        "-include",
        "/etc/passwd",
        "-imacros",
        "/etc/passwd",
        "-I/etc",
        "-I",
        "../../outside",
        "-isystem",
        "/",
        "-iquote",
    ),
    *("../outside", "-DEVIL=\n::error::x", "-Wl,--wrap=x", "-Wp,-MD,sentinel", "-o", "sentinel", "-MF", "sentinel"),
    *("-x", "/etc/passwd", "-std=c++17;touch", "--config=evil", "-B.", "--sysroot=/etc", "-specs=evil", "-Dother=(0)"),
]

#: Settings that their tool cannot read: it fails on the files beside them, and on no others.
BROKEN = [
    pylint_settings("bad1", "pyproject.toml", '[tool.pylint]\nmax-line-length = "100\\n[MAIN]\\ninit-hook={hook}"\n'),
    pylint_settings("bad2", ".pylintrc", "[MAIN]\nno-docstring-rgx=(\n"),
    cpp_settings("bad3", "CPPLINT.cfg", "exclude_files=(\nextensions=../x\nheaders=\x1b[31m\nset noparent\n"),
    cpp_settings("bad4", "CPPLINT.cfg", "exclude_files=(::error::x\n"),
]

CASES = [
    *(module(name, place) for place in ("", "nodes/") for name in MODULES),
    package("curses", "deep/"),
    package("email", "deep/"),
    Case(
        "deep/curses/x.so",
        lambda t: [t.write(f"deep/curses/x.{tag}so", b"\x7fELF") for tag in ("", "abi3.")],
        "deep/user.py",
    ),
    Case(
        "deep/user.py",
        lambda t: t.write("deep/user.py", PYTHON + "import curses.x\nimport email.x\nfrom . import y\n"),
        "deep/user.py",
    ),
    Case(
        "evil.pth",
        lambda t: [t.write(f"{d}evil.pth", f"import os; {t.python('pth')}") for d in ("", "nodes/")],
        "nodes/json.py",
    ),
    *PYLINT,
    cpp_settings("lint1", "CPPLINT.cfg", "no-such-option\nfilter\nlinelength=one\n::error::x\n"),
    cpp_settings(
        "lint2", "CPPLINT.cfg", "filter=" + "-x/y," * 5_000 + "\nlinelength=99999999999999999999\nroot=../../..\n"
    ),
    cpp_settings("tidy1", ".clang-tidy", "Checks: ['*'\n  broken: [\n"),
    cpp_settings("tidy2", ".clang-tidy", "Checks: '*'\nExtraArgs: ['-fplugin=./evil.so', '-Xclang', '-load']\n"),
    cpp_settings("check1", ".cppcheck", "--addon={script}\n--suppress=*\n"),
    at_root("cppcheck.cfg", '{{"addons": ["{script}"], "productName": "::error::x", "safety": true}}'),
    at_root(".cppcheck", "--addon={script}\n"),
    at_root("suppressions.txt", "*\n"),
    at_root("suppressions.xml", "<suppressions><suppress><id>*</id></suppress></suppressions>"),
    at_root("std.cfg", "<not a library"),
    at_root("boost.cfg", "<not a library"),
    at_root("boost", "<not a library"),
    at_root("qt.cfg", "<!DOCTYPE d [<!ENTITY e SYSTEM 'file:///etc/passwd'>]><def>&e;</def>"),
    at_root("../CPPLINT.cfg", "exclude_files=.*\nfilter=-\n"),
    at_root("../.pylintrc", "[MAIN]\ninit-hook={payload}\n"),
    at_root("../ruff.toml", "lint.ignore = ['ALL']\n"),
    *(planted(name) for name in PROGRAMS),
    compile_database({"directory": ".", "file": "top.cpp", "arguments": FLAGS, "command": "; ".join(FLAGS)}),
]


@pytest.fixture(scope="module")
def scene(new_trap: Callable[[], Trap]) -> tuple[Trap, Outcome]:
    """All of it at once, in an environment that points into the workspace wherever it can."""
    trap = new_trap()
    for case in CASES:
        case.build(trap)
    root = str(trap.root)
    environment = {
        **dict.fromkeys(("PYTHONPATH", "PYTHONUSERBASE", "PYTHONPLATLIBDIR", "PYLINTHOME", "CLANG_TIDY", "HOME"), root),
        "PYTHONSTARTUP": f"{root}/json.py",
        "PYTHONINSPECT": "",
        "PYLINTRC": f"{root}/rc1/.pylintrc",
        "PYTHONBREAKPOINT": "evil_plugin.register",
        "PATH": f"{root}/bin:.:{root}:" + os.environ["PATH"],
    }
    return trap, trap.run(environment=environment)


@pytest.mark.parametrize("case", CASES, ids=lambda case: case.name)
def test_nothing_of_it_runs(case: Case, scene: tuple[Trap, Outcome]) -> None:
    trap, outcome = scene
    assert outcome.code == 1, (outcome.stderr, outcome.notes())
    assert_harmless(trap, outcome)
    assert_the_rest_is_analysed(outcome)
    assert (case.path, case.rule) in {(path, rule) for path, _, rule in outcome.findings()}, outcome.notes()


@pytest.fixture(scope="module")
def broken(new_trap: Callable[[], Trap]) -> tuple[Trap, Outcome]:
    trap = new_trap()
    for case in BROKEN:
        case.build(trap)
    return trap, trap.run()


@pytest.mark.parametrize("case", BROKEN, ids=lambda case: case.name)
def test_settings_that_break_a_tool(case: Case, broken: tuple[Trap, Outcome]) -> None:
    """That is trouble with the tool, never green; other files and other tools are not concerned."""
    trap, outcome = broken
    assert outcome.code == 3
    assert_harmless(trap, outcome)
    assert_the_rest_is_analysed(outcome)
    assert outcome.says(f"without a result: {case.path}") or outcome.says(
        f"{case.name.partition('/')[0]}/evil_plugin.py"
    )
    if case.path.endswith(".cpp"):  # what cpplint would have said is missing, not what cppcheck says
        assert (case.path, case.rule) in {(path, rule) for path, _, rule in outcome.findings()}


@pytest.mark.skipif(not shutil.which("ruff", path=os.path.join(sys.prefix, "bin")), reason="ruff is optional")
def test_ruff_settings_that_name_a_file_outside(trap: Trap) -> None:
    trap.write("sub/ruff.toml", 'extend = "/etc/passwd"\n')
    trap.write("sub/beside.py", PYTHON)
    outcome = trap.run()
    assert outcome.code == 1 and outcome.says("ruff does not read the file that `extend` names here")
    assert_harmless(trap, outcome)
    assert_the_rest_is_analysed(outcome)
    assert ("sub/beside.py", 2, "undefined-variable") in outcome.findings()


def test_a_trusted_configuration_runs_its_code(trap: Trap) -> None:
    """What ``--trust-config`` promises, and nothing without it: the same workspace, run both ways."""
    pylint_settings("rc", ".pylintrc", "[MAIN]\ninit-hook={hook}\n").build(trap)
    outcome = trap.run()
    assert outcome.code == 1
    assert_harmless(trap, outcome)
    outcome = trap.run("--trust-config")
    assert outcome.code == 1 and trap.executed == ["rc"]
    assert_the_rest_is_analysed(outcome)
