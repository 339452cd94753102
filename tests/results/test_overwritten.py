# SPDX-License-Identifier: Apache-2.0
"""A function that its block defines again before anything may call it never runs; all others may."""

from __future__ import annotations

import pytest

from haros_ci.results.overwritten import is_overwritten, is_used_before

FIRST = "def make():\n    return 1\n\n\n"
SECOND = "def make():\n    return 2\n"


@pytest.mark.parametrize(
    "between",
    [
        "",
        "import os\n\n\n",
        "LIMIT = 3\n\n\n",
        "def other():\n    return make()\n\n\n",
        "class Other:\n    def run(self):\n        return 1\n\n\n",
        "class Other:\n    @property\n    def run(self):\n        return make()\n\n\n",
        "'''a text'''\n",
    ],
)
def test_the_first_of_two(between: str) -> None:
    text = FIRST + between + SECOND
    assert is_overwritten(text, 2)
    assert not is_overwritten(text, text.count("\n"))


@pytest.mark.parametrize(
    "between",
    [
        "class Keep:\n    value = globals()['make']()\n\n\n",
        "class Keep:\n    value = getattr(HERE, 'make')()\n\n\n",
        "def keep(f):\n    vars()['ma' + 'ke']()\n    return f\n\n\n@keep\ndef other():\n    pass\n\n\n",
        "class Keep:\n    value = sys.modules[__name__].make()\n\n\n",
        "class Keep:\n    value = eval('ma' 'ke()')\n\n\n",
        "from builtins import globals as all_of_them\n\n\n",
        "@cached\ndef other(a=LIMIT):\n    return make()\n\n\n",
    ],
)
def test_a_function_that_may_be_reached_by_its_name_as_a_text(between: str) -> None:
    assert not is_overwritten(FIRST + between + SECOND, 2)


def test_methods_and_inner_functions() -> None:
    methods = "class Node:\n    def on(self):\n        pass\n\n    def on(self):\n        return 1\n"
    assert is_overwritten(methods, 3)
    inner = "def outer():\n    def on():\n        pass\n\n    def on():\n        return 1\n\n    return on\n"
    assert is_overwritten(inner, 3)
    assert is_overwritten("def make():\n    return 1\n\n\nclass make:\n    pass\n", 2)
    assert is_overwritten(FIRST + SECOND + SECOND, 6)


@pytest.mark.parametrize(
    "text",
    [
        FIRST,
        FIRST + "make()\n\n\n" + SECOND,
        FIRST + "def other():\n    return make()\n\n\nother()\n\n\n" + SECOND,
        FIRST + "old = make\n\n\n" + SECOND,
        FIRST + "def other(what=make):\n    return what()\n\n\n" + SECOND,
        FIRST + "def other(*, what=make):\n    return what()\n\n\n" + SECOND,
        FIRST + "@make\ndef other():\n    pass\n\n\n" + SECOND,
        FIRST + "@make\n" + SECOND,
        FIRST + "class Other:\n    run = make\n\n\n" + SECOND,
        FIRST + "class Other(make):\n    pass\n\n\n" + SECOND,
        FIRST + "if LIMIT:\n    def make():\n        return 2\n",
        "if LIMIT:\n    def make():\n        return 1\nelse:\n    def make():\n        return 2\n",
        "try:\n    def make():\n        return 1\nexcept NameError:\n    pass\n\n\n" + SECOND,
        "@overload\n" + FIRST + SECOND,
        "class A:\n    def on(self):\n        pass\n\n\nclass B:\n    def on(self):\n        pass\n",
        "class A:\n    @property\n    def on(self):\n        pass\n\n    @on.setter\n    def on(self, value):\n        pass\n",
        "def broken(:\n    pass\n",
        "",
    ],
)
def test_functions_that_may_run(text: str) -> None:
    assert not any(is_overwritten(text, line) for line in range(text.count("\n") + 2))


def second(text: str) -> int:
    """The line of the last definition."""
    return text[: text.rindex("def make")].count("\n") + 1


@pytest.mark.parametrize(
    "text",
    [
        FIRST + "subscribe(make)\n\n\n" + SECOND,
        FIRST + "first = make\n\n\n" + SECOND,
        FIRST + "make()\n\n\n" + SECOND,
        FIRST + "@make\ndef other():\n    pass\n\n\n" + SECOND,
        FIRST + "subscribe(make)\n\n\n@decorated\n" + SECOND,
        "for topic in topics:\n    def make():\n        pass\n    subscribe(make)\nfor topic in others:\n    def make():\n        pass\n",
        "def f(a):\n    if a:\n        def make():\n            pass\n        use(make)\n    def make():\n        pass\n",
        FIRST + "if LIMIT:\n    subscribe(make)\n    def make():\n        return 1\n",
        "if LIMIT:\n    pass\n\n\nclass A:\n    def make(self):\n        pass\n\n    on = make\n\n    def make(self):\n        return 1\n",
    ],
)
def test_what_is_used_before_it_is_replaced(text: str) -> None:
    assert is_used_before(text, second(text))
    assert not is_used_before(text, 1)


@pytest.mark.parametrize(
    "text",
    [
        FIRST + SECOND,
        FIRST + "subscribe(other)\n\n\n" + SECOND,
        FIRST + "def other():\n    return make()\n\n\n" + SECOND,
        FIRST + SECOND + "\n\nsubscribe(make)\n",
        "subscribe(make)\n\n\n" + FIRST + SECOND,
        "for topic in topics:\n    def make():\n        pass\nfor topic in others:\n    def make():\n        pass\n    subscribe(make)\n",
        "if a:\n    def make():\n        pass\n    def other():\n        return make()\nif b:\n    def make():\n        pass\n",
        "def broken(:\n    pass\n\n\n" + SECOND,
    ],
)
def test_what_is_replaced_unused(text: str) -> None:
    assert not any(is_used_before(text, line) for line in range(text.count("\n") + 2))


def test_many_definitions_are_cheap() -> None:
    """Pairs of names and statements are bounded: what is beyond is not called overwritten."""
    few = "".join(f"def f{i}():\n    pass\n" for i in range(50)) * 2
    assert is_overwritten(few, 1)
    many = "".join(f"def f{i}():\n    pass\n" for i in range(4_000)) * 2
    assert not is_overwritten(many, 8_000)
    used = "".join(f"def f{i}():\n    pass\n" for i in range(4_000)) + "g(f3999)\n" + "def f3999():\n    pass\n"
    assert is_used_before(used, 8_002)
    crossed = "".join(f"def f{i}():\n    pass\n" for i in range(4_000)) + "g(f3999)\n"
    assert not is_used_before(crossed + crossed, 16_000)
    calls = "g(f)\n" * 5_000
    assert not is_used_before(calls + "for x in y:\n" + "    def f():\n        pass\n" * 5_000, 15_000)
