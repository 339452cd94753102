# SPDX-License-Identifier: Apache-2.0
"""Names that tools give to the Python files that they run."""

from __future__ import annotations

import pytest

from haros_ci.linters.given_names import GIVEN, is_extra_script, is_given

SPHINX = "project = 'a'\nextensions = []\nif tags.has('b'):\n    pass\n"
SCRIPT = "Import('env projenv')\nenv.Append(A=1)\n"
GIVES = [
    (".cmake-format.py", "section", "with section('format'):\n    a = 1\n"),
    ("tools/cmake-format.py", "section", "with section('format'):\n    a = 1\n"),
    ("doc/conf.py", "tags", SPHINX),
    (".jupyter/jupyter_notebook_config.py", "get_config", "c = get_config()\n"),
    ("jupyter_server_config.py", "c", "c.ServerApp.port = 1\n"),
    ("ipython_config.py", "load_subconfig", "load_subconfig('a.py')\n"),
    ("libwalk.so-gdb.py", "gdb", "gdb.printing\n"),
    ("SConstruct.py", "Environment", "env = Environment()\n"),
    ("src/SConscript", "env", "Import('env')\nenv.Library('a')\n"),
    ("SConscript", "Import", "Import('env')\n"),
]
GIVES_NOT = [
    (".cmake-format.py", "sections", "with sections('format'):\n    a = 1\n"),
    ("cmake_format.py", "section", "with section('format'):\n    a = 1\n"),
    ("cmake-format.py/a.py", "section", "section\n"),
    ("doc/conf.py", "tag", SPHINX),
    ("config/conf.py", "tags", "use(tags)\n"),
    ("config/conf.py", "tags", "# extensions\nuse(tags)\n"),
    ("config/conf.py", "tags", "def f():\n    extensions = tags\n"),
    ("doc/conf2.py", "tags", SPHINX),
    ("walker_config.py", "c", "c.a = 1\n"),
    ("gdb.py", "gdb", "gdb.printing\n"),
    ("walk_gdb.py", "gdb", "gdb.printing\n"),
    ("SConstruct.py", "env", "env.Library('a')\n"),
    ("SConstruct.py", "env", "from a import Import\nImport('env')\nenv\n"),
    ("SConstruct.py", "env", "Import(env)\n"),
    ("SConstruct.py", "corners", "def never():\n    Import('corners')\nuse(corners)\n"),
    ("SConstruct.py", "corners", "# Import('corners')\nuse(corners)\n"),
    ("SConstruct.py", "corners", "if False:\n    Import('corners')\nuse(corners)\n"),
    ("setup.py", "Environment", "Environment()\n"),
    ("script.py", "env", SCRIPT),
    ("wscript.py", "bld", "bld.program()\n"),
    (".ycm_extra_conf.py", "flags", "use(flags)\n"),
    (".lldbinit.py", "lldb", "lldb.debugger\n"),
]


@pytest.mark.parametrize(("path", "name", "text"), GIVES)
def test_names_that_a_tool_gives(path: str, name: str, text: str) -> None:
    assert is_given(path, name, text)


@pytest.mark.parametrize(("path", "name", "text"), GIVES_NOT)
def test_names_that_nothing_gives(path: str, name: str, text: str) -> None:
    assert not is_given(path, name, text)


def test_each_row_names_its_source() -> None:
    assert all(row.names and row.source for row in GIVEN)


EXTRA = [
    ("fw/platformio.ini", "[env:a]\nextra_scripts = pre:tools/script.py\n", True),
    ("fw/platformio.ini", "[env:a]\nextra_scripts =\n    post:other.py\n    ./tools/script.py ; last\n", True),
    ("platformio.ini", "[env]\nextra_scripts = pre:a.py, fw/tools/script.py\n", True),
    ("fw/platformio.ini", "[env:a]\nextra_scripts = script.py\n", False),
    ("fw/platformio.ini", "[env:a]\n; extra_scripts = tools/script.py\n", False),
    ("fw/platformio.ini", "[env:a]\nextra_scripts = a.py\nlib = tools/script.py\n", False),
    ("fw/platformio.ini", "[env:a]\nextra_scripts = more/tools/script.py\n", False),
    ("fw/platformio.ini", "[env:a]\nextra_scripts = tools/script.pyc\n", False),
    ("other/platformio.ini", "[env:a]\nextra_scripts = tools/script.py\n", False),
]


@pytest.mark.parametrize(("project", "text", "expected"), EXTRA)
def test_an_extra_script_of_platformio(project: str, text: str, expected: bool) -> None:
    files = {project: text}

    def runs(path: str) -> bool:
        return is_extra_script(path, files.__contains__, files.__getitem__)

    assert is_given("fw/tools/script.py", "env", SCRIPT, runs) is expected
    assert is_given("fw/tools/script.py", "projenv", SCRIPT, runs) is expected
    assert not is_given("fw/tools/script.py", "board", SCRIPT, runs)


@pytest.mark.parametrize("text", ["# Import\nEnvironment()\n", "def never():\n    Import('env')\nEnvironment()\n"])
def test_a_program_that_calls_itself_an_extra_script(text: str) -> None:
    assert not is_given("node.py", "Environment", text, lambda path: True)
    assert is_given("node.py", "Environment", "Import('env')\n" + text, lambda path: True)
