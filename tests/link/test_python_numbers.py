# SPDX-License-Identifier: Apache-2.0
"""Numbers of Python in parameters: their types by the operators and functions that make them, and constants of libraries."""

from __future__ import annotations

import math
from typing import Any

import pytest
from link.test_ros2_python import declared, node

HEAD = "import math\nimport os\nimport random\nimport time\nimport numpy as np\nfrom math import pi, radians, sqrt\nK = 3\n"


def parameter(value: str) -> tuple[str | None, Any]:
    """Type and default of a parameter that is declared with *value*, in which ``some`` is not known."""
    body = f"some = eval(input())\nself.declare_parameter('a', {value})"
    kind, default, _ = declared(node(body, head=HEAD))["a"]
    return kind, default


@pytest.mark.parametrize(
    ("value", "expected"),
    [
        ("-math.pi / 2", -math.pi / 2),
        ("math.pi", math.pi),
        ("2 * pi", 2 * math.pi),
        ("math.tau / 4", math.tau / 4),
        ("np.pi / 4", math.pi / 4),
        ("math.radians(90)", math.radians(90)),
        ("radians(90) + 1", math.radians(90) + 1),
        ("np.deg2rad(45)", math.radians(45)),
        ("sqrt(2)", math.sqrt(2)),
        ("math.atan2(1, 2)", math.atan2(1, 2)),
        ("1 / 2", 0.5),
        ("4 / 2", 2.0),
        ("2 ** -1", 0.5),
        ("K * 1.0", 3.0),
    ],
)
def test_numbers_that_are_known(value: str, expected: float) -> None:
    assert parameter(value) == ("double", expected)


@pytest.mark.parametrize(
    ("value", "expected"),
    [
        ("some / 2", "double"),
        ("2 / some", "double"),
        ("some * 0.5", "double"),
        ("1.0 - some", "double"),
        ("-(some * 0.5)", "double"),
        ("math.sqrt(some)", "double"),
        ("math.sqrt(some) + 1", "double"),
        ("time.time()", "double"),
        ("random.uniform(0, 1)", "double"),
        ("7 // 2", "int"),
        ("2 ** 8", "int"),
        ("K % 2", "int"),
        ("len(some)", "int"),
        ("len(some) * 2", "int"),
        ("int(some) + 1", "int"),
        ("int(some) / 2", "double"),
        ("some > 1", "bool"),
        ("not some", "bool"),
        ("'x%d' % some", "str"),
        ("'x' + some", "str"),
        ("some + 'x'", "str"),
    ],
)
def test_types_of_what_is_not_known(value: str, expected: str) -> None:
    assert parameter(value)[0] == expected


@pytest.mark.parametrize(
    "value",
    [
        "some",
        "-some",
        "some * 2",
        "2 * some",
        "some + 1",
        "1 + some",
        "some - 1",
        "some // 2",
        "some % 3",
        "2 ** some",
        "some ** 2",
        "some or 5",
        "some and 5",
        "100 if some else 1.0",
        "some * K",
        "some + [1]",
        "np.sqrt(some)",
        "np.sqrt([1, 2])",
        "math.sqrt(-1)",
        "math.acos(2)",
        "math.log(some, 2, 3)[0]",
        "os.cpu_count() * 2",
        "some / some",
        "math.something",
        "math.something * 2",
    ],
)
def test_types_that_are_not_known(value: str) -> None:
    assert parameter(value)[0] is None


@pytest.mark.parametrize("value", ["math.exp(1000)", "math.sqrt(10 ** 400)", "10.0 ** 400", "math.factorial(100000)"])
def test_numbers_that_are_too_large(value: str) -> None:
    assert parameter(value)[1] is None
