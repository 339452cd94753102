# SPDX-License-Identifier: Apache-2.0
"""Classes that are declared in a namespace and defined under a using-directive of it; messages under one of their package."""

from __future__ import annotations

import pytest
from follow_kit import CPP_HEAD, cpp, ends, explicit, names, ros2_cpp, types

HEADER = '#include <string>\nnamespace ns { class B { public: B(const std::string& s = "robot"); virtual ~B(); }; }\n'
OTHER = '#include <string>\nnamespace other { class B { public: B(const std::string& s = "else"); }; }\n'
BODY = "B::B(const std::string& s) { ros::NodeHandle nh; nh.advertise<std_msgs::String>(s, 1); }\n"
USING = CPP_HEAD + '#include "b.h"\nusing namespace ns;\n' + BODY
INSIDE = CPP_HEAD + '#include "b.h"\nnamespace ns {\n' + BODY + "}\n"
MAKES = ("ns::B b;", "ns::B* b = new ns::B();", "ns::B b{};", "boost::shared_ptr<ns::B> b(new ns::B);")


@pytest.mark.parametrize("source", [USING, INSIDE])
@pytest.mark.parametrize("code", MAKES)
def test_a_default_argument_of_the_declaration(source: str, code: str) -> None:
    assert names(cpp(code, '#include "b.h"\n', b__h=HEADER, b__cpp=source)) == ["/robot"]


@pytest.mark.parametrize("code", ['ns::B b("given");', 'ns::B* b = new ns::B("given");'])
def test_an_argument_that_is_given(code: str) -> None:
    assert names(cpp(code, '#include "b.h"\n', b__h=HEADER, b__cpp=USING)) == ["/given"]


def test_one_of_two_classes_of_one_name() -> None:
    found = cpp("ns::B b;", '#include "b.h"\n#include "o.h"\n', b__h=HEADER, o__h=OTHER, b__cpp=USING)
    assert names(found) == ["/robot"]


CLASS = (
    "#include <ros/ros.h>\n#include <std_msgs/String.h>\nnamespace ns { class C { public: using Text = std_msgs::String; "
    "typedef std_msgs::Bool Flag; enum { SIZE = 7 }; void init(); void flag(const Flag::ConstPtr& f); ros::NodeHandle nh; }; }\n"
)
INIT = (
    'void C::init() { nh.advertise<Text>("a", SIZE); nh.subscribe("b", 1, &C::flag, this); }\n'
    'void C::flag(const Flag::ConstPtr& f) { nh.advertise<Flag>("c", 1); }\n'
)


@pytest.mark.parametrize(
    "opened",
    [
        "using namespace ns;\n%s",
        "namespace { using namespace ns; }\n%s",
        "namespace ns {\n%s}\n",
        "namespace ns {\n#define C ns::C\n%s}\n",
    ],
)
def test_what_a_class_names_is_known_in_its_methods(opened: str) -> None:
    found = cpp("ns::C c; c.init();", '#include "c.h"\n', c__h=CLASS, c__cpp='#include "c.h"\n' + opened % INIT)
    assert [(end.name, end.type, end.queue_size) for end in ends(found) + ends(found, "subscribers")] == [
        ("/a", "std_msgs/String", 7),
        ("/c", "std_msgs/Bool", 1),
        ("/b", "std_msgs/Bool", 1),
    ]


@pytest.mark.parametrize("opened", ["", "using namespace other;\n"])
def test_a_class_in_a_namespace_that_is_not_open_is_another_one(opened: str) -> None:
    other = "namespace other { class D {}; class C { public: void init(); }; }\n"
    body = 'void C::init() { ros::NodeHandle nh; nh.advertise<Text>("a", SIZE); }\n'
    source = f'#include "c.h"\n{other}{opened}{body}'
    found = cpp("ns::C c; c.init();", '#include "c.h"\n', c__h=CLASS, c__cpp=source)
    assert types(found) in ([], [("/a", None)])


INCLUDE = "#include <my_msgs/msg/some_point2.hpp>\n"
#: What stands before a publisher of a type, and the message that this is.
OPENED = (
    (INCLUDE + "using namespace my_msgs::msg;\n", "SomePoint2", "my_msgs/msg/SomePoint2"),
    (
        INCLUDE + "using namespace my_msgs::msg;\nusing namespace other_msgs::msg;\n",
        "SomePoint2",
        "my_msgs/msg/SomePoint2",
    ),
    (INCLUDE + "using namespace my_msgs;\n", "msg::SomePoint2", "my_msgs/msg/SomePoint2"),
    ("using namespace sensor_msgs::msg;\nusing namespace my_msgs::msg;\n", "Image", "sensor_msgs/msg/Image"),
    ("using namespace my_msgs::msg;\n", "SomePoint2", None),
    (INCLUDE, "SomePoint2", None),
    (INCLUDE + "using namespace other_msgs::msg;\n", "SomePoint2", None),
    (INCLUDE + "using namespace my_msgs::srv;\n", "SomePoint2", None),
    (INCLUDE + "#include <other_msgs/msg/some_point2.hpp>\nusing namespace other_msgs::msg;\n", "SomePoint2", None),
    ("using namespace my_msgs;\n", "msg::SomePoint2", None),
    (INCLUDE + "using namespace my_msgs::msg;\nstruct SomePoint2 {};\n", "SomePoint2", None),
)


@pytest.mark.parametrize(("before", "kind", "expected"), OPENED)
def test_messages_of_an_open_namespace(before: str, kind: str, expected: str | None) -> None:
    (node,) = ros2_cpp(f'create_publisher<{kind}>("a", 1);', before=before).nodes
    assert [end.type for end in explicit(node)] == [expected]


#: What stands before a publisher of a type that is named through a namespace with using-directives, and the message that it is.
THROUGH = (
    (INCLUDE + "namespace all { using namespace my_msgs::msg; }\n", "all::SomePoint2", "my_msgs/msg/SomePoint2"),
    ("namespace all { using namespace std_msgs::msg; }\n", "all::String", "std_msgs/msg/String"),
    (
        "#ifdef A\nnamespace all { using namespace std_msgs; }\n#else\nnamespace all { using namespace ::std_msgs::msg; }\n#endif\n",
        "all::String",
        "std_msgs/msg/String",
    ),
    (
        INCLUDE + "namespace all { using namespace my_msgs::msg; using namespace std_msgs::msg; }\n",
        "all::String",
        "std_msgs/msg/String",
    ),
    (INCLUDE + "namespace all { using namespace my_msgs::msg; class SomePoint2 {}; }\n", "all::SomePoint2", None),
    (INCLUDE + "namespace all { using namespace my_msgs::msg; }\n", "other::SomePoint2", None),
    (INCLUDE + "namespace all { using namespace my_msgs::srv; }\n", "all::SomePoint2", None),
    ("namespace all { using namespace my_msgs::msg; }\n", "all::SomePoint2", None),
    (INCLUDE + "namespace all { namespace in { using namespace my_msgs::msg; } }\n", "all::SomePoint2", None),
)


@pytest.mark.parametrize(("before", "kind", "expected"), THROUGH)
def test_messages_through_a_namespace(before: str, kind: str, expected: str | None) -> None:
    (node,) = ros2_cpp(f'create_publisher<{kind}>("a", 1);', before=before).nodes
    assert [end.type for end in explicit(node)] == [expected]


def test_messages_of_ros_1_through_a_namespace() -> None:
    before = "#include <my_msgs/Own.h>\nnamespace all { using namespace std_msgs; using namespace my_msgs; }\n"
    found = cpp('nh.advertise<all::Own>("a", 1); nh.advertise<std_msgs::Bool>("b", 1);', before)
    assert types(found) == [("/a", "my_msgs/Own"), ("/b", "std_msgs/Bool")]


@pytest.mark.parametrize(
    ("opened", "expected"),
    [
        ("namespace api { using namespace ns; }\n", ["/robot"]),
        ("namespace api { using namespace ns; class B {}; }\n", []),
        ("namespace api { using namespace other; }\n", []),
        ("namespace { using namespace ns; }\n", []),
    ],
)
def test_a_class_through_a_namespace(opened: str, expected: list[str]) -> None:
    found = cpp("api::B b;", '#include "b.h"\n' + opened, b__h=HEADER, b__cpp=INSIDE)
    assert names(found) == expected


SERVICE = """#include <my_msgs/Find.h>
{}
class C {{ public: bool go({}FindRequest& a, {}FindResponse& b) {{ return true; }} }};
"""


@pytest.mark.parametrize(
    ("opened", "space", "expected"),
    [
        ("using namespace my_msgs;", "", "my_msgs/Find"),
        ("", "my_msgs::", "my_msgs/Find"),
        ("using namespace my_msgs;", "my_msgs::", "my_msgs/Find"),
        ("", "", None),
        ("using namespace other_msgs;", "", None),
        ("using namespace my_msgs; struct FindRequest {}; struct FindResponse {};", "", None),
    ],
)
def test_a_service_by_its_request(opened: str, space: str, expected: str | None) -> None:
    found = cpp('C c; nh.advertiseService("a", &C::go, &c);', SERVICE.format(opened, space, space))
    assert [end.type for end in ends(found, "servers") if end.name == "/a"] == [expected]
