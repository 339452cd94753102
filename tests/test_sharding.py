# SPDX-License-Identifier: Apache-2.0
"""A run on several machines and one run: the same bytes in every format. What makes no whole run is refused."""

from __future__ import annotations

import json
import os
import shutil
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from unittest.mock import patch

import pytest
from commandline import commit, write

from haros_ci.cli import main
from haros_ci.linters.sandbox import protection

EXAMPLES = Path(__file__).resolve().parent.parent / "examples"
FORMATS = ("sarif", "json", "text", "github")
#: The tools that haros-ci brings along.
PROJECT = "linters: {ruff: {enabled: false}, clang-tidy: {enabled: false}, catkin_lint: {enabled: false}}\n"


@dataclass(frozen=True)
class Place:
    """A workspace, and a directory beside it for all that runs leave."""

    root: Path
    cache: str

    @property
    def out(self) -> Path:
        return self.root.parent / "out"

    def run(self, command: str, *arguments: str) -> int:
        here = Path.cwd()
        kept = {k: v for k, v in os.environ.items() if not k.startswith("GITHUB_")}
        try:
            os.chdir(self.root)
            with patch.dict(os.environ, kept, clear=True):
                return main([command, *arguments])
        finally:
            os.chdir(here)

    def whole(self, *options: str, cache: str | None = None) -> tuple[int, dict[str, bytes]]:
        return self._written("whole", "check", cache or self.cache, *options)

    def shards(self, of: int, *options: str, cache: str | None = None) -> list[str]:
        files = [str(self.out / f"{number}-{of}.jsonl") for number in range(1, of + 1)]
        for number, file in enumerate(files, 1):
            arguments = [f"--shard={number}/{of}", f"--output=shard={file}", cache or self.cache, *options]
            assert self.run("check", *arguments) == 0
        return files

    def merged(self, files: list[str], *options: str) -> tuple[int, dict[str, bytes]]:
        return self._written("merged", "merge", "--no-cache", *options, *files)

    def _written(self, name: str, command: str, *arguments: str) -> tuple[int, dict[str, bytes]]:
        place = self.out / name
        shutil.rmtree(place, ignore_errors=True)
        code = self.run(command, *(f"--output={format}={place / format}" for format in FORMATS), *arguments)
        return code, {path.name: path.read_bytes() for path in sorted(place.iterdir())} if place.exists() else {}


@pytest.fixture(scope="module", params=("warehouse_ws", "legacy_ws"))
def example(request: pytest.FixtureRequest, tmp_path_factory: pytest.TempPathFactory) -> Iterator[Place]:
    """A copy of an example under git, one commit behind; its cache is filled by the first run."""
    scratch = tmp_path_factory.mktemp(request.param)
    shutil.copytree(EXAMPLES / request.param, scratch / "ws")
    place = Place(scratch / "ws", f"--cache-dir={scratch / 'cache'}")
    if not (place.root / ".haros-ci.yaml").exists() and not (place.root / "haros.yaml").exists():
        write(place.root, {".haros-ci.yaml": PROJECT})
    commit(place.root)
    sources = sorted(p for p in place.root.rglob("*") if p.suffix in (".py", ".cpp", ".launch"))
    for path in sources[::2]:
        path.write_bytes(b"\n".join(path.read_bytes().split(b"\n")) + b"\n")
    moved = [path for path in sources if path.suffix == ".cpp"][0]
    moved.write_text(moved.read_text() + "\nstatic int added_one(int a) { int unused; return a; }\n")
    commit(place.root)
    yield place


@pytest.fixture(scope="module")
def cold(example: Place) -> list[str]:
    """Three shards for which nothing was cached."""
    files = [Path(file) for file in example.shards(3, cache="--no-cache")]
    return [str(file.rename(file.with_name(f"cold-{file.name}"))) for file in files]


def test_cold_shards_give_the_same_bytes_as_a_cold_run(example: Place, cold: list[str]) -> None:
    """Nothing is cached, so units are spread over processes in another way in each run."""
    code, whole = example.whole()
    assert code == 1
    assert set(whole) == set(FORMATS)
    assert len(json.loads(whole["json"])["results"]) > 5
    assert example.merged(cold) == (code, whole)


@pytest.mark.parametrize("of", [1, 2, 5])
def test_any_number_of_shards_gives_the_same_bytes(example: Place, of: int) -> None:
    assert example.merged(example.shards(of)) == example.whole()


@pytest.mark.parametrize("kind", ["file", "sarif", "revision"])
def test_baselines_are_matched_once_all_is_there(example: Place, kind: str) -> None:
    scratch = example.root.parent
    option = {"file": f"--baseline={scratch / 'known.jsonl'}", "sarif": f"--baseline={scratch / 'known.sarif'}"}
    if kind == "file":
        assert example.run("baseline", "create", "--file", str(scratch / "known.jsonl"), example.cache, "src") == 0
    elif kind == "sarif":
        example.run("check", f"--output=sarif={scratch / 'known.sarif'}", example.cache, "--ignore=pylint")
    shared = ["--baseline-rev=HEAD~1"] if kind == "revision" else []
    only_here = [option[kind]] if kind in option else []
    code, whole = example.whole(*shared, *only_here, "--why")
    states = {result["state"] for result in json.loads(whole["json"])["results"]}
    assert "new" in states or kind != "revision"
    assert "unchanged" in states
    files = example.shards(3, *shared)
    assert example.merged(files, *shared, *only_here, "--why") == (code, whole)


def test_suppressions_imports_and_paths(example: Place) -> None:
    """All of them take part when the shards are joined."""
    paths = sorted({path.relative_to(example.root).parts[0] for path in example.root.rglob("package.xml")})
    log = example.root.parent / "other.sarif"
    example.run("check", f"--output=sarif={log}", example.cache, "--profile=all", "--select=cpplint")
    text = (
        log.read_text()
        .replace('"name":"cpplint"', '"name":"othertool"')
        .replace('"name": "cpplint"', '"name": "othertool"')
    )
    log.write_text(text)
    options = ["--profile=all", "--ignore=cpplint:whitespace/*"]
    report = [f"--import={log}", "--sarif-for=github", "--fail-on=error", "--statistics"]
    code, whole = example.whole(*options, *report, *paths)
    files = example.shards(2, *options, *paths)
    assert example.merged(files, *options, *report, *(f"--path={path}" for path in paths)) == (code, whole)


def test_remembered_costs_change_the_division_and_nothing_else(example: Place, cold: list[str]) -> None:
    costs = example.root.parent / "costs.json"
    first = example.merged(cold, f"--write-costs={costs}")
    remembered = json.loads(costs.read_text())["costs"]
    assert {"", "cppcheck", "pylint", "lizard"} <= remembered.keys()
    before = [Path(file).read_text().count('"answer"') for file in example.shards(3)]
    heavy = {tool: dict.fromkeys(by, 10**9 if tool == "lizard" else 1) for tool, by in remembered.items()}
    costs.write_text(json.dumps({"haros-ci-costs": 1, "costs": heavy}))
    files = example.shards(3, f"--shard-costs={costs}")
    assert example.merged(files) == first
    assert [Path(file).read_text().count('"answer"') for file in files] != before


# -- what makes no whole run --------------------------------------------------------------------------------------

NODE = '"""Node."""\n\n\ndef go():\n    """Go."""\n    return speed\n'


@pytest.fixture(scope="module")
def cache(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The same three files are in each small workspace: tools look at them once."""
    return tmp_path_factory.mktemp("cache")


@pytest.fixture
def small(tmp_path: Path, cache: Path) -> Place:
    files = {f"ws/scripts/{name}.py": NODE for name in "abc"}
    write(tmp_path, files)
    return Place(tmp_path / "ws", f"--cache-dir={cache}")


def test_a_missing_shard_is_named_and_nothing_is_written(small: Place, capsys: pytest.CaptureFixture[str]) -> None:
    files = small.shards(3)
    for left in range(3):
        assert small.merged(files[:left] + files[left + 1 :]) == (3, {})
        assert f"missing: shard {left + 1}/3" in capsys.readouterr().err


def test_a_file_that_cannot_be_read_is_named(small: Place, capsys: pytest.CaptureFixture[str]) -> None:
    files = small.shards(2)
    for odd in (str(small.out / "gone.jsonl"), str(small.root), "/dev/zero"):
        assert small.merged([files[0], odd]) == (3, {})
        assert odd in capsys.readouterr().err


def test_a_truncated_shard_is_named(small: Place, capsys: pytest.CaptureFixture[str]) -> None:
    files = small.shards(2)
    Path(files[1]).write_bytes(Path(files[1]).read_bytes()[:-20])
    assert small.merged(files) == (3, {})
    assert "2-2.jsonl: is cut short" in capsys.readouterr().err


def test_a_shard_of_other_contents_is_refused(small: Place, capsys: pytest.CaptureFixture[str]) -> None:
    files = small.shards(2)
    write(small.root, {"scripts/a.py": NODE + "\n"})
    assert small.merged(files) == (3, {})
    assert "other files than those that are here" in capsys.readouterr().err
    older = small.out / "older.jsonl"
    shutil.copyfile(files[0], older)
    newer = small.shards(2)[1]
    assert small.merged([str(older), newer]) == (3, {})
    assert "have analysed different files" in capsys.readouterr().err


def test_shards_of_different_costs_are_refused(small: Place, capsys: pytest.CaptureFixture[str]) -> None:
    costs = write(
        small.root.parent, {"costs.json": '{"haros-ci-costs":1,"costs":{"pylint":{"scripts/a.py":1000000000}}}'}
    )
    first = small.out / "first.jsonl"
    shutil.copyfile(small.shards(2)[0], first)
    second = small.shards(2, f"--shard-costs={costs / 'costs.json'}")[1]
    assert small.merged([str(first), second]) == (3, {})
    assert "--shard-costs" in capsys.readouterr().err


def test_there_may_be_more_shards_than_work(small: Place) -> None:
    assert small.merged(small.shards(16)) == small.whole()


def test_other_options_are_named(small: Place, capsys: pytest.CaptureFixture[str]) -> None:
    files = small.shards(2, "--profile=strict", "--select=security")
    assert small.merged(files, "--profile=strict") == (2, {})
    error = capsys.readouterr().err
    assert "other settings: --select or --ignore\n" in error
    assert "the options that the shards were given" in error


@pytest.mark.parametrize("options", [["--fail-on=never"], ["--allow-tool-failure=pylint"], ["--jobs=1"]])
def test_options_of_the_report_may_differ(small: Place, options: list[str]) -> None:
    expected = small.whole(*options)
    assert small.merged(small.shards(2), *options) == expected


def test_an_answer_that_is_taken_out_is_missed(small: Place, capsys: pytest.CaptureFixture[str]) -> None:
    files = small.shards(1)
    lines = Path(files[0]).read_text().splitlines()
    [kept] = [line for line in lines if line.startswith('["answer","pylint","scripts/b.py"')]
    rest = [line for line in lines[:-1] if line != kept]
    Path(files[0]).write_text("\n".join([*rest, json.dumps({"lines": len(rest) + 1}, separators=(",", ":"))]) + "\n")
    assert small.merged(files) == (3, {})
    assert "no shard has answered for scripts/b.py (pylint)" in capsys.readouterr().err


def test_a_result_outside_the_workspace_is_not_taken_in(small: Place) -> None:
    files = small.shards(1)
    text = Path(files[0]).read_text()
    assert '"scripts/b.py",6' in text
    Path(files[0]).write_text(text.replace('"scripts/b.py",6', '"../../secret.py",6'))
    code, written = small.merged(files)
    assert code == 1
    assert b"secret" not in b"".join(written.values())


@pytest.mark.parametrize(
    "arguments",
    [
        ["--shard=1/2"],
        ["--shard=1/2", "--output=sarif=x"],
        ["--shard=1/2", "--output=shard="],
        ["--shard=1/2", "--output=shard"],
        ["--shard=1/2", "--output=shard=x", "--output=text"],
        ["--shard=3/2", "--output=shard=x"],
        ["--shard=", "--output=shard=x"],
        ["--shard=1/2", "--output=shard=x", "--fix"],
        ["--shard=1/2", "--output=shard=x", "--diff"],
        ["--output=shard=x"],
    ],
    ids=" ".join,
)
def test_wrong_usage_is_said(small: Place, arguments: list[str]) -> None:
    assert small.run("check", *arguments) == 2
    assert not (small.root / "x").exists()


def test_costs_that_are_none_are_said(small: Place, capsys: pytest.CaptureFixture[str]) -> None:
    bad = write(small.root.parent, {"bad.json": "{}"}) / "bad.json"
    assert small.run("check", "--shard=1/2", "--output=shard=x", f"--shard-costs={bad}") == 2
    assert "bad.json" in capsys.readouterr().err


# -- tool trouble -------------------------------------------------------------------------------------------------


def test_a_tool_that_fails_is_no_less_trouble_when_shards_are_joined(
    small: Place, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    from haros_ci.linters import radon

    parse = radon.parse

    def choke(output: object, batch: object) -> object:
        if any(file.path.endswith("b.py") for file in batch.files):  # type: ignore[attr-defined]
            raise ValueError("choked")
        return parse(output, batch)  # type: ignore[arg-type]

    monkeypatch.setattr(radon, "parse", choke)
    code, whole = small.whole(cache="--no-cache")
    assert code == 3
    files = small.shards(2, cache="--no-cache")
    assert "warning: radon failed" in capsys.readouterr().err
    monkeypatch.undo()
    assert small.merged(files) == (code, whole)
    assert small.merged(files, "--allow-tool-failure=metrics")[0] == 1


def test_a_tool_that_is_missing_everywhere_is_missing_when_shards_are_joined(
    small: Place, monkeypatch: pytest.MonkeyPatch
) -> None:
    from haros_ci.linters import pylint

    with monkeypatch.context() as without:
        without.setattr(pylint, "locate", lambda options: None)
        expected = small.whole()
        files = small.shards(2)
    assert expected[0] == 3
    assert small.merged(files) == expected


def test_how_linters_were_confined_is_said_of_the_machines_that_ran_them(
    small: Place, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Not of the one that joins; where they differ, the weakest way counts."""
    with monkeypatch.context() as patched:
        patched.setenv("HAROS_CI_SANDBOX", "off")
        protection.cache_clear()
        files = small.shards(2, cache="--no-cache")
        expected = small.whole()
    protection.cache_clear()
    assert b"Linters run without a sandbox, as HAROS_CI_SANDBOX is off." in expected[1]["text"]
    assert small.merged(files) == expected
    mixed = small.out / "mixed.jsonl"
    header, _, rest = Path(files[0]).read_text().partition("\n")
    assert json.loads(header)["confined"] == "off"
    mixed.write_text(header.replace('"confined":"off"', '"confined":"files-network"') + "\n" + rest)
    _, written = small.merged([str(mixed), files[1]])
    assert b"On a part of the machines: Linters run without a sandbox, as HAROS_CI_SANDBOX is off." in written["text"]
    files = small.shards(2, cache="--no-cache")
    with monkeypatch.context() as patched:  # the machine that joins does not count
        patched.setenv("HAROS_CI_SANDBOX", "off")
        protection.cache_clear()
        assert b"HAROS_CI_SANDBOX" not in small.merged(files)[1]["text"]
    protection.cache_clear()


def test_no_tool_is_needed_where_shards_are_joined(small: Place, monkeypatch: pytest.MonkeyPatch) -> None:
    expected = small.whole()
    files = small.shards(2)
    from haros_ci.registry import LINTERS

    for linter in LINTERS:
        monkeypatch.setattr(linter, "locate", lambda options: None)
        monkeypatch.setattr(linter, "command", None)
    assert small.merged(files) == expected


def test_names_that_no_tool_can_be_given_are_told_as_ever(small: Place) -> None:
    write(small.root, {"scripts/odd\x07.py": NODE, "scripts/--jobs=1.py": NODE, "scripts/é \u2028.py": NODE})
    assert small.merged(small.shards(3, cache="--no-cache")) == small.whole()


def test_what_only_all_the_code_tells_is_found_once(small: Place, capsys: pytest.CaptureFixture[str]) -> None:
    """The thresholds on structure: a part of its own, that has to be there."""
    deep = "def f(a):\n" + "".join(f"{'    ' * n}if a > {n}:\n" for n in range(1, 9)) + f"{'    ' * 9}return a\n"
    write(small.root, {"scripts/deep.py": deep})
    options = ["--profile=all", "--ignore=pylint"]
    expected = small.whole(*options)
    assert any("nest" in result["rule"] for result in json.loads(expected[1]["json"])["results"])
    files = small.shards(3, *options)
    assert small.merged(files, *options) == expected
    [holder] = [Path(file) for file in files if '["whole",{"name":"structure"' in Path(file).read_text()]
    lines = [line for line in holder.read_text().splitlines()[:-1] if '"name":"structure"' not in line]
    holder.write_text("\n".join([*lines, json.dumps({"lines": len(lines) + 1}, separators=(",", ":"))]) + "\n")
    capsys.readouterr()
    assert small.merged(files, *options) == (3, {})
    assert "no shard has answered for structure" in capsys.readouterr().err
