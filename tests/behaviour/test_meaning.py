# SPDX-License-Identifier: Apache-2.0
"""What hpl-specs refuses of properties that it can read: aliases, variables, kinds of values."""

from __future__ import annotations

import pytest

from haros_ci.behaviour.meaning import mistakes, unused_aliases
from haros_ci.behaviour.parser import parse_property


@pytest.mark.parametrize(
    ("text", "slip", "said"),
    [
        ("globally: no /a {x = @B.x}", "UNBOUND", "no event before this one has the alias B; write 'as B'"),
        ("globally: /a causes /b as B {x = @A.x}", "UNBOUND", "alias A"),
        ("globally: /a {x = @B.x} causes /b as B", "UNBOUND", "alias B"),
        ("globally: /b requires /a as A {x = @B.x}", "UNBOUND", "alias B"),
        ("globally: /b {x = @A.x} requires /a as A", "UNBOUND", "alias A"),
        ("after /p until /q {x = @A.x}: no /a as A", "UNBOUND", "alias A"),
        ("after /p {x = @Q.x} until /q as Q: no /a", "UNBOUND", "alias Q"),
        ("after /p as P: no /a {x = @A.x}", "UNBOUND", "there is @P"),
        ("globally: /a as A causes /b as A", "TWICE", "given twice"),
        ("after /p as P: no /a as P", "TWICE", "given twice"),
        ("globally: no (/a or /a)", "EVENTS", "stands twice"),
        ("globally: no /a {forall i in v: x}", "VARIABLE", "never used"),
        ("globally: no /a {forall i in v[@i]: @i > 0}", "VARIABLE", "depend on @i itself"),
        ("globally: no /a {forall i in v: (exists i in v: @i > 0)}", "VARIABLE", "bound twice"),
        ('globally: no /a {x = 1 and x = "t"}', "KIND", "x is used as a text here, and as a number elsewhere"),
        ('globally: no /a {1 = "t"}', "KIND", "1 is a number, where a text is needed"),
        ("globally: no /a {not 1}", "KIND", "where true or false is needed"),
        ("globally: no /a {1}", "KIND", "where true or false is needed"),
        ("globally: no /a {x < True}", "KIND", "where a number is needed"),
        ("globally: no /a {x in 3}", "KIND", "where an array or a range or a set is needed"),
        ("globally: no /a {len(3) > 1}", "KIND", "len takes (an array or a range or a set)"),
        ("globally: no /a {log(x) > 1}", "KIND", "log takes (a number, a number)"),
        ("globally: no /a {max(x, [1 to 2]) > 1}", "KIND", "max takes"),
        ("globally: no /a {x = 1 and x.y = 1}", "KIND", "x is used as"),
        ("globally: no /a as A {@A.x = 1 and x.y = 1}", "KIND", "x is used as"),
        ('globally: no /a {exists i in {"t"}: @i > 0}', "KIND", "where a number is needed"),
    ],
)
def test_mistakes(text: str, slip: str, said: str) -> None:
    found = mistakes(parse_property(text))
    assert any(each.slip.name == slip and said in each.message for each in found)


@pytest.mark.parametrize(
    "text",
    [
        "globally: no /a",
        "globally: no /a as A {@A.x > 0}",
        "globally: /a as A causes /b {x = @A.x}",
        "globally: /b as B requires /a {x = @B.x}",
        "after /p as P until /q {x = @P.x}: /a as A causes /b {x = @P.x + @A.x}",
        "after (/p as P or /r as R): no /a {x = @P.x}",
        "globally: no (/a or /b)",
        "globally: (/a or /b) causes (/a or /c)",
        "globally: no /a {exists i in [0 to 3]: v[@i] > 0}",
        "globally: no /a {(exists i in v: v[@i] > 0) and (forall i in w: w[@i] > 0)}",
        'globally: no /a {x = y and z = "t" and b = True and c}',
        "globally: no /a {max(x) > 1 or max(x, y, 3) > 1 or yaw(q) > 1 or yaw(1, 2, 3, 4) > 1}",
        'globally: no /a {str(x) = "1" and bool(x) and int(y) = 1}',
        "globally: no /a {x in y and z in {1, 2} and len({1}) = 1}",
        "globally: no /a {@A.x > 0} within 1 s" if False else "globally: no /a {True}",
    ],
)
def test_what_is_right(text: str) -> None:
    assert mistakes(parse_property(text)) == ()


@pytest.mark.parametrize(
    ("text", "unused"),
    [
        ("globally: no /a as A", ["A"]),
        ("globally: no /a as A {@A.x > 0}", ["A"]),
        ("after /p as P: /a as A causes /b {x = @A.x}", ["P"]),
        ("globally: /a as A causes /b {x = @A.x}", []),
        ("globally: no /a", []),
        ("after /p as P until /q {x = @P.x}: no /b", []),
        ("globally: /a as A causes /b {exists A in v: @A > 0}", ["A"]),
    ],
)
def test_aliases_that_no_other_event_uses(text: str, unused: list[str]) -> None:
    assert [event.alias for event in unused_aliases(parse_property(text))] == unused
