# SPDX-License-Identifier: Apache-2.0
"""Project files and arguments set as a trap, each through a run of its own."""

from __future__ import annotations

import os
from collections.abc import Callable
from dataclasses import dataclass

import pytest
from hostile_kit import CONTROL_FINDING, Trap, assert_harmless, assert_the_rest_is_analysed

OWN = ".haros-ci.yaml"


@dataclass(frozen=True)
class Case:
    """What is set up, the run's arguments, its exit code, and words that stand on stderr or in a notification."""

    name: str
    build: Callable[[Trap], object]
    code: int
    says: str = ""
    arguments: tuple[str, ...] = ()


def settings(name: str, text: str | bytes, says: str = "", code: int = 2, file: str = OWN) -> Case:
    """A project file; wrong ones are the user's mistake, with file and line."""
    return Case(
        name,
        lambda t: t.write(file, text.replace("TOUCH", t.touch("yaml")) if isinstance(text, str) else text),
        code,
        says,
    )


BOMB = "".join(f"a{n}: &a{n} [{', '.join([f'*a{n - 1}'] * 9)}]\n" for n in range(1, 10))
PROJECT_FILES = [
    settings("alias bomb", f"a0: &a0 [x, x]\n{BOMB}", f"{OWN}:6: more than 100000 values"),
    settings("many aliases", "select: &a [x]\nignore: [" + "*a, " * 2_000 + "]\n", f"{OWN}:2: more than 1000 aliases"),
    settings("a cycle", "select: &a [*a]\n", f"{OWN}:1: 'a' contains itself"),
    settings("merge bomb", "a: &a {<<: *a}\n", f"{OWN}:1: 'a' contains itself"),
    settings("os.system", "select: !!python/object/apply:os.system ['TOUCH']\n", f"{OWN}:1: tag "),
    settings("an object", "profile: !!python/name:os.system\n", f"{OWN}:1: tag "),
    settings("a module", "x: !!python/module:evil\n", f"{OWN}:1: tag "),
    settings("deep lists", "select: " + "[" * 5_000 + "]" * 5_000, f"{OWN}:1: nested deeper than 50 levels"),
    settings("deep maps", "".join(" " * n + "a:\n" for n in range(300)), f"{OWN}:50: nested deeper than 50 levels"),
    settings("tabs", "select:\n\t- x\n", f"{OWN}:2: not valid YAML"),
    settings("a control character", b"select: [\x1b]\n", f"{OWN}:1: not valid YAML: it holds a control character"),
    settings("unended text", 'profile: "ros\n::error::x\n', "not valid YAML"),
    settings("binary", b"\xff\xfe\x00", f"{OWN}:1: not UTF-8 text"),
    settings("two documents", "profile: ros\n---\nprofile: all\n", f"{OWN}:2: a second document begins here"),
    settings("a list", "- x\n", f"{OWN}:1: a project file must be a map"),
    settings("5 MB", "# \n" * 1_700_000, "larger than 1000000 bytes"),
    settings("an unknown key", "profile: ros\ninit-hook: TOUCH\n", f"{OWN}:2: unknown key 'init-hook'"),
    settings("a hostile key", "'::error::\\x1b[31m##[error]': 1\n", f"{OWN}:1: unknown key"),
    settings("a hostile key, escaped", '"\\e[31m\\n::error::\\u202e##[error]": 1\n', f"{OWN}:1: unknown key"),
    settings("a key twice", "profile: ros\nprofile: all\n", f"{OWN}:2: key 'profile' stands here again"),
    settings("a wrong profile", "profile: rso\n", f"{OWN}:1: 'profile' cannot be 'rso'"),
    settings("a wrong type", "select: 3\n", f"{OWN}:1: 'select' must be a list, not a number"),
    settings(
        "infinite time",
        "linters: {pylint: {timeout: .inf}}\n",
        f"{OWN}:1: 'timeout' of linter 'pylint' is too large a number of seconds",
    ),
    settings("a long number", f"max-file-size: {'9' * 500}\n", f"{OWN}:1: number too long"),
    settings("a number of base 60", f"max-file-size: 1{':59' * 50}\n", f"{OWN}:1: number too long"),
    settings("a date that is none", "profile: 2024-99-99\n", f"{OWN}:1: 'profile' cannot be"),
    settings("a baseline outside", "baseline: ../../etc/passwd\n", f"{OWN}:1: 'baseline' must lie in the workspace"),
    settings("a baseline at home", "baseline: ~/x\n", f"{OWN}:1: 'baseline' must lie in the workspace"),
    settings(
        "a database outside", "compile-database: /etc\n", f"{OWN}:1: 'compile-database' must lie in the workspace"
    ),
    settings("an empty glob", "exclude: ['']\n", f"{OWN}:1: "),
    settings(
        "too many selectors", "select: [" + ", ".join(f"x{n}" for n in range(900)) + "]\n", "more than 500 selectors"
    ),
    settings("a glob that backtracks", f"exclude: ['{'**/' * 30}x{'*a' * 30}b']\n", "", 1),
    settings("a selector that backtracks", f"select: ['{'*a' * 100}b']\n", f"{OWN}:1: no rule matches"),
    settings(
        "arguments for pylint", "linters: {pylint: {arguments: ['--init-hook=TOUCH']}}\n", "only with --trust-config", 1
    ),
    settings("plug-ins", "plugins: [evil_plugin]\n", "plugins are loaded only with --trust-config", 1),
    settings("nothing", "", "", 1),
    settings("nothing but a BOM", b"\xef\xbb\xbf", "", 1),
    settings(
        "HAROS: os.system", "project: !!python/object/apply:os.system ['TOUCH']\n", "haros.yaml:1: tag", 2, "haros.yaml"
    ),
    settings("HAROS: hostile keys", '"\\e[31m\\n::error::##[error]<img>@team|": 1\n', "has no effect", 1, "haros.yaml"),
    settings("HAROS: a list", "[]\n", "haros.yaml:1: a project file must be a map", 2, "haros.yaml"),
    Case(
        "a link that leads out",
        lambda t: (t.root / OWN).symlink_to(t.outside / "victim.json"),
        2,
        "a symbolic link out of the workspace",
    ),
    Case("a link that leads nowhere", lambda t: (t.root / OWN).symlink_to("nowhere"), 1),
    Case("a link to itself", lambda t: (t.root / OWN).symlink_to(OWN), 1),
    Case("a directory", lambda t: (t.root / OWN).mkdir(), 1),
    Case("a pipe", lambda t: os.mkfifo(t.root / OWN), 1),
    Case("a device", lambda t: (t.root / OWN).symlink_to("/dev/zero"), 1),
    Case("a huge file", lambda t: t.sparse(OWN, 200_000_000), 2, "larger than 1000000 bytes"),
    Case("none for --isolated", lambda t: t.write(OWN, "\t"), 1, "", ("--isolated",)),
    Case("a directory as --project", lambda t: None, 2, "is a directory", ("--project=.",)),
    Case("a pipe as --project", lambda t: os.mkfifo(t.root / "p"), 2, "no such project file", ("--project=p",)),
]

ARGUMENTS = [
    Case(
        "a link that leads out",
        lambda t: (t.root / "out.py").symlink_to(t.outside / "secret.py"),
        2,
        "out of the workspace",
        ("out.py",),
    ),
    Case(
        "a link that leads out, and another file",
        lambda t: (t.root / "out.py").symlink_to(t.outside / "secret.py"),
        2,
        "out.py: a symbolic link out of the workspace",
        (CONTROL_FINDING[0], "out.py"),
    ),
    Case(
        "a file behind a link that leads out",
        lambda t: (t.root / "out").symlink_to(t.outside),
        2,
        "out/secret.py: a symbolic link out of the workspace",
        (CONTROL_FINDING[0], "out/secret.py"),
    ),
    Case(
        "a directory that leads out of the work tree",
        lambda t: [t.commit(), (t.root / "src").symlink_to(t.outside)],
        2,
        "src: a symbolic link out of the workspace",
        ("src",),
    ),
    Case("nothing there", lambda t: None, 2, "no such file or directory", ("gone.py",)),
    Case("nothing there, hostile", lambda t: None, 2, "no such file or directory", ("\x1b[31m\n::error::##[error]x",)),
    Case("an option", lambda t: t.write("--init-hook=x.py", ""), 2, "", ("--init-hook=x.py",)),
    Case(
        "an option behind --",
        lambda t: t.write("--init-hook=x.py", ""),
        1,
        "",
        ("--", "--init-hook=x.py", CONTROL_FINDING[0]),
    ),
    Case("a pipe", lambda t: os.mkfifo(t.root / "pipe.py"), 1, "", ("pipe.py", CONTROL_FINDING[0])),
    Case("the same twice", lambda t: None, 1, "", (CONTROL_FINDING[0], ".", f"./{CONTROL_FINDING[0]}")),
    Case(
        "a hostile name",
        lambda t: t.write("::error::a\x1b[31m.py", ""),
        1,
        "unprintable",
        ("::error::a\x1b[31m.py", CONTROL_FINDING[0]),
    ),
    Case("a hostile selector", lambda t: None, 1, "", ("--select=\x1b[31m::error::x##[error]",)),
    Case(
        "a hostile profile", lambda t: None, 2, "--profile: unknown value", ("--profile=\x1b[31m\n::error::x##[error]",)
    ),
    Case("a hostile format", lambda t: None, 2, "unknown format", ("--output=\x1b[31m\n::error::x##[error]",)),
]


def assert_case(case: Case, trap: Trap) -> None:
    case.build(trap)
    victim = (trap.outside / "victim.json").read_bytes()
    outcome = trap.run(*case.arguments)
    assert outcome.code == case.code, (outcome.stderr, outcome.notes() if outcome.code != 2 else "")
    assert case.says in outcome.stderr or outcome.says(case.says), outcome.stderr
    assert_harmless(trap, outcome)
    assert (trap.outside / "victim.json").read_bytes() == victim
    if case.code == 2:
        assert outcome.stderr.startswith(("error: ", "Usage: ")) and set(outcome.formats.values()) <= {""}
    else:
        assert_the_rest_is_analysed(outcome)
        assert {path for path, _, _ in outcome.findings()} == {CONTROL_FINDING[0]}


@pytest.mark.parametrize("case", PROJECT_FILES, ids=lambda case: case.name)
def test_project_files(case: Case, trap: Trap) -> None:
    assert_case(case, trap)


@pytest.mark.parametrize("case", ARGUMENTS, ids=lambda case: case.name)
def test_arguments(case: Case, trap: Trap) -> None:
    assert_case(case, trap)


def test_what_cannot_be_read(trap: Trap) -> None:
    trap.write("locked.py", "X = undefined_here\n").chmod(0)
    trap.write("locked/inside.py", "X = undefined_here\n")
    (trap.root / "locked").chmod(0)
    try:
        outcome = trap.run(driver=trap.unprivileged())
    finally:
        (trap.root / "locked").chmod(0o700)
    assert outcome.code == 1 and outcome.says("it cannot be read")
    assert_harmless(trap, outcome)
    assert_the_rest_is_analysed(outcome)
