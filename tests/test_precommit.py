# SPDX-License-Identifier: Apache-2.0
"""The hooks, installed and run by the real pre-commit on real commits."""

from __future__ import annotations

import os
import re
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
FAULTY_CPP = "int half(int all)\n{\n  int parts = 2;\n  parts -= 2;\n  return all / parts;\n}\n"
HEADER = "// SPDX-License-Identifier: Apache-2.0\n"

NODE = """\
#include <rclcpp/rclcpp.hpp>
#include <std_msgs/msg/int32.hpp>
int main(int argc, char ** argv)
{
  rclcpp::init(argc, argv);
  auto node = std::make_shared<rclcpp::Node>("NAME");
  auto end = node->create_END<std_msgs::msg::Int32>("chatter", 10, &take);
  rclcpp::spin(node);
}
"""
SYSTEM = {
    "demo/package.xml": '<package format="3"><name>demo</name><version>1.0.0</version><description>Talks.</description>'
    '<maintainer email="arm@example.org">Arm</maintainer><license>Apache-2.0</license><depend>rclcpp</depend></package>\n',
    "demo/CMakeLists.txt": "project(demo)\nadd_executable(demo_talker src/talker.cpp)\n"
    "add_executable(demo_listener src/listener.cpp)\n",
    "demo/src/talker.cpp": NODE.replace("NAME", "talker").replace("END", "publisher").replace(", &take", ""),
    "demo/src/listener.cpp": NODE.replace("NAME", "listener").replace("END", "subscription"),
    "demo/launch/all.launch.xml": '<launch>\n  <node pkg="demo" exec="demo_talker"/>\n'
    '  <node pkg="demo" exec="demo_listener"/>\n</launch>\n',
}


@dataclass(frozen=True)
class Checkout:
    """A user's repository with hooks installed."""

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
def checkout(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Callable[..., Checkout]]:
    """Makes users' repositories with the hooks of those ids; they share the hook's environment, which pre-commit builds once (half a minute)."""
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
        "PIP_COMPILE": "0",  # most of the modules are never imported
        "VIRTUALENV_SETUPTOOLS": "bundle",  # is there to build with
        "PIP_NO_BUILD_ISOLATION": "0",  # as in: no
    }
    hook = Checkout(installing.copy_of_the_checkout(home / "haros-ci"), environment)
    hook.run("git", "init", "--quiet", "--initial-branch=main")
    hook.commit({})
    revision = hook.run("git", "rev-parse", "HEAD").stdout.strip()

    def make(*ids: str) -> Checkout:
        user = Checkout(tmp_path_factory.mktemp("user"), environment)
        user.run("git", "init", "--quiet", "--initial-branch=main")
        config = {
            "repos": [{"repo": str(hook.path), "rev": revision, "hooks": [{"id": id} for id in ids or ("haros-ci",)]}]
        }
        (user.path / ".pre-commit-config.yaml").write_text(yaml.safe_dump(config), encoding="utf-8")
        done = user.run(sys.executable, "-m", "pre_commit", "install", "--install-hooks")
        assert done.returncode == 0, done.stdout + done.stderr
        return user

    yield make


def test_a_commit_with_a_defect_fails_and_without_it_passes(checkout: Callable[..., Checkout]) -> None:
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


def test_known_findings_do_not_stop_a_commit(checkout: Callable[..., Checkout]) -> None:
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


def test_the_system_is_checked_as_a_whole(checkout: Callable[..., Checkout]) -> None:
    user = checkout("haros-ci-arch")
    passed, said = user.commit(SYSTEM)
    assert passed, said
    passed, said = user.commit({"demo/src/talker.cpp": SYSTEM["demo/src/talker.cpp"].replace("Int32", "String")})
    assert not passed
    assert "demo/src/listener.cpp" in said and "topic-type-mismatch" in said, "it stands in a file that is not changed"
    retyped = {name: SYSTEM[name].replace("Int32", "String") for name in SYSTEM}
    passed, said = user.commit(retyped)
    assert passed, said
    passed, said = user.commit(
        {
            "demo/launch/all.launch.xml": SYSTEM["demo/launch/all.launch.xml"].replace(
                "<launch>", "<launch>\n  <!-- both -->"
            )
        }
    )
    assert passed, said
    passed, said = user.commit({"README.md": "Talks.\n"})
    assert passed and "no files to check" in said


def test_known_findings_of_the_system_do_not_stop_a_commit(checkout: Callable[..., Checkout]) -> None:
    user = checkout("haros-ci-arch")
    for name, text in {
        **SYSTEM,
        "demo/src/talker.cpp": SYSTEM["demo/src/talker.cpp"].replace("Int32", "String"),
    }.items():
        (user.path / name).parent.mkdir(parents=True, exist_ok=True)
        (user.path / name).write_text(text)
    [program] = (Path(user.environment["PRE_COMMIT_HOME"])).glob("repo*/py_env*/bin/haros-ci")
    done = user.run(str(program), "baseline", "create", "--profile", "architecture")
    assert done.returncode == 0, done.stdout + done.stderr
    passed, said = user.commit({})
    assert passed, said
    listener = SYSTEM["demo/src/listener.cpp"]
    passed, said = user.commit(
        {"demo/src/listener.cpp": "// Listens.\n" + listener.replace('("chatter", 10,', '(\n    "chatter", 5,')}
    )
    assert passed, said
    more = {
        f"demo/src/{name}.cpp": (user.path / f"demo/src/{name}.cpp").read_text().replace("  rclcpp::spin", line)
        for name, line in (
            ("talker", '  auto other = node->create_publisher<std_msgs::msg::String>("count", 10);\n  rclcpp::spin'),
            (
                "listener",
                '  auto other = node->create_subscription<std_msgs::msg::Int32>("count", 1, &take);\n  rclcpp::spin',
            ),
        )
    }
    passed, said = user.commit(more)
    assert not passed
    assert "/count" in said and said.count("topic-type-mismatch]") == 1


def test_no_linter_runs_for_the_system(checkout: Callable[..., Checkout]) -> None:
    passed, said = checkout("haros-ci-arch").commit(
        {**SYSTEM, "demo/scripts/joints.py": FAULTY, "demo/half.cpp": FAULTY_CPP}
    )
    assert passed, said


def test_files_that_it_does_not_know_start_nothing(checkout: Callable[..., Checkout]) -> None:
    passed, said = checkout().commit({"notes.txt": "def (\n", "logo.svg.b64": "AAAA\n"})
    assert passed, said
    assert "no files to check" in said


def test_a_hostile_file_name_is_a_name(checkout: Callable[..., Checkout]) -> None:
    user = checkout()
    passed, said = user.commit({"--output=json=pwned.py": CLEAN, "$(touch pwned).py": FAULTY})
    assert not passed
    assert "undefined-variable" in said
    assert not list(user.path.glob("pwned*"))


def test_the_documented_configuration_names_the_hook() -> None:
    hooks = yaml.safe_load((ROOT / ".pre-commit-hooks.yaml").read_text(encoding="utf-8"))
    [repo] = yaml.safe_load((ROOT / "docs/workflows/pre-commit-config.yaml").read_text(encoding="utf-8"))["repos"]
    assert [h["id"] for h in repo["hooks"]] == [hook["id"] for hook in hooks] == ["haros-ci", "haros-ci-arch"]
    assert all(hook["require_serial"] is True for hook in hooks), "the command uses all cores itself"
    for args in (hooks[0]["args"], *(h["args"] for h in repo["hooks"] if "args" in h)):
        assert args[-1] == "--", "a file named like an option is a file"
    assert hooks[1]["pass_filenames"] is False, "a system is all its files"


PARTS_OF_A_SYSTEM = (
    "src/a.cpp", "src/a.cc", "include/a.hpp", "include/a.h", "scripts/a.py", "scripts/talker", "launch/a.launch", "a.test",
    "launch/a.launch.py", "launch/a.launch.xml", "launch/a.launch.yaml", "config/a.yaml", "config/a.yml", "package.xml",
    "CMakeLists.txt", "a/CMakeLists.txt", "cmake/a.cmake", "urdf/a.xacro", "setup.cfg", "msg/A.msg", "nodelets.xml", "talker",
)  # fmt: skip
NO_PARTS = (
    "README.md", "docs/a.rst", "a.txt", "requirements.txt", "a.png", "mesh/a.stl", "a.dae", "maps/a.pgm", "a.js", "a.cpp.orig",
    ".gitignore", "a.json", "CMakeLists.txt.user", "a.pyc", "a.xmlx", "dir.py/a.md", "a.sh",
)  # fmt: skip


@pytest.mark.parametrize("name", PARTS_OF_A_SYSTEM)
def test_what_the_system_is_made_of_starts_the_hook(name: str) -> None:
    assert re.search(files_of("haros-ci-arch"), name)


@pytest.mark.parametrize("name", NO_PARTS)
def test_what_is_no_part_of_the_system_does_not(name: str) -> None:
    assert not re.search(files_of("haros-ci-arch"), name)


def files_of(id: str) -> str:
    """The pattern of the hook, as pre-commit searches for it in paths."""
    hooks = yaml.safe_load((ROOT / ".pre-commit-hooks.yaml").read_text(encoding="utf-8"))
    [pattern] = [hook["files"] for hook in hooks if hook["id"] == id]
    assert isinstance(pattern, str)
    return pattern
