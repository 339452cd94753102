# SPDX-License-Identifier: Apache-2.0
"""HPL: what is read, as which tree and at which places; what is refused, where, and with which help."""

from __future__ import annotations

import pytest

from haros_ci.behaviour import tree
from haros_ci.behaviour.fault import HplFault
from haros_ci.behaviour.parser import parse_file, parse_property, read_file
from haros_ci.behaviour.text import canonical

#: Texts and what their canonical texts are.
READ = [
    ("globally: no /a", "globally: no /a"),
    ("  globally\n:\tno\r\n/a  ", "globally: no /a"),
    ("globally: some a/b within 1500 ms", "globally: some a/b within 1.5 s"),
    ("globally: no ~a within 0.2 s", "globally: no ~a within 200 ms"),
    ("globally: no /a within 1e3ms", "globally: no /a within 1 s"),
    ("globally: no /a within 0 s", "globally: no /a within 0 s"),
    ("globally: no /a within 10 hz", "globally: no /a within 100 ms"),
    ("after /p as P: /a causes (/b or /c as C)", "after /p as P: /a causes (/b or /c as C)"),
    ("after /p until (/q or /r): /b requires /a", "after /p until (/q or /r): /b requires /a"),
    ("until /q {x}: /a forbids /b", "until /q {x}: /a forbids /b"),
    ("globally: no /a {x=1 and y!=2 or not z>=3}", "globally: no /a {x = 1 and y != 2 or not z >= 3}"),
    ("globally: no /a {((x)) = (1)}", "globally: no /a {x = 1}"),
    ("globally: no /a {(x = 1 or y) and z}", "globally: no /a {(x = 1 or y) and z}"),
    ("globally: no /a {a - (b - c) - d = 2 * (x + 1)}", "globally: no /a {a - (b - c) - d = 2 * (x + 1)}"),
    ("globally: no /a {(x ** 2) ** 3 > x ** (2 ** 3)}", "globally: no /a {x ** 2 ** 3 > x ** (2 ** 3)}"),
    ("globally: no /a {-x ** -2 = --3}", "globally: no /a {-x ** -2 = --3}"),
    ("globally: no /a {(a implies b) implies (c iff d)}", "globally: no /a {a implies b implies (c iff d)}"),
    ("globally: no /a {x in ![0 to 1]! or y in [a.b to c[1].d]}", "globally: no /a {x in ![0 to 1]! or y in [a.b to c[1].d]}"),
    ("globally: no /a {x in {1,-2 , \"t\\\"u\"}}", "globally: no /a {x in {1, -2, \"t\\\"u\"}}"),
    ("globally: no /a {(forall i in v: v[@i] > 0) and y}", "globally: no /a {forall i in v: v[@i] > 0 and y}"),
    ("globally: no /a {forall i in v: (v[@i] > 0 and y)}", "globally: no /a {forall i in v: (v[@i] > 0 and y)}"),
    ("globally: no /a {max(x, 1, y + 2) > atan2(x, y)}", "globally: no /a {max(x, 1, y + 2) > atan2(x, y)}"),
    ("globally: no /a {x = PI or y = .5 or z = 1. or w = 1e-3}", "globally: no /a {x = PI or y = .5 or z = 1. or w = 1e-3}"),
    ("globally: no /a {(x = y) = True}", "globally: no /a {(x = y) = True}"),
    ("globally: no no", "globally: no no"),
    ("globally: causes causes forbids", "globally: causes causes forbids"),
    ("globally: nodes causes some_topic", "globally: nodes causes some_topic"),
    ("globally: no /a as as {to > 1 and in = 2 and x.not.E = 3}", "globally: no /a as as {to > 1 and in = 2 and x.not.E = 3}"),
    ("globally: no /a {not_ready or Effort > 1 or index = 3}", "globally: no /a {not_ready or Effort > 1 or index = 3}"),
    ("globally: no /a {b[0]!=1}", "globally: no /a {b[0] != 1}"),
    ("# one\nglobally: no # two\n /a { # three\n x } # four", "globally: no /a {x}"),
    ("# id: p # title: \"t\" globally: no /a", "globally: no /a"),
]  # fmt: skip


@pytest.mark.parametrize(("text", "expected"), READ)
def test_what_is_read(text: str, expected: str) -> None:
    assert canonical(parse_property(text)) == expected


@pytest.mark.parametrize(("_", "text"), READ)
def test_the_canonical_text_is_the_same_property(_: str, text: str) -> None:
    assert canonical(parse_property(text)) == text


#: Texts, the column of the fault, what is said and the help.
REFUSED = [
    ("", 1, "'globally', 'after' or 'until'", "begins as"),
    ("globaly: no /a", 1, "found 'globaly'", "'globally'"),
    ("globally no /a", 10, "expected ':'", ""),
    ("globally: /a", 13, "but the text ends here", ""),
    ("globally: /a cause /b", 14, "'causes', 'forbids' or 'requires'", "did you mean 'causes'?"),
    ("globally: no", 13, "a topic", ""),
    ("globally: no /a /b", 17, "the end of the property", ""),
    ("globally: no /a within 10", 26, "a unit: s, ms or hz", "100 ms"),
    ("globally: no /a within 10 msec", 27, "a unit", "'ms'"),
    ("globally: no /a within -1 s", 24, "a number", "not negative"),
    ("globally: no /a within 0 hz", 17, "a rate of 0", ""),
    ("globally: no /a within 1e999 s", 17, "more than 1,000,000,000,000 s", "leave the bound out"),
    ("globally: no /a within 1e-300 hz", 17, "more than", ""),
    ("globally: no (/a)", 17, "another event", "no parentheses"),
    ("globally: no (/a or)", 20, "a topic", ""),
    ("globally: no /a || /b", 17, "the end", "in parentheses: (/a or /b)"),
    ("globally: no /a {}", 18, "a condition", "leave the empty braces out"),
    ("globally: no /a {x = }", 22, "a value, a field or a condition", ""),
    ("globally: no /a {x = 1 = 2}", 24, "'}' or an operator", ""),
    ("globally: no /a {x == 1}", 20, "'}' or an operator", "write ="),
    ("globally: no /a {x && y}", 20, "operator", "'and'"),
    ("globally: no /a {!x}", 18, "a value", "'not'"),
    ("globally: no /a {x not in {1}}", 20, "operator", "not x in"),
    ("globally: no /a {x in 0 to 3}", 25, "operator", "[0 to 100]"),
    ("globally: no /a {x in [0, 3]}", 25, "'to'", "in braces: {0, 1}"),
    ("globally: no /a {x = 1, y = 2}", 23, "operator", "'and'"),
    ("globally: no /a {x = $A.y}", 22, "a value", "@A"),
    ("globally: no /a {x = @ A}", 22, "an alias after '@'", "without a space"),
    ("globally: no /a {x = 'a'}", 22, "a value", "double quotes"),
    ("globally: no /a {x = \"a}", 22, "has no end", "close it"),
    ("globally: no /a {x = lenght(y)}", 22, "no function lenght", "'len'"),
    ("globally: no /a {x} as A", 21, "the end", "before the predicate"),
    ("globally: no /a {forall @i in v: x}", 25, "the name of a variable", "without @"),
    ("globally: no /a {forall i of v: x}", 27, "'in'", ""),
    ("globally: no /a {x[0}", 21, "']'", ""),
    ("globally: no /a {(x}", 20, "')'", ""),
    ("globally: no /a {x.}", 20, "the name of a field", ""),
    ("# id: 3\nglobally: no /a", 7, "a name", ""),
    ("# id: a\n# id: b\nglobally: no /a", 1, "a second 'id'", ""),
    ("# title: t\nglobally: no /a", 10, "a text in double quotes", ""),
    ("globally: no /a {" + "(" * 40 + "x" + ")" * 40 + "}", 48, "nested deeper than 30", "apart"),
    ("globally: no /a {x" + " + x" * 130 + " > 0}", 18, "120 operators", "apart"),
    ("globally: no /a {x in {" + "1," * 5000 + "1}}", 9999, "", ""),
    ("globally: no /a {x > 1" + "0" * 300 + "}", 22, "more than 300", ""),
    ("globally: no /a" + " " * 20_000, 1, "more than 20000 characters", "apart"),
]  # fmt: skip


@pytest.mark.parametrize(("text", "column", "said", "help"), REFUSED)
def test_what_is_refused(text: str, column: int, said: str, help: str) -> None:
    with pytest.raises(HplFault) as caught:
        parse_property(text)
    assert said in caught.value.message
    assert help in caught.value.help
    assert caught.value.at.column == column or column == 9999


def test_places() -> None:
    text = "after /p as P:\n  no /a as A {x.y = @P.z[0] + 1}\n  within 100 ms"
    found = parse_property(text)

    def at(place: tree.Place) -> str:
        assert (place.line, place.column) == (
            text.count("\n", 0, place.offset) + 1,
            place.offset - text.rfind("\n", 0, place.offset),
        )
        return text[place.offset : place.end]

    (activator,), (event,) = found.scope.activator, found.pattern.behaviour
    assert at(found.at) == text
    assert at(found.scope.at) == "after /p as P"
    assert at(found.pattern.at).startswith("no /a")
    assert at(activator.topic_at) == "/p"
    assert event.alias_at is not None and at(event.alias_at) == "A"
    assert event.predicate is not None and at(event.predicate.at) == "x.y = @P.z[0] + 1"
    assert found.pattern.bound is not None and at(found.pattern.bound.at) == "within 100 ms"
    texts = [at(each.at) for each in tree.parts(event.predicate)]
    assert texts == ["x.y = @P.z[0] + 1", "x.y", "x", "@P.z[0] + 1", "@P.z[0]", "@P.z", "@P", "0", "1"]
    names = [at(each.name_at) for each in tree.parts(event.predicate) if isinstance(each, tree.Field)]
    assert names == ["y", "x", "z"]


def test_metadata() -> None:
    text = '# id: one\n# title: "T \\" U"\n# notes: "n"\n# see: other\n# haros: ignore[x]\nglobally: no /a'
    found = parse_property(text)
    assert [(each.key, each.value) for each in found.metadata] == [
        ("id", "one"), ("title", 'T " U'), ("notes", "n"), ("see", "other"),
    ]  # fmt: skip
    assert found.at.line == 6


def test_a_file_is_several_properties() -> None:
    text = "# a comment: no metadata\nglobally: no /a\nafter /b:\n  no /c\n\n# id: d\nuntil /d: some /e"
    assert [canonical(each) for each in parse_file(text)] == [
        "globally: no /a", "after /b: no /c", "until /d: some /e",
    ]  # fmt: skip
    assert parse_file("") == parse_file("# nothing") == ()


def test_a_fault_in_a_file_hides_no_other_property() -> None:
    text = '# id: a\nglobally: no /a {x >}\n\n# id: b\nglobally: no /b\nglobally no /c\n# title: "d"\nafter /x:\n no /d\nglobally: /e'
    found, faults = read_file(text)
    assert [canonical(each) for each in found] == ["globally: no /b", "after /x: no /d"]
    assert [(fault.at.line, fault.at.column) for fault in faults] == [(2, 21), (6, 10), (10, 13)]


@pytest.mark.parametrize(
    "text",
    ["#", "# id", "# id:", "globally", "globally:", "(", "{" * 100, "\0", "\ufeffglobally: no /a {", "globally: no /é"],
)
def test_any_text_has_an_answer(text: str) -> None:
    with pytest.raises(HplFault):
        parse_property(text)
    read_file(text)
