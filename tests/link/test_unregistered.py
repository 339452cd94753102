# SPDX-License-Identifier: Apache-2.0
"""Python programs of ROS 1 without ``rospy.init_node``: rospy registers nothing of them."""

from __future__ import annotations

import pytest
from follow_kit import PYTHON_HEAD, Node, follow, names, node, only, python_files

SUBSCRIBE = 'rospy.Subscriber("x", String)\nrospy.Publisher("y", String, queue_size=1)\n'
LAUNCH = '<launch><node pkg="p" type="n.py" name="me"/></launch>'


def launched(code: str, **modules: str) -> Node:
    return node(follow(python_files(PYTHON_HEAD + code, LAUNCH, **modules)))


#: Nothing calls it: there are no topics.
NEVER = (
    SUBSCRIBE,
    f"def main():\n    {SUBSCRIBE.splitlines()[0]}\n    rospy.spin()\nif __name__ == '__main__':\n    main()\n",
    f"import os, sys, numpy as np\nfrom geometry_msgs.msg import *\nimport tf\n{SUBSCRIBE}",
    f"from lib.part import T\n{SUBSCRIBE}",
    'import actionlib\nfrom p.msg import DoAction\nactionlib.SimpleActionServer("do", DoAction)\nrospy.Service("s", E, None)\n',
)


@pytest.mark.parametrize("code", NEVER)
def test_what_is_never_registered_is_not_there(code: str) -> None:
    found = launched(code, part="T = 1\n")
    assert [end for end in found.endpoints if end.kind not in ("getters", "setters", "clients")] == []


def test_a_program_that_makes_nothing_else_is_no_node() -> None:
    assert follow(python_files(PYTHON_HEAD + SUBSCRIBE)).configurations == ()


def test_parameters_and_calls_of_services_need_no_name() -> None:
    code = 'rospy.set_param("a", 1)\nrospy.get_param("b", 2)\nrospy.ServiceProxy("c", E)\n' + SUBSCRIBE
    found = launched(code)
    kinds = ("setters", "getters", "clients", "publishers", "subscribers")
    assert [names(found, kind) for kind in kinds] == [["/a"], ["/b"], ["/c"], [], []]


def test_a_module_of_another_program_is_none_itself() -> None:
    files = python_files(f'{PYTHON_HEAD}from lib.part import run\nrospy.init_node("n")\nrun()\n')
    files["p/src/lib/part.py"] = f"{PYTHON_HEAD}def run():\n    rospy.Subscriber('x', String)\n"
    files["p/scripts/part.py"] = (
        f"{PYTHON_HEAD}def run():\n    rospy.Subscriber('x', String)\nrospy.Subscriber('z', String)\n"
    )
    files["p/CMakeLists.txt"] += "catkin_install_python(PROGRAMS scripts/part.py)\n"
    assert [each.name for each in only(follow(files)).nodes] == ["/n"]


#: It is called somewhere, or may be: the topics stay.
STAYS = (
    ('rospy.init_node("m")\n' + SUBSCRIBE, False),
    (SUBSCRIBE + 'rospy.init_node("m")\n', False),
    (f"try:\n    rospy.init_node('m')\nexcept rospy.ROSException:\n    pass\n{SUBSCRIBE}", False),
    (f"import sys\nif len(sys.argv) > 9:\n    rospy.init_node('m')\n{SUBSCRIBE}", False),
    (f"from rospy import init_node\ninit_node('m')\n{SUBSCRIBE}", False),
    (f"from rospy import init_node as begin\nbegin('m')\n{SUBSCRIBE}", False),
    (f"from lib.part import begin\nbegin()\n{SUBSCRIBE}", False),
    (f"import somewhere\nsomewhere.begin()\n{SUBSCRIBE}", True),
    (f"from somewhere.nodes import Base\nclass A(Base):\n    pass\nA()\n{SUBSCRIBE}", True),
    (f"import importlib\nimportlib.import_module('lib.part')\n{SUBSCRIBE}", True),
    (f"def never():\n    rospy.init_node('m')\n{SUBSCRIBE}", True),
)


@pytest.mark.parametrize(("code", "is_doubted"), STAYS)
def test_what_may_be_registered_stays(code: str, is_doubted: bool) -> None:
    found = launched(code, part="import rospy\ndef begin():\n    rospy.init_node('m')\n")
    assert (names(found, "subscribers"), names(found)) == (["/x"], ["/y"])
    doubts = {unknown.field for end in found.endpoints for unknown in end.unknowns}
    assert ("conditions" in doubts) == is_doubted
