# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from pathlib import Path

from git_histories import manifest, plant
from in_memory import MANIFEST, built, messages, workspace_of

from haros_ci.model.build import Build
from haros_ci.workspace.build import build_of, builds
from haros_ci.workspace.discover import discover

CFG = """#!/usr/bin/env python
from dynamic_reconfigure.parameter_generator_catkin import *
gen = ParameterGenerator()
gen.add("rate", double_t, 0, "Hz", 10.0, 1.0, 100.0)
exit(gen.generate("arm", "arm", "Arm"))
"""


def test_a_package_on_disk(tmp_path: Path) -> None:
    cmake = b"""cmake_minimum_required(VERSION 3.0.2)
project(arm)
find_package(catkin REQUIRED COMPONENTS roscpp dynamic_reconfigure message_generation)
add_message_files(FILES State.msg)
generate_messages(DEPENDENCIES std_msgs)
generate_dynamic_reconfigure_options(cfg/Arm.cfg)
catkin_package(LIBRARIES ${PROJECT_NAME})
add_library(${PROJECT_NAME} src/arm.cpp)
add_executable(${PROJECT_NAME}_node src/main.cpp)
target_link_libraries(${PROJECT_NAME}_node ${PROJECT_NAME} ${catkin_LIBRARIES})
catkin_install_python(PROGRAMS scripts/tool.py DESTINATION ${CATKIN_PACKAGE_BIN_DESTINATION})
"""
    files = {"package.xml": manifest("arm"), "CMakeLists.txt": cmake, "msg/State.msg": b"Header header\n"}
    files |= {"cfg/Arm.cfg": CFG.encode(), "scripts/tool.py": b"pass\n", "scripts/other": b"#!/usr/bin/python\n"}
    files |= {"src/arm.cpp": b"", "src/main.cpp": b"int main() {}\n"}
    workspace = discover(plant(tmp_path, {f"ws/arm/{path}": data for path, data in files.items()}), (".",))
    assert {file.path: file.language for file in workspace.files}["ws/arm/cfg/Arm.cfg"] == "setup"
    build = builds(workspace)["arm"]
    assert [(t.name, t.kind, t.sources, t.links) for t in build.targets] == [
        ("arm", "library", ("ws/arm/src/arm.cpp",), ()),
        ("arm_node", "executable", ("ws/arm/src/main.cpp",), ("arm", "${catkin_LIBRARIES}")),
    ]
    assert [(c.name, c.path, [p.name for p in c.parameters]) for c in build.configs] == [
        ("Arm", "ws/arm/cfg/Arm.cfg", ["rate"])
    ]
    assert [(i.name, i.path) for i in build.interfaces] == [("arm/State", "ws/arm/msg/State.msg")]
    assert build.scripts == ("ws/arm/scripts/other", "ws/arm/scripts/tool.py")
    assert build.problems == ()


def test_scripts() -> None:
    python = "#!/usr/bin/env python3\n"
    build = built(
        "install(PROGRAMS nodes/plain.py nodes/run.sh DESTINATION lib/arm)",
        "nodes/run.sh",
        nodes__plain_py="x = 1\n",
        nodes__talker_py=python,
        nodes__old_py="#!/usr/bin/python2.7\n",
        src__arm__library_py="x = 1\n",
        setup_py=f"{python}setup()\n",
        launch__a_launch_py="#!/bin/sh python-like\n",
    )
    assert build.scripts == ("arm/nodes/old.py", "arm/nodes/plain.py", "arm/nodes/talker.py")


def test_roots_of_setup_and_cmake_are_joined() -> None:
    build = built("catkin_python_setup()", setup_py="setup(package_dir={'': 'src'})")
    assert build.python_roots == (("", "arm/src"),)
    assert built("project(arm)").python_roots == ()


def test_a_package_without_cmake() -> None:
    workspace = workspace_of({"package.xml": MANIFEST.format("arm"), "msg/A.msg": "int32 x"})
    build = build_of(workspace, workspace.packages[0])
    assert build.targets == () and build.problems == ()
    assert [interface.name for interface in build.interfaces] == ["arm/A"]


def test_files_of_inner_packages_are_not_ours() -> None:
    workspace = workspace_of(
        {
            "package.xml": MANIFEST.format("outer"),
            "inner/package.xml": MANIFEST.format("inner"),
            "inner/msg/A.msg": "int32 x",
            "inner/tool.py": "#!/usr/bin/env python\n",
            "inner/src/inner/__init__.py": "#!/usr/bin/env python\n",
        }
    )
    found = builds(workspace)
    assert found["outer"] == Build(package="outer")
    assert found["inner"].scripts == ("inner/tool.py",)


def test_two_packages_of_one_name() -> None:
    files = {f"{place}/package.xml": MANIFEST.format("arm") for place in "ab"}
    files |= {"a/CMakeLists.txt": "add_library(x x.cpp)", "a/x.cpp": "", "b/msg/A.msg": "int32 x"}
    found = builds(workspace_of(files | {"a/x.cpp": "int x;"}))
    assert [t.name for t in found["arm"].targets] == ["x"] and found["arm"].interfaces == ()


def test_problems_of_every_kind_are_gathered() -> None:
    build = built(
        "generate_dynamic_reconfigure_options(cfg/Gone.cfg cfg/Bad.cfg)",
        cfg__Bad_cfg="gen = (",
        msg__A_msg="nonsense",
        setup_py="setup(",
    )
    assert [(p.path, p.line) for p in build.problems] == [
        ("arm/CMakeLists.txt", 1),
        ("arm/cfg/Bad.cfg", None),
        ("arm/msg/A.msg", 1),
        ("arm/setup.py", None),
    ]
    assert messages(build)[0] == (1, "arm/cfg/Gone.cfg is not in the workspace; its parameters are missing")
