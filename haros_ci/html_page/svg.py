# SPDX-License-Identifier: Apache-2.0
"""One configuration as a picture of its own, for READMEs and wikis: the same that the page shows, without what is behind switches.

A script, a link or an address is nowhere in it; names are text. Light or dark is the reader's.
"""

from __future__ import annotations

from collections.abc import Iterator

from haros_ci.html_page.elements import Drawn, Elements, elements
from haros_ci.html_page.layout import CHARACTER, HEAD, LINE, MOST_LINES, Layout, Rectangle, laid_out
from haros_ci.model.architecture import Configuration, Node
from haros_ci.report.channels import Channel, is_known
from haros_ci.report.xml_tags import escaped, tag

_STYLE = (
    "text{font:12px system-ui,'DejaVu Sans',sans-serif;fill:#1b1f26;text-anchor:middle}.s{fill:#555d69;font-size:10.5px}.o{font-size:10.5px;text-anchor:start}"
    ".n text:first-of-type{font-weight:600}.b text{text-anchor:start;font-weight:600;fill:#555d69}rect,path{stroke:#7b8494;stroke-width:1.2}.ground{fill:#fff;stroke:none}"
    ".n>rect{fill:#e8eefc}.topics>rect{fill:#eef7ea}.services>path{fill:#fdf3e1}.actions>path{fill:#f6eafb}.b>rect{fill:#00000008}.e{fill:none}.tip{fill:#7b8494;stroke:none}"
    ".c>rect,.c>path,.e.c{stroke-dasharray:6 4}.u>rect,.u>path{stroke:#8a4b00;stroke-dasharray:2 3}"
    "@media(prefers-color-scheme:dark){text{fill:#e7eaee}.s,.b text{fill:#a7b0bc}.ground{fill:#14171c}.n>rect{fill:#24314d}.topics>rect{fill:#20382a}.services>path{fill:#40341d}"
    ".actions>path{fill:#38264a}.b>rect{fill:#ffffff0a}}"
)


def render(one: Configuration) -> str | None:
    """The picture, with a final newline; None for what is too large to be drawn."""
    made = elements(one)
    shown = [number for number, channel in enumerate(made.channels) if not channel.switch]
    layout = laid_out(made)
    if layout is None:
        return None
    return "\n".join([*_parts(one, made, layout, shown), "</svg>", ""])


def _parts(one: Configuration, made: Elements, layout: Layout, shown: list[int]) -> Iterator[str]:
    places = [*layout.nodes, *layout.boxes, *(layout.channels[number] for number in shown)]
    width = max((x + w for x, _, w, _ in places), default=0) + 14
    height = max((y + h for _, y, _, h in places), default=0) + 14
    yield tag("svg", {"xmlns": "http://www.w3.org/2000/svg", "viewBox": f"0 0 {width} {height}", "width": width, "height": height, "role": "img"})  # fmt: skip
    yield f"<title>{escaped(one.name)}</title><style>{_STYLE}</style>"
    yield '<defs><marker id="arrow" viewBox="0 0 8 8" refX="7" refY="4" markerWidth="9" markerHeight="9" markerUnits="userSpaceOnUse" orient="auto"><path class="tip" d="M0 0.5L7.5 4L0 7.5Z"/></marker></defs>'
    yield tag("rect", {"class": "ground", "width": width, "height": height}, closed=True)
    for box, place in zip(made.boxes, layout.boxes, strict=True):
        yield f'<g class="b">{_rectangle(place, 6)}{_text(place[0] + 8, place[1] + 14, _cut(f"{box.kind} {box.name}", place[2]))}</g>'
    kept = set(shown)
    for number, channel, gives, points in layout.edges:
        if channel in kept:
            yield _edge(made.nodes[number], made.channels[channel].channel, gives, points)
    for number, place in enumerate(layout.nodes):
        yield _node(made.nodes[number], made.own[number], place)
    for number in shown:
        yield _channel(made.channels[number], layout.channels[number])


def _edge(node: Node, channel: Channel, gives: bool, points: tuple[int, ...]) -> str:
    ends = [
        end
        for owner, end in channel.ends
        if owner is node and (end.kind in ("publishers", "clients", "action_clients")) is gives
    ]
    conditional = node.conditions or node.presence or (ends and all(end.conditions for end in ends))
    path = "L".join(f"{x} {y}" for x, y in zip(points[::2], points[1::2], strict=True))
    return tag(
        "path", {"class": "e c" if conditional else "e", "d": f"M{path}", "marker-end": "url(#arrow)"}, closed=True
    )


def _node(node: Node, own: list[Channel], place: Rectangle) -> str:
    x, y, width, _ = place
    classes = _classes("n", bool(node.conditions or node.presence), is_known(node.name))
    lines = [
        f"{'→' if channel.ends[0][1].kind in ('publishers', 'clients', 'action_clients') else '←'} {channel.name}"
        for channel in own[:MOST_LINES]
    ]
    lines += [f"and {len(own) - MOST_LINES} more"] if len(own) > MOST_LINES else []
    middle = x + width // 2
    return (
        f'<g class="{classes}">{_rectangle(place, 4)}{_text(middle, y + 16, _cut(node.name.rpartition("/")[2], width * 0.86))}'
        f"{_text(middle, y + 30, _cut(f'{node.package}/{node.type}', width * 1.1), 's')}"
        f"{''.join(_text(x + 8, y + HEAD + 8 + n * LINE, _cut(line, width * 1.1), 'o') for n, line in enumerate(lines))}</g>"
    )


def _channel(drawn: Drawn, place: Rectangle) -> str:
    x, y, width, height = place
    channel = drawn.channel
    classes = _classes(channel.what, channel.conditional, is_known(channel.name) and bool(channel.types))
    right, bottom, middle = x + width, y + height, y + height // 2
    shape = {
        "services": f'<path d="M{x + 9} {y}H{right}L{right - 9} {bottom}H{x}Z"/>',
        "actions": f'<path d="M{x + 10} {y}H{right - 10}L{right} {middle}L{right - 10} {bottom}H{x + 10}L{x} {middle}Z"/>',
    }.get(channel.what, _rectangle(place, height // 2))
    return f'<g class="{classes}">{shape}{_text(x + width // 2, y + 16, _cut(channel.name, width - 12))}</g>'


def _classes(kind: str, conditional: bool, known: bool) -> str:
    return " ".join([kind, *(["c"] if conditional else []), *([] if known else ["u"])])


def _rectangle(place: Rectangle, radius: int) -> str:
    x, y, width, height = place
    return tag("rect", {"x": x, "y": y, "width": width, "height": height, "rx": radius}, closed=True)


def _text(x: int, y: int, words: str, kind: str | None = None) -> str:
    return f"{tag('text', {'x': x, 'y': y, 'class': kind})}{escaped(words)}</text>"


def _cut(words: str, width: float) -> str:
    most = max(4, int((width - 8) / CHARACTER))
    return words if len(words) <= most else f"{words[: most - 1]}…"
