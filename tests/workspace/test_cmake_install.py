# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import pytest
from in_memory import built, messages


def test_targets_are_installed() -> None:
    text = "add_library(a x.cpp)\nadd_library(b x.cpp)\nadd_executable(c x.cpp)\ninstall(TARGETS a c EXPORT e\n"
    text += " ARCHIVE DESTINATION lib LIBRARY DESTINATION lib RUNTIME DESTINATION bin INCLUDES DESTINATION b)"
    assert [(t.name, t.is_installed) for t in built(text, "x.cpp").targets] == [("a", True), ("b", False), ("c", True)]


def test_ament_auto_package_installs_what_it_made() -> None:
    text = "ament_auto_add_library(a x.cpp)\nadd_library(b x.cpp)\nament_auto_package(INSTALL_TO_SHARE launch config)"
    build = built(text, "x.cpp")
    assert [(t.name, t.is_installed) for t in build.targets] == [("a", True), ("b", False)]
    assert [(i.path, i.kind, i.destination) for i in build.installed] == [
        ("arm/launch", "directory", "share/arm/launch"),
        ("arm/config", "directory", "share/arm/config"),
    ]


def test_cs_install_installs_what_cs_add_made_and_directories_of_common_names() -> None:
    text = "project(arm)\nfind_package(catkin_simple REQUIRED)\ncatkin_simple()\ncs_add_library(a x.cpp)\n"
    text += "cs_add_executable(b x.cpp)\nadd_library(c x.cpp)\ncs_install()\ncs_export()"
    files = {
        "launch__a_launch": "<launch/>",
        "worlds__big__a_launch": "<launch/>",
        "config__a_yaml": "",
        "include__arm__a_h": "",
    }
    build = built(text, "x.cpp", **files)
    assert [(t.name, t.is_installed) for t in build.targets] == [("a", True), ("b", True), ("c", False)]
    assert [(i.path, i.kind, i.destination) for i in build.installed] == [
        ("arm/include/arm", "directory", "include/arm"),
        ("arm/launch", "directory", "share/arm/launch"),
        ("arm/worlds", "directory", "share/arm/worlds"),
    ]
    assert built("cs_export()", launch__a_launch="").installed == ()


@pytest.mark.parametrize(
    ("cmake", "expected"),
    [
        (
            "install(PROGRAMS scripts/a.py scripts/b DESTINATION ${CATKIN_PACKAGE_BIN_DESTINATION})",
            [("scripts/a.py", "program", "lib/arm", "a.py"), ("scripts/b", "program", "lib/arm", "b")],
        ),
        ("install(PROGRAMS a.py DESTINATION lib/arm RENAME a)", [("a.py", "program", "lib/arm", "a")]),
        ("catkin_install_python(PROGRAMS a.py DESTINATION lib/arm)", [("a.py", "program", "lib/arm", "a.py")]),
        ("install(FILES p.xml DESTINATION share/arm)", [("p.xml", "file", "share/arm", "p.xml")]),
        ("install(FILES p.xml TYPE DATA)", [("p.xml", "file", "share", "p.xml")]),
        ("install(DIRECTORY launch DESTINATION share/arm)", [("launch", "directory", "share/arm/launch", "")]),
        ("install(DIRECTORY launch/ DESTINATION share/arm)", [("launch", "directory", "share/arm", "")]),
        (
            'install(DIRECTORY a b DESTINATION x FILES_MATCHING PATTERN "*.h" PATTERN ".svn" EXCLUDE)',
            [("a", "directory", "x/a", ""), ("b", "directory", "x/b", "")],
        ),
        (
            "foreach(d launch config)\ninstall(DIRECTORY ${d}/ DESTINATION share/${PROJECT_NAME}/${d})\nendforeach()",
            [("launch", "directory", "share/launch", ""), ("config", "directory", "share/config", "")],
        ),
        ("install(FILES /etc/x ${CMAKE_CURRENT_BINARY_DIR}/y DESTINATION z)", []),
        ("find_package(X)\ninstall(FILES ${X_FILES} DESTINATION z)", []),
        ('install(EXPORT e DESTINATION z)\ninstall(CODE "x")\ninstall(SCRIPT s)', []),
    ],
)
def test_files(cmake: str, expected: list[tuple[str, str, str, str]]) -> None:
    build = built(cmake)
    assert [(i.path[4:], i.kind, i.destination, i.name) for i in build.installed] == expected
    assert messages(build) == []


def test_interfaces_that_are_generated() -> None:
    text = "add_message_files(FILES A.msg)\nadd_service_files(DIRECTORY services FILES S.srv)\nadd_action_files()"
    build = built(text, msg__A_msg="int32 x", msg__B_msg="int32 x", services__S_srv="---", action__D_action="---\n---")
    assert [(i.name, i.kind, i.is_generated) for i in build.interfaces] == [
        ("arm/D", "action", True),
        ("arm/A", "msg", True),
        ("arm/B", "msg", False),
        ("arm/S", "srv", True),
    ]


def test_interfaces_of_rosidl() -> None:
    text = 'rosidl_generate_interfaces(${PROJECT_NAME} "msg/A.msg" DEPENDENCIES std_msgs ADD_LINTER_TESTS)'
    build = built(f"project(arm)\n{text}", msg__A_msg="int32 x", msg__B_msg="int32 x")
    assert [(i.name, i.is_generated) for i in build.interfaces] == [("arm/A", True), ("arm/B", False)]


def test_without_a_word_of_them_all_are_generated() -> None:
    assert [i.is_generated for i in built("project(arm)", msg__A_msg="int32 x").interfaces] == [True]


def test_python_packages_of_ament() -> None:
    build = built(
        "project(arm)\nament_python_install_package(${PROJECT_NAME})\nament_python_install_package(b PACKAGE_DIR src/b)"
    )
    assert build.python_roots == (("arm", "arm/arm"), ("b", "arm/src/b"))


@pytest.mark.parametrize(
    ("cmake", "expected"),
    [
        (
            "add_message_files(FILES A.msg)\ngenerate_messages()\nadd_dependencies(t ${${PROJECT_NAME}_EXPORTED_TARGETS})",
            ("t", "arm_generate_messages_cpp"),
        ),
        (
            "generate_dynamic_reconfigure_options(A.cfg)\nadd_service_files(FILES S.srv)\nadd_message_files(FILES A.msg)\n"
            "add_dependencies(t ${arm_EXPORTED_TARGETS})",
            ("t", "arm_gencfg", "arm_generate_messages_cpp"),
        ),
        ("add_dependencies(t ${arm_EXPORTED_TARGETS})\nadd_message_files(FILES A.msg)", ("t",)),
        (
            "find_package(catkin REQUIRED)\nadd_dependencies(t ${catkin_EXPORTED_TARGETS})",
            ("t", "${catkin_EXPORTED_TARGETS}"),
        ),
        (
            "rosidl_get_typesupport_target(made ${PROJECT_NAME} rosidl_typesupport_cpp)\nadd_dependencies(t ${made})",
            ("t", "arm__rosidl_typesupport_cpp"),
        ),
        ("add_dependencies(t ${CATKIN_DEVEL_PREFIX}/include)", ("t", "${BUILD}/devel/include")),
    ],
)
def test_targets_of_generated_code_have_their_names(cmake: str, expected: tuple[str, ...]) -> None:
    build = built(f"project(arm)\n{cmake}", msg__A_msg="int32 x", srv__S_srv="---")
    assert [c.arguments for c in build.commands if c.name == "add_dependencies"] == [expected]


def test_ament_auto_package_installs_headers_where_there_are_some() -> None:
    build = built("ament_auto_package()", include__arm__a_hpp="int a();")
    assert [(i.path, i.kind, i.destination) for i in build.installed] == [("arm/include", "directory", "include")]
    assert built("ament_auto_package()", src__a_hpp="int a();").installed == ()
