# SPDX-License-Identifier: Apache-2.0
"""Planted caches: wherever one lies and whatever is in it, it costs time only, and the report is the same."""

from __future__ import annotations

import os
import pickle
from pathlib import Path

import pytest
from cache_kit import (
    EVIL,
    UNWRITTEN,
    Case,
    Payload,
    crowded,
    directory,
    doctored,
    each,
    entries,
    included,
    linked,
    listening,
    located,
    programs,
    shards,
    sparse,
    truncated,
)
from hostile_kit import CHEAP_FINDING, Outcome, Trap, assert_harmless, assert_the_rest_is_analysed

INSIDE = "the cache directory lies inside the workspace"


def deep_link(t: Trap) -> None:
    (t.root / "a").symlink_to(t.outside)


def pipe(t: Trap) -> None:
    t.cache = t.place / "pipe"
    os.mkfifo(t.cache)


REFUSED = [
    Case("in the workspace", located(lambda t: t.root / "cache"), INSIDE),
    Case("the workspace", located(lambda t: t.root), INSIDE),
    Case("the working directory", located(lambda t: Path(".")), INSIDE),
    Case("below the working directory", located(lambda t: Path("a/b")), INSIDE),
    Case("by a way round", located(lambda t: t.outside / ".." / "ws" / "cache"), INSIDE),
    Case("a link into the workspace", linked(lambda t: t.place / "link", lambda t: t.root), INSIDE),
    Case("a link out of the workspace", linked(lambda t: t.root / "link", lambda t: t.outside), INSIDE),
    Case("behind a link, named", deep_link, "a symbolic link of the workspace", ("--cache-dir=a",)),
    Case("far behind a link, named", deep_link, "a symbolic link of the workspace", ("--cache-dir=a/b/c",)),
    Case("a file, named", lambda t: None, "'--cache-dir'", (f"--cache-dir={CHEAP_FINDING[0]}",)),
]


def assert_refused(trap: Trap, outcome: Outcome, says: str) -> None:
    assert outcome.code == 2 and says in outcome.stderr, outcome.stderr
    assert outcome.stderr.startswith(("error: ", "Usage: ")) and set(outcome.formats.values()) == {""}
    assert_harmless(trap, outcome)


@pytest.mark.parametrize("case", REFUSED, ids=lambda case: case.name)
def test_places_that_are_refused(case: Case, trap: Trap) -> None:
    """A pull request brings along what is in the workspace: a cache there is taken only if it is named, and no link."""
    trap.use_cheap_control()
    case.plant(trap)
    before = sorted(trap.root.rglob("*")), sorted(trap.outside.rglob("*"))
    assert_refused(trap, trap.run(*case.arguments), case.says)
    assert (sorted(trap.root.rglob("*")), sorted(trap.outside.rglob("*"))) == before


@pytest.mark.parametrize("variable", ["XDG_CACHE_HOME", "HOME"])
def test_a_default_place_in_the_workspace(variable: str, trap: Trap) -> None:
    trap.use_cheap_control()
    environment = {"HAROS_CI_CACHE": "", "XDG_CACHE_HOME": "", variable: str(trap.root)}
    assert_refused(trap, trap.run(environment=environment), INSIDE)


@pytest.mark.parametrize("named", ["cache", "a/../cache", "new/cache"])
def test_a_place_in_the_workspace_that_is_named(named: str, trap: Trap, uncached: Outcome) -> None:
    """It is taken, and what was planted there is not believed."""
    trap.use_cheap_control()
    for number in range(16):
        trap.write(f"{named}/cppcheck-{number:x}.json", pickle.dumps(number))
    outcome = trap.run(f"--cache-dir={named}")
    assert outcome.code == 1 and outcome.stderr == ""
    assert_harmless(trap, outcome)
    assert outcome.findings() == uncached.findings()
    written = [file for file in (trap.root / named).iterdir() if file.read_bytes().startswith(b"{")]
    groups = sorted({file.name.rpartition("-")[0] for file in written})  # two of one group may be in one file
    # what is known of files, and as a whole: what was found in the architecture, the architecture, and what it lacks
    assert groups == ["cppcheck", "facts-cpp", "includes", "libraries", "macros", "sights", "whole"]


UNUSABLE = [
    Case("a file", located(lambda t: t.outside / "victim.json"), UNWRITTEN),
    Case("below a file", located(lambda t: t.outside / "victim.json" / "cache"), UNWRITTEN),
    Case("a device", located(lambda t: Path("/dev/null")), UNWRITTEN),
    Case("a pipe", pipe, UNWRITTEN),
    Case("a name too long", located(lambda t: t.place / ("x" * 300)), UNWRITTEN),
    Case("a link to nowhere", linked(lambda t: t.place / "link", lambda t: "nowhere"), UNWRITTEN),
    Case("a link to a file", linked(lambda t: t.place / "link", lambda t: t.outside / "victim.json"), UNWRITTEN),
    Case("a link to itself", linked(lambda t: t.place / "link", lambda t: "link"), UNWRITTEN),
    Case("a link to a directory", linked(lambda t: t.place / "link", lambda t: t.sentinels.parent)),
]


SPOILED = [
    Case("emptied", shards("")),
    Case("truncated", truncated),
    Case("binary", shards(b"\x00\xff\x1b[31m::error::x\n##[error]x")),
    Case("a program", shards(b"\x7fELF" + bytes(range(256)) * 100)),
    Case("pickled", each(lambda t, shard: shard.write_bytes(pickle.dumps(Payload(t.touch("pickle")))))),
    Case(
        "a YAML tag", each(lambda t, shard: shard.write_text(f"!!python/object/apply:os.system ['{t.touch('yaml')}']"))
    ),
    Case("foreign", shards('{"name": "x", "dependencies": {"y": "^1.0.0"}}')),
    Case("a list", shards("[1, 2, 3]")),
    Case("another format", shards('{"format": 99, "run": 1, "entries": {}}')),
    Case("wrong types", shards('{"format": 1, "run": "x", "entries": []}')),
    Case("a run beyond all", shards(f'{{"format": 1, "run": {1 << 60}, "entries": {{}}}}')),
    Case("the last run", shards(f'{{"format": 1, "run": {(1 << 53) - 1}, "entries": {{}}}}')),
    Case("no numbers", entries('"x": [1, NaN], "y": [1, -Infinity]')),
    Case("numbers beyond all", entries('"x": [1, {"a": [1e999, -1e999]}]')),
    Case("a long number", entries(f'"x": [1, {"9" * 4_000}], "y": [{"9" * 4_000}, 1]')),
    Case("a number that is too long", entries(f'"x": [1, {"9" * 100_000}]')),
    Case("UTF-16", shards('{"format": 1, "run": 1, "entries": {"x": [1, 1]}}'.encode("utf-16"))),
    Case("surrogates", entries('"\\ud800": [1, "\\udfff"]')),
    Case("deep", shards("[" * 200_000)),
    Case("deep, and whole", shards("[" * 200_000 + "]" * 200_000)),
    Case("deep entries", entries(f'"x": [1, {"[" * 940}{"]" * 940}]')),
    Case("zeros, as many as are read", each(sparse(32_000_000))),
    Case("a terabyte of zeros", each(sparse(1 << 40))),
    Case("crowded", crowded),
    Case("links to a victim", each(lambda t, shard: shard.symlink_to(t.outside / "victim.json"))),
    Case("links to a secret", each(lambda t, shard: shard.symlink_to(t.outside / "secret.py"))),
    Case("links to a device", each(lambda t, shard: shard.symlink_to("/dev/zero"))),
    Case("links to a directory", each(lambda t, shard: shard.symlink_to(t.outside))),
    Case("links to nowhere", each(lambda t, shard: shard.symlink_to("nowhere"))),
    Case("links to themselves", each(lambda t, shard: shard.symlink_to(shard.name))),
    Case("second names of a victim", each(lambda t, shard: shard.hardlink_to(t.outside / "victim.json"))),
    Case("directories", each(directory), UNWRITTEN),
    Case("pipes", each(lambda t, shard: os.mkfifo(shard))),
    Case("sockets", each(listening)),
    Case("programs and modules", programs),
    Case("no includes", included([])),
    Case("wrong includes", included([1, None, []])),
    Case("includes of no shape", included(3)),
    Case("deep includes", included([[[[[]]]]])),
    Case("includes outside", included(["../outside/error.hpp", "/etc/passwd", "../" * 50, EVIL, "control.cpp", ""])),
    Case("includes of another shape", doctored(lambda value: [[EVIL]], "includes")),
]


@pytest.mark.parametrize("case", [*UNUSABLE, *SPOILED], ids=lambda case: case.name)
def test_the_report_is_the_same(case: Case, trap: Trap, uncached: Outcome) -> None:
    trap.use_cheap_control()
    case.plant(trap)
    before = {file.name: file.read_bytes() for file in trap.outside.iterdir()}
    outcome = trap.run(*case.arguments)
    assert outcome.stderr.startswith(case.says) and (case.says or outcome.stderr == "")
    assert outcome.code == 1 and outcome.formats == uncached.formats
    assert_harmless(trap, outcome)
    assert_the_rest_is_analysed(outcome, CHEAP_FINDING)
    assert {file.name: file.read_bytes() for file in trap.outside.iterdir()} == before


def test_what_was_spoiled_is_written_anew(trap: Trap) -> None:
    trap.use_cheap_control()
    shards("[" * 200_000)(trap)
    assert b" 0 hits, 11 misses" in trap.start("check", "--timings").stderr
    # what was found in the architecture is kept as a whole: facts of files and what nodes make are not asked for
    assert b" 6 hits, 0 misses" in trap.start("check", "--timings").stderr


@pytest.mark.parametrize("mode", [0o000, 0o100, 0o300, 0o500], ids=oct)
def test_a_directory_without_permission(mode: int, trap: Trap, uncached: Outcome) -> None:
    """Without the right to list it (0o300) it is written, but not trimmed."""
    trap.use_cheap_control()
    trap.use_filled_cache()
    for shard in trap.cache.iterdir():
        shard.write_text("junk")  # so that there is something to write
    trap.cache.chmod(mode)
    outcome = trap.run(driver=trap.unprivileged())
    trap.cache.chmod(0o700)
    assert outcome.code == 1 and outcome.formats == uncached.formats
    assert outcome.stderr.startswith(UNWRITTEN)
    assert_harmless(trap, outcome)


def test_files_without_permission(trap: Trap, uncached: Outcome) -> None:
    trap.use_cheap_control()
    trap.use_filled_cache()
    for shard in trap.cache.iterdir():
        shard.chmod(0)
    outcome = trap.run(driver=trap.unprivileged())
    assert outcome.code == 1 and outcome.stderr == "" and outcome.formats == uncached.formats


COMMANDS = [
    Case("a file", located(lambda t: t.outside / "victim.json")),
    Case("a link to a file", linked(lambda t: t.place / "link", lambda t: t.outside / "victim.json")),
    Case("a link to nowhere", linked(lambda t: t.place / "link", lambda t: "nowhere")),
    Case("a link to itself", linked(lambda t: t.place / "link", lambda t: "link")),
    Case("a name too long", located(lambda t: t.place / ("x" * 300))),
    Case("links to a victim", each(lambda t, shard: shard.symlink_to(t.outside / "victim.json"))),
    Case("links to a directory", each(lambda t, shard: shard.symlink_to(t.outside))),
    Case("links to nowhere", each(lambda t, shard: shard.symlink_to("nowhere"))),
    Case("directories", each(directory)),
    Case("pipes", each(lambda t, shard: os.mkfifo(shard))),
    Case("programs and modules", programs),
]


@pytest.mark.parametrize("case", COMMANDS, ids=lambda case: case.name)
def test_the_cache_command(case: Case, trap: Trap) -> None:
    """``cache dir``, ``stats`` and ``clear`` do it or say why not, and touch nothing elsewhere."""
    trap.use_cheap_control()
    case.plant(trap)
    before = {file.name: file.read_bytes() for file in trap.outside.iterdir()}
    for action in ("dir", "stats", "clear"):
        done = trap.start("cache", action)
        said = done.stderr.decode()
        assert (done.returncode, said) == (0, "") or (done.returncode == 2 and said.startswith("error: ")), said
    assert {file.name: file.read_bytes() for file in trap.outside.iterdir()} == before
    assert trap.executed == []


@pytest.mark.parametrize("action", ["dir", "stats", "clear"])
def test_the_cache_command_in_the_workspace(action: str, trap: Trap) -> None:
    trap.cache = trap.root
    kept = trap.write("x-0.json", "{}")
    done = trap.start("cache", action)
    assert done.returncode == 2 and INSIDE in done.stderr.decode()
    assert kept.exists()


def test_clear_leaves_what_is_not_its_own(trap: Trap) -> None:
    trap.use_cheap_control()
    programs(trap)
    assert trap.start("cache", "clear").returncode == 0
    left = {file.name for file in trap.cache.iterdir()}
    assert not any(name.endswith(".json") for name in left) and {"git", "json.py", "x.pth"} < left
