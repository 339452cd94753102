# SPDX-License-Identifier: Apache-2.0
"""C++: the full specialisation of a template of functions that a call means, and calls that say nothing of one."""

from __future__ import annotations

from follow_kit import case, cpp, names, table

OF_RESULTS = """
namespace k {
template<typename T> T sent(ros::NodeHandle& nh, const std::string& name);
template<> bool sent(ros::NodeHandle& nh, const std::string& name) { nh.advertise<std_msgs::Bool>(name + "_bool", 1); return true; }
template<> double sent(ros::NodeHandle& nh, const std::string& name) { nh.advertise<std_msgs::Float64>(name + "_double", 1); return 1.0; }
template<> std::string sent<std::string>(ros::NodeHandle& nh, const std::string& name) { nh.advertise<std_msgs::String>(name + "_text", 1); return ""; }
template<typename T> T through(ros::NodeHandle& nh) { return sent<T>(nh, "inner"); }
}
"""
IN_CONTAINERS = """
template<typename T> std::vector<T> many(ros::NodeHandle& nh);
template<> std::vector<int> many(ros::NodeHandle& nh) { nh.advertise<std_msgs::Int32>("ints", 1); return {}; }
template<> std::vector<double> many(ros::NodeHandle& nh) { nh.advertise<std_msgs::Float64>("doubles", 1); return {}; }
"""


@table((
    case("the first", 'k::sent<bool>(nh, "a");', "/a_bool", before=OF_RESULTS),
    case("another", 'k::sent<double>(nh, "a");', "/a_double", before=OF_RESULTS),
    case("with its argument written out", 'k::sent<std::string>(nh, "a");', "/a_text", before=OF_RESULTS),
    case("several", 'k::sent<double>(nh, "a"); k::sent<bool>(nh, "b");', "/a_double", "/b_bool", before=OF_RESULTS),
    case("from another template", "k::through<double>(nh);", "/inner_double", before=OF_RESULTS),
    case("something of what is returned", "many<double>(nh);", "/doubles", before=IN_CONTAINERS),
))  # fmt: skip
def test_the_one_for_the_template_arguments(before: str, code: str, expected: list[str]) -> None:
    assert names(cpp(code, before)) == expected


OVERLOADS = """
template<typename T> void made(ros::NodeHandle& nh, int n) { nh.advertise<std_msgs::String>("number", 1); }
template<typename T> void made(ros::NodeHandle& nh, const std::string& n) { nh.advertise<std_msgs::String>(n, 1); }
"""
PRIMARY = """
template<typename T> void one(ros::NodeHandle& nh, const std::string& name) { nh.advertise<T>(name, 1); }
"""


@table((
    case("overloads that are templates", 'made<int>(nh, "text"); made<int>(nh, 2);', "/number", "/text", before=OVERLOADS),
    case("a template without specialisations", 'one<std_msgs::String>(nh, "a");', "/a", before=PRIMARY),
))  # fmt: skip
def test_what_is_no_specialisation(before: str, code: str, expected: list[str]) -> None:
    assert names(cpp(code, before)) == expected


WRITTEN = """
template<typename T> void add(ros::NodeHandle& nh, const std::string& n)%s
template<> void add<int>(ros::NodeHandle& nh, const std::string& n) { nh.advertise<std_msgs::Int32>(n + "_int", 1); }
template<> void add<k::M>(ros::NodeHandle& nh, const std::string& n) { nh.advertise<std_msgs::Float64>(n + "_m", 1); }
"""
OF_CLASS = """
struct S { ros::NodeHandle nh; template<typename T> void add(const std::string& n); };
template<> void S::add<int>(const std::string& n) { nh.advertise<std_msgs::Int32>(n + "_int", 1); }
template<> void S::add<double>(const std::string& n) { nh.advertise<std_msgs::Float64>(n + "_double", 1); }
"""
OF_NUMBERS = """
template<typename T, int N> void add(ros::NodeHandle& nh, const std::string& n);
template<> void add<int, 1>(ros::NodeHandle& nh, const std::string& n) { nh.advertise<std_msgs::Int32>(n + "_1", 1); }
template<> void add<int, 2>(ros::NodeHandle& nh, const std::string& n) { nh.advertise<std_msgs::Int32>(n + "_2", 1); }
"""
ANY = ' { nh.advertise<std_msgs::String>(n + "_any", 1); }'
SPACE = "namespace k { struct M {}; }\n"


@table((
    case("the first", 'add<int>(nh, "x");', "/x_int", before=SPACE + WRITTEN % ";"),
    case("another", 'add<k::M>(nh, "x");', "/x_m", before=SPACE + WRITTEN % ";"),
    case("another, under a using-directive", 'using namespace k; add<M>(nh, "x");', "/x_m", before=SPACE + WRITTEN % ";"),
    case("the template itself", 'add<bool>(nh, "x");', "/x_any", before=SPACE + WRITTEN % ANY),
    case("one of a template with a body", 'add<k::M>(nh, "x");', "/x_m", before=SPACE + WRITTEN % ANY),
    case("a number among them", 'add<int, 2>(nh, "x"); add<int, 1>(nh, "y");', "/x_2", "/y_1", before=OF_NUMBERS),
    case("of a method", 'S s; s.add<double>("x"); s.add<int>("y");', "/x_double", "/y_int", before=OF_CLASS),
))  # fmt: skip
def test_the_one_that_is_written_for_the_template_arguments(before: str, code: str, expected: list[str]) -> None:
    assert names(cpp(code, before)) == expected


@table((
    case("of what is written", 'add<bool>(nh, "x");', "add", before=SPACE + WRITTEN % ";"),
    case("of what is returned", 'k::sent<int>(nh, "a");', "k::sent", before=OF_RESULTS),
    case("of a number", 'add<int, 3>(nh, "x");', "add", before=OF_NUMBERS),
    case("of a method", 'S s; s.add<bool>("x");', "S::add", before=OF_CLASS),
))  # fmt: skip
def test_none_is_for_the_template_arguments(before: str, code: str, expected: list[str]) -> None:
    found = cpp(code, before)
    assert names(found) == []
    reason = f"{expected[0]} has specialisations, of which none is for the template arguments of a call"
    assert [unknown.reason for unknown in found.unknowns] == [reason]
