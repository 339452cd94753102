# SPDX-License-Identifier: Apache-2.0
"""Identities, and the fingerprints that carry them."""

from __future__ import annotations

import pytest

from haros_ci.model.location import Location
from haros_ci.results.comments import bare
from haros_ci.results.fingerprint import (
    EDGE,
    fingerprint,
    message_template,
    partial_fingerprints,
    restore_identity,
    text_hashes,
)
from haros_ci.results.line_hash import github_line_hashes
from haros_ci.results.result import Identity, Result, Run, Tool
from haros_ci.results.rule import Level

TEXT = """\
#include <string>
namespace nav
{
void Ctl::init(int speed)
{
  int limit = speed;
  publish(limit);  // now
  return;
}
}
"""


def identities(text: str, *lines: int | None, language: str = "cpp", path: str = "a.cpp") -> list[Identity]:
    results = tuple(Result("t", "r", Level.NOTE, "Bad 'x' 3.", Location(path, line)) for line in lines)
    (run,) = fingerprint((Run(Tool("t"), results=results),), lambda _: text, lambda _: language)
    found = [result.identity for result in run.results]
    assert None not in found
    return [identity for identity in found if identity]


def test_an_identity() -> None:
    (here,) = identities(TEXT, 6)
    assert (here.scope, here.template, here.occurrence) == ("nav::Ctl::init", "Bad '_' 0", 1)
    assert here.snippet == "  int limit = speed;"
    assert here.line_hash == github_line_hashes(TEXT, {6})[6]
    assert len({here.text, here.shape, here.before, here.after}) == 4
    assert all(len(value) == 16 for value in (here.text, here.shape, here.before, here.after))


SAME = [
    ("indentation", "  int limit = speed;", "\tint  limit=speed ;"),
    ("line end", "publish(limit);  // now\n", "publish(limit);  // now\r\n"),
    ("trailing comment", "speed;\n", 'speed;  // "why"\n'),
    ("block comment", "speed;\n", "speed; /* why */\n"),
    ("byte-order mark", "#include", "\ufeff#include"),
    ("blank lines", "\n  int limit", "\n\n\n  int limit"),
    ("neighbour's comment", "  // now", ""),
    ("beyond the context", "#include <string>", "#include <vector>"),
]
DIFFERENT = [
    ("text", "limit = speed;", "limit = speed + 1;", ["text", "shape"]),
    ("name", "limit = speed;", "limit = haste;", ["text"]),
    ("a line above", "{\n  int", "{\n  go();\n  int", ["before"]),
    ("a line below", "  return;", "  go();", ["after"]),
    ("scope", "Ctl::init", "Ctl::start", ["scope", "before"]),
]


@pytest.mark.parametrize(("name", "old", "new"), SAME, ids=[case[0] for case in SAME])
def test_what_does_not_matter(name: str, old: str, new: str) -> None:
    changed = TEXT.replace(old, new, 1)
    line = next(n for n, text in enumerate(changed.split("\n"), 1) if "limit=" in text.replace(" ", ""))
    (before,), (after,) = identities(TEXT, 6), identities(changed, line)
    for field in ("scope", "text", "shape", "before", "after", "template", "occurrence"):
        assert getattr(before, field) == getattr(after, field), field


@pytest.mark.parametrize(("name", "old", "new", "fields"), DIFFERENT, ids=[case[0] for case in DIFFERENT])
def test_what_does(name: str, old: str, new: str, fields: list[str]) -> None:
    changed = TEXT.replace(old, new, 1)
    line = next(n for n, text in enumerate(changed.split("\n"), 1) if "limit = " in text)
    (before,), (after,) = identities(TEXT, 6), identities(changed, line)
    names = ("scope", "text", "shape", "before", "after")
    assert [f for f in names if getattr(before, f) != getattr(after, f)] == fields


def test_copies_are_counted() -> None:
    text = "void f() {\n  a(b);\n  a(b);\n}\nvoid g() {\n  a(b);\n}\n"
    assert [i.occurrence for i in identities(text, 3, 2, 6, 2)] == [3, 1, 1, 2]


def test_edges_and_lines_that_are_not_there() -> None:
    first, last = identities("one_long_line(here)\ntwo_long_line(here)", 1, 2, language="")
    assert (first.before, last.after) == (EDGE, EDGE)
    whole, beyond = identities(TEXT, None, 99)
    assert (whole.text, whole.template, whole.line_hash) == ("", "Bad 'x' 0", "")
    assert (beyond.text, beyond.before, beyond.line_hash) == ("", "", "")
    (braces,) = identities("x;\n}\n}\n}\ncall_me(now);\n}\n}\n}\n", 5, language="")
    assert (braces.before, braces.after) == ("", "")
    assert identities("", 1)[0].occurrence == 1


def test_the_scope_is_our_own_in_code_and_the_tool_s_elsewhere() -> None:
    result = Result("t", "r", Level.NOTE, "Bad.", Location("a.cpp", 6), scope="Ctl::init(int)")
    (run,) = fingerprint((Run(Tool("t"), results=(result,)),), lambda _: TEXT, lambda _: "cpp")
    assert run.results[0].identity is not None
    assert (run.results[0].identity.scope, run.results[0].scope) == ("nav::Ctl::init", "Ctl::init(int)")
    (run,) = fingerprint((Run(Tool("t"), results=(result,)),), lambda _: TEXT, lambda _: "yaml")
    assert run.results[0].identity is not None
    assert run.results[0].identity.scope == "Ctl::init(int)"


TEMPLATES = [
    ("Unused variable 'x'", "Unused variable 'y'"),
    ("Line 12 of 300.", "Line 7 of 4"),
    ('Use "a" or `b`.', 'Use "c" or `d`.'),
    ("Too long (121/120)", "Too long (140/120)"),
]
NOT_TEMPLATES = [
    ("Unused variable 'x'", "Unused argument 'x'"),
    ("Don't use it, it's bad", "Don't read it, it's bad"),
    ("Use int16_t", "Use int32_t"),
    ("a", "b"),
]


@pytest.mark.parametrize(("one", "other"), TEMPLATES)
def test_one_template(one: str, other: str) -> None:
    assert message_template(one) == message_template(other)


@pytest.mark.parametrize(("one", "other"), NOT_TEMPLATES)
def test_two_templates(one: str, other: str) -> None:
    assert message_template(one) != message_template(other)


@pytest.mark.parametrize(
    ("line", "kind", "expected"),
    [
        ("  a = b;  // c", "c", "a=b;"),
        ('s = "// no";  /* c */ t', "c", 's="//no";t'),
        ("c = '\"'; // d", "c", "c='\"';"),
        ("  // alone", "c", "//alone"),
        ("x = '#'  # y", "python", "x='#'"),
        ("# alone", "python", "#alone"),
        ("key: a#b # c", "yaml", "key:a#b"),
        ("it: don't # c", "yaml", "it:don't"),
        ('set(A "#b") # c', "cmake", 'set(A"#b")'),
        ("uint8 X=1 # c", "interface", "uint8X=1"),
        ("string S=a # b", "interface", "stringS=a#b"),
        ("<a/> <!-- b -->", "xml", "<a/>"),
        ("a // b # c", "", "a//b#c"),
    ],
)
def test_bare_lines(line: str, kind: str, expected: str) -> None:
    assert bare(line, kind) == expected


def test_fingerprints_restore_the_identity() -> None:
    (run,) = fingerprint(
        (Run(Tool("t"), results=(Result("t", "r", Level.NOTE, "Bad 'x'.", Location("a.cpp", 6)),)),),
        lambda _: TEXT,
        lambda _: "cpp",
    )
    (result,) = run.results
    values = partial_fingerprints(result)
    assert set(values) == {
        "primaryLocationLineHash", "harosCi/v1", "harosCiScope/v1", "harosCiText/v1", "harosCiShape/v1",
        "harosCiBefore/v1", "harosCiAfter/v1",
    }  # fmt: skip
    assert result.identity is not None
    restored = restore_identity(values, scope="nav::Ctl::init", template="Bad '_'", snippet=result.identity.snippet)
    assert restored == result.identity


@pytest.mark.parametrize("values", [{}, {"primaryLocationLineHash": "a:1"}, {"harosCi/v1": "x"}, {"harosCi/v1": "x:²"}])
def test_foreign_fingerprints_restore_nothing(values: dict[str, str]) -> None:
    assert restore_identity(values, scope="", template="", snippet="") is None


def test_fingerprints_hold_no_line_numbers() -> None:
    def made(text: str, line: int) -> dict[str, str]:
        results = (Result("t", "r", Level.NOTE, "Bad.", Location("a.cpp", line)),)
        return partial_fingerprints(
            fingerprint((Run(Tool("t"), results=results),), lambda _: text, lambda _: "cpp")[0].results[0]
        )

    assert made(TEXT, 6) == made("\n" * 40 + TEXT, 46)
    assert partial_fingerprints(Result("t", "r", Level.NOTE, "Bad.", Location("a.cpp", 6))) == {}


def test_text_hashes_know_every_line() -> None:
    (here,) = identities(TEXT, 6)
    assert here.text in text_hashes(TEXT, "a.cpp", "cpp")
    assert here.text not in text_hashes(TEXT.replace("limit", "bound"), "a.cpp", "cpp")
