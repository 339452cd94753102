# SPDX-License-Identifier: Apache-2.0
"""The action's steps, run as the runner runs them, on a git history with a pull request."""

from __future__ import annotations

import html
import json
import os
import re
import shutil
import subprocess
import sys
from dataclasses import dataclass
from importlib.util import find_spec
from pathlib import Path
from typing import Any

import forked
import installing
import pytest
import yaml
from commandline import cache_home
from mutations import LAUNCH_XML, LISTENER_CPP, ROS2, TALKER_CPP, system

from haros_ci.cli import check as check_command

ROOT = Path(__file__).resolve().parent.parent
ACTION: dict[str, Any] = yaml.safe_load((ROOT / "action.yml").read_text(encoding="utf-8"))
WORKFLOW: dict[str, Any] = yaml.safe_load((ROOT / "docs/workflows/haros-ci.yml").read_text(encoding="utf-8"))

#: Inputs that are no option of the command: arguments, where the log goes, and the action's own set-up.
ACTION_ONLY = {
    "paths",
    "merge",
    "args",
    "linters",
    "tool-versions",
    "working-directory",
    "plugins",
    "plugin-packages",
    "sarif-file",
    "report",
    "reports",
    "annotations",
    "python",
    "install",
    "version",
    "cache",
}
#: Steps that run a script of ours, and those that restore or keep a directory.
SCRIPTS = [step for step in ACTION["runs"]["steps"] if "run" in step]
KEEPERS = [step for step in ACTION["runs"]["steps"] if "uses" in step]
#: Options that no input gives: they belong to a project file, to a person at a terminal, or would weaken the action.
TERMINAL_ONLY = {
    "exclude", "import", "isolated", "no-baseline", "no-cache", "output", "show-settings", "statistics", "timings",
    "trust-config", "why", "quiet", "verbose", "fix", "diff", "watch", "plugin", "plugin-whitelist", "plugin-blacklist", "plugin-export", "stdin-filename",
}  # fmt: skip

MANIFEST = """<package format="3">
  <name>arm</name>
  <version>0.1.0</version>
  <description>An arm.</description>
  <maintainer email="arm@example.org">Arm</maintainer>
  <license>Apache-2.0</license>
</package>
"""
KNOWN = '''"""Joints of the arm."""


def limit(angle):
    """Keep within range."""
    return min(angle, REACH)
'''
ADDED = KNOWN + '\n\ndef home():\n    """Where the arm rests."""\n    return [resting] * 6\n'
CLEAN = KNOWN + '\n\ndef home():\n    """Where the arm rests."""\n    return [0.0] * 6\n'


# -- a history and a runner ---------------------------------------------------------------------------------------


def git(directory: Path, *arguments: str) -> str:
    done = subprocess.run(["git", *arguments], cwd=directory, env=clean_environment(), capture_output=True, check=True)
    return done.stdout.decode().strip()


def clean_environment() -> dict[str, str]:
    """This process's environment without what a CI job, git or the user's git configuration would add."""
    kept = {
        k: v for k, v in os.environ.items() if not k.startswith(("GITHUB_", "RUNNER_", "INPUT_", "HAROS_CI_", "GIT_"))
    }
    who = {
        f"GIT_{role}_{what}": f"{what.lower()}@example.org"
        for role in ("AUTHOR", "COMMITTER")
        for what in ("NAME", "EMAIL")
    }
    return {**kept, **who, "GIT_CONFIG_GLOBAL": os.devnull, "GIT_CONFIG_SYSTEM": os.devnull}


def commit(repository: Path, files: dict[str, str], message: str = "change") -> str:
    for name, text in files.items():
        (repository / name).parent.mkdir(parents=True, exist_ok=True)
        (repository / name).write_text(text, encoding="utf-8")
    git(repository, "add", "--all")
    git(repository, "commit", "--quiet", "--allow-empty", "--message", message)
    return git(repository, "rev-parse", "HEAD")


@dataclass(frozen=True)
class PullRequest:
    """A served repository and the merge commit that a runner checks out, as GitHub makes it."""

    origin: Path
    base: str
    merge: str


def pull_request(
    directory: Path,
    changes: dict[str, str],
    *,
    base: str = "main",
    before: dict[str, str] | None = None,
    later: int = 0,
) -> PullRequest:
    """A pull request with *changes*; *later* commits reach the base after GitHub made the merge commit."""
    author, origin = directory / "author", directory / "origin.git"
    author.mkdir(parents=True)
    git(author, "init", "--quiet", f"--initial-branch={base}")
    commit(author, {"package.xml": MANIFEST, "arm/joints.py": KNOWN, **(before or {})}, "start")
    git(author, "checkout", "--quiet", "-b", "feature")
    commit(author, changes, "feature")
    git(author, "checkout", "--quiet", base)
    commit(author, {"README.md": "The arm.\n"}, "elsewhere")
    git(author, "checkout", "--quiet", "--detach")
    git(author, "merge", "--quiet", "--no-ff", "--message", "merge", "feature")
    merge = git(author, "rev-parse", "HEAD")
    git(author, "update-ref", "refs/pull/1/merge", merge)
    git(author, "checkout", "--quiet", base)
    for number in range(later):
        commit(author, {}, f"later {number}")
    git(directory, "clone", "--quiet", "--mirror", str(author), str(origin))
    return PullRequest(origin, base, merge)


def checkout(request: PullRequest, workspace: Path, *, depth: int | None = 1) -> None:
    """What actions/checkout does for a pull request."""
    workspace.mkdir(parents=True)
    git(workspace, "init", "--quiet")
    git(workspace, "remote", "add", "origin", request.origin.as_uri())
    how = [f"--depth={depth}"] if depth else []
    refs = [f"+{request.merge}:refs/remotes/pull/1/merge"]
    refs += [] if depth else ["+refs/heads/*:refs/remotes/origin/*"]
    git(workspace, "fetch", "--quiet", "--no-tags", *how, "origin", *refs)
    git(workspace, "checkout", "--quiet", "--force", "refs/remotes/pull/1/merge")


@dataclass(frozen=True)
class Job:
    """What a run of the action left."""

    code: int
    log: str
    outputs: dict[str, str]
    summary: str
    temp: Path

    @property
    def commands(self) -> list[str]:
        """The workflow commands that the runner obeys: at a line's start, outside a stop-commands block."""
        obeyed, token = [], None
        for line in self.log.splitlines():
            found = re.match(r"\s*::([^ :]+)(.*)", line)
            if token is not None:
                token = None if found and found[1] == token else token
            elif found and found[1] == "stop-commands":
                token = found[2].removeprefix("::")
            elif found or "##[" in line:
                obeyed.append(line)
        return obeyed


def run_action(
    workspace: Path, inputs: dict[str, str], *, base: str = "", group: str | None = None, action: Path = ROOT
) -> Job:
    """Run every step until one fails; ``install: false`` with this test's interpreter unless *inputs* say otherwise.

    *base* is the target branch of a pull request, *group* the event of a merge queue as JSON. What is kept between runs lies in ``kept``
    beside the workspace.
    """
    temp = workspace.parent / "runner-temp"
    temp.mkdir(exist_ok=True)
    (temp / "event.json").write_text(group or "{}")
    output, page = temp / "output", temp / "summary"
    page.write_text("")
    outputs: dict[str, dict[str, str]] = {}
    defaults = {name: given["default"] for name, given in ACTION["inputs"].items()}
    shared = {"cache-dir": f"{cache_home()}/action"}
    values = {**defaults, "python": forked.python(), "install": "false", **shared, **inputs}
    assert values.keys() == defaults.keys()
    code, log = 0, ""
    for number, step in enumerate(ACTION["runs"]["steps"]):
        if not runs(step, outputs, code):
            continue
        if "uses" in step:
            outputs[step.get("id", "")] = keep(step, outputs, temp, workspace.parent / "kept")
            continue
        output.write_text("")
        script = temp / f"step-{number}.sh"
        script.write_text(step["run"])
        done = subprocess.run(
            ["bash", "--noprofile", "--norc", "-eo", "pipefail", str(script)],
            cwd=workspace,
            env={
                **clean_environment(),
                "CI": "true",
                "GITHUB_ACTIONS": "true",
                "GITHUB_ACTION_PATH": str(action),
                "GITHUB_WORKSPACE": str(workspace),
                "GITHUB_OUTPUT": str(output),
                "GITHUB_STEP_SUMMARY": str(page),
                "GITHUB_EVENT_NAME": "pull_request" if base else "push" if group is None else "merge_group",
                "GITHUB_EVENT_PATH": str(temp / "event.json"),
                "GITHUB_BASE_REF": base,
                "RUNNER_TEMP": str(temp),
                **{name: evaluate(text, values) for name, text in step.get("env", {}).items()},
            },
            stdin=subprocess.DEVNULL,
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
        )
        code, log = code or done.returncode, log + done.stdout.decode()
        outputs[step.get("id", "")] = dict(line.split("=", 1) for line in output.read_text().splitlines())
    return Job(code, log, outputs.get("check", {}), page.read_text(), temp)


def evaluate(text: str, inputs: dict[str, str]) -> str:
    return re.sub(r"\$\{\{ inputs\.([a-z-]+) \}\}", lambda found: inputs[found[1]], text)


def output_of(outputs: dict[str, dict[str, str]], name: str) -> str:
    _, step, _, output = name.split(".")
    return outputs.get(step, {}).get(output, "")


def runs(step: dict[str, Any], outputs: dict[str, dict[str, str]], code: int) -> bool:
    """Whether a step runs: comparisons of outputs, joined by ``&&``, and no failure before it unless it starts with ``always()``."""
    terms = step.get("if", "success()").split(" && ")
    if terms[0] != "always()" and code:
        return False
    for term in terms:
        if term not in ("always()", "success()"):
            name, operator, text = term.split(" ")
            if (output_of(outputs, name) == text.strip("'")) is not (operator == "=="):
                return False
    return True


def keep(step: dict[str, Any], outputs: dict[str, dict[str, str]], temp: Path, store: Path) -> dict[str, str]:
    """What actions/cache/restore and actions/cache/save do: a key is written once, and the newest entry of a prefix is restored."""
    known = {"github.sha": "0123abc", "runner.temp": str(temp)}

    def filled(text: str) -> str:
        return re.sub(
            r"\$\{\{ ([a-z.-]+) \}\}", lambda found: known.get(found[1]) or output_of(outputs, found[1]), text
        )

    place, key = Path(filled(step["with"]["path"])), filled(step["with"]["key"])
    assert place.parent == temp and re.fullmatch(r"[\w.-]{1,512}", key)
    store.mkdir(exist_ok=True)
    if "/save@" in step["uses"]:
        if place.is_dir() and not (store / key).exists():
            shutil.copytree(place, store / key, symlinks=True)
        return {}
    prefixes = [prefix for prefix in [filled(step["with"].get("restore-keys", ""))] if prefix]
    entries = sorted(store.iterdir(), key=lambda entry: entry.stat().st_mtime, reverse=True)
    found = [e for e in entries if e.name == key] + [
        e for e in entries for prefix in prefixes if e.name.startswith(prefix)
    ]
    if not found:
        return {}
    shutil.copytree(found[0], place, symlinks=True, dirs_exist_ok=True)
    return {"cache-hit": "true" if found[0].name == key else "false"}


def sarif(job: Job) -> dict[str, Any]:
    log: dict[str, Any] = json.loads(Path(job.outputs["sarif"]).read_text(encoding="utf-8"))
    return log


def states(job: Job) -> list[str]:
    return sorted(result["baselineState"] for run in sarif(job)["runs"] for result in run["results"])


# -- the file -----------------------------------------------------------------------------------------------------


def test_no_expression_reaches_a_shell() -> None:
    for step in SCRIPTS:
        assert step["shell"] == "bash"
        assert "${{" not in step["run"]


def test_actions_of_others_are_pinned_and_keep_directories_of_ours() -> None:
    for step in KEEPERS:
        assert re.fullmatch(r"actions/cache/(?:restore|save)@[0-9a-f]{40}", step["uses"])
        assert re.fullmatch(r"\$\{\{ runner\.temp \}\}/haros-ci-(?:environment|cache)", step["with"]["path"])


def test_every_input_is_described_and_used() -> None:
    used = set(re.findall(r"\$\{\{ inputs\.([a-z-]+) \}\}", (ROOT / "action.yml").read_text(encoding="utf-8")))
    assert used == ACTION["inputs"].keys()
    for name, given in ACTION["inputs"].items():
        assert given["description"].strip(), name
        assert isinstance(given["default"], str), f"{name}: the runner knows only strings"


def test_inputs_and_options_are_equal() -> None:
    options = {flag for parameter in check_command.params for flag in parameter.opts if flag.startswith("--")}
    known = {flag.removeprefix("--") for flag in options}
    inputs = ACTION["inputs"].keys() - ACTION_ONLY
    assert inputs | TERMINAL_ONLY == known
    assert not inputs & TERMINAL_ONLY


def test_the_scripts_read_what_the_steps_give() -> None:
    for step in SCRIPTS:
        [name] = re.findall(r"action/[a-z]+\.sh", step["run"])
        read = set(re.findall(r"\bINPUT_[A-Z_]+", (ROOT / name).read_text(encoding="utf-8")))
        assert read == step["env"].keys()


def test_the_documented_workflow_fits() -> None:
    [step] = [s for s in WORKFLOW["jobs"]["check"]["steps"] if s.get("id") == "haros-ci"]
    assert step["with"].keys() <= ACTION["inputs"].keys()
    text = (ROOT / "docs/workflows/haros-ci.yml").read_text(encoding="utf-8")
    assert set(re.findall(r"steps\.haros-ci\.outputs\.([a-z-]+)", text)) <= ACTION["outputs"].keys()
    assert WORKFLOW["permissions"] == {"contents": "read"}
    assert "pull_request_target" not in text


def test_the_workflow_that_keeps_the_page_fits() -> None:
    text = (ROOT / "docs/workflows/haros-ci-report.yml").read_text(encoding="utf-8")
    made = yaml.safe_load(text)
    [step] = [one for one in made["jobs"]["report"]["steps"] if one.get("id") == "haros-ci"]
    assert step["with"].keys() <= ACTION["inputs"].keys() and step["with"]["report"] is True
    assert set(re.findall(r"steps\.haros-ci\.outputs\.([a-z-]+)", text)) <= ACTION["outputs"].keys()
    assert made["permissions"] == {"contents": "read"} and "pull_request_target" not in text
    assert all("${{" not in one.get("run", "") for job in made["jobs"].values() for one in job["steps"])


# -- a pull request -----------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("depth", "later"),
    [(None, 0), (1, 0), (1, 3), (1, 60)],
    ids=["whole history", "one commit", "base moved on", "base moved far on"],
)
def test_only_the_new_finding_is_annotated(tmp_path: Path, depth: int | None, later: int) -> None:
    request = pull_request(tmp_path, {"arm/joints.py": ADDED}, later=later)
    checkout(request, tmp_path / "workspace", depth=depth)
    job = run_action(tmp_path / "workspace", {"cache-dir": ""}, base="main")
    assert job.code == 1, job.log
    assert (job.temp / "haros-ci-cache").is_dir()
    assert job.outputs == {"exit-code": "1", "new-count": "1", "sarif": str(job.temp / "haros-ci.sarif")}
    [annotation] = [c for c in job.commands if c.startswith(("::error ", "::warning "))]
    assert "file=arm/joints.py" in annotation
    assert "resting" in annotation
    assert states(job) == ["new", "unchanged"]
    assert "resting" in job.summary
    assert "REACH" not in job.summary


def test_of_the_system_only_what_is_new_is_annotated(tmp_path: Path) -> None:
    """The base has two nodes that disagree on a topic. The change renames it, and makes them disagree on another one."""
    spin = "  rclcpp::spin"
    after = system(
        (TALKER_CPP, '"goal"', '"target"'), (LAUNCH_XML, 'to="goal"', 'to="target"'),
        (TALKER_CPP, spin, '  auto b = node->create_publisher<std_msgs::msg::String>("count", 1);\n' + spin),
        (LISTENER_CPP, spin, '  auto b = node->create_subscription<std_msgs::msg::Int32>("count", 1, &take);\n' + spin),
    )  # fmt: skip
    at_root = [{path.removeprefix("walker/"): text for path, text in files.items()} for files in (ROS2, after)]
    request = pull_request(tmp_path, at_root[1], before=at_root[0])
    checkout(request, tmp_path / "workspace")
    job = run_action(tmp_path / "workspace", {"profile": "architecture"}, base="main")
    assert job.code == 1, job.log
    [annotation] = [c for c in job.commands if c.startswith(("::error ", "::warning "))]
    assert "file=src/second.cpp" in annotation and "/count" in annotation and "%0Asrc/first.cpp:" in annotation
    assert states(job) == ["new", "updated"]
    findings, _, change = job.summary.partition("```mermaid")[0].rpartition("## ")
    assert "/count" in findings and "/target" not in findings
    assert "/target" in change, "what the change does is told besides"
    assert all("graphs" not in run for run in sarif(job)["runs"])


def entries(tmp_path: Path, what: str) -> list[str]:
    return sorted(entry.name for entry in tmp_path.glob(f"kept/haros-ci-{what}-*"))


def test_results_are_kept_between_runs_also_where_there_are_new_findings(tmp_path: Path) -> None:
    request = pull_request(tmp_path, {"arm/joints.py": ADDED})
    checkout(request, tmp_path / "workspace")

    def misses() -> int:
        job = run_action(tmp_path / "workspace", {"cache-dir": "", "args": "--timings"}, base="main")
        assert job.code == 1, job.log
        shutil.rmtree(job.temp)
        return int(re.findall(r"cache: [0-9]+ hits, ([0-9]+) misses", job.log)[0])

    first = misses()
    [entry] = entries(tmp_path, "results")
    assert entry.endswith("-0123abc")
    assert misses() < first


@pytest.mark.parametrize(
    "inputs",
    [
        pytest.param({"cache": "false", "cache-dir": ""}, id="not wanted"),
        pytest.param({}, id="the workflow names the directory"),
        pytest.param({"cache-dir": "", "profile": "no such"}, id="wrong input"),
    ],
)
def test_stays_without_kept_results(tmp_path: Path, inputs: dict[str, str]) -> None:
    request = pull_request(tmp_path, {"arm/joints.py": ADDED})
    checkout(request, tmp_path / "workspace")
    assert run_action(tmp_path / "workspace", inputs, base="main").code in (1, 2)
    assert entries(tmp_path, "results") == []


def test_parts_of_the_work_keep_results_of_their_own(tmp_path: Path) -> None:
    request = pull_request(tmp_path, {"arm/joints.py": ADDED})
    checkout(request, tmp_path / "workspace")
    for shard in ("1/2", "2/2"):
        assert run_action(tmp_path / "workspace", {"cache-dir": "", "shard": shard}, base="main").code == 0
    first, second = entries(tmp_path, "results")
    assert "-1-2-" in first and "-2-2-" in second


def test_a_clean_pull_request_passes(tmp_path: Path) -> None:
    request = pull_request(tmp_path, {"arm/joints.py": CLEAN})
    checkout(request, tmp_path / "workspace")
    job = run_action(tmp_path / "workspace", {}, base="main")
    assert (job.code, job.outputs["new-count"]) == (0, "0"), job.log
    assert job.commands == []
    assert states(job) == ["unchanged"]


def test_a_push_has_no_baseline_and_shows_all(tmp_path: Path) -> None:
    request = pull_request(tmp_path, {"arm/joints.py": ADDED})
    checkout(request, tmp_path / "workspace")
    job = run_action(tmp_path / "workspace", {"fail-on": "never", "sarif-file": "out/log.sarif"})
    assert (job.code, job.outputs["new-count"], job.outputs["sarif"]) == (0, "2", "out/log.sarif"), job.log
    assert (tmp_path / "workspace/out/log.sarif").is_file()


def test_a_workspace_below_the_checkout(tmp_path: Path) -> None:
    """Annotations name files from the root of the repository, as GitHub wants them; outputs from where the next step starts."""
    below = {"ws/package.xml": MANIFEST, "ws/arm/joints.py": KNOWN, "other/joints.py": KNOWN}
    request = pull_request(tmp_path, {"ws/arm/joints.py": ADDED, "other/joints.py": ADDED}, before=below)
    checkout(request, tmp_path / "workspace")
    inputs = {"working-directory": "ws", "sarif-file": "log.sarif", "args": "--statistics\n--exclude=none\n"}
    job = run_action(tmp_path / "workspace", inputs, base="main")
    assert (job.code, job.outputs["new-count"], job.outputs["sarif"]) == (1, "1", "ws/log.sarif"), job.log
    [annotation] = [c for c in job.commands if c.startswith(("::error ", "::warning "))]
    assert "file=ws/arm/joints.py" in annotation
    assert (tmp_path / "workspace/ws/log.sarif").is_file()


@pytest.mark.parametrize(
    ("inputs", "says"),
    [
        ({"working-directory": "nowhere"}, "The input 'working-directory' is no directory."),
        ({"working-directory": ".\n."}, "The input 'working-directory' is no directory."),
        ({"args": "arm/joints.py"}, "A line of the input 'args' is no option; paths are for the input 'paths'."),
        ({"exact": "yes"}, "The input 'exact' is neither true nor false."),
    ],
)
def test_inputs_that_cannot_be_meant(tmp_path: Path, inputs: dict[str, str], says: str) -> None:
    request = pull_request(tmp_path, {"arm/joints.py": CLEAN})
    checkout(request, tmp_path / "workspace")
    job = run_action(tmp_path / "workspace", inputs)
    assert job.code == 2 and job.commands == [f"::error title=haros-ci::{says}"]


def test_without_annotations_the_log_is_plain(tmp_path: Path) -> None:
    request = pull_request(tmp_path, {"arm/joints.py": ADDED})
    checkout(request, tmp_path / "workspace")
    job = run_action(tmp_path / "workspace", {"annotations": "false"}, base="main")
    assert (job.code, job.commands, job.summary) == (1, [], "")
    assert "resting" in job.log


def test_a_pull_request_cannot_silence_itself(tmp_path: Path) -> None:
    hush = {"arm/joints.py": ADDED, ".haros-ci.yaml": "ignore: [undefined-variable]\nfail-on: never\n"}
    request = pull_request(tmp_path, hush)
    checkout(request, tmp_path / "workspace")
    job = run_action(tmp_path / "workspace", {}, base="main")
    assert (job.code, job.outputs["new-count"]) == (1, "1"), job.log


def test_a_pull_request_cannot_bring_its_own_baseline(tmp_path: Path) -> None:
    known, all_of_it = (recorded(tmp_path / name, text) for name, text in (("before", KNOWN), ("after", ADDED)))
    request = pull_request(tmp_path, {"arm/joints.py": ADDED, "known.jsonl": all_of_it}, before={"known.jsonl": known})
    checkout(request, tmp_path / "workspace")
    job = run_action(tmp_path / "workspace", {"baseline": "known.jsonl"}, base="main")
    assert (job.code, job.outputs["new-count"]) == (1, "1"), job.log


def recorded(directory: Path, text: str) -> str:
    """The baseline file of a workspace with that one module."""
    (directory / "arm").mkdir(parents=True)
    (directory / "arm/joints.py").write_text(text)
    command = [forked.python(), "-I", "-m", "haros_ci", "baseline", "create", "--no-cache", "--file", "known.jsonl"]
    subprocess.run(command, cwd=directory, env=clean_environment(), check=True, capture_output=True)
    return (directory / "known.jsonl").read_text(encoding="utf-8")


@pytest.mark.parametrize(("require", "code"), [("", 3), ("false", 1), ("true", 3)])
def test_a_baseline_that_cannot_be_fetched_is_said_loudly(tmp_path: Path, require: str, code: int) -> None:
    """And what the pull request says of itself does not count."""
    hush = {".haros-ci.yaml": "ignore: [undefined-variable]\nfail-on: never\n"}
    request = pull_request(tmp_path, {"arm/joints.py": ADDED, **hush})
    checkout(request, tmp_path / "workspace")
    git(tmp_path / "workspace", "remote", "set-url", "origin", (tmp_path / "gone.git").as_uri())
    job = run_action(tmp_path / "workspace", {"require-baseline": require}, base="main")
    assert (job.code, job.outputs["exit-code"]) == (code, str(code)), job.log
    assert any("fetch-depth: 0" in command for command in job.commands)
    assert "no baseline" in job.log.lower()
    if require == "false":
        assert job.outputs["new-count"] == "2"
        assert "The defaults and the command line are used" in html.unescape(job.summary)
    else:
        assert len(job.commands) == 1 and job.commands[0].startswith("::error"), (
            "one clear error, and no finding is called new"
        )
        assert "new-count" not in job.outputs and "sarif" not in job.outputs


def merge_group(workspace: Path, base: str) -> str:
    """What GitHub says of a merge group that is put on *base*."""
    sha = git(workspace, "rev-parse", base).strip()
    return json.dumps({"action": "checks_requested", "merge_group": {"base_sha": sha, "base_ref": "refs/heads/main"}})


@pytest.mark.parametrize("depth", [1, 0])
def test_a_merge_group_is_compared_with_its_base(tmp_path: Path, depth: int) -> None:
    request = pull_request(tmp_path, {"arm/joints.py": ADDED})
    workspace = tmp_path / "workspace"
    checkout(request, workspace, depth=depth)
    job = run_action(workspace, {}, group=merge_group(request.origin, "main"))
    assert (job.code, job.outputs["new-count"]) == (1, "1"), job.log
    assert "updated" in states(job) or "unchanged" in states(job)


@pytest.mark.parametrize(
    "event", ["{}", "[1]", "no JSON", '{"merge_group": {"base_sha": "--upload-pack=x"}}', '{"merge_group": 1}']
)
def test_a_merge_group_without_a_base_is_one_error(tmp_path: Path, event: str) -> None:
    request = pull_request(tmp_path, {"arm/joints.py": ADDED})
    checkout(request, tmp_path / "workspace")
    job = run_action(tmp_path / "workspace", {}, group=event)
    assert job.code == 3 and [c[:7] for c in job.commands] == ["::error"], job.log
    job = run_action(tmp_path / "workspace", {"require-baseline": "false"}, group=event)
    assert (job.code, job.outputs["new-count"]) == (1, "2"), job.log


@pytest.mark.parametrize(
    ("inputs", "base", "code"),
    [
        ({"baseline-rev": "nowhere"}, "", 3),
        ({"baseline-rev": "nowhere", "require-baseline": "false"}, "", 0),
        ({"baseline-rev": "HEAD"}, "", 0),
        ({}, "main", 0),
        ({}, "", 0),
        ({"require-baseline": "true"}, "", 3),
        ({"require-baseline": "yes"}, "", 2),
    ],
)
def test_when_a_base_is_required(tmp_path: Path, inputs: dict[str, str], base: str, code: int) -> None:
    request = pull_request(tmp_path, {"arm/joints.py": CLEAN})
    checkout(request, tmp_path / "workspace")
    job = run_action(tmp_path / "workspace", {"fail-on": "never", **inputs}, base=base)
    assert (job.code, job.outputs["exit-code"]) == (code, str(code)), job.log


def test_paths_are_lines_and_arguments_are_not_split(tmp_path: Path) -> None:
    faulty = '"""Fault."""\n\n\ndef go():\n    """Go."""\n    return speed\n'
    request = pull_request(tmp_path, {"a b/one.py": faulty, "--jobs/two.py": faulty, "three.py": faulty})
    checkout(request, tmp_path / "workspace")
    job = run_action(tmp_path / "workspace", {"paths": "\r\n  a b \n\n--jobs\n"}, base="main")
    assert (job.code, job.outputs["new-count"]) == (1, "2"), job.log


def test_further_reports_are_lines(tmp_path: Path) -> None:
    request = pull_request(tmp_path, {"a b/one.py": "x = 1\n"})
    checkout(request, tmp_path / "workspace")
    job = run_action(tmp_path / "workspace", {"reports": " junit=out/a b.xml \r\n\ncsv=out/x.csv\n"}, base="main")
    assert job.code in (0, 1), job.log
    assert (tmp_path / "workspace/out/a b.xml").read_text().startswith("<?xml")
    assert (tmp_path / "workspace/out/x.csv").read_text().startswith("level,")


def test_the_page_to_look_at(tmp_path: Path) -> None:
    request = pull_request(tmp_path, {"arm/arm/two.py": "x = 1\n"})
    checkout(request, tmp_path / "workspace")
    job = run_action(tmp_path / "workspace", {"report": "true"}, base="main")
    assert job.code in (0, 1), job.log
    page = Path(job.outputs["report"])
    assert page.parent == job.temp and page.read_text(encoding="utf-8").startswith("<!DOCTYPE html>")
    without = run_action(tmp_path / "workspace", {}, base="main")
    assert "report" not in without.outputs and not page.exists()


# -- hostile names ------------------------------------------------------------------------------------------------


def test_a_hostile_branch_name_is_a_name(tmp_path: Path) -> None:
    base = "rel$(touch${IFS}pwned)`touch${IFS}pwned`;touch${IFS}pwned&&--x"
    request = pull_request(tmp_path, {"arm/joints.py": ADDED}, base=base)
    checkout(request, tmp_path / "workspace")
    job = run_action(tmp_path / "workspace", {}, base=base)
    assert (job.code, job.outputs["new-count"]) == (1, "1"), job.log
    assert not list(tmp_path.rglob("pwned"))


@pytest.mark.parametrize(
    "name",
    [
        "$(touch pwned).py",
        "a\n::error file=x,line=1::pwned\n.py",
        "::set-output name=sarif::pwned.py",
        "##[set-output name=sarif]pwned.py",
        "--output=json=pwned",
        "a\r::stop-commands::x.py",
    ],
)
def test_a_hostile_file_name_is_a_name(tmp_path: Path, name: str) -> None:
    body = "#!/usr/bin/env python3\ndef go():\n    return speed  # ##[set-output name=sarif]x\n"
    request = pull_request(tmp_path, {name: body})
    checkout(request, tmp_path / "workspace")
    job = run_action(tmp_path / "workspace", {}, base="main")
    assert job.outputs.keys() == {"exit-code", "new-count", "sarif"}
    assert job.outputs["sarif"] == str(job.temp / "haros-ci.sarif")
    assert all(command.startswith(("::error ", "::warning ", "::notice ")) for command in job.commands), job.commands
    assert not any(command.startswith("::error file=x") for command in job.commands)
    assert not list(tmp_path.rglob("pwned"))


def test_modules_of_the_workspace_are_not_imported(tmp_path: Path) -> None:
    planted = "open('pwned', 'w').close()\n"
    names = ("json.py", "venv.py", "pip.py", "secrets.py", "haros_ci.py", "sitecustomize.py", "click.py")
    request = pull_request(tmp_path, {"arm/joints.py": ADDED, **dict.fromkeys(names, planted)})
    checkout(request, tmp_path / "workspace")
    job = run_action(tmp_path / "workspace", {"python": sys.executable}, base="main")
    assert job.code == 1, job.log
    assert not list(tmp_path.rglob("pwned"))


def test_a_planted_repository_is_not_asked(tmp_path: Path) -> None:
    """A bare repository among the pull request's files would bring its own configuration, which runs commands."""
    bare = {
        "arm/HEAD": "ref: refs/heads/main\n",
        "arm/objects/keep": "",
        "arm/refs/keep": "",
        "arm/config": '[core]\n\tbare = true\n\tfsmonitor = "touch pwned"\n\tsshCommand = "touch pwned;"\n'
        '[remote "origin"]\n\turl = ssh://example.invalid/x\n\tuploadpack = touch pwned;\n',
    }
    request = pull_request(tmp_path, {"arm/joints.py": ADDED, **bare})
    checkout(request, tmp_path / "workspace")
    job = run_action(tmp_path / "workspace", {"paths": "arm"}, base="main")
    assert (job.code, job.outputs["new-count"]) == (1, "1"), job.log
    assert not list(tmp_path.rglob("pwned"))


# -- wrong inputs -------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    "inputs",
    [
        {"annotations": "yes"},
        {"require-baseline": "1"},
        {"install": ""},
        {"install": "true", "linters": "yes"},
        {"install": "true", "tool-versions": "latest"},
        {"install": "true", "version": "main; touch pwned"},
        {"install": "true", "version": "0.1.0 --pre"},
        {"cache": "yes"},
        {"profile": "rso"},
        {"fail-on": "always"},
        {"project": "missing.yaml"},
        {"sarif-file": "a\nnew-count=0"},
        {"reports": "junit"},
        {"reports": "junit="},
        {"reports": "jnuit=report.xml"},
        {"jobs": "-1; touch pwned"},
        {"select": "--help"},
        {"plugins": "no_such_plugin_of_ours"},
        {"plugin-packages": "our-rules"},  # not installed with install: false
    ],
    ids=lambda inputs: next(iter(inputs)),
)
def test_wrong_inputs_are_said(tmp_path: Path, inputs: dict[str, str]) -> None:
    commit_less = tmp_path / "workspace"
    commit_less.mkdir()
    (commit_less / "joints.py").write_text(KNOWN)
    job = run_action(commit_less, inputs)
    assert job.code == 2, job.log
    assert any(command.startswith("::error ") for command in job.commands)
    assert "sarif" not in job.outputs
    assert "new-count" not in job.outputs
    assert not list(tmp_path.rglob("pwned"))


@pytest.mark.parametrize(
    "line",
    [
        "./rules",
        "../rules",
        "rules/x",
        "/rules",
        "-r rules.txt",
        "--pre",
        "x @ file:///rules",
        "x; y",
        "$(touch pwned)",
    ],
)
def test_packages_of_plugins_have_no_paths(tmp_path: Path, line: str) -> None:
    workspace = tmp_path / "workspace"
    workspace.mkdir()
    job = run_action(workspace, {"install": "true", "plugin-packages": f"our-rules==1.0\n{line}\n"})
    assert job.code == 2 and "no requirement by name" in job.log
    assert not (tmp_path / "runner" / "haros-ci-environment").exists() and not list(tmp_path.rglob("pwned"))


@pytest.mark.parametrize(
    "line",
    ["rules", "rules[a,b]", "rules==1.2", "rules >=1, <2", "rules @ git+https://example.org/rules@v1", "rules~=1.0"],
)
def test_packages_of_plugins_have_names(line: str) -> None:
    script = (ROOT / "action/install.sh").read_text(encoding="utf-8")
    [pattern] = re.findall(r"^requirement='.*'$", script, re.M)
    done = subprocess.run(["bash", "-c", f'{pattern}; [[ "$1" =~ $requirement ]]', "bash", line])
    assert done.returncode == 0


#: In the place of Python: says what it was called with, and makes an environment that does the same.
RECORDER = """#!/bin/sh
printf '%s\\n' "$*" >> "$RECORD"
case "$*" in *" -m venv "*) for last; do :; done; mkdir -p "$last/bin"; cp "$0" "$last/bin/python";; esac
"""


@pytest.mark.parametrize("versions", ["pinned", "newest"])
@pytest.mark.parametrize(
    ("linters", "exact", "release", "what"),
    [
        ("true", "false", "", "/action[linters]"),
        ("false", "true", "", "/action[exact]"),
        ("true", "true", "", "/action[linters,exact]"),
        ("false", "false", "", "/action"),
        ("false", "false", "0.1.0", "haros-ci==0.1.0"),
        ("true", "true", "1.2.0rc1", "haros-ci[linters,exact]==1.2.0rc1"),
    ],
)
def test_what_is_installed(tmp_path: Path, linters: str, exact: str, release: str, what: str, versions: str) -> None:
    python = tmp_path / "python"
    python.write_text(RECORDER)
    python.chmod(0o755)
    environment = {
        "PATH": os.environ["PATH"],
        "RECORD": str(tmp_path / "record"),
        "RUNNER_TEMP": str(tmp_path),
        "GITHUB_ACTION_PATH": "/action",
        "INPUT_PYTHON": str(python),
        "INPUT_INSTALL": "true",
        "INPUT_LINTERS": linters,
        "INPUT_EXACT": exact,
        "INPUT_TOOL_VERSIONS": versions,
        "INPUT_VERSION": release,
        "INPUT_PLUGIN_PACKAGES": "",
    }
    subprocess.run(["bash", str(ROOT / "action" / "install.sh")], env=environment, check=True)
    [installed] = [line for line in (tmp_path / "record").read_text().splitlines() if " pip install " in line]
    assert installed.split()[-1] == what
    assert ("--constraint /action/action/constraints.txt" in installed) == (versions == "pinned")


def test_an_old_log_is_not_passed_on(tmp_path: Path) -> None:
    workspace = tmp_path / "workspace"
    workspace.mkdir()
    (workspace / "joints.py").write_text(CLEAN)
    assert "sarif" in run_action(workspace, {}).outputs
    assert run_action(workspace, {"profile": "rso"}).outputs == {"exit-code": "2"}


# -- the real installation ----------------------------------------------------------------------------------------


#: Python, but that an environment has a link to the pip that is here, where unpacking and compiling another takes five seconds.
LINKING = """#!/bin/sh
case "$*" in
  *" -m venv "*)
    for last; do :; done
    '{python}' -I -m venv --clear --without-pip "$last" && ln -s '{pip}' "$last"/lib/python*/site-packages/;;
  *) exec '{python}' "$@";;
esac
"""
#: Python, but that nothing can be installed into the environments that it makes.
EMPTY = """#!/bin/sh
case "$*" in
  *" -m venv "*) for last; do :; done; rm -rf "$last"; mkdir -p "$last/bin"; ln -s "$(command -v false)" "$last/bin/python";;
  *) exec '{python}' "$@";;
esac
"""


def as_python(path: Path, text: str) -> str:
    path.write_text(text)
    path.chmod(0o755)
    return str(path)


def test_the_install_step(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    installing.needs_package_index()
    pip = find_spec("pip")
    linking = LINKING.format(python=sys.executable, pip=Path(pip.origin).parent) if pip and pip.origin else None
    python = as_python(tmp_path / "python", linking) if linking else sys.executable
    monkeypatch.setenv("PIP_COMPILE", "0")  # most of the modules are never imported
    action = installing.copy_of_the_checkout(tmp_path / "action")
    request = pull_request(tmp_path, {"arm/joints.py": ADDED})
    checkout(request, tmp_path / "workspace")
    for is_kept in ("true", "false"):  # the second use in a job finds the first one's environment
        inputs = {"install": "true", "cache": is_kept, "python": python}
        job = run_action(tmp_path / "workspace", inputs, base="main", action=action)
        assert (job.code, job.outputs["new-count"]) == (1, "1"), job.log
    assert (job.temp / "haros-ci-environment/bin/haros-ci").is_file()
    shutil.rmtree(job.temp)
    monkeypatch.setenv("PIP_NO_INDEX", "1")  # the next run restores it, and installs nothing
    restoring = {"install": "true", "python": python}
    job = run_action(tmp_path / "workspace", restoring, base="main", action=action)
    assert (job.code, job.outputs["new-count"]) == (1, "1"), job.log
    (action / "haros_ci/__init__.py").write_text("# changed\n")
    run_action(tmp_path / "workspace", {"install": "false"}, base="main", action=action)
    assert len(entries(tmp_path, "environment")) == 1
    as_python(tmp_path / "python", EMPTY.format(python=sys.executable))
    job = run_action(tmp_path / "workspace", {**restoring, "linters": "true"}, base="main", action=action)
    assert job.code == 2 and "could not be installed" in job.log, "another environment is another key"
