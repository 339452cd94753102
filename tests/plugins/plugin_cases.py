# SPDX-License-Identifier: Apache-2.0
"""Runs the command with a directory of plug-ins on its path, as an installation would have them."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

from commandline import write
from forked import server

ROOT = Path(__file__).resolve().parents[2]
EXAMPLE = ROOT / "examples" / "haros_ci_example_plugin"

#: A workspace whose package has a node: it publishes /batteryState, and /red/beacon through a wrapper.
WORKSPACE = {
    "package.xml": '<package format="3">\n  <name>demo</name><version>1.0.0</version><description>A demo.</description>\n'
    '  <maintainer email="a@example.org">A</maintainer><license>MIT</license>\n'
    "  <buildtool_depend>ament_cmake</buildtool_depend><depend>rclpy</depend><depend>std_msgs</depend>\n"
    "  <export><build_type>ament_cmake</build_type></export>\n</package>\n",
    "CMakeLists.txt": "cmake_minimum_required(VERSION 3.8)\nproject(demo)\nfind_package(ament_cmake REQUIRED)\n"
    "install(PROGRAMS lamp.py DESTINATION lib/demo)\nament_package()\n",
    "lamp.py": "#!/usr/bin/env python3\nimport acme_ros\nimport rclpy\nfrom rclpy.node import Node\nfrom std_msgs.msg import String\n\n"
    'rclpy.init()  # TODO later\nnode = Node("lamp")\npub = node.create_publisher(String, "batteryState", 10)\nacme_ros.beacon(node, "red")\n',
}

#: A page as a check has it; nobody runs these examples.
PAGE = "# {id}\n\n## What it finds\n\nA.\n\n## Why it matters\n\nB.\n\n## Bad\n\n## Good\n\n## Limits\n\nC.\n"
CHECK = (
    "from haros_ci.api import Check, Finding, Level, Location\n"
    "def look(project):\n    {body}\n"
    "CHECKS = (Check(id='{id}', summary='S.', level=Level.WARNING, project=look),)\n"
    "PAGES = {{'{id}': {page!r}}}\n"
)


def check_module(id: str, body: str) -> str:
    """A plug-in with one check of the whole workspace."""
    return CHECK.format(id=id, body=body, page=PAGE.format(id=id))


#: In the place of the command: what is on PYTHONPATH comes before what is installed.
ON_PATH = "import sys\nsys.path.insert(0, {path!r})\nfrom haros_ci.cli import main\nsys.exit(main())\n"


def run(*arguments: str, cwd: Path, path: Path | None = None, **environment: str) -> subprocess.CompletedProcess[str]:
    """``haros-ci ARGUMENTS`` in *cwd*, with *path* before what is installed, forked from the process that has all modules loaded."""
    kept = {
        k: v
        for k, v in os.environ.items()
        if not k.startswith(("GITHUB_", "HAROS_", "PYTHON")) and k not in ("CI", "COLUMNS")
    }
    env = {**kept, "XDG_CACHE_HOME": str(cwd.parent / "xdg"), **environment}
    driver = None
    if path is not None:
        driver = write(cwd.parent, {"on_path.py": ON_PATH.format(path=str(path))}) / "on_path.py"
    done = server().run(list(arguments), cwd=cwd, env=env, timeout=300, driver=driver)
    return subprocess.CompletedProcess(done.args, done.returncode, done.stdout.decode(), done.stderr.decode())


def started(
    *arguments: str, cwd: Path, path: Path | None = None, **environment: str
) -> subprocess.CompletedProcess[str]:
    """``python -m haros_ci ARGUMENTS`` in *cwd*, with *path* on PYTHONPATH: for what is loaded and from where."""
    kept = {
        k: v
        for k, v in os.environ.items()
        if not k.startswith(("GITHUB_", "HAROS_", "PYTHON")) and k not in ("CI", "COLUMNS")
    }
    if path is not None:
        kept["PYTHONPATH"] = str(path)
    return subprocess.run(
        [sys.executable, "-m", "haros_ci", *arguments],
        cwd=cwd,
        env={**kept, "XDG_CACHE_HOME": str(cwd.parent / "xdg"), **environment},
        capture_output=True,
        text=True,
        timeout=300,
    )


def workspace(root: Path) -> Path:
    write(root, WORKSPACE)
    (root / "lamp.py").chmod(0o755)
    return root
