# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import pytest
from in_memory import built, messages, workspace_of

from haros_ci.model.build import Build
from haros_ci.workspace.build import COMPONENT, builds

FILES = ("src/a.cpp", "src/deep/b.cpp", "src/c.cxx", "src/no.py", "node.cpp", "main.cpp")
MANIFEST = "<package format='3'><name>{}</name>{}<export><build_type>ament_cmake</build_type></export></package>"


def workspace_builds(**packages: str) -> dict[str, Build]:
    """The builds of packages, each by its CMake; a first line ``# depends a b`` is its manifest's."""
    files: dict[str, str] = {}
    for name, cmake in packages.items():
        head = cmake.partition("\n")[0]
        needed = head.split()[2:] if head.startswith("# depends") else []
        files[f"{name}/package.xml"] = MANIFEST.format(name, "".join(f"<depend>{n}</depend>" for n in needed))
        files[f"{name}/CMakeLists.txt"] = cmake
        files[f"{name}/a.cpp"] = files[f"{name}/b.cpp"] = "// code\n"
    return builds(workspace_of(files))


def links(build: Build) -> dict[str, list[str]]:
    return {target.name: list(target.links) for target in build.targets}


@pytest.mark.parametrize(
    ("cmake", "kind", "sources"),
    [
        ("ament_auto_add_library(t SHARED DIRECTORY src)", "library", ["src/a.cpp", "src/deep/b.cpp", "src/c.cxx"]),
        ("ament_auto_add_library(t DIRECTORY src/deep)", "library", ["src/deep/b.cpp"]),
        (
            "ament_auto_add_library(t DIRECTORY src node.cpp)",
            "library",
            ["node.cpp", "src/a.cpp", "src/deep/b.cpp", "src/c.cxx"],
        ),
        ("ament_auto_add_executable(t DIRECTORY src/deep)", "executable", ["src/deep/b.cpp"]),
        ("ament_auto_add_library(t INTERFACE)", "interface", []),
        ("ament_auto_add_library(t OBJECT node.cpp)", "object", ["node.cpp"]),
        ("ament_auto_add_library(t DIRECTORY ../other)", "library", []),
        ("ament_auto_add_library(t DIRECTORY ${NOT_KNOWN_HERE}/x)", "library", []),
    ],
)
def test_automatic_targets(cmake: str, kind: str, sources: list[str]) -> None:
    (target,) = built(cmake, *FILES).targets
    found = list(target.sources)
    assert (target.kind, found) == (kind, [f"arm/{path}" for path in sources])


def test_automatic_targets_are_linked_with_the_libraries_before_them() -> None:
    build = built(
        "ament_auto_add_library(one node.cpp)\nadd_library(plain node.cpp)\nament_auto_add_library(two INTERFACE)\n"
        "ament_auto_add_executable(exe main.cpp)\nament_auto_add_library(alone NO_TARGET_LINK_LIBRARIES node.cpp)\n"
        "ament_auto_package()\n",
        *FILES,
    )
    assert links(build) == {"one": [], "plain": [], "two": ["one"], "exe": ["one", "two"], "alone": []}
    assert [t.name for t in build.targets if t.is_installed] == ["one", "two", "exe", "alone"]


LIBRARY = "add_library(core a.cpp)\nadd_library(hidden b.cpp)\ninstall(TARGETS core EXPORT x)\n"


@pytest.mark.parametrize(
    ("cmake", "expected"),
    [
        ("add_library(t a.cpp)\nament_target_dependencies(t base)", ["base::core"]),
        (
            "add_library(t a.cpp)\nament_target_dependencies(t SYSTEM PUBLIC base rclcpp)",
            ["base::core", "${rclcpp_LIBRARIES}"],
        ),
        (
            "find_package(base REQUIRED)\nadd_library(t a.cpp)\ntarget_link_libraries(t ${base_LIBRARIES})",
            ["base::core"],
        ),
        ("find_package(base REQUIRED)\nadd_library(t a.cpp)\ntarget_link_libraries(t ${base_TARGETS})", ["base::core"]),
        ("add_library(t a.cpp)\ntarget_link_libraries(t PUBLIC base::core)", ["base::core"]),
        (
            "# depends base rclcpp\nament_auto_find_build_dependencies()\nament_auto_add_library(t a.cpp)",
            ["base::core"],
        ),
        ("# depends base rclcpp\nautoware_package()\nament_auto_add_library(t a.cpp)", ["base::core"]),
        ("# depends base\nament_auto_add_library(t a.cpp)", []),
        ("add_library(t a.cpp)\ntarget_link_libraries(t ${other_LIBRARIES})", []),
        ("add_library(t a.cpp)\nament_target_dependencies(other base)", []),
        ("add_library(t a.cpp)\nament_target_dependencies(t messages)", ["${messages_LIBRARIES}"]),
    ],
)
def test_links_lead_to_the_libraries_that_other_packages_install(cmake: str, expected: list[str]) -> None:
    found = workspace_builds(base=LIBRARY, messages="", user=cmake)
    assert links(found["user"])["t"] == expected


def test_a_summary_gives_way_to_a_definition_in_the_workspace() -> None:
    helper = "ament_auto_package(CONFIG_EXTRAS helper-extras.cmake)\n"
    extras = "macro(autoware_package)\nadd_library(made ${CMAKE_CURRENT_SOURCE_DIR}/a.cpp)\nendmacro()\n"
    files = {
        "helper/package.xml": MANIFEST.format("helper", ""),
        "helper/CMakeLists.txt": helper,
        "helper/helper-extras.cmake": extras,
        "user/package.xml": MANIFEST.format("user", ""),
        "user/CMakeLists.txt": "find_package(helper REQUIRED)\nautoware_package()\n",
        "user/a.cpp": "// code\n",
    }
    assert [t.name for t in builds(workspace_of(files))["user"].targets] == ["made"]


COMPONENTS = """\
add_library(lib node.cpp)
rclcpp_components_register_node(lib PLUGIN "arm::Talker" EXECUTABLE talker)
rclcpp_components_register_nodes(lib arm::A arm::B)
rclcpp_components_register_node(lib PLUGIN "arm::C" EXECUTABLE c EXECUTOR MultiThreadedExecutor)
"""


def test_components_lead_to_class_library_and_files() -> None:
    build = built(COMPONENTS, *FILES)
    assert [(p.name, p.base, p.library) for p in build.plugins] == [
        (name, COMPONENT, "lib") for name in ("arm::Talker", "arm::A", "arm::B", "arm::C")
    ]
    assert [(t.name, t.component, t.links, t.is_installed) for t in build.targets if t.component] == [
        ("talker", "arm::Talker", ("lib",), True),
        ("c", "arm::C", ("lib",), True),
    ]


@pytest.mark.parametrize(
    ("cmake", "expected"),
    [
        ("generate_parameter_library(p src/p.yaml)", [("p", "arm/src/p.yaml", "cpp")]),
        ("generate_parameter_library(${PROJECT_NAME}_p src/p.yaml check.hpp)", [("arm_p", "arm/src/p.yaml", "cpp")]),
        ("generate_parameter_module(p src/p.yaml arm.check)", [("p", "arm/src/p.yaml", "python")]),
    ],
)
def test_parameter_libraries(cmake: str, expected: list[tuple[str, str, str]]) -> None:
    build = built(f"project(arm)\n{cmake}", src__p_yaml="arm:\n  a: {type: int}\n")
    assert [(p.name, p.path, p.language) for p in build.parameter_libraries] == expected
    assert [(p.package, p.location.path, p.location.line) for p in build.parameter_libraries] == [
        ("arm", "arm/CMakeLists.txt", 2)
    ]
    assert [(t.name, t.kind) for t in build.targets] == [(expected[0][0], "interface")]
    assert build.problems == ()


@pytest.mark.parametrize(
    ("cmake", "said"),
    [
        (
            "generate_parameter_library(p gone.yaml)",
            "p: the parameters in gone.yaml are not among the files; they are missing",
        ),
        (
            "generate_parameter_library(p ../../p.yaml)",
            "p: the parameters in ../../p.yaml are not among the files; they are missing",
        ),
        (
            "find_package(x)\ngenerate_parameter_library(p ${x_DIR}/p.yaml)",
            "p: the parameters in ${x_DIR}/p.yaml are only known in a build; they are missing",
        ),
    ],
)
def test_parameter_libraries_that_are_not_there(cmake: str, said: str) -> None:
    build = built(cmake)
    assert build.parameter_libraries == ()
    assert [message for _, message in messages(build)] == [said]


def test_a_parameter_library_without_a_file_is_none() -> None:
    build = built("generate_parameter_library(p)\ngenerate_parameter_library()")
    assert (build.parameter_libraries, build.targets, build.problems) == ((), (), ())


def test_definitions_in_idl_are_known_by_name() -> None:
    build = built(
        'rosidl_generate_interfaces(arm "msg/A.idl" "srv/B.idl" "action/C.idl" msg/D.msg)',
        msg__A_idl="module arm { module msg { struct A { int32 x; }; }; };\n",
        srv__B_idl="module x {};",
        action__C_idl="module x {};",
        msg__D_msg='int32[<=3] a [1, 2]\nstring<=5 b "x"\nint32 C=3\n',
    )
    assert [(i.name, i.kind, len(i.sections), i.is_generated) for i in build.interfaces] == [
        ("arm/C", "action", 3, True),
        ("arm/A", "msg", 1, True),
        ("arm/D", "msg", 1, True),
        ("arm/B", "srv", 2, True),
    ]
    assert build.problems == ()


@pytest.mark.parametrize(
    ("cmake", "expected"),
    [
        ("install(DIRECTORY launch DESTINATION share/${PROJECT_NAME}/)", ["share/arm/launch"]),
        ("install(DIRECTORY launch/ DESTINATION share//${PROJECT_NAME}/)", ["share/arm"]),
        (
            "install(DIRECTORY launch config DESTINATION share/${PROJECT_NAME})",
            ["share/arm/launch", "share/arm/config"],
        ),
        ("install(FILES a.yaml DESTINATION share/${PROJECT_NAME}/)", ["share/arm"]),
        ("ament_auto_package(INSTALL_TO_SHARE launch config)", ["share/arm/launch", "share/arm/config"]),
        ("autoware_ament_auto_package(INSTALL_TO_SHARE launch)", ["share/arm/launch"]),
    ],
)
def test_destinations(cmake: str, expected: list[str]) -> None:
    build = built(f"project(arm)\n{cmake}", "launch/a.launch.py", "config/b.yaml", "a.yaml")
    assert [each.destination for each in build.installed] == expected


@pytest.mark.parametrize(
    ("cmake", "classes", "said"),
    [
        ('rclcpp_components_register_node(lib PLUGIN "a::B" EXECUTABLE b EXECUTOR ${x_EXECUTOR})', ["a::B"], []),
        (
            'rclcpp_components_register_node(lib PLUGIN "${x_CLASS}" EXECUTABLE b)',
            [],
            ["rclcpp_components_register_node: ${x_CLASS} is only known in a build; the component is missing"],
        ),
        (
            "rclcpp_components_register_nodes(lib ${x_CLASS})",
            [],
            ["rclcpp_components_register_nodes: ${x_CLASS} is only known in a build; the component is missing"],
        ),
        ("rclcpp_components_register_nodes()", [], []),
    ],
)
def test_components_that_only_a_build_knows(cmake: str, classes: list[str], said: list[str]) -> None:
    build = built(f"find_package(x)\nadd_library(lib node.cpp)\n{cmake}", *FILES)
    assert [plugin.name for plugin in build.plugins] == classes
    assert [message for _, message in messages(build)] == said
