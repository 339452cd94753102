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


GIVEN = "import threading\ndef f(x, y='d'):\n    PUB(x + y)\nclass C:\n    def m(self, x, y='e'):\n        PUB(x + y)\n"


@pytest.mark.parametrize(
    ("call", "expected"),
    [
        ("threading.Thread(target=f, args=('a',), kwargs={'y': 'k'}).start()", ["/ak"]),
        ("threading.Thread(target=f, args=('a',)).start()", ["/ad"]),
        ("threading.Thread(target=f, args=['a', 'b']).start()", ["/ab"]),
        ("threading.Thread(None, f, 'name', ('a',)).start()", ["/ad"]),
        ("threading.Thread(target=f, kwargs=dict(x='b', y='j')).start()", ["/bj"]),
        ("threading.Timer(1.0, f, ['a']).start()", ["/ad"]),
        ("threading.Timer(1.0, f, args=('a',), kwargs={'y': 'h'}).start()", ["/ah"]),
        ("threading.Thread(target=C().m, args=('a',)).start()", ["/ae"]),
        ("for n in ('a', 'b'):\n    threading.Thread(target=f, args=(n,)).start()", ["/ad", "/bd"]),
        ("rospy.Subscriber('s', String, lambda m, a: PUB('cb_' + a), 'x')", ["/cb_x"]),
        ("rospy.Subscriber('s', String, callback=lambda m, a: PUB('cb_' + a), callback_args='y')", ["/cb_y"]),
        # what is not known, or not given
        ("threading.Thread(target=f, args=x()).start()", ["/?"]),
        ("threading.Thread(target=f, args=('a',), kwargs=x()).start()", ["/a?"]),
        ("threading.Thread(target=f, args=(x(),)).start()", ["/?d"]),
        ("threading.Thread(target=lambda: PUB('l')).start()", ["/l"]),
        ("rospy.Subscriber('s', String, lambda m: PUB('cb'))", ["/cb"]),
        ("rospy.Subscriber('s', String, lambda m: PUB('cb'), None, 1)", ["/cb"]),
    ],
)
def test_arguments_that_are_given_for_later(call: str, expected: list[str]) -> None:
    assert made(GIVEN + call) == expected


@pytest.mark.parametrize(
    ("body", "expected"),
    [
        ("d = {'a': 'x'}\ntry:\n    n = d['b']\n    PUB('a')\nexcept KeyError:\n    PUB('b')", ["/a!", "/b"]),
        ("d = {}\ntry:\n    n = d[1]\n    PUB('a')\nexcept (KeyError, IndexError):\n    PUB('b')", ["/a!", "/b"]),
        # what has the key, or may have it
        ("d = {'a': 'x'}\ntry:\n    PUB(d['a'])\nexcept KeyError:\n    PUB('b')", ["/b", "/x"]),
        ("d = {'a': 'x'}\nd['b'] = 'y'\ntry:\n    PUB(d['b'])\nexcept KeyError:\n    PUB('b')", ["/b", "/y"]),
        (
            "d = {'a': 'x'}\nd[x()] = 'y'\ntry:\n    n = d['b']\n    PUB('a')\nexcept KeyError:\n    PUB('b')",
            ["/a", "/b"],
        ),
        (
            "d = {'a': 'x'}\nd.update(x())\ntry:\n    n = d['b']\n    PUB('a')\nexcept KeyError:\n    PUB('b')",
            ["/a", "/b"],
        ),
        (
            "from collections import defaultdict\nd = defaultdict(str)\ntry:\n    n = d['b']\n    PUB('a')\nexcept KeyError:\n    PUB('b')",
            ["/a", "/b"],
        ),
        ("d = {'a': 'x'}\ntry:\n    n = d.get('b')\n    PUB('a')\nexcept KeyError:\n    PUB('b')", ["/a", "/b"]),
        ("d = {'a': 'x'}\ntry:\n    n = d['b']\n    PUB('a')\nexcept ValueError:\n    PUB('b')", ["/a", "/b"]),
    ],
)
def test_a_dictionary_without_the_key(body: str, expected: list[str]) -> None:
    assert made(body) == expected


MAKE = "def make(n):\n    def cb(m):\n        PUB('t_' + n)\n    return cb\n"
SUB = "rospy.Subscriber('s', String, %s)"


@pytest.mark.parametrize(
    ("body", "expected"),
    [
        ("for n in ('a', 'b'):\n    " + SUB % "lambda m, n=n: PUB('t_' + n)", ["/t_a", "/t_b"]),
        ("for i in range(2):\n    " + SUB % "lambda m, k=i + 1: PUB('t_%d' % k)", ["/t_1", "/t_2"]),
        (
            "def go():\n    for n in ('a', 'b'):\n        def cb(m, k=n):\n            PUB('t_' + k)\n        "
            + SUB % "cb"
            + "\ngo()",
            ["/t_a", "/t_b"],
        ),
        (MAKE + "for n in ('a', 'b'):\n    " + SUB % "make(n)", ["/t_a", "/t_b"]),
        (MAKE + SUB % "make('a')" + "\n" + SUB % "make('b')", ["/t_a", "/t_b"]),
        ("fs = []\nfor n in ('a', 'b'):\n    fs.append(lambda k=n: PUB(k))\nfor f in fs:\n    f()", ["/a", "/b"]),
        ("class C:\n    T = 'c'\n    def go(self, t=T):\n        PUB(t)\nC().go()\nC().go('d')", ["/c", "/d"]),
        ("T = 'm'\nclass C:\n    T = 'c'\n    def go(self, t=T):\n        PUB(t)\nC().go()", ["/c"]),
        # what is as it was
        ("f = lambda n='a', q=1: PUB(n)\nf()\nf('b')", ["/a", "/b"]),
        (
            "def go(n):\n    def pub(t, k='d'):\n        PUB(n + t + k)\n    pub('x')\n    pub('y', 'z')\ngo('a')",
            ["/axd", "/ayz"],
        ),
        (MAKE + SUB % "make('a')" + "\n" + SUB % "make('a')", ["/t_a"]),
        (MAKE + SUB % "make(x())", ["/t_?"]),
        ("n = 'a'\n" + SUB % "lambda m: PUB(n)", ["/a"]),
        ("T = 'm'\nclass C:\n    def go(self, t=T):\n        PUB(t)\nC().go()", ["/m"]),
        ("def go():\n    n = 'a'\n    f = lambda: PUB(n)\n    n = 'b'\n    f()\ngo()", ["/b"]),
    ],
)
def test_what_a_function_takes_along(body: str, expected: list[str]) -> None:
    assert made(body) == expected


MP, POOL, FUTURES = (
    "import multiprocessing as mp\n",
    "import multiprocessing as mp\np = mp.Pool(2)\n",
    "import concurrent.futures as c\n",
)
WITH = FUTURES + "with c.ThreadPoolExecutor(max_workers=2) as e:\n    "


@pytest.mark.parametrize(
    ("call", "expected"),
    [
        (MP + "mp.Process(target=f, args=('a',), kwargs={'y': 'k'}).start()", ["/ak"]),
        (MP + "mp.Process(None, f, 'name', ('a',)).start()", ["/ad"]),
        (MP + "mp.get_context('spawn').Process(target=f, args=('a',)).start()", ["/ad"]),
        (MP + "for i in range(1):\n    mp.Process(target=f, args=('sim%d' % (i + 1),)).start()", ["/sim1d"]),
        (
            MP + "class P(mp.Process):\n    def __init__(self, n):\n        super().__init__()\n        self.n = n\n"
            "    def run(self):\n        f(self.n)\nP('a').start()",
            ["/ad"],
        ),
        (WITH + "e.submit(f, 'a', y='q')", ["/aq"]),
        (WITH + "e.map(f, ['a', 'b'])", ["/ad", "/bd"]),
        (
            FUTURES
            + "class X:\n    def __init__(self):\n        self.e = c.ProcessPoolExecutor()\n        self.e.submit(f, 'a')\nX()",
            ["/ad"],
        ),
        (POOL + "p.apply_async(f, args=('a',), kwds={'y': 'w'})", ["/aw"]),
        (POOL + "p.map(f, ['a', 'b'])", ["/ad", "/bd"]),
        # what is not known, or not given
        (MP + "mp.Process(target=f, args=x()).start()", ["/?"]),
        (MP + "mp.Process(target=f, args=(x(),)).start()", ["/?d"]),
        (MP + "mp.Process(target=lambda: PUB('l')).start()", ["/l"]),
        (MP + "mp.Process(target=x()).start()", []),
        (MP + "class P(mp.Process):\n    def go(self):\n        f('a')\nP().start()", []),
        (WITH + "e.map(f, x())", ["/?d"]),
        (WITH + "e.map(f, ['a'], ['b'])", ["/ab"]),
        (WITH + "e.map(f, ['a'], x())", ["/?"]),
        (WITH + "e.submit(f, *x())", ["/?"]),
        (POOL + "p.map(f, [])", ["/?d"]),
        (POOL + "p.apply(f, x())", ["/?"]),
    ],
)
def test_arguments_that_processes_and_pools_are_given(call: str, expected: list[str]) -> None:
    assert made(GIVEN + call) == expected
