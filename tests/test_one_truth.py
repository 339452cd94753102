# SPDX-License-Identifier: Apache-2.0
"""A workspace has one model: with facts just read and from the cache, followed and kept, with one process and with two."""

from __future__ import annotations

from pathlib import Path

import pytest
from bench.one_truth import differences, ways

from haros_ci.analysis import programs as reading
from haros_ci.analysis.programs import programs
from haros_ci.model.workspace import Problem, Workspace
from haros_ci.workspace.build import builds
from haros_ci.workspace.cache import DiskCache
from haros_ci.workspace.discover import discover

EXAMPLES = Path(__file__).resolve().parent.parent / "examples"
WORKSPACES = sorted(path.name for path in EXAMPLES.iterdir() if path.is_dir())


@pytest.mark.parametrize("name", WORKSPACES)
def test_the_model_is_the_same_however_it_comes_about(name: str, tmp_path: Path) -> None:
    (first, expected), *others = ways(EXAMPLES / name, tmp_path)
    assert len(others) >= 7
    for way, found in others:
        assert found == expected, f"{way} is not as {first}:\n" + "\n".join(differences(expected, found))


@pytest.mark.parametrize("name", WORKSPACES)
def test_facts_just_read_are_equal_to_those_of_the_cache(name: str, tmp_path: Path) -> None:
    workspace = discover(EXAMPLES / name, ())
    built = builds(workspace)
    cache = DiskCache(tmp_path)
    read = programs(workspace, built, cache, [], 2)
    assert cache.flush() is None
    again = DiskCache(tmp_path)
    kept = programs(workspace, built, again, [])
    assert again.stats.misses == 0
    assert [each.program for each in kept] == [each.program for each in read]
    assert [repr(each.program) for each in kept] == [repr(each.program) for each in read]
    assert {hash(each.program) for each in kept} == {hash(each.program) for each in read}


def test_copies_of_a_file_are_read_once_and_are_each_there(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    broken = "void f() { g(; ((( }\n"
    texts = {"a/one.cpp": broken, "a/two.cpp": "int h() { return 1; }\n", "a/one.py": broken, "b/one.cpp": broken}
    for path, text in texts.items():
        file = tmp_path / "ws" / path
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_text(text)
    read: list[str] = []
    real = reading.read_facts

    def counted(workspace: Workspace, path: str, language: str) -> str:
        read.append(path)
        return real(workspace, path, language)

    monkeypatch.setattr(reading, "read_facts", counted)
    workspace = discover(tmp_path / "ws", ())
    cache = DiskCache(tmp_path / "cache")
    problems: list[Problem] = []
    found = {each.path: each.program for each in programs(workspace, {}, cache, problems)}
    assert sorted(read) == ["a/one.cpp", "a/one.py", "a/two.cpp"]
    assert found["a/one.cpp"] == found["b/one.cpp"] != found["a/two.cpp"]
    assert found["a/one.py"].language == "python"
    assert {each.path for each in problems} == {"a/one.cpp", "a/one.py", "b/one.cpp"}
    assert cache.flush() is None
    again = {each.path: each.program for each in programs(workspace, {}, DiskCache(tmp_path / "cache"), [])}
    assert again == found and len(read) == 3
