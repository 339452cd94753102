# SPDX-License-Identifier: Apache-2.0
"""C++: a ``std::string_view`` of a literal is the text, as a ``std::string`` is."""

from __future__ import annotations

import pytest

from tests.link.follow_kit import cpp, names

GLOBAL = 'namespace { constexpr std::string_view N{"t"}; }\nstruct S { static constexpr std::string_view M{"t"}; const std::string_view n{"t"}; };\n'
KNOWN = [
    'std::string_view n{"t"}; ADV(n.data(), 1);',
    'std::string_view n = "t"; ADV(std::string(n), 1);',
    "ADV(N.data(), 1);",
    "ADV(S::M.data(), 1);",
    "S s; ADV(s.n.data(), 1);",
    'std::string s = "t"; std::string_view n = s; ADV(std::string{n}, 1);',
    'using namespace std; string_view n{"t"}; ADV(n.data(), 1);',
]
UNKNOWN = [
    'std::string_view n = "xt"; n.remove_prefix(1); ADV(std::string(n), 1);',
    "std::string_view n = asked(); ADV(n.data(), 1);",
    'other::string_view n{"t"}; ADV(n.data(), 1);',
]


@pytest.mark.parametrize("body", KNOWN)
def test_it_is_known(body: str) -> None:
    assert names(cpp(body, GLOBAL)) == ["/t"]


@pytest.mark.parametrize("body", UNKNOWN)
def test_it_is_not_known(body: str) -> None:
    assert names(cpp(body, "std::string asked();\n")) == ["/?"]
