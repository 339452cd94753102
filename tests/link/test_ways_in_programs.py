# SPDX-License-Identifier: Apache-2.0
"""Python: what generated programs have shown (``tests/bench/run_oracle.py``): handlers that may end a loop, functions given to map, ways behind a return."""

from __future__ import annotations

import pytest

from tests.link.follow_kit import conditions, ends, names, python

LOOP = """
for x in ["a", "b", "c"]:
    try:
        y = open(x)
    except {handler}:
        {body}
    rospy.Publisher(x, String, queue_size=1)
"""


@pytest.mark.parametrize("handler", ["OSError", "Exception", "(KeyError, ValueError)"])
@pytest.mark.parametrize(
    "body",
    [
        "break",
        "continue",
        "if True: break",
        "if True: continue",
        "if len(x) == 1: break",
        "for z in [1]:\n            break",
        "pass",
        "raise",
    ],
)
def test_a_handler_that_may_end_a_loop_ends_no_turn_for_certain(handler: str, body: str) -> None:
    assert names(python(LOOP.format(handler=handler, body=body))) == ["/a", "/b", "/c"]


@pytest.mark.parametrize("body", ["if True: return", "return", "if x == 'a': return"])
def test_nor_a_function(body: str) -> None:
    text = (
        "def f(x):\n    try:\n        y = open(x)\n    except OSError:\n        {}\n"
        "    rospy.Publisher(x, String, queue_size=1)\nf('a')\nf('b')\n"
    )
    assert names(python(text.format(body))) == ["/a", "/b"]


UNKNOWN = "import random\nxs = ['a', 'b']\nif random.random() < 0.5:\n    xs.append('c')\n"


@pytest.mark.parametrize(
    "call",
    [
        "list(map(f, xs))",
        "for _ in map(f, xs):\n    pass",
        "list(filter(f, xs))",
        "list(map(lambda x: f(x), rospy.get_param('~unset')))",
        "tuple(map(f, reversed(xs)))",
    ],
)
def test_a_function_is_called_for_what_a_list_may_have(call: str) -> None:
    found = python(UNKNOWN + "def f(x):\n    rospy.Publisher('/p/' + x, String, queue_size=1)\n" + call)
    assert names(found) == ["/p/?"]


@pytest.mark.parametrize(
    ("call", "expected"),
    [
        ("list(map(f, ['a', 'b']))", ["/a", "/b"]),
        ("list(filter(f, ['a', 'b']))", ["/a", "/b"]),
        ("list(map(f, []))", []),
        ("list(map(str, ['a']))", []),
        ("list(filter(None, ['a']))", []),
        ("list(map(str, xs))", []),
    ],
)
def test_and_for_what_it_has(call: str, expected: list[str]) -> None:
    found = python(
        UNKNOWN + "def f(x):\n    rospy.Publisher(x, String, queue_size=1)\n    return random.random() < 0.5\n" + call
    )
    assert names(found) == expected


BEHIND = """
import random
def make():
    rospy.Publisher("a", String, queue_size=1)
def f():
    {before}
    if {test}:
        return
    make()
f()
"""


@pytest.mark.parametrize(
    ("before", "test", "expected"),
    [
        ("if random.random() < 0.5: make()", "1 > 0", ["random.random() < 0.5"]),
        ("make()", "1 > 0", []),
        ("if random.random() < 0.5: make()", "1 > 2", []),
    ],
)
def test_a_way_behind_a_return_that_is_taken_does_not_count(before: str, test: str, expected: list[str]) -> None:
    (end,) = ends(python(BEHIND.format(before=before, test=test)))
    assert [condition for _, condition, _, _ in conditions(end)] == expected


@pytest.mark.parametrize(
    ("change", "expected"),
    [
        ("v.append('b')", ["/?", "/a"]),
        ("v.extend(['b', 'c'])", ["/?", "/a"]),
        ("w.append('b')", ["/?", "/a"]),  # the same list
        ("v += ['b']", ["/?", "/a"]),
        ("u.append('b')", ["/a"]),
        ("v = ['b']", ["/a"]),
        ("v[:].append('b')", ["/a"]),
        ("len(v)", ["/a"]),
        ("sorted(v)", ["/a"]),
    ],
)
def test_a_list_that_grows_while_it_is_gone_through(change: str, expected: list[str]) -> None:
    text = f"u = ['u']\nv = ['a']\nw = v\nfor x in v:\n    rospy.Publisher(x, String, queue_size=1)\n    {change}\n    if len(v) > 3: break\n"
    assert sorted(names(python(text))) == expected


FINALLY = "def f(x):\n    try:\n        {}\n    except {}:\n        {}\n    finally:\n        rospy.Publisher(x, String, queue_size=1)\nf('a')\n"


@pytest.mark.parametrize(
    ("body", "handler", "ways"),
    [
        ("raise ValueError()", "ValueError", "return"),
        ("return open(x)", "OSError", "return None"),
        ("return open(x)", "OSError", "raise"),
        ("return open(x)", "OSError", "pass"),
        ("y = open(x)", "OSError", "return"),
        ("raise ValueError()", "ValueError", "pass"),
        ("raise ValueError()", "ValueError", "if x: return"),
        ("for y in [1]: break", "ValueError", "return"),
        ("while x: return", "ValueError", "raise"),
        ("for y in [1]: y = 2\n        else: return", "ValueError", "return"),
        ("y = " + " + ".join(["'a'"] * 900) + "\n        if y: return", "ValueError", "return"),
        (
            "if x == 0: y = 1\n" + "".join(f"        elif x == {n}: y = 1\n" for n in range(150)) + "        return",
            "ValueError",
            "return",
        ),
    ],
)
def test_finally_is_done_however_the_block_is_left(body: str, handler: str, ways: str) -> None:
    found = python(FINALLY.format(body, handler, ways))
    assert names(found) == ["/a"]
    assert all(not end.is_ruled_out for end in ends(found))


def test_finally_in_a_loop() -> None:
    text = (
        "for x in ['a', 'b']:\n    try:\n        y = open(x)\n    except OSError:\n        continue\n    else:\n        break\n"
        "    finally:\n        rospy.Publisher(x, String, queue_size=1)\n"
    )
    assert names(python(text)) == ["/a", "/b"]


NESTED = """
def f(fs):
    for g in fs:
        g("a")
def one(x):
    rospy.Publisher("/one/" + x, String, queue_size=1)
def two(x):
    rospy.Publisher("/two/" + x, String, queue_size=1)
"""


@pytest.mark.parametrize("depth", [0, 1, 2, 3, 4])
def test_functions_of_a_list_are_called_in_loops_in_loops(depth: int) -> None:
    loops = "".join(f"{' ' * level}for i{level} in ['x', 'y']:\n" for level in range(depth))
    assert names(python(f"{NESTED}{loops}{' ' * depth}f([one, two])\n")) == ["/one/a", "/two/a"]


@pytest.mark.parametrize("listed", ["[print, len]", "[]", "['one', 'two']"])
def test_other_lists_call_none_of_them(listed: str) -> None:
    loops = "".join(f"{' ' * level}for i{level} in ['x', 'y']:\n" for level in range(4))
    found = python(f"{NESTED}{loops}    f({listed})\n")
    assert names(found) == []
