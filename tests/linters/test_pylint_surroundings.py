# SPDX-License-Identifier: Apache-2.0
"""Messages of pylint that other files refute, and those that they do not."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import pytest
from linter_samples import workspace

from haros_ci.linters.pylint_doubts import is_refuted
from haros_ci.linters.pylint_surroundings import is_refuted_around
from haros_ci.model.location import Location
from haros_ci.model.package import Package
from haros_ci.results.result import Result
from haros_ci.results.rule import Level
from haros_ci.workspace.package_xml import parse_package

KINDS = "class Kind:\n    def by_name(name):\n        return list(Kind)[name]\n"
CALLED = "import kinds\nkinds.Kind.by_name('a')\n"


def refuted(root: Path, rule: str, files: dict[str, str], path: str, line: int, column: int = 1) -> bool:
    made = replace(workspace(root, files), names=frozenset(files))
    return is_refuted_around(Result("pylint", rule, Level.ERROR, "", Location(path, line, column)), made)


@pytest.mark.parametrize(
    "files",
    [
        {"main.py": CALLED},
        {"main.py": CALLED + "Other.by_name(2)\n"},
        {"main.py": CALLED, "other.py": "Kind.by_name (3)\nby_name(4)\n"},
        {"main.py": "", "launch/a.launch.py": CALLED},
    ],
)
def test_a_helper_that_is_called_on_its_class(tmp_path: Path, files: dict[str, str]) -> None:
    assert refuted(tmp_path, "no-self-argument", {"kinds.py": KINDS, **files}, "kinds.py", 2)


@pytest.mark.parametrize(
    ("kinds", "main"),
    [
        (KINDS, ""),
        (KINDS, CALLED + "kind.by_name(1)\n"),
        (KINDS, CALLED + "Kind().by_name(1)\n"),
        (KINDS, "self.by_name(1)\n"),
        (KINDS, "Other.by_name(1)\n"),
        (KINDS + "    def go(self):\n        self.by_name(1)\n", CALLED),
        (KINDS, CALLED + "call_later(self.by_name)\n"),
        ("def (:\n" + KINDS, CALLED),
    ],
)
def test_a_method_that_is_called_on_an_object(tmp_path: Path, kinds: str, main: str) -> None:
    assert not refuted(tmp_path, "no-self-argument", {"kinds.py": kinds, "main.py": main}, "kinds.py", 2)


BESIDE = {"a/plan/plan.py": "class Plan: pass\n", "a/plan/other.py": ""}


@pytest.mark.parametrize(
    "main",
    [
        "import plan\nplan.Plan()\n",
        "import plan as p\np.Plan()\n",
        "from plan import Plan\nPlan()\n",
    ],
)
def test_a_module_beside_the_script_comes_first(tmp_path: Path, main: str) -> None:
    assert refuted(tmp_path, "not-callable", {**BESIDE, "a/plan/main.py": main}, "a/plan/main.py", 2)


@pytest.mark.parametrize(
    ("rule", "files", "main"),
    [
        ("not-callable", {"a/plan/other.py": ""}, "import plan\nplan.Plan()\n"),
        ("not-callable", {"a/plan.py": ""}, "import plan\nplan.Plan()\n"),
        ("not-callable", BESIDE, "plan = 1\nplan()\n"),
        ("not-callable", BESIDE, "import planner\nplanner.Plan()\n"),
        ("unreachable", BESIDE, "import plan\nplan.Plan()\n"),
    ],
)
def test_other_modules(tmp_path: Path, rule: str, files: dict[str, str], main: str) -> None:
    place = "a/main.py" if "a/plan.py" in files else "a/plan/main.py"
    names = {name: text for name, text in files.items() if name != "a/plan/plan.py" or place != "a/main.py"}
    assert not refuted(tmp_path, rule, {**names, place: main}, place, 2)


def test_values_of_a_method_without_self() -> None:
    assert is_refuted("invalid-sequence-index", 3, 0, KINDS)
    assert is_refuted("not-callable", 3, 0, "class A:\n    def go(f):\n        f(1)\n")


@pytest.mark.parametrize(
    "text",
    [
        KINDS.replace("(name)", "(self, name)"),
        KINDS.replace("[name]", "['a']"),
        KINDS.replace("    def", "    @staticmethod\n    def", 1).replace("\n        return", " return"),
        "def by_name(name):\n    x = 1\n    return list(x)[name]\n",
        "class A:\n    def __init__(name):\n        return [][name]\n",
    ],
)
def test_values_of_others(text: str) -> None:
    assert not is_refuted("invalid-sequence-index", 3, 0, text)


LOAD = "#!/usr/bin/env python\nimport yaml\nx = yaml.load(open('a'))\n"
CATKIN = (
    '<package format="2"><name>a</name><version>1.0.0</version><buildtool_depend>catkin</buildtool_depend>{}</package>'
)
KEY = "<exec_depend>python-yaml</exec_depend>"
PRINTING = {"a/b.py": 'print "b"\n'}


def package(manifest: str) -> Package:
    made = parse_package("a/package.xml", manifest.encode())
    assert isinstance(made, Package)
    return made


def of_python2(
    root: Path, text: str, keys: str, more: dict[str, str], rule: str = "no-value-for-parameter", name: str = "Loader"
) -> bool:
    files = {"a/package.xml": CATKIN.format(keys), "a/a.py": text, **more}
    made = replace(workspace(root, files, [package(files["a/package.xml"])]), names=frozenset(files))
    message = f"No value for argument '{name}' in function call."
    return is_refuted_around(Result("pylint", rule, Level.ERROR, message, Location("a/a.py", 3, 5)), made)


@pytest.mark.parametrize(
    ("text", "keys", "more"),
    [
        (LOAD, KEY, {}),
        (LOAD, "<depend>python-numpy</depend>", {}),
        (LOAD, "", PRINTING),
        (LOAD.replace("env python", "env python2"), "", {}),
        (LOAD + "if x.has_key('a'):\n    pass\n", "", {}),
        (LOAD.partition("\n")[2], KEY, {}),
    ],
)
def test_a_package_for_python_2(tmp_path: Path, text: str, keys: str, more: dict[str, str]) -> None:
    assert of_python2(tmp_path, text, keys, more)
    assert of_python2(tmp_path, text, keys, more, "anomalous-backslash-in-string")
    assert of_python2(tmp_path, text, keys, more, "deprecated-method")
    assert of_python2(tmp_path, text, keys, more, name="size") is (
        "python2" in text
    )  # such a script runs another version
    assert not of_python2(tmp_path, text, keys, more, "undefined-variable")


@pytest.mark.parametrize(
    ("text", "keys", "more"),
    [
        (LOAD, "", {}),
        (LOAD, f"<!-- {KEY} -->", {}),
        (LOAD.replace("env python", "env python3"), KEY, PRINTING),
        (LOAD, KEY + "<exec_depend>python3-yaml</exec_depend>", {}),
        (LOAD, '<exec_depend condition="$ROS_PYTHON_VERSION == 2">python-yaml</exec_depend>', {}),
        (LOAD, "", {"a/b.py": 'print("b")\n'}),
        (LOAD, "", {"a/b.py": '"""Text\nprint "b"\n"""\n'}),
        (LOAD, "", {"a/b.py": "#!/usr/bin/python3\n", "a/c.py": 'print "c"\n'}),
        (LOAD, "", {"other/b.py": 'print "b"\n'}),
    ],
)
def test_a_package_that_may_be_for_python_3(tmp_path: Path, text: str, keys: str, more: dict[str, str]) -> None:
    assert not of_python2(tmp_path, text, keys, more, "anomalous-backslash-in-string")


@pytest.mark.parametrize(
    ("more", "name", "expected"),
    [
        ({}, "Loader", True),
        ({"requirements.txt": "numpy\n"}, "Loader", True),
        ({"a/requirements.txt": "PyYAML>=6\n"}, "Loader", False),
        ({"a/setup.py": "setup(install_requires=['pyyaml'])\n"}, "Loader", False),
        ({}, "stream", False),
    ],
)
def test_load_without_a_loader_in_ros_1(tmp_path: Path, more: dict[str, str], name: str, expected: bool) -> None:
    text = LOAD.replace("env python", "env python3")
    assert of_python2(tmp_path, text, "<depend>python3-yaml</depend>", more, name=name) is expected


def test_a_package_of_ros_2_is_for_python_3(tmp_path: Path) -> None:
    keys = KEY + "<export><build_type>ament_python</build_type></export>"
    files = {"a/package.xml": CATKIN.replace("catkin", "ament_python").format(keys), "a/a.py": LOAD, **PRINTING}
    made = replace(workspace(tmp_path, files, [package(files["a/package.xml"])]), names=frozenset(files))
    said = Result(
        "pylint", "no-value-for-parameter", Level.ERROR, "No value for argument 'Loader'", Location("a/a.py", 3)
    )
    assert not is_refuted_around(said, made)


OLD = "#!/usr/bin/env python2.7\nimport yaml\nfrom tools import load\nimport other.tools as ot\n"


@pytest.mark.parametrize("rule", ["no-value-for-parameter", "unexpected-keyword-arg", "too-many-function-args"])
@pytest.mark.parametrize("call", ["yaml.load(f)", "yaml.sub.load (f)", "load(f)", "ot.load(f)"])
def test_signatures_of_libraries_for_python2(tmp_path: Path, rule: str, call: str) -> None:
    assert refuted(tmp_path, rule, {"a.py": f"{OLD}{call}\n"}, "a.py", 5)
    assert refuted(tmp_path, rule, {"a.py": f"{OLD}if a:\n    {call}\n"}, "a.py", 6, 5)


@pytest.mark.parametrize(
    ("text", "more"),
    [
        (OLD.replace("python2.7", "python") + "yaml.load(f)\n", {}),
        (OLD.replace("python2.7", "python3") + "yaml.load(f)\n", {}),
        (f"\n{OLD}"[:-1] + "; yaml.load(f)\n", {}),
        (OLD + "yaml.load(f)\n", {"yaml.py": ""}),
        (OLD + "yaml.load(f)\n", {"src/yaml/__init__.py": ""}),
        (OLD + "load(f)\n", {"src/tools.py": ""}),
        (OLD + "load(f)\ndef load(a, b): pass\n", {}),
        (OLD + "self.load(f)\n", {}),
        (OLD + "unknown(f)\n", {}),
        (OLD + "(yaml)(f)\n", {}),
    ],
)
def test_signatures_that_are_known(tmp_path: Path, text: str, more: dict[str, str]) -> None:
    assert not refuted(tmp_path, "no-value-for-parameter", {"a.py": text, **more}, "a.py", 5)
    assert not refuted(tmp_path, "undefined-variable", {"a.py": f"{OLD}yaml.load(f)\n"}, "a.py", 5)


@pytest.mark.parametrize(
    ("text", "more", "expected"),
    [
        ("import numpy as np\nnp.reshape(a, newshape=(1, 2))\n", {}, True),
        ("import numpy\nnumpy.percentile(a, 5, interpolation='linear')\n", {}, True),
        ("import numpy as np\nnp.reshape(a, size=(1, 2))\n", {}, False),
        ("import numpy as np\nnp.reshape(a)\n", {}, False),
        ("import numpy as np\nnp.reshape(a, newshape=(1, 2))\n", {"numpy.py": ""}, False),
        ("import tools as np\nnp.reshape(a, newshape=(1, 2))\n", {}, False),
    ],
)
def test_keywords_of_a_former_numpy(tmp_path: Path, text: str, more: dict[str, str], expected: bool) -> None:
    assert refuted(tmp_path, "no-value-for-parameter", {"a.py": text, **more}, "a.py", 2) is expected
    assert refuted(tmp_path, "unexpected-keyword-arg", {"a.py": text, **more}, "a.py", 2) is expected


@pytest.mark.parametrize(
    ("message", "expected"),
    [
        ("Using deprecated class Text of module typing", True),
        ("Using deprecated class ByteString of module typing", False),
        ("Using deprecated class ByteString of module collections.abc", False),
        ("Using deprecated class MaybeEncodingError of module typing_tools", False),
        ("Using deprecated class Distribution of module distutils", False),
    ],
)
def test_aliases_of_typing_stay(tmp_path: Path, message: str, expected: bool) -> None:
    made = workspace(tmp_path, {"a.py": "x = 1\n"})
    assert (
        is_refuted_around(Result("pylint", "deprecated-class", Level.WARNING, message, Location("a.py", 1)), made)
        is expected
    )


READ = "class Options:\n    def _read(cls, path):\n        return cls(path)\n"
MADE = "    @classmethod\n    def make(cls, path):\n        return Options._read(cls, path)\n"


@pytest.mark.parametrize(
    "main", ["", "Options._read(Narrow, 1)\n", "cls._read(cls, 1)\n", "Options._read (\n    type(it), 1)\n"]
)
def test_a_helper_that_is_given_the_class(tmp_path: Path, main: str) -> None:
    assert refuted(tmp_path, "no-self-argument", {"a.py": READ + MADE, "main.py": main}, "a.py", 2)


@pytest.mark.parametrize(
    ("text", "main"),
    [
        (READ, ""),
        (READ, "Options._read(path)\n"),
        (READ + MADE, "Options._read('a')\n"),
        (READ + MADE, "it._read(Options)\n"),
        (READ + MADE, "self._read(1)\n"),
        (READ + MADE, "apply(Options._read)\n"),
        (READ + MADE, "Options._read(Path('a'))\n"),
    ],
)
def test_a_class_method_without_its_decorator(tmp_path: Path, text: str, main: str) -> None:
    assert not refuted(tmp_path, "no-self-argument", {"a.py": text, "main.py": main}, "a.py", 2)
    assert not is_refuted("not-callable", 3, 15, READ)


TOLD = "class Machine:\n    def telling(func):\n        return func\n    {}\n    def go(self):\n        pass\n"


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        (TOLD.format("@telling"), True),
        (TOLD.format("@telling  # each"), True),
        (TOLD.format("@telling").replace("func", "cls"), False),
        (TOLD.format("@telling_more"), False),
        (TOLD.format("@staticmethod"), False),
        (TOLD.format("@telling") + "Machine().telling(1)\n", False),
        (TOLD.format("@telling") + "        self.telling()\n", False),
        (TOLD.format("x = 1") + "@telling\ndef go():\n    pass\n", False),
    ],
)
def test_a_decorator_of_methods(tmp_path: Path, text: str, expected: bool) -> None:
    assert refuted(tmp_path, "no-self-argument", {"a.py": text}, "a.py", 2) is expected


WRAPPED = "class Line:\n    @needs_length\n    def bend(self, *, length):\n        return length\n"
#: A class whose constructor a decorator calls, with what it has.
SINGLE = "@singleton\nclass Arm:\n    def __init__(self, node):\n        pass\n"
OF_CALLS = ["missing-kwoa", "no-value-for-parameter", "unexpected-keyword-arg", "too-many-function-args"]


@pytest.mark.parametrize("rule", OF_CALLS)
@pytest.mark.parametrize(
    ("files", "call"),
    [
        ({"line.py": WRAPPED}, "a.bend(1)"),
        ({"line.py": WRAPPED.replace("needs_length", "house.needs(\n        1)")}, "Line(1).bend(2)"),
        ({"line.py": "@click.command()\n@wraps(f)\nasync def bend(a):\n    pass\n"}, "bend()"),
        ({"line.py": WRAPPED, "other.py": "def bend(a):\n    pass\n"}, "line.Line.bend(1)"),
        ({"line.py": SINGLE}, "Arm()"),
        ({"line.py": SINGLE}, "line.Arm()"),
        ({"line.py": SINGLE.replace("@singleton", "@tools.singleton(1)")}, "Arm()"),
    ],
)
def test_a_function_that_a_decorator_changes(tmp_path: Path, rule: str, files: dict[str, str], call: str) -> None:
    assert refuted(tmp_path, rule, {**files, "main.py": f"x = 1\n{call}\n"}, "main.py", 2)


@pytest.mark.parametrize("rule", OF_CALLS)
@pytest.mark.parametrize(
    ("files", "call"),
    [
        ({"line.py": WRAPPED.replace("    @needs_length\n", "")}, "a.bend(1)"),
        ({"line.py": WRAPPED.replace("needs_length", "staticmethod")}, "a.bend(1)"),
        ({"line.py": WRAPPED.replace("needs_length", "functools.lru_cache(1)")}, "a.bend(1)"),
        ({"line.py": WRAPPED}, "a.bends(1)"),
        ({"line.py": WRAPPED}, "bend(1)\ndef bend(): pass"),
        ({"line.py": WRAPPED}, "self.bend(1)\nclass Arc:\n    def bend(self): pass"),
        ({"line.py": WRAPPED}, "Line(a.bend)"),
        ({"line.py": WRAPPED + "class Other:\n    def __init__(self, a):\n        pass\n"}, "Other()"),
        ({"line.md": WRAPPED}, "a.bend(1)"),
        ({"line.py": SINGLE.replace("singleton", "dataclass")}, "Arm()"),
        ({"line.py": SINGLE.replace("singleton", "functools.total_ordering")}, "Arm()"),
        ({"line.py": SINGLE.replace("@singleton", "# @singleton")}, "Arm()"),
        ({"line.py": SINGLE.replace("\nclass", "\ndef make(): pass\n\nclass")}, "Arm()"),
        ({"line.py": SINGLE}, "Leg()"),
    ],
)
def test_a_function_as_it_is_defined(tmp_path: Path, rule: str, files: dict[str, str], call: str) -> None:
    assert not refuted(tmp_path, rule, {**files, "main.py": f"x = 1\n{call}\n"}, "main.py", 2)
    assert not refuted(tmp_path, "not-callable", {"line.py": WRAPPED, "main.py": "x = 1\na.bend(1)\n"}, "main.py", 2)


def test_the_call_that_is_meant(tmp_path: Path) -> None:
    """The place is that of the whole call, which begins where those in it begin."""
    made = workspace(tmp_path, {"line.py": WRAPPED, "main.py": "öö.bend(1).cut(2)\n"})
    for end, expected in ((11, True), (18, False), (None, False)):
        place = Location("main.py", 1, 1, 1 if end else None, end)
        assert is_refuted_around(Result("pylint", "missing-kwoa", Level.ERROR, "", place), made) is expected


SETUP = "from distutils.core import setup\nsetup(name='a')\n"


@pytest.mark.parametrize(
    ("files", "expected"),
    [
        ({"tool/a/model.py": "from __future__ import division\n"}, True),
        ({"tool/a/model.py": "from __future__ import (absolute_import, print_function)\n"}, True),
        ({"tool/a/model.py": "print 'a'\n"}, True),
        ({"tool/a/model.py": "from __future__ import annotations\n"}, False),
        ({"tool/a/model.py": "# from __future__ import division\n"}, False),
        ({"other/model.py": "from __future__ import division\n"}, False),
        ({"tool/model.py": "from __future__ import division\n", "tool/b.py": "#!/usr/bin/python3\n"}, False),
        ({}, False),
    ],
)
def test_code_outside_of_packages(tmp_path: Path, files: dict[str, str], expected: bool) -> None:
    assert refuted(tmp_path, "deprecated-module", {"tool/setup.py": SETUP, **files}, "tool/setup.py", 1) is expected
    assert not refuted(tmp_path, "undefined-variable", {"tool/setup.py": SETUP, **files}, "tool/setup.py", 1)


def test_code_beside_packages_of_ros_2(tmp_path: Path) -> None:
    files = {"tool/setup.py": SETUP, "tool/model.py": "from __future__ import division\n", "a/package.xml": ""}
    made = replace(workspace(tmp_path, files, [Package("a", "a", ros=2)]), names=frozenset(files))
    said = Result("pylint", "deprecated-module", Level.WARNING, "", Location("tool/setup.py", 1, 1))
    assert not is_refuted_around(said, made)


PLAIN = "#!/usr/bin/env python\n"
TABS = "Parsing failed: 'inconsistent use of tabs and spaces in indentation (a, line 3)'"
MIXED = "#!/usr/bin/env python\ndef f():\n\tgo()\n        go()\n"


def of_tabs(root: Path, text: str, keys: str, more: dict[str, str], message: str = TABS) -> bool:
    files = {"a/package.xml": CATKIN.format(keys), "a/a.py": text, **more}
    made = replace(workspace(root, files, [package(files["a/package.xml"])]), names=frozenset(files))
    return is_refuted_around(Result("pylint", "syntax-error", Level.ERROR, message, Location("a/a.py", 4, 1)), made)


@pytest.mark.parametrize(
    ("text", "keys", "more"),
    [
        (MIXED, KEY, {}),
        (MIXED, "", PRINTING),
        (MIXED, "", {"b/b.py": "try:\n    go()\nexcept ValueError, e:\n    pass\n"}),
        (MIXED.replace("env python", "env python2"), "", {}),
        (MIXED.replace("def", "from __future__ import print_function\ndef"), "", {}),
        (MIXED, "", {}),
        (MIXED, "", {"README.md": "For ROS Kinetic.\n", "b/b.py": "#!/usr/bin/env python\n"}),
        (MIXED, "", {f"b/{name}.py": MIXED for name in "bc"}),
        (MIXED[MIXED.index("def") :], "", {"b/b.py": "#!/usr/bin/env python\n"}),
        (MIXED, "", {**{f"b/{name}.py": MIXED for name in "bcd"}, "b/e.py": "#!/usr/bin/env python3\n"}),
    ],
)
def test_tabs_of_python_2(tmp_path: Path, text: str, keys: str, more: dict[str, str]) -> None:
    assert of_tabs(tmp_path, text, keys, more)
    assert not of_tabs(tmp_path, text, keys, more, "Parsing failed: 'invalid syntax (a, line 3)'")


@pytest.mark.parametrize(
    ("text", "keys", "more"),
    [
        (MIXED.replace("#!/usr/bin/env python\n", ""), "", {}),
        (MIXED.replace("#!/usr/bin/env python\n", "#!/bin/sh\n"), "", {}),
        (MIXED.replace("#!/usr/bin/env python\n", "#!/bin/sh\n"), "", {"b/b.py": "#!/usr/bin/env python\n"}),
        (MIXED[MIXED.index("def") :], "", {"b/b.py": "#!/usr/bin/env python\n", "README.md": "For ROS Noetic.\n"}),
        (MIXED[MIXED.index("def") :], "", {"b/b.py": "#!/usr/bin/env python\n", "b/c.py": "#!/usr/bin/env python3\n"}),
        (MIXED.replace("env python\n", "env python3.8\n"), "", {}),
        (MIXED, "", {"README.md": "For ROS Noetic.\n"}),
        (MIXED, "<exec_depend>python3-yaml</exec_depend>", {}),
        (MIXED, "", {"docker/Dockerfile": "FROM ros:noetic-ros-base\n"}),
        (MIXED, "", {".github/workflows/ci.yml": "runs-on: ubuntu-20.04\n"}),
        (MIXED, "", {"install.sh": "pip3 install numpy\n"}),
        (MIXED.replace("#!/usr/bin/env python\n", "from __future__ import annotations\n"), "", {}),
        (MIXED.replace("env python\n", "env python3\nfrom __future__ import print_function\n"), "", {}),
        (MIXED.replace("env python", "env python3"), KEY, PRINTING),
        (MIXED, "", {"b/b.py": 'print "b"\n', "b/c.py": "#!/usr/bin/env python3\n"}),
        (MIXED, "<export><build_type>ament_python</build_type></export>", PRINTING),
        (MIXED, "", {f"b/{name}.py": MIXED.replace("env python", "env python3") for name in "bcde"}),
        (MIXED[MIXED.index("def") :], "", {f"b/{name}.py": "def f():\n\tgo()\n" for name in "bcde"}),
        (MIXED.replace("env python", "env python3"), "", {f"b/{name}.py": MIXED for name in "bcde"}),
    ],
)
def test_tabs_of_what_may_be_python_3(tmp_path: Path, text: str, keys: str, more: dict[str, str]) -> None:
    assert not of_tabs(tmp_path, text, keys, more)


WHOLE = "__all__ = ['Arm']\nfrom arm import *\n"


def of_all(root: Path, text: str, more: dict[str, str], keys: str = "") -> bool:
    files = {"a/package.xml": CATKIN.format(keys), "a/src/a/__init__.py": text, **more}
    made = replace(workspace(root, files, [package(files["a/package.xml"])]), names=frozenset(files))
    at = Location("a/src/a/__init__.py", 1, 1)
    message = "Undefined variable name 'Arm' in __all__"
    return is_refuted_around(Result("pylint", "undefined-all-variable", Level.ERROR, message, at), made)


@pytest.mark.parametrize(
    "module",
    [
        "class Arm:\n    pass\n",
        "def Arm():\n    pass\n",
        "Arm = 1\n",
        "from b import Arm\n",
        "__all__ = ['Arm']\nArm = 1\n",
    ],
)
def test_names_of_a_module_beside(tmp_path: Path, module: str) -> None:
    assert of_all(tmp_path, WHOLE, {"a/src/a/arm.py": module})
    assert of_all(tmp_path, WHOLE, {"a/src/a/arm/__init__.py": module})


@pytest.mark.parametrize(
    ("text", "more"),
    [
        (WHOLE, {"a/src/arm.py": "class Arm: pass\n"}),
        (WHOLE, {"a/src/a/arm.py": "class Arms: pass\n"}),
        (WHOLE, {"a/src/a/arm.py": "class Hand:\n    Arm = 1\n"}),
        (WHOLE, {"a/src/a/arm.py": "# Arm = 1\n"}),
        (WHOLE, {"a/src/a/arm.py": "__all__ = ['Hand']\nclass Arm: pass\n"}),
        (WHOLE.replace("*", "Hand"), {"a/src/a/arm.py": "class Arm: pass\n"}),
        ("#!/usr/bin/env python3\n" + WHOLE, {"a/src/a/arm.py": "class Arm: pass\n"}),
    ],
)
def test_names_that_no_module_beside_has(tmp_path: Path, text: str, more: dict[str, str]) -> None:
    assert not of_all(tmp_path, text, more)


def test_a_package_of_ros_2_imports_nothing_so(tmp_path: Path) -> None:
    keys = "<export><build_type>ament_python</build_type></export>"
    assert not of_all(tmp_path, WHOLE, {"a/src/a/arm.py": "class Arm: pass\n"}, keys)


OF_ITSELF = "from one import One\n"
WITH_ITS_NAME = {"a/src/one/one.py": "class One:\n    pass\n", "a/src/one/old.py": "print 'one'\n"}


def imports_another(root: Path, files: dict[str, str], path: str) -> bool:
    files = {"a/package.xml": CATKIN.format(""), **files}
    made = replace(workspace(root, files, [package(files["a/package.xml"])]), names=frozenset(files))
    return is_refuted_around(Result("pylint", "import-self", Level.WARNING, "", Location(path, 1, 1)), made)


@pytest.mark.parametrize(
    ("path", "files"),
    [
        ("a/bin/one", {"a/bin/one": "#!/usr/bin/env python\n" + OF_ITSELF}),
        ("a/bin/one", {"a/bin/one": "#!/usr/bin/env python3\n" + OF_ITSELF}),
        ("a/src/one/__init__.py", {"a/src/one/__init__.py": OF_ITSELF, **WITH_ITS_NAME}),
        ("a/src/one/__init__.py", {"a/src/one/__init__.py": PLAIN + OF_ITSELF, "a/src/one/one.py": ""}),
        ("a/src/one/__init__.py", {"a/src/one/__init__.py": OF_ITSELF, "a/src/one/one.py": "", "a/bin/two.py": PLAIN}),
        (
            "a/scripts/one.py",
            {"a/scripts/one.py": OF_ITSELF + "roslib.load_manifest('one')\n", "a/src/one/__init__.py": ""},
        ),
        ("a/launch/one.py", {"a/launch/one.py": OF_ITSELF + "def generate_launch_description():\n    return one()\n"}),
        ("a/one/one.py", {"a/one/one.py": "from one import other\n", "a/one/other.py": ""}),
        ("a/one/__init__.py", {"a/one/__init__.py": "from one.other import Other\n", "a/one/other.py": ""}),
        ("a/one/__init__.py", {"a/one/__init__.py": "from a.one.other import x\n", "a/one/other/__init__.py": ""}),
        (
            "a/one/one.py",
            {"a/one/one.py": "from one import (other as o, more)\n", "a/one/other.py": "", "a/one/more.py": ""},
        ),
    ],
)
def test_an_import_of_another_module_of_that_name(tmp_path: Path, path: str, files: dict[str, str]) -> None:
    assert imports_another(tmp_path, files, path)


@pytest.mark.parametrize(
    ("path", "files"),
    [
        ("a/src/one.py", {"a/src/one.py": OF_ITSELF}),
        ("a/one/__init__.py", {"a/one/__init__.py": "from one.other import Other\n"}),
        ("a/one/__init__.py", {"a/one/__init__.py": "from two.other import Other\n", "a/one/other.py": ""}),
        ("a/one/one.py", {"a/one/one.py": "from one.other import Other\n"}),
        ("a/scripts/one.py", {"a/scripts/one.py": OF_ITSELF, "a/src/one/__init__.py": ""}),
        ("a/scripts/one.py", {"a/scripts/one.py": OF_ITSELF + "roslib.load_manifest('one')\n"}),
        ("a/src/one/__init__.py", {"a/src/one/__init__.py": OF_ITSELF, "a/src/one/other.py": ""}),
        ("a/src/one/__init__.py", {"a/src/one/__init__.py": OF_ITSELF, "a/src/one/one.py": ""}),
        ("a/src/one/__init__.py", {"a/src/one/__init__.py": PLAIN + OF_ITSELF}),
        (
            "a/src/one/__init__.py",
            {"a/src/one/__init__.py": PLAIN + OF_ITSELF, "a/src/one/one.py": "", "README.md": "For ROS Noetic.\n"},
        ),
        ("a/src/one/one.py", {"a/src/one/one.py": OF_ITSELF, **WITH_ITS_NAME}),
        ("a/one/one.py", {"a/one/one.py": "from one import other\n"}),
        ("a/one/one.py", {"a/one/one.py": "from one import other, more\n", "a/one/other.py": ""}),
        ("a/two/one.py", {"a/two/one.py": "from one import other\n", "a/two/other.py": ""}),
        ("a/one/one.py", {"a/one/one.py": "import one\n", "a/one/other.py": ""}),
    ],
)
def test_an_import_of_itself(tmp_path: Path, path: str, files: dict[str, str]) -> None:
    assert not imports_another(tmp_path, files, path)


BINDS = "PYBIND11_MODULE(core, m) {}\n"


@pytest.mark.parametrize(
    ("text", "more"),
    [
        (WHOLE, {}),
        ("__all__ = ['Arm']\ntry:\n    from arm_msgs.msg import *\nexcept ImportError:\n    pass\n", {}),
        (WHOLE.replace("arm", ".core"), {"a/src/core.cpp": BINDS}),
        (WHOLE.replace("arm", ".core"), {"a/CMakeLists.txt": "pybind11_add_module(core src/core.cpp)\n"}),
        (WHOLE.replace("arm", ".core"), {"a/setup.py": "setup(ext_modules=[Extension('a.core', [])])\n"}),
        (WHOLE.replace("arm", ".core"), {"a/src/a/core.cpython-310-x86_64-linux-gnu.so": ""}),
        (WHOLE.replace("arm", ".core"), {"a/src/a/core.py": "from arm_can import *\n__all__ = ['Arm']\n"}),
        (
            WHOLE.replace("arm", "."),
            {"a/src/a/__init__.py": WHOLE.replace("arm", ".b"), "a/src/a/b.py": "from c import *\n"},
        ),
    ],
)
def test_names_that_a_module_that_is_not_seen_may_have(tmp_path: Path, text: str, more: dict[str, str]) -> None:
    assert of_all(tmp_path, text, more)


@pytest.mark.parametrize(
    ("text", "more"),
    [
        ("__all__ = ['Arm']\n", {}),
        ("__all__ = ['Arm']\nfrom arm import Hand\n", {}),
        ("__all__ = ['Arm']\n# from arm import *\n", {}),
        ("__all__ = ['Arm']\nfrom math import *\n", {}),
        ("__all__ = ['Arm']\nfrom os.path import *\n", {}),
        (WHOLE.replace("arm", ".core"), {}),
        (WHOLE.replace("arm", ".core"), {"a/src/core.cpp": BINDS.replace("core", "other")}),
        (WHOLE.replace("arm", ".core"), {"a/src/a/core.py": "from math import *\n"}),
        (WHOLE.replace("arm", ".core"), {"a/src/a/core.py": "from .core import *\n"}),
    ],
)
def test_names_that_no_module_that_is_seen_has(tmp_path: Path, text: str, more: dict[str, str]) -> None:
    assert not of_all(tmp_path, text, more)


UNWRITTEN = "def f():\n    try:\n        # TODO: Add your code here\n    except ValueError:\n        pass\n"
MISSED = "Parsing failed: 'expected an indented block after 'try' statement on line 2 (a, line 4)'"


@pytest.mark.parametrize(
    ("text", "more", "message", "expected"),
    [
        (UNWRITTEN, {}, MISSED, True),
        (UNWRITTEN.replace("TODO: Add your code here", "Write the code"), {}, MISSED, True),
        (UNWRITTEN.replace("TODO: Add your", "Your solution, in the\n        # lab, goes here"), {}, MISSED, True),
        (UNWRITTEN, {"README.md": "Solve a.py.\n"}, MISSED, True),
        (UNWRITTEN, {"a/b.py": "a = 1\n"}, MISSED, True),
        (UNWRITTEN, {"a/b.py": "from a import f\n"}, MISSED, False),
        (UNWRITTEN, {"a/CMakeLists.txt": "catkin_install_python(PROGRAMS a.py DESTINATION bin)\n"}, MISSED, False),
        (UNWRITTEN, {"a/setup.py": "setup(scripts=['a.py'])\n"}, MISSED, False),
        (UNWRITTEN, {"a/a.launch": '<launch><node pkg="a" type="a.py" name="n"/></launch>\n'}, MISSED, False),
        (UNWRITTEN.replace("# TODO: Add your code here", ""), {}, MISSED, False),
        (UNWRITTEN.replace("TODO: Add your code here", "TODO"), {}, MISSED, False),
        (UNWRITTEN, {}, "Parsing failed: 'invalid syntax (a, line 4)'", False),
    ],
)
def test_exercises(text: str, more: dict[str, str], message: str, expected: bool, tmp_path: Path) -> None:
    assert of_tabs(tmp_path, text, "", more, message) is expected


@pytest.mark.parametrize(
    ("text", "more", "expected"),
    [
        ("from {package}.msg import {name}\n", {}, True),
        ("import os\nfrom {package-name} import x\n", {"b.py": "import os\n"}, True),
        ("class {{ name }}(Node):\n    pass\n", {}, True),
        ("class ${Name}:\n    pass\n", {}, True),
        ("import @(module)\n", {}, True),
        ("{% if x %}\nimport os\n{% endif %}\n", {}, True),
        ("def test_{name}():\n    pass\n", {}, True),
        # a file that something names, and what is no placeholder
        ("from {package}.msg import {name}\n", {"b.py": "import a\n"}, False),
        ("from {package}.msg import {name}\n", {"CMakeLists.txt": "install(PROGRAMS a.py DESTINATION lib/p)\n"}, False),
        ("from {package}.msg import {name}\n", {"a.launch.py": "Node(package='p', executable='a.py')\n"}, False),
        ("def f(:\n    return '{name}'.format(name=1)\n", {}, False),
        ("x = {name}\ndef f(:\n", {}, False),
        ("print 'from {x} import'\n", {}, False),
        ("def f(a={}):\n    return a[\n", {}, False),
        ("class A(dict):\n    x = {'a': 1\n", {}, False),
        ("@(module)\ndef f(:\n", {}, False),
    ],
)
def test_templates(text: str, more: dict[str, str], expected: bool, tmp_path: Path) -> None:
    assert refuted(tmp_path, "syntax-error", {"a.py": text, **more}, "a.py", 1) is expected


LEAF = "class Window(Base):\n    def __init__(self, port):\n        super(type(self), self).__init__(port)\n"


@pytest.mark.parametrize(
    ("more", "name", "expected"),
    [
        ({}, "type", True),
        ({"b.py": "window = Window(1)\n"}, "type", True),
        ({"b.py": "from a import Window\n\nclass Other(Base):\n    pass\n"}, "type", True),
        ({"b.py": "class Small(Window):\n    pass\n"}, "type", False),
        ({"b.py": "class Small(Base, a.Window):\n    pass\n"}, "type", False),
        ({"a.py": f"{LEAF}\n\nclass Small(Window):\n    pass\n"}, "type", False),
        ({}, "Base", False),
        ({"a.py": "def f(self):\n    pass\n    super(type(self), self).f()\n"}, "type", False),
    ],
)
def test_super_of_the_type_of_self(tmp_path: Path, more: dict[str, str], name: str, expected: bool) -> None:
    files = {"a.py": LEAF, **more}
    made = replace(workspace(tmp_path, files), names=frozenset(files))
    message = f"Bad first argument '{name}' given to super()"
    assert (
        is_refuted_around(Result("pylint", "bad-super-call", Level.WARNING, message, Location("a.py", 3)), made)
        is expected
    )


PATCHED = """class Mission:
    def go(self):
        return {}

    def _detect(self, timeout=2.0):
        return timeout
"""
OF_LAMBDA = "Unexpected keyword argument 'timeout' in lambda call"


@pytest.mark.parametrize(
    ("call", "more", "message", "expected"),
    [
        ("self._detect(timeout=1.0)", "", OF_LAMBDA, True),
        ("1 + self._detect(timeout=1.0)", "", "Too many positional arguments for lambda call", True),
        ("self._detect(timeout=1.0)", "", "Unexpected keyword argument 'timeout' in method call", False),
        ("self._other(timeout=1.0)", "", OF_LAMBDA, False),
        ("detect(timeout=1.0)", "", OF_LAMBDA, False),
        ("self._detect(timeout=1.0)", "\n    def off(self):\n        self._detect = lambda: 0\n", OF_LAMBDA, False),
    ],
)
def test_a_lambda_that_a_test_puts_in_the_place_of_a_method(
    tmp_path: Path, call: str, more: str, message: str, expected: bool
) -> None:
    calls = "from mission import Mission\n\nMission().go()\nMission().off()\n"
    texts = {"mission.py": PATCHED.format(call) + more, "main.py": calls, "test_a.py": "m._detect = lambda: 0\n"}
    made = workspace(tmp_path, texts)
    place = Location("mission.py", 3, 16)
    rule = "unexpected-keyword-arg" if "keyword" in message else "too-many-function-args"
    assert is_refuted_around(Result("pylint", rule, Level.ERROR, message, place), made) is expected
