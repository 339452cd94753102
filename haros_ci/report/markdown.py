# SPDX-License-Identifier: Apache-2.0
"""The report as GitHub-flavoured Markdown, for a comment on a pull request or the summary of a job; GitLab shows it, too."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from haros_ci.report import summary
from haros_ci.report.diff_markdown import linked
from haros_ci.report.escape import markdown, markdown_code
from haros_ci.report.gathered import gathered
from haros_ci.report.message import plain, shorten
from haros_ci.results.result import Notification, Report, Result
from haros_ci.results.rule import Level
from haros_ci.results.silence_words import sentences

#: A comment on GitHub has at most so many characters; here bytes, which are never fewer.
MAX_COMMENT = 65_536
MAX_ROWS = 500
MAX_TROUBLE = 50
MAX_TEXT = 500
MAX_ALSO = 5
TABLE = "\n| Level | Place | Finding | Rule |\n|---|---|---|---|\n"


def render(report: Report, *, limit: int = MAX_COMMENT, blob: str = "") -> str:
    """Verdict, trouble, a table of the open findings, coverage: at most *limit* bytes (2,000 or more) of UTF-8.

    A quarter is the most that trouble takes, and another that coverage and messages take; the worst findings have the
    rest, and what does not fit is counted. *blob* is the address below which files can be read, for links to lines; "" for none.
    """
    counts = summary.count(report)
    head = [f"## haros-ci: {summary.headline(report, counts)}", "", summary.verdict(report, counts)]
    if stood_for := summary.stood_for(report):
        head.append(stood_for)
    if known := summary.known(counts):
        head.append(f"Also {known}.")
    if metrics := summary.metrics(report):
        head.append(_text(metrics))
    head += [f"\n> [!WARNING]\n> {_text(sentence)}." for sentence in sentences(report.silenced)]
    alarms = [f"\n> [!CAUTION]\n> {_text(alarm)}" for alarm in alarms_of(report)]
    top = "\n".join([*head, *_fitting(alarms, len(alarms), limit // 4, "alarm"), ""])
    tail = "\n".join(["", *_coverage(report, limit // 8), *_messages(report, limit // 8), ""])
    shown = sorted(report.shown(), key=lambda result: (result.level.rank, result.sort_key))
    room = limit - _size(top) - _size(tail) - _size(TABLE) - 200
    rows = list(_taken((_row(result, blob) for result in shown[:MAX_ROWS]), room))
    left = len(shown) - len(rows)
    more = f"\n{summary.plural(left, 'more finding')} not in this table; the SARIF log has them all.\n" if left else ""
    text = f"{top}{TABLE if rows else ''}{''.join(rows)}{more}{tail}"
    return text + _changes(report, limit - _size(text), blob)


def alarms_of(report: Report) -> tuple[str, ...]:
    """What must not be overlooked, even when nothing was found."""
    missing = summary.no_baseline(report)
    return (*((missing,) if missing else ()), *summary.failures(report))


def _changes(report: Report, room: int, blob: str) -> str:
    """What the change does to the system, where a base revision is known and *room* bytes are enough."""
    if report.changes is None:
        return ""
    from haros_ci.report.diff_markdown import render

    text = f"\n### What changes in the system\n\n{render(report.changes, blob=blob)}"
    return text if _size(text) <= room else ""


def _row(result: Result, blob: str) -> str:
    ids = (result.full_id, *result.also[:MAX_ALSO])
    rules = ", ".join(markdown_code(shorten(rule, MAX_TEXT)) for rule in ids)
    text = shorten(str(result.location), MAX_TEXT)
    place = linked(text, result.location.path, result.location.line, blob) if blob else markdown_code(text)
    return f"| {result.level.value} | {place} | {_text(plain(result))} | {rules} |\n"


def _coverage(report: Report, room: int) -> Iterator[str]:
    yield _text(" ".join(filter(None, (summary.covered(report), report.coverage.sandbox))))
    if given_up := summary.given_up(report):
        yield _text(given_up)
        named = summary.given_up_on(report)
        lines = [
            f"- {markdown_code(shorten(place, MAX_TEXT))}: {_text(why)}" if place else f"- {_text(why)}"
            for place, why in named
        ]
        yield from _fitting(lines, len(lines), room, "line")
    unseen = report.coverage.unseen
    messages = [f"- Not seen: {_text(sentence)}" for sentence in unseen[:MAX_TROUBLE]]
    yield from _fitting(messages, len(unseen), room, "sentence")


def _messages(report: Report, room: int) -> Iterator[str]:
    named = {*summary.given_up_on(report)}  # they stand above
    of_many = {why for place, why in named if place.endswith((" more file", " more files"))}
    notes = gathered(
        note
        for note in summary.notifications(report)
        if note.level is Level.ERROR
        or (_place_and_reason(note) not in named and note.message.rstrip(".") not in of_many)
    )
    if not notes:
        return
    yield ""
    yield f"<details><summary>{summary.plural(len(notes), 'message')} of tools and configuration</summary>\n"
    yield from _fitting([_note(note) for note in notes[:MAX_TROUBLE]], len(notes), room, "message")
    yield "\n</details>"


def _place_and_reason(note: Notification) -> tuple[str, str]:
    """As ``summary.given_up_on`` names it."""
    return (f"{note.path}:{note.line}" if note.line else f"{note.path}", note.message.rstrip("."))


def _note(note: Notification) -> str:
    place = f"{note.path}:{note.line}" if note.line else f"{note.path}"
    where = f" {markdown_code(shorten(place, MAX_TEXT))}" if note.path else ""
    return f"- {note.level.value}: {_text(note.tool or 'haros-ci')}{where}: {_text(note.message)}"


def _fitting(lines: list[str], total: int, room: int, noun: str) -> list[str]:
    """As many of *lines* as *room* bytes hold, then how many of *total* are left."""
    taken = list(_taken(lines, room - 60))
    return [*taken, f"- and {summary.plural(total - len(taken), f'more {noun}')}"] if len(taken) < total else taken


def _taken(lines: Iterable[str], room: int) -> Iterator[str]:
    for line in lines:
        room -= _size(line) + 1
        if room < 0:
            return
        yield line


def _size(text: str) -> int:
    return len(text.encode("utf-8", "replace"))


def _text(text: str) -> str:
    return markdown(shorten(" ".join(text.split()), MAX_TEXT))
