# SPDX-License-Identifier: Apache-2.0
"""The tools, as installed, find the defect in the bad example of a rule, and not in the good one."""

from __future__ import annotations

import re
from functools import cache
from pathlib import Path
from tempfile import TemporaryDirectory

import pytest
from linter_samples import MemoryStore, everything, workspace

from haros_ci.linters.catalogue import rules_of
from haros_ci.linters.catalogue.examples import BY_RULE
from haros_ci.linters.linter import LintOptions
from haros_ci.linters.run import lint
from haros_ci.registry import LINTERS

FUNCTION = "void f() {\n  @\n}\n"
BRANCH = "\n    stop();\n  }\n}\n"
NUMBER = "void f(int size, int cells, int flags, int ticks, bool enabled) {\n  @\n}\n"
GOAL = "struct Goal { const char * text; };\nGoal * find(int id);\nvoid f(int id, bool is_set, Goal & next) {\n  @\n}\n"
CATCH = "void f() {\n  try {\n    open();\n  } @\n}\n"
SPIN = "def spin(goal, joints, enabled, last_goal):\n    @\n        return 1\n    return goal, joints, enabled, last_goal\n"
ROUND_POSE = "#include <vector>\nstruct Pose { double x, y, z; };\nstruct Path { std::vector<Pose> poses; };\nvoid f(const Path & path) {\n  @\n    show(pose.x);\n  }\n}\n"
PORT = "#include <cassert>\nstruct Port {\n  bool open();\n};\nvoid f(Port & port) {\n  @\n}\n"
COUNT = "#include <mutex>\nclass Count {\n  void up() {\n    @\n  }\n  std::mutex mutex_;\n  int count_ = 0;\n};\n"

#: What stands around an example: it is put where the @ is, as far to the right. Around an example that has no entry stands nothing.
AROUND = {
    "cppcheck:accessMoved": "#include <memory>\nvoid f(Publisher * publisher, std::unique_ptr<Message> message) {\n  @\n}\n",
    "cppcheck:arrayIndexOutOfBounds": "#include <array>\n" + FUNCTION,
    "cppcheck:assertWithSideEffect": PORT,
    "cppcheck:badBitmaskCheck": "void f(int status) {\n  @" + BRANCH,
    "cppcheck:catchExceptionByValue": "#include <exception>\n" + CATCH.replace("@", "@\n    log(err.what());\n  }"),
    "cppcheck:constStatement": "struct Controller { void stop(); };\nvoid f(Controller & controller) {\n  @\n}\n",
    "cppcheck:cstyleCast": "void f(const char * name) {\n  @\n  show(text);\n}\n",
    "cppcheck:eraseDereference": "#include <set>\nvoid f(std::set<int> & goals) {\n  @\n  show(*it);\n}\n",
    "cppcheck:exceptRethrowCopy": "#include <exception>\n" + CATCH,
    "cppcheck:incorrectLogicOperator": "void f(int cell) {\n  @" + BRANCH,
    "cppcheck:iterateByValue": ROUND_POSE,
    "cppcheck:legacyUninitvar": FUNCTION,
    "cppcheck:memleak": "#include <vector>\n" + NUMBER,
    "cppcheck:memleakOnRealloc": "#include <cstdlib>\nvoid f(int size) {\n  char * data = (char *)malloc(8);\n  @\n  free(data);\n}\n",
    "cppcheck:mismatchAllocDealloc": "#include <vector>\n" + FUNCTION,
    "cppcheck:missingOverride": "class Part {\n public:\n  virtual void stop();\n};\n@\n",
    "cppcheck:multiCondition": NUMBER,
    "cppcheck:nullPointer": GOAL,
    "cppcheck:nullPointerRedundantCheck": GOAL,
    "cppcheck:passedByValue": "#include <string>\n@\n",
    "cppcheck:resourceLeak": "#include <cstdio>\n#include <fstream>\nbool f(const char * path) {\n  @\n  return true;\n}\n",
    "cppcheck:selfAssignment": "class Arm {\n  double speed_ = 0;\n public:\n  @\n};\n",
    "cppcheck:stlcstr": "#include <string>\n@\n",
    "cppcheck:unassignedVariable": "double f(double speed) {\n  @\n}\n",
    "cppcheck:uninitvar": "void drive(int speed);\n" + NUMBER,
    "cppcheck:unreadVariable": "int size();\n" + FUNCTION,
    "cppcheck:unsignedLessThanZero": "void f(unsigned total, unsigned used) {\n  @" + BRANCH,
    "cppcheck:unusedScopedObject": COUNT,
    "cppcheck:unusedVariable": FUNCTION,
    "cppcheck:variableScope": NUMBER,
    "pylint:comparison-with-itself": SPIN,
    "pylint:no-else-return": "def state(ready):\n    @\n",
    "pylint:pointless-statement": "class Arm:\n    def __init__(self):\n        self.ready = False\n\n    def start(self):\n        @\n",
    "pylint:singleton-comparison": SPIN,
    "pylint:subprocess-run-check": "import subprocess\n\n@\n",
    "pylint:unspecified-encoding": "def read(path):\n    @\n        return stream.read()\n",
    "flake8:E711": SPIN,
    "flake8:E712": SPIN,
    "flake8:E713": SPIN,
}  # fmt: skip
#: What is not run, and why.
LEFT_OUT = {
    "cpplint:build/header_guard": "the name of the guard is made of the package and the path",
    "cpplint:runtime/references": "cpplint asks about it only where a CPPLINT.cfg turns it on",
}
#: What a tool turns on by itself differs between its versions.
SETTINGS = {"ruff": {"ruff.toml": 'lint.select = ["BLE", "B", "E", "F", "PLW"]\n'}}
SUFFIX = {"cppcheck": "cpp", "cpplint": "hpp", "flake8": "py", "pylint": "py", "ruff": "py", "shellcheck": "sh"}
RULES = [f"{tool}:{rule}" for tool in SUFFIX for rule in sorted(BY_RULE) if rule in rules_of(tool)]


@pytest.mark.parametrize("name", [name for name in RULES if name not in LEFT_OUT])
def test_a_tool_finds_the_defect_in_the_bad_example_alone(name: str) -> None:
    tool, _, rule = name.partition(":")
    found = _found(tool)
    if found is None:
        pytest.skip(f"{tool} is not installed")
    assert {path for path, other in found if other == rule} & {*_files(name)} == {next(iter(_files(name)))}


def test_only_examples_that_there_are_have_surroundings() -> None:
    assert {*AROUND} <= {*RULES} and {*LEFT_OUT} <= {*RULES}


def _files(name: str) -> dict[str, str]:
    """The bad and the good example of the rule *name*, in this order, as files."""
    tool, _, rule = name.partition(":")
    before, _, after = AROUND.get(name, "@\n").partition("@")
    indent = before.rpartition("\n")[2] if before.endswith(" ") and "}" not in before.rpartition("\n")[2] else ""
    first = {"shellcheck": "#!/bin/sh\n"}.get(tool, "")
    pair, stem = BY_RULE[rule], re.sub("[^A-Za-z0-9]", "_", name)
    texts = {"bad": pair.bad, "good": pair.good}
    return {
        f"{stem}_{kind}.{SUFFIX[tool]}": first + before + text.replace("\n", "\n" + indent) + after
        for kind, text in texts.items()
    }


@cache
def _found(tool: str) -> frozenset[tuple[str, str]] | None:
    """Where the tool finds what in all its examples: one process for them. None: it is not installed."""
    (linter,) = (one for one in LINTERS if one.NAME == tool)
    options = LintOptions(enabled=frozenset({tool}))
    if linter.locate(options) is None:
        return None
    files = {path: text for name in RULES if name.startswith(f"{tool}:") for path, text in _files(name).items()}
    files |= SETTINGS.get(tool, {})
    with TemporaryDirectory() as directory:
        (run,) = lint(workspace(Path(directory), files), [linter], options, MemoryStore(), everything)
    return frozenset((result.location.path, result.rule) for result in run.results)
