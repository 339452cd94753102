# SPDX-License-Identifier: Apache-2.0
"""What the workspace names, in patches, policies and comparisons; and trees of git that no disk holds."""

from __future__ import annotations

import hashlib
import os
import subprocess
import zlib
from xml.etree import ElementTree

import pytest
from hostile_kit import OBEYED, RAW, TRACE, Trap, plain

MANIFEST = """<package format="3"><name>bad</name><version>1.0.0</version><description>d</description>
<maintainer email="a@b.org">A</maintainer><license>MIT</license>
<!-- {} -->
<buildtool_depend>ament_cmake</buildtool_depend>
<export><build_type>ament_cmake</build_type></export></package>
"""
CMAKE = "project(bad)\nfind_package(ament_cmake REQUIRED)\nfind_package(std_msgs REQUIRED)\nadd_executable(t t.cpp)\n"
CMAKE += "ament_target_dependencies(t std_msgs rclcpp)\ninstall(TARGETS t DESTINATION lib/bad)\nament_package()\n"
EVIL = r"a\x01\x1b[31m\u202e##[error]]]></topic><evil/>\n::error::y|`@team <b>"
LAUNCH = f'''from launch import LaunchDescription
from launch_ros.actions import Node
def generate_launch_description():
    return LaunchDescription([
        Node(package="bad", executable="t", name="{EVIL}", remappings=[("chat", "/{EVIL}")]),
        Node(package="bad", executable="t", name="ok", remappings=[("chat", "/*")]),
    ])
'''
CODE = """#include <rclcpp/rclcpp.hpp>
int main() {
  rclcpp::init(0, 0);
  auto n = std::make_shared<rclcpp::Node>("a");
  n->create_publisher<std_msgs::msg::String>("chat", 1);
  n->create_publisher<std_msgs::msg::String>("plain", 1);
  rclcpp::spin(n);
}
"""
PATCH = ("check", ".", "--profile=architecture", "--diff")


def laid(trap: Trap, comment: str = "c", folder: str = "bad") -> None:
    trap.write(f"{folder}/package.xml", MANIFEST.format(comment))
    trap.write(f"{folder}/CMakeLists.txt", CMAKE)
    trap.write(f"{folder}/t.cpp", CODE)


def test_a_patch_in_a_log_of_a_runner_commands_nothing(trap: Trap) -> None:
    laid(trap, "\n ::error::x\n\t::add-mask::y\n##[error]z \u202e")
    done = trap.start(*PATCH, environment={"GITHUB_ACTIONS": "true"})
    text = done.stdout.decode()
    assert "+<depend>std_msgs</depend>" in text
    assert not OBEYED.search(text) and not RAW.search(text)


@pytest.mark.parametrize(
    "command",
    [
        ("metrics",),
        ("metrics", "--format=csv"),
        ("model", "--coverage"),
        ("model",),
        ("model", "--format=readme"),
        ("query", "for n in <nodes> where True return n"),
        ("diff", "HEAD~1"),
        ("diff", "HEAD~1", "--format=markdown"),
        ("check", ".", "--output=text", "--statistics"),
        ("baseline", "show"),
    ],
    ids=" ".join,
)
def test_no_line_begins_as_a_command_to_a_runner(trap: Trap, command: tuple[str, ...]) -> None:
    laid(trap, folder="::stop-commands::x")
    trap.write("::error::x/a.launch.py", LAUNCH.replace(EVIL, "::error::y"))
    trap.write("::error::x/b.py", "def f():\n    return undefined_name\n")
    trap.commit()
    trap.write("::stop-commands::x/t.cpp", CODE.replace('"plain"', '"other"'))
    trap.commit()
    if command[0] == "baseline":
        trap.start("baseline", "create", ".")
    done = trap.start(*command, environment={"GITHUB_ACTIONS": "true"})
    text = (done.stdout + done.stderr).decode()
    assert any(word in text for word in ("::stop-commands::x", "::error::x", "other", "bad")), text
    assert not OBEYED.search(text), text


@pytest.mark.parametrize("folder", ["a b", 'a"b', "a\\b", "\u00e9", "a\tb", "-x", "a\u202eb", "'", " a", "a "])
def test_a_patch_is_of_the_file_that_it_names(trap: Trap, folder: str) -> None:
    laid(trap, folder=folder)
    trap.write("a/package.xml", "<other/>\n")
    done = trap.start(*PATCH)
    subprocess.run(["git", "apply", "-"], cwd=trap.root, input=done.stdout, check=True, env=plain({}))
    assert "<depend>std_msgs</depend>" in (trap.root / folder / "package.xml").read_text()


@pytest.mark.parametrize("end", ["\u2028", "\x85", "\r"])
def test_nothing_is_mended_where_lines_are_not_counted_alike(trap: Trap, end: str) -> None:
    laid(trap, f"a{end}b{end}")
    before = (trap.root / "bad/package.xml").read_bytes()
    trap.start("check", ".", "--profile=architecture", "--fix")
    assert (trap.root / "bad/package.xml").read_bytes() == before


def test_what_links_lead_to_is_not_mended(trap: Trap) -> None:
    laid(trap)
    victim = trap.outside / "package.xml"
    (trap.root / "bad/package.xml").rename(victim)
    (trap.root / "bad/package.xml").symlink_to(victim)
    before = victim.read_bytes()
    trap.start("check", ".", "--profile=architecture", "--fix")
    assert victim.read_bytes() == before


def test_a_policy_allows_no_pattern_and_stays_xml(trap: Trap) -> None:
    laid(trap)
    trap.write("bad/launch/l.launch.py", LAUNCH)
    done = trap.start("policy")
    text, told = done.stdout.decode(), done.stderr.decode()
    names = {element.text for element in ElementTree.fromstring(text).iter("topic")}
    assert "plain" in names and not any("*" in (name or "") for name in names)
    assert not RAW.search(text) and not OBEYED.search(text)
    assert "(/*)" in told and not RAW.search(told) and not OBEYED.search(told)


@pytest.mark.parametrize("format", ["text", "markdown", "json"])
def test_a_comparison_shows_names_as_names(trap: Trap, format: str) -> None:
    laid(trap)
    trap.commit()
    trap.write("bad/launch/l.launch.py", LAUNCH)
    trap.commit()
    text = trap.start("diff", "HEAD~1", "HEAD", "--format", format).stdout.decode()
    assert "l.launch.py" in text
    assert not RAW.search(text) and not OBEYED.search(text)
    assert format != "markdown" or ("<evil" not in text and "@team" not in text.replace("&#64;team", ""))


def tree(trap: Trap, *entries: tuple[bytes, bytes, str]) -> str:
    """A tree object, whatever is in it; written as git writes it, since a process for each of thousands takes long."""
    data = b"".join(mode + b" " + name + b"\0" + bytes.fromhex(object) for mode, name, object in entries)
    stored = b"tree %d\0" % len(data) + data
    made = hashlib.sha1(stored).hexdigest()
    place = trap.root / ".git" / "objects" / made[:2] / made[2:]
    place.parent.mkdir(exist_ok=True)
    place.write_bytes(zlib.compress(stored, 1))
    return made


def compared(trap: Trap, top: str) -> tuple[int, str]:
    commit = trap.git("commit-tree", top, "-p", "HEAD", "-m", "odd")
    done = trap.start("diff", "HEAD", commit)
    said = done.stderr.decode()
    assert not TRACE.search(said) and not RAW.search(said + done.stdout.decode())
    return done.returncode, said


def test_a_tree_deeper_than_a_disk_takes(trap: Trap) -> None:
    laid(trap)
    trap.commit()
    deep = trap.git("rev-parse", "HEAD:bad")
    for _ in range(3_000):
        deep = tree(trap, (b"40000", b"d", deep))
    assert compared(trap, deep) == (0, "")


def test_a_tree_of_endless_files(trap: Trap) -> None:
    laid(trap)
    trap.commit()
    wide = trap.git("rev-parse", "HEAD:bad")
    for _ in range(8):
        wide = tree(trap, *((b"40000", b"d%d" % number, wide) for number in range(10)))
    code, said = compared(trap, wide)
    assert code == 2 and "more than" in said


def test_entries_that_are_no_files_of_ours(trap: Trap) -> None:
    laid(trap)
    trap.commit()
    blob, head = trap.git("rev-parse", "HEAD:bad/t.cpp"), trap.git("rev-parse", "HEAD")
    odd = [(b"100644", b"a\nb.cpp"), (b"120000", b"l.cpp"), (b"100644", b"\xff.cpp"), (b"100644", b".git")]
    odd += [(b"100644", b"\x1b[31m.launch"), (b"100666", b"m.cpp"), (b"0", b"n.cpp"), (b"100644", b"x" * 5_000)]
    assert compared(trap, tree(trap, *((*each, blob) for each in odd), (b"160000", b"sub", head))) == (0, "")
    assert not os.listdir(trap.sentinels)


@pytest.mark.parametrize("output", ["sarif=out.sarif", "json=dir/x.json", "csv=new.csv", "haros-json=dir"])
def test_no_link_of_the_workspace_leads_an_output_out_of_it(trap: Trap, output: str) -> None:
    (trap.root / "out.sarif").symlink_to(trap.outside / "victim.json")
    (trap.root / "new.csv").symlink_to(trap.outside / "new.csv")
    (trap.root / "dir").symlink_to(trap.outside)
    trap.use_cheap_control()
    before = {path.name: path.read_bytes() for path in trap.outside.iterdir()}
    done = trap.start("check", f"--output={output}")
    assert done.returncode == 2
    assert b"a symbolic link leads out of the current directory" in done.stderr
    assert {path.name: path.read_bytes() for path in trap.outside.iterdir()} == before


def test_links_inside_and_devices_take_an_output(trap: Trap) -> None:
    trap.write("real/.keep", "")
    (trap.root / "dir").symlink_to("real")
    trap.use_cheap_control()
    done = trap.start("check", "--output=json=dir/x.json", "--output=csv=/dev/null")
    assert done.returncode == 1, done.stderr
    assert (trap.root / "real" / "x.json").is_file()
