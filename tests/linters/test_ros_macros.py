# SPDX-License-Identifier: Apache-2.0
"""What of a spoiled cache gets into the header that cppcheck reads before every file: nothing but names."""

from __future__ import annotations

import pytest

from haros_ci.linters.ros_macros import header, names


def test_marks_that_are_names() -> None:
    assert names(["d:MY_EXPORT", "r:MY_CASE"]) == ("MY_CASE(...)", "MY_EXPORT")


@pytest.mark.parametrize(
    "mark",
    [
        'd:X\n#include "/etc/passwd"',
        "d:X\r#include </etc/passwd>",
        "d:X \\\n#pragma once",
        "d:X /*",
        "d:X(...) 1",
        "d:",
        "x:X",
        "r:lower\n",
        "",
    ],
)
def test_a_mark_that_is_no_name_is_left_out(mark: str) -> None:
    assert names([mark, "d:MY_EXPORT"]) == ("MY_EXPORT",)
    assert "passwd" not in header(names([mark]))
