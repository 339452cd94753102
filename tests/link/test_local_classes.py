# SPDX-License-Identifier: Apache-2.0
"""C++: classes that functions define are followed as others, and mean nothing outside of their function ([class.local])."""

from __future__ import annotations

import pytest

from tests.link.follow_kit import cpp, names

BASE = "struct B { virtual void go(ros::NodeHandle & nh) = 0; void run(ros::NodeHandle & nh) { go(nh); } };\n"
MAKES = '{ ADV(std::string("t"), 1); }'
FIRES = [
    ("struct L { ros::NodeHandle nh; L() %s } l;" % MAKES, ""),
    ("class L { public: ros::NodeHandle nh; void go() %s }; L l; l.go();" % MAKES, ""),
    ("struct L { ros::NodeHandle & nh; void operator()() %s }; L l{nh}; l();" % MAKES, ""),
    ("struct D : B { void go(ros::NodeHandle & nh) override %s }; D d; B & b = d; b.run(nh);" % MAKES, BASE),
    ("go();", "void go() { struct L { ros::NodeHandle nh; void run() %s }; L().run(); }" % MAKES),
    ("W().go();", "struct W { void go() { struct L { ros::NodeHandle nh; L() %s } l; } };" % MAKES),
    ("W w;", "struct W { W() { struct L { ros::NodeHandle nh; L() %s } l; } };" % MAKES),
    ("[&] { struct L { ros::NodeHandle nh; L() %s } l; }();" % MAKES, ""),
    ("struct L { ros::NodeHandle nh; L() %s }; [] { L l; }();" % MAKES, ""),
    ("struct L { ros::NodeHandle nh; L() %s }; auto l = std::make_unique<L>();" % MAKES, ""),
]
QUIET = [
    ("struct L { ros::NodeHandle nh; void go() %s }; L l;" % MAKES, ""),
    ("struct L { ros::NodeHandle nh; L() %s };" % MAKES, ""),
    ("go(); L l;", "struct L {}; void go() { struct L { ros::NodeHandle nh; L() %s }; }" % MAKES),
    ("struct L {}; L l;", "struct L { ros::NodeHandle nh; L() %s };" % MAKES),
    ("go(); other();", "void go() { struct L { ros::NodeHandle nh; L() %s }; } void other() { L l; }" % MAKES),
    (
        "a(); b();",
        "void a() { struct L { ros::NodeHandle nh; L() %s }; } void b() { struct L { ros::NodeHandle nh; }; L l; }"
        % MAKES,
    ),
    ("W::L l;", "struct W { struct L {}; W() { struct L { ros::NodeHandle nh; L() %s } l; } };" % MAKES),
    ("struct L { static void go(ros::NodeHandle & nh) %s };" % MAKES, ""),
    ("L l;", "namespace a { void L() { ros::NodeHandle nh; %s } } struct L { int n = 0; };" % MAKES),
    ("{ struct L { ros::NodeHandle nh; void go() %s }; } go(nh);" % MAKES, "void go(ros::NodeHandle & nh) {}"),
    ("using L = W; L l;", "struct W {}; void go() { struct L { ros::NodeHandle nh; L() %s } l; }" % MAKES),
]


@pytest.mark.parametrize(("body", "before"), FIRES)
def test_what_a_local_class_makes(body: str, before: str) -> None:
    assert names(cpp(body, before)) == ["/t"]


@pytest.mark.parametrize(("body", "before"), QUIET)
def test_what_makes_nothing(body: str, before: str) -> None:
    assert names(cpp(body, before)) == []


def test_tables_of_a_local_struct() -> None:
    rows = 'struct E { const char * n; int q; }; E all[] = {{"a", 1}, {"b", 2}}; for (auto & e : all) ADV(std::string(e.n), e.q);'
    assert names(cpp(rows)) == ["/a", "/b"]
