# SPDX-License-Identifier: Apache-2.0
"""The hook, installed and run by the real pre-commit on real commits."""

from __future__ import annotations

import os
import subprocess
import sys
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from pathlib import Path

import installing
import pytest
import yaml

ROOT = Path(__file__).resolve().parent.parent

CLEAN = '"""Joints."""\n\n\ndef home():\n    """Where the arm rests."""\n    return [0.0] * 6\n'
FAULTY = CLEAN.replace("0.0", "rest_angle")
CLEAN_CPP = "int half(int all)\n{\n  return all / 2;\n}\n"
FAULTY_CPP = "int half(int all)\n{\n  const int parts = 0;\n  return all / parts;\n}\n"
HEADER = "// SPDX-License-Identifier: Apache-2.0\n"


@dataclass(frozen=True)
class Checkout:
    """A user's repository with the hook installed."""

    path: Path
    environment: dict[str, str]

    def run(self, *command: str) -> subprocess.CompletedProcess[str]:
        return subprocess.run(
            command, cwd=self.path, env=self.environment, stdin=subprocess.DEVNULL, capture_output=True, text=True
        )

    def commit(self, files: dict[str, str]) -> tuple[bool, str]:
        """Whether a commit of *files* went through, and what was said."""
        for name, text in files.items():
            (self.path / name).parent.mkdir(parents=True, exist_ok=True)
            (self.path / name).write_text(text, encoding="utf-8")
        self.run("git", "add", "--all")
        before = self.run("git", "rev-parse", "--verify", "--quiet", "HEAD").stdout
        done = self.run("git", "commit", "--message", "change")
        passed = self.run("git", "rev-parse", "--verify", "--quiet", "HEAD").stdout != before
        assert passed == (done.returncode == 0)
        return passed, done.stdout + done.stderr


@pytest.fixture(scope="module")
def checkout(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Callable[[], Checkout]]:
    """Makes users' repositories; they share the hook's environment, which pre-commit builds once (half a minute)."""
    installing.needs_package_index()
    home = tmp_path_factory.mktemp("pre-commit")
    kept = {k: v for k, v in os.environ.items() if not k.startswith(("GIT_", "PRE_COMMIT", "HAROS_CI_"))}
    who = {f"GIT_{role}_{what}": "arm@example.org" for role in ("AUTHOR", "COMMITTER") for what in ("NAME", "EMAIL")}
    environment = {
        **kept,
        **who,
        "GIT_CONFIG_GLOBAL": os.devnull,
        "GIT_CONFIG_SYSTEM": os.devnull,
        "PRE_COMMIT_HOME": str(home / "environments"),
        "XDG_CACHE_HOME": str(home / "cache"),
    }
    hook = Checkout(installing.copy_of_the_checkout(home / "haros-ci"), environment)
    hook.run("git", "init", "--quiet", "--initial-branch=main")
    hook.commit({})
    revision = hook.run("git", "rev-parse", "HEAD").stdout.strip()

    def make() -> Checkout:
        user = Checkout(tmp_path_factory.mktemp("user"), environment)
        user.run("git", "init", "--quiet", "--initial-branch=main")
        config = {"repos": [{"repo": str(hook.path), "rev": revision, "hooks": [{"id": "haros-ci"}]}]}
        (user.path / ".pre-commit-config.yaml").write_text(yaml.safe_dump(config), encoding="utf-8")
        done = user.run(sys.executable, "-m", "pre_commit", "install", "--install-hooks")
        assert done.returncode == 0, done.stdout + done.stderr
        return user

    yield make


def test_a_commit_with_a_defect_fails_and_without_it_passes(checkout: Callable[[], Checkout]) -> None:
    user = checkout()
    passed, said = user.commit({"arm/joints.py": CLEAN, "arm/half.cpp": HEADER + CLEAN_CPP, "README.md": "An arm.\n"})
    assert passed, said
    passed, said = user.commit({"arm/joints.py": FAULTY})
    assert not passed
    assert "undefined-variable" in said
    passed, said = user.commit({"arm/joints.py": CLEAN, "arm/half.cpp": HEADER + FAULTY_CPP})
    assert not passed
    assert "zerodiv" in said
    passed, said = user.commit({"arm/half.cpp": HEADER + CLEAN_CPP.replace("all", "whole")})
    assert passed, said


def test_known_findings_do_not_stop_a_commit(checkout: Callable[[], Checkout]) -> None:
    user = checkout()
    (user.path / "arm").mkdir()
    (user.path / "arm/joints.py").write_text(FAULTY)
    [program] = (Path(user.environment["PRE_COMMIT_HOME"])).glob("repo*/py_env*/bin/haros-ci")
    done = user.run(str(program), "baseline", "create")
    assert done.returncode == 0, done.stdout + done.stderr
    passed, said = user.commit({})
    assert passed, said
    passed, said = user.commit({"arm/joints.py": "\n\n" + FAULTY + "\n\nREACH = MAX_REACH\n"})
    assert not passed
    assert "MAX_REACH" in said
    assert "rest_angle" not in said


def test_files_that_it_does_not_know_start_nothing(checkout: Callable[[], Checkout]) -> None:
    passed, said = checkout().commit({"notes.txt": "def (\n", "logo.svg.b64": "AAAA\n"})
    assert passed, said
    assert "no files to check" in said


def test_a_hostile_file_name_is_a_name(checkout: Callable[[], Checkout]) -> None:
    user = checkout()
    passed, said = user.commit({"--output=json=pwned.py": CLEAN, "$(touch pwned).py": FAULTY})
    assert not passed
    assert "undefined-variable" in said
    assert not list(user.path.glob("pwned*"))


def test_the_documented_configuration_names_the_hook() -> None:
    [hook] = yaml.safe_load((ROOT / ".pre-commit-hooks.yaml").read_text(encoding="utf-8"))
    [repo] = yaml.safe_load((ROOT / "docs/workflows/pre-commit-config.yaml").read_text(encoding="utf-8"))["repos"]
    assert [h["id"] for h in repo["hooks"]] == [hook["id"]]
    assert hook["require_serial"] is True, "the command uses all cores itself"
    for args in (hook["args"], *(h["args"] for h in repo["hooks"] if "args" in h)):
        assert args[-1] == "--", "a file named like an option is a file"
