# SPDX-License-Identifier: Apache-2.0
"""Two revisions of a small workspace as literals, and what the change between them does, a line each."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

from haros_ci.analysis.architecture import varied
from haros_ci.analysis.comparison import revision_of
from haros_ci.changes.revision import Revision, changes_of
from haros_ci.checking.page import filled
from haros_ci.config.settings import Settings
from haros_ci.model.changes import Change, Changes
from haros_ci.workspace.cache import MemoryCache
from haros_ci.workspace.discover import discover

Files = Mapping[str, str]


def revision(root: Path, files: Files) -> Revision:
    """*files*, with what every package has, read below *root*."""
    for path, text in filled(files).items():
        place = root / path
        place.parent.mkdir(parents=True, exist_ok=True)
        place.write_text(text, encoding="utf-8")
    workspace = discover(root, (".",))
    return revision_of(workspace, varied(workspace, Settings(root=root), MemoryCache(), alternatives=False))


def changes(tmp_path: Path, base: Files, head: Files, renames: Mapping[str, str] | None = None) -> Changes:
    """What is otherwise at *head*."""
    return changes_of(revision(tmp_path / "base", base), revision(tmp_path / "head", head), renames or {})


def said(found: Changes) -> list[str]:
    """``parameter changed default max_speed: 1.0 -> 2.0``."""
    return [line(change) for change in found.changes]


def line(change: Change) -> str:
    words = [change.what, change.action, change.aspect, ", ".join(change.names)]
    return f"{' '.join(word for word in words if word)}: {change.before} -> {change.after}"


def python_node(name: str, *lines: str) -> str:
    """A node of rclpy with *lines* in its body."""
    body = "\n".join(lines)
    return (
        "import rclpy\nfrom rclpy.qos import QoSProfile, qos_profile_sensor_data\nfrom sensor_msgs.msg import Image, LaserScan\n"
        "from std_msgs.msg import Bool, String\nfrom std_srvs.srv import Empty, SetBool\n\n"
        f'rclpy.init()\nnode = rclpy.create_node("{name}")\n{body}\nrclpy.spin(node)\n'
    )


def launch(*nodes: str) -> str:
    """A launch file of ROS 2 with *nodes*, each the inside of a tag."""
    return "<launch>\n" + "\n".join(f"  <node {node}/>" for node in nodes) + "\n</launch>\n"
