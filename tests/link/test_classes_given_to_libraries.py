# SPDX-License-Identifier: Apache-2.0
"""Classes and objects that a library gets in a list, and classes of which it makes objects itself: handlers of servers, children of trees."""

from __future__ import annotations

import pytest
from follow_kit import ends, names, python

HANDLER = (
    "from http.server import BaseHTTPRequestHandler, HTTPServer\nclass H(BaseHTTPRequestHandler):\n"
    "    def do_GET(self):\n        self.answer()\n    def answer(self):\n        PUB('h')\n"
)
SOCKET = "import tornado.web, tornado.websocket\nclass H(tornado.websocket.WebSocketHandler):\n    def open(self):\n        PUB('h')\n"
RESOURCE = (
    "from flask_restful import Api, Resource\nclass H(Resource):\n    def __init__(self, topic='h'):\n        self.topic = topic\n"
    "    def get(self):\n        PUB(self.topic)\napi = Api(app())\n"
)
TREE = (
    "import py_trees\nclass H(py_trees.behaviour.Behaviour):\n    def __init__(self, topic):\n        super().__init__(topic)\n        self.topic = topic\n"
    "    def setup(self):\n        PUB(self.topic)\n"
)


@pytest.mark.parametrize(
    ("code", "expected"),
    [
        (HANDLER + "HTTPServer(('', 80), H).serve_forever()\n", ["/h"]),
        (HANDLER + "HTTPServer(server_address=('', 80), RequestHandlerClass=H)\n", ["/h"]),
        (HANDLER + "with HTTPServer(('', 80), H) as server:\n    server.serve_forever()\n", ["/h"]),
        (HANDLER + "class K(H):\n    pass\nHTTPServer(('', 80), K)\n", ["/h"]),
        (HANDLER.replace("BaseHTTPRequestHandler)", "abc.ABC, BaseHTTPRequestHandler)") + "HTTPServer(('', 80), H)\n", ["/h"]),
        (SOCKET + "tornado.web.Application([(r'/x', H), (r'/y', H)])\n", ["/h"]),
        (SOCKET + "tornado.web.Application(handlers=[('/x', H, {})])\n", ["/h"]),
        (SOCKET + "class A(tornado.web.Application):\n    def __init__(self):\n        every = [('/x', H)]\n        super().__init__(every)\nA()\n", ["/h"]),
        (RESOURCE + "api.add_resource(H, '/x')\n", ["/h"]),
        (RESOURCE + "import functools\napi.add_resource(functools.partial(H, 'i'), '/x')\n", ["/i"]),
        (RESOURCE + "import functools\napi.add_resource(functools.partial(H, topic='i'), '/x')\n", ["/i"]),
        (TREE + "root = py_trees.composites.Sequence('r')\nroot.add_children([H('a'), H('b')])\n", ["/a", "/b"]),
        (TREE + "py_trees.composites.Sequence(children=[H('a'), py_trees.composites.Selector(children=(H('b'),))])\n", ["/a", "/b"]),
        (TREE + "py_trees.run({'first': H('a'), 'more': [H('b')]})\n", ["/a", "/b"]),
    ],
)  # fmt: skip
def test_they_may_be_called(code: str, expected: list[str]) -> None:
    found = ends(python(code))
    assert sorted(end.name for end in found) == expected
    for end in found:
        (unknown,) = end.unknowns
        assert unknown.field == "conditions" and "by its base class" in unknown.reason


@pytest.mark.parametrize(
    "code",
    [
        HANDLER,
        HANDLER + "HTTPServer(('', 80), other())\n",
        HANDLER + "every = [H]\n",
        HANDLER + "print(H, [H])\n",
        HANDLER + "isinstance(other(), (H, int))\n",
        HANDLER + "HTTPServer(('', 80), 'H')\n",
        HANDLER + "def unused():\n    HTTPServer(('', 80), H)\n",
        HANDLER.replace("(BaseHTTPRequestHandler)", "") + "HTTPServer(('', 80), H)\n",
        HANDLER.replace("(BaseHTTPRequestHandler)", "(abc.ABC)") + "import abc\nHTTPServer(('', 80), H)\n",
        HANDLER.replace("(BaseHTTPRequestHandler)", "(Exception)") + "lib.retry(H)\n",
        "import enum\n" + HANDLER.replace("(BaseHTTPRequestHandler)", "(enum.Enum)") + "lib.take([H])\n",
        "import threading\n" + HANDLER.replace("(BaseHTTPRequestHandler)", "(threading.Thread)") + "lib.take(H)\n",
        HANDLER.replace("PUB('h')", "pass") + "HTTPServer(('', 80), H)\n",
        HANDLER.replace("self.answer()", "pass").replace("answer", "__answer") + "HTTPServer(('', 80), H)\n",
        SOCKET.replace("    def open", "    @staticmethod\n    def open") + "tornado.web.Application([('/x', H)])\n",
        "import asynctest, rostest\n"
        + HANDLER.replace("(BaseHTTPRequestHandler)", "(asynctest.TestCase)")
        + "rostest.rosrun('p', 'n', H)\n",
        "import aiounittest, rostest\n"
        + HANDLER.replace("(BaseHTTPRequestHandler)", "(aiounittest.AsyncTestCase)")
        + "rostest.rosrun('p', 'n', H)\n",
        TREE + "H('a')\n",
        TREE + "every = [H('a')]\nprint(every)\n",
    ],
)
def test_they_are_not_given_or_not_called(code: str) -> None:
    assert not names(python(code))


def test_what_the_constructor_makes_is_made_by_the_library() -> None:
    code = HANDLER.replace("    def do_GET", "    def __init__(self, *args):\n        PUB('made')\n    def do_GET")
    found = ends(python(code + "HTTPServer(('', 80), H)\nHTTPServer(('', 81), H)\n"))
    assert sorted(end.name for end in found) == ["/h", "/made"]
    assert all([unknown.field for unknown in end.unknowns] == ["conditions"] for end in found)


def test_lists_in_lists_without_end() -> None:
    code = TREE + "l = [H('a')]\nfor i in range(200):\n    l = [l, l]\nlib.take(l)\nm = []\nm.append(m)\nlib.take(m)\n"
    assert not names(python(code))
