# SPDX-License-Identifier: Apache-2.0
"""What checks said of the base revision without its C++ is said again of a change that moves lines of C++, and is what would be found anew."""

from __future__ import annotations

import shutil
from collections.abc import Iterable
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest
from commandline import commit, write

from haros_ci import pipeline
from haros_ci.analysis import kept_findings
from haros_ci.analysis.kept_findings import KeptFindings
from haros_ci.api.testing import examples_of
from haros_ci.checking import all_checks
from haros_ci.checking.unseen import Held
from haros_ci.config.settings import Settings
from haros_ci.model.workspace import Store
from haros_ci.registry import checks, page_of
from haros_ci.results.result import Report
from haros_ci.workspace.cache import MemoryCache

EXAMPLES = Path(__file__).resolve().parent.parent / "examples"
#: Words that checks look for in texts.
WORDS = "getPath sendTransform FindPackage createInstance subscribe publish spin Timer init Subscriber"
EDITS = {
    "a comment at the top": "// more\n{}",
    "a comment at the end": "{}\n// more\n",
    "a comment of words": f"// {WORDS}\n{{}}",
    "an include in a comment": "// #include <nowhere/nothing.hpp>\n{}",
    "an include in a block": "/*\n#include <nowhere/nothing.hpp>\n#include <map> */\n{}",
    "a plug-in in a comment": '// loader("std_msgs", "a::Base") Q_OBJECT get_package_share_directory("nowhere") + "/x"\n{}',
    "a frame in a comment": '// frame_id = "/map"; >>>>>>> other\n{}',
}


def sources(root: Path) -> list[Path]:
    return sorted(path for path in root.rglob("*") if path.suffix in (".cpp", ".hpp"))


@pytest.fixture(scope="module", params=("legacy_ws", "warehouse_ws"))
def known(request: pytest.FixtureRequest, tmp_path_factory: pytest.TempPathFactory) -> tuple[Path, Store]:
    """A copy of an example as a repository, and a cache in which its revision is."""
    root = tmp_path_factory.mktemp("kept") / "ws"
    shutil.copytree(EXAMPLES / request.param, root)
    commit(root)
    store = MemoryCache()
    pipeline.analyse(settings_of(root, baseline_rev=None), store)
    return root, store


def settings_of(root: Path, **more: Any) -> Settings:
    return replace(
        Settings(root=root, profile="architecture", baseline_rev="HEAD", cache_dir=root.parent / "cache", jobs=1),
        **more,
    )


def copy_of(store: Store) -> MemoryCache:
    made = MemoryCache()
    made._values.update(store._values)  # type: ignore[attr-defined]
    return made


def held_in(monkeypatch: pytest.MonkeyPatch) -> list[frozenset[str]]:
    """The checks that are not asked, run by run."""
    found: list[frozenset[str]] = []
    run_all = all_checks.run_all

    def noted(*arguments: Any) -> Any:
        held = arguments[-1]
        found.append(held.checks if held is not None else frozenset())
        return run_all(*arguments)

    monkeypatch.setattr(all_checks, "run_all", noted)
    return found


def reported(root: Path, store: Store) -> Report:
    return pipeline.analyse(settings_of(root), store)[0]


@pytest.mark.parametrize("number", range(len(EDITS)), ids=EDITS)
def test_the_report_is_that_of_a_run_that_asks_all(
    known: tuple[Path, Store], number: int, monkeypatch: pytest.MonkeyPatch
) -> None:
    root, store = known
    held, every, edit = held_in(monkeypatch), sources(root), list(EDITS.values())[number]
    for path in (every[number % len(every)], every[-1 - number % len(every)]):
        before = path.read_text()
        path.write_text(edit.format(before))
        try:
            found = reported(root, copy_of(store))
            is_asked_less = len(held[-1]) > 30
            assert is_asked_less, "checks of systems are not asked"
            assert found == reported(root, MemoryCache()), path
        finally:
            path.write_text(before)


@pytest.mark.parametrize(
    ("line", "is_with_code"),
    [
        ("// more", True),
        ("// a comment that has a word, spin, which is looked up", False),
        ('RCLCPP_INFO(get_logger(), "x");', False),
    ],
)
def test_what_is_held(tmp_path: Path, monkeypatch: pytest.MonkeyPatch, line: str, is_with_code: bool) -> None:
    root, code = tmp_path / "ws", "// walks\n#include <rclcpp/rclcpp.hpp>\nvoid go(rclcpp::Logger get_logger()) {\n}\n"
    cmake = "project(walker)\nadd_executable(go src/go.cpp)\n"
    write(root, {"walker/src/go.cpp": code, "walker/package.xml": PACKAGE, "walker/CMakeLists.txt": cmake})
    commit(root)
    store = MemoryCache()
    reported(root, store)
    write(root, {"walker/src/go.cpp": code.replace("{", "{\n  " + line)})
    held = held_in(monkeypatch)
    found = reported(root, copy_of(store))
    assert "unknown-package" in held[0] and "merge-conflict" not in held[0]
    assert ("action-without-result" in held[0]) is is_with_code
    assert found == reported(root, MemoryCache())


PACKAGE = """<?xml version="1.0"?>
<package format="3"><name>walker</name><version>1.0.0</version><description>Walks.</description>
<maintainer email="a@example.org">A</maintainer><license>Apache-2.0</license>
<buildtool_depend>ament_cmake</buildtool_depend><depend>rclcpp</depend>
<export><build_type>ament_cmake</build_type></export></package>
"""

OTHER = {
    "a comment of Python": ("walker/go.py", "# more\nx = 1\n"),
    "a page": ("README.md", "# more\n"),
    "a statement": ("walker/src/go.cpp", "void go() {}\nint more = other();\n"),
    "a header": ("walker/src/go.cpp", "#include <map>\nvoid go() {}\n"),
    "a manifest": ("walker/package.xml", PACKAGE.replace("1.0.0", "1.0.1")),
    "a new file": ("walker/src/more.cpp", "// more\n"),
}


@pytest.mark.parametrize("edit", OTHER.values(), ids=OTHER)
def test_nothing_is_held_after(tmp_path: Path, monkeypatch: pytest.MonkeyPatch, edit: tuple[str, str]) -> None:
    files = {"walker/go.py": "x = 1\n", "walker/src/go.cpp": "void go() {}\n", "walker/package.xml": PACKAGE}
    root, store = write(tmp_path / "ws", files), MemoryCache()
    commit(root)
    reported(root, store)
    write(root, dict([edit]))
    held = held_in(monkeypatch)
    found = reported(root, copy_of(store))
    assert not any(held)
    assert found == reported(root, MemoryCache())


def spoilt(value: Any) -> Iterable[Any]:
    yield from (None, [], "text", {}, {**value, "built": "other"}, {**value, "words": 1})
    yield {**value, "without": {"checks": ["x"], "results": [{"tool": "other"}]}}


def test_what_is_no_record_of_ours_is_not_believed(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    root, store = write(tmp_path / "ws", {"a/package.xml": PACKAGE, "a/src/go.cpp": "void go() {}\n"}), MemoryCache()
    commit(root)
    reported(root, store)
    write(root, {"a/src/go.cpp": "// more\nvoid go() {}\n"})
    (key,) = (key for key in store._values if key[1].startswith(f"{kept_findings.NAME} "))
    before = store._values[key]
    held = held_in(monkeypatch)
    for value in spoilt(before):
        other = copy_of(store)
        other._values[key] = value
        reported(root, other)
    assert not any(held)
    reported(root, copy_of(store))
    assert held[-1]


def test_a_check_that_spoke_of_a_changed_file_is_asked_again(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (check,) = (check for check in checks() if check.id == "parameter-out-of-range")
    example = examples_of(page_of(check))[1]
    (told,) = {path for path, _ in example.expected}
    files = {**example.files, "walker/package.xml": PACKAGE, "walker/src/more.cpp": "int more() { return 1; }\n"}
    root, store = write(tmp_path / "ws", files), MemoryCache()
    commit(root)
    reported(root, store)
    held = held_in(monkeypatch)
    for path in ("walker/src/more.cpp", told):
        write(root, {path: "// more\n" + files[path]})
        found = reported(root, copy_of(store))
        assert "parameter-not-declared" in held[-1] and (check.id in held[-1]) is (path != told)
        assert found == reported(root, MemoryCache())
        write(root, files)


def test_findings_are_kept_of_the_base_alone(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    kept: list[Held] = []
    put = KeptFindings.put
    monkeypatch.setattr(KeptFindings, "put", lambda *arguments: (kept.append(Held()), put(*arguments))[1])
    root, store = write(tmp_path / "ws", {"a/package.xml": PACKAGE, "a/src/go.cpp": "void go() {}\n"}), MemoryCache()
    commit(root)
    write(root, {"a/src/go.cpp": "void go() {}\nvoid more() {}\n"})
    reported(root, store)
    assert len(kept) == 1
