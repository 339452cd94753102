# SPDX-License-Identifier: Apache-2.0
"""Small ROS 1 workspaces in memory, followed to their architecture, and short views of what their nodes make."""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import pytest

from haros_ci.analysis.architecture import architecture
from haros_ci.config.settings import Settings
from haros_ci.model.architecture import Architecture, Configuration, Endpoint, Node
from haros_ci.model.package import Package, SourceFile
from haros_ci.model.workspace import Workspace
from haros_ci.workspace.language import language_of

CPP_HEAD = "#include <ros/ros.h>\n#include <std_msgs/String.h>\n"
CPP_MAIN = 'int main(int argc, char** argv) {\nros::init(argc, argv, "n");\nros::NodeHandle nh;\n%s\nros::spin();\n}\n'
PYTHON_HEAD = "#!/usr/bin/env python\nimport rospy\nfrom std_msgs.msg import String\n"
PYTHON_INIT = 'rospy.init_node("n")\n'
CMAKE = "cmake_minimum_required(VERSION 3.0)\nproject({})\nfind_package(catkin REQUIRED)\ncatkin_package()\n"
PUBLISH = "nh.advertise<std_msgs::String>("


@dataclass(frozen=True)
class Texts:
    texts: Mapping[str, str]

    def text(self, path: str) -> str:
        return self.texts.get(path, "")


class Nothing:
    """A cache that keeps nothing."""

    def get(self, group: str, path: str, key: str) -> None:
        return None

    def put(self, group: str, path: str, key: str, value: object) -> None:
        return None

    def get_text(self, group: str, path: str, key: str) -> None:
        return None

    def put_text(self, group: str, path: str, key: str, text: str) -> None:
        return None


def workspace(texts: Mapping[str, str], ros: int | None = None) -> Workspace:
    """The workspace with these files; every first directory is a package, of the ROS version *ros*."""
    packages = {path.partition("/")[0] for path in texts}
    whole = {f"{p}/package.xml": f"<package><name>{p}</name></package>" for p in packages} | dict(texts)
    files = []
    for path, text in sorted(whole.items()):
        language = language_of(path.rpartition("/")[2]) or ("python" if text.startswith("#!") else None)
        if language is not None:
            files.append(SourceFile(path, language, len(text), "", path.partition("/")[0]))
    return Workspace(
        Path("/nowhere"), tuple(Package(p, p, ros=ros) for p in sorted(packages)), tuple(files), Texts(whole)
    )


def follow(texts: Mapping[str, str], ros: int | None = None) -> Architecture:
    """The architecture of the workspace with these files, without what is known of nodes from elsewhere."""
    settings = Settings(root=Path("/nowhere"))
    return architecture(workspace(texts, ros), settings, Nothing(), environment={}, known_nodes=False)


def cpp_files(text: str, launch: str = "", **others: str) -> dict[str, str]:
    """The package ``p`` with one executable ``n`` of *text*; *others* are headers and sources, ``__`` for a dot."""
    more = {f"p/src/{name.replace('__', '.')}": content for name, content in others.items()}
    sources = " ".join(path[2:] for path in ("p/src/main.cpp", *more) if path.endswith(".cpp"))
    cmake = CMAKE.format("p") + f"include_directories(src)\nadd_executable(n {sources})\n"
    files = {"p/CMakeLists.txt": cmake, "p/src/main.cpp": text, **more}
    return files | ({"p/launch/l.launch": launch} if launch else {})


def python_files(text: str, launch: str = "", **modules: str) -> dict[str, str]:
    """The package ``p`` with one script ``n.py`` of *text*; *modules* are those of its Python package ``lib``."""
    files = {
        "p/CMakeLists.txt": CMAKE.format("p") + "catkin_python_setup()\ncatkin_install_python(PROGRAMS scripts/n.py)\n",
        "p/setup.py": "from distutils.core import setup\nsetup(packages=['lib'], package_dir={'': 'src'})\n",
        "p/src/lib/__init__.py": "",
        "p/scripts/n.py": text,
    }
    files |= {f"p/src/lib/{name}.py": content for name, content in modules.items()}
    return files | ({"p/launch/l.launch": launch} if launch else {})


def main(body: str, before: str = "") -> str:
    """A C++ program; ``ADV(`` stands for the call that advertises a string on the handle ``nh``."""
    return (CPP_HEAD + before + "\n" + CPP_MAIN % body).replace("ADV(", PUBLISH)


def script(body: str) -> str:
    """A rospy program; ``PUB(x)`` is ``rospy.Publisher(x, String, queue_size=1)`` for an *x* without calls."""
    return PYTHON_HEAD + PYTHON_INIT + body.replace("PUB(", "rospy.Publisher(data_class=String, queue_size=1, name=")


def only(found: Architecture) -> Configuration:
    assert len(found.configurations) == 1, [configuration.name for configuration in found.configurations]
    return found.configurations[0]


def node(found: Architecture, name: str | None = None) -> Node:
    nodes = [each for each in only(found).nodes if name is None or each.name == name]
    assert len(nodes) == 1, [each.name for each in only(found).nodes]
    return nodes[0]


def cpp(body: str, before: str = "", launch: str = "", **others: str) -> Node:
    """The only node of a package whose executable has this in ``main``."""
    return node(follow(cpp_files(main(body, before), launch, **others)))


def python(body: str, launch: str = "", **modules: str) -> Node:
    """The only node of a package whose script is this."""
    return node(follow(python_files(script(body), launch, **modules)))


ROS2_CMAKE = "cmake_minimum_required(VERSION 3.8)\nproject({})\nfind_package(ament_cmake_auto REQUIRED)\n"
ROS2_HEAD = (
    "#include <rclcpp/rclcpp.hpp>\n#include <std_msgs/msg/string.hpp>\n"
    "using std_msgs::msg::String;\nusing namespace std::chrono_literals;\n"
)
ROS2_NODE = (
    'class N : public rclcpp::Node {\npublic:\nexplicit N(const rclcpp::NodeOptions & options)\n: Node("n", options)'
    "{\n%s\n}\n%s\n};\n"
)


def ros2_files(text: str, launch: Mapping[str, str] | None = None, **others: str) -> dict[str, str]:
    """The package ``p`` whose library has the component ``N`` of *text*, with the executable ``n``.

    *launch* are launch files by name, *others* are headers and sources, ``__`` for a dot.
    """
    more = {f"p/src/{name.replace('__', '.')}": content for name, content in others.items()}
    sources = " ".join(path[2:] for path in ("p/src/n.cpp", *more) if path.endswith(".cpp"))
    cmake = ROS2_CMAKE.format("p") + (
        f"ament_auto_add_library(n_lib SHARED {sources})\n"
        'rclcpp_components_register_node(n_lib PLUGIN "N" EXECUTABLE n)\nament_auto_package(INSTALL_TO_SHARE launch)\n'
    )
    files = {"p/CMakeLists.txt": cmake, "p/src/n.cpp": text, **more}
    return files | {f"p/launch/{name}": content for name, content in (launch or {}).items()}


def ros2_cpp(body: str, members: str = "", before: str = "", **others: str) -> Configuration:
    """The only configuration of a component with this in its constructor and class."""
    return only(follow(ros2_files(ROS2_HEAD + before + ROS2_NODE % (body, members), **others), 2))


def ros2_main(body: str, before: str = "", **others: str) -> Configuration:
    """The only configuration of a program with this in ``main``, after ``rclcpp::init``."""
    more = {f"p/src/{name.replace('__', '.')}": content for name, content in others.items()}
    sources = " ".join(path[2:] for path in ("p/src/n.cpp", *more) if path.endswith(".cpp"))
    text = f"{ROS2_HEAD}{before}\nint main(int argc, char ** argv) {{\nrclcpp::init(argc, argv);\n{body}\n}}\n"
    cmake = ROS2_CMAKE.format("p") + f"ament_auto_add_executable(n {sources})\nament_auto_package()\n"
    return only(follow({"p/CMakeLists.txt": cmake, "p/src/n.cpp": text, **more}, 2))


def explicit(found: Node, kind: str = "publishers") -> list[Endpoint]:
    """The endpoints of a ROS 2 node that its own code makes."""
    return [end for end in ends(found, kind) if not end.implicit]


def ends(found: Node, kind: str = "publishers") -> list[Endpoint]:
    return [end for end in found.endpoints if end.kind == kind]


def names(found: Node, kind: str = "publishers") -> list[str]:
    """Sorted names; ``?`` stands for what is not known."""
    return sorted(end.name for end in ends(found, kind))


def types(found: Node, kind: str = "publishers") -> list[tuple[str, str | None]]:
    return sorted((end.name, end.type) for end in ends(found, kind))


def conditions(end: Endpoint) -> list[tuple[str, str, int | None, int | None]]:
    """Statement, text, line and column of each condition, outermost first."""
    return [(c.statement, c.condition, c.location.line, c.location.column) for c in end.conditions]


def well_formed(found: Node) -> None:
    """Whatever is not known has its reason, and only that."""
    for end in found.endpoints:
        fields = {unknown.field for unknown in end.unknowns}
        assert ("?" in end.original_name) == ("name" in fields), end
        assert all(unknown.reason for unknown in end.unknowns), end


def case(name: str, code: str, *expected: str, before: str = "") -> Any:
    """A row of a table: its name, code before ``main``, code, names."""
    return name, before, code, sorted(expected)


def table(rows: Iterable[Any], defects: Mapping[str, str] | None = None) -> Any:
    """Parametrise by *rows*; *defects* are why a row does not hold yet, by its name."""
    why = defects or {}
    made = []
    for name, *values in rows:
        marks = (pytest.mark.xfail(strict=True, reason=why[name]),) if name in why else ()
        made.append(pytest.param(*values, id=name, marks=marks))
    return pytest.mark.parametrize(("before", "code", "expected"), made)


def because(why: str, *rows: str) -> dict[str, str]:
    """The same reason for each of *rows*."""
    return dict.fromkeys(rows, why)


def admits(found: Sequence[str], expected: Sequence[str]) -> bool:
    """Whether each name found allows what is expected of it: all of ``/a|/b``, or that text itself.

    ``?`` is any text; what stands before the first one is the namespace of a name that may be absolute.
    """
    return len(found) == len(expected) and all(
        name == truth or all(_allows(name, each) for each in truth.split("|"))
        for name, truth in zip(found, expected, strict=True)
    )


def _allows(name: str, truth: str) -> bool:
    first, *rest = name.split("?")
    if not rest:
        return name == truth
    start = f"(?:{re.escape(first)})?" if first.endswith("/") else re.escape(first)
    return re.fullmatch(start + "".join(".*" + re.escape(piece.lstrip("/")) for piece in rest), truth) is not None
