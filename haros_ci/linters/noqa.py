# SPDX-License-Identifier: Apache-2.0
"""``# noqa`` for pylint: what flake8 is told to pass over, pylint need not report under another name."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable

from haros_ci.results.result import Result

#: The codes of flake8 (pycodestyle, pyflakes, bugbear) for the defects that pylint reports, too.
CODES = {
    "anomalous-backslash-in-string": "W605",
    "bare-except": "E722 B001",
    "cell-var-from-loop": "B023",
    "comparison-with-itself": "B015",
    "dangerous-default-value": "B006",
    "expression-not-assigned": "B018 F633",
    "format-needs-mapping": "F502",
    "function-redefined": "F811",
    "pointless-statement": "B018",
    "redefined-builtin": "A001 A002",
    "reimported": "F811",
    "self-assigning-variable": "PLW0127",
    "singleton-comparison": "E711 E712",
    "undefined-all-variable": "F822",
    "undefined-variable": "F821",
    "unused-import": "F401",
    "unused-variable": "F841",
    "unused-wildcard-import": "F403",
    "used-before-assignment": "F821 F823",
    "wildcard-import": "F403",
    "wrong-import-position": "E402",
}
#: As flake8's ``defaults.NOQA_INLINE_REGEX``.
_NOQA = re.compile(r"#\s{0,9}noqa(?::[\s]?(?P<codes>[A-Z][0-9]+(?:[,\s]+(?=[A-Z][0-9])[A-Z][0-9]+)*))?", re.IGNORECASE)


def without_noqa(results: Iterable[Result], text: Callable[[str], str]) -> tuple[Result, ...]:
    """*results* without those of pylint on lines whose ``# noqa`` is for the same defect, or for all; *text* reads a path."""
    lines: dict[str, list[str]] = {}
    kept = []
    for result in results:
        path, line = result.location.path, result.location.line
        if result.tool == "pylint" and result.rule in CODES and line:
            if path not in lines:
                whole = text(path)
                lines[path] = whole.split("\n") if "noqa" in whole.lower() else []
            if line <= len(lines[path]) and _is_silenced(lines[path][line - 1], CODES[result.rule].split()):
                continue
        kept.append(result)
    return tuple(kept)


def _is_silenced(line: str, codes: list[str]) -> bool:
    found = _NOQA.search(line)
    if found is None:
        return False
    named = re.split(r"[,\s]+", found["codes"].upper()) if found["codes"] else []
    return not named or any(code.startswith(name) for code in codes for name in named)
