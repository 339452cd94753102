# SPDX-License-Identifier: Apache-2.0
"""Node interfaces as Markdown tables for READMEs, between two comments, so that they can be made anew in place."""

from __future__ import annotations

import json
from collections.abc import Iterator, Mapping

from haros_ci.model.architecture import Architecture
from haros_ci.regex import regex
from haros_ci.report.escape import markdown, markdown_code
from haros_ci.report.model_json import plain
from haros_ci.report.node_interface import Entry, Interface, interfaces, qos_text

BEGIN, END = "<!-- haros-ci:interface -->", "<!-- /haros-ci:interface -->"
HEADINGS = {
    "publishers": "Publishers",
    "subscribers": "Subscribers",
    "servers": "Services",
    "clients": "Service clients",
    "action_servers": "Action servers",
    "action_clients": "Action clients",
    "parameters": "Parameters",
}
#: What a code span holds as it stands in any cell of a GitHub table.
_CODE = regex(r"[A-Za-z0-9_~/.,:?\[\]{}()'\"=+ -]*[A-Za-z0-9_~/.,:?\[\]{}()'\"=+-]")
_WORDS = regex(r"(?!.*__)[a-z0-9_.,? -]*")
#: Descriptions by the headings above a row (node, table) and its name as they are written.
Descriptions = Mapping[tuple[str, str, str], str]


def render(architecture: Architecture, package: str | None = None, descriptions: Descriptions | None = None) -> str:
    """The tables of the node types of *package*, or of all under a heading each, between ``BEGIN`` and ``END``.

    *descriptions*, Markdown as written in an earlier version of the tables, go into the last column. An empty table is
    left out, as are implicit ends; of those whose name is not known at all it is said that there may be more.
    """
    lines = [BEGIN, ""]
    last = None
    for item in interfaces(architecture):
        if package is None or item.package == package:
            if package is None and item.package != last:
                lines += [f"## {code(item.package)}", ""]
            last = item.package
            lines += _node(item, descriptions or {})
    if last is None:
        lines += ["No node was found.", ""]
    return "\n".join([*lines, END, ""])


def refreshed(text: str, tables: str) -> str | None:
    """*text* with *tables* in place of what is from the first ``BEGIN`` to the ``END`` behind it; None without them."""
    start = text.find(BEGIN)
    end = text.find(END, start)
    if start < 0 or end < 0:
        return None
    line_end = "\r\n" if "\r\n" in text else "\n"
    return text[:start] + tables.strip("\n").replace("\n", line_end) + text[end + len(END) :]


def code(text: str) -> str:
    """*text* as inline code that a table cell of GitHub-flavoured Markdown shows as it stands."""
    return f"`{text}`" if _CODE.fullmatch(text) else markdown_code(text)


def _node(item: Interface, descriptions: Descriptions) -> Iterator[str]:
    title = f"{code(item.type)}: {code(item.part)}" if item.part else code(item.type)
    yield from (f"### {title}", "")
    if item.is_library:
        yield from ("A class: this is what it brings into the node of whoever uses it.", "")
    result = [entry for entry in item.entries if entry.name.strip("?~/.")]
    if len(result) < len(item.entries) or any(why.field == "endpoints" for node in item.nodes for why in node.unknowns):
        yield from ("There may be more than what stands here.", "")
    elif not result:
        yield from ("No endpoints.", "")
    for kind, heading in HEADINGS.items():
        rows = [entry for entry in result if entry.kind == kind]
        if not rows:
            continue
        columns = ["Name", "Type", *_third(kind, item.ros), "Description"]
        yield from (f"#### {heading}", "", f"| {' | '.join(columns)} |", f"|{' --- |' * len(columns)}")
        for entry in rows:
            name = code(entry.name)
            cells = [name, code(entry.type or "?"), *_value(entry, item.ros)]
            cells.append(descriptions.get((title, heading, name), ""))
            yield "|" + "".join(f" {cell} |" if cell else " |" for cell in cells)
        yield ""


def _third(kind: str, ros: int) -> list[str]:
    if kind == "parameters":
        return ["Default"]
    if kind in ("publishers", "subscribers"):
        return ["Queue" if ros == 1 else "QoS"]
    return []


def _value(entry: Entry, ros: int) -> list[str]:
    if entry.kind == "parameters":
        return [" or ".join(code(text) for text in defaults(entry))]
    if entry.kind not in ("publishers", "subscribers"):
        return []
    text = qos_text(entry, ros)
    return [text if _WORDS.fullmatch(text) else markdown(text)]


def defaults(entry: Entry) -> tuple[str, ...]:
    """The defaults that the code gives a parameter, as JSON writes them, sorted; ``?`` for one that is not known."""
    texts = set()
    for end in entry.ends:
        if end.value is not None:
            texts.add(json.dumps(plain(end.value), ensure_ascii=False))
        elif any(why.field in ("value", "default") for why in end.unknowns):
            texts.add("?")
    return tuple(sorted(texts))
