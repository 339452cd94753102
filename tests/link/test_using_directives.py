# SPDX-License-Identifier: Apache-2.0
"""Classes that are declared in a namespace and defined under a using-directive of it."""

from __future__ import annotations

import pytest
from follow_kit import CPP_HEAD, cpp, names

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
    assert names(found) == ["/?"]
