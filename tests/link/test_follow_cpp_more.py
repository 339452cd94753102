# SPDX-License-Identifier: Apache-2.0
"""C++: macros, numbers and names of libraries, typedefs, what only the run decides; and what stays unknown of them."""

from __future__ import annotations

import pytest
from follow_kit import CMAKE, admits, case, cpp, cpp_files, ends, follow, main, names, node, table, types

from haros_ci.model.architecture import Node

OUTSIDE = (
    "#include <string>\n#include <memory>\n#include <functional>\nbool cond();\nstd::string text();\nint number();\n"
)
SIZED = 'nh.advertise<std_msgs::String>("a", %s);'

#: What a macro's text is as a queue size; None is not known.
MACROS = (
    ("0xFF", 255),
    ("0x1F", 31),
    ("0x10UL", 16),
    ("010", 8),
    ("0b11", 3),
    ("10u", 10),
    ("1'000", 1000),
    ("((5))", 5),
    ("(-3)", -3),
    ("((2) * (3))", 6),
    ("(K + 1)", 5),
    ("K", 4),
    ("1e3", 1000),
    ("(2)*(3)", None),
    ("2+3", None),
    ("K+1", None),
    ("(K2 * 2)", None),
    ("08", None),
    ("(1, 2)", None),
    ("(unsigned)5", None),
    ("sizeof(int)", None),
    ("F(3)", None),
    ("Q", None),
    ("(5", None),
    ("5)", None),
    ("{5}", None),
    ("'a' + 1", None),
    ("x ? 1 : 2", None),
    ("(" * 60 + "5" + ")" * 60, None),
)


@pytest.mark.parametrize(("text", "expected"), MACROS)
def test_a_macro_is_what_its_text_is_where_it_stands(text: str, expected: int | None) -> None:
    found = cpp(SIZED % "Q", f"#define K 4\n#define K2 1+1\n#define F(x) x\n#define Q {text}\n")
    assert [end.queue_size for end in ends(found)] == [expected]


TEXTS = (
    case("in parentheses", "ADV(S, 1);", "/a", before='#define S ("a")'),
    case("with another", "ADV(S, 1);", "/ab", before='#define B "b"\n#define S ("a" B)'),
    case("put together", 'ADV(S + "c", 1);', "/abc", before='#define B "b"\n#define S std::string("a") + B'),
    case("of a macro", "ADV(S, 1);", "/a", before='#define B "a"\n#define S B'),
    case("of a constant", "ADV(S, 1);", "/a", before='namespace k { const std::string N = "a"; }\n#define S k::N'),
    case("escapes", "ADV(S, 1);", "/a", before='#define S "\\x61"'),
    case("of itself", "ADV(S, 1);", "/?", before="#define S S"),
    case("of each other", "ADV(S, 1);", "/?", before="#define S (T)\n#define T (S)"),
    case("wide", "ADV(S, 1);", "/?", before='#define S L"a"'),
    case("a call", "ADV(S, 1);", "/?", before="#define S text()"),
    case("two names", "ADV(S, 1);", "/?", before="#define S a b"),
)


@table(TEXTS)
def test_macros_of_texts(before: str, code: str, expected: list[str]) -> None:
    assert admits(names(cpp(code, OUTSIDE + before)), expected)


NUMBERS = (
    ("M_PI", 3.141592653589793),
    ("-M_PI / 2", -1.5707963267948966),
    ("DBL_MAX", 1.7976931348623157e308),
    ("FLT_MAX", 3.4028234663852886e38),
    ("INT_MAX", 2147483647),
    ("UINT16_MAX", 65535),
    ("std::numeric_limits<double>::max()", 1.7976931348623157e308),
    ("-std::numeric_limits<float>::max()", -3.4028234663852886e38),
    ("std::numeric_limits<double>::min()", 2.2250738585072014e-308),
    ("std::numeric_limits<int>::max()", 2147483647),
    ("std::numeric_limits<int>::min()", -2147483648),
    ("std::numeric_limits<unsigned char>::max()", 255),
    ("std::numeric_limits<uint64_t>::max() / 4", 4611686018427387903),
    ("std::numeric_limits<double>::quiet_NaN()", None),
    ("std::numeric_limits<char>::max()", None),
    ("std::numeric_limits<Unheard>::max()", None),
    ("NAN", None),
    ("M_UNHEARD", None),
    ("HOST_NAME_MAX", None),
)


@pytest.mark.parametrize(("text", "expected"), NUMBERS)
def test_numbers_that_libraries_name(text: str, expected: float | None) -> None:
    found = cpp(f'double d; nh.param<double>("a", d, {text});', OUTSIDE)
    assert [end.value for end in ends(found, "getters")] == [expected]


def test_a_workspace_may_say_itself_what_a_constant_is() -> None:
    found = cpp('double d; nh.param<double>("a", d, M_PI);', "#define M_PI 3.0\n")
    assert [end.value for end in ends(found, "getters")] == [3.0]


STANDARD = (
    case("to_string", 'ADV("a" + to_string(3), 1);', "/a3"),
    case("string", 'ADV(string("a"), 1); string s = "b"; ADV(s, 1);', "/a", "/b"),
    case("make_shared", 'auto p = make_shared<string>("a"); ADV(*p, 1);', "/a"),
    case("shared_ptr", 'shared_ptr<string> p = make_shared<string>("a"); ADV(*p, 1);', "/a"),
    case("make_pair", 'pair<string, int> p = make_pair("a", 1); ADV(p.first, 1);', "/a"),
    case("vector", 'vector<string> v{"a"}; for (auto& s : v) ADV(s, 1);', "/a"),
    case("stringstream", 'stringstream s; s << "a" << 1; ADV(s.str(), 1);', "/a1"),
    case("function of one's own", "ADV(to_string(3), 1);", "/b", before='string to_string(int i) { return "b"; }'),
    case("not known", "ADV(unheard(3), 1);", "/?"),
)


@table(STANDARD)
def test_names_of_std_under_its_using_directive(before: str, code: str, expected: list[str]) -> None:
    assert admits(names(cpp(code, OUTSIDE + "using namespace std;\n" + before)), expected)


def test_a_using_directive_of_a_header_counts() -> None:
    found = cpp('string s = "a"; ADV(s, 1);', '#include "b.h"\n', b__h="using namespace std;\n")
    assert names(found) == ["/a"]


CHECKED = (
    case(
        "text", 'std::string s = "a"; CHECK_EQ(s, text()) << "x"; CHECK(!s.empty()); LOG(INFO) << s; ADV(s, 1);', "/a"
    ),
    case("list", 'std::vector<std::string> v = {"a"}; CHECK_GT(v.size(), 0); for (auto& s : v) ADV(s, 1);', "/a"),
    case(
        "pointer", 'std::vector<std::string> v = {"a"}; CHECK_NOTNULL(&v)->size(); for (auto& s : v) ADV(s, 1);', "/a"
    ),
    case(
        "a function inside",
        'std::string s = "a"; CHECK(change(s)); ADV(s, 1);',
        "/?",
        before="bool change(std::string& s);",
    ),
    case("another macro", 'std::string s = "a"; UNHEARD(s); ADV(s, 1);', "/?"),
)


@table(CHECKED)
def test_checks_of_glog_leave_what_they_are_given(before: str, code: str, expected: list[str]) -> None:
    assert admits(names(cpp(code, OUTSIDE + before)), expected)


CLOUDS = "pcl::PCLPointCloud2", "pcl::PointCloud<pcl::PointXYZ>", "Cloud"


@pytest.mark.parametrize("cloud", CLOUDS)
def test_point_clouds_of_pcl_are_those_of_sensor_msgs(cloud: str) -> None:
    before = f"typedef pcl::PointCloud<pcl::PointXYZI> Cloud;\nvoid f(const {cloud}::ConstPtr& m) {{}}\n"
    found = cpp(f'nh.advertise<{cloud} >("a", 1); nh.subscribe("b", 1, f);', before)
    assert types(found) == [("/a", "sensor_msgs/PointCloud2")]
    assert types(found, "subscribers") == [("/b", "sensor_msgs/PointCloud2")]


CLASS = "namespace ph { struct Alpha { ros::NodeHandle nh; %s }; }\n"
ALIASED = (
    case(
        "method",
        "ph::Alpha a; a.go();",
        "/a",
        before=CLASS % "void go();" + 'typedef ph::Alpha A;\nvoid A::go() { ADV("a", 1); }',
    ),
    case(
        "constructor", "ph::Alpha a;", "/a", before=CLASS % "Alpha();" + 'typedef ph::Alpha A;\nA::A() { ADV("a", 1); }'
    ),
    case(
        "constructor's own name",
        "ph::Alpha a;",
        "/a",
        before=CLASS % "Alpha();" + 'using A = ph::Alpha;\nA::Alpha() { ADV("a", 1); }',
    ),
    case(
        "typedef of a typedef",
        "ph::Alpha a; a.go();",
        "/a",
        before=CLASS % "void go();" + 'typedef ph::Alpha B; typedef B A;\nvoid A::go() { ADV("a", 1); }',
    ),
    case(
        "base",
        "C c;",
        "/a",
        before=(
            'struct B { ros::NodeHandle nh; void go() { ADV("a", 1); } }; typedef B Base;'
            "struct C : Base { C() : Base() { Base::go(); } };"
        ),
    ),
    case(
        "base by this",
        "D d; d.go();",
        "/b",
        before=(
            'struct B { ros::NodeHandle nh; virtual void go() { ADV("b", 1); } }; typedef B Q;'
            "struct D : B { void go() { this->Q::go(); } };"
        ),
    ),
    case(
        "base's method of another class",
        "D d; d.B::go();",
        "/b",
        before=(
            'struct B { ros::NodeHandle nh; virtual void go() { ADV("b", 1); } };'
            'struct D : B { void go() { ADV("d", 1); } };'
        ),
    ),
)


@table(ALIASED)
def test_typedefs_of_classes(before: str, code: str, expected: list[str]) -> None:
    assert names(cpp(code, OUTSIDE + before)) == expected


def test_a_typedef_that_is_not_included_says_nothing_of_a_method() -> None:
    own = CLASS % "void go();" + 'void ph::Alpha::go() { ADV("a", 1); }\n'
    other = '#include <outside/a.h>\nvoid A::go() { nh.advertise<std_msgs::String>("b", 1); }\n'
    header = "namespace ph { struct Alpha; }\ntypedef ph::Alpha A;\n"
    found = cpp("ph::Alpha a; a.go();", OUTSIDE + own, t__h=header, o__cpp=other)
    assert names(found) == ["/a"]


NODELET = """#include <ros/ros.h>
#include <nodelet/nodelet.h>
#include <std_msgs/String.h>
"""
PACKAGE = (
    '<package format="2"><name>p</name><version>1.0.0</version><description>d</description>'
    '<maintainer email="a@b.c">m</maintainer><license>BSD</license><buildtool_depend>catkin</buildtool_depend>'
    '<export><nodelet plugin="${prefix}/plugins.xml"/></export></package>'
)
PLUGINS = (
    '<library path="lib/liblib"><class name="p/N" type="%s" base_class_type="nodelet::Nodelet">'
    "<description>d</description></class></library>"
)


def nodelet(code: str, kind: str) -> Node:
    found = follow(
        {
            "p/CMakeLists.txt": CMAKE.format("p") + "add_library(lib src/lib.cpp)\n",
            "p/package.xml": PACKAGE,
            "p/plugins.xml": PLUGINS % kind,
            "p/src/lib.cpp": NODELET + code,
        }
    )
    return node(found)


def lazy(base: str, call: str) -> Node:
    code = (
        f"namespace ph {{ typedef {base} Base; class A : public {base} {{ ros::Publisher p;"
        f" virtual void onInit() {{ {call}"
        ' p = pnh_->advertise<std_msgs::String>("a", 1); nh_->subscribe("b", 1, &A::f, this); }'
        " void f(const std_msgs::String& m) {} }; }\n"
    )
    return nodelet(code, "ph::A")


def test_a_nodelet_that_is_exported_by_a_typedef() -> None:
    code = (
        "namespace ph { class A : public nodelet::Nodelet { ros::Publisher p; virtual void onInit() {"
        ' p = getNodeHandle().advertise<std_msgs::String>("a", 1); } }; typedef A Alias; }\n'
        "PLUGINLIB_EXPORT_CLASS(ph::Alias, nodelet::Nodelet)\n"
    )
    assert names(nodelet(code, "ph::Alias")) == ["/a"]


LAZY = "nodelet_topic_tools::NodeletLazy", "jsk_topic_tools::ConnectionBasedNodelet"


@pytest.mark.parametrize("call", ("{}::onInit();", "{short}::onInit();", "Base::onInit();", "this->{short}::onInit();"))
@pytest.mark.parametrize("base", LAZY)
def test_what_a_base_class_of_a_library_sets_up_when_it_is_called_by_name(base: str, call: str) -> None:
    found = lazy(base, call.format(base, short=base.partition("::")[2]))
    assert (names(found), names(found, "subscribers")) == (["/p_N/a"], ["/b"])


@pytest.mark.parametrize("call", ("", "Unheard::onInit();", "other::NodeletLazy::onInit();"))
@pytest.mark.parametrize("base", LAZY)
def test_handles_of_a_base_class_that_has_not_set_them_up_are_not_known(base: str, call: str) -> None:
    found = lazy(base, call)
    assert (names(found), names(found, "subscribers")) == (["/?/a"], ["/?/b"])


def test_a_nodelet_of_a_base_class_outside_says_so() -> None:
    found = lazy("other::Nodelet", "other::Nodelet::onInit();")
    assert names(found) == ["/?/a"]
    said = "the base class other::Nodelet is not in the workspace: what it makes and calls is not known"
    assert [unknown.reason for unknown in found.unknowns] == [said]


LABELS = " ".join(f"case {number}:" for number in range(12))
MADE = 'struct C { std::string s; ros::NodeHandle nh; C() : s("a") {} void go() { ADV(s, 1); } };'
SWITCHES = (
    case(
        "labels that share a block",
        f"C* c; switch (number()) {{ {LABELS} c = new C; break; default: return 1; }} c->go();",
        "/a",
        before=MADE,
    ),
    case(
        "one of them",
        f'std::string s = "z"; switch (7) {{ {LABELS} s = "a"; break; default: s = "b"; }} ADV(s, 1);',
        "/a",
    ),
    case(
        "none of them",
        f'std::string s = "z"; switch (30) {{ {LABELS} s = "a"; break; default: s = "b"; }} ADV(s, 1);',
        "/b",
    ),
    case(
        "default among them", 'std::string s = "z"; switch (30) { case 1: default: case 2: s = "a"; } ADV(s, 1);', "/a"
    ),
    case("no default", f'std::string s = "z"; switch (30) {{ {LABELS} s = "a"; }} ADV(s, 1);', "/z"),
    case(
        "empty at the end",
        'std::string s = "z"; switch (2) { case 1: s = "a"; break; case 2: case 3: ; } ADV(s, 1);',
        "/z",
    ),
    case("not known", f'std::string s = "z"; switch (number()) {{ {LABELS} s = "a"; }} ADV(s, 1);', "/a|/z"),
)


@table(SWITCHES)
def test_labels_without_a_block(before: str, code: str, expected: list[str]) -> None:
    assert admits(names(cpp(code, OUTSIDE + before)), expected)


TYPED = (
    ("included by a header", '#include "b.h"\nusing namespace my_msgs;\n', "Foo", "my_msgs/Foo"),
    ("opened by a header", '#include "c.h"\n', "Foo", "my_msgs/Foo"),
    (
        "brought by a message's header",
        "#include <nav_msgs/Odometry.h>\nusing namespace geometry_msgs;\n",
        "PoseWithCovariance",
        "geometry_msgs/PoseWithCovariance",
    ),
    ("by its whole name", "", "other_msgs::Foo", "other_msgs/Foo"),
    ("not open", '#include "b.h"\n', "Foo", None),
    ("class of one's own", '#include "b.h"\nusing namespace my_msgs;\nclass Foo { int i; };\n', "Foo", None),
)


@pytest.mark.parametrize(("before", "name", "expected"), [row[1:] for row in TYPED], ids=[row[0] for row in TYPED])
def test_message_types_by_what_is_included(before: str, name: str, expected: str | None) -> None:
    opened = "#include <my_msgs/Foo.h>\nusing namespace my_msgs;\n"
    found = cpp(f'nh.advertise<{name}>("a", 1);', before, b__h="#include <my_msgs/Foo.h>\n", c__h=opened)
    assert types(found) == [("/a", expected)]


OTHERS = {"class": "class Foo { int i; };", "typedef": "typedef std_msgs::Int8 Foo;"}


@pytest.mark.parametrize("kind", OTHERS)
def test_another_executables_class_is_not_the_message(kind: str) -> None:
    before = "#include <my_msgs/Foo.h>\nusing namespace my_msgs;\nvoid f(const FooConstPtr& m) {}\n"
    files = cpp_files(main('nh.advertise<Foo>("a", 1); nh.subscribe("b", 1, f);', before))
    files["p/src/other.cpp"] = OTHERS[kind] + "\nint main() {}\n"
    files["p/CMakeLists.txt"] += "add_executable(m src/other.cpp)\n"
    found = node(follow(files))
    assert types(found) == [("/a", "my_msgs/Foo")]
    assert types(found, "subscribers") == [("/b", "my_msgs/Foo")]


GETTERS = (
    case(
        "member",
        'C c; ADV("n" + std::to_string(c.q()), 1);',
        "/n7",
        before="struct C { int i = 7; int q() const { return i; } };",
    ),
    case(
        "by a pointer",
        'C* c = new C; ADV("n" + std::to_string(c->q()), 1);',
        "/n7",
        before="struct C { int i = 7; int q() const { return i; } };",
    ),
    case("static", 'ADV("n" + std::to_string(C::q()), 1);', "/n4", before="struct C { static int q() { return 4; } };"),
    case(
        "with a condition",
        'ADV("n" + std::to_string(f(9)), 1);',
        "/n3",
        before="int f(int i) { if (i > 3) return 3; return i; }",
    ),
    case(
        "computed in a loop",
        'ADV("n" + std::to_string(f(9)), 1);',
        "/n?",
        before="int f(int i) { while (cond()) i++; return i; }",
    ),
)


@table(GETTERS)
def test_what_short_functions_return(before: str, code: str, expected: list[str]) -> None:
    assert admits(names(cpp(code, OUTSIDE + before)), expected)


CONSTANTS = (
    case(
        "local of a constant's name",
        "ADV(s, 1); f(3); ADV(s, 1);",
        "/a",
        "/a",
        before='const std::string s = "a"; void f(int i) { int s = 2; s = i; }',
    ),
    case("pointer to a constant", "f(3); ADV(s, 1);", "/b", before='const char* s = "a"; void f(int i) { s = "b"; }'),
    case(
        "static member",
        "C::f(); ADV(C::s, 1);",
        "/b",
        before='struct C { static const char* s; static void f() { s = "b"; } }; const char* C::s = "a";',
    ),
    case(
        "reference to a pointer",
        'const char* s = "a"; f(s); ADV(s, 1);',
        "/b",
        before='void f(const char*& s) { s = "b"; }',
    ),
)


@table(CONSTANTS)
def test_constants_and_what_points_to_them(before: str, code: str, expected: list[str]) -> None:
    assert names(cpp(code, OUTSIDE + before)) == expected


INTERFACE = "struct I { virtual void go() = 0; };\nI* make();\n"
MAKER = 'struct D : I { ros::NodeHandle nh; void go() { ADV("d", 1); } };\n'
TOLD = (
    (
        "virtual",
        "I* i = make(); i->go();",
        INTERFACE + MAKER,
        "I::go is called on an object whose class is not known; it may be D",
    ),
    (
        "virtual with a body",
        "I* i = make(); i->go();",
        "struct I { virtual void go() {} };\nI* make();\n" + MAKER,
        "I::go is called on an object whose class is not known; it may be D",
    ),
    (
        "function object",
        "std::function<void()> f = pick(); f();",
        "std::function<void()> pick();",
        "f is called, which is not known: what pick returns is not known",
    ),
    (
        "function pointer",
        "F f = pick(); f();",
        "typedef void (*F)(); F pick();",
        "f is called, which is not known: what pick returns is not known",
    ),
    (
        "plug-in",
        'L l("p", "I"); l.createInstance("q/D");',
        "typedef pluginlib::ClassLoader<I> L;",
        "the plug-in q/D is loaded: it is not in the workspace",
    ),
    (
        "plug-in without a name",
        'L l("p", "I"); l.createInstance(text());',
        "typedef pluginlib::ClassLoader<I> L;",
        "a plug-in is loaded: its name is not known: what text returns is not known",
    ),
    (
        "one of all plug-ins",
        'L l("p", "I"); for (auto& s : l.getDeclaredClasses()) l.createInstance(s);',
        "typedef pluginlib::ClassLoader<I> L;",
        "a plug-in is loaded: its name is not known: an element of a list that is not known",
    ),
)


@pytest.mark.parametrize(("code", "before", "said"), [row[1:] for row in TOLD], ids=[row[0] for row in TOLD])
def test_what_only_the_run_decides_is_told(code: str, before: str, said: str) -> None:
    found = cpp('ADV("z", 1); ' + code, OUTSIDE + before)
    assert [unknown.reason for unknown in found.unknowns] == [said]


QUIET = (
    ("known object", "I* i = new D; i->go();", INTERFACE + MAKER),
    ("nobody overrides it", "I* i = make(); i->go();", INTERFACE),
    (
        "what overrides it makes nothing",
        "I* i = make(); i->go();",
        INTERFACE + "struct D : I { void go() { number(); } };",
    ),
    ("not virtual", "I* i = make(); i->go();", "struct I { void go() {} };\nI* make();\n" + MAKER),
    ("another class's method", "I* i = make(); i->go();", INTERFACE + MAKER.replace(" : I", "")),
    (
        "what its base does",
        "I* i = make(); i->go();",
        INTERFACE.replace("= 0;", '{ ros::NodeHandle nh; ADV("y", 1); }') + "struct D : I { void go() { I::go(); } };",
    ),
    ("empty function object", "C c; c.go();", "struct C { std::function<void()> f; void go() { if (f) f(); } };"),
    ("known function object", 'std::function<void()> f = [&]() { ADV("y", 1); }; f();', ""),
    ("library's function", "unheard(3);", ""),
    ("no plug-in at all", 'pluginlib::ClassLoader<int> l("p", "I"); l.createInstance("");', ""),
)


@pytest.mark.parametrize(("code", "before"), [row[1:] for row in QUIET], ids=[row[0] for row in QUIET])
def test_what_makes_nothing_or_is_known_is_not_told(code: str, before: str) -> None:
    assert cpp('ADV("z", 1); ' + code, OUTSIDE + before).unknowns == ()


MEMBER = 'struct C { ros::NodeHandle nh; void go() { ADV("g", 1); } void run(void (C::*f)()) { (this->*f)(); } };'
POINTERS = (
    case("given", "C c; c.run(&C::go);", "/g", before=MEMBER),
    case("kept", "C* c = new C; auto f = &C::go; (c->*f)();", "/g", before=MEMBER),
    case(
        "template",
        "C c; c.start();",
        "/g",
        before=(
            'struct C { ros::NodeHandle nh; void f(const std_msgs::String& m) { ADV("g", 1); }'
            "template <class M> void sub(const std::string& t, void (C::*f)(const M&)) { nh.subscribe(t, 1, f, this); }"
            ' void start() { sub<std_msgs::String>("t", &C::f); } };'
        ),
    ),
)


@table(POINTERS)
def test_methods_that_pointers_to_members_tell(before: str, code: str, expected: list[str]) -> None:
    assert names(cpp(code, OUTSIDE + before)) == expected
