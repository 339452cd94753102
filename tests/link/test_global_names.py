# SPDX-License-Identifier: Apache-2.0
"""C++: names from the global namespace on, ``::ros::NodeHandle`` ([basic.lookup.qual])."""

from __future__ import annotations

import re

import pytest

from tests.link.follow_kit import cpp_files, ends, explicit, follow, main, names, node, ros2_main, types

HEAD = "#include <ros/ros.h>\n#include <std_msgs/String.h>\n"
PLAIN = """
struct Driver {
  Driver(ros::NodeHandle & nh) : own_(new ros::NodeHandle("~")) {
    std::string prefix = "arm";
    own_->getParam("rate", rate_);
    pub_ = std::make_shared<ros::Publisher>(own_->advertise<std_msgs::String>("state", 1));
    sub_ = nh.subscribe<std_msgs::String>(prefix + "/in", 1, boost::bind(&Driver::heard, this, _1));
    ros::param::get("/all", all_);
  }
  void heard(const std_msgs::String::ConstPtr & m) { late_ = own_->advertise<std_msgs::String>("late", 1); }
  std::unique_ptr<ros::NodeHandle> own_; std::shared_ptr<ros::Publisher> pub_; ros::Subscriber sub_; ros::Publisher late_; int rate_; std::string all_;
};
int main(int argc, char ** argv) {
  ros::init(argc, argv, "n");
  ros::NodeHandle nh;
  Driver driver(nh);
  ros::spin();
}
"""


def globally(text: str) -> str:
    """The same with ``::`` before all names of libraries."""
    return re.sub(r"(?<![\w:])(ros|std|std_msgs|boost|rclcpp)::", r"::\1::", text)


def test_names_from_the_global_namespace_on_are_the_same_names() -> None:
    plain, written = (node(follow(cpp_files(HEAD + text))) for text in (PLAIN, globally(PLAIN)))
    assert names(plain) == ["/n/late", "/n/state"] and names(plain, "getters") == ["/all", "/n/rate"]
    assert [(end.kind, end.name, end.type) for end in written.endpoints] == [
        (end.kind, end.name, end.type) for end in plain.endpoints
    ]


@pytest.mark.parametrize(
    "before",
    [
        "namespace inner { namespace ros { struct NodeHandle {}; } }\nnamespace inner { ",
        "namespace inner { namespace ros { int NodeHandle; } }\nusing namespace inner;\nnamespace other { ",
    ],
)
def test_a_namespace_of_that_name_inside_hides_nothing(before: str) -> None:
    text = globally(PLAIN).replace("\nstruct Driver", f"\n{before}struct Driver").replace("\nint main", "}\nint main")
    space = "inner" if "namespace inner { struct" in text else "other"
    text = text.replace("Driver driver", f"{space}::Driver driver")
    assert names(node(follow(cpp_files(HEAD + text)))) == ["/n/late", "/n/state"]


def test_of_ros_2() -> None:
    text = (
        'class N : public ::rclcpp::Node { public: N() : ::rclcpp::Node("n") {\n'
        '  p_ = create_publisher<::std_msgs::msg::String>("t", ::rclcpp::QoS(5)); }\n'
        "  ::rclcpp::Publisher<::std_msgs::msg::String>::SharedPtr p_; };\n"
    )
    (found,) = ros2_main("::rclcpp::spin(::std::make_shared<::N>());", before=text).nodes
    assert types(found) and [(end.name, end.type) for end in explicit(found)] == [("/t", "std_msgs/msg/String")]


def test_a_class_of_the_workspace_is_meant_from_the_global_namespace_on() -> None:
    text = (
        "struct Made { static std::string topic() { return \"global\"; } };\n"
        "namespace inner { struct Made { static std::string topic() { return \"inner\"; } };\n"
        "  void go(ros::NodeHandle & nh) { static auto a = nh.advertise<std_msgs::String>(Made::topic(), 1);\n"
        "    static auto b = nh.advertise<std_msgs::String>(::Made::topic(), 1); } }\n"
        "int main(int c, char ** v) { ros::init(c, v, \"n\"); ros::NodeHandle nh; inner::go(nh); }\n"
    )  # fmt: skip
    assert names(node(follow(cpp_files(HEAD + text)))) == ["/global", "/inner"]
    assert len(ends(node(follow(cpp_files(HEAD + text))))) == 2


def test_what_stands_in_brackets_is_looked_up_where_it_is_written() -> None:
    text = (
        "namespace inner { struct Talker { void go(ros::NodeHandle & nh) { static auto a = nh.advertise<std_msgs::String>(\"t\", 1); } };\n"
        "  template <class T> void start(ros::NodeHandle & nh) { ::std::unique_ptr<T> held(new T); ::std::vector<T> all(1);\n"
        "    for (auto & one : all) { one.go(nh); } }\n"
        "  struct Late { ::std::shared_ptr<Talker> held; void go(ros::NodeHandle & nh) { held->go(nh); } };\n"
        "}\n"
        "int main(int c, char ** v) { ros::init(c, v, \"n\"); ros::NodeHandle nh; inner::start<inner::Talker>(nh); inner::Late l; l.go(nh); }\n"
    )  # fmt: skip
    plain, written = (names(node(follow(cpp_files(HEAD + one)))) for one in (text.replace(" ::std", " std"), text))
    assert written == plain == ["/t"]


OTHER = (
    HEAD
    + 'std::string name = "other";\nstd::string Names::name = "other";\nros::NodeHandle * handle = new ros::NodeHandle("other");\n'
)
NAMES = "struct Names { static std::string name; };\n"


@pytest.mark.parametrize("other", ["a.cpp", "main (copy).cpp", "z.cpp"])
@pytest.mark.parametrize(
    ("before", "body", "name"),
    [
        ("std::string name;\n", 'name = "own"; nh.advertise<std_msgs::String>(name, 1);', "/own"),
        ("static std::string name;\n", 'nh.advertise<std_msgs::String>(name + "own", 1);', "/?own"),
        ('std::string name = "own";\n', "nh.advertise<std_msgs::String>(name, 1);", "/own"),
        (NAMES + 'std::string Names::name = "own";\n', "nh.advertise<std_msgs::String>(Names::name, 1);", "/own"),
        (NAMES + "std::string Names::name;\n", 'nh.advertise<std_msgs::String>(Names::name + "own", 1);', "/?own"),
        ("ros::NodeHandle * handle;\n", 'handle = &nh; handle->advertise<std_msgs::String>("own", 1);', "/own"),
    ],
)
def test_a_variable_of_the_file_does_not_begin_as_one_of_another_program(
    other: str, before: str, body: str, name: str
) -> None:
    found = node(follow(cpp_files(main(body, before)) | {f"p/src/{other}": OTHER}))
    assert names(found) == [name]


@pytest.mark.parametrize(
    ("before", "others", "name"),
    [
        (NAMES, {"lib__cpp": 'std::string Names::name = "lib";\n'}, "/lib"),
        ('#include "h.h"\n', {"h__h": NAMES, "lib__cpp": '#include "h.h"\nstd::string Names::name = "lib";\n'}, "/lib"),
        ('#include "h.h"\n', {"h__h": NAMES + 'std::string Names::name = "h";\n'}, "/h"),
    ],
)
def test_a_static_member_begins_as_its_definition_in_the_program(
    before: str, others: dict[str, str], name: str
) -> None:
    body = "nh.advertise<std_msgs::String>(Names::name, 1);"
    found = node(follow(cpp_files(main(body, before), **others) | {"p/src/a.cpp": OTHER}))
    assert names(found) == [name]
