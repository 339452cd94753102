# SPDX-License-Identifier: Apache-2.0
"""Node interfaces as people document them: the rows of tables of topics, services, actions and parameters in Markdown.

Read are tables of GitHub-flavoured Markdown (its specification, 4.10) and HTML, outside of code and comments. A heading
above, a column or a cell must tell what a table is about; others are passed over.
"""

from __future__ import annotations

import html
import re
from collections.abc import Callable, Iterator, Sequence
from html.parser import HTMLParser

from haros_ci.records import dataclass
from haros_ci.regex import regex

LONGEST_CELL = 2_000
LONGEST_HTML_TABLE = 50_000  # characters
LONGEST_TABLE = 1_000  # lines

TOPICS = ("publishers", "subscribers")
SERVICES = ("servers", "clients")
ACTIONS = ("action_servers", "action_clients")
PARAMETERS = ("parameters",)

_NAME_COLUMN = regex(
    r"(?:(?:input|output|subscribed|published) )?"
    r"(?:topics?|services?|actions?|interface|parameters?|param|local|global)?"
    r" ?(?:names?)?|parameters? ?/.*|.{1,40} parameters?"
)
_TYPE_COLUMN = regex(r"(?:message|msg|data|service|srv|topic|action|parameter)? ?types?")
_DEFAULT_COLUMN = regex(r"default( values?)?\b")
_SAYS_WHAT = regex(r"type|default|desc|defin|expla|meaning|interface")
_NOT_INTERFACE = regex(
    r"\bexamples?\b|\brviz|\bformats?\b|\btypes?\b|\.msg\b|::|\bfields?\b|\bmessages?\b|\boptions?\b"
)
_ROS_TYPE = regex(r"[a-z]\w*(?:/|::)(?:(?:msg|srv|action)s?(?:/|::))?[A-Z]\w*")
_NAME = regex(r"[~/\w<{*.:?\[\]>}$-]+")


@dataclass(frozen=True, slots=True)
class TableRow:
    """One documented name. *kinds* are the kinds of ends that it may be, *names* the forms in which it is given.

    *type* and *default* are plain text, None where the table has no such column or the cell is empty; *description* is
    as written. *headings* are those above, outermost first, as written; *table* is the line of the table's head.
    """

    kinds: tuple[str, ...]
    names: tuple[str, ...]
    type: str | None
    default: str | None
    line: int
    table: int
    headings: tuple[str, ...] = ()
    description: str = ""


@dataclass(frozen=True, slots=True)
class _Table:
    line: int
    header: tuple[str, ...]
    rows: tuple[tuple[int, tuple[str, ...]], ...]
    headings: tuple[str, ...]
    lead: str


def rows(text: str) -> tuple[TableRow, ...]:
    """The rows of all tables in *text* that document interfaces, in order; of a cell with several names several."""
    lines = _without_comments(text).split("\n")
    found = [row for table in _tables(lines) for row in _read(table)]
    return tuple(sorted(found, key=lambda row: row.line))


def plain(cell: str) -> str:
    """A cell without ticks, emphasis, links, tags and escapes."""
    cell = cell[:LONGEST_CELL]
    cell = re.sub(r"!?\[([^\[\]]*)\]\([^()]*\)", r"\1", cell)
    cell = re.sub(r"</?(?:br|u|b|i|code|sup|nobr|p|span|em|strong|tt|a)\b[^<>]*>", " ", cell, flags=re.I)
    cell = html.unescape(cell).replace("`", " ").replace("**", "")
    return " ".join(re.sub(r"\\([\\`*_{}\[\]()<>#+.!|~-])", r"\1", cell).replace("\N{ZERO WIDTH SPACE}", "").split())


def kinds_of(text: str) -> tuple[str, ...]:
    """The kinds of ends that a heading or the head of a column names, () for none."""
    words = plain(text).lower()
    if re.search(r"\bparam(eter)?s?\b", words):
        topics = TOPICS if re.search(r"\btopics?\b|\binputs?\b|\boutputs?\b", words) else ()
        return (*topics, *PARAMETERS)
    client, server = re.search(r"\bclients?\b", words), re.search(r"\bservers?\b", words)
    if re.search(r"\bactions?\b", words):
        return ("action_clients",) if client else ("action_servers",) if server else ACTIONS
    if re.search(r"\bservices?\b", words) or client:
        return ("clients",) if client else ("servers",)
    sub = re.search(r"\binputs?\b|\bsubscri", words)
    pub = re.search(r"\boutputs?\b|\bpublish|\bpublications?\b", words)
    if sub or pub:
        return TOPICS if sub and pub else ("subscribers",) if sub else ("publishers",)
    return TOPICS if re.search(r"\btopics\b", words) else ()


def _without_comments(text: str) -> str:
    """*text* with HTML comments blanked, lines kept."""
    parts, at = [], 0
    while (start := text.find("<!--", at)) >= 0 and (end := text.find("-->", start + 4)) >= 0:
        parts += [text[at:start], "\n" * text.count("\n", start, end)]
        at = end + 3
    return "".join([*parts, text[at:]]).replace("\r\n", "\n").replace("\r", "\n")


def _tables(lines: list[str]) -> Iterator[_Table]:
    fence, headings, at = "", list[tuple[int, str]](), 0
    while at < len(lines):
        line = lines[at]
        mark = re.match(r"\s*(```+|~~~+)", line)
        if mark and (not fence or mark[1].startswith(fence)):
            fence = "" if fence else mark[1]
        elif fence:
            pass
        elif heading := re.match(r"\s{0,3}(#{1,6})\s+(\S.*)", line):
            headings = [item for item in headings if item[0] < len(heading[1])]
            headings.append((len(heading[1]), heading[2].rstrip(" #")))
        else:
            above = tuple(text for _, text in headings)
            lead = next((text for text in reversed(lines[max(0, at - 2) : at]) if text.strip()), "")
            if at + 1 < len(lines) and _is_ruler(lines[at + 1]) and "|" in line:
                header = _cells(line)
                end = at + 2
                while end < len(lines) and "|" in lines[end]:
                    end += 1
                body = tuple((number + 1, _cells(lines[number])) for number in range(at + 2, end))
                yield _Table(at + 1, header, body, above, lead)
                at = end - 1
            elif "<table" in line.lower():
                end = next(
                    (n for n in range(at, min(at + LONGEST_TABLE, len(lines))) if "</table" in lines[n].lower()), at
                )
                yield from _html(lines[at : end + 1], at + 1, above, lead)
                at = end
        at += 1


def _is_ruler(line: str) -> bool:
    return "-" in line and "|" in line and all(re.fullmatch(r":?-+:?", cell) for cell in _cells(line))


def _cells(line: str) -> tuple[str, ...]:
    line = line.strip()
    line = line.removeprefix("|")
    if line.endswith("|") and not line.endswith("\\|"):
        line = line[:-1]
    return tuple(cell.strip().replace("\\|", "|") for cell in re.split(r"(?<!\\)\|", line))


class _TableReader(HTMLParser):
    """Collects the cells of one HTML table by row, each row with its line."""

    def __init__(self) -> None:
        super().__init__(convert_charrefs=True)
        self.rows: list[tuple[int, list[str]]] = []
        self._open = False

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        if tag == "tr":
            self.rows.append((self.getpos()[0], []))
            self._open = False
        elif tag in ("td", "th") and self.rows:
            self.rows[-1][1].append("")
            self._open = True
        elif tag == "br":
            self.handle_data(", ")

    def handle_endtag(self, tag: str) -> None:
        if tag in ("td", "th", "tr"):
            self._open = False

    def handle_data(self, data: str) -> None:
        if self._open and self.rows[-1][1]:
            self.rows[-1][1][-1] += data[:LONGEST_CELL]


def _html(lines: Sequence[str], first: int, headings: tuple[str, ...], lead: str) -> Iterator[_Table]:
    text = "\n".join(lines)
    if len(text) > LONGEST_HTML_TABLE:
        return
    reader = _TableReader()
    reader.feed(text)
    reader.close()
    found = [
        (first + line - 1, tuple(" ".join(cell.split()) for cell in cells)) for line, cells in reader.rows if cells
    ]
    if found:
        yield _Table(found[0][0], found[0][1], tuple(found[1:]), headings, lead)


@dataclass(frozen=True, slots=True)
class _Columns:
    """Where a table has what: numbers of columns, None for those that it lacks; *names* are one or more."""

    names: tuple[int, ...]
    type: int | None
    default: int | None
    role: int | None
    description: int | None


def _columns(header: Sequence[str], of_launch: bool) -> _Columns | None:
    """The columns of a table with this header; None if it is one of arguments of a function, or of values that someone chose."""

    def first(fits: Callable[[str], object], besides: Sequence[int] = ()) -> int | None:
        return next((n for n, cell in enumerate(header) if fits(cell) and n not in besides), None)

    names = [n for n, cell in enumerate(header) if cell and _NAME_COLUMN.fullmatch(cell) and cell != "interface"]
    names = names if any("global" in header[n] for n in names) else names[:1]
    if not names or "i/o" in header or not _SAYS_WHAT.search(" ".join(header)):
        return None
    return _Columns(
        tuple(names),
        first(_TYPE_COLUMN.fullmatch, names),
        None if of_launch else first(_DEFAULT_COLUMN.match),  # that of an argument of a launch file is none
        first(frozenset(("interface", "interface type", "direction")).__contains__),
        first("description".__eq__),
    )


def _read(table: _Table) -> Iterator[TableRow]:
    header = [plain(cell).lower() for cell in table.header]
    title = plain(table.headings[-1]).lower() if table.headings else ""
    at = _columns(header, re.search(r"\blaunch\b", title) is not None)
    if at is None:
        return
    kinds = _kinds(table, header[at.names[0]], at.type is not None)
    for line, cells in table.rows:
        if len(cells) <= at.names[0]:
            continue
        type, default = plain(_cell(cells, at.type)) or None, plain(_cell(cells, at.default)) or None
        about_it = (line, table.line, table.headings, _cell(cells, at.description))
        here = kinds_of(_cell(cells, at.role)) or kinds
        provided = [split_names(cells[n]) for n in at.names if len(cells) > n]
        for forms in zip(*provided, strict=False) if len(provided) > 1 else ((name,) for name in provided[0]):
            spelt = tuple(form for form in forms if _NAME.fullmatch(form) and re.search(r"\w", form))
            fitting = _fitting(here, spelt, type)
            if fitting:
                yield TableRow(fitting, spelt, type, default, *about_it)


def _cell(cells: Sequence[str], column: int | None) -> str:
    """The text in a column; "" where the row or the table has none."""
    return cells[column] if column is not None and len(cells) > column else ""


def _kinds(table: _Table, column: str, typed: bool) -> tuple[str, ...]:
    """What the table is about: its name column tells, else a short line above, else the headings, innermost first."""
    messages = kinds_of(column)
    if messages == PARAMETERS or (
        messages and len(messages) == 1 and column.startswith(("input", "output", "subscr", "publish"))
    ):
        return messages
    lead = table.lead.strip()
    if len(lead) < 60 and re.match(r"[-*+]\s|\*\*|__", lead) and (found := kinds_of(lead)):
        return found
    inner = table.headings[1:] or table.headings  # the title of the page names the package
    for heading in reversed(inner):
        words = plain(heading).lower()
        found = kinds_of(heading)
        if not found and _NOT_INTERFACE.search(words):
            return ()
        if found:
            return () if _NOT_INTERFACE.search(words) and found != PARAMETERS else found
    if typed and column.startswith(("topic", "service", "action")):
        return TOPICS if column.startswith("topic") else SERVICES if column.startswith("service") else ACTIONS
    return ()


def _fitting(kinds: tuple[str, ...], names: tuple[str, ...], type: str | None) -> tuple[str, ...]:
    """Those of *kinds* that a row can be by its type: a topic has a ROS type, a parameter has none."""
    if not names:
        return ()
    ros = type is not None and is_ros_type(type)
    if type is not None and not ros:
        bare = re.fullmatch(r"[A-Z][A-Za-z0-9]+", type) and names[0].startswith(("~", "/"))
        kept = kinds if bare or type in ("?", "-") else tuple(kind for kind in kinds if kind in PARAMETERS)
    elif ros:
        kept = tuple(kind for kind in kinds if kind not in PARAMETERS)
    else:
        plainly = names[0].startswith(("~", "/"))
        kept = tuple(kind for kind in kinds if plainly or kind in PARAMETERS or kind in (*SERVICES, *ACTIONS))
    return kept


def is_ros_type(text: str) -> bool:
    """Whether *text* is one ROS type, or several with ``or`` between."""
    return all(_ROS_TYPE.fullmatch(part.strip(" ;\"'")) for part in re.split(r"\s+or\s+|,\s*|\s+\|\s+", text))


def split_names(cell: str) -> tuple[str, ...]:
    """The names in a cell, parted by commas, breaks, ``or``, ``and`` or a slash with spaces; remarks in brackets go."""
    cell = re.sub(r"<br ?/?>", ", ", cell[:LONGEST_CELL], flags=re.I)
    ticks = re.findall(r"`([^`]+)`", cell)
    parts = (
        ticks
        if ticks and not plain(re.sub(r"`[^`]+`", "", cell)).strip(" ,/&;")
        else re.split(r",\s*|\s+/\s+|;\s+|\s+and\s+|\s+or\s+", plain(cell))
    )
    names = (re.sub(r"\s*(?:\([^()]*\)|\*\d)$", "", plain(part)).strip(" ,\"'") for part in parts)
    return tuple(re.sub(r"^~(?=[^/])", "~/", name) for name in names if name)
