# SPDX-License-Identifier: Apache-2.0
"""Which ROS 2 launch files start a workspace."""

from __future__ import annotations

from launching_kit import loader, node, workspace

from haros_ci.launch.facts.memory import LEAST, LaunchMemory, Memo
from haros_ci.launch.python.interpret import interpret
from haros_ci.launch.ros2.entry import entry_files
from haros_ci.launch.ros2.places import Places
from haros_ci.model.launch_actions import Description

FULL = f"<launch>{node()}</launch>"


def include(path: str, condition: str = "") -> str:
    return f'<launch><arg name="t"/><include file="$(find-pkg-share bot)/{path}" {condition}/></launch>'


def entries(files: dict[str, str], memo: Memo | None = None) -> tuple[str, ...]:
    plain = loader(files)

    def load(path: str) -> Description | None:
        return interpret(path, files[path], lambda _: None, {}) if path.endswith(".py") else plain(path)

    places = Places(workspace(files))
    return entry_files(places.workspace, load, places, lambda path: not path.endswith(".launch"), memo)


def test_files_that_no_other_includes() -> None:
    files = {
        "bot/launch/main.launch.xml": include("launch/part.launch.xml"),
        "bot/launch/part.launch.xml": FULL,
        "bot/launch/alone_launch.yaml": "launch:\n- node: {pkg: p, exec: e}\n",
        "bot/launch/plain.xml": FULL,
        "bot/launch/empty.xml": "<launch/>",
        "bot/config/plain.xml": FULL,
        "bot/launch/self.launch.xml": include("launch/self.launch.xml"),
    }
    memo: Memo = {}
    assert entries(files, memo) == (
        "bot/launch/alone_launch.yaml",
        "bot/launch/main.launch.xml",
        "bot/launch/plain.xml",
        "bot/launch/self.launch.xml",
    )
    assert len(memo) == 5


def test_conditions_of_includes() -> None:
    files = {"bot/launch/a.launch.xml": FULL, "bot/launch/b.launch.xml": FULL, "bot/launch/c.launch.xml": FULL}
    files["bot/launch/main.launch.xml"] = include("launch/a.launch.xml", 'if="false"')
    files["bot/launch/more.launch.xml"] = include("launch/b.launch.xml", 'if="$(var t)"')
    assert entries(files) == (
        "bot/launch/a.launch.xml",
        "bot/launch/c.launch.xml",
        "bot/launch/main.launch.xml",
        "bot/launch/more.launch.xml",
    )


def test_what_is_for_tests_or_ros_1_is_left_out() -> None:
    files = {
        "bot/test/a.launch.xml": FULL,
        "bot/launch/old.launch": FULL,
        "bot/launch/old.launch.xml": '<launch><node pkg="p" type="t" name="n"/></launch>',
    }
    assert entries(files) == ()


def chain(times: int, length: int) -> dict[str, str]:
    """Launch files that include the next one so many *times*."""
    body = '<include file="$(dirname)/c{}.launch.xml"/>'.format
    files = {f"bot/launch/c{n}.launch.xml": f"<launch>{body(n + 1) * times}</launch>" for n in range(length)}
    return {**files, f"bot/launch/c{length}.launch.xml": FULL}


def test_files_that_take_all_steps_share_them() -> None:
    memory = LaunchMemory(left=30_000)
    assert entries(chain(3, 12), memory) == ("bot/launch/c0.launch.xml",)
    cut = [
        key[0]
        for key, system in memory.items()
        if any("more than can be evaluated" in p.message for p in system.problems)
    ]
    assert ("bot/launch/c0.launch.xml",) in cut and ("bot/launch/c12.launch.xml",) not in cut
    assert -13 * LEAST < memory.left < LEAST


def test_files_that_take_few_steps_leave_the_others() -> None:
    memory = LaunchMemory()
    before = memory.left
    assert entries(chain(1, 12), memory) == ("bot/launch/c0.launch.xml",)
    assert 0 < before - memory.left < 13 * 2_000
    assert not any(system.problems for system in memory.values())


FUNCTIONS = "def arguments():\n    return []\n"
OTHER = "from launch import LaunchDescription\nfrom bot.{} import {}\ndef generate_launch_description():\n    return LaunchDescription([])\n"


def test_a_module_that_launch_files_import_is_no_launch_file() -> None:
    files = {
        "bot/bot/common_launch.py": FUNCTIONS,
        "bot/launch/main.launch.py": OTHER.format("common_launch", "arguments"),
        "bot/bot/shared_launch.py": FUNCTIONS,
        "bot/launch/more_launch.py": "import bot.shared_launch as shared\n" + OTHER.format("x", "y"),
    }
    assert entries(files) == ("bot/launch/main.launch.py", "bot/launch/more_launch.py")


def test_a_launch_file_without_a_description_is_one_where_nobody_imports_it() -> None:
    files = {
        "bot/launch/alone_launch.py": FUNCTIONS,
        "bot/launch/misspelt.launch.py": FUNCTIONS,
        "bot/launch/named_launch.py": FUNCTIONS,
        "bot/launch/full_launch.py": OTHER.format("x", "y"),
        "bot/launch/main.launch.py": "# from bot.alone_launch import x\nnamed_launch = 1  # import\n"
        + OTHER.format("full_launch", "arguments"),
    }
    assert entries(files) == tuple(sorted(files))
