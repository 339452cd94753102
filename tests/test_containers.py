# SPDX-License-Identifier: Apache-2.0
"""The GitLab component and the Dockerfile: what they say fits the command, and the component's script does what it should."""

from __future__ import annotations

import fnmatch
import os
import re
import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest
import yaml
from commandline import commit, write
from test_command import BAD, DEFAULT_TOOLS, GOOD, MANIFEST

ROOT = Path(__file__).resolve().parent.parent
SPEC, JOBS = yaml.safe_load_all((ROOT / "templates" / "haros-ci.yml").read_text(encoding="utf-8"))
INPUTS: dict[str, dict[str, Any]] = SPEC["spec"]["inputs"]
JOB: dict[str, Any] = JOBS["haros-ci"]
DOCKERFILE = (ROOT / "Dockerfile").read_text(encoding="utf-8")


def script(where: Path, **given: str) -> str:
    """The job's script with its inputs filled in, for a haros-ci that is here."""
    values = {name: given.get(name, entry["default"]) for name, entry in INPUTS.items()}
    text = re.sub(r"\$\[\[ inputs\.([\w-]+) \]\]", lambda match: values[match[1]], "\n".join(JOB["script"]))
    command = where / "haros-ci"
    command.write_text(f'#!/bin/sh\nexec "{sys.executable}" -m haros_ci "$@"\n', encoding="utf-8")
    command.chmod(0o755)
    return text.replace("/opt/haros-ci/bin/haros-ci", str(command))


def test_every_input_is_used_and_documented() -> None:
    text = str(JOB)
    for name, entry in INPUTS.items():
        assert f"$[[ inputs.{name} ]]" in text
        assert entry["description"]
        assert "options" in entry or "regex" in entry or name == "stage", "what reaches the shell is limited"


@pytest.mark.parametrize("value", ["a; rm -r b", "$(id)", "a`id`", 'a"b', "-r x", "a\nb", "a|b", "a&b", "a>b"])
@pytest.mark.parametrize("name", ["package", "paths"])
def test_inputs_cannot_be_commands(name: str, value: str) -> None:
    assert re.search(INPUTS[name]["regex"].replace("$", r"\Z"), value) is None


@pytest.mark.parametrize(
    "value",
    [
        ".",
        "src",
        "src/arm src/lift",
        "haros-ci",
        "haros-ci==0.1.0",
        "git+https://example.org/a/b@v1",
        "haros-ci[linters]",
    ],
)
def test_usual_inputs(value: str) -> None:
    assert any(re.search(INPUTS[name]["regex"], value) for name in ("package", "paths"))


def test_a_merge_request_shows_what_is_new(tmp_path: Path) -> None:
    repository = write(
        tmp_path / "lift", {"package.xml": MANIFEST, "lift/doors.py": BAD, "lift/b.py": GOOD, **DEFAULT_TOOLS}
    )
    base = commit(repository)
    write(repository, {"lift/gates.py": BAD})
    commit(repository)
    environment = {**os.environ, "CI_MERGE_REQUEST_DIFF_BASE_SHA": base, "HAROS_CI_CACHE": str(tmp_path / "cache")}
    done = subprocess.run(
        ["bash", "-euo", "pipefail", "-c", script(tmp_path)],
        cwd=repository,
        env=environment,
        capture_output=True,
        text=True,
    )
    assert done.returncode == 1, done.stderr
    assert "lift/gates.py:4" in done.stdout and "lift/doors.py" not in done.stdout
    for name in JOB["artifacts"]["reports"].values():
        assert (repository / name).stat().st_size > 0
    environment["CI_MERGE_REQUEST_DIFF_BASE_SHA"] = ""
    done = subprocess.run(
        ["bash", "-c", script(tmp_path, **{"fail-on": "error"})],
        cwd=repository,
        env=environment,
        capture_output=True,
        text=True,
    )
    assert done.returncode == 0, done.stderr
    assert "lift/doors.py:4" in done.stdout, "without a base all is shown"


def test_the_image_has_what_it_needs() -> None:
    """What is copied into the image is what pyproject.toml names."""
    kept = [
        line[1:] for line in (ROOT / ".dockerignore").read_text(encoding="utf-8").splitlines() if line.startswith("!")
    ]
    project = (ROOT / "pyproject.toml").read_text(encoding="utf-8")
    for needed in ("haros_ci", "checks", "README.md", "LICENSE", "pyproject.toml", "action/constraints.txt"):
        assert needed in kept and (ROOT / needed).exists()
        assert needed.startswith("action/") or needed == "pyproject.toml" or needed in project
    assert not any(fnmatch.fnmatch(".git", pattern) for pattern in kept)
    assert re.search(r"^USER \d+$", DOCKERFILE, re.M), "not root"
    assert "--constraint /source/action/constraints.txt" in DOCKERFILE
