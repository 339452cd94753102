# SPDX-License-Identifier: Apache-2.0
"""A variable, or what a getter gives, has the value that the test around says, as long as nothing else is assigned to it."""

from __future__ import annotations

import pytest
from follow_kit import cpp, names, python

OUTSIDE = "std::string text(); int number(); std::string getSide(); struct S { std::string side; int kind; S(); void run(); };\n"
TOLD = (
    ('std::string s = text(); if (s == "left") { ADV(s + "/x", 1); }', ["/left/x"]),
    ('std::string s = text(); if ("left" == s) { ADV(s + "/x", 1); }', ["/left/x"]),
    ('std::string s = text(); if (s == "left" && number() > 1) { ADV(s + "/x", 1); }', ["/left/x"]),
    ('int i = number(); if (i == 2) { ADV("x" + std::to_string(i), 1); }', ["/x2"]),
    ('S s; s.side = text(); if (s.side == "left") { ADV(s.side + "/x", 1); }', ["/left/x"]),
    ('if (getSide() == "left") { ADV(getSide() + "/x", 1); }', ["/left/x"]),
    ('S* s = other(); if (s->getSide() == "left") { ADV(s->getSide() + "/x", 1); }', ["/left/x"]),
    ('std::string s = number() ? "a" : "b"; if (s == "a") { ADV(s + "/x", 1); }', ["/a/x"]),
    ('std::string s = text(); if (s == "a") { ADV(s, 1); } else if (s == "b") { ADV(s, 1); }', ["/a", "/b"]),
    # what the test does not say
    ('std::string s = text(); if (s == "left") { } ADV(s + "/x", 1);', ["/?/x"]),
    ('std::string s = text(); if (s == "left") { } else { ADV(s + "/x", 1); }', ["/?/x"]),
    ('std::string s = text(); if (s != "left") { ADV(s + "/x", 1); }', ["/?/x"]),
    ('std::string s = text(); if (s == "left" || number()) { ADV(s + "/x", 1); }', ["/?/x"]),
    ('std::string s = text(); if (!(s == "left")) { ADV(s + "/x", 1); }', ["/?/x"]),
    ('std::string s = text(); if (s == "left") { s = text(); ADV(s + "/x", 1); }', ["/?/x"]),
    ('std::string s = text(); if (s == "left") { s = text(); } ADV(s + "/x", 1);', ["/?/x"]),
    ('std::string s = text(); if (s == text()) { ADV(s + "/x", 1); }', ["/?/x"]),
    ('if (text() == "left") { ADV(text() + "/x", 1); }', ["/?/x"]),
    ('if (getSide() == "left") { } ADV(getSide() + "/x", 1);', ["/?/x"]),
    ('if (getSide() == "left") { ADV(getOther() + "/x", 1); }', ["/?/x"]),
    ('if (getSide(1) == "left") { ADV(getSide(2) + "/x", 1); }', ["/?/x"]),
    ('std::string s = "b"; if (text() == "a") { s = "a"; } ADV(s + "/x", 1);', ["/?"]),
)


@pytest.mark.parametrize(("code", "expected"), TOLD)
def test_in_cpp(code: str, expected: list[str]) -> None:
    assert names(cpp(code, OUTSIDE)) == expected


PYTHON = (
    ("s = f()\nif s == 'left':\n    PUB(s + '/x')\n", ["/left/x"]),
    ("if get_side() == 'left':\n    PUB(get_side() + '/x')\n", ["/left/x"]),
    ("s = f()\nif s == 'a':\n    PUB(s)\nelif s == 'b':\n    PUB(s)\nelse:\n    PUB(s + 'c')\n", ["/?c", "/a", "/b"]),
    ("s = f()\nif s == 'a':\n    s = s + 'b'\nPUB(s)\n", ["/?"]),
    ("s = f()\nif s in ('a', 'b'):\n    PUB(s)\n", ["/?"]),
    ("s = f()\nwhile s == 'a':\n    s = f()\nPUB(s)\n", ["/?"]),
)


@pytest.mark.parametrize(("body", "expected"), PYTHON)
def test_in_python(body: str, expected: list[str]) -> None:
    assert names(python(body)) == expected


def test_what_stands_under_another_test_of_the_same_is_decided() -> None:
    code = 'std::string s = text(); if (s == "a") { if (s == "b") { ADV("x", 1); } else { ADV("y", 1); } }'
    assert {end.name: end.is_ruled_out for end in cpp(code, OUTSIDE).endpoints} == {"/x": True, "/y": False}
