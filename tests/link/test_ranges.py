# SPDX-License-Identifier: Apache-2.0
"""Numbers in a row, also those of Python 2."""

from __future__ import annotations

import pytest
from follow_kit import names, python

RANGES = (
    ("xrange(2)", "/p0 /p1"),
    ("xrange(1, 3)", "/p1 /p2"),
    ("xrange(4, 0, -2)", "/p2 /p4"),
    ("range(2)", "/p0 /p1"),
    ("list(xrange(2))", "/p0 /p1"),
    ("six.moves.range(2)", "/p0 /p1"),
)
FORMS = (
    "for i in {}:\n    PUB('p%d' % i)\n",
    "l = [rospy.Publisher('p' + str(i), String, queue_size=1) for i in {}]\n",
)


@pytest.mark.parametrize(("numbers", "expected"), RANGES)
@pytest.mark.parametrize("form", FORMS)
def test_ranges(form: str, numbers: str, expected: str) -> None:
    assert names(python("import six\n" + form.format(numbers))) == expected.split()


@pytest.mark.parametrize("name", ["range", "xrange"])
def test_a_number_that_a_constructor_is_given(name: str) -> None:
    body = (
        "class Rotor:\n    def __init__(self, i):\n        self.i = i\n    def turned(self, message):\n        pass\n"
        "class Drone:\n    def __init__(self, count):\n"
        f"        self.rotors = [Rotor(i) for i in {name}(count)]\n"
        f"        self.subs = [rospy.Subscriber('r' + str(i), String, self.rotors[i].turned) for i in {name}(count)]\n"
        "Drone(2)\n"
    )
    assert names(python(body), "subscribers") == ["/r0", "/r1"]


def test_the_name_of_either_version() -> None:
    body = "try:\n    xrange\nexcept NameError:\n    xrange = range\nfor i in xrange(2):\n    PUB('p%d' % i)\n"
    assert set(names(python(body))) in ({"/p0", "/p1"}, {"/p?"})


@pytest.mark.parametrize(
    "numbers", ["xrange(count())", "xrange(2.5)", "xrange(3000)", "xrange(int(rospy.get_param('n')))"]
)
def test_ranges_that_are_not_known(numbers: str) -> None:
    assert set(names(python(FORMS[0].format(numbers)))) <= {"/p?"}


def test_a_function_of_its_own_of_that_name() -> None:
    body = "def xrange(n):\n    return [n + 5]\nfor i in xrange(2):\n    PUB('p%d' % i)\n"
    assert names(python(body)) == ["/p7"]
