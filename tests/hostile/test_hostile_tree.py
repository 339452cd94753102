# SPDX-License-Identifier: Apache-2.0
"""Trees full of traps: names, contents, links, special files and manifests, all in one workspace, in and out of git."""

from __future__ import annotations

import json
import os
import socket
import tempfile
from collections.abc import Callable
from dataclasses import dataclass

import pytest
from hostile_kit import Outcome, Trap, assert_harmless, assert_the_rest_is_analysed

PYTHON = b'"""A module."""\nX = undefined_here\n'
CPP = b"int f(int x) { int *unset = 0; return *unset + x; }\n"


@dataclass(frozen=True)
class Case:
    """A file or more, and what the report says of *path*: the finding of this rule (a one-word *says*), or a notice
    with these words, or (``""``) nothing at all."""

    path: str
    says: str
    build: Callable[[Trap], object]


def named(name: str, says: str = "") -> Case:
    """A file with one known defect and a hostile name."""
    cpp = name.endswith(".cpp")
    return Case(
        name, says or ("nullPointer" if cpp else "undefined-variable"), lambda t: t.write(name, CPP if cpp else PYTHON)
    )


def holding(name: str, data: bytes, says: str) -> Case:
    return Case(name, says, lambda t: t.write(name, data))


def linked(name: str, target: str, says: str) -> Case:
    def build(t: Trap) -> None:
        path = t.root / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.symlink_to(target.format(outside=t.outside))

    return Case(name, says, build)


def manifest(name: str, text: str | bytes, says: str = "malformed-manifest") -> Case:
    return Case(f"{name}/package.xml", says, lambda t: t.write(f"{name}/package.xml", text))


UNPRINTABLE = "its name has unprintable characters"
NAMES = [
    named("::error::pwned.py"),
    named("::error file=a.py,line=1::pwned.cpp"),
    named(" ::warning::indented.py"),
    named("##[error]older.py"),
    named("##[add-matcher]older.cpp"),
    named("%0A::error::encoded.py"),
    named("\x1b]52;c;cGF5bG9hZA==\x07.py", UNPRINTABLE),
    named("\x1b[2J\x1b[31m.cpp", UNPRINTABLE),
    named("\x9b31m.py", UNPRINTABLE),
    named("a\u202egpj.py", UNPRINTABLE),
    named("a\u2066b.cpp", UNPRINTABLE),
    named("tab\tbed.py", UNPRINTABLE),
    named("--init-hook=import os.py"),
    named("--rcfile=evil.py"),
    named("-rf.cpp"),
    named("--enable=all.cpp"),
    named("--.py"),
    named("@response.cpp"),
    named("@team.py"),
    named("'single' and \"double\".py"),
    named('quo"te.cpp'),
    named("$(touch x).py"),
    named("`touch x`.cpp"),
    named("; touch x ;.py"),
    named("~.py"),
    named("~root/home.py"),
    named("%s%n%d.py"),
    named("back\\slash\\n.py"),
    named("a" * 252 + ".py"),
    named("a|b.py"),
    named("<img src=x onerror=alert(1)>.py"),
    named("[link](javascript:alert(1)).py"),
    named("![image](http:..example.org).py"),
    named("with space.py"),
    named("ends in space .cpp"),
    named("comma,colon:a.py"),
    named("*.py"),
    named("{a,b}[c].cpp"),
    named("a#b?c=d&e.py"),
    named("file:etc.py"),
    named("http:x.py"),
    named("C:\\x.py"),
    named("größe 漢字.py"),
    Case(".", r"skipped 'new\n::error::line.py'", lambda t: t.write("new\n::error::line.py", PYTHON)),
    Case(".", r"skipped 'carriage\r.py'", lambda t: t.write("carriage\r.py", PYTHON)),
    Case(".", r"skipped 'separator\u2028.py'", lambda t: t.write("separator\u2028.py", PYTHON)),
    Case(".", r"skipped 'latin\udce9.py'", lambda t: t.write(b"latin\xe9.py", PYTHON)),
    Case(".", r"skipped 'd\n::error::x'", lambda t: t.write("d\n::error::x/inside.py", PYTHON)),
]


def socket_at(t: Trap) -> None:
    """Names of sockets are short, so it is bound elsewhere and moved."""
    with tempfile.TemporaryDirectory() as short, socket.socket(socket.AF_UNIX) as end:
        end.bind(f"{short}/s")
        os.rename(f"{short}/s", t.root / "socket.py")


NESTED = "/".join(["n"] * 300) + "/deep.py"
LINKS = [
    linked("out.py", "{outside}/secret.py", "leads out of the workspace"),
    linked("relative.py", "../outside/secret.py", "leads out of the workspace"),
    linked("outdir", "{outside}", "leads out of the workspace"),
    linked("everything", "/", "leads out of the workspace"),
    linked("zero.cpp", "/dev/zero", "leads out of the workspace"),
    linked("terminal.py", "/dev/tty", "leads out of the workspace"),
    linked("self.py", "self.py", "leads nowhere"),
    linked("gone.py", "no such file", "leads nowhere"),
    linked("loop/again", "..", ""),
    linked("hardly.py", "control.py", ""),
    linked("manifested/package.xml", "{outside}/victim.json", "leads out of the workspace"),
    Case("pipe.py", "", lambda t: os.mkfifo(t.root / "pipe.py")),
    Case("pipe.cpp", "", lambda t: os.mkfifo(t.root / "pipe.cpp")),
    Case("socket.py", "", socket_at),
    Case(NESTED, "undefined-variable", lambda t: t.write(NESTED, PYTHON)),
]

CONTENTS = [
    Case("huge.cpp", "200000000 bytes, more than the limit", lambda t: t.sparse("huge.cpp", 200_000_000)),
    Case("huge.py", "200000000 bytes, more than the limit", lambda t: t.sparse("huge.py", 200_000_000)),
    Case("huge.xml", "200000000 bytes, more than the limit", lambda t: t.sparse("huge.xml", 200_000_000)),
    holding("one_line.py", b"X = [" + b"1," * 2_500_000 + b"]\n", "more than the limit"),
    holding("minified.py", b"X = [" + b"1," * 500_000 + b"]\n", "a line of more than 5000 characters"),
    holding("lists.py", b"X = " + b"[" * 3_000 + b"]" * 3_000 + b"\n", "a line of more than 5000 characters"),
    holding(
        "comments.cpp", b"/**/" * 500 + b"int y;\nint f(int x) { int *unset = 0; return *unset + x; }\n", "nullPointer"
    ),
    holding("nested_lists.py", b"X = " + b"[\n" * 3_000 + b"]\n" * 3_000, "syntax-error"),
    holding("nested_calls.py", b"X = X" + b"()\\\n" * 3_000 + b"\n", "pylint could not analyse this file"),
    holding("nul.py", b"X = 1\n\0\n", "binary data"),
    holding("nul.cpp", b"int a;\n\0\n", "binary data"),
    holding("program.cpp", b"\x7fELF\2\1\1\0\0\0", "binary data"),
    holding("utf16.py", PYTHON.decode().encode("utf-16"), "encoded as UTF-16"),
    holding("utf16.cpp", CPP.decode().encode("utf-16"), "encoded as UTF-16"),
    holding("latin.cpp", b"// Andr\xe9\n" + CPP, "decoded as Latin-1"),
    holding("latin.py", b"# Andr\xe9\n" + PYTHON, "decoded as Latin-1"),
    holding("declared.py", b"# -*- coding: no-such-codec -*-\n" + PYTHON, "syntax-error"),
    holding("bom.py", b"\xef\xbb\xbf" + PYTHON, "undefined-variable"),
    holding("bom.cpp", b"\xef\xbb\xbf" + CPP, "nullPointer"),
    holding("crlf.py", PYTHON.replace(b"\n", b"\r\n"), "undefined-variable"),
    holding("cr.py", PYTHON.replace(b"\n", b"\r"), "undefined-variable"),
    holding("unended.py", PYTHON.rstrip(), "undefined-variable"),
    holding("empty.py", b"", ""),
    holding("empty.cpp", b"", ""),
    holding("blank.py", b"\n" * 1_000, ""),
    holding("python2.py", b'print "hello"\nexec "x"\n', "it is Python 2"),
    holding("broken.py", b"def f(:\n", "syntax-error"),
    holding("broken.cpp", b"int f( { ) }\n", "cppcheck could not analyse this file"),
    holding("surrogate.py", b'X = ("\\ud800", undefined_here)\n', "undefined-variable"),
    holding(
        "quotes.py",
        "X = undefined_here  # \x1b]52;c;x\x07 \u202e ::error::x ##[error]x\n".encode(),
        "undefined-variable",
    ),
    holding("says.py", b"::error::pwned\n##[error]pwned\n", "syntax-error"),
    holding("comment.py", b'"""::error::x"""\n    ::error::y\n\x1b[31m ##[stop-commands]x\n', "syntax-error"),
    holding(
        "passwd.cpp",
        b'#include "/etc/passwd"\n#include </etc/shadow>\n' + CPP,
        "nullPointer",
    ),
    holding("outside.cpp", b'#include "../outside/error.hpp"\n' + CPP, "nullPointer"),
    holding("beyond.cpp", b'#include "../outside/secret.hpp"\n#include "../../../x.hpp"\n' + CPP, "nullPointer"),
    holding("itself.cpp", b'#pragma once\n#include "itself.cpp"\n' + CPP, "nullPointer"),
    holding("error.cpp", b'#error "::error::x \x1b[31m ##[error]"\n' + CPP, "nullPointer"),
    holding("conditions.cpp", b"#if A\n" * 500, ""),
    holding("unclosed.cpp", b"/*" + b"\n" * 100, ""),
    holding("launch/bomb.launch", b'<!DOCTYPE x [<!ENTITY a "a">]><launch>&a;</launch>', "malformed-launch-file"),
    holding("script", b"#!/usr/bin/env python3\n" + PYTHON, "undefined-variable"),
]

LAUGHS = "".join(f'<!ENTITY e{n + 1} "{f"&e{n};" * 10}">' for n in range(9))
GOOD = '<package format="3"><name>{}</name><version>1.0.0</version></package>\n'
MANIFESTS = [
    manifest("laughs", f'<!DOCTYPE p [<!ENTITY e0 "x">{LAUGHS}]><package><name>&e9;</name></package>'),
    manifest("entity", '<!DOCTYPE p [<!ENTITY x SYSTEM "file:///etc/passwd">]><package><name>&x;</name></package>'),
    manifest(
        "parameter", '<!DOCTYPE p [<!ENTITY % x SYSTEM "file:///etc/passwd">%x;]><package><name>a</name></package>'
    ),
    manifest("remote", '<!DOCTYPE p SYSTEM "http://localhost:9/x.dtd"><package><name>a</name></package>'),
    manifest("torn", "<package><name>a</name>"),
    manifest("void", ""),
    manifest("nameless", "<package format='3'><version>1.0.0</version></package>"),
    manifest("another", "<launch/>"),
    manifest("deep", "<a>" * 50_000 + "</a>" * 50_000),
    manifest("wide", "<package><name>a</name>" + "<a/>" * 150_000 + "</package>"),
    manifest(
        "attributes",
        "<package " + " ".join(f'a{n}="x"' for n in range(200)) + "><name>attributes</name></package>",
        "invalid-manifest",
    ),
    manifest("large", "<package><name>a</name>" + "<!-- -->\n" * 600_000 + "</package>", "more than the limit"),
    manifest("coded", b'<?xml version="1.0" encoding="no-such-codec"?><package><name>a</name></package>'),
    manifest("binary", b"\x00\x01\x02"[1:]),
    manifest("formatted", '<package format="::error::&#10;x"><name>formatted</name></package>'),
    manifest("speaking", "<package><name>::error::a&#x202e;##[error]&lt;img&gt;@team|</name></package>", ""),
    manifest("xinclude", GOOD.format('<i:include xmlns:i="http://www.w3.org/2001/XInclude" href="/etc/passwd"/>')),
    manifest("twin1", GOOD.format("twin"), "invalid-manifest"),
    manifest("twin2", GOOD.format("twin"), ""),
    manifest(
        "condition",
        GOOD.format("condition").replace("</p", "<depend condition='((((((((('>x</depend></p"),
        "invalid-manifest",
    ),
]

CASES = [*NAMES, *LINKS, *CONTENTS, *MANIFESTS]


@pytest.fixture(scope="module")
def plain(new_trap: Callable[[], Trap]) -> tuple[Trap, Outcome]:
    trap = new_trap()
    for case in CASES:
        case.build(trap)
    return trap, trap.run()


@pytest.fixture(scope="module")
def in_git(plain: tuple[Trap, Outcome]) -> tuple[Trap, Outcome]:
    """The same tree as a work tree of git, half of it tracked."""
    trap, _ = plain
    trap.git("init", "-q", "-b", "main")
    trap.git("add", "--", "control.py", "*a*")
    trap.git("commit", "-q", "-m", "a change")
    return trap, trap.run()


@pytest.mark.parametrize("place", ["plain", "in_git"])
@pytest.mark.parametrize("case", CASES, ids=lambda case: ascii(case.path)[:60])
def test_tree(case: Case, place: str, request: pytest.FixtureRequest) -> None:
    trap, outcome = request.getfixturevalue(place)
    assert outcome.code == 1, outcome.stderr
    said = {rule for path, _, rule in outcome.findings() if path == case.path}
    notes = [message for path, message in outcome.notes() if path == case.path]
    if case.says:
        assert case.says in said or any(case.says in note for note in notes), (said, notes)
    else:
        assert not said and not notes, (said, notes)
    assert_harmless(trap, outcome)
    assert_the_rest_is_analysed(outcome)


@pytest.mark.parametrize("format", ["json", "sarif", "text"])
def test_what_is_printed_is_no_command(in_git: tuple[Trap, Outcome], format: str) -> None:
    """A log in which a runner looks for commands holds none, and machine formats stay what they are."""
    trap, outcome = in_git
    printed = trap.command("check", f"--output={format}")
    assert "##[" not in printed and not any(line.lstrip().startswith("::") for line in printed.splitlines())
    if format == "json":
        assert json.loads(printed) == outcome.report
