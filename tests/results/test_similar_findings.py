# SPDX-License-Identifier: Apache-2.0
"""The same finding in files that are mostly one text is one finding for who reads; other texts have findings of their own."""

from __future__ import annotations

import json
from dataclasses import replace
from pathlib import Path

import pytest
from commandline import haros, write

from haros_ci.model.location import Location
from haros_ci.results.result import BaselineState, Related, Result, Suppression
from haros_ci.results.rule import Level
from haros_ci.results.twins import twins

#: Eleven lines, of which the fifth is the one that findings are of.
LINES = ("<launch>", *(f'<arg name="a{n}" default="{n}"/>' for n in range(9)), "</launch>")
TEXT = "\n".join(LINES)
OTHER = "\n".join(f'<param name="b{n}" value="{n}"/>' for n in range(12))


def unused(path: str, name: str = "a3", line: int = 5, level: Level = Level.WARNING) -> Result:
    message = f"launch argument {name!r} is declared, but never read; use it."
    return Result("haros-ci", "unused-launch-argument", level, message, Location(path, line))


def joined(results: list[Result], texts: dict[str, str], largest: int = 100_000) -> tuple[Result, ...]:
    return twins(results, lambda path: texts.get(path, ""), largest)


def test_a_variant_of_a_file() -> None:
    variant = TEXT.replace('name="a7" default="7"', 'name="other" default="x"')
    results = [unused("a.launch"), unused("b.launch"), unused("c.launch")]
    (one,) = joined(results, {"a.launch": TEXT, "b.launch": variant, "c.launch": f"{variant}\n<!-- c -->\n"})
    assert one.message.endswith("never read; use it; and the same in 2 similar files (b.launch, c.launch)")
    assert one.copies == tuple(results[1:])
    assert one.related == tuple(Related(Location(p, 5), f"The same in {p}.") for p in ("b.launch", "c.launch"))


def test_an_extract_of_a_file() -> None:
    long = "\n".join(f"<node{n}/>" for n in range(25))
    error = [unused("a.launch", level=Level.ERROR), unused("b.launch", level=Level.ERROR)]
    assert len(joined(error, {"a.launch": long, "b.launch": f"{long}\n{OTHER}\n{OTHER}"})) == 1


def test_quotes_and_comment_marks_are_no_difference() -> None:
    text = TEXT.replace('"', "'")
    assert len(joined([unused("a.launch"), unused("b.launch")], {"a.launch": TEXT, "b.launch": text})) == 1


def test_the_one_with_more_stands_for_the_other() -> None:
    more = replace(
        unused("b.launch"),
        message=f"{unused('b.launch').message.rstrip('.')}; and the same of a4 (line 6)",
        copies=(unused("b.launch", "a4", 6),),
    )
    results = [unused("a.launch"), more]
    (one,) = joined(results, {"a.launch": TEXT, "b.launch": TEXT.replace('"7"', '"8"')})
    assert one.location.path == "b.launch"
    assert one.message.endswith("; and the same of a4 (line 6); and the same in 1 similar file (a.launch)")
    assert [copy.location.path for copy in one.copies] == ["b.launch", "a.launch"]


def pasted(path: str, line: int) -> Result:
    return replace(unused(path, line=line), copies=(unused(path, "a4", line + 1),))


def test_two_arguments_that_were_pasted_into_another_file_of_the_directory() -> None:
    texts = {"l/a.launch": TEXT, "l/b.launch": f"{OTHER}\n{LINES[4]}\n{LINES[5]}\n", "m/b.launch": OTHER}
    first, other = joined([pasted("l/a.launch", 5), pasted("l/b.launch", 13), pasted("m/b.launch", 5)], texts)
    assert [copy.location.path for copy in first.copies] == ["l/a.launch", "l/b.launch", "l/b.launch"]
    assert other.location.path == "m/b.launch"


def alone(path: str) -> str:
    """Twelve lines that no other file has, and one that all have."""
    return "\n".join((*(f'<param name="{path}{n}"/>' for n in range(12)), LINES[4]))


def test_one_line_that_was_pasted_into_three_files_of_a_directory() -> None:
    """Launch files that have nothing else in common, of which each declares an argument that it does not read."""
    texts = {path: alone(path) for path in ("l/a.launch", "l/b.launch", "l/c.launch", "m/d.launch")}
    first, other = joined([unused(path, line=13) for path in texts], texts)
    assert first.location.path == "l/a.launch"
    assert [copy.location.path for copy in first.copies] == ["l/b.launch", "l/c.launch"]
    assert other.location.path == "m/d.launch"


@pytest.mark.parametrize("kind", ["two files", "another line", "errors"])
def test_one_line_of_several_files_that_stays_apart(kind: str) -> None:
    paths = ("a.launch", "b.launch") if kind == "two files" else ("a.launch", "b.launch", "c.launch")
    texts = {path: alone(path) for path in paths}
    if kind == "another line":
        texts["c.launch"] = texts["c.launch"].replace(LINES[4], LINES[5])
    level = Level.ERROR if kind == "errors" else Level.WARNING
    assert len(joined([unused(path, line=13, level=level) for path in paths], texts)) == len(paths)


QUIET = [
    pytest.param([unused("a.launch"), unused("a.launch", line=6)], TEXT, id="one file"),
    pytest.param([unused("a.launch"), unused("b.launch")], OTHER, id="another text"),
    pytest.param([unused("a.launch"), unused("b.launch", "a4", 6)], TEXT, id="another argument"),
    pytest.param([unused("a.launch"), unused("b.launch")], f"<x/>\n{TEXT}", id="another line"),
    pytest.param([unused("a.launch"), unused("b.launch", level=Level.ERROR)], TEXT, id="another level"),
    pytest.param([unused("a.launch"), replace(unused("b.launch"), rule="other")], TEXT, id="another rule"),
    pytest.param([unused("a.launch"), replace(unused("b.launch"), tool="other")], TEXT, id="another tool"),
    pytest.param([unused("a.launch"), unused("b.launch.py")], TEXT, id="another language"),
    pytest.param([unused("a.launch"), replace(unused("b.launch"), value=1.0)], TEXT, id="numbers"),
    pytest.param([unused("a.launch"), replace(unused("b.launch"), location=Location("b.launch"))], TEXT, id="no line"),
    pytest.param(
        [unused("a.launch"), replace(unused("b.launch"), suppressions=(Suppression("inSource"),))],
        TEXT,
        id="suppressed",
    ),
    pytest.param([unused("a.launch"), replace(unused("b.launch"), state=BaselineState.NEW)], TEXT, id="a new one"),
    pytest.param(
        [replace(unused(path), state=BaselineState.ABSENT) for path in ("a.launch", "b.launch")], TEXT, id="gone"
    ),
    pytest.param(
        [unused("a.launch"), unused("b.launch")],
        "\n".join((*LINES[:6], *(f'<arg name="c{n}" default="{n}"/>' for n in range(9)), "</launch>")),
        id="half of the lines",
    ),
    pytest.param(
        [pasted("a.launch", 5), replace(pasted("b.launch", 5), copies=())], OTHER, id="one of two pasted arguments"
    ),
    pytest.param(
        [replace(pasted(path, 5), level=Level.ERROR) for path in ("a.launch", "b.launch")], OTHER, id="pasted errors"
    ),
    pytest.param([pasted("a/a.launch", 5), pasted("b/b.launch", 5)], OTHER, id="pasted into another directory"),
]


@pytest.mark.parametrize(("results", "other"), QUIET)
def test_others_stay(results: list[Result], other: str) -> None:
    paths = {result.location.path for result in results} - {"a.launch", "a/a.launch"}
    assert joined(results, {"a.launch": TEXT, "a/a.launch": TEXT, **dict.fromkeys(paths, other)}) == tuple(results)


def test_short_and_long_files_stay() -> None:
    results = [unused("a.launch", line=1), unused("b.launch", line=1)]
    short = "\n".join(LINES[:7])
    assert len(joined(results, {"a.launch": short, "b.launch": f"{short}\n"})) == 2
    assert len(joined(results, {"a.launch": TEXT, "b.launch": f"{TEXT}\n"}, largest=50)) == 2


def test_programs_have_each(tmp_path: Path) -> None:
    manifest = (
        '<package format="2"><name>walker</name><version>1.0.0</version><description>d</description>'
        '<maintainer email="a@example.org">a</maintainer><license>BSD</license><buildtool_depend>catkin</buildtool_depend></package>\n'
    )
    head = '<launch>\n  <arg name="port" default="7"/>\n  <arg name="baud" default="7"/>\n'
    nodes = "".join(f'  <param name="p{n}" value="{n}"/>\n' for n in range(9))
    write(
        tmp_path,
        {
            "package.xml": manifest,
            "CMakeLists.txt": "project(walker)\ninstall(DIRECTORY launch DESTINATION share/walker)\n",
            "launch/one.launch": f"{head}{nodes}</launch>\n",
            "launch/two.launch": f'{head}{nodes}  <param name="more" value="1"/>\n</launch>\n',
        },
    )
    data = json.loads(haros("check", ".", "--output=json", cwd=tmp_path).stdout)
    results = [one for one in data["results"] if one["rule"] == "unused-launch-argument"]
    shown = [one for one in results if not one["copyOf"]]
    assert (len(results), len(shown)) == (4, 1)
    assert "the same of baud (line 3); and the same in 1 similar file (launch/two.launch)" in shown[0]["shownAs"]
