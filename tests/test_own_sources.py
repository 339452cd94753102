# SPDX-License-Identifier: Apache-2.0
"""Keys of what is kept: they hold every module of ours that had a hand in it."""

from __future__ import annotations

import ast
from pathlib import Path

import pytest

from haros_ci.own_sources import LIBRARIES, OF_FACTS, OF_FOLLOWED, OF_LINTERS, OF_MEASURES, digest, program_digest

ROOT = Path(__file__).resolve().parent.parent
#: What has no say: texts of exceptions, and what a package's folder alone brings along.
HARMLESS = {"haros_ci", "haros_ci.errors", "haros_ci.extract", "haros_ci.systems.known"}
#: Where tools are run, not what is made of their answers.
HARMLESS |= {"haros_ci.interruption", "haros_ci.own_sources", "haros_ci.scratch", "haros_ci.timing"}

#: What modules are made with: it has no say in what they find.
HARMLESS |= {"haros_ci.records", "haros_ci.regex"}


def module_path(name: str) -> Path | None:
    path = ROOT.joinpath(*name.split("."))
    if path.with_suffix(".py").is_file():
        return path.with_suffix(".py")
    return path / "__init__.py" if (path / "__init__.py").is_file() else None


def imported(path: Path) -> set[str]:
    """The modules of ours that a module imports, wherever in it."""
    found = set()
    for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
        if isinstance(node, ast.Import):
            found |= {alias.name for alias in node.names}
        elif isinstance(node, ast.ImportFrom) and node.module:
            found |= {node.module, *(f"{node.module}.{alias.name}" for alias in node.names)}
    return {name for name in found if name.startswith("haros_ci.") and module_path(name) is not None}


def reached(*start: str) -> set[str]:
    found, waiting = set(start), list(start)
    while waiting:
        path = module_path(waiting.pop())
        assert path is not None
        for name in imported(path) - found:
            found.add(name)
            waiting.append(name)
    return found


@pytest.mark.parametrize(
    ("packages", "start"),
    [
        (OF_FACTS, ("haros_ci.extract.cpp.read", "haros_ci.extract.python.read", "haros_ci.syntax.codec")),
        (OF_MEASURES, ("haros_ci.measuring.cpp", "haros_ci.measuring.python")),
        (OF_FOLLOWED, ("haros_ci.follow.follow",)),
        (
            OF_LINTERS,
            (
                "haros_ci.linters.cppcheck",
                "haros_ci.linters.pylint",
                "haros_ci.linters.run",
                "haros_ci.linters.metrics",
            ),
        ),
    ],
)
def test_all_modules_that_have_a_hand_in_it_are_in_the_key(packages: tuple[str, ...], start: tuple[str, ...]) -> None:
    inside = {f"haros_ci.{package}".replace("/", ".") for package in packages}
    outside = {name for name in reached(*start) if name not in inside and name.rpartition(".")[0] not in inside}
    assert outside <= HARMLESS


def test_the_digest_is_of_the_bytes(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    from haros_ci import own_sources

    monkeypatch.setattr(own_sources, "_HERE", str(tmp_path))
    (tmp_path / "syntax").mkdir()
    found = []
    for text in ("a = 1\n", "a = 2\n", "a = 1\n"):
        (tmp_path / "syntax/node.py").write_text(text)
        digest.cache_clear()
        found.append(digest(OF_FACTS))
    (tmp_path / "syntax/more.py").write_text("")
    digest.cache_clear()
    found.append(digest(OF_FACTS))
    digest.cache_clear()
    assert found[0] == found[2] != found[1]
    assert found[3] not in found[:3]


def test_what_is_not_there_is_no_fault(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    from haros_ci import own_sources

    monkeypatch.setattr(own_sources, "_HERE", str(tmp_path / "haros.zip"))
    digest.cache_clear()
    assert digest(OF_FACTS)
    digest.cache_clear()


def test_the_program_is_all_of_its_files(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    from haros_ci import own_sources

    package = tmp_path / "a_program_of_ours"
    (package / "inner/tables").mkdir(parents=True)
    (package / "__init__.py").write_text("")
    monkeypatch.syspath_prepend(str(tmp_path))
    monkeypatch.setattr(own_sources, "INSTALLED", (package.name, "a_program_that_is_not_there"))
    found = []
    for name in ("inner/tables/names.txt", "inner/one.py", "inner/page.md", "inner/one.pyc", "__pycache__/one.py"):
        (package / name).parent.mkdir(exist_ok=True)
        program_digest.cache_clear()
        found.append(program_digest())
        (package / name).write_text("1")
    program_digest.cache_clear()
    found.append(program_digest())
    program_digest.cache_clear()
    assert found[2:] == [found[2]] * 4  # neither documentation nor compiled code
    assert len(set(found)) == 3


@pytest.mark.parametrize("library", LIBRARIES)
def test_both_depend_on_the_libraries(library: str, monkeypatch: pytest.MonkeyPatch) -> None:
    from haros_ci import own_sources

    digest.cache_clear()
    program_digest.cache_clear()
    before = digest(OF_FACTS), program_digest()
    known = own_sources._version
    monkeypatch.setattr(own_sources, "_version", lambda name: "0" if name == library else known(name))
    digest.cache_clear()
    program_digest.cache_clear()
    after = digest(OF_FACTS), program_digest()
    digest.cache_clear()
    program_digest.cache_clear()
    assert before[0] != after[0] and before[1] != after[1]
