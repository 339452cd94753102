# SPDX-License-Identifier: Apache-2.0
"""What to do about a section of a parameter file that matches no node: its name is not always what is wrong."""

from __future__ import annotations

from pathlib import Path

import pytest

from haros_ci.api.testing import said
from haros_ci.checking.page import Example
from haros_ci.registry import checks

MANIFEST = (
    '<package format="3"><name>demo</name><version>1.0.0</version><description>d</description><maintainer email="a@b.cd">m</maintainer>'
    "<license>Apache-2.0</license><buildtool_depend>ament_cmake</buildtool_depend><depend>rclpy</depend>"
    "<export><build_type>ament_cmake</build_type></export></package>\n"
)
CMAKE = (
    "cmake_minimum_required(VERSION 3.8)\nproject(demo)\nfind_package(ament_cmake REQUIRED)\n"
    "install(PROGRAMS driver.py DESTINATION lib/demo)\ninstall(DIRECTORY launch config DESTINATION share/demo)\nament_package()\n"
)
DRIVER = """\
import rclpy
from rclpy.node import Node


class Driver(Node):
    def __init__(self):
        super().__init__("driver")
        self.declare_parameter("max_speed", 1.0)
        self.declare_parameter("wheel.radius", 0.1)


def main():
    rclpy.init()
    rclpy.spin(Driver())


if __name__ == "__main__":
    main()
"""
RELAY = "#!/usr/bin/env python3\nprint('relay')\n"
LAUNCH = (
    '<launch><node pkg="demo" exec="driver.py" name="front_driver"><param from="$(find-pkg-share demo)/config/params.yaml"/>'
    "</node></launch>\n"
)
RENAMED = "is called otherwise, so it gets none of these parameters; write front_driver or /** here, or name the node "
NONE = "is called otherwise, and declares none of these parameters; start {} with this file, or take the file from /front_driver"


def message(section: str, folder: Path, more: dict[str, str] | None = None) -> str:
    check = next(check for check in checks() if check.id == "parameter-section-unmatched")
    files = {
        "package.xml": MANIFEST,
        "CMakeLists.txt": CMAKE,
        "driver.py": DRIVER,
        "config/params.yaml": section,
        "launch/all.launch.xml": LAUNCH,
        **(more or {}),
    }
    (result,) = said(check, Example("", True, files), folder)
    return result.message


def section(name: str, *keys: str) -> str:
    return f"{name}:\n  ros__parameters:\n" + "".join(f"    {key}: 0.5\n" for key in keys)


@pytest.mark.parametrize(
    ("text", "words"),
    [
        # the node has none of them
        (section("relay", "turbo"), NONE.format("relay")),
        (section("driver", "turbo", "steps"), NONE.format("driver")),
        (section("relay", "wheel:\n      width"), NONE.format("relay")),
        # it has one
        (section("relay", "turbo", "max_speed"), f"{RENAMED}relay"),
        (section("driver", "max_speed"), f"{RENAMED}driver"),
        (section("driver", "wheel:\n      radius"), f"{RENAMED}driver"),
        (section("driver", "use_sim_time"), f"{RENAMED}driver"),
        (section("driver", *(f"speed_{number}" for number in range(200))), f"{RENAMED}driver"),  # too many to look at
    ],
)
def test_a_node_that_has_none_of_the_parameters(text: str, words: str, tmp_path: Path) -> None:
    assert message(text, tmp_path).endswith(words)


VAGUE = DRIVER.replace('super().__init__("driver")', 'super().__init__("driver", allow_undeclared_parameters=True)')


@pytest.mark.parametrize(
    ("script", "is_named"),
    [
        ({"scripts/relay.py": RELAY}, True),
        ({"scripts/relay.py": "if __name__ == '__main__':\n    print()\n"}, True),
        ({"scripts/relay.py": "print()\n"}, False),  # a module
        ({"scripts/other.py": RELAY}, False),
        ({"scripts/relay.py": RELAY, "old/relay.py": RELAY}, False),
        ({"scripts/relay.sh": RELAY}, False),
    ],
)
def test_a_section_for_another_program(script: dict[str, str], is_named: bool, tmp_path: Path) -> None:
    words = "is another program than relay.py, and gets none of these parameters; start relay.py with this file, or take the file from /front_driver"
    told = message(section("relay", "turbo"), tmp_path, {"driver.py": VAGUE, **script})
    assert told.endswith(words if is_named else f"{RENAMED}relay")


TWO = (
    '<launch><node pkg="demo" exec="driver.py" name="{}">{}</node>'
    '<node pkg="demo" exec="relay.py" name="relay"><param from="$(find-pkg-share demo)/config/relay.yaml"/></node></launch>\n'
)
FROM = '<param from="$(find-pkg-share demo)/config/{}"/>'
RELAY_NODE = DRIVER.replace("Driver", "Relay").replace("driver", "relay")


def messages(tmp_path: Path, launch: str, **files: str) -> list[str]:
    check = next(check for check in checks() if check.id == "parameter-section-unmatched")
    everything = {
        "package.xml": MANIFEST,
        "CMakeLists.txt": CMAKE.replace("driver.py", "driver.py relay.py"),
        "driver.py": DRIVER,
        "relay.py": RELAY_NODE,
        "config/relay.yaml": section("relay", "max_speed"),
        "config/driver.yaml": section("driver", "max_speed"),
        "launch/all.launch.xml": launch,
        **{f"config/{name}.yaml": text for name, text in files.items()},
    }
    return [result.message for result in said(check, Example("", True, everything), tmp_path)]


@pytest.mark.parametrize(
    ("launch", "files", "words"),
    [
        (TWO.format("driver", FROM.format("relay.yaml")), {}, "/driver is given config/relay.yaml, which is for relay alone, and gets none of its parameters: config/driver.yaml has a section of that name; write that file"),
        (TWO.format("front", FROM.format("relay.yaml")), {"driver": section("/front", "max_speed")}, "config/driver.yaml has a section of that name"),
        (TWO.format("driver", FROM.format("relay.yaml")), {"driver": section("# c\n'driver'", "max_speed")}, "config/driver.yaml has a section of that name"),
    ],
)  # fmt: skip
def test_a_file_for_another_node(launch: str, files: dict[str, str], words: str, tmp_path: Path) -> None:
    (message,) = messages(tmp_path, launch, **files)
    assert words in message


@pytest.mark.parametrize(
    ("launch", "files"),
    [
        # it is given the right one
        (TWO.format("driver", FROM.format("driver.yaml")), {}),
        (TWO.format("driver", FROM.format("driver.yaml") + FROM.format("relay.yaml")), {}),
        (TWO.format("driver", ""), {}),
        # nothing beside it is for the node
        (TWO.format("driver", FROM.format("relay.yaml")), {"driver": section("other", "max_speed")}),
        (TWO.format("front", FROM.format("relay.yaml")), {}),
        (TWO.format("driver", FROM.format("relay.yaml")), {"driver": "driver:\n  max_speed: 0.5\n"}),
        (TWO.format("driver", FROM.format("relay.yaml")), {"driver": section("/**/driver", "max_speed")}),
        (TWO.format("driver", FROM.format("relay.yaml")), {"more": section("driver", "max_speed")}),  # or two are
        # the file is for it, too
        (TWO.format("driver", FROM.format("relay.yaml")), {"relay": section("relay", "max_speed") + section("driver", "max_speed")}),
        (TWO.format("driver", FROM.format("relay.yaml")), {"relay": section("/**", "max_speed")}),
        (TWO.format("driver", FROM.format("relay.yaml")), {"relay": section("'/*'", "max_speed")}),
        # the name of the node is not known
        (TWO.format("$(env WHO)", FROM.format("relay.yaml")), {}),
    ],
)  # fmt: skip
def test_a_file_that_is_for_the_node_or_may_be(launch: str, files: dict[str, str], tmp_path: Path) -> None:
    assert messages(tmp_path, launch, **files) == []


def test_another_launch_file_gives_it_the_right_one(tmp_path: Path) -> None:
    other = '<launch><node pkg="demo" exec="driver.py" name="driver">' + FROM.format("driver.yaml") + "</node></launch>"
    assert messages(tmp_path, TWO.format("driver", FROM.format("relay.yaml"))) != []
    (tmp_path / "head/launch/other.launch.xml").write_text(other, encoding="utf-8")
    assert messages(tmp_path, TWO.format("driver", FROM.format("relay.yaml"))) == []
