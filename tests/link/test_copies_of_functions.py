# SPDX-License-Identifier: Apache-2.0
"""A function that stands in two headers: bodies that are the same but for their places are one function."""

from __future__ import annotations

import pytest
from follow_kit import cpp, names

USE = 'ros::Publisher pub = ADV(topic() + "/b", 1);'
INCLUDED = '#include "first.h"\n#include "second.h"'
ONE = 'inline std::string topic()\n{\n  std::string base = "/a";\n  if (base.empty()) { return "x"; }\n  return base;\n}\n'


@pytest.mark.parametrize("before", ["", "\n\n", "int before();\n"])
def test_the_same_body_at_other_lines(before: str) -> None:
    assert names(cpp(USE, INCLUDED, first__h=ONE, second__h=before + ONE)) == ["/a/b"]


def test_spaces_and_comments_are_no_body() -> None:
    other = ONE.replace("  ", "      ").replace(";\n", " ;  // here\n")
    assert names(cpp(USE, INCLUDED, first__h=ONE, second__h=other)) == ["/a/b"]


@pytest.mark.parametrize(
    ("old", "new"), [('"/a"', '"/c"'), ("base.empty()", "!base.empty()"), ("return base", "return base + base")]
)
def test_another_body_is_another_function(old: str, new: str) -> None:
    assert names(cpp(USE, INCLUDED, first__h=ONE, second__h=ONE.replace(old, new))) != ["/a/b"]
