# SPDX-License-Identifier: Apache-2.0
"""What follows from a table of API rows is worked out once for that table, and never taken for what follows from another one."""

from __future__ import annotations

from haros_ci.analysis.api_rows import api_rows
from haros_ci.index.api_names import called_back
from haros_ci.model.api import Row, load_row
from haros_ci.model.once import TABLES, once
from haros_ci.systems.keeping import of_rows

OWN = {"call": "acme::listen", "calls": ["0"]}


def counted() -> tuple[list[tuple[Row, ...]], object]:
    asked: list[tuple[Row, ...]] = []

    @once
    def names(rows: tuple[Row, ...]) -> tuple[str, ...]:
        asked.append(rows)
        return tuple(row.call for row in rows)

    return asked, names


def table(name: str) -> tuple[Row, ...]:
    return (load_row({"call": name}),)


def test_the_same_table_is_looked_at_once() -> None:
    asked, names = counted()
    rows = table("a::b")
    assert callable(names) and names(rows) is names(rows) == ("a::b",)
    assert asked == [rows]


def test_an_equal_table_is_another_one() -> None:
    asked, names = counted()
    assert callable(names) and names(table("a::b")) == names(table("a::b"))
    assert len(asked) == 2


def test_no_table_is_taken_for_one_that_is_gone() -> None:
    """Each is freed at once by who asks, so that its place in memory is free for the next."""
    name_of = once(lambda rows: rows[0].call)
    for number in range(20 * TABLES):
        assert name_of(table(f"a::f{number}")) == f"a::f{number}"


def test_a_project_without_rows_has_the_tables_themselves() -> None:
    first, second = (api_rows(declared, "", []) for declared in (None, []))
    assert first.keys() == second.keys() and all(first[version] is second[version] for version in first)


def test_rows_of_a_project_come_first_and_count() -> None:
    plain, own = (api_rows(declared, "", []) for declared in (None, [OWN]))
    for version, rows in own.items():
        assert rows[0].call == "acme::listen" and rows[1:] == plain[version]
        assert called_back(rows) - called_back(plain[version]) == {"acme::listen"}
        assert of_rows(rows) != of_rows(plain[version])
    assert plain == api_rows(None, "", []), "and they stay with their project"
