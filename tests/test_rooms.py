# SPDX-License-Identifier: Apache-2.0
"""The rooms' one-way doors (docs/start-to-finish.md), held against every import in the package."""

from __future__ import annotations

import ast
import re
from collections import Counter
from pathlib import Path

from every import every

ROOT = Path(__file__).resolve().parent.parent
PACKAGE = ROOT / "haros_ci"

DOORS: dict[str, set[str]] = {
    "__init__": set(),
    "model": set(),
    "errors": set(),
    "records": set(),
    "regex": set(),
    "timing": set(),
    "bounded_python": set(),
    "bounded_yaml": set(),
    "results": {"bounded_python", "model"},
    "interruption": set(),
    "scratch": {"errors", "interruption"},
    "workspace": {"errors", "model", "results", "scratch", "timing"},
    "interfaces": {"model", "workspace"},
    # HPL: its texts, and what follows of them; what is in the workspace is given to it
    "behaviour": {"bounded_yaml", "interfaces", "model"},
    # properties against messages; where those come from it does not know
    "monitoring": {"behaviour"},
    # runs as formulas; the monitor is the judge of what is found
    "verification": {"behaviour", "errors", "interfaces", "interruption", "monitoring"},
    # properties as files that run beside a system
    "monitor_files": {"behaviour", "monitoring"},
    # tests as files, and the modules that they stand on; what is tested is given to it
    "test_files": {"behaviour", "interfaces", "monitor_files", "monitoring"},
    # programs as front ends write them: typed nodes and their codec
    "syntax": set(),
    "changes": {"interfaces", "model", "syntax"},
    # what was one room: each opens the ones before it alone (docs/architecture.md)
    "substitutions": {"bounded_python", "bounded_yaml", "model"},
    "index": {"model", "substitutions", "syntax"},
    # the call graph stands on the index of the programs; it knows no system and no check
    "code": {"index", "model", "syntax"},
    # how often code publishes, and what follows for topics
    "rates": {"code", "model", "syntax"},
    # which inputs of a node can cause which outputs; what runs code, and what sends, it knows from the rates
    "dependence": {"code", "index", "model", "rates", "syntax"},
    # call sites as text, and what the call graph says of them
    "coverage": {"code", "index", "model", "results", "syntax"},
    "knowledge": set(),
    "checking": {
        "behaviour",
        "bounded_yaml",
        "changes",
        "code",
        "interfaces",
        "knowledge",
        "model",
        "results",
        "syntax",
        "timing",
    },
    "config": {"bounded_yaml", "errors", "model", "results"},
    "values": {"model", "syntax"},
    "graph": {"model", "substitutions", "values"},
    "declared": {"graph", "model"},
    "extract": {"bounded_yaml", "model", "syntax"},
    "forks": {"interruption"},
    "follow": {"graph", "index", "model", "syntax", "values"},
    "keeping": {"follow", "graph", "index", "model", "syntax", "values"},
    "launch": {"bounded_python", "bounded_yaml", "graph", "model", "substitutions", "timing"},
    "linters": {"bounded_yaml", "interruption", "knowledge", "model", "own_sources", "results", "scratch", "timing"},
    # the digest of our own modules in keys
    "own_sources": set(),
    "plugins": {"checking", "errors", "linters", "model", "results"},
    "query": {"model", "results"},
    "writing": {"errors", "interruption"},
    "haros_plugins": {"bounded_yaml", "errors", "linters", "plugins", "query", "results", "scratch", "writing"},
    "registry": {"checking", "config", "errors", "haros_plugins", "linters", "plugins", "results", "timing"},
    "report": {"model", "results", "scratch"},
    "robot": {"bounded_python", "bounded_yaml", "launch", "model", "workspace"},
    "systems": {
        "follow",
        "graph",
        "index",
        "keeping",
        "launch",
        "model",
        "robot",
        "substitutions",
        "syntax",
        "timing",
        "values",
    },
    "analysis": {
        "behaviour",
        "changes",
        "checking",
        "code",
        "config",
        "coverage",
        "declared",
        "dependence",
        "errors",
        "extract",
        "forks",
        "index",
        "keeping",
        "knowledge",
        "launch",
        "linters",
        "model",
        "monitoring",
        "own_sources",
        "plugins",
        "query",
        "rates",
        "registry",
        "report",
        "results",
        "robot",
        "scratch",
        "syntax",
        "systems",
        "test_files",
        "timing",
        "verification",
        "workspace",
    },
    "baselines": {"config", "errors", "model", "results", "timing", "workspace"},
    "linting": {"analysis", "config", "linters", "model", "query", "registry", "results"},
    # what the syntax says of functions, and the index of the programs of classes
    "measuring": {
        "analysis",
        "code",
        "config",
        "extract",
        "forks",
        "index",
        "linters",
        "model",
        "own_sources",
        "results",
        "syntax",
        "timing",
        "workspace",
    },
    # HAROS's data files, of all that a run knows
    "haros_json": {
        "analysis",
        "config",
        "declared",
        "linters",
        "linting",
        "measuring",
        "model",
        "query",
        "report",
        "results",
        "workspace",
    },
    # one HTML file of all that a run knows
    "html_page": {
        "analysis",
        "behaviour",
        "checking",
        "config",
        "errors",
        "forks",
        "measuring",
        "model",
        "report",
        "results",
        "timing",
        "workspace",
    },
    "brought": {"config", "model", "results", "workspace"},
    "commented": {"analysis", "config", "linters", "linting", "model", "results"},
    "refuted": {"config", "model", "results", "workspace"},
    "hosting": {"analysis", "config", "haros_plugins", "measuring", "model", "query", "results", "timing"},
    "pipeline": {
        "analysis",
        "baselines",
        "brought",
        "commented",
        "refuted",
        "config",
        "hosting",
        "linters",
        "linting",
        "measuring",
        "model",
        "registry",
        "results",
        "timing",
        "workspace",
    },
    "security": {"model"},
    # a run on several machines: the room knows files of shards, shards/sharding.py what goes into them
    "shards": {
        "analysis",
        "baselines",
        "config",
        "linters",
        "linting",
        "model",
        "pipeline",
        "registry",
        "results",
        "workspace",
    },
    # bags and lines of JSON as messages with times
    "recordings": {"bounded_yaml", "errors", "model", "scratch"},
    "starting": {"model"},
    "streams": set(),
    "stack_room": set(),
    "commands": {
        "analysis",
        "baselines",
        "behaviour",
        "bounded_yaml",
        "changes",
        "config",
        "declared",
        "errors",
        "haros_json",
        "html_page",
        "interruption",
        "linters",
        "measuring",
        "model",
        "monitor_files",
        "monitoring",
        "pipeline",
        "plugins",
        "query",
        "recordings",
        "registry",
        "report",
        "results",
        "scratch",
        "security",
        "shards",
        "starting",
        "streams",
        "test_files",
        "timing",
        "verification",
        "workspace",
        "writing",
    },
    "internal_errors": {"report", "streams", "writing"},
    "cli": {"commands", "errors", "interruption", "report", "stack_room", "streams", "internal_errors"},
    "__main__": {"cli"},
    # checks see a system; api.testing makes one of the examples of their pages
    "api": {
        "analysis",
        "behaviour",
        "changes",
        "checking",
        "code",
        "config",
        "dependence",
        "interfaces",
        "knowledge",
        "linters",
        "model",
        "rates",
        "report",
        "results",
        "security",
        "syntax",
        "systems",
        "workspace",
    },
}
#: What modules are made with: regular expressions and data classes. ``haros_ci`` itself has the version and the address.
TOOLS = ("records", "regex")
PURE_ROOMS = {"model", "results"}
EFFECTS = {"subprocess", "socket", "shutil", "tempfile", "multiprocessing"}
#: A module that has more is of several nouns. There are no exceptions: whatever would be one is split.
MOST_LINES = 350


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
    """The rooms among *names* that *here* may not open; what all modules are made with is open to all."""
    rooms = {name.split(".")[1] for name in names if name.startswith("haros_ci.")}
    return {there for there in rooms & DOORS.keys() if there not in (here, *TOOLS) and there not in DOORS[here]}


def modules() -> list[Path]:
    return sorted(PACKAGE.rglob("*.py"))


@every("path", modules(), ids=lambda path: path.relative_to(ROOT).as_posix())
def test_doors_are_one_way(path: Path) -> None:
    here = room(path)
    names = imports(ast.parse(path.read_text(encoding="utf-8")))
    assert here in DOORS, f"{here}: a new room needs its row in the table"
    assert not door_breaks(here, names)
    assert not (here in PURE_ROOMS and names & EFFECTS)


def test_the_page_for_newcomers_has_every_room() -> None:
    page = (ROOT / "docs/architecture.md").read_text(encoding="utf-8")
    cells = re.findall(r"^\| (`[^|]*) \|", page, re.MULTILINE)
    named = [name for cell in cells for name in re.findall(r"`(\w+)`", cell)]
    assert sorted(named) == sorted(DOORS.keys() - {"__init__", "__main__"})


def test_no_two_rooms_open_each_other() -> None:
    below: dict[str, set[str]] = {}
    rest = dict(DOORS)
    while rest:
        free = [room for room, doors in rest.items() if doors <= below.keys()]
        assert free, f"rooms in a circle: {sorted(rest)}"
        below.update((room, rest.pop(room)) for room in free)


def test_the_table_can_fail() -> None:
    assert door_breaks("model", {"haros_ci.results.rule"}) == {"results"}
    assert door_breaks("report", {"haros_ci.linters.run"}) == {"linters"}
    assert door_breaks("results", {"haros_ci.model.location"}) == set()


@every("path", sorted((ROOT / "checks").glob("*.py")), ids=lambda path: path.name)
def test_checks_see_only_the_api(path: Path) -> None:
    ours = {n for n in imports(ast.parse(path.read_text(encoding="utf-8"))) if n.split(".")[0] == "haros_ci"}
    assert all(n == "haros_ci.api" or n.startswith("haros_ci.api.") for n in ours)


@every("path", modules(), ids=lambda path: path.relative_to(ROOT).as_posix())
def test_every_file_carries_its_licence(path: Path) -> None:
    assert path.read_text(encoding="utf-8").startswith("# SPDX-License-Identifier: Apache-2.0\n")


def test_every_package_is_installed() -> None:
    """A directory of modules that pyproject.toml does not name is there in a checkout, and missing after pip install."""
    text = (ROOT / "pyproject.toml").read_text(encoding="utf-8")
    named = set(re.findall(r'"(haros_ci[\w.]*)",\n', text[text.index("packages = [") : text.index("package-dir")]))
    found = {".".join(path.parent.relative_to(ROOT).parts) for path in (ROOT / "haros_ci").rglob("*.py")}
    assert named == found | {"haros_ci_checks"}


def test_no_two_test_modules_have_one_name() -> None:
    """pytest imports them by their names alone, and collects the first of two (its "import file mismatch")."""
    names = Counter(path.name for path in (ROOT / "tests").rglob("test_*.py"))
    assert [name for name, count in names.items() if count > 1] == []


def test_no_module_is_long() -> None:
    every = (*modules(), *(ROOT / "checks").glob("*.py"))
    lines = {path: path.read_text(encoding="utf-8").count("\n") for path in every}
    exceptions = {path.relative_to(ROOT).as_posix(): count for path, count in lines.items() if count > MOST_LINES}
    assert exceptions == {}
