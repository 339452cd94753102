# SPDX-License-Identifier: Apache-2.0
"""Messages are sentences, with links to related locations and to nothing else."""

from __future__ import annotations

from dataclasses import replace

import pytest
from report_samples import NULL_RESULT

from haros_ci.model.location import Location
from haros_ci.report.message import MAX_MESSAGE, linked, number, plain
from haros_ci.results.result import Related

HERE = Related(Location("a.cpp", 3), "Declared here.")
THERE = Related(Location("b.cpp", 4), "")


@pytest.mark.parametrize(
    ("message", "related", "said", "text"),
    [
        ("Null pointer", (), "Null pointer.", "Null pointer."),
        ("Null pointer.", (HERE,), "Null pointer.", "Null pointer. See [Declared here](1)."),
        ("Two\n  lines", (HERE, THERE), "Two lines.", "Two lines. See [Declared here](1), [b.cpp:4](2)."),
        ("Was [declared](1) before", (HERE,), "Was declared before.", "Was [declared](1) before."),
        ("Was [declared](1)", (HERE, THERE), "Was declared.", "Was [declared](1). See [b.cpp:4](2)."),
        (r"Index [v\[0\]](1)", (HERE,), "Index v[0].", r"Index [v\[0\]](1)."),
        ("Index v[0]", (), "Index v[0].", "Index v[0]."),
        ("Lambda [this](int x)", (), "Lambda [this](int x).", r"Lambda \[this\](int x)."),
        (
            "See [x](https://evil.example)",
            (HERE,),
            "See [x](https://evil.example).",
            r"See \[x\](https://evil.example). See [Declared here](1).",
        ),
        ("Not [ours](2)", (HERE,), "Not [ours](2).", r"Not \[ours\](2). See [Declared here](1)."),
        ("Not [ours](1)", (), "Not [ours](1).", r"Not \[ours\](1)."),
        ("Really?", (), "Really?", "Really?"),
        ("", (), "No message.", "No message."),
        ("\x1b[31mred", (), "�[31mred.", "�[31mred."),
    ],
)
def test_messages(message: str, related: tuple[Related, ...], said: str, text: str) -> None:
    result = replace(NULL_RESULT, message=message, related=related)
    assert plain(result) == said
    assert linked(result) == text


def test_what_reads_as_a_link_in_a_name_of_the_workspace_is_none() -> None:
    result = replace(NULL_RESULT, tool="haros-ci", message="No package [here](1)", related=(HERE,))
    assert plain(result) == "No package [here](1)."
    assert linked(result) == r"No package \[here\](1). See [Declared here](1)."


def test_brackets_in_labels_are_escaped() -> None:
    near = Related(Location("a.cpp", 3), "v[0](x)")
    assert linked(replace(NULL_RESULT, message="Out of range", related=(near,))) == r"Out of range. See [v\[0\](x)](1)."


def test_long_messages_are_cut() -> None:
    result = replace(NULL_RESULT, message="word " * 10_000, related=())
    assert len(plain(result)) <= MAX_MESSAGE and plain(result).endswith("...")


@pytest.mark.parametrize(
    ("value", "written"), [(None, None), (12.0, 12), (0.5, 0.5), (float("nan"), None), (float("inf"), None), (-3.0, -3)]
)
def test_numbers(value: float | None, written: float | None) -> None:
    assert number(value) == written and type(number(value)) is type(written)
