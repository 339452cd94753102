# SPDX-License-Identifier: Apache-2.0
"""Findings before and after a change: which are old, which new, which gone; against a revision and against files."""

from __future__ import annotations

import json
import re
from collections import Counter
from dataclasses import replace

import pytest

from haros_ci.model.location import Location
from haros_ci.results.compact import read_compact, write_compact
from haros_ci.results.fingerprint import fingerprint, partial_fingerprints
from haros_ci.results.known import ComparedFiles, KnownFinding, known_from_results, known_from_sarif
from haros_ci.results.matching import match
from haros_ci.results.result import BaselineState, Identity, Result, Run, Tool
from haros_ci.results.rule import Level
from haros_ci.results.sarif_reader import read_sarif

Files = dict[str, str]

PATTERNS = {
    "uses-eval": (re.compile(r"\beval\((\w*)"), "Use of eval on '{0}'."),
    "unused-variable": (re.compile(r"\bint (unused\w*)"), "Unused variable '{0}'."),
    "long-function": (re.compile(r"\b(\w+)\(.*//! (\d+)"), "Function '{0}' has {1} lines."),
}


def language(path: str) -> str:
    return {"py": "python", "cpp": "cpp", "hpp": "cpp", "xml": "package"}[path.rpartition(".")[2]]


def lint(files: Files, rules: tuple[str, ...] = tuple(PATTERNS)) -> tuple[Result, ...]:
    """A toy linter: one result for each match of a rule's pattern."""
    found = []
    for path, text in files.items():
        for number, line in enumerate(re.split(r"\r\n|\r|\n", text.removeprefix("\ufeff")), 1):
            for rule in rules:
                for hit in PATTERNS[rule][0].finditer(line):
                    message = PATTERNS[rule][1].format(*hit.groups())
                    value = float(hit[2]) if rule == "long-function" else None
                    place = Location(path, number, hit.start() + 1)
                    found.append(Result("toy", rule, Level.WARNING, message, place, value=value))
    run = Run(Tool("toy"), results=tuple(sorted(found, key=lambda r: r.sort_key)), analysed=frozenset(files))
    return fingerprint((run,), files.__getitem__, language)[0].results


def sarif(results: tuple[Result, ...]) -> bytes:
    """A log as the report writes it, reduced to what identities need."""
    entries = [
        {
            "ruleId": r.rule,
            "level": r.level.value,
            "message": {"text": r.message},
            "locations": [
                {
                    "physicalLocation": {
                        "artifactLocation": {"uri": r.location.path},
                        "region": {"startLine": r.location.line},
                    },
                    "logicalLocations": [{"fullyQualifiedName": r.identity.scope if r.identity else ""}],
                }
            ],
            "partialFingerprints": partial_fingerprints(r),
            "properties": {} if r.value is None else {"value": r.value},
        }
        for r in results
    ]
    return json.dumps(
        {"version": "2.1.0", "runs": [{"tool": {"driver": {"name": "toy"}}, "results": entries}]}
    ).encode()


KINDS = ("revision", "sarif", "compact")


def known(kind: str, results: tuple[Result, ...]) -> tuple[KnownFinding, ...]:
    if kind == "sarif":
        return known_from_sarif(read_sarif(sarif(results), "old.sarif"))
    if kind == "compact":
        return read_compact(write_compact(known_from_results(results)).encode(), "old.jsonl")
    return known_from_results(results)


def compare(kind: str, before: Files, after: Files, renames: dict[str, str] | None = None) -> tuple[Result, ...]:
    sides = ComparedFiles(
        head=lambda path: after.get(path, ""),
        base=(lambda path: before.get(path, "")) if kind == "revision" else None,
        language=language,
        exists=after.__contains__,
        analysed=lambda tool, path: path in after,
        renames=(renames or {}) if kind == "revision" else {},
    )
    return match(lint(after), known(kind, lint(before)), sides)


def verdicts(results: tuple[Result, ...]) -> str:
    """``2 O 1 N``: old, new, absent."""
    letters = {BaselineState.NEW: "N", BaselineState.ABSENT: "A"}
    counts = Counter(letters.get(r.state, "O") for r in results if r.state)
    return " ".join(f"{counts[letter]} {letter}" for letter in "ONA" if counts[letter])


BASE = """\
#include <string>

namespace walker
{
int start(int a)
{
  int first = a;
  first += compute(a);
  int x = eval(first);
  publish(x);
  return first;
}

int stop(int b)
{
  int second = b;
  second -= compute(b);
  publish(second);
  return second;
}
}  // namespace walker
"""

OTHER = """\
namespace walker
{
int turn(int angle)
{
  rotate(angle);
  return angle;
}
}
"""

LINE = "  int x = eval(first);\n"
START = BASE[BASE.index("int start") : BASE.index("\nint stop")]
STOP = BASE[BASE.index("int stop") : BASE.index("}  // namespace")]


def edit(*changes: tuple[str, str], text: str = BASE) -> Files:
    for old, new in changes:
        assert text.count(old) >= 1, old
        text = text.replace(old, new, 1)
    return {"a.cpp": text}


def whole(text: str) -> Files:
    return {"a.cpp": text}


UNUSED = BASE.replace(LINE, "  int unused_a = 3;\n")
TWICE = BASE.replace(LINE, LINE + "  publish(first);\n  check(first);\n  check(x);\n" + LINE)
LONG = BASE.replace("int start(int a)\n", "int start(int a) //! 31\n").replace(LINE, "")
FLOW = "  int x = combine(eval(first), second_argument, third_argument);\n"

#: name, before, after, verdicts
CASES: list[tuple[str, Files, Files, str]] = [
    ("1 one line above", whole(BASE), edit(("#include", "// hello\n#include")), "1 O"),
    ("1 a hundred lines above", whole(BASE), edit(("#include", "// hello\n" * 100 + "#include")), "1 O"),
    ("2 lines deleted above", whole(BASE), edit(("#include <string>\n\n", "")), "1 O"),
    ("3 block indented", whole(BASE), edit((START, START.replace("\n  ", "\n      "))), "1 O"),
    ("4 CRLF", whole(BASE), whole(BASE.replace("\n", "\r\n")), "1 O"),
    ("4 tabs", whole(BASE), whole(BASE.replace("  ", "\t")), "1 O"),
    ("4 byte-order mark", whole(BASE), whole("\ufeff" + BASE), "1 O"),
    ("5 trailing comment", whole(BASE), edit(("eval(first);", "eval(first);  // why")), "1 O"),
    ("6 line above edited", whole(BASE), edit(("first += compute(a)", "first += measure(a) * 2")), "1 O"),
    ("6 line below edited", whole(BASE), edit(("publish(x)", "publish(x + 1, now())")), "1 O"),
    ("7 reflowed, finding on the first line", whole(BASE.replace(LINE, FLOW)),
     edit((LINE, "  int x = combine(eval(first),\n    second_argument,\n    third_argument);\n")), "1 O"),
    ("7 reflowed, finding on the second line", whole(BASE.replace(LINE, FLOW)),
     edit((LINE, "  int x = combine(\n    eval(first),\n    second_argument, third_argument);\n")), "1 O"),
    ("8 local renamed", whole(BASE), whole(BASE.replace("first", "initial")), "1 O"),
    ("8 named variable renamed", whole(UNUSED), whole(UNUSED.replace("unused_a", "unused_b")), "1 O"),
    ("9 function renamed", whole(BASE), whole(BASE.replace("start", "begin")), "1 O"),
    ("9 namespace renamed", whole(BASE), whole(BASE.replace("walker", "runner")), "1 O"),
    ("9 measured function renamed", whole(LONG), whole(LONG.replace("start", "begin")), "1 O"),
    ("9 measured function gets a parameter", whole(LONG), whole(LONG.replace("(int a)", "(int a, int c)")), "1 O"),
    ("10 file renamed", whole(BASE), {"b.cpp": BASE}, "1 O"),
    ("11 directory renamed", {"old/a.cpp": BASE}, {"new/a.cpp": BASE}, "1 O"),
    ("12 renamed and edited", whole(BASE),
     {"b.cpp": BASE.replace(STOP, "int halt()\n{\n  return brake();\n}\n").replace("publish(x)", "send(x, 1)")}, "1 O"),
    ("13 function moved down", whole(BASE), edit((START, ""), (STOP, STOP + "\n" + START)), "1 O"),
    ("14 function moved to another file", {**whole(BASE), "b.cpp": OTHER},
     {**edit((START, "")), "b.cpp": OTHER.replace("{\n", "{\n" + START, 1)}, "1 O"),
    ("15 file copied", whole(BASE), {**whole(BASE), "b.cpp": BASE}, "1 O 1 N"),
    ("15 file copied and the original's function renamed", whole(BASE),
     {**whole(BASE.replace("start", "begin")), "b.cpp": BASE}, "1 O 1 N"),
    ("16 function copied below", whole(BASE), edit((STOP, START.replace("start", "again") + STOP)), "1 O 1 N"),
    ("16 function copied above", whole(BASE), edit((START, START.replace("start", "again") + START)), "1 O 1 N"),
    ("17 functions swapped", edit((STOP, STOP.replace("  publish", LINE + "  publish"))),
     whole(BASE[: BASE.index("int start")] + STOP.replace("  publish", LINE + "  publish") + START + "}\n"), "2 O"),
    ("18 line duplicated below", whole(BASE), edit((LINE, LINE * 2)), "1 O 1 N"),
    ("19 line duplicated above", whole(BASE), edit(("  int first = a;\n", LINE + "  int first = a;\n")), "1 O 1 N"),
    ("20 one of two mended", whole(TWICE), whole(TWICE.replace(LINE, "", 1)), "1 O 1 A"),
    ("20 the other of two mended", whole(TWICE), whole((LINE + "|").join(TWICE.split(LINE)[:2]).replace("|", "")
     + TWICE.split(LINE)[2]), "1 O 1 A"),
    ("21 one mended, one added elsewhere", whole(BASE),
     edit((LINE, ""), ("  second -= compute(b);\n", "  second -= eval(b);\n")), "1 N 1 A"),
    ("21 one mended in place, another added in the same function", whole(UNUSED),
     edit(("unused_a = 3", "used = 3"), ("  first += compute(a);\n", "  first += 1;\n  int unused_b;\n  note();\n"),
          ("  return first;\n", "  return first + used;\n"), text=UNUSED), "1 N 1 A"),
    ("21 one mended elsewhere, one added beside it", whole(UNUSED),
     {"a.cpp": UNUSED.replace("  int unused_a = 3;\n", "  int unused_a = 3; // NOW USED\n  int unused_b = 4;\n")
      .replace("int unused_a", "int used_a")}, "1 N 1 A"),
    ("21 rewritten: another text, about another name", whole(UNUSED),
     edit(("int unused_a = 3;", "int unused_b = measure(a) - first;"), text=UNUSED), "1 N 1 A"),
    ("21 rewritten: shorter, about another name", whole(UNUSED.replace("= 3", "= compute(a, now())")),
     edit(("int unused_a = compute(a, now());", "int unused_b;"), text=UNUSED.replace("= 3", "= compute(a, now())")), "1 N 1 A"),
    ("8 rewritten, about the same name", whole(UNUSED),
     edit(("int unused_a = 3;", "int unused_a = measure(a) - first;"), text=UNUSED), "1 O"),
    ("8 named variable renamed and its value changed", whole(UNUSED),
     edit(("int unused_a = 3;", "int unused_b = 4;"), text=UNUSED), "1 O"),
    ("8 named variable renamed and an argument added", whole(UNUSED.replace("= 3", "= compute(a)")),
     edit(("int unused_a = 3;", "int unused_b = compute(a, 1);"), text=UNUSED), "1 O"),
    ("22 mended in f, added in g", whole(BASE),
     edit((LINE, ""), ("  publish(second);\n", LINE + "  publish(second);\n")), "1 N 1 A"),
    ("23 another rule fires on the line", whole(BASE), edit(("int x = eval", "int unused_x = eval")), "1 O 1 N"),
    ("24 two rules on a line, one mended", edit(("int x = eval", "int unused_x = eval")), whole(BASE), "1 O 1 A"),
    ("30 metric a little worse", whole(LONG), whole(LONG.replace("31", "32")), "1 O"),
    ("30 metric much worse within its band", whole(LONG), whole(LONG.replace("31", "60")), "1 O"),
    ("34 generated path changes", {"build-1/gen.cpp": BASE}, {"build-2/gen.cpp": BASE}, "1 O"),
]  # fmt: skip

#: What files of known findings answer otherwise, because they have no text of the past to compare lines with.
WITHOUT_BASE = {
    "7 reflowed, finding on the second line": "1 N 1 A",
    "21 one mended elsewhere, one added beside it": "1 O",
    "8 named variable renamed and an argument added": "1 N 1 A",
}
#: What a compact file answers otherwise, because it holds no names.
WITHOUT_NAMES = {
    "21 rewritten: another text, about another name": "1 O",
    "21 rewritten: shorter, about another name": "1 O",
    "8 named variable renamed and an argument added": "1 O",
}


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize(("name", "before", "after", "expected"), CASES, ids=[case[0] for case in CASES])
def test_mutations(kind: str, name: str, before: Files, after: Files, expected: str) -> None:
    if kind != "revision":
        expected = WITHOUT_BASE.get(name, expected)
    if kind == "compact":
        expected = WITHOUT_NAMES.get(name, expected)
    found = compare(kind, before, after)
    assert verdicts(found) == expected, [(str(r.location), r.state, r.reason) for r in found]


def sides(after: Files, **changes: object) -> ComparedFiles:
    return replace(
        ComparedFiles(head=lambda path: after.get(path, ""), language=language, exists=after.__contains__),
        **changes,  # type: ignore[arg-type]
    )


def states(results: tuple[Result, ...]) -> list[tuple[str, str]]:
    return [(str(r.location.path), r.state.value if r.state else "") for r in results]


@pytest.mark.parametrize("kind", KINDS)
def test_the_copy_is_the_new_one(kind: str) -> None:
    found = compare(kind, whole(BASE), edit((LINE, LINE * 2)))
    assert [(r.location.line, r.state) for r in found] == [(9, BaselineState.UNCHANGED), (10, BaselineState.NEW)]
    found = compare(kind, whole(BASE), {**whole(BASE), "0.cpp": BASE})
    assert states(found) == [("0.cpp", "new"), ("a.cpp", "unchanged")]
    found = compare(kind, whole(BASE), edit((START, START.replace("start", "again") + START)))
    assert [r.state for r in found] == [BaselineState.NEW, BaselineState.UNCHANGED]


UPDATED = [
    ("text", whole(BASE), whole(BASE.replace("first", "initial")), {"revision", "sarif", "compact"}),
    ("file", whole(BASE), {"b.cpp": BASE}, {"revision", "sarif", "compact"}),
    ("value", whole(LONG), whole(LONG.replace("31", "32")), {"revision", "sarif"}),
]
UNCHANGED = [
    ("line", whole(BASE), edit(("#include", "\n\n#include"))),
    ("indentation", whole(BASE), whole(BASE.replace("  ", "\t"))),
    ("comment", whole(BASE), edit(("eval(first);", "eval(first);  // why"))),
    ("neighbours", whole(BASE), edit(("publish(x)", "send(x)"), ("+= compute", "-= compute"))),
    ("scope", whole(BASE), whole(BASE.replace("int start", "int begin"))),
    ("nothing", whole(BASE), whole(BASE)),
]


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize(("name", "before", "after", "kinds"), UPDATED, ids=[case[0] for case in UPDATED])
def test_updated(kind: str, name: str, before: Files, after: Files, kinds: set[str]) -> None:
    (found,) = compare(kind, before, after)
    assert (found.state is BaselineState.UPDATED) == (kind in kinds)
    assert (f"{name} " in found.reason.partition(";")[2]) == (kind in kinds)


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize(("name", "before", "after"), UNCHANGED, ids=[case[0] for case in UNCHANGED])
def test_unchanged(kind: str, name: str, before: Files, after: Files) -> None:
    (found,) = compare(kind, before, after)
    assert found.state is BaselineState.UNCHANGED, found.reason


def test_level_and_message_of_an_upgraded_tool() -> None:
    old = known_from_results(lint(whole(BASE)))
    new = tuple(replace(r, level=Level.ERROR) for r in lint(whole(BASE)))
    (found,) = match(new, old, sides(whole(BASE)))
    assert (found.state, found.reason) == (BaselineState.UPDATED, "same text and scope (line 9); level warning → error")
    run = Run(Tool("toy"), results=tuple(replace(r, message="eval is evil", identity=None) for r in lint(whole(BASE))))
    (found,) = match(fingerprint((run,), whole(BASE).__getitem__, language)[0].results, old, sides(whole(BASE)))
    assert (found.state, found.reason) == (BaselineState.UPDATED, "same text and scope (line 9); message changed")


@pytest.mark.parametrize(
    "moved",
    [{"column": None}, {"column": 7}, {"column": 8, "end_line": 9, "end_column": 3}],
    ids=["no column", "other column", "end"],
)
def test_columns_do_not_matter(moved: dict[str, int]) -> None:
    results = lint(whole(BASE))
    new = tuple(replace(r, location=replace(r.location, **moved)) for r in results)
    assert [r.state for r in match(new, known_from_results(results), sides(whole(BASE)))] == [BaselineState.UNCHANGED]


def test_rule_under_its_old_name() -> None:
    old = tuple(replace(k, rule="W123") for k in known_from_results(lint(whole(BASE))))
    assert verdicts(match(lint(whole(BASE)), old, sides(whole(BASE)))) == "1 N 1 A"
    known_as = sides(whole(BASE), aliases={"toy:W123": "toy:uses-eval"})
    assert verdicts(match(lint(whole(BASE)), old, known_as)) == "1 O"


def file_level(path: str, *messages: str) -> tuple[Result, ...]:
    run = Run(Tool("toy"), results=tuple(Result("toy", "manifest", Level.WARNING, m, Location(path)) for m in messages))
    return fingerprint((run,), lambda _: "<package/>", language)[0].results


FILE_LEVEL = [
    ("unrelated edit", file_level("p/package.xml", "No licence."), file_level("p/package.xml", "No licence."), "1 O"),
    ("a number", file_level("p/package.xml", "601 lines."), file_level("p/package.xml", "640 lines."), "1 O"),
    ("package moved", file_level("p/package.xml", "No licence."), file_level("q/package.xml", "No licence."), "1 O"),
    ("another name", file_level("p/package.xml", "'a' is missing."),
     file_level("p/package.xml", "'b' is missing."), "1 N 1 A"),
    ("one of two", file_level("p/package.xml", "'a' is missing.", "'b' is missing."),
     file_level("p/package.xml", "'b' is missing."), "1 O 1 A"),
]  # fmt: skip


@pytest.mark.parametrize(("name", "before", "after", "expected"), FILE_LEVEL, ids=[case[0] for case in FILE_LEVEL])
def test_findings_without_line(name: str, before: tuple[Result, ...], after: tuple[Result, ...], expected: str) -> None:
    there = {r.location.path: "<package/>" for r in after}
    for old in (known_from_results(before), read_compact(write_compact(known_from_results(before)).encode(), "b")):
        assert verdicts(match(after, old, sides(there))) == expected


def test_first_line_of_the_file() -> None:
    def run(text: str) -> tuple[Result, ...]:
        result = Result("toy", "no-docstring", Level.NOTE, "Missing module docstring.", Location("a.py", 1, 1))
        return fingerprint((Run(Tool("toy"), results=(result,)),), lambda _: text, language)[0].results

    old, new = "import os\n\nos.sep\n", "import abc\nimport os\n\nos.sep\n"
    assert verdicts(match(run(new), known_from_results(run(old)), sides({"a.py": new}))) == "1 O"


def test_partial_runs_leave_other_files_alone() -> None:
    before = {**whole(BASE), "b.cpp": BASE}
    old = known_from_results(lint(before))
    only_b = sides(before, analysed=lambda tool, path: path == "b.cpp", partial=True)
    assert states(match(lint({"b.cpp": BASE}), old, only_b)) == [("b.cpp", "unchanged")]
    assert states(match((), old, only_b)) == [("b.cpp", "absent")]
    gone = sides({"b.cpp": BASE}, analysed=lambda tool, path: path == "b.cpp", partial=True)
    assert states(match(lint({"b.cpp": BASE}), old, gone)) == [("b.cpp", "unchanged")]
    assert states(match(lint({"b.cpp": BASE}), old, replace(gone, partial=False))) == [
        ("b.cpp", "unchanged"),
        ("a.cpp", "absent"),
    ]


def test_a_copy_from_an_unanalysed_file_is_new() -> None:
    old = known_from_results(lint(whole(BASE)))
    copied = {**whole(BASE), "b.cpp": BASE}
    only_b = sides(copied, analysed=lambda tool, path: path == "b.cpp", partial=True)
    assert states(match(lint({"b.cpp": BASE}), old, only_b)) == [("b.cpp", "new")]


def test_suppressed_findings_are_not_known() -> None:
    from haros_ci.results.result import Suppression

    silent = tuple(replace(r, suppressions=(Suppression("inSource"),)) for r in lint(whole(BASE)))
    assert known_from_results(silent) == ()
    assert verdicts(match(lint(whole(BASE)), known_from_results(silent), sides(whole(BASE)))) == "1 N"
    (found,) = match(silent, known_from_results(lint(whole(BASE))), sides(whole(BASE)))
    assert (found.state, len(found.suppressions)) == (BaselineState.UNCHANGED, 1)


FURTHER = "new: every earlier 'uses-eval' with this text stands elsewhere or is matched to another result"


@pytest.mark.parametrize(
    ("after", "reason"),
    [
        (edit(("#include", "\n#include")), "same text at its mapped line (9 → 10)"),
        (whole(BASE), "same text at its mapped line (line 9)"),
        (edit((LINE, LINE * 2)), FURTHER),
        (edit(("compute(b)", "eval(b)")), "new: no earlier 'uses-eval' in this file has this text"),
        ({**whole(BASE), "c.cpp": OTHER.replace("rotate(", "eval(")}, "new: no earlier 'uses-eval' in this file"),
        (edit(("int x", "int unused_x")), "new: the baseline has no 'unused-variable'"),
        (edit((LINE, "")), "gone: 'uses-eval' is no longer found here"),
        ({}, "gone with its file"),
        ({"b.cpp": BASE}, "moved: same text and scope in another file (a.cpp:9 → b.cpp:9); file changed"),
    ],
)  # fmt: skip
def test_every_verdict_says_why(after: Files, reason: str) -> None:
    assert reason in [r.reason for r in compare("revision", whole(BASE), after)]


def test_a_rename_map_carries_findings_of_edited_files() -> None:
    after = {"b.cpp": BASE.replace("eval(first)", "eval(second)").replace("start", "begin")}
    assert verdicts(compare("revision", whole(BASE), after, {"a.cpp": "b.cpp"})) == "1 O"


def test_order_of_the_results_does_not_matter() -> None:
    before = {f"{n}.cpp": BASE for n in range(4)}
    after = {f"{n}.cpp": BASE.replace(LINE, LINE * 2) for n in range(4)}
    old, new = known_from_results(lint(before)), lint(after)
    here = {r.location: r.state for r in match(new, old, sides(after))}
    there = {r.location: r.state for r in match(new[::-1], old[::-1], sides(after))}
    assert here == there


def test_ten_thousand_findings() -> None:
    """Half of them alike, all moved down by two lines, one added."""

    def made(shift: int, count: int) -> list[Result]:
        return [
            Result("toy", f"rule-{n % 7}", Level.NOTE, "Bad.", Location("a.cpp", n + shift),
                   identity=Identity(scope="f", text=f"{0 if n % 2 else n:016x}", template="Bad.", occurrence=n))
            for n in range(1, count + 1)
        ]  # fmt: skip

    old = known_from_results(made(0, 10_000))
    for past in (old, tuple(replace(known, line=None) for known in old)):
        found = match(made(2, 10_001), past, sides({"a.cpp": ""}))
        assert Counter(r.state for r in found) == {BaselineState.UNCHANGED: 10_000, BaselineState.NEW: 1}
        assert found[-1].state is BaselineState.NEW
