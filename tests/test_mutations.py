# SPDX-License-Identifier: Apache-2.0
"""What stays old and what is new after a change: the real command on real git histories, with all three baselines."""

from __future__ import annotations

import json
from collections import Counter
from functools import cache
from pathlib import Path

import pytest
from commandline import commit, git, haros, write
from histories import History, Log, history, states
from histories import expected as states_of
from mutations import LINE, MUTATIONS, WALKER, Mutation

KINDS = ("revision", "sarif", "compact")
CASES = {f"c{number}": mutation for number, mutation in enumerate(MUTATIONS)}


class Lab:
    """The histories, each made when a test first asks for it, and what the command says of each."""

    def __init__(self, scratch: Path) -> None:
        self.scratch = scratch
        self.history = cache(self._history)
        self.results = cache(self._results)

    def _history(self, tools: tuple[str, ...]) -> History:
        cases = {case: mutation for case, mutation in CASES.items() if mutation.tools == tools}
        return history(self.scratch / "-".join(("tools", *tools)), cases, self.scratch / "cache")

    def _results(self, tools: tuple[str, ...], kind: str) -> dict[str, list[Log]]:
        return self.history(tools).results(kind)


@pytest.fixture(scope="module")
def lab(tmp_path_factory: pytest.TempPathFactory) -> Lab:
    return Lab(tmp_path_factory.mktemp("mutations"))


def case_of(name: str) -> str:
    """The directory of the case with that name."""
    (found,) = [case for case, mutation in CASES.items() if mutation.name == name]
    return found


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("case", CASES, ids=lambda case: f"{CASES[case].number} {CASES[case].name}")
def test_states(lab: Lab, case: str, kind: str) -> None:
    mutation = CASES[case]
    results = lab.results(mutation.tools, kind)[case]
    why = [(r["path"], r["line"], r["state"], r["reason"]) for r in results]
    assert states(results) == states_of(mutation, kind), why
    if mutation.lines is not None:
        assert tuple(r["line"] for r in results if r["state"] == "new") == mutation.lines, why


def test_every_number_has_a_test() -> None:
    assert {mutation.number for mutation in MUTATIONS} | {26, 35, 36, 37, 38} == set(range(1, 41))


@pytest.mark.parametrize("mutation", MUTATIONS, ids=lambda m: m.name)
def test_every_difference_of_a_file_has_a_reason(mutation: Mutation) -> None:
    assert bool(mutation.sarif or mutation.compact) == bool(mutation.why)
    assert mutation.states not in (mutation.sarif, mutation.compact)


# 26. None of our own tools has renamed a rule, so the new name comes with an imported log, as it does in life.
@pytest.mark.parametrize(("known_as", "state"), [(["old-name"], "updated"), ([], "new")])
def test_a_renamed_rule_of_an_imported_log(tmp_path: Path, known_as: list[str], state: str) -> None:
    root = write(tmp_path / "ws", {"walker.cpp": WALKER})
    line = WALKER.splitlines().index(LINE.rstrip("\n")) + 1
    write(tmp_path, {"old.sarif": foreign("old-name", [], line), "new.sarif": foreign("new-name", known_as, line)})
    off = ["--project", str(write(tmp_path, {"none.yaml": NO_TOOLS}) / "none.yaml"), "--no-cache"]
    logs = ["--import", str(tmp_path / "new.sarif"), "--baseline", str(tmp_path / "old.sarif")]
    done = haros("check", *off, *logs, "--output=json", "--fail-on=never", cwd=root)
    assert done.returncode == 0, done.stderr
    found = [(r["rule"], r["state"]) for r in json.loads(done.stdout)["results"]]
    absent = [] if known_as else [("old-name", "absent")]
    assert sorted(found) == sorted([("new-name", state), *absent])


NO_TOOLS = "linters: {cpplint: false, pylint: false, cppcheck: false, lizard: false, radon: false}\n"


def foreign(rule: str, known_as: list[str], line: int) -> str:
    """The log of another tool that has one finding."""
    place = {"artifactLocation": {"uri": "walker.cpp"}, "region": {"startLine": line}}
    result = {"ruleId": rule, "message": {"text": "May overrun."}, "locations": [{"physicalLocation": place}]}
    driver = {"name": "other", "rules": [{"id": rule, **({"deprecatedIds": known_as} if known_as else {})}]}
    return json.dumps({"version": "2.1.0", "runs": [{"tool": {"driver": driver}, "results": [result]}]})


@pytest.fixture(scope="module")
def upstream(lab: Lab, tmp_path_factory: pytest.TempPathFactory) -> History:
    """A clone whose base is a commit further."""
    made = lab.history(("cpplint",))
    root = tmp_path_factory.mktemp("clone") / "ws"
    git(made.root, "clone", "-q", ".", str(root))
    git(root, "checkout", "-q", "-b", "upstream", made.base)
    write(root, {"elsewhere/src/turn.cpp": WALKER.replace("Walker", "Turner").replace("first", "other")})
    return History(root, made.options, made.cases, commit(root, "upstream"), made.head)


@pytest.fixture(scope="module")
def shallow(lab: Lab, tmp_path_factory: pytest.TempPathFactory) -> History:
    made = lab.history(("lizard",))
    root = tmp_path_factory.mktemp("shallow") / "ws"
    git(made.root, "clone", "-q", "--depth=1", made.root.as_uri(), str(root))
    return History(root, made.options, made.cases, made.base, made.head)


# 35. The same change on a newer upstream, which has a finding of its own.
@pytest.mark.parametrize(
    ("branch", "commands"),
    [
        ("unmerged", [["checkout", "-q", "-B", "unmerged", "HEAD"]]),
        ("merged", [["checkout", "-q", "-B", "merged", "HEAD"], ["merge", "-q", "--no-edit", "upstream"]]),
        ("rebased", [["checkout", "-q", "-B", "rebased", "HEAD"], ["rebase", "-q", "upstream"]]),
        (
            "squashed",
            [
                ["checkout", "-q", "-B", "squashed", "upstream"],
                ["merge", "-q", "--squash", "HEAD"],
                ["commit", "-q", "-m", "squashed"],
            ],
        ),
    ],
)
def test_the_same_states_on_a_newer_upstream(
    lab: Lab, upstream: History, branch: str, commands: list[list[str]]
) -> None:
    for command in commands:
        git(upstream.root, *(upstream.head if word == "HEAD" else word for word in command))
    report = upstream.check(upstream.baseline("revision"))
    theirs = {r["state"] for r in report["results"] if r["path"].startswith("elsewhere/")}
    assert theirs == (set() if branch == "unmerged" else {"unchanged"})
    ours = [r for r in report["results"] if not r["path"].startswith("elsewhere/")]
    made = lab.history(("cpplint",))
    assert ours == made.check(made.baseline("revision"))["results"]


def test_order_of_arguments_and_number_of_processes_leave_no_trace(lab: Lab) -> None:
    """36."""
    made = lab.history(("cpplint",))
    some = [
        case_of(name) for name in ("file renamed", "file copied", "function moved to another file", "block indented")
    ]
    files = sorted(str(path.relative_to(made.root)) for case in some for path in (made.root / case).rglob("*.cpp"))
    arguments = ("--no-cache", made.baseline("revision"), "--fail-on=never", "--output=sarif")
    plain = haros("check", *made.options, *arguments, "--jobs=1", *files, cwd=made.root)
    shuffled = haros("check", *made.options, *arguments, "--jobs=4", *files[1::2], *files[::-2], cwd=made.root)
    assert plain.returncode == 0, plain.stderr
    assert len(json.loads(plain.stdout)["runs"][0]["results"]) >= len(some)
    assert shuffled.stdout == plain.stdout


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize(
    ("name", "wanted"),
    [
        ("first of two mended", "unchanged absent"),
        ("line duplicated below", "unchanged new"),
        ("file renamed", "updated"),
        ("function moved to another file", "updated"),
        ("block indented", "unchanged"),
    ],
)
def test_only_some_files(lab: Lab, kind: str, name: str, wanted: str) -> None:
    """37. The arguments are files: of all others, whose findings the baseline has too, nothing is said."""
    if name == "file renamed" and kind != "revision":
        wanted = "new"  # whether a file that is no argument is gone, such a run cannot tell without git
    made = lab.history(("cpplint",))
    files = [str(path.relative_to(made.root)) for path in (made.root / case_of(name)).rglob("*.cpp")]
    report = made.check(made.baseline(kind), *files)
    watched = [r for r in report["results"] if r["rule"] == "runtime/printf"]
    assert Counter(r["state"] for r in watched) == Counter(wanted.split())
    assert {r["path"].partition("/")[0] for r in report["results"]} == {case_of(name)}


# 38.
@pytest.mark.parametrize("flag", ["--baseline-rev=nowhere", "--baseline-rev=HEAD~1", "--baseline-rev=@base"])
def test_without_a_base_all_counts_and_it_is_said(shallow: History, flag: str) -> None:
    asked = ("check", *shallow.options, flag.replace("@base", shallow.base), "--fail-on=note")
    assert haros(*asked, cwd=shallow.root).returncode == 2
    arguments = (*asked, "--no-require-baseline")
    done = haros(*arguments, cwd=shallow.root)
    assert done.returncode == 1
    assert "No baseline: " in done.stdout
    report = json.loads(haros(*arguments, "--output=json", cwd=shallow.root).stdout)
    assert report["baseline"]["available"] is False
    assert report["counts"]["open"] == len(report["results"]) > 0
    assert [n for n in report["notifications"] if n["message"].startswith("No baseline: ")]
    assert haros(*arguments, "--require-baseline", cwd=shallow.root).returncode == 3
    assert haros(*arguments, "--require-baseline", "--fail-on=never", cwd=shallow.root).returncode == 3


def test_the_first_commit_has_no_base(tmp_path: Path, lab: Lab) -> None:
    root = write(tmp_path / "ws", {"walker.cpp": WALKER})
    commit(root)
    arguments = ("check", *lab.history(("cpplint",)).options, "--baseline-rev=HEAD~1", "--fail-on=note")
    done = haros(*arguments, cwd=root)
    assert (done.returncode, "no baseline" in done.stderr) == (2, True)
    done = haros(*arguments, "--no-require-baseline", cwd=root)
    assert (done.returncode, "No baseline: " in done.stdout) == (1, True)
    assert haros(*arguments, "--require-baseline", cwd=root).returncode == 3
