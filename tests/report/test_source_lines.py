# SPDX-License-Identifier: Apache-2.0
"""Quoted lines: counted as editors count, capped, without secrets, columns unchanged."""

from __future__ import annotations

import pytest

from haros_ci.report.source_lines import MAX_QUOTED, lines_of, quoted, split


@pytest.mark.parametrize(
    ("text", "lines"),
    [
        ("a\nb\n", ["a", "b", ""]),
        ("a\r\nb\rc", ["a", "b", "c"]),
        ("a\x0cb\u2028c\x85d", ["a\x0cb\u2028c\x85d"]),
        ("", [""]),
    ],
)
def test_split(text: str, lines: list[str]) -> None:
    assert split(text) == lines


@pytest.mark.parametrize(
    ("line", "hidden"),
    [
        ('password = "hunter22";', "hunter22"),
        ("  API_KEY: 'abcd1234'", "abcd1234"),
        ('{"token": "s3cr3t-value"}', "s3cr3t-value"),
        ("git clone https://ghp_0123456789abcdefghijABCDEFGHIJ@x", "ghp_0123456789abcdefghijABCDEFGHIJ"),
        ("key: AKIAABCDEFGHIJKLMNOP", "AKIAABCDEFGHIJKLMNOP"),
        ('secret = "cut off before its en', "cut off before its en"),
    ],
)
def test_secrets_are_masked(line: str, hidden: str) -> None:
    assert quoted(line) == line.replace(hidden, "*" * len(hidden))


@pytest.mark.parametrize(
    "line",
    [
        'std::string token = next("tok");',
        "password = read_password()",
        'ROS_INFO("token: %s", token);',
        "#include <base/secret.hpp>",
        "ghp_short",
        "auto x = 'a';\tint y;",
        "",
    ],
)
def test_code_is_not_masked(line: str) -> None:
    assert quoted(line) == line


def test_controls_are_replaced_and_tabs_stay() -> None:
    assert quoted("\ta\x1b[2J\u202e") == "\ta�[2J�"


def test_long_lines_are_cut() -> None:
    assert len(quoted("x" * 100_000)) == MAX_QUOTED


def test_files_are_read_once() -> None:
    read: list[str] = []

    def reader(path: str) -> str:
        read.append(path)
        return "a\nb"

    lines = lines_of(reader)
    assert [lines("x"), lines("x"), lines("y")] == [["a", "b"]] * 3
    assert read == ["x", "y"]
