# SPDX-License-Identifier: Apache-2.0
"""ROS 1: the name of a node that no launch file starts: what it gives itself, or why that is not known."""

from __future__ import annotations

import pytest

from haros_ci.follow.ros.own_name import ANONYMOUS, NOT_SEEN, PERHAPS_ANONYMOUS
from haros_ci.model.architecture import Node
from haros_ci.model.running import as_running
from tests.link.follow_kit import CPP_HEAD, PYTHON_HEAD, cpp_files, follow, names, node, only, python_files

BODY = 'ros::NodeHandle own("~"), other; own.advertise<std_msgs::String>("x", 1); other.advertise<std_msgs::String>("y", 1);'
PYTHON_BODY = "rospy.Publisher('~x', String, queue_size=1)\nrospy.Publisher('y', String, queue_size=1)\n"
ARGUMENT, ONE_OF = "there is no element 1: the list has 1", "it may be one of 'a', 'b'"


def cpp_node(init: str, before: str = "", launch: str = "") -> Node:
    text = f"{CPP_HEAD}{before}\nint main(int argc, char** argv) {{\n{init}\n{BODY}\nros::spin();\n}}\n"
    return node(follow(cpp_files(text, launch)))


def python_node(init: str, launch: str = "") -> Node:
    return node(follow(python_files(f"{PYTHON_HEAD}import sys\n{init}\n{PYTHON_BODY}", launch)))


def own(found: Node) -> list[str]:
    return [unknown.reason for unknown in found.unknowns if unknown.field == "name"]


DEFINED = """#ifdef WITH_A
const std::string own_name("a");
#elif defined(WITH_B)
const std::string own_name("b");
#endif"""
UNKNOWN = [
    ("ros::init(argc, argv, argv[1]);", "", "/?", ARGUMENT),
    ("ros::init(argc, argv, own_name);", DEFINED, "/?", ONE_OF),
    ('#ifdef A\nros::init(argc, argv, "a");\n#else\nros::init(argc, argv, "b");\n#endif', "", "/?", ONE_OF),
    ('if (f()) ros::init(argc, argv, "a"); else ros::init(argc, argv, "b");', "", "/?", ONE_OF),
    ('if (f()) { ros::init(argc, argv, "a"); } ros::init(argc, argv, "b");', "", "/?", ONE_OF),
    ('std::string s = "a"; if (f()) s = "b"; ros::init(argc, argv, s);', "", "/?", ONE_OF),
    ('ros::init(argc, argv, std::string("a_") + argv[1]);', "", "/a_?", ARGUMENT),
    ('ros::init(argc, argv, "a", other_flags());', "", "/a?", PERHAPS_ANONYMOUS),
    ("start(argc, argv);", "void start(int, char**);", "/?", NOT_SEEN),
]


@pytest.mark.parametrize(("init", "before", "expected", "reason"), UNKNOWN)
def test_the_reason_is_given_where_a_node_has_no_name_that_is_known(
    init: str, before: str, expected: str, reason: str
) -> None:
    found = cpp_node(init, before)
    assert (found.name, found.process, own(found)) == (expected, expected, [reason])
    assert names(found) == sorted([f"{expected}/x", "/y"])
    assert [u.reason.partition(": ")[2] for end in found.endpoints for u in end.unknowns if u.field == "name"] == [
        reason
    ]


KNOWN = [
    ('ros::init(argc, argv, "a");', "", "/a"),
    ('ros::init(argc, argv, "n");', "", "/n"),
    ('const char* s = "a"; ros::init(argc, argv, s);', "", "/a"),
    ('std::string s = "a"; if (f()) s = "a"; ros::init(argc, argv, s);', "", "/a"),
    ('ros::init(argc, argv, "a"); ros::init(argc, argv, "b");', "", "/a"),
    ('ros::init(argc, argv, "a"); if (f()) ros::init(argc, argv, "b");', "", "/a"),
    ('if (f()) { ros::init(argc, argv, "a"); if (g()) ros::init(argc, argv, "b"); }', "", "/a"),
    ('if (f()) ros::init(argc, argv, "a"); else ros::init(argc, argv, "a");', "", "/a"),
    ('if (f()) return 1; ros::init(argc, argv, "a");', "", "/a"),
    ('if (argc > 1) ros::init(argc, argv, argv[1]); else ros::init(argc, argv, "a");', "", "/a"),
    ('if (argc < 2) return 1; ros::init(argc, argv, "a");', "", "/a"),
    ('#ifdef A\nros::init(argc, argv, "a");\n#endif', "", "/a"),
    ("ros::init(argc, argv, own_name);", 'const std::string own_name("a");', "/a"),
    ('ros::init(argc, argv, "a", ros::init_options::NoSigintHandler);', "", "/a"),
    ('ros::init(argc, argv, "a", 1);', "", "/a"),
    ("start(argc, argv);", 'void start(int argc, char** argv) { ros::init(argc, argv, "a"); }', "/a"),
]


@pytest.mark.parametrize(("init", "before", "expected"), KNOWN)
def test_a_node_has_the_name_that_it_gives_itself(init: str, before: str, expected: str) -> None:
    found = cpp_node(init, before)
    assert (found.name, own(found), names(found)) == (expected, [], sorted([f"{expected}/x", "/y"]))


@pytest.mark.parametrize("flags", ["ros::init_options::AnonymousName", "2", "3"])
def test_an_anonymous_node_keeps_the_part_that_is_known(flags: str) -> None:
    found = cpp_node(f'ros::init(argc, argv, "a", {flags});')
    assert (found.name, own(found)) == ("/a_?", [])
    assert ANONYMOUS in [unknown.reason for end in found.endpoints for unknown in end.unknowns]


PYTHON = [
    ("rospy.init_node(sys.argv[1])", "/?", [ARGUMENT]),
    ("rospy.init_node('a' if f() else 'b')", "/?", [ONE_OF]),
    ("if f():\n    rospy.init_node('a')\nelse:\n    rospy.init_node('b')", "/?", [ONE_OF]),
    ("rospy.init_node('a_%s' % f())", "/a_?", None),
    ("rospy.init_node('a', anonymous=f())", "/a?", [PERHAPS_ANONYMOUS]),
    ("import elsewhere\nelsewhere.start()", "/?", [NOT_SEEN]),
    ("rospy.init_node('a')", "/a", []),
    ("rospy.init_node(name='a')", "/a", []),
    ("rospy.init_node('a', anonymous=True)", "/a_?", []),
    ("rospy.init_node('a', anonymous=False)", "/a", []),
    ("rospy.init_node('a', disable_signals=True)", "/a", []),
    ("try:\n    rospy.init_node('a')\nexcept rospy.ROSException:\n    pass", "/a", []),
    ("rospy.init_node('a')\nif f():\n    rospy.init_node('b')", "/a", []),
]


@pytest.mark.parametrize(("init", "expected", "reasons"), PYTHON)
def test_the_same_of_programs_in_python(init: str, expected: str, reasons: list[str] | None) -> None:
    found = python_node(init)
    assert found.name == expected and names(found) == sorted([f"{expected}/x", "/y"])
    assert own(found) == reasons if reasons is not None else own(found)


LAUNCH = '<launch><node pkg="p" type="{}" name="me"/></launch>'


@pytest.mark.parametrize("init", [init for init, before, *_ in UNKNOWN if not before and '"a_"' not in init])
def test_a_launch_file_gives_the_name(init: str) -> None:
    found = cpp_node(init, launch=LAUNCH.format("n"))
    assert (found.name, own(found), names(found)) == ("/me", [], ["/me/x", "/y"])


def test_a_launch_file_gives_the_name_of_a_script() -> None:
    found = python_node("rospy.init_node(sys.argv[1])", LAUNCH.format("n.py"))
    assert (found.name, own(found), names(found)) == ("/me", [], ["/me/x", "/y"])


@pytest.mark.parametrize("text", ["int main() { return 0; }", "int main(int argc, char**) { return argc; }"])
def test_a_program_that_is_no_node_is_none(text: str) -> None:
    assert follow(cpp_files(text)).configurations == ()


def test_nodes_without_names_are_not_one() -> None:
    cmake = "cmake_minimum_required(VERSION 3.0)\nproject(p)\nadd_executable(n n.cpp)\nadd_executable(m m.cpp)\n"
    text = CPP_HEAD + "int main(int argc, char** argv) { ros::init(argc, argv, argv[1]); " + BODY + " }"
    found = as_running(follow({"p/CMakeLists.txt": cmake, "p/n.cpp": text, "p/m.cpp": text.replace('"x"', '"z"')}))
    assert [(item.name, [node.name for node in item.nodes]) for item in found.configurations] == [
        ("p/m", ["/?"]),
        ("p/n", ["/?"]),
    ]
    assert [names(item.nodes[0]) for item in found.configurations] == [["/?/z", "/y"], ["/?/x", "/y"]]


def test_a_node_alone_stays_the_only_one_of_its_configuration() -> None:
    assert [item.name for item in only(follow(cpp_files(CPP_HEAD + "int main() { " + BODY + " }"))).nodes] == ["/?"]
