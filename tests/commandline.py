# SPDX-License-Identifier: Apache-2.0
"""Runs the real command, as a process of its own, in a workspace made of literals."""

from __future__ import annotations

import atexit
import os
import shutil
import subprocess
import tempfile
from collections.abc import Mapping
from pathlib import Path

from forked import server
from repositories import begin

GIT = {
    "GIT_CONFIG_GLOBAL": os.devnull,
    "GIT_CONFIG_NOSYSTEM": "1",
    "GIT_AUTHOR_NAME": "A",
    "GIT_AUTHOR_EMAIL": "a@example.org",
    "GIT_COMMITTER_NAME": "A",
    "GIT_COMMITTER_EMAIL": "a@example.org",
    "GIT_AUTHOR_DATE": "2024-01-01T00:00:00Z",
    "GIT_COMMITTER_DATE": "2024-01-01T00:00:00Z",
}

#: A package of ROS 1 that installs the script talker.py.
TALKER_PACKAGE = {
    "src/demo/package.xml": "<package><name>demo</name><version>1.0.0</version><description>d</description>"
    "<maintainer email='a@b.cd'>a</maintainer><license>x</license><buildtool_depend>catkin</buildtool_depend>"
    "<run_depend>rospy</run_depend><run_depend>std_msgs</run_depend></package>",
    "src/demo/CMakeLists.txt": "cmake_minimum_required(VERSION 3.5)\nproject(demo)\nfind_package(catkin REQUIRED)\ncatkin_package()\n"
    "catkin_install_python(PROGRAMS talker.py DESTINATION ${CATKIN_PACKAGE_BIN_DESTINATION})\n",
}


def haros(
    *arguments: str, cwd: Path, driver: Path | None = None, **environment: str
) -> subprocess.CompletedProcess[str]:
    """``haros-ci ARGUMENTS`` in *cwd*, or a *driver* that calls it; CI variables of the machine the tests run on are kept away from it."""
    kept = {
        k: v for k, v in os.environ.items() if not k.startswith(("GITHUB_", "HAROS_")) and k not in ("CI", "COLUMNS")
    }
    env = {**kept, "XDG_CACHE_HOME": cache_home(), **environment}
    done = server().run(list(arguments), cwd=cwd, env=env, timeout=300, driver=driver)
    return subprocess.CompletedProcess(done.args, done.returncode, done.stdout.decode(), done.stderr.decode())


def cache_home() -> str:
    """A cache for all tests of this run, and of the processes of it, which inherit its name: the same files are in many tests."""
    if "TESTS_CACHE_HOME" not in os.environ:
        os.environ["TESTS_CACHE_HOME"] = tempfile.mkdtemp(prefix="haros-ci-tests-")
        atexit.register(shutil.rmtree, os.environ["TESTS_CACHE_HOME"], ignore_errors=True)
    return os.environ["TESTS_CACHE_HOME"]


def write(root: Path, files: Mapping[str, str | bytes]) -> Path:
    """The files below *root*, made or overwritten."""
    for name, content in files.items():
        path = root / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_bytes(content if isinstance(content, bytes) else content.encode("utf-8"))
    return root


def git(root: Path, *arguments: str) -> str:
    done = subprocess.run(
        ["git", *arguments], cwd=root, env={**os.environ, **GIT}, capture_output=True, text=True, check=True, timeout=60
    )
    return done.stdout


def commit(root: Path, message: str = "change") -> str:
    """All that is there as one commit; its name."""
    begin(root)
    git(root, "add", "-A")
    git(root, "commit", "-q", "--allow-empty", "-m", message)
    return git(root, "rev-parse", "HEAD").strip()
