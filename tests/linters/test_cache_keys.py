# SPDX-License-Identifier: Apache-2.0
"""What the key of an answer holds, tool by tool: everything that a tool can see and that can change its answer, one change each."""

from __future__ import annotations

import json
from collections.abc import Iterable, Mapping
from dataclasses import replace
from pathlib import Path

import pytest
from linter_samples import MemoryStore, workspace

from haros_ci.linters.linter import Linter, LintOptions, Unit
from haros_ci.linters.work import Digests
from haros_ci.model.package import Package
from haros_ci.registry import LINTERS

ADAPTERS: dict[str, Linter] = {linter.NAME: linter for linter in LINTERS}

P = Package("p", "p", ros=2)
Q = Package("q", "q", ros=2)


def keys(
    root: Path,
    tool: str,
    files: Mapping[str, str],
    packages: Iterable[Package] = (P, Q),
    executables: Iterable[str] | None = (),
    options: LintOptions | None = None,
) -> dict[str, str]:
    """The key of each unit, by its path; the store is fresh."""
    linter, options = ADAPTERS[tool], options or LintOptions()
    space = workspace(root, files, packages)
    space = replace(space, executables=None if executables is None else frozenset(executables))
    plan = getattr(linter, "plan", None)
    if plan is None:
        kept = (file for file in space.files if file.language in linter.LANGUAGES)
        units: Iterable[Unit] = [Unit(file, dependencies=tuple(linter.dependencies(space, file))) for file in kept]
    else:
        units = plan(space, options, MemoryStore())
    digests, given = Digests(space), linter.fingerprint(space, options)
    return {unit.file.path: digests.key(tool, "1", given, unit) for unit in units}


def renewed(place: Path, tool: str, files: Mapping[str, str], change: Mapping[str, str | None]) -> set[str]:
    after = {path: text for path, text in {**files, **change}.items() if text is not None}
    old, new = keys(place / "old", tool, files), keys(place / "new", tool, after)
    return {path for path in old.keys() & new.keys() if old[path] != new[path]}


CPP = {
    "p/src/a.cpp": '#include "a.hpp"\n#include <p/b.hpp>\nint a;\n',
    "p/src/a.hpp": "",
    "p/include/p/b.hpp": '#include "c.hpp"\n',
    "p/include/p/c.hpp": "",
    "p/src/z.cpp": "int z;\n",
    "q/src/q.cpp": "int q;\n",
}
A, Z, Q_CPP = "p/src/a.cpp", "p/src/z.cpp", "q/src/q.cpp"
PY = {
    "p/p/a.py": "from . import x\nfrom p.b import y\n",
    "p/p/b.py": "y = 1\n",
    "p/p/z.py": "z = 1\n",
    "q/scripts/q.py": "q = 1\n",
}
DATABASE = {
    "build/compile_commands.json": json.dumps(
        [{"directory": ".", "file": A, "arguments": ["c++", "-Ip/include", "-DX=1", A]}]
    )
}

#: Tool, files before, what changes (None: it is gone), the units whose key must change. All others must keep theirs.
CASES = [
    # cppcheck: headers under every name that they can be meant by, what is asked for, and macros that are known by any file
    ("cppcheck", CPP, {"p/src/a.hpp": "int h;\n"}, {A}),
    ("cppcheck", CPP, {"p/include/p/c.hpp": "int c;\n"}, {A}),
    ("cppcheck", CPP, {"p/src/c.hpp": "int c;\n"}, {A}),
    ("cppcheck", CPP, {"q/src/c.hpp": "int c;\n"}, set()),
    ("cppcheck", CPP, {"p/src/p/b.hpp": "int b;\n"}, {A}),
    ("cppcheck", CPP, {"p/include/a.hpp": "int other;\n"}, {A}),
    ("cppcheck", CPP, {Q_CPP: "class Q_EXPORT Q {};\n"}, {A, Z, Q_CPP}),
    ("cppcheck", CPP, {Q_CPP: "int other;\n"}, {Q_CPP}),
    ("cppcheck", CPP, {Q_CPP: "REGISTER_Q(q)\nint q;\n"}, {A, Z, Q_CPP}),
    ("cppcheck", CPP, {"p/src/a.hpp": "#include <QWidget>\n"}, {A}),
    ("cppcheck", {**CPP, Z: "#include <QWidget>\n"}, {"p/CMakeLists.txt": "add_definitions(-DQT_NO_KEYWORDS)\n"}, {Z}),
    ("cppcheck", {**CPP, Z: '#if __has_include("new.hpp")\n#endif\n'}, {"p/src/new.hpp": ""}, {Z}),
    ("cppcheck", {**CPP, Z: '#if __has_include(<p/new.hpp>)\n#endif\n'}, {"p/include/p/new.hpp": ""}, {Z}),
    ("cppcheck", {**CPP, Z: "#if __has_include(NAME)\n#endif\n"}, {Q_CPP: "int r;\n"}, {Z, Q_CPP}),
    ("cppcheck", {**CPP, Z: '#define X "../../q/src/q.cpp"\n#include X\n'}, {Q_CPP: "int r;\n"}, {Z, Q_CPP}),
    ("cppcheck", {**CPP, Z: '%:include "a.hpp"\n'}, {"p/src/a.hpp": "int h;\n"}, {A, Z}),
    ("cppcheck", {**CPP, Z: '#/**/include "a.hpp"\n'}, {"p/src/a.hpp": "int h;\n"}, {A, Z}),
    ("cppcheck", {**CPP, Z: '#inc\\\nlude "a.hpp"\n'}, {"p/src/a.hpp": "int h;\n"}, {A, Z}),
    ("cppcheck", {**CPP, Z: '#import "a.hpp"\n'}, {"p/src/a.hpp": "int h;\n"}, {A, Z}),
    ("cppcheck", {**CPP, Z: '// #include "a.hpp"\n'}, {"p/src/a.hpp": "int h;\n"}, {A}),
    ("cppcheck", {**CPP, Z: 'const char* s = "#include X";\n'}, {"p/src/a.hpp": "int h;\n"}, {A}),
    ("cppcheck", CPP, {"README.txt": "x"}, set()),
    # clang-tidy: the same, and the flags of the file
    ("clang-tidy", {**CPP, **DATABASE}, {"p/include/p/c.hpp": "int c;\n"}, {A}),
    ("clang-tidy", {**CPP, **DATABASE}, {"p/src/p/b.hpp": "int b;\n"}, {A}),
    ("clang-tidy", {**CPP, **DATABASE}, {path: text.replace("X=1", "X=2") for path, text in DATABASE.items()}, {A}),
    ("clang-tidy", {**CPP, **DATABASE}, {Z: "int zz;\n"}, set()),
    ("clang-tidy", {**CPP, **DATABASE}, {".clang-tidy": "Checks: x\n"}, set()),
    # cpplint: settings up to the root, the header of a source by its name, the ROS version and root of guards
    ("cpplint", CPP, {"p/CPPLINT.cfg": "linelength=9\n"}, {p for p in CPP if p.startswith("p/")}),
    ("cpplint", CPP, {"CPPLINT.cfg": "linelength=9\n"}, set(CPP)),
    ("cpplint", CPP, {"p/src/z.hpp": ""}, {Z}),
    ("cpplint", CPP, {"p/src/a.hpp": None}, {A}),
    ("cpplint", CPP, {"p/src/other.hpp": ""}, set()),
    ("cpplint", CPP, {"q/src/z.hpp": ""}, set()),
    # pylint: modules that are imported, of other packages, too; packages that a module is in
    ("pylint", PY, {"p/p/b.py": "y = 2\n"}, {"p/p/a.py", "p/p/b.py"}),
    ("pylint", PY, {"p/p/__init__.py": ""}, {"p/p/a.py", "p/p/b.py", "p/p/z.py"}),
    ("pylint", {**PY, "p/p/__init__.py": ""}, {"p/p/__init__.py": "x = 1\n"}, {f"p/p/{n}.py" for n in ("a", "b", "z", "__init__")}),
    ("pylint", {**PY, "p/p/__init__.py": ""}, {"p/__init__.py": ""}, {f"p/p/{n}.py" for n in ("a", "b", "z", "__init__")}),
    ("pylint", PY, {"p/p/x.py": ""}, {"p/p/a.py"}),
    ("pylint", {**PY, "p/p/z.py": "import helper\n"}, {"q/scripts/helper.py": ""}, {"p/p/z.py"}),
    ("pylint", {**PY, "p/p/z.py": "import q.inner\n"}, {"q/q/__init__.py": "", "q/q/inner.py": ""}, {"p/p/z.py"}),
    ("pylint", PY, {"q/scripts/helper.py": ""}, set()),
    ("pylint", PY, {"pylintrc": "[M]\n"}, set(PY)),
    ("pylint", PY, {"q/scripts/pylintrc": "[M]\n"}, {"q/scripts/q.py"}),
    ("pylint", PY, {"setup.cfg": "[metadata]\n"}, set()),
    # mypy: the same within a package; which packages there are
    ("mypy", PY, {"p/p/b.py": "y = ''\n"}, {"p/p/a.py", "p/p/b.py"}),
    ("mypy", PY, {"p/p/__init__.py": ""}, set(PY)),
    ("mypy", PY, {"mypy.ini": "[mypy]\n"}, set(PY)),
    ("mypy", {**PY, "p/p/z.py": "import helper\n"}, {"q/scripts/helper.py": ""}, set()),
    # ruff is in test_ruff_config.py; flake8's plug-ins ask for the package
    ("flake8", PY, {"p/p/__init__.py": ""}, {"p/p/a.py", "p/p/b.py", "p/p/z.py"}),
    ("flake8", PY, {"p/.flake8": "[flake8]\n"}, {"p/p/a.py", "p/p/b.py", "p/p/z.py"}),
    ("flake8", PY, {"p/p/b.py": "y = 2\n"}, {"p/p/b.py"}),
    # isort: whose a module is
    ("isort", PY, {"helper.py": ""}, set(PY)),
    ("isort", {**PY, "p/p/__init__.py": ""}, {"p/p/__init__.py": "__import__('pkg_resources')\n"}, {*PY, "p/p/__init__.py"}),
    ("isort", PY, {"p/p/b.py": "y = 2\n"}, {"p/p/b.py"}),
    ("isort", PY, {"p/.isort.cfg": "[settings]\n"}, {"p/p/a.py", "p/p/b.py", "p/p/z.py"}),
    # vulture: all of a package
    ("vulture", PY, {"p/p/b.py": "y = 2\n"}, {"p/p/a.py", "p/p/b.py", "p/p/z.py"}),
    ("vulture", PY, {"p/setup.cfg": "[options.entry_points]\nx = p.b:y\n"}, {"p/p/a.py", "p/p/b.py", "p/p/z.py"}),
    ("vulture", PY, {"pyproject.toml": "[tool.vulture]\n"}, set(PY)),
    # those that see one file and their settings
    ("bandit", PY, {".bandit": "[bandit]\n"}, set(PY)),
    ("bandit", PY, {"p/p/b.py": "y = 2\n"}, {"p/p/b.py"}),
    ("black", PY, {"p/pyproject.toml": "[tool.black]\n"}, {"p/p/a.py", "p/p/b.py", "p/p/z.py"}),
    ("black", PY, {"p/p/b.py": "y = 2\n"}, {"p/p/b.py"}),
    ("codespell", {**PY, ".codespellrc": "[codespell]\nignore-words = w\n", "w": "a\n"}, {"w": "b\n"}, set(PY)),
    ("codespell", {**PY, ".codespellrc": "[codespell]\nskip = x\n", "w": "a\n"}, {"w": "b\n"}, set()),
    ("clang-format", {"p/a.cpp": "", "p/.clang-format": "BasedOnStyle: InheritParentConfig\n"}, {".clang-format": "{}\n"}, {"p/a.cpp"}),
    ("clang-format", {"p/a.cpp": "", "p/.clang-format": "{}\n"}, {"p/.clang-format-ignore": "x\n"}, {"p/a.cpp"}),
    ("cmake-lint", {"x.cmake": ""}, {".cmake-format.yaml": "a: 1\n"}, {"x.cmake"}),
    ("cmake-lint", {"x.cmake": ""}, {".cmake-format.py": "a = 1\n"}, set()),
    ("cmakelint", {"x.cmake": ""}, {".cmakelintrc": "filter=-a\n"}, {"x.cmake"}),
    ("hadolint", {"a.Dockerfile": ""}, {".hadolint.yaml": "ignored: []\n"}, {"a.Dockerfile"}),
    ("shellcheck", {"x.sh": "", "y.sh": ". ./x.sh\n"}, {"x.sh": "a=1\n"}, {"x.sh"}),
    ("shellcheck", {"x.sh": ""}, {".shellcheckrc": "disable=SC1\n"}, {"x.sh"}),
    ("yamllint", {"a.yaml": "", ".yamllint": "extends: b\n", "b": "rules: {}\n"}, {"b": "extends: default\n"}, {"a.yaml"}),
    ("yamllint", {"a.yaml": "", ".yamllint": "ignore-from-file: g\n", "g": ""}, {"g": "x\n"}, {"a.yaml"}),
    ("xmllint", {"p/a.launch": "<a/>", "p/b.launch": "<b/>"}, {"p/a.launch": "<c/>"}, {"p/a.launch"}),
    ("flawfinder", CPP, {"p/src/a.hpp": "int h;\n"}, {"p/src/a.hpp"}),
    ("lizard", CPP, {"p/src/a.hpp": "int h;\n"}, {"p/src/a.hpp"}),
    ("radon", PY, {"p/p/b.py": "y = 2\n"}, {"p/p/b.py"}),
]  # fmt: skip


@pytest.mark.parametrize(("tool", "files", "change", "expected"), CASES)
def test_what_changes_the_key(
    tmp_path: Path, tool: str, files: dict[str, str], change: dict[str, str | None], expected: set[str]
) -> None:
    assert renewed(tmp_path, tool, files, change) == expected


def test_every_tool_has_a_case() -> None:
    assert {tool for tool, *_ in CASES} | {"ruff", "catkin_lint"} == set(ADAPTERS)


EXECUTABLE = [("ruff", "p/p/a.py"), ("flake8", "p/p/a.py")]


@pytest.mark.parametrize(("tool", "path"), EXECUTABLE)
def test_a_mode_that_rules_ask_for(tmp_path: Path, tool: str, path: str) -> None:
    old, new = keys(tmp_path, tool, PY), keys(tmp_path, tool, PY, executables=[path])
    assert {p for p in old if old[p] != new[p]} == {path}


OF_THE_PACKAGE = [
    ("cpplint", CPP, replace(P, ros=1), {p for p in CPP if p.startswith("p/")}),
    ("cpplint", CPP, replace(P, name="other"), set()),
    ("mypy", PY, replace(P, path="p/p"), {"p/p/a.py", "p/p/b.py", "p/p/z.py"}),
    ("vulture", PY, replace(P, name="other"), {"p/p/a.py", "p/p/b.py", "p/p/z.py"}),
    ("pylint", PY, replace(P, ros=1), set()),
]


@pytest.mark.parametrize(("tool", "files", "package", "expected"), OF_THE_PACKAGE)
def test_what_the_manifest_decides(
    tmp_path: Path, tool: str, files: dict[str, str], package: Package, expected: set[str]
) -> None:
    old, new = keys(tmp_path, tool, files), keys(tmp_path, tool, files, [package, Q])
    assert {path for path in old if old[path] != new[path]} == expected


CATKIN = {"p/package.xml": "<package/>", "p/CMakeLists.txt": "", "p/launch/a.launch": "<launch/>", "p/src/a.cpp": ""}
OF_CATKIN = [
    ({"p/CMakeLists.txt": "project(p)\n"}, {}, True),
    ({"p/launch/a.launch": "<launch></launch>"}, {}, True),
    ({"p/src/b.cpp": ""}, {}, True),
    ({}, {"executables": ["p/launch/a.launch"]}, True),
    ({}, {"packages": [replace(P, ros=1), Package("r", "r", ros=2)]}, True),
    ({}, {"packages": [replace(P, ros=1), replace(Q, ros=1)]}, True),
    ({"p/src/a.cpp": "int a;\n"}, {}, False),
    ({"q/launch/a.launch": "<launch/>"}, {}, False),
    ({}, {}, False),
]


@pytest.mark.parametrize(("change", "more", "expected"), OF_CATKIN)
def test_catkin_lint_sees_the_whole_package(
    tmp_path: Path, change: dict[str, str], more: dict[str, list[str]], expected: bool
) -> None:
    old = keys(tmp_path / "old", "catkin_lint", CATKIN, [replace(P, ros=1), Q])
    given: dict[str, object] = {"packages": [replace(P, ros=1), Q], **more}
    new = keys(tmp_path / "new", "catkin_lint", {**CATKIN, **change}, **given)  # type: ignore[arg-type]
    assert len(old) == 1 and (old != new) == expected


def test_a_trusted_clang_tidy_file_is_in_the_key(tmp_path: Path) -> None:
    trusting = LintOptions(trust_config=True)
    old = keys(tmp_path / "old", "clang-tidy", {**CPP, **DATABASE}, options=trusting)
    for number, path in enumerate((".clang-tidy", "p/.clang-tidy", "p/src/.clang-tidy")):
        new = keys(tmp_path / str(number), "clang-tidy", {**CPP, **DATABASE, path: "Checks: x\n"}, options=trusting)
        assert old.keys() == new.keys() == {A} and old != new
    beside = keys(tmp_path / "beside", "clang-tidy", {**CPP, **DATABASE, "q/.clang-tidy": "x"}, options=trusting)
    assert beside == old


@pytest.mark.parametrize("planted", ["[]", '{"x": 1}', '"text"', '{"x": ["A_EXPORT", 3]}'])
def test_spoiled_macros_are_read_anew(tmp_path: Path, planted: str) -> None:
    from haros_ci.linters import ros_macros

    space = workspace(tmp_path, {"a.cpp": "class A_EXPORT A;\nvoid B_LOCAL f();\n"})
    store = MemoryStore()
    assert ros_macros.names(ros_macros.macro_marks(space, space.files, store)) == ("A_EXPORT", "B_LOCAL")
    store.values = dict.fromkeys(store.values, planted.replace("x", space.files[0].digest))
    assert ros_macros.names(ros_macros.macro_marks(space, space.files, store)) == ("A_EXPORT", "B_LOCAL")


#: Tools whose answers depend on the Python that runs them.
OF_PYTHON = ["bandit", "black", "flake8", "isort", "mypy", "pylint", "radon", "vulture"]


@pytest.mark.parametrize("tool", sorted(ADAPTERS))
def test_the_python_that_runs_the_tool(tmp_path: Path, tool: str, monkeypatch: pytest.MonkeyPatch) -> None:
    linter, space = ADAPTERS[tool], workspace(tmp_path, PY)
    before = linter.fingerprint(space, LintOptions())
    assert linter.fingerprint(space, LintOptions()) == before
    monkeypatch.setattr("sys.version_info", (3, 99, 0, "final", 0))
    assert (linter.fingerprint(space, LintOptions()) != before) == (tool in OF_PYTHON)
