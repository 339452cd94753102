# SPDX-License-Identifier: Apache-2.0
"""What undefined-interface proposes: the interface of that name in another package, before one of a like name."""

from __future__ import annotations

from pathlib import Path

import pytest

from haros_ci.api.testing import said
from haros_ci.checking.page import Example
from haros_ci.registry import checks

MANIFEST = (
    '<package format="3"><name>{}</name><version>1.0.0</version><description>d</description><maintainer email="a@b.cd">m</maintainer>'
    "<license>Apache-2.0</license><buildtool_depend>ament_cmake</buildtool_depend>{}"
    "<export><build_type>ament_cmake</build_type></export></package>\n"
)
CMAKE = (
    "cmake_minimum_required(VERSION 3.8)\nproject({})\nfind_package(ament_cmake REQUIRED)\nfind_package(rosidl_default_generators REQUIRED)\n"
    "rosidl_generate_interfaces(${{PROJECT_NAME}} msg/{})\nadd_executable(walk walk.cpp)\nament_package()\n"
)
CODE = '#include <rclcpp/rclcpp.hpp>\n#include "geo/msg/geo_point.hpp"\nint main() {}\n'


@pytest.mark.parametrize(
    ("depends", "more", "words"),
    [
        ("", "", "; did you mean geo/GeoPoints?"),
        ("<depend>geographic_msgs</depend>", "", "; did you mean geographic_msgs/GeoPoint?"),
        ("<depend>std_msgs</depend>", "", "; did you mean geo/GeoPoints?"),
        ("", "GeoPoint", "; did you mean other/GeoPoint?"),
        ("", "GeoPointt", "; did you mean geo/GeoPoints?"),
        ("<depend>geographic_msgs</depend>", "GeoPoint", "; did you mean geographic_msgs/GeoPoint or other/GeoPoint?"),
    ],
)
def test_the_same_name_in_another_package(depends: str, more: str, words: str, tmp_path: Path) -> None:
    files = {
        "geo/package.xml": MANIFEST.format("geo", depends),
        "geo/CMakeLists.txt": CMAKE.format("geo", "GeoPoints.msg"),
        "geo/msg/GeoPoints.msg": "float32 a\n",
        "geo/walk.cpp": CODE,
    }
    if more:
        files |= {
            "other/package.xml": MANIFEST.format("other", ""),
            "other/CMakeLists.txt": CMAKE.format("other", f"{more}.msg"),
            f"other/msg/{more}.msg": "float32 a\n",
            "other/walk.cpp": "int main() {}\n",
        }
    check = next(check for check in checks() if check.id == "undefined-interface")
    found = [result.message for result in said(check, Example("", True, files), tmp_path)]
    assert len(found) == 1 and words in found[0]
