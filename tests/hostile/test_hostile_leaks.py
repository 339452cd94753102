# SPDX-License-Identifier: Apache-2.0
"""Nothing outside the workspace gets into a report: one canary for each way in, with the kernel's sandbox and without it."""

from __future__ import annotations

import os
import shutil
from collections.abc import Callable
from functools import cache
from pathlib import Path

import pytest
from hostile_kit import CONTROL_FINDING, Outcome, Trap
from leak_kit import ASKING, CPP, DATABASE, PY, TEXTS, Attack, Attacker

from haros_ci.linters.sandbox import protection

FAMILIES: dict[str, tuple[dict[str, Attack], tuple[str, ...]]] = {
    "cpp": (CPP, ("cppcheck", "cpplint", "clang-tidy", "clang-format", "flawfinder")),
    "python": (PY, ("pylint", "ruff", "mypy", "flake8", "bandit", "black", "isort", "vulture", "codespell")),
    "texts": (
        TEXTS,
        ("yamllint", "shellcheck", "hadolint", "xmllint", "cmakelint", "cmake-lint", "clang-format", "cpplint"),
    ),
}
#: Those that run where they are installed: named, they would be missed.
OPTIONAL = ("clang-tidy", "ruff", "xmllint")
WAYS = [(family, name) for family, (attacks, _) in FAMILIES.items() for name in attacks]


class Ground:
    """One run over all attacks of a family, and what it wrote anywhere."""

    def __init__(self, trap: Trap, family: str, sandbox: str) -> None:
        attacks, tools = FAMILIES[family]
        self.attackers = {name: Attacker(trap, name) for name in attacks}
        trap.git("init", "-q", "-b", "main")
        for name, attack in attacks.items():
            attack(self.attackers[name])
        tools = tuple(tool for tool in tools if tool not in OPTIONAL or shutil.which(tool))
        arguments = [f"--select={tool}" for tool in tools]
        if (trap.root / DATABASE).exists():
            arguments.append(f"--compile-database={DATABASE}")
        trap.cache = trap.place / "cache"
        environment = {"HAROS_CI_SANDBOX": sandbox, "HOME": "/"}
        self.outcome: Outcome = trap.run("--profile=all", "--timings", *arguments, environment=environment)
        self.written = {**self.outcome.formats, "stderr": self.outcome.stderr}
        for path in sorted(trap.cache.rglob("*")):
            if path.is_file():
                self.written[f"cache/{path.relative_to(trap.cache)}"] = path.read_bytes().decode("utf-8", "replace")


@pytest.fixture(scope="module")
def ground(tmp_path_factory: pytest.TempPathFactory) -> Callable[[str, str], Ground]:
    @cache
    def made(family: str, sandbox: str) -> Ground:
        place = tmp_path_factory.mktemp("leaks")
        return Ground(Trap(place, place / "cache"), family, sandbox)

    return made


@pytest.mark.parametrize("sandbox", ["", "off"], ids=["sandbox", "no sandbox"])
@pytest.mark.parametrize(("family", "name"), WAYS, ids=[name for _, name in WAYS])
def test_no_way_leads_out(family: str, name: str, sandbox: str, ground: Callable[[str, str], Ground]) -> None:
    done = ground(family, sandbox)
    canary = done.attackers[name].canary
    assert done.outcome.code in (1, 3), done.outcome.stderr
    shown = [place for place, text in done.written.items() if _shows(text, canary)]
    if name in ASKING:  # facts have both branches of each condition, and are made of a file's text alone
        shown = [place for place in shown if not place.startswith("cache/facts-cpp-")]
    assert shown == []


def _shows(text: str, canary: str) -> bool:
    """Whether the canary stands there; escapes of Markdown and JSON do not hide it. It may go on: absolute, absolute_x."""
    at = 0
    text = text.replace("\\_", "_").replace("&#95;", "_").replace("&lowbar;", "_")
    while (at := text.find(canary, at)) >= 0:
        at += len(canary)
        if not text[at : at + 1].isalnum() and text[at : at + 1] != "_":
            return True
    return False


@pytest.mark.parametrize("sandbox", ["", "off"], ids=["sandbox", "no sandbox"])
@pytest.mark.parametrize("family", FAMILIES)
def test_the_rest_is_analysed(family: str, sandbox: str, ground: Callable[[str, str], Ground]) -> None:
    done = ground(family, sandbox)
    assert done.outcome.code in (1, 3), done.outcome.stderr
    if family == "python":
        assert CONTROL_FINDING in done.outcome.findings()
    else:
        assert done.outcome.findings()


def test_the_canary_would_be_seen(tmp_path: Path) -> None:
    """The condition into which the attacks include is printed, if the header is one of the workspace."""
    trap = Trap(tmp_path, tmp_path / "cache")
    trap.write("inside.h", "CANARY_inside\n")
    trap.write("a.cpp", 'bool f(int e) { return e ==\n#include "inside.h"\n && e ==\n#include "inside.h"\n; }\n')
    outcome = trap.run("--profile=all", "--select=cppcheck")
    assert all(_shows(outcome.formats[name], "CANARY_inside") for name in ("text", "json", "sarif", "github"))


@pytest.mark.skipif(not protection().files, reason="this kernel has no Landlock, or it is switched off")
def test_the_summary_says_that_there_is_a_sandbox(trap: Trap) -> None:
    assert "Linters run in a sandbox: " in trap.run().formats["text"]


def test_the_summary_says_that_there_is_none(trap: Trap) -> None:
    outcome = trap.run(environment={"HAROS_CI_SANDBOX": "off"})
    for name in ("text", "markdown", "json"):
        assert "Linters run without a sandbox, as HAROS" in outcome.formats[name].replace("&#95;", "_"), name


def test_what_is_trusted_is_not_confined(trap: Trap) -> None:
    outcome = trap.run("--trust-config")
    assert "Linters run without a sandbox, as the workspace is trusted" in outcome.formats["text"]


def test_devices_and_pipes_are_never_opened(tmp_path: Path) -> None:
    """Not by a directive, not by a link, not where they lie: the run ends soon, and nothing is missing in it."""
    trap = Trap(tmp_path, tmp_path / "cache")
    os.mkfifo(trap.root / "pipe.h")
    (trap.root / "zero.h").symlink_to("/dev/zero")
    (trap.root / "linked.h").symlink_to("pipe.h")
    for number, target in enumerate(("pipe.h", "linked.h", "zero.h", "/dev/zero", "/dev/stdin", "/proc/kmsg")):
        trap.write(f"a{number}.cpp", f'#include "{target}"\nint f() {{ int unset{number}; return unset{number}; }}\n')
    trap.write("haros.yaml", "linters: {cppcheck: {timeout: 30}}\n")
    outcome = trap.run("--profile=all")
    assert outcome.code == 1, outcome.notes()
    assert {path for path, _, rule in outcome.findings() if rule == "uninitvar"} == {f"a{n}.cpp" for n in range(6)}
