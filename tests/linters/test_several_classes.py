# SPDX-License-Identifier: Apache-2.0
"""Calls of what may be an object of several classes, and names that the main function sets for others."""

from __future__ import annotations

import pytest

from haros_ci.linters.pylint_doubts import is_refuted

CLASSES = "class Near:\n    def fetch(self):\n        pass\n\n\nclass Far:\n    def fetch(self, items, *, rate=1):\n        pass\n\n\n"
NODE = "class Node:\n    def __init__(self, near):\n{}\n\n    def run(self, items):\n        {}  # HERE\n"
BRANCHES = "        if near:\n            self.client = Near()\n        else:\n            self.client = Far()"
CHOICE = "        self.client = Near() if near else Far()"
NONE = "        self.client = None\n        self.client: Near = Near()\n        self.client = remote.Far()"


def refuted(rule: str, text: str, at: str) -> bool:
    lines = text.split("\n")
    line = next(number for number, one in enumerate(lines, 1) if "HERE" in one)
    return is_refuted(rule, line, lines[line - 1].index(at), text)


@pytest.mark.parametrize("made", [BRANCHES, CHOICE, NONE])
@pytest.mark.parametrize(
    ("rule", "call"),
    [
        ("no-value-for-parameter", "self.client.fetch()"),
        ("too-many-function-args", "self.client.fetch(items)"),
        ("unexpected-keyword-arg", "self.client.fetch(items, rate=3)"),
        ("unexpected-keyword-arg", "self.client.fetch(items=items)"),
        ("no-value-for-parameter", "self.client.fetch(*items)"),
    ],
)
def test_a_call_that_fits_one_of_them(made: str, rule: str, call: str) -> None:
    assert refuted(rule, CLASSES + NODE.format(made, call), "self")


@pytest.mark.parametrize(
    ("made", "call"),
    [
        (BRANCHES, "self.client.fetch(items, 3, 4)"),
        (BRANCHES, "self.client.fetch(size=3)"),
        (BRANCHES, "self.client.fetch(rate=3)"),
        (BRANCHES, "self.fetch()"),
        (BRANCHES, "self.other.fetch()"),
        (BRANCHES, "fetch()"),
        ("        self.client = Far()", "self.client.fetch()"),
        ("        self.client = Far()\n        self.other = Near()", "self.client.fetch()"),
        ("        self.client = Far()\n        self.client = Far()", "self.client.fetch()"),
        ("        self.client = Far()\n        self.client = make()", "self.client.fetch()"),
        ("        self.client = Far()\n        self.client = None", "self.client.fetch()"),
    ],
)
def test_a_call_that_fits_none(made: str, call: str) -> None:
    at = "fetch" if call.startswith("fetch") else "self"
    assert not refuted("no-value-for-parameter", CLASSES + NODE.format(made, call), at)


def test_what_a_class_of_another_file_takes_is_not_known() -> None:
    assert refuted("no-value-for-parameter", NODE.format(BRANCHES, "self.client.fetch()"), "self")


COUNT = "def on_text(data):\n    global count\n    count += 1  # HERE\n\n\n"
MAIN = 'def main():\n    global count, start\n    count = 0\n    run(on_text)\n\n\nif __name__ == "__main__":\n    main()\n'


@pytest.mark.parametrize(
    "text",
    [
        COUNT + MAIN,
        COUNT.replace("count += 1", "print(count)") + MAIN,
        COUNT.replace("    global count\n", "").replace("count += 1", "print(2 * count)") + MAIN,
        COUNT + MAIN.partition("if __name__")[0],  # an entry point
        COUNT + MAIN.replace("main()", "begin()"),
        COUNT + MAIN.replace("main()", "begin()").partition("if __name__")[0] + "begin()\n",
        "class Texts:\n    def on_text(self):\n        global count\n        count += 1  # HERE\n\n\n" + MAIN,
    ],
)
def test_a_global_name_that_main_sets(text: str) -> None:
    assert refuted("undefined-variable", text, "count")


@pytest.mark.parametrize(
    "text",
    [
        COUNT,
        COUNT + MAIN.replace("    global count, start\n", ""),
        COUNT + MAIN.replace("    count = 0\n", ""),
        COUNT + MAIN.replace("    count = 0\n", "    if start:\n        count = 0\n"),
        COUNT + MAIN.replace("    count = 0\n", "    count += 0\n"),
        COUNT + MAIN.replace("count = 0", "counts = 0"),
        COUNT + MAIN.replace("main()", "on_image()").partition("if __name__")[0],  # a callback, which may come later
        COUNT + MAIN.replace("def main", "def on_image"),
        "def main():\n    global count\n    while True:\n        print(count)  # HERE\n        count = 1\n    count = 2\n",
        "print(count)  # HERE\n\n\n" + MAIN,
        MAIN.replace("    count = 0\n", "    print(count)  # HERE\n    count = 0\n"),
    ],
)
def test_a_global_name_that_may_not_be_set(text: str) -> None:
    assert not refuted("undefined-variable", text, "count")


NUMPY = "from numpy import dot, sin as s\nimport numpy as np\n\n\ndef f(names, m):\n    at = CALL\n    print(names[at], at[2, 1])  # HERE\n"


@pytest.mark.parametrize("call", ["dot(m, dot(m, m))", "s(m)", "np.random.randint(len(m))", "np.linalg.inv(m)"])
@pytest.mark.parametrize("at", ["names", "at[2"])
def test_what_functions_of_numpy_give(call: str, at: str) -> None:
    text = NUMPY.replace("CALL", call)
    assert refuted("invalid-sequence-index", text, at)
    assert not refuted("invalid-sequence-index", text.replace("numpy", "numbers"), at)
    assert not refuted("invalid-sequence-index", text.replace(call, "other(m)"), at)
