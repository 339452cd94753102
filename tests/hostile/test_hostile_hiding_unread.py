# SPDX-License-Identifier: Apache-2.0
"""Changed files that cannot be read whole: findings at the file, never green; those that were so before are messages."""

from __future__ import annotations

import os
import re
import sys
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import pytest
from hostile_kit import CHEAP_FINDING, CONTROL, Outcome, Part, Trap, assert_harmless

QUICK = ("--ignore=pylint,cpplint,metrics,ruff,cppcheck",)
RULE = "file-not-analysed"
TEXT = "int f(int x) { return x; }\n"
LONG = f"int a[] = {{{'1, ' * 2_000}}};\n"
LFS = "version https://git-lfs.github.com/spec/v1"
A = "src/a.cpp"


#: Where a case stands.
Place = Trap | Part


@dataclass(frozen=True)
class Case:
    """What the head does to a file, and words of the message at *path*."""

    name: str
    head: Callable[[Place], object]
    says: str
    path: str = A
    base: Callable[[Place], object] = lambda t: None
    is_alone: bool = False  # what it does concerns files of other cases


def replaced(place: Place, name: str, target: str) -> None:
    (place.root / name).unlink()
    (place.root / name).symlink_to(target)


def secret(place: Place, name: str = A) -> str:
    """The file outside that has the ending of *name*, as a link from there."""
    outside = (place.outside / "secret").with_suffix(".py" if name.endswith(".py") else ".hpp")
    return os.path.relpath(outside, (place.root / name).parent)


CASES = [
    Case("a long line", lambda t: t.write(A, TEXT + LONG), "line 2: a line of more than 5000 characters"),
    Case("a long line in a new file", lambda t: t.write("n.py", f"x = '{'x' * 6000}'\n"), "5000", "n.py"),
    Case("a NUL", lambda t: t.write(A, TEXT + "\0"), "binary data where cpp text was expected"),
    Case("a pointer", lambda t: t.write("n.hpp", f"{LFS}\noid sha256:0\nsize 1\n"), "a pointer of Git LFS", "n.hpp"),
    Case("UTF-16", lambda t: t.write(A, TEXT.encode("utf-16")), "encoded as UTF-16; save it as UTF-8"),
    Case("large", lambda t: t.write(A, TEXT * 100_000), "more than the limit of 2000000; raise it or exclude the file"),
    Case("a link out", lambda t: replaced(t, A, secret(t)), "leads out of the workspace"),
    Case("a link to nowhere", lambda t: replaced(t, A, "nowhere"), "leads nowhere"),
    Case("a new link out", lambda t: (t.root / "b.py").symlink_to(secret(t, "b.py")), "leads out", "b.py"),
    Case(
        "a link to a file that is no source",
        lambda t: [t.write("src/a.txt", TEXT), replaced(t, A, "a.txt")],
        "a symbolic link to src/a.txt, which is not analysed as cpp",
    ),
    Case(
        "a link to a file that nobody looks at",
        lambda t: [t.write(".h/a.cpp", TEXT), replaced(t, A, "../.h/a.cpp")],
        "a symbolic link to .h/a.cpp, which is not analysed as cpp",
    ),
    Case(
        "a link to a file of another kind",
        lambda t: [t.write("src/a.yaml", "a: 1\n"), replaced(t, A, "a.yaml")],
        "which is not analysed as cpp",
    ),
    Case("a name of two lines", lambda t: t.write("src/b\n.cpp", TEXT), "rename it", "src"),
    Case("a name that is no UTF-8", lambda t: t.write(b"src/\xff.cpp", TEXT), "rename it", "src"),
    Case(
        "unread before, and other contents now",
        lambda t: t.write(A, TEXT + LONG),
        "a line of more than 5000 characters",
        base=lambda t: t.write(A, LONG),
    ),
    Case(
        "a comment that would silence it",
        lambda t: t.write(A, f"// haros: ignore[{RULE}] never mind\n{LONG}"),
        "a line of more than",
    ),
    Case(
        "attributes that change what is checked out",
        lambda t: [
            t.write(".gitattributes", "*.cpp working-tree-encoding=UTF-16\n"),
            *(t.write(name, TEXT.encode("utf-16")) for name in (A, CHEAP_FINDING[0])),
        ],
        "encoded as UTF-16",
        is_alone=True,
    ),
    Case("a manifest", lambda t: t.write("src/package.xml", "<package>\0</package>"), "binary data", "src/package.xml"),
    Case("a launch file", lambda t: t.write("x.launch", f"<launch>{' ' * 30_000}</launch>"), "20000", "x.launch"),
]


def pull_request(trap: Trap, base: Callable[[Trap], object], head: Callable[[Trap], object]) -> None:
    (trap.root / CONTROL).unlink()
    trap.write(CHEAP_FINDING[0], TEXT)
    trap.write(A, TEXT)
    base(trap)
    trap.commit()
    trap.git("checkout", "-q", "-b", "head")
    head(trap)
    trap.commit()
    if (trap.root / ".gitattributes").exists():  # as a clone has it
        for name in trap.git("ls-files").splitlines():
            os.unlink(trap.root / name)
        trap.git("checkout", "-q", "--", ".")


def told(outcome: Outcome) -> list[tuple[str, str, str | None, str]]:
    found = [r for r in outcome.report["results"] if r["rule"] == RULE]
    return [(r["path"], r["level"], r["state"], r["message"]) for r in found]


class Requests:
    """Pull requests, each with all cases that can stand beside one another, and what runs say of it."""

    def __init__(self, new_trap: Callable[[], Trap]) -> None:
        self.new_trap = new_trap
        self.made: dict[tuple[int, str], tuple[Trap, list[Outcome]]] = {}

    def of(self, case: Any, cases: list[Any], *runs: tuple[str, ...]) -> tuple[Trap, str, list[Outcome]]:
        """The trap, the directory of *case* in it with a slash, and the outcome of each of the *runs*."""
        together = [] if case.is_alone else [each for each in cases if not each.is_alone]
        key = (id(cases), case.name if case.is_alone else "")
        if key not in self.made:
            trap = self.new_trap()
            places = [trap] if case.is_alone else [Part(trap, f"c{number}") for number in range(len(together))]
            stood = list(zip(places, together or [case]))
            pull_request(
                trap,
                lambda _: [[place.write(A, TEXT), each.base(place)] for place, each in stood],
                lambda _: [each.head(place) for place, each in stood],
            )
            self.made[key] = trap, [trap.run(*arguments) for arguments in runs]
        trap, outcomes = self.made[key]
        return trap, "" if case.is_alone else f"c{together.index(case)}/", outcomes


@pytest.fixture(scope="module")
def requests(new_trap: Callable[[], Trap]) -> Requests:
    return Requests(new_trap)


@pytest.mark.parametrize("case", CASES, ids=lambda case: case.name)
def test_it_is_a_finding_at_the_file(case: Case, requests: Requests) -> None:
    against, without = ("--baseline-rev=main", *QUICK), ("--baseline-rev=nowhere", "--no-require-baseline", *QUICK)
    trap, place, (outcome, again) = requests.of(case, CASES, against, without)
    assert outcome.code == 1, (outcome.stderr, outcome.notes())
    [(path, level, state, message)] = [found for found in told(outcome) if found[0] == place + case.path]
    assert (path, level, state) == (place + case.path, "warning", "new")
    assert path in {r["path"] for r in outcome.report["results"] if r["rule"] == RULE and r["open"]}
    assert case.says in message.replace(place, "")
    assert f"haros-ci:{RULE}" in outcome.formats["text"] and RULE in outcome.formats["github"]
    said = [words.replace(place, "") for where, words in outcome.notes() if where == path]
    assert not [words for words in said if case.says in words], "it is said once"
    assert_harmless(trap, outcome)
    assert (path, "warning", None, message) in told(again), "without the base everything counts"


@dataclass(frozen=True)
class Quiet:
    """No finding; *says* stands in a message."""

    name: str
    base: Callable[[Place], object]
    head: Callable[[Place], object] = lambda t: t.write("readme", "")
    says: str = ""
    arguments: tuple[str, ...] = ("--baseline-rev=main",)
    is_alone: bool = False  # what it does or asks concerns files of other cases


QUIET = [
    Quiet("it was so", lambda t: t.write(A, LONG), says="skipped: a line of more than 5000 characters"),
    Quiet("it was so, and large", lambda t: t.write(A, TEXT * 100_000), says="more than the limit"),
    Quiet("it was so, and a link", lambda t: replaced(t, A, secret(t)), says="leads out"),
    Quiet(
        "it has moved",
        lambda t: t.write("src/old.cpp", LONG),
        lambda t: (t.root / "src/old.cpp").rename(t.root / "src/new.cpp"),
        says="5000",
        is_alone=True,
    ),
    Quiet(
        "what git converts",
        lambda t: [t.write("w.cpp", LONG), t.write(".gitattributes", "*.cpp text eol=crlf\n")],
        says="5000",
        is_alone=True,
    ),
    Quiet("no base revision", lambda t: None, lambda t: t.write(A, LONG), "5000", (), is_alone=True),
    Quiet(
        "not committed",
        lambda t: t.write(".gitignore", "/out\n"),
        lambda t: [t.write("out/x.cpp", LONG), t.write("readme", "")],
        is_alone=True,
    ),
    Quiet("prose", lambda t: None, lambda t: t.write("a.md", "x" * 30_000 + "\n")),
    Quiet("long prose", lambda t: None, lambda t: t.write("a.md", "x\n" * 2_000_000), "more than the limit"),
    Quiet("what nobody reads", lambda t: None, lambda t: t.write("a.bin", b"\0" * 3_000_000)),
    Quiet("Latin-1", lambda t: None, lambda t: t.write(A, b"int a; // \xe4\n"), "decoded as Latin-1"),
    Quiet("shorter lines", lambda t: None, lambda t: t.write(A, f"int a[] = {{{'1, ' * 1_600}}};\n")),
    Quiet("it is mended", lambda t: t.write(A, LONG), lambda t: t.write(A, TEXT)),
    Quiet("it is gone", lambda t: t.write(A, LONG), lambda t: (t.root / A).unlink()),
    Quiet("a link to source", lambda t: None, lambda t: (t.root / "b.cpp").symlink_to("src/a.cpp")),
    Quiet("a link to a directory", lambda t: None, lambda t: (t.root / "lib").symlink_to("src")),
    Quiet(
        "a link between kinds of data",
        lambda t: t.write("a.xml", "<a/>\n"),
        lambda t: (t.root / "a.launch").symlink_to("a.xml"),
    ),
    Quiet(
        "left out by the command line",
        lambda t: None,
        lambda t: t.write(A, LONG),
        arguments=("--baseline-rev=main", "--exclude=src"),
        is_alone=True,
    ),
    Quiet(
        "left out by the base",
        lambda t: t.write(".haros-ci.yaml", "exclude: [src]\n"),
        lambda t: t.write(A, LONG),
        is_alone=True,
    ),
    Quiet(
        "turned off by the base",
        lambda t: t.write(".haros-ci.yaml", f"ignore: [{RULE}]\n"),
        lambda t: t.write(A, LONG),
        is_alone=True,
    ),
]


@pytest.mark.parametrize("case", QUIET, ids=lambda case: case.name)
def test_it_is_no_finding(case: Quiet, requests: Requests) -> None:
    _, place, (outcome,) = requests.of(case, QUIET, (*case.arguments, *QUICK))
    assert_quiet(case, place, outcome)


def assert_quiet(case: Quiet, place: str, outcome: Outcome) -> None:
    """Nothing is found, and of the files of the case nothing is said but what it names."""
    assert outcome.code == 0, (outcome.stderr, outcome.formats["text"])
    assert told(outcome) == []
    said = [message for path, message in outcome.notes() if path is None or path.startswith(place)]
    assert any(case.says in message for message in said) if case.says else said == [], outcome.notes()


OF_BUILDS = [
    Case(
        "a definition that renames a word",
        lambda t: t.write("CMakeLists.txt", "project(a)\nadd_definitions(-Dkept=local)\n"),
        "kept=local",
        "CMakeLists.txt",
    ),
    Case(
        "a template of CMake",
        lambda t: t.write("cfg/a.cmake.in", "add_compile_options(-include part.glsl)\n"),
        "add_compile_options(… -include",
        "cfg/a.cmake.in",
    ),
    Case(
        "a header of a form",
        lambda t: [t.write("src/f.ui", "<ui><header>part.glsl</header></ui>\n"), t.write("src/part.glsl", TEXT)],
        "a form of Qt has C++ include it",
        "src/part.glsl",
    ),
]


@pytest.mark.parametrize("case", OF_BUILDS, ids=lambda case: case.name)
def test_what_a_build_is_told_is_a_finding(case: Case, trap: Trap) -> None:
    pull_request(trap, case.base, case.head)
    outcome = trap.run("--baseline-rev=main", *QUICK)
    assert outcome.code == 1, (outcome.stderr, outcome.notes())
    assert [case.says in message for path, _, _, message in told(outcome) if path == case.path] == [True]
    assert_harmless(trap, outcome)


def test_a_given_file_is_reported_and_others_are_not(trap: Trap) -> None:
    pull_request(trap, lambda t: None, lambda t: [t.write(A, LONG), t.write("src/b.cpp", LONG)])
    done = trap.start("check", A, "--baseline-rev=main", *QUICK).stdout.decode()
    assert f"{A}: warning: " in done and "src/b.cpp: warning: The change" not in done, done


def test_an_exception_of_the_base_accepts_it(trap: Trap) -> None:
    accepted = f"exceptions: [{{files: [src/a.cpp], rules: [{RULE}], reason: generated}}]\n"
    pull_request(trap, lambda t: t.write(".haros-ci.yaml", accepted), lambda t: t.write(A, LONG))
    outcome = trap.run("--baseline-rev=main", *QUICK)
    assert outcome.code == 0 and outcome.report["counts"]["suppressed"] == 1


def test_shards_say_the_same(trap: Trap) -> None:
    pull_request(trap, lambda t: None, lambda t: t.write(A, LONG))
    options = ("--baseline-rev=main", *QUICK)
    files = [str(trap.place / f"{n}.shard.jsonl") for n in (1, 2)]
    for n, file in enumerate(files, 1):
        assert trap.start("check", f"--shard={n}/2", f"--output=shard={file}", *options).returncode == 0
    assert trap.command("merge", "--output=json", *options, *files) == trap.command("check", "--output=json", *options)


DEFECT = "int f(int x) { int *unset = 0; return *unset + x; }\n"
#: Text around the defect by which a tool would say of it that it stands in another file, or take it for a comment.
DIRECTIVES = {
    "another file": f'#line 1 "other.cpp"\n{DEFECT}',
    "another file, as compilers write it": f'# 1 "/etc/passwd" 3\n{DEFECT}',
    "another file, behind a comment": f'/*\n*/ #line 1 "other.cpp"\n{DEFECT}',
    "another file, behind a control character": f'\x01#\x02line 1 "other.cpp"\n{DEFECT}',
    "another line": f"#line 700\n{DEFECT}",
    "a directive in a comment": f"/*#include*/\n{DEFECT}/**/\n",
    "a directive in a comment of two lines": f"/*\n#include*/\n{DEFECT}/**/\n",
    "a directive in a text": f'const char *s = "#include"; {DEFECT}',
    "a directive in a raw text": f'const char *s = R"(\n#include)";\n{DEFECT}const char *t = R"()";\n',
    "a question in a text": f'const char *s = "__has_include("; {DEFECT}',
    "a line that ends with a carriage return": f"#define X <vector>\n#include X\r{DEFECT}",
    "a directive behind another one": f'#include "/usr/include/stdio.h" #if 0\n{DEFECT}#include "/usr/include/stdio.h" #endif\n',
}


def written(path: str, text: str) -> Callable[[Place], object]:
    return lambda place: place.write(path, text)


HIDDEN = [Case(name, written(A, text), "") for name, text in DIRECTIVES.items()]


@pytest.mark.parametrize("case", HIDDEN, ids=lambda case: case.name)
def test_directives_hide_no_code(case: Case, requests: Requests) -> None:
    arguments = ("--baseline-rev=main", "--ignore=pylint,cpplint,metrics,ruff", "--select=nullPointer")
    trap, place, (outcome,) = requests.of(case, HIDDEN, arguments)
    text = DIRECTIVES[case.name]
    where = re.split("\r\n|\n|\r", text[: text.index(DEFECT)])
    assert (place + A, len(where), "nullPointer") in outcome.findings(), outcome.notes()
    assert place + A in {r["path"] for r in outcome.report["results"] if r["rule"] == "nullPointer" and r["open"]}
    assert outcome.code == 1
    assert_harmless(trap, outcome)


LINTERS = ("--ignore=metrics,cpplint,ruff", "--select=nullPointer,undefined-variable")
NOWHERE = "import os\n\n\ndef f():\n    return nowhere + os.sep\n"
B = "src/b.py"
#: What keeps a linter from analysing a file that compilers and interpreters take, and which linter says so.
UNREADABLE = {
    "a condition of compilers": (A, f"#if __has_builtin(__builtin_expect)\n#endif\n{DEFECT}", "cppcheck"),
    "a name that is not ASCII": (A, f"int \xe9;\n{DEFECT}", "cppcheck"),
    "a name in hexadecimal": (A, f"int \\u00e9;\n{DEFECT}", "cppcheck"),
    "digraphs": (A, f"int e()\n<%\n  return 0;\n%>\n{DEFECT}", "cppcheck"),
    "a macro that opens a block": (
        A,
        f"#ifdef NEVER\n#else\n#define OPEN {{\n#endif\nnamespace a OPEN\nCALL(}}\n{DEFECT}",
        "cppcheck",
    ),
    "a file that includes itself": (A, f'#ifndef TWICE\n#include "a.cpp"\n#define TWICE\n#endif\n{DEFECT}', "cppcheck"),
    "many conditional operators": (A, f"int a = {'1 ? 2 : ' * 400}3;\n{DEFECT}", "cppcheck"),
    "a new file": ("src/new.cpp", f"int \\u00e9;\n{DEFECT}", "cppcheck"),
    "an encoding that only the interpreter knows": (B, f"# -*- coding: utf-7 -*-\n{NOWHERE}", "pylint"),
    "an encoding that is none": ("src/new.py", f"# -*- coding: punycode -*-\n{NOWHERE}", "pylint"),
    "another encoding": (B, f"# vim: set fileencoding=utf-16 :\n{NOWHERE}", "pylint"),
    "Python of a newer version than anything before": ("src/new.py", f"type X = int\n{NOWHERE}", "pylint"),
    "Python 2 in a file that was not": (B, f"print 'x'\n{NOWHERE}", "pylint"),
}


NOT_ANALYSED = [
    Case(name, written(path, text), tool, path, base=written(B, "x = 1\n"))
    for name, (path, text, tool) in UNREADABLE.items()
    if "newer" not in name or sys.version_info < (3, 12)
]


@pytest.mark.parametrize("name", UNREADABLE)
def test_what_a_linter_cannot_analyse_since_a_change(name: str, requests: Requests) -> None:
    case = next((case for case in NOT_ANALYSED if case.name == name), None)
    if case is None:
        pytest.skip("pylint reads it")
    trap, place, (outcome,) = requests.of(case, NOT_ANALYSED, ("--baseline-rev=main", *LINTERS))
    assert outcome.code == 1, outcome.notes()
    [(path, level, state, message)] = [
        found for found in told(outcome) if found[0].startswith(place) and case.says in found[3]
    ]
    assert (path, level, state) == (place + case.path, "warning", "new")
    assert path in {r["path"] for r in outcome.report["results"] if r["rule"] == RULE and r["open"]}
    assert message.startswith(f"{case.says} cannot analyse this file")
    said = [words for where, words in outcome.notes() if where is None or where.startswith(place)]
    assert not [words for words in said if words.startswith(f"{case.says} could not analyse")], "it is said once"
    assert_harmless(trap, outcome)


OLD = f"int \\u00e9;\n{TEXT}"
READABLE = [
    Quiet("it was so", lambda t: t.write(A, OLD), lambda t: t.write(A, f"{OLD}int b;\n"), "cppcheck could not analyse"),
    Quiet(
        "it was so, and has moved",
        lambda t: t.write("src/old.cpp", OLD * 9),
        lambda t: (t.root / "src/old.cpp").rename(t.root / "src/new.cpp"),
        "cppcheck could not analyse",
    ),
    Quiet("nobody changes it", lambda t: t.write("src/old.cpp", OLD), says="cppcheck could not analyse"),
    Quiet("it is mended", lambda t: t.write(A, OLD), lambda t: t.write(A, TEXT)),
    Quiet(
        "newer Python, as there is some",
        lambda t: t.write(B, "type X = int\n"),
        lambda t: t.write("src/new.py", "type Y = int\n"),
        "it is for Python 3.12",
        is_alone=True,
    ),
    Quiet("new Python 2", lambda t: None, lambda t: t.write(B, "print 'x'\n"), "it is Python 2"),
    Quiet(
        "Python 2 as before", lambda t: t.write(B, "print 'x'\n"), lambda t: t.write(B, "print 'y'\n"), "it is Python 2"
    ),
    Quiet(
        "no base revision", lambda t: None, lambda t: t.write(A, OLD), "cppcheck could not analyse", (), is_alone=True
    ),
    Quiet(
        "a header of others that was so",
        lambda t: [t.write("src/h.hpp", "int \\u00e9;\n"), t.write(A, f'#include "h.hpp"\n{TEXT}')],
        lambda t: t.write(A, f'#include "h.hpp"\n{TEXT}int b;\n'),
        "cppcheck could not analyse",
    ),
    Quiet(
        "turned off by the base",
        lambda t: t.write(".haros-ci.yaml", f"ignore: [{RULE}]\n"),
        lambda t: t.write(A, OLD),
        is_alone=True,
    ),
    Quiet(
        "an error of the preprocessor", lambda t: None, lambda t: t.write(A, f"#ifndef X\n#error no\n#endif\n{TEXT}")
    ),
    Quiet(
        "another compiler", lambda t: None, lambda t: t.write(A, f"#ifndef __GNUC__\n#if y(\n#endif\n#endif\n{TEXT}")
    ),
]


@pytest.mark.parametrize("case", READABLE, ids=lambda case: case.name)
def test_what_linters_could_not_analyse_before(case: Quiet, requests: Requests) -> None:
    if "newer" in case.name and sys.version_info >= (3, 12):
        pytest.skip("pylint reads it")
    _, place, (outcome,) = requests.of(case, READABLE, (*case.arguments, *LINTERS))
    assert_quiet(case, place, outcome)


def test_a_wrong_file_is_one_finding(trap: Trap) -> None:
    """What no interpreter takes pylint says itself."""
    pull_request(trap, lambda t: None, lambda t: t.write(B, "def f(:\n"))
    outcome = trap.run("--baseline-rev=main", "--ignore=cpplint,ruff")
    assert {rule for path, _, rule in outcome.findings() if path == B} == {"syntax-error"}


def test_a_header_that_no_linter_can_analyse(trap: Trap) -> None:
    """It is said of the header that the change alters, not of the file that includes it."""
    pull_request(
        trap,
        lambda t: [t.write("src/h.hpp", "int h;\n"), t.write(A, f'#include "h.hpp"\n{TEXT}')],
        lambda t: t.write("src/h.hpp", f"int \\u00e9;\n{DEFECT}"),
    )
    assert [found[:3] for found in told(trap.run("--baseline-rev=main", *LINTERS))] == [("src/h.hpp", "warning", "new")]


LIST = "cmake_minimum_required(VERSION 3.8)\nproject(a)\n"
LIFT = "inline int & lift()\n{\n  int made = 1;\n  return made;\n}\n"
PART = "def part():\n    return undefined_thing\n"
BASE = {
    "src/lift.inc": LIFT,
    "src/lift.txt": LIFT,
    "src/part.txt": PART,
    "src/rows.txt": "1, 2, 3\n",
    "src/notes.md": "# Notes\n",
    A: TEXT,
    "src/a.py": "A = 1\n",
    "CMakeLists.txt": LIST,
    ".parts/part.py": PART,
    "src/node_modules/tool.py": PART,
    "extra/lift.cpp": LIFT,
    "extra/COLCON_IGNORE": "",
    "src/fast.pyx": PART,
}
COMPILED = LIST + "set_source_files_properties(src/lift.txt PROPERTIES LANGUAGE CXX)\nadd_library(b src/lift.txt)\n"


def used(head: dict[str, str], more: dict[str, str], trap: Trap) -> list[str]:
    pull_request(
        trap,
        lambda t: [t.write(name, text) for name, text in {**BASE, **more}.items()],
        lambda t: [t.write(name, text) for name, text in head.items()],
    )
    return [path for path, _, state, _ in told(trap.run("--baseline-rev=main", *QUICK)) if state == "new"]


@pytest.mark.parametrize(
    ("head", "path"),
    [
        ({A: '#include "lift.inc"\n' + TEXT}, "src/lift.inc"),
        ({"CMakeLists.txt": COMPILED}, "src/lift.txt"),
        ({"src/a.py": "A = exec(open('part.txt').read())\n"}, "src/part.txt"),
        ({"CMakeLists.txt": LIST + "add_compile_options(-specs=flags)\n"}, "CMakeLists.txt"),
        ({A: '#include "copy.inc"\n' + TEXT, "src/copy.inc": LIFT}, "src/copy.inc"),
        ({"src/a.py": "sys.path.insert(0, '.parts')\nimport part\n"}, ".parts/part.py"),
        ({"src/a.py": "from src.node_modules import tool\n"}, "src/node_modules/tool.py"),
        ({"CMakeLists.txt": LIST + "add_library(c extra/lift.cpp)\n"}, "extra/lift.cpp"),
        ({"src/a.py": "import pyximport\nimport fast\n"}, "src/fast.pyx"),
    ],
)
def test_a_file_of_the_base_that_a_change_uses_first(head: dict[str, str], path: str, trap: Trap) -> None:
    assert used(head, {}, trap) == [path]


@pytest.mark.parametrize(
    ("head", "more"),
    [
        ({A: '#include "lift.inc"\nint b;\n'}, {A: '#include "lift.inc"\n'}),
        ({"src/b.cpp": '#include "lift.inc"\n'}, {A: '#include "lift.inc"\n'}),
        ({"src/a.py": "A = open('part.txt').read()\n"}, {}),
        ({"src/a.py": "A = 'see notes.md and rows.txt'\n"}, {}),
        ({A: "// not lift.inc\n" + TEXT}, {}),
        ({"CMakeLists.txt": LIST + "install(FILES src/lift.inc src/part.txt DESTINATION share/a)\n"}, {}),
        ({"readme.md": "lift.inc, part.txt\n"}, {}),
        ({A: '#include "moved.inc"\n', "src/moved.inc": LIFT}, {A: '#include "lift.inc"\n'}),
        ({"src/copy.inc": LIFT}, {}),
        ({"src/b.py": "import part\nA = 1\n"}, {"src/a.py": "sys.path.insert(0, '.parts')\nimport part\n"}),
        ({"src/a.py": "A = 'extra words'\n"}, {}),
        ({"src/a.py": "lift = 1\nfrom part import x\n"}, {}),
        (
            {"CMakeLists.txt": LIST + "add_library(c extra/lift.cpp b.cpp)\n"},
            {"CMakeLists.txt": LIST + "add_library(c extra/lift.cpp)\n"},
        ),
        ({"src/b.py": "import fast\n"}, {"src/a.py": "import fast\n"}),
    ],
)
def test_a_file_of_the_base_that_was_used_or_still_is_not(
    head: dict[str, str], more: dict[str, str], trap: Trap
) -> None:
    assert used(head, more, trap) == []


@pytest.mark.parametrize(
    ("path", "text", "says"),
    [
        (A, "#include PART\n" + TEXT, "'#include PART'"),
        (A, "TP_ARGS(int g(int x) { return x; })\n" + TEXT, "code in the arguments of TP_ARGS"),
        ("launch/a.launch.xml.in", "<launch/>\n", "made into data of ROS by a build"),
        ("CMakeLists.txt", LIST + "file(STRINGS list.txt A)\n", "file(… STRINGS list.txt A) may compile, make or run"),
        ("colcon.pkg", '{"cmake-args": ["-DCMAKE_CXX_FLAGS=-DX"]}\n', "1 changed file sets flags of compilers"),
    ],
)
def test_what_compilers_are_given_otherwise_is_named(path: str, text: str, says: str, trap: Trap) -> None:
    pull_request(trap, lambda t: None, lambda t: t.write(path, text))
    outcome = trap.run("--baseline-rev=main", *QUICK)
    assert [place for place, message in outcome.notes() if says in message] == [path], outcome.notes()
