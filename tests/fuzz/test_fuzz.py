# SPDX-License-Identifier: Apache-2.0
"""The fuzzer: its table of targets is complete, its stored inputs pass, and it finds what is wrong with a reader."""

from __future__ import annotations

import ast
import json
import re
import subprocess
import sys
from functools import cache
from importlib import import_module
from pathlib import Path
from random import Random

import pytest
from fuzz import execute, targets
from fuzz.mutate import LONGEST, Mutator
from fuzz.shrink import shrunk

HERE = Path(__file__).parent
ROOT = HERE.parents[1]
CORPUS = HERE / "corpus"
PROGRAM = ROOT / "haros_ci"

#: Modules that read bytes which no workspace, log, shard, cache or tool has written.
NOT_FUZZED = {
    "commands.testgen": "reads what the generated tests, which run code of the workspace anyway, write to a file of this run",
    "html_page.gather": "reads what analysis.kept_runs has kept, through the cache, and escapes it again",
    "own_sources": "digests the bytes of haros-ci itself",
    "streams": "opens the null device in place of streams that are closed",
    "workspace.base_settings": "opens files that linters.settings_files parses",
    "workspace.noted_files": "asks for flags of compilers by a pattern",
    "workspace.object_name": "digests bytes, as git does",
    "workspace.settings_around": "opens files that linters.settings_files parses",
    "commands.baseline": "compares bytes",
    "baselines": "opens the files that results.compact and results.sarif_reader read",
    "checking.launch_edits": "parses again what launch.python has parsed",
    "checking.transforms": "splits arguments that link has split",
    "extract.cpp.exact_clang": "opens files for libclang, in a process of its own",
    "extract.cpp.exact_worker": "reads what haros-ci writes to it, in a process of its own",
    "commands.fixing": "compares bytes and writes them",
    "forks": "reads what this program's own child has written to its pipe",
    "haros_plugins.child": "reads what haros-ci writes to it",
    "haros_plugins.manifest": "reads a plug-in that is installed, which the user trusts to run",
    "haros_plugins.run": "copies what plug-ins export, which the user trusts to run",
    "commands.init": "looks for names in files of continuous integration, and parses none",
    "interfaces.collect": "is run by developers on distributions of ROS",
    "html_page.document": "reads files of the program",
    "interfaces.common": "reads a file of the program",
    "knowledge.facts": "reads a file of the program",
    "systems.known.load": "reads files of the program",
    "linters.conversation": "takes lines of JSON of a plug-in's process, which the user trusts to run",
    "linters.cpplint_worker": "reads what haros-ci writes to it, in a process of its own",
    "linters.installed": "reads what pip has installed",
    "linters.metrics_worker": "reads what haros-ci writes to it, in a process of its own",
    "linters.mypy_worker": "parses files for mypy, in a process of its own",
    "linters.process": "opens the files that a tool's output goes to",
    "linters.text_worker": "reads what haros-ci writes to it, in a process of its own",
    "commands.merge": "opens the files that shards.shard_file reads",
    "commands.output": "opens files to write to, and the folder that haros_json.documents reads",
    "plugins.load": "reads a plug-in that the user names",
    "plugins.place": "reads a plug-in that the user names",
    "commands.readme_check": "reads values of YAML by a regular expression",
    "recordings.bag": "looks at the first bytes of files; bounded_yaml reads the metadata",
    "registry": "reads pages of the program's checks",
    "report.model_sqlite": "reads the database that it has just made",
    "starting.files": "reads files of the program",
    "monitor_files.core": "parses files of the program",
    "monitor_files.parts.program": "copied into files that a user runs; not run here",
    "test_files.property_tests.processes": "copied beside tests that a user runs; not run here",
    "test_files.property_tests.ros1": "copied beside tests that a user runs; not run here",
    "test_files.property_tests.verdicts": "copied beside tests that a user runs; not run here",
    "test_files.written": "reads files of the program",
    "verification.running": "reads how much memory this process has",
    "workspace.base": "reads what it has written",
    "workspace.discover": "opens files, and hands bytes to the readers",
    "workspace.files": "opens files; workspace.content decodes",
}
#: What turns foreign bytes or text into values.
DECODERS = {
    "json": {"load", "loads"},
    "yaml": {"parse", "load", "safe_load", "compose", "compose_all"},
    "ast": {"parse", "literal_eval"},
    "expat": {"ParserCreate"},
    "shlex": {"split"},
    "tomllib": {"loads"},
    "configparser": {"ConfigParser", "RawConfigParser"},
    "csv": {"DictReader", "reader"},
    "pickle": {"load", "loads"},
    "zlib": {"decompress"},
}
NAMES = {"parse_xml", "read_regular", "read_head", "open", "decode"}


@cache
def readers() -> dict[str, str]:
    """The modules that call a decoder, with one that they call."""
    found = {}
    for path in sorted(PROGRAM.rglob("*.py")):
        name = ".".join(path.relative_to(PROGRAM).with_suffix("").parts)
        for node in ast.walk(ast.parse(path.read_text("utf-8"))):
            function = node.func if isinstance(node, ast.Call) else None
            if isinstance(function, ast.Attribute):
                owner = function.value.id if isinstance(function.value, ast.Name) else ""
                if function.attr in DECODERS.get(owner, ()) or function.attr in ("read_bytes", "read_text"):
                    found[name] = f"{owner}.{function.attr}"
            elif isinstance(function, ast.Name) and function.id in NAMES:
                found[name] = function.id
    return found


def fuzzed(module: str, prefixes: set[str]) -> bool:
    return any(module == prefix or module.startswith((f"{prefix}.", f"{prefix}_")) for prefix in prefixes)


def test_every_reader_has_a_target() -> None:
    prefixes = {prefix for name in targets.NAMES for prefix in targets.entry(name).modules}
    missing = {name: what for name, what in readers().items() if not fuzzed(name, prefixes) and name not in NOT_FUZZED}
    assert not missing, "add a target to tests/fuzz/targets, or a reason to NOT_FUZZED"


def test_reasons_are_of_readers_that_are_there() -> None:
    assert set(NOT_FUZZED) <= set(readers())


@pytest.mark.parametrize("name", targets.NAMES)
def test_a_target_names_modules_that_are_there(name: str) -> None:
    for module in targets.entry(name).modules:
        place = PROGRAM.joinpath(*module.split("."))
        assert place.is_dir() or list(place.parent.glob(f"{place.name}*.py")), module


@pytest.mark.parametrize("group", targets.GROUPS)
def test_a_group_has_the_targets_that_the_table_says(group: str) -> None:
    assert set(import_module(f"fuzz.targets.{group}").TARGETS) == set(targets.GROUPS[group])


def test_the_workflow_fuzzes_every_group() -> None:
    text = (ROOT / ".github" / "workflows" / "fuzz.yml").read_text("utf-8")
    (groups,) = re.findall(r"^ +group: \[(.+)\]$", text, re.MULTILINE)
    assert groups.split(", ") == list(targets.GROUPS)


def test_every_corpus_is_of_a_target_and_small() -> None:
    assert {place.name for place in CORPUS.iterdir()} == set(targets.NAMES)
    assert sum(path.stat().st_size for path in CORPUS.rglob("*") if path.is_file()) < 600_000


def stored() -> list[Path]:
    """Of each target all cases, and the first of the other inputs; ``tests/fuzz/run.py`` runs them all."""
    chosen = []
    for place in sorted(CORPUS.iterdir()):
        every = sorted(place.iterdir())
        cases = [path for path in every if path.name.startswith("case-")]
        chosen += cases + [path for path in every if path not in cases][:2]
    return chosen


@pytest.mark.parametrize("path", [pytest.param(path, id=f"{path.parent.name}/{path.name}") for path in stored()])
def test_a_stored_input_passes(path: Path) -> None:
    finding = execute.run(targets.entry(path.parent.name).run, path.read_bytes(), seconds=600, twice=True)
    assert finding is None, finding


def _raises(data: bytes) -> object:
    return data.decode()


def _exits(data: bytes) -> object:
    raise SystemExit(3)


def _spins(data: bytes) -> object:
    while data:
        pass
    return None


def _recurses(data: bytes) -> object:
    return _recurses(data)


_LAST = [0]


def _counts(data: bytes) -> object:
    _LAST[0] += 1
    return _LAST[0]


@pytest.mark.parametrize(
    ("target", "kind"),
    [
        (_raises, "UnicodeDecodeError"),
        (_exits, "SystemExit"),
        (_spins, "slow"),
        (_recurses, "RecursionError"),
        (_counts, "differs"),
    ],
)
def test_what_is_wrong_is_found(target: execute.Target, kind: str) -> None:
    finding = execute.run(target, b"\xff", seconds=0.2, twice=True)
    assert finding is not None and finding.kind == kind


@pytest.mark.parametrize("target", [len, bytes.hex, lambda data: {"a", "b", "c"}, lambda data: [1.5, float("nan")]])
def test_what_is_right_is_no_finding(target: execute.Target) -> None:
    assert execute.run(target, b"\xff", twice=True) is None


def test_sets_are_the_same_in_any_order() -> None:
    assert execute.canonical({"a": {1, 2}}) == execute.canonical({"a": {2, 1}})
    assert execute.canonical({"a": 1, "b": 2}) != execute.canonical({"b": 2, "a": 1})


@pytest.mark.parametrize(
    ("data", "needed"), [(b"a\nb\nXY\nc\n" * 9, b"XY"), (b"X" * 50, b"X"), (b"aXbYc", b"XY"), (b"XY", b"XY")]
)
def test_inputs_are_made_smaller(data: bytes, needed: bytes) -> None:
    def shows(part: bytes) -> bool:
        return all(sign in part for sign in needed.split())

    small = shrunk(data, lambda part: all(bytes((sign,)) in part for sign in needed), seconds=60)
    assert sorted(small) == sorted(needed)
    assert shows(needed)


def test_one_seed_makes_one_row_of_inputs() -> None:
    def row(seed: int) -> list[bytes]:
        mutator = Mutator(Random(seed), (b"word",))
        return [mutator.mutated(b"a: [1, 2]\nb:\n  - c\n", [b"x = y\n"]) for _ in range(300)]

    assert row(1) == row(1) != row(2)
    assert all(len(data) <= LONGEST for data in row(3))
    assert any(b"word" in data for data in row(1))


def driver(*arguments: str) -> subprocess.CompletedProcess[str]:
    command = [sys.executable, str(HERE / "run.py"), *arguments]
    return subprocess.run(command, capture_output=True, text=True, cwd=ROOT, check=False)


def test_the_driver_fuzzes_a_target(tmp_path: Path) -> None:
    done = driver("condition", "--seconds", "1", "--findings", str(tmp_path / "f"), "--grow", str(tmp_path / "g"))
    assert done.returncode == 0, done.stdout + done.stderr
    assert re.match(r"condition +[1-9]\d* inputs +[1-9]\d* blocks", done.stdout) and "no finding" in done.stdout
    assert not (tmp_path / "f").exists() and (tmp_path / "g" / "condition").is_dir()


def test_the_driver_refuses_a_target_that_is_not_there() -> None:
    done = driver("conditions", "--seconds", "1")
    assert (done.returncode, done.stdout) == (2, "")
    assert "no such target: conditions" in done.stderr


def test_stored_inputs_and_a_few_more_run_in_copies_of_one_process(tmp_path: Path) -> None:
    done = driver("condition", "names", "--inputs", "2", "--findings", str(tmp_path / "f"))
    assert done.returncode == 0, done.stdout + done.stderr
    stored = {name: len(list((CORPUS / name).iterdir())) for name in ("condition", "names")}
    for name, count in stored.items():
        assert re.search(rf"^{name} +{count + 2} inputs +[1-9]\d* blocks", done.stdout, re.MULTILINE), done.stdout


@pytest.mark.parametrize("end", ["os.kill(os.getpid(), 9)", "os._exit(3)", "raise KeyError"])
def test_a_copy_that_dies_is_a_finding_with_its_input(tmp_path: Path, end: str) -> None:
    script = f"""
import os, sys
sys.path[:0] = [{str(HERE.parent)!r}]
from pathlib import Path
from fuzz import run, worker
def body(state):
    state.write_bytes(worker.HEAD.pack(1, 3) + b"bad")
    {end}
start = lambda state, said, err: run.Forked(lambda: body(state), state, said, err)
print(run.watched_process("target", Path({str(tmp_path)!r}), start)[0]["inputs"])
"""
    done = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, check=False)
    assert (done.returncode, done.stdout.split()) == (0, ["1"]), done.stderr
    (found,) = tmp_path.glob("target-died*.txt")
    assert found.with_suffix("").read_bytes() == b"bad"


SCRIPT = """
import json, sys
sys.path.insert(0, {tests!r})
from fuzz.instrument import install
coverage = install()
from haros_ci.model.condition import evaluate
first = len(coverage.new())
evaluate("$X == 'a'", {{"X": "a"}})
second = len(coverage.new())
coverage.clear()
evaluate("$X == 'a'", {{"X": "a"}})
third = len(coverage.new())
words = [word.decode("utf-8", "replace") for words in coverage.words.values() for word in words]
print(json.dumps([first, second, third, "and" in words]))
"""


def test_coverage_is_of_blocks_that_were_not_entered_before() -> None:
    script = SCRIPT.format(tests=str(HERE.parent))
    done = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, cwd=ROOT, check=True)
    _, second, third, has_word = json.loads(done.stdout)
    assert second > 0 and third == 0 and has_word


def test_the_page_lists_the_targets() -> None:
    page = (ROOT / "docs" / "fuzzing.md").read_text("utf-8")
    listed = dict(re.findall(r"^\| `([a-z0-9-]+)` \| (.+?) \|$", page, re.MULTILINE))
    assert listed == {name: targets.entry(name).what for name in targets.NAMES}
