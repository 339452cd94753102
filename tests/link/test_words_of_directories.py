# SPDX-License-Identifier: Apache-2.0
"""What stands for a directory in a command line of a launch file is part of one word."""

from __future__ import annotations

import pytest

from haros_ci.graph.words import shell_words


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("arm --param-file $(workspace .)/config/a.yaml", ["arm", "--param-file", "$(workspace .)/config/a.yaml"]),
        ("$(workspace src/arm)/a b", ["$(workspace src/arm)/a", "b"]),
        ("$(workspace my robots)/a b", ["$(workspace my robots)/a", "b"]),
        ("x '$(find-pkg-share arm)/y z' w", ["x", "$(find-pkg-share arm)/y z", "w"]),
        ("$(find arm)/a b", ["$(find arm)/a", "b"]),
        ("(a b)", ["(a", "b)"]),
        ("$(a) b", ["$(a)", "b"]),
        ("a 'b c", ["a", "'b", "c"]),
    ],
)
def test_words(text: str, words: list[str]) -> None:
    assert shell_words(text) == words
