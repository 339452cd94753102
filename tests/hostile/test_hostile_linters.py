# SPDX-License-Identifier: Apache-2.0
"""The linters that are asked for, on workspaces that want more of them than findings."""

from __future__ import annotations

import os
import subprocess
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest
from hostile_kit import Outcome, Trap, assert_harmless

from haros_ci.linters import flake8, installed, rows, settings_files
from haros_ci.linters.linter import LintOptions

OFF = ("cppcheck", "cpplint", "pylint", "lizard", "radon", "ruff", "clang-tidy", "catkin_lint")
SECRET_MODULE = f"from typing import Final\nKEY: Final = {Trap.SECRET!r}\nclass A:\n    the_secret_outside = 1\n"


def asking(trap: Trap, *tools: str) -> Outcome:
    """A run of *tools* alone, found harmless."""
    entries = [*(f"{name}: false" for name in OFF if name not in tools), *(f"{name}: true" for name in tools)]
    trap.write("haros.yaml", f"linters: {{{', '.join(entries)}}}\n")
    outcome = trap.run("--no-cache", *(f"--select={name}" for name in tools))
    assert_harmless(trap, outcome)
    return outcome


def found(outcome: Outcome, path: str) -> set[str]:
    return {f"{r['tool']}:{r['rule']}" for r in outcome.report["results"] if r["path"] == path}


@pytest.mark.parametrize("tool", ["mypy", "pylint"])
def test_imports_lead_to_nothing_outside(trap: Trap, tool: str) -> None:
    """By a link to a module or package; even if the settings ask for it."""
    for name in ("leak.py", "stub.pyi", "pk/__init__.py"):
        place = trap.outside / name
        place.parent.mkdir(exist_ok=True)
        place.write_text(SECRET_MODULE)
    for name in ("leak.py", "stub.pyi", "pk"):
        (trap.root / name).symlink_to(trap.outside / name)
    trap.write("q/__init__.py", "")
    (trap.root / "q" / "leak.py").symlink_to(trap.outside / "leak.py")
    (trap.root / "q" / "inside.py").symlink_to(trap.root / "own.py")
    os.mkfifo(trap.root / "pipe.py")
    follow = "follow_imports = normal\nfollow_imports_for_stubs = False\n"
    trap.write("mypy.ini", "[mypy]\n" + "".join(f"{s}{follow}" for s in ("", "[mypy-leak]\n", "[mypy-stub]\n")))
    trap.write("own.py", "from typing import Final\n\nOWN: Final = 1\n")
    lines = ["import leak", "import stub", "import pk", "from q import leak as other", "from typing import Literal"]
    modules = ("leak", "stub", "pk", "other")
    lines += [f"x_{name}: Literal['a'] = {name}.KEY\n{name}.A().the_secret_outsid" for name in modules]
    trap.write("a.py", "\n".join([*lines, "import pipe", "from q import inside", "y: str = inside.OWN", ""]))
    outcome = asking(trap, tool)
    assert outcome.code != 3
    if tool == "mypy":
        own = {r["message"] for r in outcome.report["results"] if r["rule"] == "assignment"}
        assert len(own) == 1 and "int" in own.pop()  # what lies inside is followed
    else:
        assert "pylint:undefined-variable" in found(outcome, "control.py")


def test_nothing_of_one_file_passes_for_words_on_another(trap: Trap) -> None:
    """Tools quote what they cannot read."""
    trap.write("evil.py", "x = \x0ccontrol.py:3: bad - (\n")
    trap.write("evil2.py", "x = \x0cerror: cannot format control.py: Cannot parse: 1:3: x ((\n")
    trap.write("evil3.py", "X = '{x\\n./control.py\\t1\\t1\\tE902\\tlies}'.format(y=1)\n")
    outcome = asking(trap, "vulture", "black", "flake8")
    assert not [message for path, message in outcome.notes() if path == "control.py"]
    assert found(outcome, "control.py") == {"flake8:F821"}


BOMBS: dict[str, Callable[[Trap], object]] = {
    "yamllint": lambda t: t.write(".yamllint", f"ignore-from-file: [{'big, ' * 5000}]\nrules: {{}}\n"),
    "codespell": lambda t: t.write(".codespellrc", f"[codespell]\nignore-words = {'big,./big,' * 1000}\n"),
    "flake8": lambda t: t.write("setup.cfg", "[flake8]\n" + ("max" + " " * 4900 + "x\n") * 100),
    "isort": lambda t: t.write(".isort.cfg", "[settings]\n[DEFAULT]\n" + inherited()),
    "black": lambda t: t.write("pyproject.toml", "[tool.black]\n[tool.vulture]\na" + ".'a'" * 5000 + " = 1\n"),
    "vulture": lambda t: None,  # the same file
}


def inherited() -> str:
    return "".join(f"k{n} = 1\n" for n in range(4000)) + "".join(f"[s{n}]\n" for n in range(4000))


def test_settings_that_explode(trap: Trap) -> None:
    """They cost their own tool at most, and no memory."""
    trap.write("big", "wrod\n" * 200_000)
    for set_trap in BOMBS.values():
        set_trap(trap)
    trap.write("a.yaml", "a:  1\n")
    outcome = asking(trap, *BOMBS)
    assert outcome.says("yamllint failed: .yamllint: ignore-from-file names more than 8 files")
    assert outcome.code == 3
    assert "flake8:F821" in found(outcome, "control.py")


@pytest.mark.parametrize(
    "text",
    [
        "[tool.a]\n" + "a." * 20_000 + "a = 1\n",
        "[" + ".".join(["tool", *["'a'"] * 10_000]) + "]\n",
        "x = {" + "a . " * 10_000 + "a = 1}\n",
        "x = " + "[" * 100_000,
    ],
)
def test_a_toml_that_is_too_much(text: str) -> None:
    with pytest.raises((ValueError, RecursionError)):
        settings_files.toml(text)


@pytest.mark.parametrize(
    "text",
    [
        "[tool.isort.sections.a]\nknown_first_party = ['a.b.c.d', \"x.y\"]\n",
        "[tool.a]\nx = '" + "one two. " * 1000 + "'\n",
        "[tool.a]\nx = '" + "....... " * 1000 + "'\n",
        "[tool.a]\nx = [" + "'a.b', " * 1000 + "]\n",
        "[tool.a]\n" + "x" * 200_000 + " = 1\n",
    ],
)
def test_a_toml_like_others(text: str) -> None:
    assert settings_files.toml(text)


def test_an_ini_with_wide_gaps() -> None:
    wide = " " * 100_000
    assert settings_files.ini(f"[flake8]\nmax-line-length{wide}={wide}99\nselect =\n{wide}E\n{wide}F\n") == {
        "flake8": {"max-line-length": "99", "select": "\nE\nF"}
    }


@pytest.fixture
def deep(trap: Trap) -> Iterator[Trap]:
    """A file deeper than Python's stack."""
    here = os.getcwd()
    os.chdir(trap.root)
    for _ in range(1100):
        os.mkdir("a")
        os.chdir("a")
    Path("x.py").write_text("import os\n")
    os.chdir(here)
    yield trap
    subprocess.run(["rm", "-rf", str(trap.root / "a")], check=True)  # shutil.rmtree is recursive


def test_settings_are_looked_for_from_any_depth(deep: Trap) -> None:
    outcome = asking(deep, "flake8", "mypy", "black")
    assert outcome.code == 1
    assert found(outcome, "a/" * 1100 + "x.py") >= {"flake8:F401"}


def test_a_style_is_of_the_workspace(trap: Trap) -> None:
    """clang-format 21 takes a style from any directory that another names."""
    (trap.outside / ".clang-format").write_text("BasedOnStyle: LLVM\nIndentWidth: 7\n")
    trap.write(".clang-format", f"BasedOnStyle: InheritParentConfig={trap.outside}\n")
    trap.write("b/.clang-format", "BasedOnStyle: Google\n")
    trap.write("c/.clang-format", f'BasedOnStyle: "Inherit\\x50arentConfig={trap.outside}"\n')
    trap.write("d/.clang-format", "BasedOnStyle: InheritParentConfig\n")
    for directory in ("", "b/", "c/", "d/"):
        trap.write(f"{directory}x.cpp", "int  f( ){return 1;}\n")
    outcome = asking(trap, "clang-format")
    assert outcome.code == 3
    assert {path for path, _, _ in outcome.findings()} == {"b/x.cpp"}
    assert {path for path, message in outcome.notes() if "clang-format failed" in message} == {
        "x.cpp",
        "c/x.cpp",
        "d/x.cpp",
    }


def test_a_program_may_take_no_notice_of_what_it_is_asked(tmp_path: Path) -> None:
    """What it writes is bounded, also by what it starts; a short answer is an answer."""
    for name, script in {"endless": "yes 1.2.3", "sound": "echo sound 1.2.3", "failing": "echo 1.2.3; exit 1"}.items():
        (tmp_path / name).write_text(f"#!/bin/sh\n{script}\n")
        (tmp_path / name).chmod(0o755)
    names = ("endless", "sound", "failing", "none")
    assert [installed.version_of(str(tmp_path / name)) for name in names] == [None, "1.2.3", None, None]


def test_what_an_answer_may_hold() -> None:
    def known(count: int, line: object = 1) -> object:
        row = ["warning", "x", "a.py", line, None, None, None]
        return rows.decode({"rules": [["t", "r", [row] * count]], "gave_up": []}, "a.py", lambda *_: True, ["a.py"])

    assert known(rows.MOST) is not None and known(1, 2**31 - 1) is not None
    assert known(rows.MOST + 1) is None
    assert known(1, 10**300) is None


def test_no_place_of_this_machine_is_in_a_fingerprint(trap: Trap) -> None:
    """Shards compare them between machines."""
    from haros_ci.model.workspace import Workspace

    assert "/" not in flake8.fingerprint(Workspace(trap.root, (), (), None), LintOptions())  # type: ignore[arg-type]


def test_a_name_is_no_list_of_arguments(trap: Trap) -> None:
    """mypy reads arguments from the file whose name follows an ``@``."""
    (trap.outside / "more.py").write_text(f"x: int = {Trap.SECRET!r}\n")
    trap.write("@more.py", "x: int = ''\n")
    trap.write("more.py", f"--config-file=evil.ini\n{trap.outside / 'more.py'}\n")
    trap.write("@gone.py", "x: int = (\n")
    trap.write("evil.ini", "[mypy]\nplugins = evil.py\n")
    trap.write("evil.py", trap.python("plug-in"))
    trap.write("good.py", "x: int = ''\n")
    outcome = asking(trap, "mypy")
    assert outcome.code == 1
    assert found(outcome, "@more.py") == found(outcome, "good.py") == {"mypy:assignment"}
    assert ("@gone.py", "mypy could not analyse this file: it is not valid Python") in [
        (path, message.rpartition(" ")[0]) for path, message in outcome.notes()
    ]
