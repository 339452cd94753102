# SPDX-License-Identifier: Apache-2.0
"""Findings that are notes where nothing uses what they are about."""

from __future__ import annotations

from pathlib import Path

import pytest
from test_check_levels import CATKIN, CMAKE, ROS1, ROS2, levels

from haros_ci.api.testing import said
from haros_ci.checking.page import Example, filled
from haros_ci.registry import checks
from haros_ci.results.rule import Level

NODE = "import rclpy\nfrom std_srvs.srv import Trigger\nrclpy.init()\nnode = rclpy.create_node({0!r})\n{1}\nrclpy.spin(node)\n"
SERVER = NODE.format("server", "node.create_service(Trigger, 'reset', print)")
CLIENT = NODE.format("client", "node.create_client(Trigger, 'reset')")
TWO = '<node pkg="demo" exec="server.py" name="one"/><node pkg="demo" exec="server.py" name="two"/>'


@pytest.mark.parametrize(
    ("files", "expected"),
    [
        ({"all": TWO + '<node pkg="demo" exec="client.py"/>'}, Level.ERROR),
        ({"all": TWO, "other": '<node pkg="demo" exec="client.py"/>'}, Level.WARNING),
        ({"all": TWO, "other": '<executable cmd="ros2 service call /reset std_srvs/srv/Trigger"/>'}, Level.WARNING),
        ({"all": TWO}, Level.NOTE),
    ],
)
def test_two_servers(files: dict[str, str], expected: Level, tmp_path: Path) -> None:
    launches = {f"launch/{name}.launch.xml": f"<launch>{text}</launch>\n" for name, text in files.items()}
    code = {"server.py": SERVER} | (
        {"client.py": CLIENT} if any("client.py" in text for text in files.values()) else {}
    )
    assert levels("several-servers", filled(launches | code), tmp_path) == [expected]


HANDLER = "def handle(request, response):\n    {}\n    return response\n"


@pytest.mark.parametrize(
    ("name", "body", "words"),
    [
        ("reset", "if request.robot_id != NAME:\n        return response", "which may be that of the one that it is not for; remap it for one of them, or start them"),
        ("reset", "if NAME not in request.targets:\n        return response", "which may be that of the one that it is not for"),
        ("reset", "print(request.robot_id)", "both execute each request, and the client takes the first answer; remap"),
        ("reset", "if request.speed > 3:\n        return response", "both execute each request"),
        ("/reset", "print(request)", "or give it a relative name and start them in different namespaces"),
        ("reset", "print(request)", "first answer; remap it for one of them, or start them in different namespaces"),
    ],
)  # fmt: skip
def test_two_servers_that_look_whom_a_request_is_for(name: str, body: str, words: str, tmp_path: Path) -> None:
    made = HANDLER.format(body) + f"node.create_service(Trigger, {name!r}, handle)"
    files = {"launch/all.launch.xml": f"<launch>{TWO}</launch>\n", "server.py": NODE.format("server", made)}
    check = next(check for check in checks() if check.id == "several-servers")
    (result,) = said(check, Example("", True, filled(files)), tmp_path)
    assert words in result.message


RVIZ = '<launch><node pkg="rviz" type="rviz" name="rviz" args="-d $(find demo)/rviz/{}.rviz"/></launch>\n'


@pytest.mark.parametrize(
    ("installed", "expected"),
    [("scripts", Level.NOTE), ("launch", Level.WARNING)],
)
def test_a_directory_that_only_launch_files_need(installed: str, expected: Level, tmp_path: Path) -> None:
    install = f"install(DIRECTORY {installed} DESTINATION ${{CATKIN_PACKAGE_SHARE_DESTINATION}})\n"
    files = {
        "package.xml": ROS1,
        "CMakeLists.txt": CATKIN + install,
        "launch/a.launch": RVIZ.format("a"),
        "scripts/a.sh": "#!/bin/sh\ntrue\n",
        "rviz/a.rviz": "Panels: []\n",
    }
    assert levels("directory-not-installed", files, tmp_path) == [expected]


@pytest.mark.parametrize(
    ("is_installed", "expected"), [(True, [Level.WARNING, Level.WARNING]), (False, [Level.NOTE] * 2)]
)
def test_what_a_model_needs_that_is_not_installed(is_installed: bool, expected: list[Level], tmp_path: Path) -> None:
    install = "install(DIRECTORY {} DESTINATION ${{CATKIN_PACKAGE_SHARE_DESTINATION}})\n"
    files = {
        "package.xml": ROS1,
        "CMakeLists.txt": CATKIN + install.format("launch" if is_installed else "scripts"),
        "launch/a.launch": '<launch><param name="robot_description" textfile="$(find demo)/urdf/a.urdf"/></launch>\n',
        "scripts/a.sh": "#!/bin/sh\ntrue\n",
        "urdf/a.urdf": '<robot name="a"><link name="b"><visual><geometry><mesh filename="package://demo/meshes/b.dae"/></geometry>'
        "</visual></link></robot>\n",
        "meshes/b.dae": "<COLLADA/>\n",
    }
    assert levels("directory-not-installed", files, tmp_path) == expected


@pytest.mark.parametrize(
    ("program", "text", "is_made"),
    [
        ("src/a.cpp", 'void f(std::string d)\n{\n  std::ofstream file(fmt::format("{}/made.yaml", d));\n}\n', True),
        ("src/a.cpp", 'void f(std::string d)\n{\n  std::ofstream file(d + "/made.yaml");\n}\n', True),
        ("src/a.py", "def f(d):\n    with open(f'{d}/made.yaml', 'w') as file:\n        file.write('')\n", True),
        (
            "src/a.py",
            "import yaml\n\n\ndef f(d):\n    path = d / 'made.yaml'\n    yaml.dump({}, path.open('w'))\n",
            True,
        ),
        ("src/a.sh", "#!/bin/sh\necho a: 1 > config/made.yaml\n", True),
        ("src/a.sh", "#!/bin/sh\ncat config/made.yaml > /tmp/other\n", False),
        ("src/a.cpp", 'void f(std::string d)\n{\n  std::ifstream file(d + "/made.yaml");\n}\n', False),
        ("src/a.cpp", 'void f()\n{\n  std::ofstream o("other.yaml");\n  YAML::LoadFile("made.yaml");\n}\n', False),
        ("src/a.py", "def f(d):\n    # made.yaml\n    open('homemade.yaml', 'w').write('')\n", False),
        ("launch/b.launch.py", "def f(d):\n    open(d + '/made.yaml', 'w').write('')\n", False),
        ("src/a.py", "def f(d):\n    return yaml.safe_load(open('made.yaml'))\n", False),
    ],
)
@pytest.mark.parametrize(
    ("check", "tag"),
    [
        (
            "parameter-file-missing",
            '<node pkg="demo" exec="n"><param from="$(find-pkg-share demo)/config/made.yaml"/></node>',
        ),
        ("missing-launch-file", '<node pkg="demo" exec="n" args="$(find-pkg-share demo)/config/made.yaml"/>'),
    ],
)
def test_a_file_that_a_program_writes(
    check: str, tag: str, program: str, text: str, is_made: bool, tmp_path: Path
) -> None:
    files = {
        "package.xml": ROS2,
        "CMakeLists.txt": CMAKE.format("install(DIRECTORY launch config DESTINATION share/demo)"),
        "config/other.yaml": "/**:\n  ros__parameters:\n    a: 1\n",
        "launch/a.launch.xml": f"<launch>{tag}</launch>\n",
        program: text,
    }
    grave = Level.ERROR if check == "parameter-file-missing" else Level.WARNING
    assert levels(check, files, tmp_path) == [Level.NOTE if is_made else grave]
