# SPDX-License-Identifier: Apache-2.0
"""C++ callbacks: which functions are called back, of what type their messages are, and what they change for others."""

from __future__ import annotations

import pytest
from follow_kit import CMAKE, admits, because, case, cpp, ends, follow, names, node, table, types, well_formed

OUTSIDE = "#include <string>\n#include <std_msgs/Int32.h>\nbool cond();\nstd::string text();\n"
INT = "std_msgs::Int32"

#: A subscriber's call, and the type of its messages (None if it is not known).
MESSAGES = (
    (f"void cb(const {INT}::ConstPtr& m) {{}}", 'nh.subscribe("x", 1, cb);', "std_msgs/Int32"),
    (f"void cb(const {INT}::ConstPtr& m) {{}}", 'nh.subscribe("x", 1, &cb);', "std_msgs/Int32"),
    (f"void cb(const {INT}ConstPtr& m) {{}}", 'nh.subscribe("x", 1, cb);', "std_msgs/Int32"),
    (f"void cb({INT}Ptr m) {{}}", 'nh.subscribe("x", 1, cb);', "std_msgs/Int32"),
    (f"void cb(const {INT}& m) {{}}", 'nh.subscribe("x", 1, cb);', "std_msgs/Int32"),
    (f"void cb({INT} m) {{}}", 'nh.subscribe("x", 1, cb);', "std_msgs/Int32"),
    (f"void cb(boost::shared_ptr<{INT} const> m) {{}}", 'nh.subscribe("x", 1, cb);', "std_msgs/Int32"),
    (f"void cb(const boost::shared_ptr<const {INT}>& m) {{}}", 'nh.subscribe("x", 1, cb);', "std_msgs/Int32"),
    (f"void cb(const ros::MessageEvent<{INT} const>& m) {{}}", 'nh.subscribe("x", 1, cb);', "std_msgs/Int32"),
    (
        f"struct C {{ void cb(const {INT}::ConstPtr& m) {{}} }};",
        'C c; nh.subscribe("x", 1, &C::cb, &c);',
        "std_msgs/Int32",
    ),
    (
        f"struct B {{ void cb(const {INT}::ConstPtr& m) {{}} }}; struct C : B {{}};",
        'C c; nh.subscribe("x", 1, &C::cb, &c);  // inherited',
        "std_msgs/Int32",
    ),
    (
        f"void cb(int i, const {INT}& m) {{}}",
        'nh.subscribe<std_msgs::Int32>("x", 1, boost::bind(cb, 1, _1));',
        "std_msgs/Int32",
    ),
    (
        f"void cb(int i, const {INT}& m) {{}}",
        'nh.subscribe("x", 1, boost::function<void(const std_msgs::Int32&)>(boost::bind(cb, 1, _1)));',
        "std_msgs/Int32",
    ),
    ("", 'nh.subscribe<std_msgs::Int32>("x", 1, [](const std_msgs::Int32::ConstPtr& m) {});', "std_msgs/Int32"),
    (
        "",
        ('boost::function<void(const std_msgs::Int32&)> f = [](const std_msgs::Int32& m) {}; nh.subscribe("x", 1, f);'),
        "std_msgs/Int32",
    ),
    (
        "struct F { void operator()(const std_msgs::Int32& m) {} };",
        'F f; nh.subscribe<std_msgs::Int32>("x", 1, f);',
        "std_msgs/Int32",
    ),
    ("template <class T> void cb(const T& m) {}", 'nh.subscribe("x", 1, cb<std_msgs::Int32>);', "std_msgs/Int32"),
    (
        "template <class T> struct C { void cb(const T& m) {} };",
        'C<std_msgs::Int32> c; nh.subscribe("x", 1, &C<std_msgs::Int32>::cb, &c);',
        "std_msgs/Int32",
    ),
    (
        f"void cb(const {INT}& m) {{}} void cb(const std_msgs::String& m, int i) {{}}",
        'nh.subscribe<std_msgs::Int32>("x", 1, cb);',
        "std_msgs/Int32",
    ),
    ("", 'nh.subscribe("x", 1, elsewhere);', None),
    ("", 'nh.subscribe("x", 1, &Elsewhere::cb, &e);', None),
    (
        "void cb(const topic_tools::ShapeShifter::ConstPtr& m) {}",
        'nh.subscribe("x", 1, cb);',
        "topic_tools/ShapeShifter",
    ),
)


#: Why a callback's type is not told yet.
NO_TYPE = {
    'nh.subscribe("x", 1, cb<std_msgs::Int32>);': "a function template's arguments are dropped where it is not called",
}


@pytest.mark.parametrize(("before", "code", "expected"), MESSAGES)
def test_messages_are_those_that_callbacks_take(
    before: str, code: str, expected: str | None, request: pytest.FixtureRequest
) -> None:
    if code in NO_TYPE:
        request.applymarker(pytest.mark.xfail(strict=True, reason=NO_TYPE[code]))
    assert types(cpp(code, OUTSIDE + before), "subscribers") == [("/x", expected)]


#: Kinds of registration: the callback ``cb`` advertises "a".
CALLED = (
    case("subscriber", 'ros::Subscriber u = nh.subscribe("u", 1, cb);', "/a"),
    case("timer", "ros::Timer t = nh.createTimer(ros::Duration(1), tick);", "/a"),
    case("timer of a method", "C c; ros::Timer t = nh.createTimer(ros::Duration(1), &C::tick, &c);", "/a"),
    case("service", 'ros::ServiceServer s = nh.advertiseService("u", serve);', "/a"),
    case("bound", 'ros::Subscriber u = nh.subscribe<std_msgs::String>("u", 1, boost::bind(bound, _1, "a"));', "/a"),
    case(
        "bound object",
        ('C c; ros::Subscriber u = nh.subscribe<std_msgs::String>("u", 1, boost::bind(&C::bound, &c, _1, "a"));'),
        "/a",
    ),
    case(
        "lambda",
        (
            'ros::Subscriber u = nh.subscribe<std_msgs::String>("u", 1, [&](const '
            'std_msgs::String::ConstPtr&) { ADV("a", 1); });'
        ),
        "/a",
    ),
    case(
        "lambda without captures",
        (
            'ros::Subscriber u = nh.subscribe<std_msgs::String>("u", 1, [](const '
            "std_msgs::String::ConstPtr&) { made(); });"
        ),
        "/a",
    ),
    case(
        "lambda with a handle of its own",
        ('ros::Timer t = nh.createTimer(ros::Duration(1), [nh](const ros::TimerEvent&) mutable { ADV("a", 1); });'),
        "/a",
    ),
    case("thread", "std::thread t(run);", "/a"),
    case("boost thread of a method", "C c; boost::thread t(boost::bind(&C::run, &c));", "/a"),
    case("callback of a callback", 'ros::Subscriber u = nh.subscribe("u", 1, first);', "/a"),
    case(
        "connect callback",
        ('ros::Publisher p = nh.advertise<std_msgs::String>("y", 1, (ros::SubscriberStatusCallback) connected);'),
        "/a",
        "/y",
    ),
    case(
        "dynamic_reconfigure",
        ("dynamic_reconfigure::Server<p::XConfig> server; server.setCallback(boost::bind(configured, _1, _2));"),
        "/a",
        "/n/parameter_descriptions",
        "/n/parameter_updates",
    ),
    case(
        "message_filters", 'message_filters::Subscriber<std_msgs::String> f(nh, "u", 1); f.registerCallback(cb);', "/a"
    ),
)
ROOTS = """
ros::NodeHandle* g;
void made() { ros::NodeHandle nh; ros::Publisher p = nh.advertise<std_msgs::String>("a", 1); }
void cb(const std_msgs::String::ConstPtr& m) { made(); }
void tick(const ros::TimerEvent&) { made(); }
bool serve(std_srvs::Empty::Request& i, std_srvs::Empty::Response& o) { made(); return true; }
void bound(const std_msgs::String::ConstPtr& m, std::string s) { ros::NodeHandle nh;
  nh.advertise<std_msgs::String>(s, 1); }
void run() { made(); }
void first(const std_msgs::String::ConstPtr& m) { ros::NodeHandle nh;
  static ros::Subscriber s = nh.subscribe("v", 1, cb); }
void connected(const ros::SingleSubscriberPublisher& p) { made(); }
void configured(p::XConfig& c, uint32_t level) { made(); }
struct C { void tick(const ros::TimerEvent&) { made(); } void run() { made(); }
  void bound(const std_msgs::String::ConstPtr& m, std::string s) { ::bound(m, s); } };
"""

#: Members that callbacks share: ``one`` and ``two`` are subscribed to before ``rest``.
SHARED = (
    case(
        "set by another",
        "",
        "/a|/b",
        before='std::string s = "a"; void one(const M&) { s = "b"; } void two(const M&) { pub(s); }',
    ),
    case(
        "set by a later one",
        "",
        "/a|/b",
        before='std::string s = "a"; void one(const M&) { pub(s); } void two(const M&) { s = "b"; }',
    ),
    case(
        "set by itself",
        "",
        "/a|/b",
        before='std::string s = "a"; void one(const M&) { pub(s); s = "b"; } void two(const M&) {}',
    ),
    case(
        "set by itself before",
        "",
        "/b",
        before='std::string s = "a"; void one(const M&) { s = "b"; pub(s); } void two(const M&) {}',
    ),
    case(
        "set from the message",
        "",
        "/a|/q",
        before='std::string s = "a"; void one(const M& m) { s = m.data; } void two(const M&) { pub(s); }',
    ),
    case(
        "set by itself from the message",
        "",
        "/a|/q",
        before='std::string s = "a"; void one(const M& m) { pub(s); s = m.data; } void two(const M&) {}',
    ),
    case(
        "counted by itself",
        "",
        "/a0|/a1|/a2",
        before=(
            'std::string s; int n = 0; void one(const M&) { pub("a" + std::to_string(n)); n++; } void two(const M&) {}'
        ),
    ),
    case(
        "set through a third",
        "",
        "/a|/b",
        before=('std::string s = "a", t = "a"; void one(const M&) { s = t; } void two(const M&) { pub(s); t = "b"; }'),
    ),
    case(
        "set through itself",
        "",
        "/a|/b",
        before=('std::string s = "a", t = "a"; void one(const M&) { pub(s); s = t; } void two(const M&) { t = "b"; }'),
    ),
    case(
        "element set by another",
        "",
        "/a|/b",
        before=(
            'std::string s; std::vector<std::string> v = {"a"}; void one(const M&) { v[0] = "b"; '
            "} void two(const M&) { pub(v[0]); }"
        ),
    ),
    case(
        "set by a function of another",
        "",
        "/a|/b",
        before=(
            'std::string s = "a"; void set() { s = "b"; } void one(const M&) { set(); } void two(const M&) { pub(s); }'
        ),
    ),
    case(
        "set in a struct by another",
        "",
        "/a|/b",
        before=(
            'std::string s; struct K { std::string t; }; K k{"a"}; void one(const M&) { k.t = '
            '"b"; } void two(const M&) { pub(k.t); }'
        ),
    ),
    case(
        "pointer moved by another",
        "",
        "/a|/b",
        before=(
            'std::string s = "a", t = "b"; std::string* q = &s; void one(const M&) { q = &t; } '
            "void two(const M&) { pub(*q); }"
        ),
    ),
    case(
        "swapped by another",
        "",
        "/a|/b",
        before=('std::string s = "a", t = "b"; void one(const M&) { std::swap(s, t); } void two(const M&) { pub(s); }'),
    ),
    case(
        "spinOnce in main",
        "ros::spinOnce(); ADV(r.s, 1);",
        "/a|/b",
        before='std::string s = "a"; void one(const M&) { s = "b"; } void two(const M&) {}',
    ),
    case(
        "spin in main",
        "ros::spin(); ADV(r.s, 1);",
        "/a|/b",
        before='std::string s = "a"; void one(const M&) { s = "b"; } void two(const M&) {}',
    ),
    case(
        "waits for a callback in main",
        'while (r.s == "a") ros::spinOnce(); ADV(r.s, 1);',
        "/b",
        before='std::string s = "a"; void one(const M&) { s = "b"; } void two(const M&) {}',
    ),
    case(
        "loop with spinOnce",
        "while (ros::ok()) { ros::spinOnce(); ADV(r.s, 1); }",
        "/a|/b",
        before='std::string s = "a"; void one(const M&) { s = "b"; } void two(const M&) {}',
    ),
    case(
        "spinner in main",
        "ros::AsyncSpinner q(1); q.start(); ADV(r.s, 1);",
        "/a|/b",
        before='std::string s = "a"; void one(const M&) { s = "b"; } void two(const M&) {}',
    ),
    case(
        "queue in main",
        "ros::getGlobalCallbackQueue()->callAvailable(); ADV(r.s, 1);",
        "/a|/b",
        before='std::string s = "a"; void one(const M&) { s = "b"; } void two(const M&) {}',
    ),
    case(
        "not set by any", "", "/a", before='std::string s = "a"; void one(const M&) { pub(s); } void two(const M&) {}'
    ),
    case(
        "set to the same",
        "",
        "/a",
        before='std::string s = "a"; void one(const M&) { s = "a"; } void two(const M&) { pub(s); }',
    ),
    case(
        "constant", "", "/a", before='const std::string s = "a"; void one(const M&) { pub(s); } void two(const M&) {}'
    ),
)
AROUND = """typedef std_msgs::String M;
struct R { ros::NodeHandle nh; ros::Subscriber u, v; %s
R() { u = nh.subscribe("u", 1, &R::one, this); v = nh.subscribe("v", 1, &R::two, this); }
void pub(const std::string& n) { nh.advertise<std_msgs::String>(n, 1); } };
"""

#: Why a row does not hold yet.
DEFECTS = because(
    ("functions whose names begin with std::, boost:: or are in capitals are taken for harmless (library.HARMLESS)"),
    "swapped by another",
) | because(
    "callbacks are not thought to run before the end of main (follow._call_back)",
    "spinner in main",
    "queue in main",
)


@table(CALLED, DEFECTS)
def test_what_is_called_back_is_followed(before: str, code: str, expected: list[str]) -> None:
    assert names(cpp(code, OUTSIDE + ROOTS)) == expected


@table(SHARED, DEFECTS)
def test_what_another_callback_may_change_is_not_told(before: str, code: str, expected: list[str]) -> None:
    got = cpp(f"R r; {code}", OUTSIDE + AROUND % before)
    assert admits(names(got), expected)
    well_formed(got)


def found(test: str, before: str, code: str) -> list[str]:
    if "followed" in test:
        return names(cpp(code, OUTSIDE + ROOTS))
    return names(cpp(f"R r; {code}", OUTSIDE + AROUND % before))


#: Members of other APIs: (member, constructor's list, body), kind, (name, type), column of the place.
MEMBERS = (
    ("tf::TransformBroadcaster b;", "C() { }", "publishers", [("/tf", "tf2_msgs/TFMessage")], (3, 5)),
    (
        "tf::TransformListener b;",
        "C() { }",
        "subscribers",
        [("/tf", "tf2_msgs/TFMessage"), ("/tf_static", "tf2_msgs/TFMessage")],
        (3, 5),
    ),
    (
        "image_transport::ImageTransport it; image_transport::Publisher b;",
        'C() : it(nh) { b = it.advertise("x", 1); }',
        "publishers",
        None,
        None,
    ),
    (
        "actionlib::SimpleActionClient<p::DoAction> b;",
        'C() : b("x", true) { }',
        "action_clients",
        [("/x", "p/Do")],
        (3, 7),
    ),
    (
        "actionlib::SimpleActionServer<p::DoAction> b;",
        'C() : b(nh, "x", false) { }',
        "action_servers",
        [("/x", "p/Do")],
        (3, 7),
    ),
)


@pytest.mark.parametrize(("member", "constructor", "kind", "expected", "place"), MEMBERS)
def test_members_make_what_their_constructors_make(
    member: str, constructor: str, kind: str, expected: list[tuple[str, str]] | None, place: tuple[int, int] | None
) -> None:
    text = f"#include <ros/ros.h>\nstruct C {{ ros::NodeHandle nh; {member}\n{constructor} }};\n"
    text += 'int main(int c, char** v) { ros::init(c, v, "n"); C x; }\n'
    got = node(follow({"p/CMakeLists.txt": CMAKE.format("p") + "add_executable(n m.cpp)\n", "p/m.cpp": text}))
    if expected is None:
        assert ("/x", "sensor_msgs/Image") in types(got, kind)
        return
    assert types(got, kind) == expected
    places = {(e.location.line, e.location.column) for e in ends(got, kind) if e.location}
    assert places == {place}
