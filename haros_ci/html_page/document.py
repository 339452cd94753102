# SPDX-License-Identifier: Apache-2.0
"""The page as text: our code, our style and one block of data in a frame that lets nothing else in.

The data is JSON in which ``<``, ``>`` and ``&`` are escaped, so that no text of a workspace ends the block. The policy allows the
script and the style whose hashes it names, and no request of any kind (CSP level 3).
"""

from __future__ import annotations

import html
import json
from base64 import b64encode
from collections.abc import Iterator, Mapping
from hashlib import sha256
from importlib.resources import files
from typing import Any

from haros_ci.report.escape import terminal

#: The parts of the script, in this order; each may use what those before it define.
SCRIPTS = (
    "dom.js",
    "data.js",
    "table.js",
    "markdown.js",
    "picture.js",
    "dependence.js",
    "trace.js",
    "history.js",
    "overview.js",
    "findings.js",
    "details.js",
    "quality.js",
    "system.js",
    "programs.js",
    "launch.js",
    "transforms.js",
    "lists.js",
    "sequence.js",
    "properties.js",
    "metrics.js",
    "changes.js",
    "main.js",
)
STYLE = "page.css"
_FRAME = """<!DOCTYPE html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta http-equiv="Content-Security-Policy" content="{policy}">
<meta name="viewport" content="width=device-width, initial-scale=1">
<meta name="referrer" content="no-referrer">
<title>{title}</title>
<style>{style}</style>
</head>
<body>
<noscript><p>This report needs JavaScript. Nothing of it is fetched from anywhere.</p></noscript>
<div id="page"></div>
<script type="application/json" id="data">{data}</script>
<script>{script}</script>
</body>
</html>
"""


def page(title: str, data: Mapping[str, Any]) -> str:
    """The whole file, ASCII in its data, the same for the same *data*."""
    script, style = code(), asset(STYLE)
    policy = f"default-src 'none'; script-src '{hash_of(script)}'; style-src '{hash_of(style)}'; base-uri 'none'; form-action 'none'"
    return _FRAME.format(
        policy=policy,
        title=html.escape(terminal(title[:200])),
        style=style,
        data=escaped(data),
        script=script,
    )


def escaped(data: Any) -> str:
    """JSON that no HTML parser sees anything in."""
    text = json.dumps(data, ensure_ascii=True, allow_nan=False, separators=(",", ":"))
    return text.replace("&", r"\u0026").replace("<", r"\u003c").replace(">", r"\u003e")


def code() -> str:
    """The script, its parts in one function so that nothing of it is a global; lines that are comments, and indents, are for who reads its source, and left out."""
    parts = ["\n".join(_bare(asset(name))) for name in SCRIPTS]
    return '\n"use strict";\n(() => {\n' + "\n".join(parts) + "\n})();\n"


def _bare(script: str) -> Iterator[str]:
    """The lines of a part that are not comments as a whole, without indents; no text of ours goes over lines (tests/html_page/test_html_document.py)."""
    return (line for line in map(str.lstrip, script.splitlines()) if not line.startswith("//"))


def asset(name: str) -> str:
    """The text of a file of ``assets/``."""
    return (files("haros_ci.html_page") / "assets" / name).read_text(encoding="utf-8")


def hash_of(text: str) -> str:
    """As a policy names what stands between the tags (CSP, hash-source)."""
    return f"sha256-{b64encode(sha256(text.encode('utf-8')).digest()).decode('ascii')}"
