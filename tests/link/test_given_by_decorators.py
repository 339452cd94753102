# SPDX-License-Identifier: Apache-2.0
"""rospy: functions that decorators give to an object of a library that is not known (``@app.route("/x")``) may be called by it."""

from __future__ import annotations

import pytest
from follow_kit import ends, python

APP = "from flask import Flask\napp = Flask(__name__)\n"
DOUBT = "the decorator {} is not known, which is given the function and may call it"
MADE = "def go():\n    PUB('a')\n"
INSIDE = "    def go():\n        PUB('a')\n"

FIRES = {
    "a call": ("app.route", APP + "@app.route('/x')\n" + MADE),
    "no call": ("app.errorhandler", APP + "@app.errorhandler\n" + MADE),
    "below another": ("app.get", APP + "@app.get('/x')\n@other\n" + MADE),
    "under the guard": ("app.route", APP + "@app.route('/x')\n" + MADE + "if __name__ == '__main__':\n    app.run()\n"),
    "a member": ("web.app.route", "import flask\nweb = flask.Web()\n@web.app.route('/x')\n" + MADE),
    "in a function": ("app.route", APP + "def main():\n    @app.route('/x')\n" + INSIDE + "main()\n"),
    "in a method": (
        "route",
        "import flask\nclass A:\n    def __init__(self):\n        self.app = flask.Flask('n')\n"
        "        @self.app.route('/x')\n        def go():\n            PUB('a')\nA()\n",
    ),
}
QUIET = {
    "no decorator": APP + MADE,
    "a module's": "import numba\n@numba.jit(nopython=True)\n" + MADE,
    "a name": "from numba import jit\n@jit\n" + MADE,
    "the standard library's": "import functools\n@functools.lru_cache(maxsize=None)\n" + MADE,
    "a class of the workspace": "class A:\n    def keep(self, f):\n        return f\na = A()\n@a.keep\n" + MADE,
    "a method": APP + "class A:\n    @app.route('/x')\n    def go(self):\n        PUB('a')\n",
    "a property's setter": "class A:\n    @property\n    def x(self):\n        return 1\n    @x.setter\n    def x(self, v):\n        PUB('a')\n",
    "one that makes nothing": APP + "@app.route('/x')\ndef go():\n    return ''\n",
    "in a function that is not called": APP + "def main():\n    @app.route('/x')\n" + INSIDE,
}


@pytest.mark.parametrize(("name", "body"), FIRES.values(), ids=FIRES)
def test_the_library_may_call_it(name: str, body: str) -> None:
    (end,) = ends(python(body))
    assert (end.name, [unknown.reason for unknown in end.unknowns]) == ("/a", [DOUBT.format(name)])


@pytest.mark.parametrize("body", QUIET.values(), ids=QUIET)
def test_nothing_calls_it(body: str) -> None:
    assert ends(python(body)) == []


def test_what_the_program_calls_is_certain() -> None:
    (end,) = ends(python(APP + "@app.route('/x')\n" + MADE + "go()\n"))
    assert (end.name, end.unknowns) == ("/a", ())


def test_a_command_is_no_such_function() -> None:
    (end,) = ends(python("import click\n@click.group()\ndef cli():\n    pass\n@cli.command()\n" + MADE + "cli()\n"))
    assert (end.name, end.unknowns, [c.condition for c in end.conditions]) == ("/a", (), ["go"])
