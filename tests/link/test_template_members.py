# SPDX-License-Identifier: Apache-2.0
"""C++: members of what a template parameter stands for, and of class templates: types, constants, aliases."""

from __future__ import annotations

import pytest
from follow_kit import case, cpp, names, table
from ros2_cpp_kit import KEPT, component, explicit, last, only, policies

SPECS = """
namespace specs {
struct Speed {
  using Message = std_msgs::msg::String;
  static constexpr char name[] = "/speed";
  static constexpr size_t depth = 3;
  static constexpr auto durability = RMW_QOS_POLICY_DURABILITY_TRANSIENT_LOCAL;
};
}
template <class SpecT> rclcpp::QoS quality() {
  rclcpp::QoS qos(SpecT::depth);
  qos.durability(SpecT::durability);
  return qos;
}
template <class SpecT, class NodeT> void create(NodeT * node) {
  auto p = node->template create_publisher<typename SpecT::Message>(SpecT::name, quality<SpecT>());
}
template <class SpecT> class Publisher {
public:
  using SpecType = SpecT;
  using SharedPtr = std::shared_ptr<Publisher<SpecT>>;
  int number_;
};
class Adaptor {
public:
  explicit Adaptor(rclcpp::Node * node) : node_(node) {}
  template <class SharedPtrT> void init(SharedPtrT & publisher) const {
    using SpecT = typename SharedPtrT::element_type::SpecType;
    create<SpecT>(node_);
  }
  template <class SharedPtrT> void again(SharedPtrT & publisher) const {
    using SpecT = typename SharedPtrT::element_type::SpecType;
    create<SpecT>(node_);
  }
  rclcpp::Node * node_;
};
"""


@pytest.mark.parametrize(
    ("body", "members"),
    (
        ("create<specs::Speed>(this);", ""),
        ("using S = specs::Speed; create<S>(this);", ""),
        ("Adaptor adaptor(this); adaptor.init(p_);", "Publisher<specs::Speed>::SharedPtr p_;"),
        ("Adaptor adaptor(this); adaptor.again(p_);", "std::shared_ptr<Publisher<specs::Speed>> p_;"),
        ("create_publisher<Spec::Message>(Spec::name, quality<Spec>());", "using Spec = specs::Speed;"),
    ),
)
def test_members_of_what_a_parameter_stands_for(body: str, members: str) -> None:
    end = only(component(body, members, SPECS))
    assert (end.name, end.type, policies(end)) == ("/speed", "std_msgs/msg/String", last(3, "reliable", KEPT))


def test_members_that_are_not_known() -> None:
    (end,) = explicit(component("create<elsewhere::Speed>(this);", "", SPECS))
    assert (end.name, end.type) == ("/?", None)
    assert {unknown.field for unknown in end.unknowns} == {"name", "type", "qos"}


def test_a_name_of_the_function_is_meant_before_those_of_libraries() -> None:
    body = 'using rclcpp::QoS; create_publisher<String>("a", QoS{2});'
    assert policies(only(component(body))) == last(2)


def test_what_a_class_template_constructs_is_made_for_each_of_many_arguments() -> None:
    before = "template <class T> class Wrapper { public: void init(rclcpp::Node & n) { m_ = std::make_unique<T>(n); }"
    before += " std::unique_ptr<T> m_; };"
    for number in range(6):
        idle = "".join(f"int i{step} = {step};" for step in range(100))
        before += (
            f'class M{number} {{ public: explicit M{number}(rclcpp::Node & n) {{ {idle} n.create_publisher<String>("m{number}", 1);'
            f" }} int x_; }}; class P{number} : public Wrapper<M{number}> {{ int y_; }};"
        )
    body = "".join(f"P{number} p{number}; p{number}.init(*this);" for number in range(6))
    assert [end.name for end in explicit(component(body, "", before))] == [f"/m{number}" for number in range(6)]


OF_TUPLES = """
struct A { void make(ros::NodeHandle& nh) { nh.advertise<std_msgs::String>("a", 1); } };
struct B { void make(ros::NodeHandle& nh) { nh.advertise<std_msgs::String>("b", 1); } };
using All = std::tuple<A, B>;
template<size_t N> void put(ros::NodeHandle& nh) { std::tuple_element_t<N, All> x; x.make(nh); }
"""


@table((
    case("an element", "std::tuple_element_t<1, std::tuple<A, B>> x; x.make(nh);", "/b", before=OF_TUPLES),
    case("of another name", "std::tuple_element_t<0, All> x; x.make(nh);", "/a", before=OF_TUPLES),
    case("its member", "typename std::tuple_element<1, All>::type x; x.make(nh);", "/b", before=OF_TUPLES),
    case("by a number that is given", "put<0>(nh); put<1>(nh);", "/a", "/b", before=OF_TUPLES),
    case("none of that number", "std::tuple_element_t<2, All> x; x.make(nh);", before=OF_TUPLES),
))  # fmt: skip
def test_elements_of_the_types_of_tuples(before: str, code: str, expected: list[str]) -> None:
    assert names(cpp(code, before)) == expected


TAKING = "template<typename T> class C { public: void cb(%s m) {} int k_; };\nclass D { public: void cb(const std_msgs::Bool& m) {} };\n"


@pytest.mark.parametrize(
    ("parameter", "call", "kind"),
    [
        ("const typename T::ConstPtr&", "C<std_msgs::String> c; nh.subscribe(NAME, &C<std_msgs::String>::cb, &c)", "std_msgs/String"),
        ("const boost::shared_ptr<T const>&", "C<std_msgs::Bool> c; nh.subscribe(NAME, &C<std_msgs::Bool>::cb, &c)", "std_msgs/Bool"),
        ("const T&", "auto c = std::make_shared<C<std_msgs::Bool>>(); nh.subscribe(NAME, &C<std_msgs::Bool>::cb, c.get())", "std_msgs/Bool"),
        ("const T&", "D d; nh.subscribe(NAME, &D::cb, &d)", "std_msgs/Bool"),
        ("const T&", "C<Outside> c; nh.subscribe(NAME, &C<Outside>::cb, &c)", None),
    ],
)  # fmt: skip
def test_the_type_that_a_method_of_a_class_template_takes(parameter: str, call: str, kind: str | None) -> None:
    found = cpp(call.replace("NAME", '"t", 1') + ";", TAKING % parameter)
    assert [end.type for end in found.endpoints if end.kind == "subscribers"] == [kind]


PARTS = """#include <array>
class P { public: P() : rel_("~") {} void init(std::string const& n) { nh_ = ros::NodeHandle(rel_, n); p = nh_.advertise<std_msgs::String>("f", 1); }
 ros::NodeHandle rel_, nh_; ros::Publisher p; };
template <class T, unsigned int N> class Several { typedef std::array<T, N> Parts; Parts parts_; std::array<T, N> more_;
 public: Several() {} void start(std::string a, std::string b) { parts_.at(0).init(a); parts_[1].init(b); more_[N - 1].init("c"); } };
class Two : public Several<P, 2> { public: Two() {} };
"""


def test_an_array_of_as_many_as_a_template_parameter_says() -> None:
    assert names(cpp('Two t; t.start("x", "y");', PARTS)) == ["/n/c/f", "/n/x/f", "/n/y/f"]
