# SPDX-License-Identifier: Apache-2.0
"""Words of tools that stand in no file of the workspace, and those that may all the same."""

from __future__ import annotations

from pathlib import Path

import pytest
from linter_samples import workspace

from haros_ci.linters import cppcheck, pylint
from haros_ci.linters.gate import CUT, Gate
from haros_ci.linters.linter import LintOptions, Unit

FILES = {
    "src/pkg/a.cpp": "int speed_limit = 3; // Über_schrift\n",
    "src/pkg/b.hpp": "struct BumperEvent {};\n",
    "other/z.py": "far_away = 1\n",
}


@pytest.fixture(scope="module")
def gates(tmp_path_factory: pytest.TempPathFactory) -> dict[str, Gate]:
    space = workspace(tmp_path_factory.mktemp("gate"), FILES)
    found = {}
    for linter in (cppcheck, pylint):
        program = linter.locate(LintOptions())
        assert program is not None
        found[linter.NAME] = Gate(space, linter, program)
    return found


def cut(gates: dict[str, Gate], message: str, tool: str = "cppcheck") -> str:
    gate = gates[tool]
    files = {file.path: file for file in gate._workspace.files}
    return gate.cut(message, Unit(files["src/pkg/a.cpp"], dependencies=("src/pkg/b.hpp",)))


@pytest.mark.parametrize(
    ("message", "shown"),
    [
        ("Condition 'e==hunter' is always true", f"Condition 'e=={CUT}' is always true"),
        ("Uninitialized variable: ghp_Zx81Kq", f"Uninitialized variable: {CUT}"),
        ("The token is AKIAQWERTYUIOP", f"The token is {CUT}"),
        ('Line "sesame:secretword" is wrong', f'Line "{CUT}:{CUT}" is wrong'),
        ("Use `p4ssw0rd` here", f"Use `{CUT}` here"),
        ("pin 4815162342", f"pin {CUT}"),
        ("correcthorsebatterystaplecorrect", CUT),
        ("Pass‘wörtchen’", f"Pass‘{CUT}’"),
    ],
)
def test_foreign_words_are_cut(gates: dict[str, Gate], message: str, shown: str) -> None:
    assert cut(gates, message) == shown


@pytest.mark.parametrize(
    "message",
    [
        "Variable 'speed_limit' is assigned a value that is never used.",
        "Comment 'Über_schrift' has an accent",
        "Class 'BumperEvent' has no constructor",
        "Same name as 'far_away' elsewhere",
        "#ifndef header guard has wrong style, please use: SRC_PKG_A_CPP_",
        "Obsolescent function 'gets' called. It is recommended to use 'fgets' or 'gets_s' instead.",
        "Consider using std::find_if algorithm instead of a raw loop.",
        "Array 'a[10]' accessed at index 12, which is out of bounds.",
        "Shifting a negative value is technically undefined behaviour",
        "It's the user's own: don't cut it",
        "The scope of the variable 'i' can be reduced",
        "RecursionError",
        "C-style pointer casting of CWE398 in POSIX",
    ],
)
def test_others_stay(gates: dict[str, Gate], message: str) -> None:
    assert cut(gates, message) == message


@pytest.mark.parametrize(
    "message",
    [
        "Unused 'os' imported; consider 'subprocess.Popen' and 'TypeError'",
        "Missing function or method docstring",
        "Use 'isinstance()' instead of 'type()'",
        "Consider using 'with' for resource-allocating operations",
    ],
)
def test_python_s_names_stay(gates: dict[str, Gate], message: str) -> None:
    assert cut(gates, message, "pylint") == message


def test_words_are_looked_for_in_the_tool_itself(gates: dict[str, Gate], tmp_path: Path) -> None:
    assert cut(gates, "constParameterReference") == "constParameterReference"
    assert cut(gates, "constParameterReferenze") == CUT
