# SPDX-License-Identifier: Apache-2.0
"""The command as its users meet it: exit codes, outputs, the baseline file, and the small commands."""

from __future__ import annotations

import json
from pathlib import Path

import pytest
from commandline import commit, haros, write

MANIFEST = """<package format="3">
  <name>lift</name><version>1.0.0</version><description>A lift.</description>
  <maintainer email="a@example.org">A</maintainer><license>Apache-2.0</license>
</package>
"""
#: What else is installed differs from machine to machine.
DEFAULT_TOOLS = {
    "haros.yaml": "linters: {ruff: false, clang-tidy: false, catkin_lint: false}\nselect: [dangerous-default-value]\n"
}
BAD = '"""Doors."""\n\n\ndef close(doors=[]):\n    """Close them."""\n    return doors\n'
GOOD = '"""Doors."""\n\n\ndef close(doors):\n    """Close them."""\n    return doors\n'
UNDEFINED = '"""Cabin."""\n\n\ndef move():\n    """Move."""\n    return flor\n'


@pytest.fixture
def lift(tmp_path: Path) -> Path:
    return write(tmp_path / "lift", {"package.xml": MANIFEST, "lift/doors.py": BAD, **DEFAULT_TOOLS})


def rules_of(text: str) -> list[str]:
    return [f"{r['tool']}:{r['rule']}" for r in json.loads(text)["results"]]


def test_a_finding_fails_the_run(lift: Path) -> None:
    done = haros("check", cwd=lift)
    assert done.returncode == 1
    assert (
        "lift/doors.py:4:1: warning: Dangerous default value [] as argument. [pylint:dangerous-default-value]"
        in done.stdout
    )
    assert "1 finding: 1 warning" in done.stdout


@pytest.mark.parametrize(
    ("arguments", "code"),
    [
        (["--fail-on", "error"], 0),
        (["--fail-on", "never"], 0),
        (["--ignore", "dangerous-default-value"], 0),
        (["--ignore", "haros_plugin_pylint:warning"], 0),
        (["--exclude", "lift/"], 0),
        (["--fail-on", "note"], 1),
        (["--profile", "bugs-only", "--select", "pylint:dangerous-default-value"], 1),
        (["--require-baseline"], 3),
        (["--baseline-rev", "HEAD", "--require-baseline"], 3),
        (["--baseline-rev", "HEAD"], 2),
        (["--baseline-rev", "HEAD", "--no-require-baseline", "--select", "dangerous-default-value"], 1),
        (["--profile", "rosy"], 2),
        (["--select", "unused-imprt"], 2),
        (["--fail-on", "always"], 2),
        (["--output", "xml"], 2),
        (["--output", "sarif", "--output", "json"], 2),
        (["--baseline", "none.sarif"], 2),
        (["--import", "none.sarif"], 2),
        (["--jobs", "0"], 2),
        (["nowhere"], 2),
        (["--no-such-flag"], 2),
    ],
    ids=lambda value: " ".join(value) if isinstance(value, list) else None,
)
def test_exit_codes(lift: Path, arguments: list[str], code: int) -> None:
    done = haros("check", *arguments, cwd=lift)
    assert done.returncode == code, done.stderr
    assert "Traceback" not in done.stderr
    if code == 2:
        assert done.stdout == ""
        assert done.stderr.strip()


def test_clean_is_zero(tmp_path: Path) -> None:
    done = haros("check", cwd=write(tmp_path / "lift", {"package.xml": MANIFEST, "lift/doors.py": GOOD}))
    assert (done.returncode, done.stdout.splitlines()[0]) == (0, "No findings")


def test_an_empty_directory_is_clean_and_says_what_it_did_not_see(tmp_path: Path) -> None:
    (tmp_path / "empty").mkdir()
    done = haros("check", cwd=tmp_path / "empty")
    assert done.returncode == 0
    assert "No package.xml was found" in done.stdout


@pytest.mark.parametrize("format", ["json", "sarif"])
def test_machine_formats_leave_stdout_pure(lift: Path, format: str) -> None:
    done = haros("check", "--output", format, "--statistics", "--timings", cwd=lift)
    assert json.loads(done.stdout)
    assert "per 1000 lines" in done.stderr


def test_several_outputs_at_once(lift: Path) -> None:
    done = haros(
        "check", "--output", "text", "--output", "sarif=out/log.sarif", "--output", "json=out/log.json", cwd=lift
    )
    assert "1 finding" in done.stdout
    log = json.loads((lift / "out/log.sarif").read_text())
    assert log["version"] == "2.1.0"
    assert rules_of((lift / "out/log.json").read_text()) == ["pylint:dangerous-default-value"]


def test_github_output_writes_the_job_summary(lift: Path, tmp_path: Path) -> None:
    page = tmp_path / "summary.md"
    done = haros("check", "--output", "github", cwd=lift, GITHUB_STEP_SUMMARY=str(page))
    assert done.stdout.startswith("::warning file=lift/doors.py,line=4")
    assert "dangerous-default-value" in page.read_text()


def test_paths_are_relative_to_the_repository(lift: Path) -> None:
    commit(lift)
    done = haros("check", "--output", "json", cwd=lift / "lift")
    assert [r["path"] for r in json.loads(done.stdout)["results"]] == ["lift/doors.py"]


def test_file_arguments_report_on_those_files_only(lift: Path) -> None:
    write(lift, {"lift/cabin.py": UNDEFINED})
    done = haros("check", "--output", "json", "lift/cabin.py", cwd=lift)
    assert rules_of(done.stdout) == ["pylint:undefined-variable"]


def test_settings_are_shown_and_nothing_runs(lift: Path) -> None:
    done = haros("check", "--show-settings", "--profile", "strict", cwd=lift)
    assert done.returncode == 0
    assert "strict" in done.stdout
    assert "finding" not in done.stdout


def test_the_same_bytes_from_cache_and_without(lift: Path) -> None:
    texts = {
        haros("check", "--output", "sarif", *more, cwd=lift).stdout
        for more in (["--no-cache"], [], [], ["--no-cache", "--jobs=1"])
    }
    assert len(texts) == 1


class TestBaselineFile:
    def test_day_one(self, lift: Path) -> None:
        assert haros("baseline", "create", cwd=lift).returncode == 0
        done = haros("check", cwd=lift)
        assert (done.returncode, done.stdout.splitlines()[0]) == (0, "No new findings")
        write(lift, {"lift/cabin.py": UNDEFINED})
        done = haros("check", cwd=lift)
        assert done.returncode == 1
        assert "1 new finding: 1 error" in done.stdout
        assert "dangerous-default-value" not in done.stdout
        assert haros("check", "--no-baseline", "--output", "json", cwd=lift).stdout.count('"rule": "') >= 2

    def test_create_leaves_what_is_known_alone(self, lift: Path) -> None:
        haros("baseline", "create", cwd=lift)
        file = lift / ".haros-ci-baseline.jsonl"
        known = file.read_bytes()
        assert haros("baseline", "create", cwd=lift).returncode == 0, "the same findings: nothing to lose"
        file.write_bytes(known := known.replace(b'"rule"', b'"reason":"agreed","rule"'))
        write(lift, {"lift/cabin.py": UNDEFINED, "lift/doors.py": GOOD})
        done = haros("baseline", "create", cwd=lift)
        assert (done.returncode, file.read_bytes()) == (2, known)
        assert (
            "To write it anew would add 1 finding, take away 1 finding and lose the reasons of 1 finding" in done.stderr
        )
        assert "the first one to be added: lift/cabin.py:" in done.stderr and "--accept-new" in done.stderr
        assert haros("baseline", "create", "--force", cwd=lift).returncode == 0
        assert haros("check", cwd=lift).returncode == 0 and b"agreed" not in file.read_bytes()

    @pytest.mark.parametrize("text", ["# Notes\n", '{"a": 1}\n', "\x00"])
    def test_create_overwrites_no_file_of_another_kind(self, lift: Path, text: str) -> None:
        write(lift, {"notes.md": text})
        done = haros("baseline", "create", "--file", "notes.md", cwd=lift)
        assert done.returncode == 2 and "may be something else" in done.stderr
        assert (lift / "notes.md").read_text() == text

    def test_create_fills_an_empty_file(self, lift: Path) -> None:
        write(lift, {"known.jsonl": ""})
        assert haros("baseline", "create", "--file", "known.jsonl", cwd=lift).returncode == 0

    def test_update_never_adds_new_ones_unless_told(self, lift: Path) -> None:
        haros("baseline", "create", cwd=lift)
        write(lift, {"lift/cabin.py": UNDEFINED, "lift/doors.py": BAD.replace("Doors", "All doors")})
        assert haros("baseline", "update", cwd=lift).returncode == 0
        assert haros("check", cwd=lift).returncode == 1
        assert haros("baseline", "update", "--accept-new", cwd=lift).returncode == 0
        assert haros("check", cwd=lift).returncode == 0

    def test_prune_drops_what_is_gone(self, lift: Path) -> None:
        haros("baseline", "create", cwd=lift)
        write(lift, {"lift/doors.py": GOOD})
        assert "1 of 1 known findings are gone" in haros("baseline", "prune", cwd=lift).stdout
        assert (lift / ".haros-ci-baseline.jsonl").read_text() == '{"haros-ci-baseline": 1}\n'

    def test_show(self, lift: Path) -> None:
        assert haros("baseline", "show", cwd=lift).returncode == 2
        haros("baseline", "create", cwd=lift)
        assert "lift/doors.py in close: " in haros("baseline", "show", cwd=lift).stdout

    def test_a_sarif_log_is_a_baseline_too(self, lift: Path) -> None:
        haros("check", "--output", "sarif=old.sarif", cwd=lift)
        write(lift, {"lift/doors.py": "# moved\n\n" + BAD})
        done = haros("check", "--baseline", "old.sarif", "--output", "json", cwd=lift)
        assert [r["state"] for r in json.loads(done.stdout)["results"]] == ["unchanged"]
        assert done.returncode == 0

    def test_an_import_is_compared_with_a_file(self, lift: Path) -> None:
        foreign = {
            "version": "2.1.0",
            "runs": [
                {
                    "tool": {"driver": {"name": "othertool"}},
                    "results": [
                        {
                            "ruleId": "X1",
                            "message": {"text": "Doors close too fast."},
                            "locations": [
                                {
                                    "physicalLocation": {
                                        "artifactLocation": {"uri": "lift/doors.py"},
                                        "region": {"startLine": 6},
                                    }
                                }
                            ],
                        }
                    ],
                }
            ],
        }
        write(lift, {"other.sarif": json.dumps(foreign)})
        done = haros("check", "--import", "other.sarif", "--output", "json", cwd=lift)
        assert "othertool:X1" in rules_of(done.stdout)
        assert (
            haros(
                "check", "--import", "other.sarif", "--ignore", "othertool:X1", "--output", "json", cwd=lift
            ).stdout.count("X1")
            <= 2
        )
        haros("check", "--import", "other.sarif", "--output", "sarif=old.sarif", cwd=lift)
        again = haros("check", "--import", "other.sarif", "--baseline", "old.sarif", cwd=lift)
        assert again.returncode == 0, again.stdout


class TestPullRequest:
    def test_only_what_the_change_makes_new(self, lift: Path) -> None:
        base = commit(lift)
        write(lift, {"lift/cabin.py": UNDEFINED, "lift/doors.py": "# a comment\n" + BAD})
        commit(lift)
        done = haros("check", "--baseline-rev", base, "--output", "json", cwd=lift)
        states = {(r["rule"], r["state"]) for r in json.loads(done.stdout)["results"]}
        assert states == {("undefined-variable", "new"), ("dangerous-default-value", "unchanged")}
        assert done.returncode == 1

    def test_the_heads_own_settings_have_no_effect(self, lift: Path) -> None:
        base = commit(lift)
        write(lift, {"lift/cabin.py": UNDEFINED, ".haros-ci.yaml": "ignore: ['*']\n"})
        done = haros("check", "--baseline-rev", base, cwd=lift)
        assert done.returncode == 1
        assert ".haros-ci.yaml differs from the base revision's haros.yaml" in done.stdout

    def test_the_heads_own_baseline_has_no_effect(self, lift: Path) -> None:
        haros("baseline", "create", cwd=lift)
        base = commit(lift)
        write(lift, {"lift/cabin.py": UNDEFINED})
        haros("baseline", "create", "--force", cwd=lift)
        commit(lift)
        assert haros("check", cwd=lift).returncode == 0
        named = haros("check", "--baseline", ".haros-ci-baseline.jsonl", "--baseline-rev", base, cwd=lift)
        assert named.returncode == 1
        assert "1 new finding" in named.stdout
        assert haros("check", "--baseline-rev", base, cwd=lift).returncode == 1

    def test_a_revision_that_cannot_be_had_is_loud_and_never_green(self, lift: Path) -> None:
        commit(lift)
        done = haros("check", "--baseline-rev", "nowhere", cwd=lift)
        assert (done.returncode, done.stdout) == (2, "")
        assert done.stderr.startswith("error: no baseline, so nothing is reported: unknown revision 'nowhere'")
        assert "--no-require-baseline" in done.stderr
        loose = ("--no-require-baseline", "--select", "dangerous-default-value")  # settings of the change do not count
        done = haros("check", "--baseline-rev", "nowhere", *loose, cwd=lift)
        assert done.returncode == 1 and "No baseline: " in done.stdout
        done = haros("check", "--baseline-rev", "nowhere", "--require-baseline", cwd=lift)
        assert (done.returncode, done.stdout) == (3, "")

    def test_a_baseline_that_the_base_does_not_have_is_the_same(self, lift: Path) -> None:
        base = commit(lift)
        haros("baseline", "create", cwd=lift)
        arguments = ("check", "--baseline-rev", base, "--baseline", ".haros-ci-baseline.jsonl")
        done = haros(*arguments, cwd=lift)
        assert (done.returncode, done.stdout) == (2, "") and "is not in the base revision" in done.stderr
        assert haros(*arguments, "--require-baseline", cwd=lift).returncode == 3
        done = haros(*arguments, "--no-require-baseline", cwd=lift)
        assert done.returncode == 1 and "No baseline: " in done.stdout


class TestSmallCommands:
    def test_explain(self, tmp_path: Path) -> None:
        done = haros("explain", "metrics:max-cyclomatic-complexity-15", "--full", cwd=tmp_path)
        assert done.returncode == 0
        assert "max_cyclomatic_complexity_15" in done.stdout
        assert haros("explain", "max_cyclomatic_complexity_15", "--full", cwd=tmp_path).stdout == done.stdout

    @pytest.mark.parametrize("name", ["G06", "g06", "topic-type-mismatch", "haros-ci:topic-type-mismatch"])
    def test_explain_prints_the_page_of_a_check(self, tmp_path: Path, name: str) -> None:
        said = haros("explain", name, "--full", cwd=tmp_path).stdout
        assert said.startswith("haros-ci:topic-type-mismatch (error)\n\n")
        assert said.count("topic-type-mismatch (") == 1 and "\n# topic-type-mismatch" not in said
        order = [
            said.index(f"\n## {title}\n") for title in ("What it finds", "Why it matters", "Bad", "Good", "Limits")
        ]
        assert order == sorted(order)
        assert "\nAliases: G06" in said and "\nSee: https://" in said

    @pytest.mark.parametrize("name", ["G0", "06", "topic", "", "haros-ci:", "G06 "])
    def test_explain_does_not_guess(self, tmp_path: Path, name: str) -> None:
        assert haros("explain", name, cwd=tmp_path).returncode == 2

    def test_explain_says_a_thing_once(self, tmp_path: Path) -> None:
        said = haros("explain", "cppcheck:uninitvar", cwd=tmp_path).stdout
        assert said.count("Uninitialized variable.") == 1 and "haros: ignore[uninitvar]" in said
        assert "`# shellcheck disable=SC2086`" in haros("explain", "shellcheck:SC2086", cwd=tmp_path).stdout

    def test_explain_of_a_metric_names_its_rules(self, tmp_path: Path) -> None:
        done = haros("explain", "nested_control", cwd=tmp_path)
        assert done.returncode == 2 and "max-control-nesting-4, max-control-nesting-5" in done.stderr

    def test_explain_suggests(self, tmp_path: Path) -> None:
        done = haros("explain", "unused-imprt", cwd=tmp_path)
        assert done.returncode == 2
        assert "did you mean unused-import" in done.stderr

    def test_rules(self, tmp_path: Path) -> None:
        rows = json.loads(haros("rules", "--json", cwd=tmp_path).stdout)
        enabled = {row["id"] for row in rows if row["enabled"]}
        assert {"pylint:undefined-variable", "cppcheck:nullPointer", "haros-ci:malformed-manifest"} <= enabled
        assert {"pylint:import-error", "cpplint:whitespace/braces"} & enabled == set()
        numbers = {row["id"]: row["catalogue"] for row in rows}
        assert numbers["haros-ci:topic-type-mismatch"] == "G06"
        assert numbers["cppcheck:nullPointer"] is None
        assert all(row["catalogue"] in (None, *row["aliases"]) for row in rows)

    def test_cache(self, lift: Path) -> None:
        place = lift.parent / "cache"
        haros("check", "--cache-dir", str(place), cwd=lift)
        assert haros("cache", "dir", "--cache-dir", str(place), cwd=lift).stdout.strip() == str(place)
        assert list(place.glob("*.json"))
        assert haros("cache", "clear", "--cache-dir", str(place), cwd=lift).returncode == 0
        assert not list(place.glob("*.json"))

    @pytest.mark.parametrize(
        "arguments", [["--help"], ["check", "--help"], ["baseline", "create", "--help"], ["--version"]]
    )
    def test_help(self, tmp_path: Path, arguments: list[str]) -> None:
        assert haros(*arguments, cwd=tmp_path).returncode == 0


def test_a_malformed_manifest_is_a_finding_and_the_rest_goes_on(lift: Path) -> None:
    write(lift, {"package.xml": "<package><name>lift</name>"})
    done = haros("check", "--output", "json", cwd=lift)
    assert rules_of(done.stdout) == ["pylint:dangerous-default-value", "haros-ci:malformed-manifest"]
    assert done.returncode == 1
