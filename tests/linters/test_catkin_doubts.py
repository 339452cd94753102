# SPDX-License-Identifier: Apache-2.0
"""Messages of catkin_lint that the workspace refutes, and those that it does not."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import pytest
from linter_samples import workspace

from haros_ci.knowledge.knowledge import knowledge
from haros_ci.linters import catkin_doubts
from haros_ci.linters.catkin_doubts import BRINGS, is_refuted
from haros_ci.model.location import Location
from haros_ci.model.package import Package
from haros_ci.model.submodules import absent

MISSING = "add_rostest() needs missing file '{}'."
NAMED = "get_filename_component(NAME ${CMAKE_CURRENT_SOURCE_DIR} NAME)\nadd_rostest(${NAME}.test)\n"
REFUTED = [
    (
        "MISSING_CMD",
        "missing catkin_package().",
        "find_package(catkin_simple REQUIRED)\ncs_install()\ncs_export()\n",
        None,
    ),
    ("MISSING_CMD", "missing catkin_package().", "  cs_export(INCLUDE_DIRS include)\n", 1),
    ("MISSING_FILE", MISSING.format(".test"), NAMED, 2),
    ("MISSING_FILE", MISSING.format("test/.test"), "", 1),
    ("MISSING_FILE", MISSING.format("${NAME}.test"), "", 1),
    ("MISSING_FILE", MISSING.format("a.test"), NAMED, 2),
    ("MISSING_FILE", MISSING.format("a.cpp"), "foreach(n a b)\n  add_executable(${n} ${n}.cpp)\nendforeach()\n", 2),
    ("MISSING_FILE", MISSING.format("x/a.cpp"), "function(go WHERE)\n  install(FILES\n ${WHERE}/a.cpp)\n", 2),
    ("MISSING_FILE", MISSING.format("a.cpp"), 'string(TOLOWER ${A} low)\ninstall(FILES "${low}.cpp")\n', 2),
    ("MISSING_FILE", MISSING.format("a.cpp"), "install(FILES a.cpp DESTINATION b OPTIONAL)\n", 1),
    ("MISSING_FILE", MISSING.format("lib/link.so"), "install(FILES lib/${CMAKE_LIBRARY_ARCHITECTURE}/link.so)\n", 1),
    ("MISSING_FILE", MISSING.format("lib/link.so"), "install(FILES lib/${CMAKE_SYSTEM_PROCESSOR}/link.so)\n", 1),
    ("MISSING_FILE", MISSING.format("lib/link.so"), "install(FILES lib/${NOWHERE_SET}/link.so)\n", 1),
    ("MISSING_FILE", MISSING.format("lib//link.so"), "", 1),
    ("MISSING_FILE", MISSING.format("/link.so"), "", 1),
    ("MISSING_FILE", "add_executable() needs missing file 'plant'.", "cuda_add_executable(a a.cu plant)\n", 1),
    ("MISSING_FILE", "add_library() needs missing file 'src/kernel'.", "add_library(a src/kernel)\n", 1),
    ("UNINSTALLED_EXPORT_LIB", "exported library 'a' is not installed.", "catkin_package(LIBRARIES a)\n", 1),
    ("UNINSTALLED_INCLUDE_PATH", "include path 'include' is not installed.", "# install(TARGETS a)\n", 1),
    ("UNINSTALLED_SCRIPT", "script 'a.py' is not installed.", "set(install a)\n", None),
    ("EXTERNAL_FILE", "include() uses file '../common.cmake' which is not in package.", "", 1),
]
STANDS = [
    ("UNINSTALLED_EXPORT_LIB", "exported library 'a' is not installed.", "  install(TARGETS b)\n", 1),
    ("UNINSTALLED_EXPORT_LIB", "exported library 'a' is not installed.", "catkin_install_python (PROGRAMS b)\n", 1),
    ("UNINSTALLED_EXPORT_LIB", "exported library 'a' is not installed.", "cs_install()\n", 1),
    ("MISSING_CMD", "missing catkin_package().", "find_package(catkin REQUIRED)\n", None),
    ("MISSING_CMD", "missing catkin_package().", "# cs_export()\n", None),
    ("MISSING_CMD", "missing generate_messages().", "cs_export()\n", None),
    ("MISSING_FILE", MISSING.format("a.test"), "add_rostest(a.test)\n", 1),
    ("MISSING_FILE", MISSING.format("src/.hidden.cpp"), "add_rostest(src/.hidden.cpp)\n", 1),
    ("MISSING_FILE", MISSING.format("a.cpp"), "set(FILES a.cpp)\nadd_executable(a ${FILES})\n", 2),
    ("MISSING_FILE", MISSING.format("robot.cpp"), "add_executable(a ${PROJECT_NAME}.cpp)\n", 1),
    ("MISSING_FILE", MISSING.format("a.test"), "add_rostest(a.test)\n" + NAMED, 1),
    ("MISSING_FILE", "no name", "", None),
    ("MISSING_FILE", "add_library() needs missing file 'other'.", "add_library(a other)\n", 1),
    ("MISSING_FILE", "add_library() needs missing file 'plant.cc'.", "add_library(a plant.cc)\n", 1),
    ("MISSING_FILE", "install() needs missing file 'plant'.", "install(FILES plant)\n", 1),
    ("MISSING_FILE", MISSING.format("lib/a.so"), "install(FILES ${CMAKE_CURRENT_SOURCE_DIR}/lib/a.so)\n", 1),
    ("EXTERNAL_FILE", "include() uses file '../nowhere.cmake' which is not in package.", "", 1),
    ("EXTERNAL_FILE", "include() uses file '/opt/common.cmake' which is not in package.", "", 1),
    ("MISSING_DEPEND", "missing build_depend on 'roscpp'.", "", 1),
]


def refuted(root: Path, rule: str, message: str, text: str, line: int | None) -> bool:
    files = {
        "robot/package.xml": "",
        "robot/CMakeLists.txt": text,
        "common.cmake": "",
        "robot/plant.cpp": "",
        "robot/src/kernel.cu": "",
    }
    made = replace(workspace(root, files, [Package("robot", "robot", ros=1)]), names=frozenset(files))
    return is_refuted(rule, message, "robot", Location("robot/CMakeLists.txt", line), made)


@pytest.mark.parametrize(("rule", "message", "text", "line"), REFUTED)
def test_refuted(tmp_path: Path, rule: str, message: str, text: str, line: int | None) -> None:
    assert refuted(tmp_path, rule, message, text, line)


@pytest.mark.parametrize(("rule", "message", "text", "line"), STANDS)
def test_stands(tmp_path: Path, rule: str, message: str, text: str, line: int | None) -> None:
    assert not refuted(tmp_path, rule, message, text, line)


@pytest.mark.parametrize(
    ("rule", "message", "expected"),
    [
        ("MISSING_FILE", MISSING.format("gears/src/gear.cpp"), True),
        ("MISSING_FILE", MISSING.format("gears"), True),
        ("MISSING_FILE", MISSING.format("gearbox/gear.cpp"), False),
        ("MISSING_FILE", MISSING.format("../gears/gear.cpp"), False),
        ("MISSING_FILE", MISSING.format("wheels/wheel.cpp"), False),
        ("MISSING_INCLUDE_PATH", "exported include path 'gears/include' does not exist.", True),
        ("MISSING_INCLUDE_PATH", "exported include path 'include' does not exist.", False),
        ("MISSING_SUBDIR", "add_subdirectory() needs missing subdirectory 'gears'.", True),
        ("UNINSTALLED_EXPORT_LIB", "exported library 'gears' is not installed.", False),
    ],
)
def test_submodules_that_are_not_checked_out(tmp_path: Path, rule: str, message: str, expected: bool) -> None:
    modules = '[submodule "gears"]\n\tpath = robot/gears\n[submodule "wheels"]\n\tpath = robot/wheels\n'
    files = {"robot/package.xml": "", ".gitmodules": modules, "robot/wheels/README": ""}
    files["robot/CMakeLists.txt"] = "install()\n"
    here = workspace(tmp_path, files, [Package("robot", "robot", ros=1)])
    lacking = absent(replace(here, names=frozenset(files)))
    assert lacking == {"robot/gears"}
    assert is_refuted(rule, message, "robot", Location("robot/CMakeLists.txt", None), here, lacking) is expected


LISTED = "generate_messages(DEPENDENCIES actionlib_msgs\n  geometry_msgs std_msgs)\n"


@pytest.mark.parametrize(
    ("name", "more", "expected"),
    [
        ("actionlib_msgs", {"robot/srv/Go.srv": "geometry_msgs/Pose to\n---\n"}, True),
        ("geometry_msgs", {"robot/srv/Go.srv": "geometry_msgs/Pose to\n---\n"}, False),
        ("actionlib_msgs", {"robot/action/Go.action": "geometry_msgs/Pose to\n---\n---\n"}, False),
        (
            "std_msgs",
            {"robot/srv/Go.srv": "bool now\n---\n", "robot/include/robot/a.h": "#include <std_msgs/String.h>\n"},
            False,
        ),
        ("sensor_msgs", {"robot/srv/Go.srv": "bool now\n---\n"}, False),
        ("std_msgs", {"robot/msg/Now.msg": "Header header\n"}, False),
        ("std_msgs", {}, False),
    ],
)
def test_messages_that_are_only_listed(tmp_path: Path, name: str, more: dict[str, str], expected: bool) -> None:
    files = {"robot/package.xml": "", "robot/CMakeLists.txt": LISTED, **more}
    here = workspace(tmp_path, files, [Package("robot", "robot", ros=1)])
    message = f"package '{name}' must be in CATKIN_DEPENDS in catkin_package()."
    assert is_refuted("MISSING_CATKIN_DEPEND", message, "robot", Location("robot/CMakeLists.txt", 1), here) is expected


PLAIN = "bool now\n---\n"
ROSCPP = "find_package(catkin REQUIRED COMPONENTS message_generation\n  roscpp)\n"


@pytest.mark.parametrize(
    ("name", "found", "interface", "expected"),
    [
        ("std_msgs", ROSCPP, PLAIN, True),
        ("std_msgs", "find_package(sensor_msgs REQUIRED)\n", PLAIN, True),
        ("geometry_msgs", "find_package(catkin REQUIRED COMPONENTS tf)\n", PLAIN, True),
        ("geometry_msgs", ROSCPP, PLAIN, False),
        ("std_msgs", "find_package(catkin REQUIRED COMPONENTS message_generation)\n", PLAIN, False),
        ("std_msgs", f"find_package(catkin REQUIRED)\n# {ROSCPP[:-1]}", PLAIN, False),
        ("std_msgs", ROSCPP, "std_msgs/String now\n---\n", False),
        ("std_msgs", ROSCPP, "Header header\n---\n", False),
        ("std_msgs", ROSCPP, "bool now\n---\n  Header header\n", False),
        ("std_msgs", ROSCPP, "", False),
        ("shape_msgs", ROSCPP, PLAIN, False),
    ],
)
def test_messages_that_are_listed_without_being_found(
    tmp_path: Path, name: str, found: str, interface: str, expected: bool
) -> None:
    files = {
        "robot/package.xml": "",
        "robot/CMakeLists.txt": found + LISTED,
        "robot/src/a.h": "#include <std_msgs/Bool.h>\n",
    }
    if interface:
        files["robot/srv/Go.srv"] = interface
    here = workspace(tmp_path, files, [Package("robot", "robot", ros=1)])
    at = Location("robot/CMakeLists.txt", None)
    assert (
        is_refuted("UNCONFIGURED_MSG_DEPEND", f"unconfigured message dependency '{name}'.", "robot", at, here)
        is expected
    )


BESIDE = "add_subdirectory(../shared shared{})\n"


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        (BESIDE.format(""), True),
        (BESIDE.format(" EXCLUDE_FROM_ALL"), True),
        ('ADD_SUBDIRECTORY ( "${CMAKE_CURRENT_SOURCE_DIR}/../shared"\n  ${CMAKE_BINARY_DIR}/shared)\n', True),
        ("add_subdirectory(${PROJECT_SOURCE_DIR}/../shared a)\n", True),
        ("add_subdirectory(../shared)\n", False),
        ("add_subdirectory(../shared EXCLUDE_FROM_ALL)\n", False),
        ("add_subdirectory(../nowhere shared)\n", False),
        ("add_subdirectory(../plain shared)\n", False),
        ("add_subdirectory(${SHARED} shared)\n", False),
        ("add_subdirectory(/opt/shared shared)\n", False),
        ("\n" + BESIDE.format(""), False),
    ],
)
def test_a_directory_that_packages_share(tmp_path: Path, text: str, expected: bool) -> None:
    files = {"robot/package.xml": "", "robot/CMakeLists.txt": text, "shared/CMakeLists.txt": "", "plain/a.h": ""}
    here = replace(workspace(tmp_path, files, [Package("robot", "robot", ros=1)]), names=frozenset(files))
    said = "subdirectory /shared is not in package."
    assert is_refuted("EXTERNAL_SUBDIR", said, "robot", Location("robot/CMakeLists.txt", 1), here) is expected


SETUP = "from setuptools import setup\nsetup({})\n"


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        (SETUP.format("**generate_distutils_setup()"), True),
        (SETUP.format("name='robot', version='1'"), True),
        (SETUP.format("name='robot'  # packages=['robot']\n"), True),
        (SETUP.format("packages=['robot']"), False),
        (SETUP.format("**generate_distutils_setup(package_dir={'': 'src'}, packages=[])"), False),
        (SETUP.format("package_dir={'': 'scripts'}, packages=['robot']"), True),
        (SETUP.format("package_dir={'robot': \"lib/robot\"}, packages=['robot']"), True),
        (SETUP.format("package_dir={'': 'src'}, packages=['robots', 'arm.robot']"), True),
        (SETUP.format("package_dir={'': 'src'}, packages=['robots', 'robot']"), False),
        (SETUP.format("package_dir={'': 'src'}, packages=names"), False),
        (SETUP.format("package_dir={'': ''}, packages=['robot']"), False),
        (SETUP.format("package_dir={'': 'scripts', 'robot': 'src/robot'}, packages=['robot']"), False),
        (SETUP.format("package_dir={'': 'scripts'}, packages=['robot'], scripts=['a']"), False),
        (SETUP.format("package_dir={}, packages=['robot']"), False),
        (SETUP.format("package_dir=folders, packages=['robot']"), False),
        (SETUP.format("scripts=['a']"), False),
        (SETUP.format("py_modules=['a']"), False),
        (SETUP.format("name='a'") + "d['packages'] = ['a']\n", False),
        ("", False),
    ],
)
def test_a_setup_that_installs_nothing(tmp_path: Path, text: str, expected: bool) -> None:
    files = {"robot/package.xml": "", "robot/CMakeLists.txt": "", "robot/setup.py": text, "robot/src/robot/a.py": ""}
    here = replace(workspace(tmp_path, files, [Package("robot", "robot", ros=1)]), names=frozenset(files))
    said = "file setup.py found but no catkin_python_setup() call."
    at = Location("robot/CMakeLists.txt", None)
    assert is_refuted("MISSING_PYTHON_SETUP", said, "robot", at, here) is expected


@pytest.mark.parametrize(
    ("messages", "finder"), [(name, each) for name, them in BRINGS.items() for each in sorted(them)]
)
def test_what_brings_messages_is_what_the_manifests_of_the_distributions_say(messages: str, finder: str) -> None:
    known, found, waiting = knowledge(), {finder}, [finder]
    while waiting:
        new = (known.depends(waiting.pop(), 1) or frozenset()) - found
        found |= new
        waiting += new
    assert messages in found


@pytest.mark.parametrize(
    ("message", "expected"),
    [
        ("add_executable() is called", True),
        ("catkin_add_nosetests() is called", False),
        ("my_add_shared_LIBRARY() is called", True),
        ("cuda_add_executable() is called", True),
        ("target_sources() is called", True),
        ("my_target_sources() is called", True),
        ("catkin_add_gtest() is called", True),
        ("add_rostest_gtest() is called", True),
        ("install() is called", False),
        ("executable() is called", False),
        ("add_executable is called", False),
        ("in add_executable()", False),
        ("add_executable_of() is called", False),
        ("", False),
        ("add_" * 75_000, False),
        ("add_a" * 60_000 + "()", False),
    ],
)
def test_commands_that_name_sources(message: str, expected: bool) -> None:
    assert catkin_doubts._is_of_sources(message) is expected
