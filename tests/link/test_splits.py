# SPDX-License-Identifier: Apache-2.0
"""Texts that a library parts at characters: topics in one parameter, with commas between them."""

from __future__ import annotations

import pytest
from follow_kit import cpp, names

EACH = "for (size_t i = 0; i < v.size(); i++) { ADV(v[i], 1); }"
SPLITS = (
    ('boost::split(v, s, boost::is_any_of(", "), boost::token_compress_on);', "a,b, c", ["/a", "/b", "/c"]),
    ('boost::algorithm::split(v, s, boost::algorithm::is_any_of(","));', "a,b", ["/a", "/b"]),
    ('boost::split(v, s, boost::is_any_of(";"));', "a,b", ["/a,b"]),
    ('boost::split(v, s, boost::is_any_of("-]"));', "a-b]c", ["/a", "/b", "/c"]),
    ('mrpt::system::tokenize(s, " ,\\t\\n", v);', " a, b ", ["/a", "/b"]),
    ('v.push_back("z"); mrpt::system::tokenize(s, ",", v);', "a", ["/a"]),
    # what is not known
    ("boost::split(v, s, f());", "a,b", ["/?"]),
    ('boost::split(v, s, boost::is_any_of(","), mode());', "a,b", ["/?"]),
    ('boost::split(v, g(), boost::is_any_of(","));', "a,b", ["/?"]),
    ('mrpt::system::tokenize(s, "", v);', "a", ["/?"]),
    ('if (g()) boost::split(v, s, boost::is_any_of(","));', "a,b", ["/?"]),
)


@pytest.mark.parametrize(("code", "text", "expected"), SPLITS)
def test_parts_of_a_text(code: str, text: str, expected: list[str]) -> None:
    body = f'std::vector<std::string> v; std::string s; nh.param<std::string>("s", s, "{text}"); {code} {EACH}'
    assert names(cpp(body, "#include <boost/algorithm/string.hpp>\n")) == expected


def test_how_many_parts_there_are() -> None:
    code = 'std::vector<std::string> v; boost::split(v, "x,,y", boost::is_any_of(",")); if (v.size() == 3) { ADV("a", 1); } else { ADV("b", 1); }'
    assert {end.name: end.is_ruled_out for end in cpp(code).endpoints} == {"/a": False, "/b": True}
