# SPDX-License-Identifier: Apache-2.0
"""Classes whose names are given away, and functions that are there twice."""

from __future__ import annotations

import pytest

from haros_ci.linters.pylint_doubts import is_refuted

CLASS = "class stop:\n    def pub(self):\n        pass\n\n\n"


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        (CLASS + "stop = stop()\nstop.pub()\n", True),
        (CLASS + "if __name__ == '__main__':\n    stop = stop()\n    while a:\n        stop.pub()\n", True),
        (CLASS + "for stop in make():\n    stop.pub()\n", True),
        (CLASS + "stop.pub()\n", False),
        (CLASS + "other = stop()\nstop.pub()\n", False),
        (CLASS + "a.stop = stop()\nstop.pub()\n", False),
        (CLASS + "# stop = stop()\nstop.pub()\n", False),
        ("import stop\nstop = stop.make()\nstop.pub()\n", False),
        (CLASS + "stop = stop()\nother.pub()\n", False),
        (CLASS + "stop = 1\nstop.pub(\n", False),
    ],
)
def test_the_name_of_a_class_that_is_given_away(text: str, expected: bool) -> None:
    last = text.rstrip("\n").split("\n")
    column = len(last[-1]) - len(last[-1].lstrip())
    assert is_refuted("no-value-for-parameter", len(last), column, text) is expected


TWICE = "{}def done(message):\n    global is_done\n    is_done = True\n\n\nother = 1\n{}def done(message):\n    global is_done{}\n    is_done = True\n"


@pytest.mark.parametrize(
    ("text", "line", "expected"),
    [
        (TWICE.format("", "", ""), 7, True),
        (TWICE.format("", "", "  # a comment"), 7, True),
        (TWICE.format("@a\n", "@a\n", ""), 8, True),
        (TWICE.format("", "", ", b"), 7, False),
        (TWICE.format("@a\n", "", ""), 8, False),
        (TWICE.format("", "", ""), 1, False),
        (TWICE.format("", "", "").replace("(message)", "(m)", 1), 7, False),
        ("class A:\n    def a(self):\n        pass\n    def a(self):\n        pass\n", 4, True),
        ("class A:\n    def a(self):\n        pass\nclass B:\n    def a(self):\n        pass\n", 5, False),
        ("def a():\n    pass\ndef a():\n    return 1\n", 3, False),
    ],
)
def test_a_function_that_is_there_twice(text: str, line: int, expected: bool) -> None:
    assert is_refuted("function-redefined", line, 0, text) is expected


ON = "{}\ndef done(data):\n    log(1)\n\n\n{}\ndef done(data):\n    log(2)\n"


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        (ON.format("@io.on('open')", "@io.on('close')"), True),
        (ON.format("@self.io.on('open', to='/a')", "@self.io.on('open', to='/b')"), True),
        (ON.format("@client.event('open')", "@client.listen('open')"), True),
        (ON.format("@io.on('open')", "@io.on('close')").replace("def", "async def"), True),
        (ON.format("@io.on('open')", "@io.on('open')"), False),
        (ON.format("@io.on('open')", ""), False),
        (ON.format("", "@io.on('close')"), False),
        (ON.format("@io.event", "@io.event"), False),
        (ON.format("@io.on()", "@io.on(1)"), False),
        (ON.format("@io.on(a)", "@io.on(b)"), False),
        (ON.format("@on('open')", "@on('close')"), False),
        (ON.format("@app.route('/a')", "@app.route('/b')"), False),  # Flask stops at the second one
        (ON.format("@mock.patch('a')", "@mock.patch('b')"), False),
        (ON.format("@io.on('open')\n@cached", "@io.on('close')\n@cached"), False),
        (ON.format("@io.on('open')", "@io.on('close')").replace("def done(data)", "class done"), False),
    ],
)
def test_functions_that_are_registered_under_other_names(text: str, expected: bool) -> None:
    line = text.count("\n", 0, text.rindex("done")) + 1
    assert is_refuted("function-redefined", line, 0, text) is expected


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("from utils.misc import *\n\n\ndef transform(a):\n    return a\n", True),
        ("from utils.misc import *\n\n\ntransform()\ndef transform(a):\n    return a\n", False),
        ("from utils.misc import *\ndef transform():\n    pass\n\n\ndef transform(a):\n    return a\n", False),
        ("import utils\n\n\ndef transform(a):\n    return a\n", False),
    ],
)
def test_a_function_in_place_of_one_of_a_star_import(text: str, expected: bool) -> None:
    line = text.count("\n", 0, text.rindex("def transform")) + 1
    assert is_refuted("function-redefined", line, 0, text) is expected


@pytest.mark.parametrize(
    ("body", "expected"),
    [
        ("self = super(Net, self).cuda()\n        return self", True),
        ("self = super().to(device)\n        self.a = 1\n        return self", True),
        ("self = super().to(device)\n        return 1", False),
        ("self = super().to(device)", False),
        ("self = Net()\n        return self", False),
        ("self = super\n        return self", False),
        ("self = other.super().to()\n        return self", False),
    ],
)
def test_an_object_that_its_base_class_gives_back(body: str, expected: bool) -> None:
    text = f"class Net(Base):\n    def cuda(self):\n        {body}\n"
    assert is_refuted("self-cls-assignment", 3, 8, text) is expected


COLOURED = "class Coloured(logging.Formatter):\n    red = 'r'\n    format = '%(message)s'\n{}\n    def format(self, record):\n        return {}\n"
USED = "    FORMATS = {1: red + format}\n"


@pytest.mark.parametrize(
    ("text", "line", "expected"),
    [
        (COLOURED.format(USED, "1"), 6, True),
        (COLOURED.format(USED, "Formatter(self.FORMATS[1]).format(record)"), 6, True),
        (COLOURED.format(USED, "self.format(record)"), 6, True),
        (COLOURED.format("    print(format)\n", "1"), 6, True),
        (COLOURED.format("    if debug:\n        a = format\n", "1"), 7, True),
        (COLOURED.format(USED + "    @wraps\n", "1").replace("@wraps\n\n", "@wraps\n"), 6, True),
        (COLOURED.format("", "1"), 5, False),  # nothing reads the text
        (COLOURED.format(USED, "self.format % record"), 6, False),  # this does, and gets the method
        (COLOURED.format(USED, "Coloured.format % record"), 6, False),
        (COLOURED.format(USED + "    format = 'b'\n", "1"), 7, False),
        (COLOURED.format("    other = lambda: 1\n", "1"), 6, False),
        (COLOURED.format("    def use(self):\n        return format\n", "1"), 7, False),
        (COLOURED.format("    # format\n", "1"), 6, False),
        (COLOURED.format("    format = red + format\n", "1"), 6, False),
        ("format = 'a'\nprint(format)\ndef format():\n    return 1\n", 3, False),
        ("class A:\n    b = '1'\nclass C:\n    d = b\n    def b(self):\n        pass\n", 5, False),
    ],
)
def test_a_value_of_a_class_that_is_used_before_a_method_takes_its_name(text: str, line: int, expected: bool) -> None:
    assert is_refuted("function-redefined", line, 0, text) is expected
