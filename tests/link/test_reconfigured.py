# SPDX-License-Identifier: Apache-2.0
"""ROS 1: what a server of dynamic_reconfigure writes to the parameters of its .cfg file is not known, and says so."""

from __future__ import annotations

from typing import Any

import pytest
from follow_kit import CMAKE, cpp_files, follow, main, node, script

from haros_ci.model.architecture import Endpoint, Node

CFG = """#!/usr/bin/env python
from dynamic_reconfigure.parameter_generator_catkin import *
gen = ParameterGenerator()
gen.add("rate", double_t, 0, "", 5, 0, 10)
gen.add("free", double_t, 0, "", 2.5)
gen.add("on", bool_t, 0, "", True)
gen.add("frame", str_t, 0, "", "map")
gen.add("odd", int_t, 0, "", compute())
exit(gen.generate("p", "n", "X"))
"""
LAUNCH = '<launch><node pkg="p" type="{}" name="n">{}</node></launch>'
OPTIONS = "generate_dynamic_reconfigure_options(cfg/X.cfg)\n"
SERVER = "dynamic_reconfigure::Server<p::XConfig> server;"


def server(params: str = "") -> Node:
    files = cpp_files(main(SERVER, "#include <p/XConfig.h>\n"), LAUNCH.format("n", params))
    files["p/CMakeLists.txt"] += OPTIONS
    return node(follow(files | {"p/cfg/X.cfg": CFG}))


def python_server() -> Node:
    text = script(
        "from dynamic_reconfigure.server import Server\nfrom p.cfg import XConfig\nServer(XConfig, lambda c, level: c)\n"
    )
    files = {"p/CMakeLists.txt": CMAKE.format("p") + "catkin_install_python(PROGRAMS n.py)\n" + OPTIONS, "p/n.py": text}
    return node(follow(files | {"p/cfg/X.cfg": CFG, "p/l.launch": LAUNCH.format("n.py", "")}))


def values(found: Node, kind: str) -> dict[str, Any]:
    """The value of each endpoint of that kind, ``?`` where it is not known."""

    def value(end: Endpoint) -> Any:
        return "?" if any(unknown.field == "value" for unknown in end.unknowns) else end.value

    return {end.name.rpartition("/")[2]: value(end) for end in found.endpoints if end.kind == kind}


@pytest.mark.parametrize("made", [server, python_server])
def test_what_a_server_writes_is_not_known(made: Any) -> None:
    assert values(made(), "setters") == dict.fromkeys(("rate", "free", "on", "frame", "odd"), "?")


def test_what_a_node_writes_itself_is_known() -> None:
    files = cpp_files(main('nh.setParam("a", 3);'), LAUNCH.format("n", ""))
    assert values(node(follow(files)), "setters") == {"a": 3}


CALLBACK = """#include <p/XConfig.h>
ros::Publisher pub;
void changed(p::XConfig& config, uint32_t level) {
  ros::NodeHandle nh;
  if (config.%s) pub = nh.advertise<std_msgs::String>("then", 1); else pub = nh.advertise<std_msgs::String>("other", 1);
  pub = nh.advertise<std_msgs::String>(config.frame, 1);
}
"""


@pytest.mark.parametrize("test", ["on", "rate > 3", "on == true", "rate == 5"])
def test_what_a_callback_is_given_rules_nothing_out(test: str) -> None:
    """Switches are there to be changed; a text of the .cfg is known, as it mostly names something."""
    body = SERVER + " server.setCallback(changed); ros::spin();"
    files = cpp_files(main(body, CALLBACK % test), LAUNCH.format("n", ""))
    files["p/CMakeLists.txt"] += OPTIONS
    found = node(follow(files | {"p/cfg/X.cfg": CFG}))
    made = {end.name: end.is_ruled_out for end in found.endpoints if end.kind == "publishers"}
    assert made.get("/then") is False, made
    assert made.get("/other") is False, made
    assert "/map" in made


@pytest.mark.parametrize(
    ("statement", "name"),
    [
        ('new (&nh) ros::NodeHandle("~/a");', "/n/a/x"),
        ('new (&(nh)) ros::NodeHandle("b");', "/b/x"),
        ('new (&nh) ros::NodeHandle("a"); new (&nh) ros::NodeHandle("c");', "/c/x"),
        ("ros::NodeHandle* other = new (&nh) ros::NodeHandle; (void)other;", "/x"),
        ('new ros::NodeHandle("~/a");', "/x"),
        ('new (std::nothrow) ros::NodeHandle("~/a");', "/x"),
    ],
)
def test_what_is_made_in_the_place_of_a_variable(statement: str, name: str) -> None:
    files = cpp_files(main(f'{statement} auto pub = nh.advertise<std_msgs::String>("x", 1);'), LAUNCH.format("n", ""))
    found = node(follow(files))
    assert [end.name for end in found.endpoints if end.kind == "publishers"] == [name]
