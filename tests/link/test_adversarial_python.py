# SPDX-License-Identifier: Apache-2.0
"""Python programs that ran beside the model: exceptions that a function raises for certain."""

from __future__ import annotations

import pytest
from follow_kit import python

LOAD = "class E(Exception): pass\nclass F(E): pass\ndef load(s, kind=ValueError):\n    if s == 'bad':\n        raise %s\n    PUB('in')\n"


def made(body: str, raised: str = "ValueError(s)") -> list[str]:
    """The publishers of a program, ``!`` for those that are ruled out."""
    found = python(LOAD % raised + body).endpoints
    return sorted(end.name + "!" * end.is_ruled_out for end in found if end.kind == "publishers" and end.name != "/in")


TRY = "try:\n    load(%s)\n    PUB('a')\nexcept %s:\n    PUB('b')"


@pytest.mark.parametrize(
    ("call", "raised", "caught", "expected"),
    [
        ("'bad'", "ValueError(s)", "ValueError as e", ["/a!", "/b"]),
        ("'bad'", "ValueError(s)", "(KeyError, ValueError)", ["/a!", "/b"]),
        ("'bad'", "ValueError", "Exception", ["/a!", "/b"]),
        ("'bad'", "KeyError(s)", "LookupError", ["/a!", "/b"]),
        ("'bad'", "F(s)", "E", ["/a!", "/b"]),
        ("'bad'", "ValueError(s)", "", ["/a!", "/b"]),
        # what is not raised, not caught, or not for certain
        ("'good'", "ValueError(s)", "ValueError", ["/a", "/b"]),
        ("'bad'", "ValueError(s)", "KeyError", ["/a", "/b"]),
        ("'bad'", "E(s)", "F", ["/a", "/b"]),
        ("x()", "ValueError(s)", "ValueError", ["/a", "/b"]),
        ("'bad' if x() else 'good'", "ValueError(s)", "ValueError", ["/a", "/b"]),
        ("'bad'", "kind(s)", "KeyError", ["/a", "/b"]),
    ],
)
def test_what_stands_behind_a_function_that_raises(call: str, raised: str, caught: str, expected: list[str]) -> None:
    assert made((TRY % (call, caught)).replace("except :", "except:"), raised) == expected


@pytest.mark.parametrize(
    "body",
    [
        "try:\n    load('bad')\nexcept ValueError:\n    pass\nPUB('a')",
        "def go():\n    try:\n        load('bad')\n    except ValueError:\n        return None\n    return 1\ngo()\nPUB('a')",
        "try:\n    load('good')\nfinally:\n    PUB('a')",
    ],
)
def test_what_comes_after_the_try(body: str) -> None:
    assert made(body) == ["/a"]
