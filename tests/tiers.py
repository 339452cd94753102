# SPDX-License-Identifier: Apache-2.0
"""Which tests are slow: those that start processes, analyse whole workspaces, or try bounds, attacks and random inputs."""

from __future__ import annotations

import re
from functools import cache
from pathlib import Path

TESTS = Path(__file__).resolve().parent
#: Directories whose tests are slow as a whole: whole systems, attacks, fuzzers, a browser.
SLOW = frozenset(("changes", "fuzz", "haros_json", "hostile", "html_page", "link", "plugins", "security", "shards"))
#: Words in names of modules that try bounds, attacks and random inputs.
_TRYING = re.compile(
    r"bounds|broken|doubting|hostile|joins|linear_patterns|matching|monitor|plain_words|republishing|semantics|stalled|test_run\b"
)
#: What a module names that starts processes, or reads and analyses whole workspaces.
_HEAVY = re.compile(
    r"\b(?:subprocess|commandline|installing|multitool|selenium|small_robot|git_histories|ros1_kit|discover|varied|analyse|cli\.main|faults)\b"
)


@cache
def is_slow(path: Path) -> bool:
    """Whether the tests of a module are of the slow tier."""
    inside = path.relative_to(TESTS)
    if inside.parts[0] in SLOW or _TRYING.search(path.name):
        return True
    return _HEAVY.search(path.read_text(encoding="utf-8")) is not None
