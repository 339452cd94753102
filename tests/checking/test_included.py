# SPDX-License-Identifier: Apache-2.0
"""Which headers are included in every build."""

from __future__ import annotations

import pytest

from haros_ci.checking.included import plain_includes


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("#include <a/b.h>\n", [("a/b.h", 1)]),
        ('\n\n  #  include "c.hpp"  // because\n', [("c.hpp", 3)]),
        ("#ifndef A_H\n#define A_H\n#include <a.h>\n#endif  // A_H\n#include <b.h>\n", [("a.h", 3), ("b.h", 5)]),
        ("#if !defined(A_H)\n#define A_H\n#include <a.h>\n#endif\n", [("a.h", 3)]),
        ("#pragma once\n#include <a.h>\n#ifdef X\n#include <b.h>\n#endif\n#include <c.h>", [("a.h", 2), ("c.h", 6)]),
        ("/*\n#include <a.h>\n*/\n#include <b.h>\n", [("b.h", 4)]),
    ],
)
def test_included_in_every_build(text: str, expected: list[tuple[str, int]]) -> None:
    assert list(plain_includes(text)) == expected


@pytest.mark.parametrize(
    "text",
    [
        "",
        "// #include <a.h>\n",
        "#ifdef ROS1\n#include <ros/ros.h>\n#else\n#include <rclcpp/rclcpp.hpp>\n#endif\n",
        "#if __has_include(<a/b.hpp>)\n#include <a/b.hpp>\n#else\n#include <a/b.h>\n#endif\n",
        "#ifndef A\n#define B\n#include <a.h>\n#endif\n",
        "#if X\n#if Y\n#endif\n#include <a.h>\n#endif\n",
        "#define NAME <a.h>\n#include NAME\n",
        "#ifndef A_H\n#define A_H\n#ifdef X\n#include <a.h>\n#endif\n#endif\n",
        "#endif\n#endif\n#if X\n#include <a.h>\n",
    ],
)
def test_not_included_for_sure(text: str) -> None:
    assert list(plain_includes(text)) == []
