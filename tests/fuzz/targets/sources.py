# SPDX-License-Identifier: Apache-2.0
"""Targets of the rooms that read code: front ends of C++ and Python, comments, scopes, and what is followed through it."""

from __future__ import annotations

import json
from collections.abc import Callable
from typing import Any

from fuzz.targets.kit import ROOT, Entry, parts, ros_package, sound, text_of, workspace

from haros_ci.analysis.architecture import architecture
from haros_ci.config.settings import Settings
from haros_ci.extract.cpp.read import read_cpp
from haros_ci.extract.parameter_library import read_parameter_library
from haros_ci.extract.python.read import read_python
from haros_ci.linters import includes, inclusions, lizard_worker, radon_worker
from haros_ci.linters.diffs import first_changes
from haros_ci.linters.metrics_worker import Unmeasurable
from haros_ci.linters.python2 import why_unreadable
from haros_ci.measuring import cpp as measuring_cpp
from haros_ci.measuring import facts
from haros_ci.measuring import python as measuring_python
from haros_ci.report.model_json import render as model_json
from haros_ci.results.comments import syntax
from haros_ci.results.directives import directives
from haros_ci.results.fingerprint import text_hashes
from haros_ci.results.line_hash import github_line_hashes
from haros_ci.results.line_map import line_mapper
from haros_ci.results.module_names import names_of
from haros_ci.results.overwritten import is_overwritten, is_used_before
from haros_ci.results.scope import scopes
from haros_ci.syntax import Program
from haros_ci.syntax.codec import decoded, encoded
from haros_ci.workspace.cache import MemoryCache
from haros_ci.workspace.code_text import has_lines_of_python, is_cpp, is_python


def _program(program: Program) -> object:
    """A program comes back from the cache as it went in."""
    stored = encoded(program)
    again = decoded(stored)
    assert again == program and encoded(again) == stored
    for line, message in program.problems:
        assert message and (line is None or line >= 1)
    return stored


def cpp(data: bytes) -> object:
    text = text_of(data, "cpp")
    return None if text is None else _program(read_cpp(text))


def python(data: bytes) -> object:
    text = text_of(data, "python")
    return None if text is None else (_program(read_python(text)), why_unreadable(text))


def _measured(found: facts.FileFacts) -> object:
    stored = json.dumps(facts.to_json(found))
    again = facts.from_json(json.loads(stored))
    assert again is not None and json.dumps(facts.to_json(again)) == stored
    return stored


def measured_cpp(data: bytes) -> object:
    text = text_of(data, "cpp")
    return None if text is None else _measured(measuring_cpp.read_cpp(text))


def measured_python(data: bytes) -> object:
    text = text_of(data, "python")
    return None if text is None else _measured(measuring_python.read_python(text))


def _by_worker(measure: Callable[[bytes], dict[str, Any]], data: bytes) -> object:
    """What a worker of metrics answers, which is JSON; a fault of the library that it asks costs the file alone."""
    try:
        return json.dumps(measure(data), sort_keys=True)
    except (Unmeasurable, RecursionError) as problem:
        return str(problem)
    except Exception as error:
        return type(error).__name__


def radon(data: bytes) -> object:
    return _by_worker(radon_worker.measure, data)


def lizard(data: bytes) -> object:
    return _by_worker(lizard_worker.measure, data)


def comments(data: bytes) -> object:
    """Comments that suppress, scopes, and hashes of lines, in every language that has them."""
    text = text_of(data)
    if text is None:
        return None
    last = text.count("\n") + 1
    found = []
    for language, path in (("cpp", "a.cpp"), ("python", "a.py"), ("launch", "a.launch"), ("cmake", "CMakeLists.txt")):
        said = tuple(directives(text, path, syntax(language, path), metrics=True))
        assert all(1 <= (each.place.line or 1) <= last + 1 for each in said)
        found.append((said, text_hashes(text, path, language)))
        of_lines = scopes(text, language)
        found.append(tuple(of_lines.at(line) for line in range(1, min(last, 50) + 1)))
    hashes = github_line_hashes(text, range(1, last + 2))
    assert set(hashes) <= set(range(1, last + 2))
    return found, hashes


def line_maps(data: bytes) -> object:
    old, _, new = (text_of(data) or "").partition("\n@@ \n")
    where = line_mapper(old, new)
    count = len(new.splitlines()) + 1
    found = [where(line) for line in range(old.count("\n") + 3)]
    assert all(line is None or 1 <= line <= count + 1 for line in found)
    known = [line for line in found if line is not None]
    assert len(known) == len(set(known)), "two lines of the old text are one line of the new"
    return found


def included(data: bytes) -> object:
    space = workspace({"bot/package.xml": ros_package(), "bot/a.hpp": b"", **parts(data, "bot/src/a.cpp")})
    direct = includes.direct(space, ("bot",))
    return (
        direct,
        {path: includes.closure(path, direct) for path in direct},
        tuple(first_changes(space.text("bot/src/a.cpp"), {"a.cpp": "a.cpp"})),
    )


def parameter_library(data: bytes) -> object:
    text = text_of(data, "yaml")
    if text is None:
        return None
    found = [read_parameter_library("bot/p.yaml", text, language) for language in ("cpp", "python")]
    return [_program(each) for each in found]


CMAKE = b"""find_package(ament_cmake REQUIRED)
find_package(rclcpp REQUIRED)
add_executable(a src/a.cpp)
ament_target_dependencies(a rclcpp)
install(TARGETS a DESTINATION lib/${PROJECT_NAME})
install(PROGRAMS scripts/b.py DESTINATION lib/${PROJECT_NAME})
ament_package()
"""


def _followed(data: bytes, default: str, ros: int) -> object:
    files = {"bot/package.xml": ros_package(ros=ros), "bot/CMakeLists.txt": CMAKE, **parts(data, default)}
    if ros == 1:
        files["bot/CMakeLists.txt"] = CMAKE.replace(b"ament_cmake", b"catkin").replace(
            b"ament_package", b"catkin_package"
        )
    found = architecture(workspace(files), Settings(root=ROOT), MemoryCache(), environment={})
    sound(*found.problems)
    return model_json(found)


def followed_cpp(data: bytes) -> object:
    return _followed(data, "bot/src/a.cpp", 2)


def followed_python(data: bytes) -> object:
    return _followed(data, "bot/scripts/b.py", 2)


def followed_ros1(data: bytes) -> object:
    return _followed(data, "bot/src/a.cpp", 1)


def defined_again(data: bytes) -> object:
    """Lines of functions that are defined again, with a text and its first lines; and the names that a module has."""
    text = data.decode("utf-8", errors="replace")
    lines = range(1, min(text.count("\n") + 2, 40))
    return names_of(text), [(is_overwritten(text, line), is_used_before(text, line)) for line in lines]


def code_under_other_names(data: bytes) -> object:
    """Whether the text of a file of data is code."""
    text = data.decode("utf-8", "replace")
    return [is_python(text), is_python(text, with_calls=False), has_lines_of_python(text), is_cpp(text)]


def confined_text(data: bytes) -> object:
    """What is blanked keeps its place, and a second look finds nothing left to blank."""
    text = data.decode("latin-1")
    there = {"src/a.h", "include/b.h"}.__contains__
    made = inclusions.confined(text, "src", there)
    assert len(made) == len(text) and made.count("\n") == text.count("\n")
    assert inclusions.confined(made, "src", there) is made
    return made


#: The rooms that following a node reaches.
_ENGINE = ("code", "declared", "follow", "graph", "index", "keeping", "launch", "substitutions", "systems", "values")

TARGETS = {
    "cpp": Entry(cpp, "C++ sources and headers", ("extract.cpp", "syntax.codec")),
    "python": Entry(python, "Python sources", ("extract.python", "linters.python2")),
    "measured-cpp": Entry(measured_cpp, "C++ as metrics see it", ("measuring.cpp", "measuring.facts")),
    "measured-python": Entry(measured_python, "Python as metrics see it", ("measuring.python",)),
    "defined-again": Entry(
        defined_again, "Python with functions of one name", ("results.overwritten", "results.module_names")
    ),
    "radon": Entry(radon, "Python as radon's worker measures it", ("linters.radon_worker", "linters.metrics_worker")),
    "lizard": Entry(lizard, "C++ as lizard's worker measures it", ("linters.lizard_worker", "linters.metrics_worker")),
    "comments": Entry(
        comments,
        "comments that suppress findings; scopes; hashes of lines",
        ("results.comments", "results.directives", "results.scope", "results.line_hash"),
        (b"// haros: ignore[x]", b"# haros: ignore", b"haros:", b"ignore-next-line[a,b]"),
    ),
    "code-texts": Entry(
        code_under_other_names,
        "texts of data that may be code",
        ("workspace.code_text",),
        (b"import a\n", b"def f():\n    pass\n", b"f(1)\n", b"void f() {\n}\n", b"key: value\n"),
    ),
    "line-maps": Entry(line_maps, "two revisions of a file", ("results.line_map",), (b"\n@@ \n",)),
    "includes": Entry(included, "#include lines, diffs of formatters", ("linters.includes", "linters.diffs")),
    "inclusions": Entry(
        confined_text,
        "directives that would lead a tool out of the workspace",
        ("linters.inclusions",),
        (
            b"#include",
            b'"/x"',
            b"</x>",
            b'"a.h"',
            b"../",
            b"\\\n",
            b"??/\n",
            b"/*",
            b"*/",
            b"__has_include(",
            b"%:",
            b"import ",
        ),
    ),
    "parameter-library": Entry(parameter_library, "YAML of generate_parameter_library", ("extract.parameter_library",)),
    "followed-cpp": Entry(followed_cpp, "a node in C++, followed to its endpoints", _ENGINE),
    "followed-python": Entry(followed_python, "a node in Python, followed to its endpoints", _ENGINE),
    "followed-ros1": Entry(followed_ros1, "a node of ROS 1 in C++ or Python", _ENGINE),
}
