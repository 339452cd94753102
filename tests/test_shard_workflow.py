# SPDX-License-Identifier: Apache-2.0
"""The workflow of docs/shards.md, run step by step as its runners would: jobs have nothing in common but artefacts and caches."""

from __future__ import annotations

import json
import re
import shutil
import subprocess
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import pytest
import yaml
from test_action import ACTION, Job, clean_environment, commit, git, run_action

ROOT = Path(__file__).resolve().parent.parent
TEXT = (ROOT / "docs/workflows/haros-ci-sharded.yml").read_text(encoding="utf-8")
WORKFLOW: dict[str, Any] = yaml.safe_load(TEXT)
SHARDS: list[int] = WORKFLOW["jobs"]["shard"]["strategy"]["matrix"]["shard"]
PROJECT = "linters: {ruff: {enabled: false}, clang-tidy: {enabled: false}, catkin_lint: {enabled: false}}\n"


@dataclass
class Hosted:
    """What outlives a job: the repository, artefacts by name, caches by key, and the steps that were taken."""

    origin: Path
    place: Path
    taken: list[str] = field(default_factory=list)

    def job(self, name: str, *, shard: int = 0) -> Job | None:
        """Run a job on a machine of its own; what its step ``haros-ci`` left."""
        machine = self.place / f"{name}-{shard}-{len(self.taken)}"
        workspace, temp = machine / "workspace", machine / "runner-temp"
        workspace.mkdir(parents=True)
        temp.mkdir()
        left: Job | None = None
        known = {
            "runner.temp": str(temp),
            "runner.os": "Linux",
            "github.sha": "c0ffee",
            "github.event_name": "push",
            "matrix.shard": str(shard),
            "strategy.job-total": str(len(SHARDS)),
        }
        for step in WORKFLOW["jobs"][name]["steps"]:
            if not wanted(step.get("if", ""), left):
                continue
            outputs = {
                f"steps.haros-ci.outputs.{k}": left.outputs.get(k, "") if left else "" for k in ACTION["outputs"]
            }
            given = {key: value_of(str(value), known | outputs) for key, value in step.get("with", {}).items()}
            what = step.get("uses", "run").partition("@")[0]
            self.taken.append(what)
            match what:
                case "run":
                    environment = {**clean_environment(), "RUNNER_TEMP": str(temp)}
                    subprocess.run(
                        ["bash", "-eo", "pipefail", "-c", step["run"]], cwd=workspace, env=environment, check=True
                    )
                case "actions/checkout":
                    git(workspace, "clone", "--quiet", self.origin.as_uri(), ".")
                case "actions/cache" | "actions/cache/restore" | "actions/cache/save":
                    self.cache(what, given)
                case "actions/upload-artifact":
                    self.upload(given)
                case "actions/download-artifact":
                    self.download(given)
                case "haros-ci/haros-ci":
                    left = run_action(workspace, given)
                case "github/codeql-action/upload-sarif":
                    assert Path(given["sarif_file"]).is_file()
                case _:
                    pytest.fail(f"a step that this test does not know: {what}")
        return left

    def cache(self, what: str, given: dict[str, str]) -> None:
        store = self.place / "caches"
        if what == "actions/cache/save":
            shutil.copytree(given["path"], store / given["key"], dirs_exist_ok=True)
            return
        found = sorted(store.glob(f"{given['restore-keys'].strip()}*")) if store.exists() else []
        if found:
            shutil.copytree(found[-1], given["path"], dirs_exist_ok=True)

    def upload(self, given: dict[str, str]) -> None:
        source, target = Path(given["path"]), self.place / "artefacts" / given["name"]
        shutil.rmtree(target, ignore_errors=True)
        target.mkdir(parents=True)
        files = [source] if source.is_file() else [p for p in source.rglob("*") if p.is_file()]
        assert files or given.get("if-no-files-found") != "error"
        for path in files:
            shutil.copy(path, target / path.name)

    def download(self, given: dict[str, str]) -> None:
        artefacts = sorted((self.place / "artefacts").glob(given.get("name") or given["pattern"]))
        Path(given["path"]).mkdir(parents=True, exist_ok=True)
        assert "name" in given or given["merge-multiple"] in ("true", "True")
        for artefact in artefacts:
            shutil.copytree(artefact, given["path"], dirs_exist_ok=True)


def wanted(condition: str, left: Job | None) -> bool:
    """Whether a step of a push is taken, after a step ``haros-ci`` that has *left* something."""
    if "github.event_name == 'pull_request'" in condition:
        return False
    if "outputs.sarif != ''" in condition and (left is None or not left.outputs.get("sarif")):
        return False
    return left is None or not left.code or "always()" in condition


def value_of(text: str, known: dict[str, str]) -> str:
    """*text* with its expressions replaced; the only kind beside names is ``name == 'a' && 'b' || 'c'``."""

    def one(found: re.Match[str]) -> str:
        choice = re.fullmatch(r"([\w.-]+) == '([^']*)' && '([^']*)' \|\| '([^']*)'", found[1])
        return known[found[1]] if choice is None else choice[3] if known[choice[1]] == choice[2] else choice[4]

    return re.sub(r"\$\{\{ (.+?) \}\}", one, text)


@pytest.fixture(scope="module")
def hosted(tmp_path_factory: pytest.TempPathFactory) -> Hosted:
    """After the jobs ``costs`` and all of ``shard`` on a repository with an example in it."""
    place = tmp_path_factory.mktemp("hosted")
    origin = place / "origin"
    shutil.copytree(ROOT / "examples/legacy_ws", origin)
    git(origin, "init", "--quiet", "--initial-branch=main")
    commit(origin, {".haros-ci.yaml": PROJECT})
    it = Hosted(origin, place)
    it.job("costs")
    for shard in SHARDS:
        left = it.job("shard", shard=shard)
        assert left is not None
        assert left.code == 0, left.log
        assert left.outputs.keys() == {"exit-code", "shard-file"}
    return it


def test_the_jobs_report_what_one_job_would(hosted: Hosted, tmp_path: Path) -> None:
    merged = hosted.job("merge")
    assert merged is not None
    git(tmp_path, "clone", "--quiet", hosted.origin.as_uri(), "workspace")
    alone = run_action(tmp_path / "workspace", {"fail-on": "never"})
    assert alone.code == merged.code == 0, merged.log
    assert Path(merged.outputs["sarif"]).read_bytes() == Path(alone.outputs["sarif"]).read_bytes()
    assert merged.outputs["new-count"] == alone.outputs["new-count"] != "0"
    assert merged.summary == alone.summary
    assert merged.commands == alone.commands
    assert "github/codeql-action/upload-sarif" in hosted.taken
    [costs] = (hosted.place / "caches").glob("haros-ci-costs-*/costs.json")
    assert "cppcheck" in json.loads(costs.read_text())["costs"]


def test_what_the_merge_has_remembered_is_taken_up(hosted: Hosted) -> None:
    """Another round of all jobs, with the costs of the first: other shares, the same report."""
    first = hosted.job("merge")
    hosted.job("costs")
    assert (hosted.place / "artefacts/haros-ci-costs/costs.json").is_file()
    for shard in SHARDS:
        left = hosted.job("shard", shard=shard)
        assert left is not None
        assert left.code == 0
    second = hosted.job("merge")
    assert first is not None
    assert second is not None
    assert Path(first.outputs["sarif"]).read_bytes() == Path(second.outputs["sarif"]).read_bytes()


def test_a_shard_that_has_not_arrived_is_said(hosted: Hosted) -> None:
    gone = hosted.place / "artefacts" / f"haros-ci-shard-{SHARDS[1]}"
    kept = gone.rename(hosted.place / "kept")
    try:
        merged = hosted.job("merge")
    finally:
        kept.rename(gone)
    assert merged is not None
    assert merged.code == 3
    assert merged.outputs == {"exit-code": "3"}
    assert f"missing: shard {SHARDS[1]}/{len(SHARDS)}" in merged.log
    assert any("shards that make no whole" in command for command in merged.commands)


# -- the file -----------------------------------------------------------------------------------------------------


def test_the_workflow_fits_the_action() -> None:
    for job in WORKFLOW["jobs"].values():
        for step in job["steps"]:
            if step.get("id") == "haros-ci":
                assert step["with"].keys() <= ACTION["inputs"].keys()
            assert "${{" not in step.get("run", "")
    assert set(re.findall(r"steps\.haros-ci\.outputs\.([a-z-]+)", TEXT)) <= ACTION["outputs"].keys()
    assert WORKFLOW["permissions"] == {"contents": "read"}
    assert "pull_request_target" not in TEXT


def test_the_shards_are_all_there_and_the_merge_waits_for_them() -> None:
    assert SHARDS == [1, 2, 3, 4]
    assert WORKFLOW["jobs"]["shard"]["strategy"]["fail-fast"] is False
    assert WORKFLOW["jobs"]["merge"]["needs"] == "shard"
    assert "!cancelled()" in WORKFLOW["jobs"]["merge"]["if"]


# -- the action's inputs ------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    "inputs",
    [
        {"shard": "1/2", "merge": "shards"},
        {"shard": "1"},
        {"shard": "3/2"},
        {"shard": "1/2\nx"},
        {"shard": "../1/2"},
        {"shard": "$(touch pwned)/2"},
    ],
    ids=str,
)
def test_wrong_inputs_are_said(tmp_path: Path, inputs: dict[str, str]) -> None:
    (tmp_path / "workspace").mkdir()
    job = run_action(tmp_path / "workspace", inputs)
    assert job.code == 2, job.log
    assert job.outputs == {"exit-code": "2"}
    assert not list(tmp_path.rglob("pwned"))


def test_a_directory_without_shards_is_said(tmp_path: Path) -> None:
    (tmp_path / "workspace").mkdir()
    job = run_action(tmp_path / "workspace", {"merge": str(tmp_path / "--none")})
    assert job.code == 3, job.log
    assert "cannot be read" in job.log
