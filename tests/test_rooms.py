# SPDX-License-Identifier: Apache-2.0
"""The rooms' one-way doors (docs/start-to-finish.md), held against every import in the package."""

from __future__ import annotations

import ast
import re
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parent.parent
PACKAGE = ROOT / "haros_ci"

DOORS: dict[str, set[str]] = {
    "errors": set(),
    "interruption": set(),
    "scratch": {"errors", "interruption"},
    "streams": set(),
    "trouble": {"report", "streams", "writing"},
    "writing": {"errors", "interruption"},
    "model": set(),
    # programs as front ends write them: typed nodes and their codec
    "syntax": set(),
    # the digest of our own modules in keys
    "own_sources": set(),
    "results": {"model"},
    "config": {"errors", "model", "results"},
    "kept_runs": {"model", "own_sources", "results", "workspace"},
    "workspace": {"errors", "model", "results", "scratch"},
    "linters": {"errors", "interruption", "model", "results", "scratch"},
    "extract": {"errors", "model", "syntax"},
    # what was one room: each opens the ones before it alone (docs/architecture.md)
    "substitutions": {"model"},
    "values": {"model", "syntax"},
    "index": {"model", "substitutions", "syntax"},
    "graph": {"model", "substitutions", "values"},
    "launch": {"graph", "model", "substitutions"},
    "follow": {"graph", "index", "model", "syntax", "values"},
    "keeping": {"follow", "graph", "index", "model", "syntax", "values"},
    "systems": {"follow", "graph", "index", "keeping", "launch", "model", "substitutions", "syntax", "values"},
    "declared": {"graph", "model"},
    "interfaces": {"model", "workspace"},
    "changes": {"interfaces", "model", "syntax"},
    "query": {"model", "results"},
    "report": {"errors", "model", "results", "scratch"},
    "checking": {"changes", "code", "errors", "interfaces", "knowledge", "model", "results", "syntax"},
    "haros_plugins": {"errors", "linters", "plugins", "query", "results", "scratch", "writing"},
    "hosting": {"config", "haros_plugins", "inspection", "measures", "model", "query", "results"},
    "plugins": {"checking", "errors", "linters", "model", "results"},
    "registry": {"checking", "config", "errors", "haros_plugins", "linters", "model", "plugins", "results"},
    # checks see a system; api.testing makes one of the examples of their pages
    "api": {
        "architecture",
        "changes",
        "checking",
        "code",
        "config",
        "inspection",
        "interfaces",
        "knowledge",
        "linters",
        "model",
        "report",
        "results",
        "security",
        "syntax",
        "systems",
        "workspace",
    },
    # the call graph stands on the index of the programs; it knows no system and no check
    "code": {"index", "model", "syntax"},
    "knowledge": set(),
    "baselines": {"config", "errors", "model", "results", "workspace"},
    "brought": {"config", "model", "results", "workspace"},
    "launch_faults": {"architecture", "extract", "knowledge", "launch", "model"},
    "unmodelled": {"model", "report"},
    "inspection": {
        "architecture",
        "checking",
        "code",
        "comparison",
        "config",
        "kept_runs",
        "launch_faults",
        "model",
        "query",
        "registry",
        "results",
        "robot",
        "systems",
        "unmodelled",
        "workspace",
    },
    "robot": {"launch", "model", "workspace"},
    # a run on several machines: the room knows files of shards, sharding.py what goes into them
    "shards": {"model", "results"},
    "sharding": {
        "baselines",
        "config",
        "inspection",
        "linters",
        "linting",
        "model",
        "pipeline",
        "registry",
        "results",
        "shards",
        "workspace",
    },
    "shard_command": {
        "baselines",
        "commands",
        "errors",
        "output",
        "report",
        "sharding",
        "shards",
        "workspace",
        "writing",
    },
    "merge_command": {
        "cli",
        "commands",
        "errors",
        "model",
        "output",
        "report",
        "results",
        "sharding",
        "shards",
        "workspace",
        "writing",
    },
    "linting": {"config", "inspection", "linters", "model", "query", "registry", "results"},
    "pipeline": {
        "baselines",
        "brought",
        "config",
        "crossings",
        "errors",
        "hosting",
        "inspection",
        "linters",
        "linting",
        "model",
        "registry",
        "results",
        "workspace",
    },
    # what the syntax says of functions, and the index of the programs of classes
    "measuring": {"code", "extract", "index", "model", "syntax"},
    "measures": {
        "architecture",
        "code",
        "config",
        "forks",
        "linters",
        "measuring",
        "model",
        "own_sources",
        "results",
        "workspace",
    },
    "limits": {"linters", "report"},
    "metrics_command": {
        "cli",
        "commands",
        "config",
        "errors",
        "limits",
        "measures",
        "measuring",
        "model",
        "output",
        "report",
        "results",
        "workspace",
        "writing",
    },
    "crossings": {"linters", "measures", "model", "results"},
    "forks": {"interruption"},
    "wanted": {"errors", "model", "systems"},
    "architecture": {
        "config",
        "declared",
        "errors",
        "exactness",
        "extract",
        "forks",
        "index",
        "keeping",
        "launch",
        "model",
        "own_sources",
        "plugins",
        "syntax",
        "systems",
        "wanted",
        "workspace",
    },
    "exactness": {"config", "extract", "linters", "model", "scratch"},
    "model_command": {
        "architecture",
        "baselines",
        "commands",
        "config",
        "declared",
        "errors",
        "interface_files",
        "kept_runs",
        "model",
        "output",
        "readme_check",
        "report",
        "unmodelled",
        "wanted",
        "workspace",
        "writing",
    },
    "query_command": {
        "architecture",
        "baselines",
        "commands",
        "errors",
        "model_command",
        "query",
        "report",
        "wanted",
        "workspace",
    },
    "security": {"model"},
    "starting": {"model"},
    "init_command": {"config", "errors", "report", "starting", "workspace", "writing"},
    "policy_command": {
        "architecture",
        "commands",
        "errors",
        "model_command",
        "output",
        "report",
        "security",
        "wanted",
        "workspace",
        "writing",
    },
    "interface_files": {"errors", "model", "output", "report", "writing"},
    "readme_check": {"model", "report"},
    "comparison": {"changes", "extract", "launch", "model", "systems"},
    "diff_command": {
        "architecture",
        "changes",
        "commands",
        "comparison",
        "config",
        "errors",
        "model",
        "output",
        "report",
        "workspace",
        "writing",
    },
    "output": {"errors", "plugins", "report", "results", "writing"},
    "fixing": {"results", "workspace", "writing"},
    "commands": {
        "baselines",
        "cli",
        "config",
        "errors",
        "fixing",
        "folders",
        "model",
        "output",
        "pipeline",
        "plugins",
        "registry",
        "report",
        "results",
        "shard_command",
        "streams",
        "watch_command",
        "workspace",
        "writing",
    },
    "watch_command": {
        "cli",
        "commands",
        "config",
        "errors",
        "interruption",
        "output",
        "report",
        "results",
        "workspace",
    },
    # HAROS's data files, of all that a run knows
    "haros_json": {
        "config",
        "declared",
        "inspection",
        "linters",
        "linting",
        "measures",
        "model",
        "query",
        "report",
        "results",
        "workspace",
    },
    "folders": {"commands", "config", "errors", "haros_json", "inspection", "model", "output", "results", "writing"},
    "new_check": {"errors", "writing"},
    "baseline_command": {"baselines", "cli", "commands", "config", "errors", "output", "report", "results", "writing"},
    "rules_command": {"commands", "config", "errors", "limits", "registry", "report", "results"},
    "manual": set(),
    "flags": {"completion"},
    "completion": {"config", "measuring", "output", "registry"},
    "cli": {
        "baseline_command",
        "streams",
        "trouble",
        "commands",
        "completion",
        "diff_command",
        "errors",
        "flags",
        "init_command",
        "interruption",
        "manual",
        "merge_command",
        "metrics_command",
        "model_command",
        "new_check",
        "policy_command",
        "query_command",
        "report",
        "rules_command",
    },
    "__main__": {"cli"},
    "__init__": set(),
}
PURE_ROOMS = {"model", "results"}
EFFECTS = {"subprocess", "socket", "shutil", "tempfile", "multiprocessing"}


def room(path: Path) -> str:
    parts = path.relative_to(PACKAGE).with_suffix("").parts
    return parts[0]


def imports(tree: ast.AST) -> set[str]:
    names: set[str] = set()
    for node in ast.walk(tree):
        if isinstance(node, ast.Import):
            names.update(alias.name for alias in node.names)
        elif isinstance(node, ast.ImportFrom):
            assert node.level == 0, "imports are absolute"
            assert node.module is not None
            names.add(node.module)
            names.update(f"{node.module}.{alias.name}" for alias in node.names)
    return names


def door_breaks(here: str, names: set[str]) -> set[str]:
    """The rooms among *names* that *here* may not open; ``haros_ci`` itself (version, address) is open to all."""
    rooms = {name.split(".")[1] for name in names if name.startswith("haros_ci.")}
    return {there for there in rooms & DOORS.keys() if there != here and there not in DOORS[here]}


def modules() -> list[Path]:
    return sorted(PACKAGE.rglob("*.py"))


@pytest.mark.parametrize("path", modules(), ids=lambda p: p.relative_to(ROOT).as_posix())
def test_doors_are_one_way(path: Path) -> None:
    here = room(path)
    names = imports(ast.parse(path.read_text(encoding="utf-8")))
    assert here in DOORS, f"{here}: a new room needs its row in the table"
    assert not door_breaks(here, names)
    assert not (here in PURE_ROOMS and names & EFFECTS)


def test_the_table_can_fail() -> None:
    assert door_breaks("model", {"haros_ci.results.rule"}) == {"results"}
    assert door_breaks("report", {"haros_ci.linters.run"}) == {"linters"}
    assert door_breaks("results", {"haros_ci.model.location"}) == set()


@pytest.mark.parametrize("path", sorted((ROOT / "checks").glob("*.py")), ids=lambda p: p.name)
def test_checks_see_only_the_api(path: Path) -> None:
    ours = {n for n in imports(ast.parse(path.read_text(encoding="utf-8"))) if n.split(".")[0] == "haros_ci"}
    assert all(n == "haros_ci.api" or n.startswith("haros_ci.api.") for n in ours)


@pytest.mark.parametrize("path", modules(), ids=lambda p: p.relative_to(ROOT).as_posix())
def test_every_file_carries_its_licence(path: Path) -> None:
    assert path.read_text(encoding="utf-8").startswith("# SPDX-License-Identifier: Apache-2.0\n")


def test_every_package_is_installed() -> None:
    """A directory of modules that pyproject.toml does not name is there in a checkout, and missing after pip install."""
    text = (ROOT / "pyproject.toml").read_text(encoding="utf-8")
    named = set(re.findall(r'"(haros_ci[\w.]*)",\n', text[text.index("packages = [") : text.index("package-dir")]))
    found = {".".join(path.parent.relative_to(ROOT).parts) for path in (ROOT / "haros_ci").rglob("*.py")}
    assert named == found | {"haros_ci_checks"}
