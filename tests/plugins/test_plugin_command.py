# SPDX-License-Identifier: Apache-2.0
"""Plug-ins on the command line: what they bring is shown, and what goes wrong with them is trouble and nothing else."""

from __future__ import annotations

import json
import shutil
import subprocess
import sys
from importlib.metadata import version
from pathlib import Path

import pytest
from commandline import write
from plugin_cases import EXAMPLE, check_module, run, started, workspace

NAME = "haros_ci_example_plugin"
#: Only what the plug-in brings, so that no other tool is started.
QUICK = ("--profile", "architecture", "--no-cache", "--fail-on", "never")


def test_the_example_brings_what_it_says(tmp_path: Path) -> None:
    root = workspace(tmp_path / "ws")
    tsv, sarif = tmp_path / "o.tsv", tmp_path / "o.sarif"
    outputs = ("--output", f"acme-tsv={tsv}", "--output", f"sarif={sarif}")
    chosen = ("--ignore", "*", "--select", "acme-todo:no-owner,camel-case-topic")
    done = run("check", "--no-cache", "--plugin", NAME, *chosen, *outputs, cwd=root, path=EXAMPLE / "src")
    assert done.returncode == 0, done.stderr
    assert tsv.read_text().splitlines() == [
        "lamp.py:7:17\tnote\tacme-todo:no-owner\tnobody is named to do it: later",
        "lamp.py:9:7\tnote\tharos-ci:camel-case-topic\t/lamp publishes /batteryState: the house writes /battery_state",
    ]
    runs = {each["tool"]["driver"]["name"]: each for each in json.loads(sarif.read_text())["runs"]}
    assert runs["haros-ci"]["tool"]["extensions"] == [{"name": NAME, "version": "1.0.0"}]
    assert runs["acme-todo"]["tool"]["driver"]["rules"][0]["id"] == "no-owner"
    assert len(runs["haros-ci"]["results"]) == 1


def test_its_rows_are_known_to_the_model(tmp_path: Path) -> None:
    root = workspace(tmp_path / "ws")
    names = []
    for arguments in ((), ("--plugin", NAME), ()):  # one after the other on one cache
        done = run("model", "--format", "json", *arguments, cwd=root, path=EXAMPLE / "src")
        (configuration,) = json.loads(done.stdout)["configurations"]
        names.append({end["name"] for node in configuration["nodes"] for end in node["publishers"]})
    assert "/red/beacon" in names[1]
    assert names[0] == names[2] and "/red/beacon" not in names[0]


def test_rules_and_explain_know_it(tmp_path: Path) -> None:
    done = run("explain", "camel-case-topic", cwd=tmp_path, path=EXAMPLE / "src", HAROS_CI_PLUGINS=f" {NAME},")
    assert "The house writes names of topics" in done.stdout
    done = run("rules", "--json", "--plugin", NAME, cwd=tmp_path, path=EXAMPLE / "src")
    rows = {row["id"]: row for row in json.loads(done.stdout)}
    assert rows["haros-ci:camel-case-topic"]["enabled"] and rows["acme-todo:no-owner"]["level"] == "note"
    done = run("explain", "camel-case-topic", cwd=tmp_path, path=EXAMPLE / "src")
    assert done.returncode == 2 and "unknown rule 'camel-case-topic'" in done.stderr


def test_the_project_file_names_plugins_only_where_it_is_trusted(tmp_path: Path) -> None:
    root = workspace(tmp_path / "ws")
    write(root, {".haros-ci.yaml": f"plugins: [{NAME}]\n"})
    done = run("check", *QUICK, cwd=root, path=EXAMPLE / "src")
    assert "plugins are loaded only with --trust-config" in done.stdout and "camel-case-topic" not in done.stdout
    done = run("check", *QUICK, "--trust-config", cwd=root, path=EXAMPLE / "src")
    assert "camel-case-topic" in done.stdout


def test_installed_it_is_found(tmp_path: Path) -> None:
    if tuple(map(int, version("setuptools").split(".")[:2])) < (70, 1):
        pytest.skip(
            "older ones need the package wheel besides"
        )  # not imported: setuptools refuses where distutils is loaded
    shutil.copytree(EXAMPLE, tmp_path / "source")
    target = tmp_path / "target"
    command = [sys.executable, "-m", "pip", "install", "--quiet", "--no-deps", "--no-build-isolation", "--no-index"]
    made = subprocess.run([*command, "--target", str(target), str(tmp_path / "source")], capture_output=True, text=True)
    if "No module named pip" in made.stderr:
        pytest.skip("no pip here")
    assert made.returncode == 0, made.stderr
    done = started("check", *QUICK, "--plugin", NAME, cwd=workspace(tmp_path / "ws"), path=target)
    assert "the house writes /battery_state" in done.stdout


def test_its_own_tests_pass(tmp_path: Path) -> None:
    command = [
        sys.executable,
        "-m",
        "pytest",
        "-q",
        "-p",
        "no:cacheprovider",
        "--basetemp",
        str(tmp_path / "t"),
        "tests",
    ]
    done = subprocess.run(command, cwd=EXAMPLE, env={"PYTHONPATH": "src", "PATH": ""}, capture_output=True, text=True)
    assert done.returncode == 0, done.stdout


# -- trouble ------------------------------------------------------------------------------------------------------

FAILING = {
    "odd-key": ("raise KeyError('x')", "failed: KeyError: 'x'"),
    "odd-exit": ("raise SystemExit(0)", "failed: RuntimeError: it called exit(0)"),
    "odd-number": ("return 3", "failed: TypeError"),
    "odd-text": ("yield 'text'", "failed: TypeError: a check yields findings, not str"),
    "odd-place": ("yield Finding(at=Location('no.py', 1), message='m', about=())", "no.py is no file of the workspace"),
}


def test_a_check_that_fails_is_trouble(tmp_path: Path) -> None:
    root = workspace(tmp_path / "ws")
    write(root, {"package.xml": "<package>"})
    modules = {f"case_{id.replace('-', '_')}.py": check_module(id, body) for id, (body, _) in FAILING.items()}
    write(tmp_path / "lib", modules)
    named = ",".join(name.removesuffix(".py") for name in modules)
    done = run("check", *QUICK, "--select", "malformed-manifest", "--plugin", named, cwd=root, path=tmp_path / "lib")
    assert done.returncode == 3
    for id, (_, said) in FAILING.items():
        assert any(f"the check {id} failed" in line and said in line for line in done.stdout.splitlines()), id
    assert "malformed-manifest" in done.stdout  # nothing else is lost


def test_what_a_plugin_prints_does_not_get_into_the_output(tmp_path: Path) -> None:
    noise = "import os\nprint('NOISE')\nos.write(1, b'NOISE')\nos.system('echo NOISE')\n"
    body = "print('NOISE'); import os; os.system('echo NOISE'); return ()"
    formats = "def render(report):\n    print('NOISE')\n    return '{}'\nRENDERERS = {'acme': render}\n"
    write(tmp_path / "lib", {"case_noise.py": noise + check_module("odd", body) + formats})
    root = workspace(tmp_path / "ws")
    done = run("check", *QUICK, "--plugin", "case_noise", "--output", "json", cwd=root, path=tmp_path / "lib")
    assert json.loads(done.stdout)
    assert done.stderr.count("NOISE") == 5
    done = run("check", *QUICK, "--plugin", "case_noise", "--output", "acme", cwd=root, path=tmp_path / "lib")
    assert done.stdout == "{}"


def test_a_format_that_fails_is_trouble_and_the_others_are_written(tmp_path: Path) -> None:
    root = workspace(tmp_path / "ws")
    bodies = {"a": "1 / 0", "b": "raise SystemExit(0)", "c": "return 3", "d": "return None"}
    functions = "".join(f"def {name}(report):\n    {body}\n" for name, body in bodies.items())
    write(tmp_path / "lib", {"case_format.py": f"{functions}RENDERERS = dict(a=a, b=b, c=c, d=d)\n"})
    outputs = [f"--output={format}={tmp_path / 'out' / format}" for format in (*bodies, "json")]
    done = run("check", *QUICK, "--plugin", "case_format", *outputs, cwd=root, path=tmp_path / "lib")
    assert done.returncode == 3
    assert all(f"the format {name} of plug-in case_format" in done.stderr for name in bodies)
    assert [path.name for path in (tmp_path / "out").iterdir()] == ["json"]


def test_a_format_of_ours_is_not_replaced(tmp_path: Path) -> None:
    write(tmp_path / "lib", {"case_ours.py": "RENDERERS = {'sarif': str}\n"})
    done = run("check", *QUICK, "--plugin", "case_ours", cwd=workspace(tmp_path / "ws"), path=tmp_path / "lib")
    assert done.returncode == 2 and "the format 'sarif' of a plug-in is one of haros-ci's own" in done.stderr


def test_an_adapter_that_fails_is_trouble_of_its_own(tmp_path: Path) -> None:
    base = (EXAMPLE / "src" / NAME / "todo.py").read_text()
    broken = base.replace('return "1"', "return 1 / 0")
    write(tmp_path / "lib", {"case_todo.py": broken, "case_linter.py": "import case_todo\nLINTERS = (case_todo,)\n"})
    others = "cppcheck,cpplint,pylint,metrics,ruff"
    done = run(
        "check", "--no-cache", "--ignore", others, "--plugin", "case_linter", cwd=workspace(tmp_path / "ws"), path=tmp_path / "lib"
    )  # fmt: skip
    assert done.returncode == 3
    assert "acme-todo: its adapter failed: ZeroDivisionError" in done.stdout


# -- the workspace ------------------------------------------------------------------------------------------------


def test_modules_of_the_workspace_are_not_run(tmp_path: Path) -> None:
    root = workspace(tmp_path / "ws")
    evil = {f"{name}.py": "raise SystemExit('EVIL')\n" for name in ("evil", "click", "yaml", "haros_ci_checks")}
    write(root, {**evil, "haros_plugin_evil/__init__.py": "raise SystemExit('EVIL')\n"})
    done = started("check", *QUICK, cwd=root)
    assert done.returncode == 0 and "EVIL" not in done.stdout + done.stderr
    done = started("check", *QUICK, "--plugin", "evil", cwd=root)
    assert done.returncode == 2 and "what the workspace has of that name is never imported" in done.stderr
    for name in ("click", "yaml", "haros_ci_checks"):  # what PYTHONPATH names is the user's; of a plug-in it is refused
        (root / f"{name}.py").unlink()
    done = started("check", *QUICK, "--plugin", "evil", cwd=root, path=root)
    assert done.returncode == 2 and "EVIL" not in done.stdout + done.stderr
