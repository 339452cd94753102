# SPDX-License-Identifier: Apache-2.0
"""Many classes of one Python file: what its routines belong to is asked in proportion to them."""

from __future__ import annotations

from pathlib import Path

from commandline import haros, write

DRIVER = """
import atexit, sys
from haros_ci.code.codebase import Routine
asked, owner = [0], Routine.owner.fget
def counting(self):
    asked[0] += 1
    return owner(self)
Routine.owner = property(counting)
atexit.register(lambda: print("asked", asked[0], file=sys.stderr))
from haros_ci.cli import main
sys.exit(main())
"""
PACKAGE = {
    "bot/package.xml": '<package format="3"><name>bot</name><version>1.0.0</version><buildtool_depend>ament_cmake</buildtool_depend></package>',
    "bot/CMakeLists.txt": "project(bot)\nfind_package(ament_cmake REQUIRED)\ninstall(PROGRAMS a.py DESTINATION lib/bot)\nament_package()\n",
}
HEAD = "#!/usr/bin/env python3\nimport rclpy\nfrom rclpy.node import Node\nfrom std_msgs.msg import String\n"
CLASS = """class A{0}(Node):
    def __init__(self):
        super().__init__('a{0}')
        self.message{0} = String()
        self.message{0}.data = 'x'
        self.made{0} = self.create_publisher(String, 't{0}', 1)
"""


def asked(place: Path, classes: int) -> int:
    code = HEAD + "".join(CLASS.format(number) for number in range(classes)) + "rclpy.init()\nrclpy.spin(A0())\n"
    root = write(place / str(classes), {**PACKAGE, "bot/a.py": code})
    driver = write(place, {"counting.py": DRIVER}) / "counting.py"
    done = haros(
        "check", ".", "--isolated", "--no-cache", "--profile=architecture", "--jobs=1", cwd=root, driver=driver
    )
    (count,) = (line.split()[1] for line in done.stderr.splitlines() if line.startswith("asked "))
    return int(count)


def test_the_attributes_of_many_classes_are_found_in_proportion(tmp_path: Path) -> None:
    few, some, many = (asked(tmp_path, classes) for classes in (30, 60, 120))
    assert many - some < 2.5 * (some - few)
