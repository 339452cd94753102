# SPDX-License-Identifier: Apache-2.0
"""Markdown for comments: bounded, and read by a CommonMark reader as the text that it is."""

from __future__ import annotations

import html
import re
from dataclasses import replace

import pytest
from format_texts import LONG, TEXTS, report_saying
from hypothesis import given
from report_samples import COVERAGE, CPPCHECK_RUN, EMPTY, FAILED, PLAIN, SCOPE_RESULT, hostile

from haros_ci.model.location import Location
from haros_ci.report import markdown
from haros_ci.report.escape import markdown as escaped
from haros_ci.report.escape import markdown_code, terminal
from haros_ci.report.message import plain, shorten
from haros_ci.results.result import Notification, Report, Result, Run, Tool
from haros_ci.results.rule import Level

BREAK = "\u200b"


def read(text: str) -> str:
    """As HTML, by GitHub's own reader with its extensions."""
    cmark = pytest.importorskip("cmarkgfm", reason="reads Markdown as GitHub does; of the test extra")
    options = pytest.importorskip("cmarkgfm.cmark").Options
    return str(cmark.github_flavored_markdown_to_html(text, options=options.CMARK_OPT_UNSAFE))


def cells(page: str) -> list[list[str]]:
    """The text of each cell of each row, without the tags of inline code."""
    rows = re.findall(r"<tr>(.*?)</tr>", page, re.DOTALL)
    return [[said(cell) for cell in re.findall(r"<t[dh]>(.*?)</t[dh]>", row, re.DOTALL)] for row in rows]


def said(cell: str) -> str:
    return html.unescape(re.sub(r"</?code>", "", cell)).replace(BREAK, "")


def tags(page: str) -> set[str]:
    return set(re.findall(r"<[^>]*>?", page))


def of(*results: Result) -> Report:
    return replace(PLAIN, runs=(replace(CPPCHECK_RUN, results=results),))


def many(count: int, message: str = "m") -> list[Result]:
    return [replace(SCOPE_RESULT, message=message, location=Location("a.cpp", n)) for n in range(1, count + 1)]


def test_what_it_says() -> None:
    text = markdown.render(PLAIN)
    assert text.startswith(
        "## haros-ci: 4 findings: 2 errors, 2 notes\n\n2 findings at or above 'warning' fail this run.\n"
    )
    assert text.count("\n| ") == 5 and "Looked at 1 package" in text
    assert "CAUTION" not in text and "more finding" not in text


def test_trouble_is_said_first_and_nothing_found_is_said() -> None:
    assert markdown.render(FAILED).count("> [!CAUTION]") == 3
    assert markdown.render(EMPTY).startswith("## haros-ci: No findings\n")


@pytest.mark.parametrize("limit", [2_000, 5_000, markdown.MAX_COMMENT])
@pytest.mark.parametrize("message", ["m", "größe <b> | " * 60, "\\" * 3000])
def test_a_comment_is_never_too_long_and_counts_the_rest(limit: int, message: str) -> None:
    notes = tuple(Notification(Level.WARNING, message, "x", f"{n}{message}") for n in range(300))
    broken = tuple(
        Run(Tool(f"t{n}"), notifications=(replace(notes[0], level=Level.ERROR),), successful=False) for n in range(30)
    )
    report = replace(
        of(*many(700, message)), runs=(*of(*many(700, message)).runs, *broken), notifications=notes,
        coverage=replace(COVERAGE, unseen=(message,) * 80),
    )  # fmt: skip
    text = markdown.render(report, limit=limit)
    rows = text.count("| note | ")
    assert len(text.encode()) <= limit
    assert f"\n{700 - rows} more findings not in this table" in text
    assert text.count("<details>") == text.count("</details>") == 1
    assert rows <= markdown.MAX_ROWS


def test_a_full_comment_is_well_used() -> None:
    text = markdown.render(of(*many(5000, "A sentence of a usual length about the code.")))
    assert markdown.MAX_COMMENT * 0.6 < len(text.encode()) <= markdown.MAX_COMMENT
    assert text.count("| note | ") in range(300, markdown.MAX_ROWS + 1)


@pytest.mark.parametrize(
    "text",
    ["www.evil.example", "https://e.example", "see http://e.example/a_b", "a@b.example", "mailto:a@b.example", "ftp://e.example",
     "xmpp:a@b.example", "@team", "#12", "!7", "GH-3", "a#1", "x/y#3", "[a](http://b)", "![a](b)", "<https://e.example>", "<a@b.example>"],
)  # fmt: skip
def test_no_links_no_mentions(text: str) -> None:
    for written in (escaped(text), markdown_code(text)):
        page = read(f"| x |\n|---|\n| {written} |")
        assert "<a" not in page and "<img" not in page
        assert cells(page)[1] == [text]
    inside = re.sub(r"<code>.*?</code>", "", html.unescape(read(escaped(text))))
    assert not re.search(r"@\w|[#!]\d|GH-\d|://", inside), "what GitHub and GitLab link after rendering"


@pytest.mark.parametrize(
    "text", ["a-b", "50 % of it", "a.b", "std::vector", "awww.x", "GH-x", "# head", "a: b", "größe 3.5", "'x' (y)"]
)
def test_texts_are_shown_without_anything_added(text: str) -> None:
    assert BREAK not in escaped(text)
    assert BREAK not in markdown_code(text)
    assert html.unescape(escaped(text)) == text


@given(TEXTS, TEXTS)
def test_hostile_texts_are_text(text: str, other: str) -> None:
    report = report_saying(text, other)
    page = read(markdown.render(report))
    assert tags(page) <= {
        "<h2>", "</h2>", "<p>", "</p>", "<blockquote>", "</blockquote>", "<table>", "</table>", "<thead>", "</thead>", "<tbody>",
        "</tbody>", "<tr>", "</tr>", "<th>", "</th>", "<td>", "</td>", "<code>", "</code>", "<ul>", "</ul>", "<li>", "</li>",
        "<details>", "</details>", "<summary>", "</summary>",
    }  # fmt: skip
    table = cells(page)
    assert [len(row) for row in table] == [4, 4]
    [result] = report.shown()
    assert table[1][2].split() == terminal(shorten(plain(result), 500)).replace(BREAK, "").split()
    assert table[1][1].split() == terminal(str(result.location)).replace(BREAK, "").split()


def test_a_message_of_a_megabyte_is_cut() -> None:
    assert len(markdown.render(report_saying(LONG))) < 30_000


def test_the_same_bytes() -> None:
    report = hostile("a|b")
    turned = replace(report, runs=tuple(replace(r, results=r.results[::-1]) for r in report.runs[::-1]))
    assert markdown.render(turned) == markdown.render(report)


def test_files_given_up_on_are_named_with_their_reasons() -> None:
    notes = tuple(
        Notification(Level.NOTE, "it includes `<b>` of no package", "architecture", f"launch/{number}.launch", 3)
        for number in range(6)
    )
    said = markdown.render(replace(PLAIN, notifications=notes))
    head = html.unescape(html.unescape(said).partition("<details>")[0])
    assert "Not analysed in full: architecture on 6 files." in head
    assert "launch/0.launch:3 and 5 more files</code>: it includes" in head and "launch/1.launch" not in head
    assert "more file of architecture" not in head and "<b>" not in said


def test_what_stands_above_is_not_said_again() -> None:
    one = Notification(Level.NOTE, "there is no function f; define it.", "architecture", "a.launch.py", 1)
    page = html.unescape(html.unescape(markdown.render(replace(PLAIN, notifications=(one,)))))
    assert page.count("there is no function f") == 1
    others = (
        replace(one, level=Level.ERROR),  # trouble is shown among the messages, too
        replace(one, line=2),  # another reason for the same file
        Notification(Level.NOTE, "a note of no file", "architecture"),
    )
    for other in others:
        page = html.unescape(html.unescape(markdown.render(replace(PLAIN, notifications=(other, one)))))
        assert other.message.rstrip(".") in page.partition("of tools and configuration")[2], other
