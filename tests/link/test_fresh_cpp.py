# SPDX-License-Identifier: Apache-2.0
"""C++: names under using-directives, objects that are called, overloads, copies; and what they are not taken for."""

from __future__ import annotations

import pytest
from follow_kit import CPP_HEAD, admits, case, cpp, cpp_files, ends, follow, names, node, table

from haros_ci.model.architecture import Node


def program(code: str, before: str, **others: str) -> Node:
    """The node of a program that is written out whole."""
    return node(follow(cpp_files(f"{CPP_HEAD}{before}\nint main(int argc, char** argv) {{ {code} }}\n", **others)))


CLASS = """
namespace k { class C { public: C(); void one(); static void two(ros::NodeHandle& n); ros::NodeHandle nh; }; }
using namespace k;
C::C() { %s }
void C::one() { nh.advertise<std_msgs::String>("one", 1); }
void C::two(ros::NodeHandle& n) { n.advertise<std_msgs::String>("two", 1); }
"""


@pytest.mark.parametrize("code", ["one(); two(nh);", "this->one(); C::two(nh);", "one(); k::C::two(nh);"])
def test_methods_of_a_class_under_a_using_directive(code: str) -> None:
    assert names(cpp("k::C c;", CLASS % code)) == ["/one", "/two"]


def test_methods_of_the_same_name_of_another_class_are_not_meant() -> None:
    other = "namespace o { class XC { public: void one(); }; }\nusing namespace o;\n" + (
        'void XC::one() { ros::NodeHandle nh; nh.advertise<std_msgs::String>("other", 1); }\n'
    )
    declared = "namespace k { class C { public: C(); void one(); }; }\nusing namespace k;\nC::C() { one(); }\n"
    assert names(cpp("k::C c;", other + declared)) == []


USING = "using namespace ros;\n"
WITH = 'ros::init(argc, argv, "n"); '
ROS = (
    case("a handle", 'NodeHandle nh("~"); Publisher p = nh.advertise<std_msgs::String>("a", 1);', "/n/a"),
    case("a pointer to one", 'NodeHandlePtr nh(new NodeHandle("x")); nh->advertise<std_msgs::String>("a", 1);', "/x/a"),
    case("inside a function", 'using namespace ros; NodeHandle nh; nh.advertise<std_msgs::String>("a", 1);', "/a"),
    case(
        "in a class",
        "X x;",
        "/a",
        before='class X { NodeHandle n; public: X() { n.advertise<std_msgs::String>("a", 1); } };',
    ),
    case("of a nested namespace", 'NodeHandle nh; nh.advertise<std_msgs::String>(names::append("a", "b"), 1);', "/a/b"),
    case(
        "the workspace's own",
        'NodeHandle nh("~"); nh.advertise<std_msgs::String>("a", 1);',
        before="struct NodeHandle { NodeHandle(const char* s);\n"
        "template<class T> void advertise(const char* n, int q) {} };",
    ),
)


@table(ROS)
def test_names_of_ros(before: str, code: str, expected: list[str]) -> None:
    assert admits(names(program(WITH + code, USING + before)), expected)


@pytest.mark.parametrize("before", [USING, "using namespace outside;\n" + USING, USING + "using namespace std;\n"])
def test_a_node_is_given_its_name(before: str) -> None:
    found = program('init(argc, argv, "given"); NodeHandle nh; nh.advertise<std_msgs::String>("a", 1);', before)
    assert (found.name, names(found)) == ("/given", ["/a"])


def test_a_node_is_given_its_name_in_a_function() -> None:
    before = USING + 'void setup(int c, char** v) { init(c, v, "given"); }\n'
    found = program('setup(argc, argv); NodeHandle nh; nh.advertise<std_msgs::String>("a", 1);', before)
    assert (found.name, names(found)) == ("/given", ["/a"])


def test_a_method_of_a_base_elsewhere_is_not_of_ros() -> None:
    before = USING + 'class W : public QWidget { public: W(int c, char** v) { init(c, v, "other"); } };\n'
    found = program('ros::init(argc, argv, "given"); W w(argc, argv); NodeHandle nh;', before)
    assert found.name == "/given"


LIBRARIES = (
    ("using namespace image_transport;", 'ImageTransport it(nh); it.advertise("a", 1);', "publishers", ["/a"]),
    ("using namespace tf;", "TransformBroadcaster b;", "publishers", ["/tf"]),
    ("using namespace message_filters;", 'Subscriber<std_msgs::String> s(nh, "a", 1);', "subscribers", ["/a"]),
    ("using namespace actionlib;", 'SimpleActionServer<k_msgs::GoAction> s(nh, "a", false);', "action_servers", ["/a"]),
    ("using namespace tf;\nusing namespace tf2_ros;", "TransformBroadcaster b;", "publishers", []),
    ("using namespace outside;", 'ImageTransport it(nh); it.advertise("a", 1);', "publishers", []),
)


@pytest.mark.parametrize(("before", "code", "kind", "expected"), LIBRARIES)
def test_names_of_libraries(before: str, code: str, kind: str, expected: list[str]) -> None:
    assert [end.name for end in ends(cpp(code, before + "\n"), kind) if not end.implicit] == expected


FUNCTOR = """
struct F {
  F(ros::NodeHandle& n) : nh(n) {}
  void operator()(const std::string& name) { nh.advertise<std_msgs::String>(name, 1); }
  ros::NodeHandle nh;
};
typedef boost::function<void(std::string)> Func;
typedef Func Alias;
bool cond();
"""
CALLS = (
    case("a parameter", "go(F(nh));", "/a", before='void go(F f) { while (cond()) f("a"); }'),
    case("by reference", "F f(nh); go(f);", "/a", before='void go(const F& f) { while (cond()) f("a"); }'),
    case(
        "as a function",
        "go(F(nh));",
        "/a",
        before='void go(boost::function<void(std::string)> f) { while (cond()) f("a"); }',
    ),
    case("as an alias of one", "go(F(nh));", "/a", before='void go(Func f) { while (cond()) f("a"); }'),
    case("as an alias of an alias", "go(F(nh));", "/a", before='void go(const Alias& f) { for (;;) f("a"); }'),
    case(
        "a member",
        "G g(nh); g.go();",
        "/a",
        before='struct G { G(ros::NodeHandle& n) : f(n) {} void go() { while (cond()) f("a"); } F f; };',
    ),
    case("a variable", 'F f(nh); while (cond()) f("a");', "/a"),
    case("one made for the call", 'while (cond()) F(nh)("a");', "/a"),
    case(
        "of each element",
        "L l; l.go(F(nh));",
        "/a",
        before="struct L : std::list<int> { void go(Func f) {\n"
        'for (const_iterator i = begin(); i != end(); ++i) { if (*i) continue; f("a"); } } };',
    ),
    case(
        "of another class",
        "Q f(nh); while (cond()) f(1);",
        before="struct Q { Q(ros::NodeHandle& n) {} void operator()(int i) {} };",
    ),
    case("never called", "go(F(nh));", before="void go(F f) { while (cond()) cond(); }"),
)


@table(CALLS)
def test_objects_that_are_called(before: str, code: str, expected: list[str]) -> None:
    assert admits(names(cpp(code, FUNCTOR + before)), expected)


MACHINE = """
class D { public: D(ros::NodeHandle& n) { n.advertise<std_msgs::String>("a", 1); } };
class E { public: E() {} };
"""
SAID = "machines::machine is given class D and a node handle: whether it makes one is not seen"
GIVEN = "the node is given to machines::machine, which is not in the workspace and may make more on it"
TEMPLATES = (
    ("machines::machine<D> m(nh);", [GIVEN, SAID]),
    ("boost::shared_ptr<machines::machine<D> > m(new machines::machine<D>(nh));", [GIVEN, SAID]),
    ("boost::shared_ptr<machines::machine<D> > m; m.reset(new machines::machine<D>(nh));", [GIVEN, SAID]),
    ("machines::machine<E> m(nh);", [GIVEN]),
    ("machines::machine<D> m;", []),
    ("machines::machine<D> m(1);", []),
    ("std::vector<D> m;", []),
    ("boost::shared_ptr<D> m(new D(nh));", []),
    ('message_filters::Subscriber<D> m(nh, "b", 1);', []),
)


@pytest.mark.parametrize(("code", "expected"), TEMPLATES)
def test_templates_of_libraries_over_classes_that_are_given_a_handle(code: str, expected: list[str]) -> None:
    found = cpp(code, MACHINE)
    assert sorted(each.reason for each in found.unknowns if each.field == "endpoints") == sorted(expected)


HEADER = """#include <ros/ros.h>
#include <string>
namespace k { class V { public:
  V() {}
  V(int a) {}
  V(ros::NodeHandle& n);
  V(ros::NodeHandle& n, const std::string& name);
  void go() {}
  void go(ros::NodeHandle& n);
  void run(int a) {}
  void run(ros::NodeHandle& n);
}; }
"""
BODIES = """
V::V(ros::NodeHandle& n) { n.advertise<std_msgs::String>("one", 1); }
V::V(ros::NodeHandle& n, const std::string& name) { n.advertise<std_msgs::String>(name, 1); }
void V::go(ros::NodeHandle& n) { n.advertise<std_msgs::String>("go", 1); }
void V::run(ros::NodeHandle& n) { n.advertise<std_msgs::String>("run", 1); }
"""
OVERLOADS = (
    ("k::V v;", []),
    ("k::V v(1);", []),
    ("k::V v(nh);", ["/one"]),
    ('k::V v(nh, "two");', ["/two"]),
    ("boost::shared_ptr<k::V> v; v.reset(new k::V(nh));", ["/one"]),
    ("k::V v; v.go();", []),
    ("k::V v; v.go(nh);", ["/go"]),
    ("k::V v; v.run(1);", []),
    ("k::V v; v.run(nh);", ["/run"]),
)


@pytest.mark.parametrize(("opening", "closing"), [("namespace k {", "}"), ("using namespace k;", "")])
@pytest.mark.parametrize(("code", "expected"), OVERLOADS)
def test_overloads_of_which_some_have_their_body_in_the_class(
    code: str, expected: list[str], opening: str, closing: str
) -> None:
    source = f'{CPP_HEAD}#include "v.h"\n{opening}\n{BODIES}\n{closing}\n'
    assert names(cpp(code, '#include "v.h"\n', v__h=HEADER, v__cpp=source)) == expected


DEFAULTS = (
    ('nh.param<bool>("a", "false");', "bool", True),
    ('bool b; nh.param<bool>("a", b, "false");', "bool", True),
    ('nh.setParam("a", "false");', "str", "false"),
    ('nh.param<std::string>("a", "false");', "str", "false"),
    ('nh.param<bool>("a", false);', "bool", False),
)


@pytest.mark.parametrize(("code", "kind", "value"), DEFAULTS)
def test_a_text_where_a_flag_is_read_is_true(code: str, kind: str, value: object) -> None:
    found = cpp(code)
    assert [(end.type, end.value) for end in (*ends(found, "getters"), *ends(found, "setters"))] == [(kind, value)]


PARTS = """
#include <string>
struct P { std::string n; std::string t; int q{3}; };
struct Z { P get() { return outside(); } const char* text(); int number(); };
struct R { R(ros::NodeHandle& n) { n.advertise<std_msgs::String>("r", 1); } int q; };
template <typename T> struct W { T get() const { T copy{data}; return copy; } T data; };
std::string text();
bool cond();
"""
COPIES = (
    ("P c{outside()};", "/?M", None),
    ("P c(outside());", "/?M", None),
    ("P c = {outside()};", "/?M", None),
    ("P c = P{outside()};", "/?M", None),
    ("auto o = outside(); P c{o};", "/?M", None),
    ("Z z; const P c{z.get()};", "/?M", None),
    ("W<P> w; w.data = outside(); const P c{w.get()};", "/?M", None),
    ("W<P> w; const P c{w.get()};", "/M", 3),
    ('P a; a.t = "k"; P c{a};', "/kM", 3),
    ('P c{"x"};', "/M", 3),
    ("P c{text()};", "/M", 3),
    ("Z z; P c{z.text()};", "/M", 3),
    ('P c{text(), "k"};', "/kM", 3),
    ("P c{};", "/M", 3),
)


@pytest.mark.parametrize(("code", "name", "queue"), COPIES)
def test_what_is_made_of_one_thing_that_is_not_known_may_be_its_copy(code: str, name: str, queue: int | None) -> None:
    found = cpp(f'{code} ADV(c.t + "M", c.q);', PARTS)
    assert [(end.name, end.queue_size) for end in ends(found)] == [(name, queue)]


def test_a_constructor_that_takes_what_is_not_known_is_followed() -> None:
    assert names(cpp("R r{outside()}; R s(outside());", PARTS)) == ["/?/r"]
