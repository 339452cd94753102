# SPDX-License-Identifier: Apache-2.0
"""pylint on hostile workspaces: nothing of them is imported or executed, whatever its name or configuration."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import pytest
from linter_samples import MemoryStore, everything, workspace

from haros_ci.linters import pylint
from haros_ci.linters.linter import LintOptions
from haros_ci.linters.run import lint
from haros_ci.model.package import Package
from haros_ci.results.result import Run

CHECKED = '''"""Module."""
import curses.nothing
import _json
import json
import re

import isort
import evil.deep
from . import astroid

print(json, re, isort, curses, evil, astroid, _json)
'''


def trap(root: Path, name: str) -> str:
    """Python source that leaves a mark when it is executed."""
    return f"open({str(root / 'marks')!r}, 'a').write({name + chr(10)!r})\n"


def marks(root: Path) -> str:
    path = root / "marks"
    return path.read_text() if path.exists() else ""


def run(
    root: Path, files: dict[str, str], options: LintOptions | None = None, packages: tuple[Package, ...] = ()
) -> Run:
    (only,) = lint(workspace(root, files, packages), [pylint], options or LintOptions(), MemoryStore(), everything)
    return only


def hostile_modules(root: Path) -> dict[str, str]:
    names = ("json", "re", "isort", "astroid", "pylint", "sitecustomize", "usercustomize", "dill", "encodings")
    files = {f"{where}{name}.py": trap(root, name) for name in names for where in ("", "scripts/")}
    packages = ("curses", "evil", "evil/deep", "xml")
    files |= {f"{where}{p}/__init__.py": trap(root, p) for p in packages for where in ("", "scripts/")}
    return {**files, "main.py": CHECKED, "scripts/main.py": CHECKED}


def test_no_module_of_the_workspace_is_imported(tmp_path: Path) -> None:
    done = run(tmp_path, hostile_modules(tmp_path))
    assert marks(tmp_path) == ""
    assert done.successful
    assert {"main.py", "scripts/main.py"} <= {result.location.path for result in done.results}
    assert not done.notifications


def test_the_trap_works_where_pylint_is_started_plainly(tmp_path: Path) -> None:
    workspace(tmp_path, hostile_modules(tmp_path))
    command = [sys.executable, "-I", "-m", "pylint", "--rcfile=/dev/null", "--persistent=n", "scripts/main.py"]
    subprocess.run(command, cwd=tmp_path, capture_output=True, check=False, timeout=120, env={"HOME": str(tmp_path)})
    assert marks(tmp_path) != ""


CONFIGURATIONS = {
    "pylintrc": "[MASTER]\ninit-hook={trap}\nload-plugins=evil\nevaluation={expression}\n",
    ".pylintrc": "[MAIN]\ninit_hook={trap}\nload-plugins=evil,\n  evil2\nextension-pkg-allow-list=evil\n",
    "setup.cfg": "[pylint.MASTER]\ninit-hook={trap}\nload-plugins=evil\n",
    "tox.ini": "[pylint]\ninit-hook={trap}\nload-plugins=evil\n",
    "pyproject.toml": '[tool.pylint.main]\ninit-hook = """{trap}"""\nload-plugins = ["evil"]\nsource-roots = ["."]\n',
    "scripts/pylintrc": "[MAIN]\ndisable=all\n init-hook={trap}\n[X]\ngood-names=x\n    [MAIN]\n    init-hook={trap}\n",
}


@pytest.mark.parametrize("name", CONFIGURATIONS)
def test_no_configuration_of_the_workspace_runs_code(tmp_path: Path, name: str) -> None:
    hook = trap(tmp_path, "hook").strip()
    text = CONFIGURATIONS[name].replace("{trap}", hook).replace("{expression}", f"__import__('os').system('{hook}')")
    evil = {"evil.py": trap(tmp_path, "evil"), "evil2.py": trap(tmp_path, "evil2")}
    done = run(tmp_path, {name: text, **evil, "scripts/a.py": "x = 1\n", "a.py": "x = 1\n"})
    assert marks(tmp_path) == "" and done.successful and "a.py" in done.analysed


def test_trusted_configuration_is_passed_whole(tmp_path: Path) -> None:
    hook = trap(tmp_path, "hook").strip()
    files = {"pylintrc": f"[MAIN]\ninit-hook={hook}\n", "a.py": "x = 1\n"}
    run(tmp_path, files, LintOptions(trust_config=True))
    assert marks(tmp_path) == "hook\n"


def test_odd_names_are_linted(tmp_path: Path) -> None:
    names = ["-rcfile.py", "--init-hook=x.py", "two words.py", "100%.py", "::error::.py", "ü.py", "a'b.py"]
    done = run(tmp_path, dict.fromkeys(names, "import os\n"))
    assert {result.location.path for result in done.results if result.rule == "unused-import"} == set(names)
    assert done.successful


def test_the_collector_is_off_in_the_tool(tmp_path: Path) -> None:
    tmp_path.joinpath("tool.py").write_text("import gc\nprint(gc.isenabled())\n")
    script = Path(pylint.__file__).with_name("isolation.py")
    command = [sys.executable, "-I", str(script), str(tmp_path), "tool"]
    assert subprocess.run(command, capture_output=True, text=True, check=True).stdout == "False\n"
