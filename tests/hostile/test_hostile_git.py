# SPDX-License-Identifier: Apache-2.0
"""Repositories set as a trap, and pull requests that would like to judge themselves."""

from __future__ import annotations

import os
import shutil
from collections.abc import Callable
from dataclasses import dataclass

import pytest
from hostile_kit import CONTROL_FINDING, CONTROL_TEXT, Outcome, Trap, assert_harmless, assert_the_rest_is_analysed

#: Settings of a repository whose value git may run, or lets another program be run; ``{}`` is a shell command.
COMMANDS = """
    core.fsmonitor core.sshCommand core.pager core.editor core.askPass core.gitProxy core.alternateRefsCommand
    core.attributesFile core.excludesFile
    diff.external diff.evil.textconv diff.evil.command diff.guitool difftool.evil.cmd merge.evil.driver
    filter.evil.clean filter.evil.smudge filter.evil.process
    alias.ls-files alias.ls-tree alias.rev-parse alias.merge-base alias.cat-file alias.diff-index alias.hash-object
    credential.helper gpg.program gpg.ssh.program sequence.editor pager.ls-files pager.diff pager.cat-file
    uploadpack.packObjectsHook receive.procReceiveRefs web.browser man.evil.cmd log.showSignature trailer.x.command
    submodule.sub.update remote.origin.uploadpack remote.origin.vcs remote.origin.proxy hook.evil.command
""".split()
VALUES = {
    "core.hooksPath": "{root}/hooks",
    "core.worktree": "/etc",
    "core.fsync": "none",
    "filter.evil.required": "true",
    "remote.origin.url": "ext::sh -c {touch}",
    "remote.origin.promisor": "true",
    "remote.origin.partialclonefilter": "blob:none",
    "url.ext::sh -c {touch} .insteadOf": "https://",
    "include.path": "../evil.inc",
    "includeIf.gitdir:/.path": "../evil.inc",
    "extensions.worktreeConfig": "true",
    "protocol.ext.allow": "always",
    "protocol.allow": "always",
    "log.mailmap": "true",
    "hook.evil.event": "post-index-change",
}
HOOKS = "post-index-change pre-commit post-checkout fsmonitor-watchman reference-transaction post-rewrite pre-auto-gc".split()
HEAD_ONLY = b'"""New here."""\nX = undefined_in_head\n'
NEW = ("new.py", 2, "undefined-variable")


@pytest.fixture(scope="module")
def scene(new_trap: Callable[[], Trap]) -> tuple[Trap, dict[str, Outcome]]:
    """A good repository with every hostile setting at once, and a planted git on PATH; analysed alone and against HEAD."""
    trap = new_trap()
    trap.write("old.py", HEAD_ONLY.replace(b"head", b"base"))
    trap.commit()
    trap.write(".gitattributes", "* diff=evil filter=evil merge=evil text working-tree-encoding=UTF-16\n*.py ident\n")
    trap.write("moved.py", (trap.root / "old.py").read_bytes())
    (trap.root / "old.py").unlink()
    trap.write("bin/git", f"#!/bin/sh\n{trap.touch('planted-git')}\n").chmod(0o755)
    trap.write("evil.inc", f"[core]\n\tfsmonitor = {trap.touch('included')}\n\thooksPath = {trap.root}/hooks\n")
    trap.write(".git/config.worktree", f"[core]\n\tfsmonitor = {trap.touch('worktree-config')}\n")
    for hook in HOOKS:
        for directory in ("hooks", ".git/hooks"):
            trap.write(f"{directory}/{hook}", f"#!/bin/sh\n{trap.touch('hook-' + hook)}\n").chmod(0o755)
    for key in COMMANDS:
        trap.git("config", key, f"!{trap.touch(key)}" if key.startswith("alias.") else trap.touch(key))
    for key, value in VALUES.items():
        touch = trap.touch(key.partition(" ")[0].replace("/", "-"))
        trap.git("config", key.format(touch=touch), value.format(root=trap.root, touch=touch))
    for sentinel in trap.sentinels.iterdir():
        sentinel.unlink()  # what git itself ran while the trap was set
    path = {"PATH": f"{trap.root}/bin:{os.environ['PATH']}"}
    runs = {
        "alone": trap.run(environment=path),
        "against HEAD": trap.run("--baseline-rev", "HEAD", environment=path),
    }
    return trap, runs


@pytest.mark.parametrize(("run", "code"), [("alone", 1), ("against HEAD", 0)])
@pytest.mark.parametrize("key", [*COMMANDS, *VALUES, *HOOKS, "planted git"])
def test_no_setting_runs_anything(key: str, run: str, code: int, scene: tuple[Trap, dict[str, Outcome]]) -> None:
    trap, runs = scene
    assert runs[run].code == code, (runs[run].stderr, runs[run].notes())
    assert runs[run].notes() == []
    assert_harmless(trap, runs[run])
    assert_the_rest_is_analysed(runs[run])
    states = {result["path"]: result["state"] for result in runs[run].report["results"]}
    known = {"control.py": "unchanged", "moved.py": "updated"}  # git's renames are seen without git running anything
    assert states == (dict.fromkeys(known) if run == "alone" else known)


# -- repositories that are none -----------------------------------------------------------------------------------


@dataclass(frozen=True)
class Broken:
    """A repository that git cannot read; *says* stands in a notification of a run without a baseline."""

    name: str
    build: Callable[[Trap], object]
    says: str = "all files are listed, .gitignore is not honoured"


def committed(then: Callable[[Trap], object]) -> Callable[[Trap], None]:
    def build(t: Trap) -> None:
        t.commit()
        then(t)

    return build


def elsewhere(t: Trap) -> None:
    """The git directory of another place, reached through a symbolic link."""
    t.commit()
    shutil.move(t.root / ".git", t.outside / "repository")
    (t.root / ".git").symlink_to(t.outside / "repository")


BROKEN = [
    Broken("a file that points to /etc", lambda t: t.write(".git", "gitdir: /etc\n")),
    Broken("a file that points nowhere", lambda t: t.write(".git", "gitdir: ../../../nowhere\n")),
    Broken("a file that points to itself", lambda t: t.write(".git", "gitdir: .git\n")),
    Broken("a file of junk", lambda t: t.write(".git", b"\x00\x1b[31m::error::x\n")),
    Broken("a file of 100 MB", lambda t: t.sparse(".git", 100_000_000)),
    Broken("an empty directory", lambda t: (t.root / ".git").mkdir()),
    Broken(
        "a directory of junk",
        lambda t: [t.write(f".git/{n}", b"\x00::error::x\n") for n in ("HEAD", "config", "index")],
    ),
    Broken("a broken configuration", committed(lambda t: t.write(".git/config", "[core\n::error::x"))),
    Broken(
        "a configuration from the future",
        committed(lambda t: t.write(".git/config", "[core]\nrepositoryformatversion = 99\n")),
    ),
    Broken("a broken index", committed(lambda t: t.write(".git/index", b"DIRC" + b"\xff" * 100))),
    Broken("a broken HEAD", committed(lambda t: t.write(".git/HEAD", "ref: ../../../etc/passwd\n"))),
    Broken("no objects", committed(lambda t: shutil.rmtree(t.root / ".git/objects"))),
    Broken("a link that leads out", elsewhere, ""),
    Broken("a link that leads nowhere", lambda t: (t.root / ".git").symlink_to("nowhere")),
    Broken("a pipe", lambda t: os.mkfifo(t.root / ".git")),
    Broken(
        "objects that are gone",
        committed(lambda t: [shutil.rmtree(d) for d in (t.root / ".git/objects").iterdir()]),
        "",
    ),
    Broken(
        "references that lead out", committed(lambda t: t.write(".git/HEAD", "ref: refs/../../../../etc/passwd\n")), ""
    ),
    Broken("a submodule that points out", committed(lambda t: t.write("sub/.git", f"gitdir: {t.outside}\n")), ""),
    Broken("a bare repository inside", committed(lambda t: bare(t)), ""),
    Broken(
        "tracked and deleted",
        committed(lambda t: [t.write("x.py", ""), t.git("add", "x.py"), (t.root / "x.py").unlink()]),
        "",
    ),
    Broken(
        "a branch with a hostile name",
        committed(lambda t: t.git("checkout", "-q", "-b", "$(touch${IFS}x)@team|##<img>")),
        "",
    ),
]


def bare(t: Trap) -> None:
    """A directory that git takes for a repository, with settings of its own."""
    t.write("bare/HEAD", "ref: refs/heads/main\n")
    t.write("bare/config", f"[core]\n\tbare = false\n\tworktree = ..\n\tfsmonitor = {t.touch('bare')}\n")
    for name in ("objects", "refs"):
        (t.root / "bare" / name).mkdir()
    t.write("bare/inside.py", '"""Empty."""\n')


@pytest.mark.parametrize("case", BROKEN, ids=lambda case: case.name)
def test_broken_repositories(case: Broken, trap: Trap) -> None:
    case.build(trap)
    outcome = trap.run()
    assert outcome.code == 1, outcome.stderr
    assert not case.says or outcome.says(case.says), outcome.notes()
    assert_harmless(trap, outcome)
    assert_the_rest_is_analysed(outcome)


@pytest.mark.parametrize(
    ("revision", "arguments", "code"),
    [
        ("HEAD", ("--no-require-baseline",), 1),
        ("--output=x", ("--no-require-baseline",), 1),
        ("$(touch x)", ("--no-require-baseline",), 1),
        ("\x1b[31m::error::x\n##[error]", ("--no-require-baseline",), 1),
    ],
)
def test_no_revision_to_compare_with(revision: str, arguments: tuple[str, ...], code: int, trap: Trap) -> None:
    """It is said, and never all green."""
    trap.commit()
    if revision == "HEAD":
        trap.write(".git/HEAD", "junk\n")
    outcome = trap.run(f"--baseline-rev={revision}", *arguments)
    assert outcome.code == code, outcome.stderr
    assert outcome.says("No baseline: ") and "No baseline: " in outcome.formats["text"]
    assert outcome.report["baseline"]["available"] is False
    assert "No baseline" in outcome.formats["github"]
    assert_harmless(trap, outcome)
    assert CONTROL_FINDING in outcome.findings()


@pytest.mark.parametrize("revision", ["HEAD", "--output=x", "$(touch x)", "\x1b[31m::error::x\n##[error]", "HEAD~99"])
@pytest.mark.parametrize(
    ("arguments", "code"),
    [((), 2), (("--fail-on=never",), 2), (("--require-baseline",), 3), (("--fail-on=never", "--require-baseline"), 3)],
)
def test_nothing_is_called_new_without_a_base(revision: str, arguments: tuple[str, ...], code: int, trap: Trap) -> None:
    """One sentence, inert, and no report."""
    trap.commit()
    if revision == "HEAD":
        trap.write(".git/HEAD", "junk\n")
    done = trap.start("check", f"--baseline-rev={revision}", *arguments)
    assert (done.returncode, done.stdout) == (code, b"")
    lines = done.stderr.decode().splitlines()
    assert len(lines) == 2 and lines[0].startswith("error: no baseline, so nothing is reported: "), lines
    assert "\x1b" not in lines[0]


# -- pull requests ------------------------------------------------------------------------------------------------


def record(t: Trap) -> None:
    """A baseline that knows all that is there now."""
    t.command("baseline", "create", ".", "--force")


SILENT = "ignore: ['*', undefined-variable, pylint]\nfail-on: never\nexclude: ['**']\nlinters: {pylint: false}\n"


@dataclass(frozen=True)
class PullRequest:
    """What the head adds beside a defect; *says* stands in the report."""

    name: str
    head: Callable[[Trap], object]
    says: str = ""
    base: Callable[[Trap], object] = lambda t: None
    arguments: tuple[str, ...] = ()


PULL_REQUESTS = [
    PullRequest("no settings", lambda t: None),
    PullRequest(
        "a project file",
        lambda t: t.write(".haros-ci.yaml", SILENT),
        ".haros-ci.yaml is not in the base revision: it has no effect until it is",
    ),
    PullRequest("a file for HAROS", lambda t: t.write("haros.yaml", SILENT), "haros.yaml is not in the base revision"),
    PullRequest(
        "another project file",
        lambda t: t.write(".haros-ci.yaml", SILENT),
        ".haros-ci.yaml differs from the base revision's .haros-ci.yaml, which this run uses",
        base=lambda t: t.write(".haros-ci.yaml", "profile: ros\n"),
    ),
    PullRequest(
        "a project file that goes before",
        lambda t: t.write(".haros-ci.yaml", SILENT),
        ".haros-ci.yaml differs from the base revision's haros.yaml",
        base=lambda t: t.write("haros.yaml", "profile: ros\n"),
    ),
    PullRequest(
        "a project file that is gone",
        lambda t: (t.root / ".haros-ci.yaml").unlink(),
        ".haros-ci.yaml is removed here",
        base=lambda t: t.write(".haros-ci.yaml", "levels: {undefined-variable: error}\nfail-on: warning\n"),
    ),
    PullRequest(
        "a project file that is broken",
        lambda t: t.write(".haros-ci.yaml", "\t::error::x\n"),
        ".haros-ci.yaml is not in the base revision",
    ),
    PullRequest(
        "a project file that is a link",
        lambda t: (t.root / ".haros-ci.yaml").symlink_to(t.outside / "victim.json"),
        "not in the base revision",
    ),
    PullRequest(
        "a project file that is named",
        lambda t: t.write("ci/settings.yaml", SILENT),
        "ci/settings.yaml differs from the base revision's",
        base=lambda t: t.write("ci/settings.yaml", "profile: ros\n"),
        arguments=("--project=ci/settings.yaml",),
    ),
    PullRequest(
        "a project file that is named and new",
        lambda t: t.write("ci/settings.yaml", SILENT),
        "ci/settings.yaml is not in the base revision",
        arguments=("--project=ci/settings.yaml",),
    ),
    PullRequest("a baseline", record),
    PullRequest(
        "another baseline",
        record,
        ".haros-ci-baseline.jsonl differs from the base revision's, which this run uses",
        base=record,
        arguments=("--baseline=.haros-ci-baseline.jsonl",),
    ),
    PullRequest(
        "a baseline of the project file",
        lambda t: [record(t), t.write(".haros-ci.yaml", "baseline: .haros-ci-baseline.jsonl\n")],
        ".haros-ci.yaml is not in the base revision",
    ),
]


@pytest.mark.parametrize("case", PULL_REQUESTS, ids=lambda case: case.name)
def test_a_pull_request_cannot_judge_itself(case: PullRequest, trap: Trap) -> None:
    """Settings, project file and baseline are the base's; where the head differs the report says so."""
    case.base(trap)
    trap.write("ci/readme", "")
    trap.commit()
    trap.git("checkout", "-q", "-b", "head")
    trap.write("new.py", HEAD_ONLY)
    case.head(trap)
    trap.commit()
    outcome = trap.run("--baseline-rev=main", *case.arguments)
    assert outcome.code == 1, (outcome.stderr, outcome.notes())
    assert not case.says or outcome.says(case.says), outcome.notes()
    assert case.says or outcome.notes() == []
    assert_harmless(trap, outcome)
    states = {(r["path"], r["line"], r["rule"]): r["state"] for r in outcome.report["results"]}
    led_out = {(".haros-ci.yaml", None, "file-not-analysed"): "new"} if case.name.endswith("is a link") else {}
    assert states == {CONTROL_FINDING: "unchanged", NEW: "new", **led_out}


def test_without_a_base_the_files_count(trap: Trap) -> None:
    """The control of the above: the same files do silence the same defect where no base revision is given."""
    trap.write("new.py", HEAD_ONLY)
    trap.write(CONTROL_FINDING[0], CONTROL_TEXT)
    trap.write(".haros-ci.yaml", SILENT.replace("exclude: ['**']\n", ""))
    outcome = trap.run()
    assert outcome.code == 0 and outcome.findings() == set()
    assert_harmless(trap, outcome)
