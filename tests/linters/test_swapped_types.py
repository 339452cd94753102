# SPDX-License-Identifier: Apache-2.0
"""Python code that gives a name another meaning at run time is named where a change brings it."""

from __future__ import annotations

from pathlib import Path

import pytest
from linter_samples import workspace

from haros_ci.linters.swapped_types import notifications, swapped

FIRES = [
    "import std_msgs.msg as m\nm.String = m.Int32\n",
    "import std_msgs.msg\nstd_msgs.msg.String = std_msgs.msg.Int32\n",
    "from std_srvs import srv\nsrv.Empty = srv.Trigger\n",
    'import std_msgs.msg as m\nsetattr(m, "String", m.Int32)\n',
    'import sys\nsys.modules["std_msgs.msg"].String = Int32\n',
    'import sys\nsetattr(sys.modules[__name__], "String", Int32)\n',
    "String = 1\nglobals().update(String=Int32)\n",
    'String = 1\nglobals()["String"] = Int32\n',
]
QUIET = [
    "from std_msgs.msg import String\nmsg = String()\nmsg.data = 'a'\n",
    "from std_msgs import msg\nout = msg.String()\nout.data = 'a'\n",
    "import std_msgs.msg as m\nm = None\nn.String = 1\n",
    "def callback(msg):\n    msg.data = 1\n    setattr(msg, 'data', 2)\n",
    "from . import msg\nmsg.top = 1\n",
    "import msg\nmsg.top = 1\n",
    "import sys\nsys.modules['a'] = None\nprint(globals()['a'])\n",
    "self.globals = {}\nself.globals.update(a=1)\nself.globals['a'] = 1\n",
    "import std_msgs.msg as m\nsetattr(self, 'm', m.Int32)\nself.msg = m.String\n",
    "import std_msgs.msg as m\nclass A:\n    String = m.Int32\n",
    "msg.data = (\n",
    "",
]


@pytest.mark.parametrize("text", FIRES)
def test_fires(text: str) -> None:
    assert [line for line, _ in swapped(text)] == [2]


def test_what_is_said_of_deep_code() -> None:
    deep = " + ".join(["a"] * 3_000)
    text = f"import std_msgs.msg as m\nglobals()[{deep}] = 1\nsetattr(m, {deep}, 1)\nm.f({deep}).A = 1\nglobals().update(a=1)\n"
    assert [name for _, name in swapped(text)] in (
        [],  # too deep for the parser of this Python
        ["globals()[…] = …", "setattr(m, …, …)", "globals().update(…)"],
    )


@pytest.mark.parametrize("text", QUIET)
def test_stays_quiet(text: str) -> None:
    assert list(swapped(text)) == []


def test_what_a_change_brings(tmp_path: Path) -> None:
    before = "import std_msgs.msg as m\n"
    old, new, more, test = (
        workspace(tmp_path / name, {path: before + text})
        for name, path, text in (
            ("a", "n.py", ""),
            ("b", "n.py", "m.String = m.Int32\n"),
            ("c", "n.py", "m.String = m.Int32\nx = 1\n"),
            ("d", "test/test_n.py", "m.String = m.Int32\n"),
        )
    )
    (note,) = notifications(new, old)
    assert (note.path, note.line) == ("n.py", 2)
    assert note.message == (
        "since this change m.String = … gives a name another meaning at run time: "
        "the model has the one that is imported or defined"
    )
    assert notifications(more, new) == notifications(new, None) == notifications(test, old) == ()
