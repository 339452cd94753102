# SPDX-License-Identifier: Apache-2.0
"""Writes docs/pictures/terminal.svg: a terminal in which haros-ci runs on an example. ``python tools/record_terminal.py``

The commands run for real, in a copy of examples/warehouse_ws. Scenes follow each other; who prefers no motion sees the first.
"""

from __future__ import annotations

import os
import pty
import re
import shutil
import subprocess
import sys
import tempfile
from collections.abc import Iterator
from html import escape
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
TARGET = ROOT / "docs" / "pictures" / "terminal.svg"
COLUMNS, ROWS = 124, 24
#: Seconds for which a scene is shown.
SHOWN = 6
#: What is typed in each scene: (what a terminal shows, what runs).
SCENES = (
    ("haros-ci check src/gripper_control", ("check", "src/gripper_control")),
    ("haros-ci explain undefined-variable", ("explain", "pylint:undefined-variable")),
    ("haros-ci baseline create", ("baseline", "create")),
    ("haros-ci check .", ("check", ".")),
    ("haros-ci model", ("model",)),
)
COLORS = {
    "31": "#ff7b72",
    "32": "#7ee787",
    "33": "#e3b341",
    "34": "#79c0ff",
    "35": "#d2a8ff",
    "36": "#76e3ea",
    "90": "#8b949e",
}
#: What differs from machine to machine: versions of tools, and whether there is a sandbox.
_LOCAL = re.compile(r" with (?=[^\n]*\d+\.\d).*?\.$|^  Linters run [^\n]*\n", re.M)
_SGR = re.compile(r"\x1b\[([\d;]{0,20})m")


def recorded(arguments: tuple[str, ...], where: Path) -> str:
    """What ``haros-ci ARGUMENTS`` writes to a terminal, with the codes of colors."""
    ours, theirs = pty.openpty()
    kept = {
        name: value
        for name, value in os.environ.items()
        if not name.startswith(("GITHUB_", "HAROS_")) and name != "NO_COLOR"
    }
    environment = {**kept, "COLUMNS": str(COLUMNS), "CI": "1", "XDG_CACHE_HOME": str(where.parent / "cache")}
    command = [sys.executable, "-m", "haros_ci", *arguments]
    with subprocess.Popen(command, cwd=where, env=environment, stdin=subprocess.DEVNULL, stdout=theirs, stderr=theirs):
        os.close(theirs)
        parts = []
        while part := _read(ours):
            parts.append(part)
    os.close(ours)
    return _LOCAL.sub(".", b"".join(parts).decode("utf-8", "replace").replace("\r\n", "\n")).replace("\n.", "\n")


def _read(terminal: int) -> bytes:
    try:
        return os.read(terminal, 1 << 16)
    except OSError:  # all that wrote to it have ended
        return b""


def spans(line: str) -> Iterator[str]:
    """A line as tspans, cut at COLUMNS."""
    style, left = "", COLUMNS
    for number, piece in enumerate(_SGR.split(line)):
        if number % 2:
            codes = piece.split(";")
            color = next((COLORS[code] for code in codes if code in COLORS), "")
            style = (f' fill="{color}"' if color else "") + (' font-weight="bold"' if "1" in codes else "")
            continue
        text, left = piece[:left], left - len(piece[:left])
        if text:
            yield f"<tspan{style}>{escape(text)}</tspan>"


def picture(scenes: list[tuple[str, str]]) -> str:
    """The SVG of scenes, each a command and what it writes."""
    width, height, step = COLUMNS * 7.25 + 24, (ROWS + 2) * 17 + 40, 100 / len(scenes)
    parts = [
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width:.0f} {height}" role="img" aria-label="haros-ci in a terminal">',
        "<style>",
        "text { font: 12px ui-monospace, 'DejaVu Sans Mono', Menlo, Consolas, monospace; fill: #e6edf3; white-space: pre }",
        f".scene {{ opacity: 0; animation: shown {SHOWN * len(scenes)}s infinite }}",
        f"@keyframes shown {{ 0%, {step - 0.1:.1f}% {{ opacity: 1 }} {step:.1f}%, 100% {{ opacity: 0 }} }}",
        *(f".s{number} {{ animation-delay: {SHOWN * number}s }}" for number in range(len(scenes))),
        "@media (prefers-reduced-motion) { .scene { animation: none } .s0 { opacity: 1 } }",
        "</style>",
        f'<rect width="{width:.0f}" height="{height}" rx="8" fill="#0d1117"/>',
        *(
            f'<circle cx="{20 + 18 * n}" cy="18" r="5.5" fill="{color}"/>'
            for n, color in enumerate(("#ff5f57", "#febc2e", "#28c840"))
        ),
    ]
    for number, (typed, text) in enumerate(scenes):
        lines = text.rstrip("\n").split("\n")
        if len(lines) > ROWS:
            lines = [*lines[: ROWS - 1], "\x1b[90m…\x1b[0m"]
        parts.append(f'<g class="scene s{number}">')
        shown = [f'<tspan fill="{COLORS["32"]}">$</tspan> <tspan font-weight="bold">{escape(typed)}</tspan>']
        shown += ["".join(spans(line)) for line in lines]
        parts += (f'<text x="14" y="{48 + 17 * row}">{line}</text>' for row, line in enumerate(shown) if line)
        parts.append("</g>")
    return "\n".join((*parts, "</svg>")) + "\n"


def main() -> None:
    with tempfile.TemporaryDirectory() as scratch:
        where = Path(scratch, "warehouse_ws")
        shutil.copytree(ROOT / "examples" / "warehouse_ws", where)
        TARGET.write_text(
            picture([(typed, recorded(arguments, where)) for typed, arguments in SCENES]), encoding="utf-8"
        )


if __name__ == "__main__":
    main()
