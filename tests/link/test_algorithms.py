# SPDX-License-Identifier: Apache-2.0
"""Functions that rewrite a text as a whole, and calls of them that leave it unknown."""

from __future__ import annotations

import pytest
from follow_kit import cpp, names

OUTSIDE = (
    "#include <string>\n#include <algorithm>\n#include <boost/algorithm/string.hpp>\nstd::string text(); bool cond();\n"
)

TOLD = (
    ("std::replace(s.begin(), s.end(), 'B', '_');", "/a_ c/"),
    ("std::replace(s.begin(), s.end(), ' ', '/');", "/aB/c"),
    ("std::transform(s.begin(), s.end(), s.begin(), ::tolower);", "/ab c/"),
    ("std::transform(s.begin(), s.end(), s.begin(), std::toupper);", "/AB C/"),
    ("boost::to_lower(s);", "/ab c/"),
    ('boost::replace_all(s, "B c", "d");', "/ad"),
    ('boost::algorithm::erase_all(s, " ");', "/aBc"),
    ("s = boost::algorithm::to_lower_copy(s);", "/ab c/"),
    ("boost::to_lower_copy(s);", "/aB c/"),
    ('s = boost::trim_copy(" x "); ', "/x"),
    ('s = "Q/" + text(); boost::to_lower(s);', "/q/?"),
)

UNKNOWN = (
    "std::replace(s.begin() + 1, s.end(), 'B', '_');",
    "std::replace(s.begin(), s.end(), text()[0], '_');",
    "std::transform(s.begin(), s.end(), s.begin(), text);",
    "std::transform(s.begin(), s.end(), t.begin(), ::tolower); s = t;",
    'boost::replace_all(s, text(), "d");',
    "boost::trim_if(s, boost::is_any_of(text()));",
    "s = text(); boost::to_lower(s);",
)


@pytest.mark.parametrize(("code", "expected"), TOLD)
def test_what_a_text_becomes(code: str, expected: str) -> None:
    found = cpp(f'std::string s = "aB c"; {code} ADV(s, 1);', OUTSIDE)
    assert " ".join(names(found)).rstrip("/") == expected.rstrip("/")


@pytest.mark.parametrize("code", UNKNOWN)
def test_what_is_not_told(code: str) -> None:
    found = cpp(f'std::string s = "aB c", t = "T"; {code} ADV(s, 1);', OUTSIDE)
    assert names(found) == ["/?"]
