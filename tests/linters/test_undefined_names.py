# SPDX-License-Identifier: Apache-2.0
"""Which undefined names are errors, which may be defined, and which are."""

from __future__ import annotations

from pathlib import Path

import pytest
from linter_samples import workspace

from haros_ci.linters.loaded_files import loaded_files
from haros_ci.linters.undefined_names import uses_gettext, weighed_names
from haros_ci.model.location import Location
from haros_ci.results.result import Result
from haros_ci.results.rule import Level


def level(name: str, text: str, *, ros1: bool = True, rule: str = "pylint:undefined-variable") -> Level | None:
    line = next(i for i, each in enumerate(text.split("\n"), 1) if name in each)
    column = text.split("\n")[line - 1].index(name) + 1
    tool, _, rule = rule.partition(":")
    said = Result(tool, rule, Level.ERROR, f"Undefined name `{name}`", Location("a.py", line, column))
    found = weighed_names([said], lambda path: text, lambda path: ros1)
    return found[0].level if found else None


@pytest.mark.parametrize(
    ("name", "text"),
    [
        ("corners", "print(corners)\n"),
        ("corners", "print('a', corners, 'b')\n"),
        ("corners", "print(f'{corners}')\n"),
        ("corners", "executor.exec(corners)\n"),
        ("corners", "corners\nexecutor.exec('corners = 1')\n"),
        ("corners", "corners\na = 'corners = 1'\n"),
        ("corners", "print(globals()); corners\n"),
        ("corners", "import sys\nif sys.version_info[0] < 3:\n    corners\n"),
    ],
)
def test_errors(name: str, text: str) -> None:
    assert level(name, text) is Level.ERROR and level(name, text, ros1=False, rule="ruff:F821") is Level.ERROR


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("exec('ret = et.' + cmd)\nret\n", None),
        ("line = 'ret = ' + cmd\nexec(line)\nret\n", None),
        ("exec('ret == et.' + cmd)\nret\n", Level.WARNING),
        ("exec('other = et.' + cmd)\nret\n", Level.WARNING),
        ("exec(cmd)\nret\n", Level.WARNING),
        ("ret\n# exec('ret = 1')\n", Level.ERROR),
    ],
)
def test_names_that_a_text_sets(text: str, expected: Level | None) -> None:
    assert level("ret", text) is expected


@pytest.mark.parametrize(
    ("name", "text"),
    [
        ("raw_input", "raw_input('go')\n"),
        ("xrange", "for i in xrange(3):\n    pass\n"),
        ("unicode", "isinstance(a, unicode)\n"),
    ],
)
def test_names_of_python_2(name: str, text: str) -> None:
    assert level(name, text) is None  # ROS 1: before Noetic there is nothing but Python 2
    assert level(name, "#!/usr/bin/env python\n" + text) is level(name, "#!/usr/bin/python2\n" + text) is None
    assert level(name, "#!/usr/bin/env python3\n" + text) is Level.WARNING
    assert level(name, text, ros1=False) is Level.ERROR
    assert level(name, "import sys\nif sys.version_info[0] < 3:\n    " + text.replace("\n", "\n    ")) is None
    assert level(name, f"try:\n    {name}\nexcept NameError:\n    pass\n") is None


@pytest.mark.parametrize(
    "text", ["def f(a: 'Node') -> None:\n", 'a: List["Node"] = []\n', "globals()['a'] = 1\nNode\n"]
)
def test_names_that_may_be_there(text: str) -> None:
    assert level("Node", text) is Level.WARNING
    assert level("Node", text, rule="flake8:F821") is Level.WARNING


def test_names_that_others_define() -> None:
    assert level("__class__", "__class__\n") is None
    assert level("_", "_('go')\n", rule="pylint:unused-variable") is Level.ERROR
    assert level("profile", "@profile\ndef f():\n    pass\n") is None
    assert level("profile", "def f():\n    return profile + 1\n") is Level.ERROR
    assert level("profile", "@other(profile)\ndef f():\n    pass\n") is Level.ERROR


@pytest.mark.parametrize(
    ("text", "is_used"),
    [
        ("import gettext\ngettext.install('robot')\n", True),
        ("import gettext\ngettext.translation('robot', 'po').install()\n", True),
        ("from gettext import gettext\nimport builtins\nbuiltins._ = gettext\n", True),
        ("# gettext.install('robot')\n", False),
        ("NOTE = 'gettext.install( )'\n", False),
        ("import gettext\n", False),
        ("", False),
    ],
)
def test_names_of_gettext(text: str, is_used: bool) -> None:
    assert uses_gettext(text) is is_used
    said = Result("pylint", "undefined-variable", Level.ERROR, "Undefined variable '_'", Location("a.py", 1, 1))
    found = weighed_names([said], lambda path: "_('go')\n", lambda path: False, is_translated=lambda: is_used)
    assert bool(found) is not is_used


@pytest.mark.parametrize(
    "text", ['TEXT = """\nfrom __future__ import annotations\n"""\n', "\"globals()['a'] = 1\"\n", "# exec(it)\n"]
)
def test_a_text_or_comment_makes_no_names(text: str) -> None:
    assert level("Node", text + "def f(a: Node): pass\n") is Level.ERROR


def test_a_level_that_the_settings_give_stands() -> None:
    said = Result("ruff", "F821", Level.ERROR, "Undefined name `xrange`", Location("a.py", 1, 1))
    assert weighed_names([said], lambda path: "xrange\n", lambda path: True, lambda result: True) == (said,)


LATE = "from __future__ import annotations\n"


@pytest.mark.parametrize(
    "text",
    [
        "HOME: Final = 1\n",
        "class A:\n    home: Final[str] = 'a'\n",
        "def f(a: int, b: list[Final]) -> None: ...\n",
        "def f(a: int) -> dict[str, Final]: ...\n",
        "def f(\n    a: int | Final,\n): ...\n",
    ],
)
def test_annotations_that_nothing_evaluates(text: str) -> None:
    assert level("Final", LATE + text) is Level.WARNING
    assert level("Final", text) is Level.ERROR


@pytest.mark.parametrize(
    "text",
    [
        "home: str = Final\n",
        "if home: Final\n",
        "print({1: Final})\n",
        "f = lambda a: Final\n",
        "def f(a=Final): ...\n",
        "a[1:Final]\n",
        "a[b:Final]\n",
    ],
)
def test_what_is_evaluated_all_the_same(text: str) -> None:
    assert level("Final", LATE + text) is Level.ERROR


LOADER = "module = imp.load_source('script', path)\nmodule.corners = corners\n"


@pytest.mark.parametrize(
    ("files", "expected"),
    [
        ({"load.py": LOADER, "config/a.yaml": "path: $(find p)/scripts/a.py\n"}, {"a.py"}),
        ({"load.py": "runpy.run_path('scripts/a.py')\n"}, {"a.py"}),
        ({"load.py": "with open(name) as f:\n    exec(f.read(), names)\nrun('a.py')\n"}, {"a.py"}),
        ({"load.py": "exec(compile(open('a.py').read(), 'a.py', 'exec'))\n"}, {"a.py"}),
        ({"load.py": "spec = importlib.util.spec_from_file_location('a', base + '/a.py')\n"}, {"a.py"}),
        ({"load.py": "exec text in names\nglob.glob('*.task.py')\n", "tasks/a.task.py": ""}, {"a.task.py"}),
        ({"load.py": "END = '.task.py'\n", "run.py": "exec(text, names)\n", "a.task.py": ""}, {"a.task.py"}),
        ({"load.py": "exec(text, names)\n", "tasks/a.task.py": ""}, set()),
        ({"load.py": "glob.glob('*.task.py')\n", "tasks/a.task.py": ""}, set()),
        ({"load.py": "exec(text, names)\nglob.glob('*.py')\n", "a.task.py": "", "b.py": ""}, set()),
        ({"load.py": "exec(text, names)\n# '*.task.py'\n", "tasks/a.task.py": ""}, set()),
        ({"load.py": "exec(text, names)\nglob.glob('*.launch.py')\n", "a.launch.py": ""}, set()),
        ({"load.py": "import a\n", "config/a.yaml": "path: scripts/a.py\n"}, set()),
        ({"load.py": LOADER, "launch/a.launch": '<launch><node pkg="p" type="a.py" name="a"/></launch>\n'}, set()),
        ({"setup.py": "exec(open('a/version.py').read())\n"}, set()),
        ({"load.py": "executor.exec(a)\nopen('a.py')\n"}, set()),
    ],
)
def test_files_that_are_loaded_by_path(files: dict[str, str], expected: set[str], tmp_path: Path) -> None:
    assert loaded_files(workspace(tmp_path, files, [])) == expected


def test_names_of_a_file_that_is_loaded() -> None:
    said = Result("pylint", "undefined-variable", Level.ERROR, "Undefined variable 'corners'", Location("s/a.py", 1, 1))
    given = ([said], lambda path: "corners\n", lambda path: False, lambda result: False)
    assert weighed_names(*given, lambda path: path == "s/a.py") == ()
    assert weighed_names(*given, lambda path: False) == (said,)


@pytest.mark.parametrize(
    "comment",
    [
        "#import matplotlib.pyplot as plt",
        "    # import matplotlib.pyplot as plt  # to debug",
        "# from matplotlib import pyplot as plt",
        "##import numpy, plt",
        "#import plt",
        "# from tools import draw, plt",
        "#from tools import plt, draw",
        "# from tools import (draw, plt)",
    ],
)
def test_names_whose_import_is_in_a_comment(comment: str) -> None:
    said = Result("pylint", "undefined-variable", Level.ERROR, "Undefined variable 'plt'", Location("a.py", 1, 1))
    (found,) = weighed_names([said], lambda path: f"plt.show()\n{comment}\n", lambda path: False)
    assert found.level is Level.WARNING
    assert weighed_names([said], lambda path: comment, lambda path: False, lambda result: True) == (said,)


@pytest.mark.parametrize(
    "comment",
    [
        "# plt draws the map",
        "# import matplotlib.pyplot as plot",
        "# import plt2",
        "# import the map and use plt for it",
        "# from plt import draw",
        "import matplotlib  # import matplotlib.pyplot as plt",
        "print('# import plt')",
        "#plt = None",
    ],
)
def test_names_that_only_a_sentence_tells_of(comment: str) -> None:
    said = Result("pylint", "undefined-variable", Level.ERROR, "Undefined variable 'plt'", Location("a.py", 1, 1))
    assert weighed_names([said], lambda path: f"plt.show()\n{comment}\n", lambda path: False) == (said,)


@pytest.mark.parametrize(
    "text",
    [
        "run()\nexit()\nprint(corners)\n",
        "import sys\nsys.exit(0)\ndef f():\n    return corners\n",
        "exit()\nfor each in a:\n    if each:\n        print(corners)\n",
        "if __name__ == '__main__':\n    run()\n    quit()\n    print(corners)\n",
        "if a:\n    pass\nelse:\n    exit()\n    print(corners)\n",
    ],
)
def test_behind_the_end_of_the_program(text: str) -> None:
    assert level("corners", text) is level("corners", text, rule="ruff:F821") is None


@pytest.mark.parametrize(
    "text",
    [
        "print(corners)\nexit()\n",
        "print('a'); exit(corners)\n",
        "def f():\n    return corners\nf()\nexit()\n",
        "if a:\n    exit()\nprint(corners)\n",
        "if a:\n    exit()\nelse:\n    print(corners)\n",
        "def f():\n    exit()\nprint(corners)\n",
        "while a:\n    exit()\nprint(corners)\n",
        "try:\n    exit()\nexcept SystemExit:\n    print(corners)\n",
        "from tools import exit\nexit()\nprint(corners)\n",
        "import tools as sys\nsys.exit()\nprint(corners)\n",
        "def exit():\n    pass\nexit()\nprint(corners)\n",
        "exit = run\nexit()\nprint(corners)\n",
        "class exit:\n    pass\nexit()\nprint(corners)\n",
        "for exit in a:\n    pass\nexit()\nprint(corners)\n",
        "a, exit = b\nexit()\nprint(corners)\n",
        "import sys\nsys.exit = run\nsys.exit()\nprint(corners)\n",
        "import sys\nsetattr(sys, 'exit', run)\nsys.exit()\nprint(corners)\n",
        "from tools import *\nexit()\nprint(corners)\n",
        "from tools import sys\nsys.exit()\nprint(corners)\n",
        "if (exit := run):\n    pass\nexit()\nprint(corners)\n",
        "parser.exit()\nprint(corners)\n",
        "exit\nprint(corners)\n",
        "exit()\nprint(corners\n",
    ],
)
def test_before_the_end_of_the_program(text: str) -> None:
    assert level("corners", text) is Level.ERROR


@pytest.mark.parametrize(
    "text",
    [
        "class A:\n    def f(self):\n        self.kind: Node['a', 'b'] = 'a'\n",
        "def f():\n    if True:\n        kind: Node = 1\n    return kind\n",
        "async def f():\n    kind: dict[\n        str, Node] = {}\n",
        "def f():\n    class A:\n        def g(self):\n            a: Node = 1\n",
    ],
)
def test_annotations_of_a_functions_variables_are_not_evaluated(text: str) -> None:
    assert level("Node", text) is Level.WARNING


@pytest.mark.parametrize(
    "text",
    [
        "kind: Node = 1\n",
        "class A:\n    kind: Node = 1\n",
        "def f(\n    a: Node,\n):\n    pass\n",
        "def f() -> Node:\n    pass\n",
        "def f():\n    kind: int = Node\n",
        "def f():\n    kind: int = 1; Node\n",
        "def f():\n    class A:\n        a: Node = 1\n",
        "def f():\n    def g(a: Node):\n        pass\n",
        "def f():\n    x = {1: Node}\n",
    ],
)
def test_other_annotations_are_evaluated(text: str) -> None:
    assert level("Node", text) is Level.ERROR


#: Whether the code around a name of Python 2 tells the versions apart; a mention elsewhere, or in a comment, is no test.
READY = [
    ("import sys\nif sys.version_info[0] < 3:\n    a = unicode(b)\n", True),
    ("from six import PY2\na = unicode(b) if PY2 else str(b)\n", True),
    ("try:\n    a = unicode(b)\nexcept NameError:\n    a = str(b)\n", True),
    ("def f(b):\n    if PY3:\n        return str(b)\n    return unicode(b)\n", True),
    ("def f(b):\n    try:\n        return unicode(b)\n    except (NameError, TypeError):\n        return b\n", True),
    ("class A:\n    if six.PY2:\n        a = unicode(b)\n", True),
    ("# sys.version_info\na = unicode(b)\n", False),
    ('"""For PY2."""\na = unicode(b)\n', False),
    ("import sys\nprint(sys.version_info)\na = unicode(b)\n", False),
    ("if PY2:\n    pass\na = unicode(b)\n", False),
    ("def g():\n    if PY2:\n        pass\ndef f(b):\n    return unicode(b)\n", False),
    ("def f(b):\n    # except NameError\n    return unicode(b)\n", False),
]


@pytest.mark.parametrize(("text", "is_ready"), READY)
def test_a_name_of_python_2_where_the_versions_are_told_apart(text: str, is_ready: bool) -> None:
    assert (level("unicode", text, ros1=False) is None) is is_ready
