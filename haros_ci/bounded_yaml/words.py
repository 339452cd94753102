# SPDX-License-Identifier: Apache-2.0
"""The words of libyaml, which speak of its grammar, in words about the text."""

from __future__ import annotations

#: What the words of libyaml mean for who wrote the text.
MEANS = {
    "found character that cannot start any token": "a tab stands in the indentation, or a text that begins with @, ` or % lacks quotes",
    "mapping values are not allowed in this context": "a key is indented too far, or a text that has ': ' in it lacks quotes",
    "did not find expected key": "the line is indented otherwise than those above it",
    "did not find expected '-' indicator": "the line is indented otherwise than those above it",
    "could not find expected ':'": "a line without a colon stands among keys",
    "did not find expected ',' or ']'": "a bracket is not closed, or a comma is missing",
    "did not find expected ',' or '}'": "a brace is not closed, or a comma is missing",
    "found unexpected end of stream": "a quote is not closed",
}


def explained(problem: str) -> str:
    """The parser's *problem*, and what it means where that is known."""
    return f"{problem} ({MEANS[problem]})" if problem in MEANS else problem
