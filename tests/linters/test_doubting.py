# SPDX-License-Identifier: Apache-2.0
"""What a text refutes is found out within limits: a large file with thousands of findings does not hold up the run."""

from __future__ import annotations

import pytest

from haros_ci.linters import pylint_doubts
from haros_ci.linters.doubting import MOST, Doubting
from haros_ci.linters.undefined_names import weighed_names
from haros_ci.model.location import Location
from haros_ci.results.result import Result
from haros_ci.results.rule import Level

#: A file of 500 kB.
MANY = 12_000
TEXT = "".join(f"def f{n}():\n    return name_number_{n}(1)\n" for n in range(MANY))


def test_what_is_beyond_the_limit_is_not_doubted() -> None:
    doubting, text = Doubting(), "x" * (MOST // 4)
    assert [doubting.may("a.py", "one", text) for _ in range(6)] == [True, True, True, True, False, False]
    assert doubting.may("a.py", "other", text) and doubting.may("b.py", "one", text), "each file and rule for itself"


@pytest.mark.parametrize(
    "rule", ["too-many-format-args", "implicit-str-concat", "unreachable", "no-value-for-parameter"]
)
def test_one_finding_in_a_large_file_does_not_take_long(rule: str) -> None:
    assert not any(pylint_doubts.is_refuted(rule, 2 * n + 2, 11, TEXT) for n in range(3))


def test_as_many_undefined_names_as_lines() -> None:
    results = [
        Result(
            "pylint",
            "undefined-variable",
            Level.ERROR,
            f"Undefined variable 'name_number_{n}'",
            Location("a.py", 2 * n + 2, 12),
        )
        for n in range(MANY)
    ]
    weighed = weighed_names(
        results, lambda path: f"{TEXT}# import name_number_3\n# import name_number_{MANY - 1}\n", lambda path: False
    )
    assert [n for n, result in enumerate(weighed) if result.level is not Level.ERROR] == [3], (
        "the last one stays as it is"
    )
