# SPDX-License-Identifier: Apache-2.0
"""Texts that break formats, for the tests of every renderer that a program reads."""

from __future__ import annotations

from dataclasses import replace

from hypothesis import strategies as st
from report_samples import COVERAGE, HOSTILE

from haros_ci.model.location import Location
from haros_ci.results.result import (
    BaselineState,
    Identity,
    Notification,
    Related,
    Report,
    Result,
    Run,
    Suppression,
    Tool,
)
from haros_ci.results.rule import Level, Rule

PIECES = (
    "]]>", "--", "-->", "<!--", "&", "&amp;", "<", ">", '"', "'", "\n", "\r\n", "\r", "\t", "\0", "\x0b", "\x1b[2J", "\x7f", "\x85",
    "\u2028", "\u202e", "\u2066", "\ufeff", "\ufffe", "\uffff", "\ud800", "\udce9", "\udfff", "\U0001fffe", "\U000e0041", "😀", "e\u0301",
    "=1+1", "@SUM(1)", "+", "-2", ",", ";", "|", "`", "``", "[a](b)", "![a](b)", "www.evil.example", "https://e.example", "a@b.example",
    "@team", "#12", "!7", "GH-3", "::error::", "##[group]", "{", "}", "\\", "%0A", "</testsuite>", "<![CDATA[", "null", " ", "a", "漢",
    *HOSTILE,
)  # fmt: skip
#: Mostly such pieces, now and then any text at all.
TEXTS = st.one_of(st.lists(st.sampled_from(PIECES), max_size=6).map("".join), st.text(st.characters(), max_size=12))
LONG = "größe <&\x00]]> " * 70_000  # more than 1 MB


def report_saying(text: str, *more: str) -> Report:
    """*text* wherever foreign text can stand: as a finding of each kind, of a tool that worked and of one that failed."""
    said = (*more, text, text, text)
    place = Location(f"src/{text}", 3, 2, 3, 4)
    result = Result(
        said[0],
        said[1],
        Level.ERROR,
        said[2],
        place,
        related=(Related(place, text),),
        subject=(text,),
        also=(text,),
        scope=text,
        reason=text,
        identity=Identity(scope=text, snippet=text),
    )
    note = Notification(Level.ERROR, text, said[0], place.path, 3)
    rule = Rule(said[1], text, help_uri=text, tags=(text,), catalogue=text)
    old = replace(result, state=BaselineState.UNCHANGED, suppressions=(Suppression("inSource", text),))
    gone = replace(result, state=BaselineState.ABSENT)
    runs = (
        Run(Tool(said[0], text, text), (rule,), (result, old, gone), (note,), frozenset({place.path, text})),
        Run(Tool(f"b{text}", text), notifications=(note,), successful=False),
    )
    return Report(runs, notifications=(note,), coverage=COVERAGE)
