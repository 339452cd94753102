# SPDX-License-Identifier: Apache-2.0
"""What messages propose for a manifest: tags that its format has, and each dependency once."""

from __future__ import annotations

from pathlib import Path

import pytest

from haros_ci.api.testing import said
from haros_ci.checking.page import Example
from haros_ci.registry import checks

MANIFEST = (
    "<package{0}><name>demo</name><version>1.0.0</version><description>d</description>"
    '<maintainer email="a@b.cd">m</maintainer><license>Apache-2.0</license>{1}</package>\n'
)
ROS1 = "<buildtool_depend>catkin</buildtool_depend><build_depend>roscpp</build_depend>"
ROS2 = "<buildtool_depend>ament_cmake</buildtool_depend>{}<export><build_type>ament_cmake</build_type></export>"
CMAKE = "cmake_minimum_required(VERSION 3.8)\nproject(demo)\n{}\n"


def pair(check_id: str, core: str, arm: str, tmp_path: Path) -> list[tuple[str, str]]:
    """What the check says of two packages of ROS 1 that import each other's modules, with these dependencies."""
    files = {}
    for name, other, needs in (("core", "arm", core), ("arm", "core", arm)):
        needs = "<buildtool_depend>catkin</buildtool_depend>" + "".join(
            f"<depend>{one}</depend>" for one in needs.split()
        )
        files[f"{name}/package.xml"] = MANIFEST.format(' format="2"', needs).replace(">demo<", f">{name}<")
        files[f"{name}/CMakeLists.txt"] = (
            f"cmake_minimum_required(VERSION 3.8)\nproject({name})\nfind_package(catkin REQUIRED)\ncatkin_python_setup()\n"
            "catkin_package(INCLUDE_DIRS include)\ninclude_directories(include ${catkin_INCLUDE_DIRS})\n"
            f"add_library({name} src/a.cpp)\n"
        )
        files[f"{name}/setup.py"] = (
            f"from setuptools import setup\nsetup(packages=['{name}'], package_dir={{'': 'src'}})\n"
        )
        files[f"{name}/src/{name}/__init__.py"] = f"import {other}\n" if check_id == "undeclared-import" else ""
        files[f"{name}/include/{name}/{name}.h"] = "int a;\n"
        files[f"{name}/src/a.cpp"] = f"#include <{other}/{other}.h>\n" if check_id == "undeclared-dependency" else ""
    check = next(check for check in checks() if check.id == check_id)
    return [(result.level.value, result.message) for result in said(check, Example("", True, files), tmp_path)]


@pytest.mark.parametrize("check_id", ["undeclared-import", "undeclared-dependency"])
def test_no_advice_that_closes_a_cycle(check_id: str, tmp_path: Path) -> None:
    found = pair(check_id, "", "core", tmp_path)
    assert len(found) == 1 and found[0][0] == "warning", found
    assert "circular dependency" in found[0][1] and "; add <" not in found[0][1]


@pytest.mark.parametrize("check_id", ["undeclared-import", "undeclared-dependency"])
def test_no_two_advices_that_close_a_cycle(check_id: str, tmp_path: Path) -> None:
    found = pair(check_id, "", "", tmp_path)
    assert sorted(level for level, _ in found) == ["error", "warning"], found
    assert sum("; add <" in message for _, message in found) == 1


def messages(manifest: str, cmake: str, source: str, tmp_path: Path) -> list[str]:
    check = next(check for check in checks() if check.id == "undeclared-dependency")
    files = {"package.xml": manifest, "CMakeLists.txt": CMAKE.format(cmake), "a.cpp": source}
    return [result.message for result in said(check, Example("", True, files), tmp_path)]


@pytest.mark.parametrize(
    ("format_", "tags"),
    [
        ("", "<build_depend>nav_msgs</build_depend> and <run_depend>nav_msgs</run_depend>"),
        (' format="1"', "<build_depend>nav_msgs</build_depend> and <run_depend>nav_msgs</run_depend>"),
        (' format="2"', "<depend>nav_msgs</depend>"),
        (' format="3"', "<depend>nav_msgs</depend>"),
    ],
)
def test_tags_of_the_format(format_: str, tags: str, tmp_path: Path) -> None:
    cmake = "find_package(catkin REQUIRED COMPONENTS roscpp nav_msgs)\ncatkin_package()\nadd_executable(a a.cpp)"
    found = messages(MANIFEST.format(format_, ROS1), cmake, "#include <nav_msgs/Odometry.h>\n", tmp_path)
    assert len(found) == 1 and found[0].rstrip(".").endswith(f"add {tags}"), found


def test_a_header_and_the_cmake_package_of_one_library(tmp_path: Path) -> None:
    cmake = "find_package(ament_cmake REQUIRED)\nfind_package(Ceres REQUIRED)\nadd_executable(a a.cpp)\nament_package()"
    manifest = MANIFEST.format(' format="3"', ROS2.format(""))
    found = messages(manifest, cmake, "#include <ceres/ceres.h>\n", tmp_path)
    assert len(found) == 1 and "add <depend>libceres-dev</depend>" in found[0], found


@pytest.mark.parametrize(
    ("declared", "cmake"),
    [
        ("<depend>roscpp</depend>", "find_package(rclcpp REQUIRED)"),
        (
            "<member_of_group>rosidl_interface_packages</member_of_group>",
            "find_package(rosidl_default_generators REQUIRED)\nrosidl_generate_interfaces(demo msg/A.msg)",
        ),
    ],
)
def test_what_another_check_says(declared: str, cmake: str, tmp_path: Path) -> None:
    cmake = f"find_package(ament_cmake REQUIRED)\n{cmake}\nadd_executable(a a.cpp)\nament_package()"
    manifest = MANIFEST.format(' format="3"', ROS2.format(declared))
    assert messages(manifest, cmake, "int a;\n", tmp_path) == []


def test_what_no_other_check_says(tmp_path: Path) -> None:
    cmake = (
        "find_package(ament_cmake REQUIRED)\nfind_package(rclcpp REQUIRED)\nadd_executable(a a.cpp)\nament_package()"
    )
    found = messages(MANIFEST.format(' format="3"', ROS2.format("")), cmake, "int a;\n", tmp_path)
    assert len(found) == 1 and "rclcpp" in found[0]


@pytest.mark.parametrize("ros", ["PCL", "OpenCV"])
def test_a_name_that_only_distributions_long_gone_have_is_not_proposed(ros: str, tmp_path: Path) -> None:
    cmake = f"find_package(catkin REQUIRED COMPONENTS roscpp)\nfind_package({ros} REQUIRED)\ncatkin_package()"
    found = messages(MANIFEST.format(' format="2"', ROS1), cmake, "int a;\n", tmp_path)
    assert len(found) == 1 and "<depend>lib" in found[0], found
    assert not any(word in found[0] for word in ("pcl<", "opencv2", "or pcl", ", pcl"))


@pytest.mark.parametrize(
    ("found", "hint"),
    [
        ("HouseOfGears", "; write HouseOfGears, as find_package() has it here"),
        ("HOUSE-OF_GEARS", "; write HOUSE-OF_GEARS, as find_package() has it here"),
        ("house_of_gear", "; did you mean house_of_gear?"),
        ("Eigen3", "packages that use it stop there; correct the name, or remove it"),
    ],
)
def test_an_exported_package_that_cmake_calls_otherwise(found: str, hint: str, tmp_path: Path) -> None:
    text = f"find_package(ament_cmake REQUIRED)\nfind_package({found})\nament_export_dependencies(house_of_gears)\nament_package()"
    files = {"package.xml": MANIFEST.format(' format="3"', ROS2.format("")), "CMakeLists.txt": CMAKE.format(text)}
    check = next(check for check in checks() if check.id == "unknown-target")
    (result,) = said(check, Example("", True, files), tmp_path)
    assert result.message.rstrip(".").endswith(hint) and "finds no package of this name" in result.message


CFG = (
    "from dynamic_reconfigure.parameter_generator_catkin import *\ngen = ParameterGenerator()\n"
    'gen.add("speed", double_t, 0, "Speed", 1.0, 0.0, 2.0)\nexit(gen.generate("demo", "driver", "Driver"))\n'
)


@pytest.mark.parametrize(
    ("more", "advice"),
    [
        ({"n.py": "from demo.cfg import DriverConfig\n"}, "and import settingsConfig from demo.cfg"),
        ({"n.cpp": "#include <demo/settingsConfig.h>\n"}, "and include <demo/settingsConfig.h>"),
        (
            {"n.py": "from demo.cfg import DriverConfig\n", "n.cpp": '#include "demo/DriverConfig.h"\n'},
            "and include <demo/settingsConfig.h>",
        ),
        ({}, "and include <demo/settingsConfig.h>"),
        ({"n.py": "import demo\n"}, "and include <demo/settingsConfig.h>"),
    ],
)
def test_who_uses_a_configuration_of_another_name(more: dict[str, str], advice: str, tmp_path: Path) -> None:
    needs = "<buildtool_depend>catkin</buildtool_depend><depend>dynamic_reconfigure</depend>"
    text = "find_package(catkin REQUIRED COMPONENTS dynamic_reconfigure)\ngenerate_dynamic_reconfigure_options(cfg/settings.cfg)\ncatkin_package()"
    files = {
        "package.xml": MANIFEST.format(' format="2"', needs),
        "CMakeLists.txt": CMAKE.format(text),
        "cfg/settings.cfg": CFG,
    }
    check = next(check for check in checks() if check.id == "config-name-mismatch")
    (result,) = said(check, Example("", True, {**files, **more}), tmp_path)
    assert advice in result.message


IDLE = "find_package(catkin REQUIRED COMPONENTS roscpp nav_msgs)\ncatkin_package()\n{}add_executable(a a.cpp)\n"


@pytest.mark.parametrize(
    ("cmake", "source", "is_idle"),
    [
        (IDLE.format(""), "int main() { return 0; }\n", True),
        (IDLE.format("include_directories(${catkin_INCLUDE_DIRS})\n"), "int main() { return 0; }\n", True),
        (IDLE.format(""), "#include <nav_msgs/Odometry.h>\nint main() { return 0; }\n", False),
        (IDLE.format(""), "#ifdef WITH_MAP\n#include <nav_msgs/Odometry.h>\n#endif\nint main() {}\n", False),
        (IDLE.format("include_directories(${nav_msgs_INCLUDE_DIRS})\n"), "int main() { return 0; }\n", False),
        (
            IDLE.replace("catkin_package()", "catkin_package(CATKIN_DEPENDS nav_msgs)").format(""),
            "int main() {}\n",
            False,
        ),
        (IDLE.replace("nav_msgs", "rosconsole").format(""), "int main() { return 0; }\n", False),
        (
            IDLE.replace("nav_msgs", "xmlrpcpp").format(""),
            "#ifdef REMOTE\n#include <xmlrpcpp/XmlRpc.h>\n#endif\nint main() {}\n",
            False,
        ),
        (IDLE.format("add_nav_msgs_tables(a)\n"), "int main() { return 0; }\n", False),
        (IDLE.format("make_tables_of_messages(a)\n"), "int main() { return 0; }\n", False),
        (IDLE.format("function(tables)\nendfunction()\ntables(a)\n"), "int main() { return 0; }\n", True),
        (IDLE.format("if(X)\nmacro(tables)\nendmacro()\nendif()\ntables(a)\n"), "int main() { return 0; }\n", True),
        (
            IDLE.format(
                "check_cxx_compiler_flag(-Wall W)\nadd_rostest(a.test)\ncatkin_add_gtest(t t.cpp)\nset_property(TARGET a PROPERTY X 1)\n"
                "install(TARGETS a)\nqt5_wrap_cpp(m a.h)\nforeach(b c)\nendforeach()\ncmake_policy(SET CMP0054 NEW)\n"
            ),
            "int main() { return 0; }\n",
            True,
        ),
        (
            IDLE.replace("nav_msgs", "dynamic_reconfigure").format("generate_dynamic_reconfigure_options(cfg/A.cfg)\n"),
            "int main() { return 0; }\n",
            False,
        ),
    ],
)
def test_a_name_that_only_find_package_has(cmake: str, source: str, is_idle: bool, tmp_path: Path) -> None:
    found = messages(MANIFEST.format(' format="2"', ROS1), cmake, source, tmp_path)
    assert any("remove it from find_package(), or add <" in message for message in found) == is_idle
    assert all("add <" in message for message in found)


@pytest.mark.parametrize(
    ("cmake", "source", "advice"),
    [
        ("find_package(Eigen3 REQUIRED)", "int a;", "add <depend>eigen</depend>"),
        ("find_package(Eigen3 REQUIRED)", "#include <Eigen/Dense>\nint a;", "add <depend>eigen</depend>"),
        (
            "find_package(eigen3_cmake_module REQUIRED)\nfind_package(Eigen3 REQUIRED)",
            "int a;",
            "add <buildtool_depend>eigen3_cmake_module</buildtool_depend>",
        ),
    ],
)
def test_a_find_module_is_advised_where_cmake_names_it(cmake: str, source: str, advice: str, tmp_path: Path) -> None:
    cmake = f"find_package(ament_cmake REQUIRED)\n{cmake}\nadd_library(a a.cpp)\nament_package()"
    found = messages(MANIFEST.format(' format="3"', ROS2.format("")), cmake, source, tmp_path)
    assert any(advice in message for message in found), found
    assert any("eigen3_cmake_module" in message for message in found) == ("eigen3_cmake_module" in cmake)


@pytest.mark.parametrize(
    ("needs", "level"),
    [
        ("", "warning"),
        ("<exec_depend>python3-numpy</exec_depend>", "warning"),
        ("<build_depend>roscpp</build_depend>", "warning"),
        ("<test_depend>std_msgs</test_depend>", "warning"),
        ("<exec_depend>roscpp</exec_depend>", "note"),
        ("<exec_depend>rospy</exec_depend>", "note"),
        ("<depend>geometry_msgs</depend>", "note"),
    ],
)
def test_a_runtime_that_another_dependency_brings(needs: str, level: str, tmp_path: Path) -> None:
    tags = f"<buildtool_depend>catkin</buildtool_depend><build_depend>message_generation</build_depend>{needs}"
    files = {
        "package.xml": MANIFEST.format(' format="2"', tags),
        "CMakeLists.txt": CMAKE.format(
            "find_package(catkin REQUIRED COMPONENTS message_generation)\nadd_message_files(FILES Joint.msg)\n"
            "generate_messages()\ncatkin_package()"
        ),
        "msg/Joint.msg": "float64 position\n",
    }
    check = next(check for check in checks() if check.id == "incomplete-interface-package")
    (result,) = said(check, Example("", True, files), tmp_path)
    assert result.level.value == level and "message_runtime" in result.message, result.message


BOTH = (
    '<buildtool_depend condition="$ROS_VERSION == 1">catkin</buildtool_depend>{}'
    '<export><build_type condition="$ROS_VERSION == 1">catkin</build_type>'
    '<build_type condition="$ROS_VERSION == 2">ament_python</build_type></export>'
)


@pytest.mark.parametrize(
    ("version", "needs", "tag"),
    [
        (3, BOTH.format(""), '<depend condition="$ROS_VERSION == 1">rospy</depend>'),
        (3, "<buildtool_depend>catkin</buildtool_depend>", "<depend>rospy</depend>"),
        (3, '<buildtool_depend condition="$ROS_DISTRO == noetic">catkin</buildtool_depend>', "<depend>rospy</depend>"),
        (2, "<buildtool_depend>catkin</buildtool_depend>", "<depend>rospy</depend>"),
    ],
)  # fmt: skip
def test_what_one_ros_has_gets_its_condition(version: int, needs: str, tag: str, tmp_path: Path) -> None:
    files = {
        "package.xml": MANIFEST.format(f' format="{version}"', needs),
        "CMakeLists.txt": CMAKE.format("find_package(catkin REQUIRED COMPONENTS rospy std_msgs)\ncatkin_package()"),
        "a.py": "import rospy\n",
    }
    check = next(check for check in checks() if check.id == "undeclared-dependency")
    found = [result for result in said(check, Example("", True, files), tmp_path) if "needs rospy" in result.message]
    assert len(found) == 1 and f"add {tag}" in found[0].message, found
    assert [edit.text.strip() for edit in found[0].fixes[0].edits] == [tag]


def test_imports_of_either_ros_get_their_conditions(tmp_path: Path) -> None:
    files = {
        "package.xml": MANIFEST.format(' format="3"', BOTH.format("")),
        "CMakeLists.txt": CMAKE.format("find_package(catkin REQUIRED)\ncatkin_python_setup()\ncatkin_package()"),
        "setup.py": "from setuptools import setup\nsetup(packages=['demo'], package_dir={'': 'src'})\n",
        "src/demo/__init__.py": "import numpy\nimport sensor_msgs.msg\nimport rosgraph\nimport tf\n",
    }
    check = next(check for check in checks() if check.id == "undeclared-import")
    message = " ".join(result.message for result in said(check, Example("", True, files), tmp_path))
    assert '<exec_depend condition="$ROS_VERSION == 1">tf</exec_depend>' in message
    assert '<exec_depend condition="$ROS_VERSION == 1">rosgraph</exec_depend>' in message
    assert "<exec_depend>sensor_msgs</exec_depend>" in message and "<exec_depend>python3-numpy</exec_depend>" in message


@pytest.mark.parametrize(
    ("name", "needs", "keys"),
    [
        ("opencv", "", ["python3-opencv", "libopencv-dev"]),
        ("opencv", "<exec_depend>python3-numpy</exec_depend>", ["python3-opencv", "libopencv-dev"]),
        ("opencv", "<exec_depend>python-numpy</exec_depend>", ["python-opencv", "libopencv-dev"]),
    ],
)
def test_keys_for_a_name_that_is_none(name: str, needs: str, keys: list[str], tmp_path: Path) -> None:
    tags = f"<buildtool_depend>catkin</buildtool_depend><depend>rospy</depend><depend>{name}</depend>{needs}"
    files = {
        "package.xml": MANIFEST.format(' format="2"', tags),
        "CMakeLists.txt": CMAKE.format(
            "find_package(catkin REQUIRED)\nfind_package(OpenCV REQUIRED)\ncatkin_package()\n"
            "catkin_install_python(PROGRAMS view.py DESTINATION ${CATKIN_PACKAGE_BIN_DESTINATION})"
        ),
        "view.py": "#!/usr/bin/env python3\nimport cv2\n",
    }
    check = next(check for check in checks() if check.id == "misspelt-dependency")
    (result,) = said(check, Example("", True, files), tmp_path)
    advice = result.message.partition("; write ")[2]
    assert all(f"{key}, which the code uses" in advice for key in keys), advice
    assert sum("python" in word for word in advice.split()) == 1, advice


@pytest.mark.parametrize(
    ("condition", "count"),
    [
        ("$ROS_VERSION == 1", 1),
        ("$ROS_DISTRO == noetic", 1),
        ("$OWN_THING == yes", 1),
        ("a == b", 1),
        ("$ROS_VERSION == 2", 0),
        ("$ROS_VERSION != 1", 0),
        ("$ROS_DISTRO == humble", 0),
        ("$ROS_DISTRO >= jazzy", 0),
        ("$ROS_DISTRO > rolling", 0),
        ("$ROS_DISTRO != noetic", 0),
        ("$OWN_THING != yes", 0),
        ("$ROS_PYTHON_VERSION == 3", 0),
        ("$ROS_VERSION == 1 or $ROS_DISTRO == rolling", 0),
        ("not a condition", 0),
    ],
)
def test_a_condition_that_never_holds(condition: str, count: int, tmp_path: Path) -> None:
    needs = f'<depend>rclcpp</depend><depend condition="{condition}">geometry_msgs</depend>'
    manifest = MANIFEST.format(' format="3"', ROS2.format(needs))
    cmake = CMAKE.format("find_package(geometry_msgs REQUIRED)\nadd_library(a a.cpp)")
    found = messages(manifest, cmake, "#include <geometry_msgs/msg/twist.hpp>\n", tmp_path)
    assert len([one for one in found if "geometry_msgs" in one]) == count, found
    assert all(f"condition that never holds here: {condition})" in one or "$" not in condition for one in found)


@pytest.mark.parametrize("declared", ["python-numpy", "python3-numpy", "rospy"])
def test_no_key_of_a_part(declared: str, tmp_path: Path) -> None:
    """PyQt5 is no part of it for QtQuick, even where the one key of that has the Python of the others."""
    needs = f"<buildtool_depend>catkin</buildtool_depend><exec_depend>{declared}</exec_depend>"
    files = {
        "package.xml": MANIFEST.format(' format="2"', needs),
        "CMakeLists.txt": (
            "cmake_minimum_required(VERSION 3.0.2)\nproject(demo)\nfind_package(catkin REQUIRED)\ncatkin_package()\n"
            "catkin_install_python(PROGRAMS window.py DESTINATION ${CATKIN_PACKAGE_BIN_DESTINATION})\n"
        ),
        "window.py": "#!/usr/bin/env python\nfrom PyQt5.QtWidgets import QApplication\nQApplication([])\n",
    }
    check = next(check for check in checks() if check.id == "undeclared-import")
    (result,) = said(check, Example("", True, files), tmp_path)
    assert "quick" not in result.message and "qt" in result.message.lower()


@pytest.mark.parametrize(
    ("needs", "cmake", "end"),
    [
        (
            "",
            "find_package(ament_lint_auto REQUIRED)\nament_lint_auto_find_test_dependencies()",
            "move find_package() into if(BUILD_TESTING), as tests alone need it, and add <test_depend>ament_lint_auto</test_depend>.",
        ),
        (
            "",
            "find_package(ament_cmake_gtest REQUIRED)\nament_add_gtest(a a.cpp)",
            "move find_package() into if(BUILD_TESTING), as tests alone need it, and add <test_depend>ament_cmake_gtest</test_depend>.",
        ),
        ("", "find_package(std_msgs REQUIRED)\nament_target_dependencies(a std_msgs b)\nb()", "add <depend>std_msgs</depend>."),
    ],
)  # fmt: skip
def test_where_a_package_of_tests_belongs(needs: str, cmake: str, end: str, tmp_path: Path) -> None:
    manifest = MANIFEST.format(' format="3"', ROS2.format(needs))
    (message,) = messages(
        manifest, CMAKE.format(f"find_package(ament_cmake REQUIRED)\n{cmake}\nament_package()"), "", tmp_path
    )
    assert message.rstrip(".").endswith(end.rstrip(".")), message


@pytest.mark.parametrize(
    ("name", "others"),
    [("pose-cov-ops", []), ("Pose_Cov_Ops", []), ("pose_cov_ops", []), ("pose-ops", ["pose_cov_ops"])],
)
def test_a_name_with_other_separators_is_corrected(name: str, others: list[str], tmp_path: Path) -> None:
    files = {
        "package.xml": MANIFEST.format(' format="3"', ROS2.format(f"<depend>{name}</depend>")),
        "CMakeLists.txt": CMAKE.format("find_package(ament_cmake REQUIRED)\nfind_package(pose_cov_ops REQUIRED)\nament_package()"),
    }  # fmt: skip
    by_id = {check.id: check for check in checks() if check.id in ("misspelt-dependency", "undeclared-dependency")}
    found = {
        key: [one.message for one in said(check, Example("", True, files), tmp_path)] for key, check in by_id.items()
    }
    corrected = [] if name == "pose_cov_ops" or others else ["write pose_cov_ops"]
    assert [word for message in found["misspelt-dependency"] for word in corrected if word in message] == corrected
    assert len(found["undeclared-dependency"]) == len(others), found


POINTS = "find_package(ament_cmake REQUIRED)\n{}\nadd_executable(a a.cpp)\nament_package()"


@pytest.mark.parametrize(
    ("found", "headers", "end"),
    [
        (
            "find_package(pcl_ros REQUIRED)",
            ("tf2_eigen/tf2_eigen.h",),
            "add <depend>pcl_ros</depend> and <depend>tf2_eigen</depend>",
        ),
        (
            "find_package(pcl_ros REQUIRED)",
            ("Eigen/Core", "tf2_eigen/tf2_eigen.h"),
            "add <depend>pcl_ros</depend> and <depend>tf2_eigen</depend>, of which pcl_ros brings <Eigen/Core>, too",
        ),
        (
            "find_package(pcl_ros REQUIRED)",
            ("Eigen/Core",),
            "add <depend>pcl_ros</depend>, which brings <Eigen/Core>, too",
        ),
        (
            "find_package(cv_bridge REQUIRED)",
            ("opencv2/opencv.hpp",),
            "add <depend>cv_bridge</depend>, which brings <opencv2/opencv.hpp>, too",
        ),
    ],
)
def test_what_another_package_brings_in_some_distributions_alone(
    found: str, headers: tuple[str, ...], end: str, tmp_path: Path
) -> None:
    manifest = MANIFEST.format(' format="3"', ROS2.format(""))
    source = "".join(f"#include <{header}>\n" for header in headers)
    (message,) = messages(manifest, POINTS.format(found), source, tmp_path)
    assert message.rstrip(".").endswith(end), message
