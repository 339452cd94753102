# SPDX-License-Identifier: Apache-2.0
"""What silences ruff or mypy in our sources has a reason on its line; .ci/lint has pinned versions, and .ci/run begins with it."""

from __future__ import annotations

import io
import re
import tokenize
from collections.abc import Iterator
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parent.parent

#: ``# type: ignore[code]`` or ``# noqa: CODE``, and what follows it.
_SWITCH = re.compile(
    r"#\s*(?:type:\s*ignore(?P<type>\[[\w, -]+\])?|noqa(?P<noqa>:\s*[A-Z]+[0-9]+)?)(?P<rest>.*)\Z", re.S
)


def without_reason(text: str) -> Iterator[int]:
    """Lines with a comment that silences ruff or mypy and has no code, or no reason behind it."""
    for token in tokenize.generate_tokens(io.StringIO(text).readline):
        found = _SWITCH.match(token.string) if token.type == tokenize.COMMENT else None
        if found is not None and not ((found["type"] or found["noqa"]) and re.search(r"\w{2}", found["rest"])):
            yield token.start[0]


@pytest.mark.parametrize(
    "line",
    [
        "a = b  # type: ignore[index]",
        "a = b  # type: ignore",
        "a = b  # type: ignore  # the table is a dict",
        "a = b  # noqa: B007",
        "a = b  # noqa",
        "a = b  # noqa: B007 -",
    ],
)
def test_no_reason(line: str) -> None:
    assert list(without_reason(line + "\n")) == [1]


@pytest.mark.parametrize(
    "line",
    [
        "a = b  # type: ignore[index]  # the table is a dict",
        "a = b  # type: ignore[index, unused-ignore]  # the table is a dict",
        "a = b  # noqa: B007 - the last one is used",
        "a = b  # noqa: BLE001 (whatever it raises)",
        "a = '# type: ignore[index]'",
        "a = b  # the types are known",
        "#: Comments like ``# noqa: CODE``.",
        "a = b",
    ],
)
def test_a_reason_or_nothing_to_give_one_for(line: str) -> None:
    assert list(without_reason(line + "\n")) == []


@pytest.mark.parametrize("room", ["haros_ci", "checks"])
def test_every_switch_of_ours_has_a_reason(room: str) -> None:
    found = [
        f"{path.relative_to(ROOT)}:{line}"
        for path in sorted((ROOT / room).rglob("*.py"))
        if "ignore" in (text := path.read_text(encoding="utf-8")) or "noqa" in text
        for line in without_reason(text)
    ]
    assert found == []


def test_ci_begins_with_lint_and_types() -> None:
    run = (ROOT / ".ci" / "run").read_text(encoding="utf-8")
    parts = [
        run.index(part)
        for part in (
            "\n.ci/lint install\n",
            "\n(.ci/lint check && .ci/site) > ",
            "pytest",
            '\nwait "$beside" || { cat ',
        )
    ]
    assert parts == sorted(parts)
    script = (ROOT / ".ci" / "lint").read_text(encoding="utf-8")
    assert all(command in script for command in ('/ruff" check .', '/ruff" format --check .', '/mypy"', "'.[dev]'"))


def test_the_versions_that_decide_are_pinned() -> None:
    text = (ROOT / "pyproject.toml").read_text(encoding="utf-8")
    extra = re.search(r"^dev = \[\n(.*?)^\]", text, re.M | re.S)
    assert extra is not None
    pins = re.findall(r'"([^"]+)"', extra[1])
    assert pins and all("==" in pin for pin in pins)
    assert {"ruff", "mypy"} <= {pin.partition("==")[0] for pin in pins}
