# SPDX-License-Identifier: Apache-2.0
"""Changes that bring what would silence them, where the base revision cannot be had: nothing of the head decides."""

from __future__ import annotations

import html
import json
import shutil
from collections.abc import Callable
from dataclasses import dataclass

import pytest
from hostile_kit import CHEAP_FINDING, CONTROL, Trap, assert_harmless

SILENT = "ignore: ['*', nullPointer, cppcheck]\nfail-on: never\nexclude: ['**']\nlinters: {cppcheck: false}\n"
QUICK = ("--ignore=pylint,cpplint,metrics,ruff,unassignedVariable",)
USED_INSTEAD = "The defaults and the command line are used"


def change(trap: Trap) -> None:
    """A base with a defect, and a head of another branch; the head's commit is the caller's."""
    (trap.root / CONTROL).unlink()
    trap.write(CHEAP_FINDING[0], "int f(int x) { int *unset = 0; return *unset + x; }\n")
    trap.commit()
    trap.git("checkout", "-q", "-b", "head")


def orphan(trap: Trap) -> None:
    trap.git("checkout", "-q", "--orphan", "alone")
    trap.commit()


def unborn(trap: Trap) -> None:
    trap.git("checkout", "-q", "--orphan", "alone")


def without_git(trap: Trap) -> None:
    shutil.rmtree(trap.root / ".git")


def without_objects(trap: Trap) -> None:
    """As after a fetch that failed half way."""
    commit = trap.git("rev-parse", "main")
    (trap.root / ".git/objects" / commit[:2] / commit[2:]).unlink()


def without_the_blob(trap: Trap) -> None:
    """The commit is there, the base's project file is not."""
    blob = trap.git("rev-parse", "main:.haros-ci.yaml")
    (trap.root / ".git/objects" / blob[:2] / blob[2:]).unlink()


def shallow(trap: Trap) -> None:
    """As actions/checkout leaves it: the head's commit alone."""
    commit = trap.git("rev-parse", "HEAD")
    trap.write(".git/shallow", f"{commit}\n")


def garbage(trap: Trap) -> None:
    trap.write(".git/refs/heads/main", "junk\n")


MISSING: dict[str, tuple[str, Callable[[Trap], object], str]] = {
    "a wrong name": ("nowhere", lambda t: None, "fetch it first"),
    "an empty name": (" ", lambda t: None, "check the spelling"),
    "an option": ("--all", lambda t: None, "check the spelling"),
    "a branch that is not fetched": ("refs/remotes/origin/main", lambda t: None, "fetch it first"),
    "a head without history": ("main", orphan, "no commit in common"),
    "a head without a commit": ("main", unborn, "no commit yet"),
    "no repository": ("main", without_git, "not in a git repository"),
    "a commit that is not there": ("main", without_objects, "unknown revision"),
    "a shallow clone": ("main", shallow, "fetch more history"),
    "a reference of junk": ("main", garbage, "unknown revision"),
}
BROUGHT: dict[str, tuple[Callable[[Trap], object], tuple[str, ...]]] = {
    "a project file": (lambda t: t.write(".haros-ci.yaml", SILENT), ()),
    "a project file for HAROS": (lambda t: t.write("haros.yaml", SILENT), ()),
    "a project file that is named": (lambda t: t.write("ci/a.yaml", SILENT), ("--project=ci/a.yaml",)),
    "a broken project file": (lambda t: t.write(".haros-ci.yaml", "\t:\n"), ()),
    "a baseline": (lambda t: t.command("baseline", "create", "."), ()),
    "a baseline that is named": (
        lambda t: t.command("baseline", "create", "."),
        ("--baseline=.haros-ci-baseline.jsonl",),
    ),
    "a marker": (lambda t: t.write("sub/COLCON_IGNORE", ""), ()),
}


@pytest.mark.parametrize(
    ("missing", "brought"),
    [
        *((missing, "a project file") for missing in MISSING),
        *(("a wrong name", brought) for brought in BROUGHT if brought != "a project file"),
        ("a head without history", "a marker"),
        ("no repository", "a marker"),
        ("no repository", "a baseline that is named"),
    ],
)
def test_nothing_of_the_head_counts(missing: str, brought: str, trap: Trap) -> None:
    """Defaults and command line decide; it is said in every format, with what is missing and what to do."""
    rev, spoil, advice = MISSING[missing]
    write, arguments = BROUGHT[brought]
    change(trap)
    write(trap)
    trap.write("sub/b.cpp", "int g(int x) { int *unset = 0; return *unset + x; }\n")
    trap.commit()
    spoil(trap)
    outcome = trap.run(f"--baseline-rev={rev}", *QUICK, *arguments, "--no-require-baseline")
    assert outcome.code == 1, (outcome.stderr, outcome.notes())
    expected = {CHEAP_FINDING, ("sub/b.cpp", 1, "nullPointer")}
    if brought == "a marker" and missing == "no repository":  # nobody knows whose marker it is
        expected.remove(("sub/b.cpp", 1, "nullPointer"))
    assert expected <= outcome.findings()
    assert outcome.report["baseline"]["available"] is False
    for name, text in outcome.formats.items():
        plain = json.loads(text) if name in ("json", "sarif") else html.unescape(text)
        assert "No baseline: " in str(plain) and advice in str(plain) and USED_INSTEAD in str(plain), (name, text)
    assert "No baseline: " in outcome.stderr and USED_INSTEAD in outcome.stderr
    assert_harmless(trap, outcome)
    if brought.startswith("a project file"):
        assert outcome.says("does not count"), outcome.notes()
    required = trap.start("check", f"--baseline-rev={rev}", *QUICK, *arguments, "--require-baseline", "--fail-on=never")
    assert (required.returncode, required.stdout) == (3, b"")
    asked = trap.start("check", f"--baseline-rev={rev}", *QUICK, *arguments)
    assert (asked.returncode, asked.stdout) == (2, b"")


@dataclass(frozen=True)
class Quiet:
    """What counts still: *known* if the defect that was there is no new one."""

    name: str
    arguments: Callable[[Trap], tuple[str, ...]]
    code: int
    build: Callable[[Trap], object] = lambda t: None


COUNTS = [
    Quiet("a base that is there", lambda t: ("--baseline-rev=main",), 0),
    Quiet(
        "a project file from outside of the workspace",
        lambda t: ("--baseline-rev=nowhere", "--no-require-baseline", f"--project={t.outside / 'own.yaml'}"),
        0,
        lambda t: (t.outside / "own.yaml").write_text("ignore: [nullPointer]\n"),
    ),
    Quiet("the command line", lambda t: ("--baseline-rev=nowhere", "--no-require-baseline", "--ignore=nullPointer"), 0),
    Quiet(
        "a threshold of the command line",
        lambda t: ("--baseline-rev=nowhere", "--no-require-baseline", "--fail-on=never"),
        0,
    ),
    Quiet("no base asked for", lambda t: (), 0, lambda t: t.write(".haros-ci.yaml", "ignore: [nullPointer]\n")),
    Quiet("no base asked for, a baseline", lambda t: (), 0, lambda t: t.command("baseline", "create", ".", *QUICK)),
    Quiet("no base asked for, and none needed", lambda t: (), 1),
]


@pytest.mark.parametrize("case", COUNTS, ids=lambda case: case.name)
def test_what_the_caller_says_counts(case: Quiet, trap: Trap) -> None:
    change(trap)
    case.build(trap)
    if trap.git("status", "--porcelain"):
        trap.commit()
    outcome = trap.run(*QUICK, *case.arguments(trap))
    assert outcome.code == case.code, (outcome.stderr, outcome.notes())
    assert outcome.says("No baseline") is any("nowhere" in word for word in case.arguments(trap))
    assert_harmless(trap, outcome)


def test_the_bases_project_file_that_cannot_be_read(trap: Trap) -> None:
    """The commit is known and its file is not: neither the head's file counts, nor is it an internal error."""
    trap.write(".haros-ci.yaml", "profile: ros\n")
    change(trap)
    trap.write(".haros-ci.yaml", SILENT)
    trap.commit()
    without_the_blob(trap)
    outcome = trap.run("--baseline-rev=main", "--no-require-baseline", *QUICK)
    assert outcome.code == 1 and CHEAP_FINDING in outcome.findings(), (outcome.stderr, outcome.notes())
    assert outcome.says("No baseline: ") and USED_INSTEAD in outcome.formats["text"]
    assert_harmless(trap, outcome)


def test_a_baseline_from_outside_does_not_make_up_for_the_base(trap: Trap) -> None:
    """What is known is known; but the project file is not the base's, which --require-baseline asks for."""
    change(trap)
    known = trap.outside / "known.jsonl"
    trap.command("baseline", "create", ".", f"--file={known}", *QUICK)
    arguments = ("--baseline-rev=nowhere", f"--baseline={known}", *QUICK)
    outcome = trap.run(*arguments, "--no-require-baseline")
    assert (outcome.code, outcome.report["counts"]["unchanged"]) == (0, 1)
    assert outcome.says("unknown revision 'nowhere'") and outcome.says(USED_INSTEAD)
    assert trap.start("check", *arguments, "--require-baseline").returncode == 3


def test_a_project_file_beside_the_repository(trap: Trap) -> None:
    """Of a workspace around one repository no change of the repository can alter the project file: it counts."""
    change(trap)
    inner = trap.place / "around" / "src" / "arm"
    inner.parent.mkdir(parents=True)
    trap.root.rename(inner)
    around = inner.parent.parent
    (around / ".haros-ci.yaml").write_text("levels: {nullPointer: note}\n")
    trap.root = around
    outcome = trap.run("--baseline-rev=main", *QUICK)
    assert outcome.code == 0 and outcome.report["baseline"]["available"] is True, (outcome.stderr, outcome.notes())
    assert [(r["level"], r["state"]) for r in outcome.report["results"]] == [("note", "unchanged")]


def test_a_shard_says_it_and_merge_decides(trap: Trap) -> None:
    change(trap)
    trap.write(".haros-ci.yaml", SILENT)
    trap.commit()
    shard = trap.place / "a.shard.jsonl"
    options = ("--baseline-rev=nowhere", *QUICK)
    assert trap.start("check", "--shard=1/1", f"--output=shard={shard}", *options).returncode == 2
    done = trap.start("check", "--shard=1/1", f"--output=shard={shard}", *options, "--no-require-baseline")
    assert done.returncode == 0 and USED_INSTEAD in done.stderr.decode()
    refused = trap.start("merge", "--output=json", *options, "--require-baseline", str(shard))
    assert (refused.returncode, refused.stdout) == (3, b"")
    merged = trap.start("merge", "--output=json", *options, "--no-require-baseline", str(shard))
    assert merged.returncode == 1
    assert [r["rule"] for r in json.loads(merged.stdout)["results"]] == ["nullPointer"]


def test_diff_of_histories_without_a_common_commit(trap: Trap) -> None:
    change(trap)
    trap.git("checkout", "-q", "--orphan", "alone")
    trap.write(".haros-ci.yaml", "\t:\n")
    trap.commit()
    done = trap.start("diff", "main")
    assert done.returncode == 0 and "no commit in common" in done.stderr.decode(), done.stderr
    assert trap.start("diff", "nowhere").returncode == 2


def test_settings_are_shown_as_they_hold(trap: Trap) -> None:
    change(trap)
    trap.write(".haros-ci.yaml", SILENT)
    shown = trap.command("check", "--show-settings", "--baseline-rev=nowhere")
    assert "unknown revision" in shown and "profile: ros" in shown and "nullPointer" not in shown
