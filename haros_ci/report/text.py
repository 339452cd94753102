# SPDX-License-Identifier: Apache-2.0
"""The report for a person at a terminal: findings by file with their line of code, trouble, then a summary."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Collection, Iterable, Iterator, Sequence
from itertools import groupby

from haros_ci.report import summary
from haros_ci.report.entries import lines_to_add
from haros_ci.report.escape import inert, terminal
from haros_ci.report.gathered import gathered
from haros_ci.report.message import label, plain, shorten
from haros_ci.report.source_lines import Reader, lines_of
from haros_ci.results.result import BaselineState, Notification, Related, Report, Result
from haros_ci.results.rule import Level
from haros_ci.results.silence_words import counted

MAX_STEPS = 12  # of one finding's flow
MAX_LINES = 5  # of one file that a note names
MAX_TROUBLE = 10  # of one tool and level; the rest is counted, and its files are named
MAX_FILES = 40
TAB = "    "
RESET, BOLD, DIM = "\x1b[0m", "\x1b[1m", "\x1b[2m"
COLORS = {Level.ERROR: "\x1b[1;31m", Level.WARNING: "\x1b[33m", Level.NOTE: "\x1b[36m"}

Paint = Callable[[str, str], str]


def render(report: Report, *, color: bool, width: int, why: bool, source: Reader | None = None) -> str:
    """The whole text. *width* is in columns; *source* gives lines of code where results do not bring their own.

    Each finding starts with ``path:line:column: level: message [tool:rule]``, which editors find. Only open findings
    are shown; *why* adds the reason of each, and one line for each that the baseline knows.
    """
    paint = _painter(color)
    counts = summary.count(report)
    blocks = _files(report.shown(), paint, width, why, source)
    if why:
        blocks.append(_matched(report, paint))
    blocks.append(_problems(report, paint))
    blocks.append(_summary(report, counts, paint))
    return _joined(blocks)


def findings(results: Iterable[Result], *, color: bool, width: int, why: bool, source: Reader | None = None) -> str:
    """*results*, in output order, as ``render`` shows them, and nothing else."""
    return _joined(_files(results, _painter(color), width, why, source))


def one_line(result: Result) -> str:
    """``path:line:column: level: message [tool:rule]``, without colour."""
    return inert(_head(result, _painter(False)))


def closing(report: Report, *, known: Collection[Notification], color: bool) -> str:
    """Problems except those in *known*, which were printed before, and one line that sums up."""
    paint = _painter(color)
    failed = (paint(COLORS[Level.ERROR], terminal(failure)) for failure in summary.failures(report))
    return _joined([_problems(report, paint, known), (paint(BOLD, summary_line(report)), *failed)])


def summary_line(report: Report) -> str:
    """One line for stderr when the report itself goes to files."""
    counts = summary.count(report)
    parts = (summary.headline(report, counts), summary.known(counts))
    return terminal("; ".join(part for part in parts if part))


def frame(line: str, columns: Sequence[tuple[int, int]], width: int) -> tuple[str, str]:
    """A line of code and the marks below it, both at most *width* wide.

    *columns* are (start, end) in code points, 1-based, end exclusive. Tabs are widened, wide characters count as two;
    of a long line the part around the first mark is kept.
    """
    first = min((start for start, _ in columns), default=1)
    begin = 0
    if len(line) >= width or sum(map(_shown_cells, line)) >= width:
        begin, room = min(first - 1, len(line)), width // 2
        while begin and (room := room - _shown_cells(line[begin - 1])) >= 0:
            begin -= 1
    code, marks = ("...", "   ") if begin else ("", "")
    for i, character in enumerate(line[begin:], start=begin + 1):
        cells = _shown_cells(character)
        if len(marks) + cells > (width if i == len(line) else width - 3):
            code += "..."
            break
        code += TAB if character == "\t" else terminal(character)
        start = next((start for start, end in columns if start <= i < max(end, start + 1)), None)
        marks += (" " if start is None else "^" if start == i else "~") * cells
    if first > len(line):
        marks += "^"
    return terminal(code.rstrip()), marks.rstrip()


def _painter(color: bool) -> Paint:
    return (lambda code, text: f"{code}{text}{RESET}") if color else (lambda code, text: text)


def _joined(blocks: Iterable[Iterable[str]]) -> str:
    return "\n".join("".join(f"{inert(line)}\n" for line in block) for block in map(tuple, blocks) if block)


def _files(
    results: Iterable[Result], paint: Paint, width: int, why: bool, source: Reader | None
) -> list[Iterable[str]]:
    lines = lines_of(source or (lambda path: ""))
    return [_file(tuple(group), paint, lines, width, why) for _, group in groupby(results, lambda r: r.location.path)]


def _file(
    results: tuple[Result, ...], paint: Paint, lines: Callable[[str], list[str]], width: int, why: bool
) -> Iterator[str]:
    """The findings of one file; those of one line share its frame, each with its own notes, and what is to be written, where several have some."""
    for number, group in groupby(results, lambda r: r.location.line):
        here = tuple(group)
        is_apart = sum(bool(result.related or result.flow) for result in here) > 1
        written: set[str] = set()
        for rest in [here[i : i + 1] for i in range(len(here))] if is_apart else [here]:
            for result in rest:
                yield _head(result, paint)
                if why and result.reason:
                    yield paint(DIM, f"      why: {terminal(result.reason)}")
            if number is not None:
                text = lines(here[0].location.path)
                yield from _frame(here, number, text, paint, width) if rest[0] is here[0] else ()
                yield from _added(rest, number, text, written, paint, width)
            for result in rest:
                yield from _notes(result, paint)


def _notes(result: Result, paint: Paint) -> Iterator[str]:
    """The related places, what several of them say in succession once; then the flow, unless all of it is at the finding's own line."""
    for words, group in groupby(result.related, label):
        near, *more = group
        place = terminal(str(near.location))
        yield f"      {place}: {paint(COLORS[Level.NOTE], 'note')}: {words}{_elsewhere(near, more)}"
    here = (result.location.path, result.location.line)
    if any((step.location.path, step.location.line) != here for step in result.flow):
        yield from _flow(result, paint)


def _elsewhere(near: Related, more: Sequence[Related]) -> str:
    """Where else the same is: by line in the same file, otherwise counted."""
    places = {(other.location.path, other.location.line) for other in more}
    places -= {(near.location.path, near.location.line)}
    if not places:
        return ""
    if {path for path, _ in places} != {near.location.path} or len(places) > MAX_LINES:
        return f"; and at {len(places)} more place{'s' if len(places) > 1 else ''}"
    numbers = ", ".join(str(line) for _, line in sorted(places, key=lambda place: place[1] or 0))
    return f"; and in line{'s' if len(places) > 1 else ''} {numbers}"


def _flow(result: Result, paint: Paint) -> Iterator[str]:
    """The places that lead to a finding, in order; of many the first ones and the last."""
    steps = tuple(enumerate(result.flow, 1))
    hidden = len(steps) - MAX_STEPS
    for number, step in steps if hidden <= 0 else (*steps[: MAX_STEPS - 1], steps[-1]):
        if hidden > 0 and number == len(steps):
            yield paint(DIM, f"      and {hidden:,} more steps, then")
        yield f"      {terminal(str(step.location))}: {paint(COLORS[Level.NOTE], f'step {number}')}: {label(step)}"


def _head(result: Result, paint: Paint) -> str:
    also = "".join(f", {terminal(other)}" for other in result.also)
    place = paint(BOLD, terminal(str(result.location)))
    level = paint(COLORS[result.level], result.level.value)
    return f"{place}: {level}: {plain(result)} {paint(DIM, f'[{terminal(result.full_id)}{also}]')}"


def _frame(here: tuple[Result, ...], number: int, lines: list[str], paint: Paint, width: int) -> Iterator[str]:
    identity = here[0].identity
    text = lines[number - 1] if number <= len(lines) else identity.snippet if identity else ""
    if not text.strip():
        return
    columns = [_columns(r) for r in here if r.location.column is not None]
    code, marks = frame(text, columns, max(width - 10, 20))
    yield f"{paint(DIM, f'{number:>6} |')} {code}"
    if marks:
        worst = min((r.level for r in here), key=lambda level: level.rank)
        yield f"{paint(DIM, '       |')} {paint(COLORS[worst], marks)}"


def _added(
    here: tuple[Result, ...], number: int, lines: list[str], written: set[str], paint: Paint, width: int
) -> Iterator[str]:
    """What *here* asks to be written below the line, but for what is *written* above: it is the place of what a manifest lacks, not what is wrong."""
    above = lines[number - 1] if 0 < number <= len(lines) else ""
    indent = above[: len(above) - len(above.lstrip())]
    new = [entry for entry in lines_to_add(here) if entry not in written]
    written.update(new)
    for entry in new:
        yield f"{paint(DIM, '     + |')} {frame(indent + entry, (), max(width - 10, 20))[0]}"


def _columns(result: Result) -> tuple[int, int]:
    place = result.location
    start = place.column or 1
    one_line = place.end_column is not None and place.end_line in (None, place.line)
    return start, place.end_column if one_line and place.end_column else start + 1


def _matched(report: Report, paint: Paint) -> Iterator[str]:
    """One line for each result that is not shown, with what became of it."""
    for result in report.results:
        if result.state in (None, BaselineState.NEW) and not result.suppressions:
            continue
        state = "suppressed" if result.suppressions else result.state.value if result.state else ""
        reason = result.reason or next((s.justification for s in result.suppressions if s.justification), "")
        line = f"{terminal(str(result.location))}: {state}: {plain(result)} [{terminal(result.full_id)}]"
        yield paint(DIM, f"{line} {terminal(reason)}".rstrip())


def _problems(report: Report, paint: Paint, known: Collection[Notification] = ()) -> Iterator[str]:
    worth = (n for n in summary.notifications(report) if n.level is not Level.NOTE or not n.tool or not n.path)
    shown = gathered((n for n in worth if n not in known), report.shown())
    for _, group in groupby(shown, lambda n: (n.level, n.tool)):
        notes = tuple(group)
        for note in notes[:MAX_TROUBLE]:
            yield f"{paint(COLORS[note.level], note.level.value)}: {_place(note)}{shorten(terminal(note.message), 500)}"
        if rest := notes[MAX_TROUBLE:]:
            yield paint(DIM, f"  and {len(rest):,} more of {terminal(notes[0].tool or 'this kind')}{_places_of(rest)}")


def _places_of(notes: Iterable[Notification]) -> str:
    """The files of notes that are not shown, so that none hides behind others."""
    paths = list(dict.fromkeys(note.path for note in notes if note.path))
    more = " …" if len(paths) > MAX_FILES else ""
    return f", on {', '.join(map(terminal, paths[:MAX_FILES]))}{more}" if paths else ""


def _place(note: Notification) -> str:
    is_named = note.message.startswith(f"{note.tool} ")  # by the message itself
    tool = f"{terminal(note.tool)}: " if note.tool and not is_named else ""
    if not note.path:
        return tool
    return f"{tool}{terminal(note.path)}{f':{note.line}' if note.line else ''}: "


def _summary(report: Report, counts: summary.ResultCounts, paint: Paint) -> Iterator[str]:
    loud = COLORS[Level.ERROR]
    failed = counts.failing or report.failed_tools() or summary.no_baseline(report)
    yield paint(loud if failed else BOLD, summary.headline(report, counts))
    beside = (summary.stood_for(report), summary.baseline(report), summary.known(counts), counted(report.silenced))
    for line in filter(None, beside):
        yield f"  {terminal(line)}"
    yield f"  {summary.verdict(report, counts)}"
    if metrics := summary.metrics(report):
        yield f"  {metrics}"
    yield f"  {terminal(summary.covered(report))}"
    if report.coverage.sandbox:
        yield f"  {report.coverage.sandbox}"
    if given_up := summary.given_up(report):
        yield f"  {terminal(given_up)}"
        for place, reason in summary.given_up_on(report, printed=Level.WARNING):
            yield f"    {terminal(place)}: {shorten(terminal(reason), 300)}" if place else f"    {terminal(reason)}"
    for sentence in report.coverage.unseen:
        yield f"  Not seen: {terminal(sentence)}"
    if counts.open:
        rule, _ = max(Counter(r.full_id for r in report.shown()).items(), key=lambda pair: (pair[1], pair[0]))
        yield paint(DIM, f"  What a rule means: haros-ci explain {terminal(rule)}")
    if counts.open > summary.MANY and report.baseline is None:
        yield paint(
            DIM, "  Too many at once? haros-ci baseline create records them; from then on only new ones are shown."
        )
    if missing := summary.no_baseline(report):
        yield paint(loud, terminal(missing))
    for failure in summary.failures(report):
        yield paint(loud, terminal(failure))


def _shown_cells(character: str) -> int:
    """Columns of a terminal that one character of source takes."""
    if character.isascii():
        return len(TAB) if character == "\t" else 1
    from unicodedata import combining, east_asian_width

    return 0 if combining(character) else 2 if east_asian_width(character) in "WF" else 1
