# SPDX-License-Identifier: Apache-2.0
"""C++: of classes of one name in several headers the one counts that the file includes, with its own methods."""

from __future__ import annotations

import pytest

from haros_ci.model.architecture import Node
from tests.link.follow_kit import CMAKE, CPP_HEAD, ends, follow, names, node, types

LOADED = """#pragma once
#include <nodelet/nodelet.h>
namespace q { template <typename To, typename From> class Msg : public nodelet::Nodelet {
  virtual void onInit() { ros::NodeHandle& h{ getPrivateNodeHandle() };
    p_ = h.advertise<To>("out", 1, true); s_ = h.subscribe("in", 1, &Msg::take, this); }
  void take(const boost::shared_ptr<From const> m) {}
  ros::Publisher p_; ros::Subscriber s_; To to_; };
}
"""
PLAIN = """#pragma once
namespace q { template <class To, class From> class Msg {
public:
  Msg(ros::NodeHandle& nh, const std::string a) : a_(a) { s_ = nh.subscribe(a, 1, &Msg::take, this); }
  void take(const typename From::ConstPtr& m) {}
  void more() {}
  ros::Subscriber s_; std::string a_; };
}
"""
USES = (
    CPP_HEAD
    + """#include <pluginlib/class_list_macros.h>
#include <std_msgs/Int32.h>
#include "p/{header}.hpp"
namespace q {{ using N = q::Msg<std_msgs::String, std_msgs::Int32>; using M = q::Msg<std_msgs::Int32, std_msgs::String>; }}
PLUGINLIB_EXPORT_CLASS(q::{name}, nodelet::Nodelet);
"""
)
WHOLE = [("/me/out", "std_msgs/String")]


def loaded(headers: dict[str, str], uses: str = "z", name: str = "N", **sources: str) -> Node:
    """The nodelet of *name*; *headers* by name, of which the library's file includes one, and more *sources*."""
    texts = {"src/q.cpp": USES.format(header=uses, name=name), **{f"src/{n}.cpp": text for n, text in sources.items()}}
    built = " ".join(sorted(texts))
    files = {
        "p/CMakeLists.txt": CMAKE.format("p") + f"include_directories(include)\nadd_library(q {built})\n",
        "p/package.xml": '<package format="2"><name>p</name><export><nodelet plugin="${prefix}/n.xml"/></export></package>',
        "p/n.xml": f'<library path="lib/libq"><class name="p/N" type="q::{name}" base_class_type="nodelet::Nodelet"/></library>',
        "p/launch/l.launch": '<launch><node pkg="nodelet" type="nodelet" name="me" args="standalone p/N"/></launch>',
        **{f"p/include/p/{header}.hpp": text for header, text in headers.items()},
        **{f"p/{path}": text for path, text in texts.items()},
    }
    return node(follow(files))


@pytest.mark.parametrize(
    "found",
    [
        {"z": LOADED},
        {"a": PLAIN, "z": LOADED},
        {"a": LOADED.replace('"out"', '"other"'), "z": LOADED},
        {"a": PLAIN, "b": PLAIN, "z": LOADED},
        {"a": PLAIN, "y": LOADED, "z": '#include "p/y.hpp"\n'},
    ],
)
def test_a_nodelet_is_the_class_that_is_included(found: dict[str, str]) -> None:
    made = loaded(found)
    assert types(made) == WHOLE
    assert types(made, "subscribers") == [("/me/in", "std_msgs/Int32")]


def test_each_alias_has_its_arguments() -> None:
    assert types(loaded({"a": PLAIN, "z": LOADED}, name="M")) == [("/me/out", "std_msgs/Int32")]


def test_another_file_of_the_library_includes_the_other() -> None:
    """The file counts that registers the class."""
    other = (
        CPP_HEAD
        + '#include "p/a.hpp"\nvoid use() { ros::NodeHandle nh; q::Msg<std_msgs::String, std_msgs::String> m(nh, "x"); }\n'
    )
    assert types(loaded({"a": PLAIN, "z": LOADED}, a=other)) == WHOLE


MAIN = (
    CPP_HEAD
    + """#include "{}.hpp"
int main(int argc, char** argv) {{ ros::init(argc, argv, "n"); ros::NodeHandle nh; K k(nh); k.go(nh); ros::spin(); }}
"""
)
CLASS = "#pragma once\nstruct K {{ K(ros::NodeHandle& nh) {{ {} }}\n{}\nros::Publisher p_; }};\n"
PUB = 'p_ = nh.advertise<std_msgs::String>("{}", 1);'
GO = "void go(ros::NodeHandle& nh) {{ {} }}"


def built(uses: str, **files: str) -> list[str]:
    cmake = CMAKE.format("p") + "include_directories(src)\nadd_executable(n src/main.cpp {})\n"
    sources = " ".join(f"src/{name}.cpp" for name, _, kind in (n.partition("__") for n in files) if kind == "cpp")
    texts = {f"p/src/{name.replace('__', '.')}": text for name, text in files.items()}
    made = node(follow({"p/CMakeLists.txt": cmake.format(sources), "p/src/main.cpp": MAIN.format(uses), **texts}))
    assert not [end for end in ends(made) if end.unknowns]
    return names(made)


def test_methods_are_those_of_the_class_that_is_included() -> None:
    one = CLASS.format(PUB.format("a"), GO.format(""))
    two = CLASS.format(PUB.format("b"), GO.format(PUB.format("c")))
    assert built("a", a__hpp=one, b__hpp=two) == ["/a"]
    assert built("b", a__hpp=one, b__hpp=two) == ["/b", "/c"]


def test_what_one_class_lacks_is_not_that_of_the_other() -> None:
    one = CLASS.replace("K(ros::NodeHandle& nh) {{ {} }}", "template <class T> K(T& t) {{}} {}").format("", "")
    two = CLASS.format(PUB.format("b"), GO.format(PUB.format("c")))
    assert built("a", a__hpp=one, b__hpp=two) == []
    assert built("b", a__hpp=one, b__hpp=two) == ["/b", "/c"]


def test_a_method_stands_in_a_file_of_its_own() -> None:
    one = CLASS.format("", "void go(ros::NodeHandle& nh);")
    two = CLASS.format(PUB.format("b"), GO.format(PUB.format("c")))
    body = '#include "{}.hpp"\nvoid K::go(ros::NodeHandle& nh) {{ {} }}\n'
    own = body.format("a", PUB.format("d"))
    assert built("a", a__hpp=one, b__hpp=two, k__cpp=CPP_HEAD + own) == ["/d"]
    assert built("a", a__hpp=one, k__cpp=CPP_HEAD + own) == ["/d"]
    assert built("a", a__hpp=one, b__hpp="struct K;\n", k__cpp=CPP_HEAD + own) == ["/d"]
    assert built("b", a__hpp=one, b__hpp=two, k__cpp=CPP_HEAD + own) == ["/b", "/c"]
