# SPDX-License-Identifier: Apache-2.0
"""The site of the pages: every page stands in its navigation once, and links mean what they mean on the repository's web view."""

from __future__ import annotations

import importlib.util
import re
import xml.etree.ElementTree as ET
from collections import Counter
from pathlib import Path
from types import ModuleType

import pytest

ROOT = Path(__file__).resolve().parent.parent
SHOWN = [
    "docs/ci.md",
    "docs/cli.md",
    "docs/decisions/0001-a.md",
    "docs/rules/README.md",
    "docs/rules/ruff.md",
    "README.md",
]


def tool(name: str) -> ModuleType:
    found = importlib.util.spec_from_file_location(name, ROOT / "tools" / f"{name}.py")
    assert found is not None and found.loader is not None
    module = importlib.util.module_from_spec(found)
    found.loader.exec_module(module)
    return module


SITE = tool("build_site")


def test_every_page_stands_in_the_navigation_once() -> None:
    pages = [path for path in SITE.shown() if path.endswith(".md")]
    text = SITE.settings(pages, {})
    named = Counter(re.findall(r"(?:- |: )([\w./-]+\.md)$", text, re.M))
    assert sorted(named) == pages
    assert [page for page, count in named.items() if count > 1] == []
    assert "/*" not in text


@pytest.mark.parametrize(
    ("markdown", "expected"),
    [
        ("[a](cli.md)", "[a](cli.md)"),
        ("[a](cli.md#check)", "[a](cli.md#check)"),
        ("[a](../README.md)", "[a](../README.md)"),
        ("[a](https://example.org/x)", "[a](https://example.org/x)"),
        ("[a](#below)", "[a](#below)"),
        ("[a](rules/)", "[a](rules/README.md)"),
        ("[a](../action.yml)", "[a](https://github.com/haros-ci/haros-ci/blob/main/action.yml)"),
        ("[a](../pyproject.toml#L3)", "[a](https://github.com/haros-ci/haros-ci/blob/main/pyproject.toml#L3)"),
        ("[a](../haros_ci)", "[a](https://github.com/haros-ci/haros-ci/tree/main/haros_ci)"),
        ("[a](nowhere.md)", "[a](nowhere.md)"),  # which mkdocs reports
        ("```\n[a](../action.yml)\n```", "```\n[a](../action.yml)\n```"),
        ("it is:\n- one\n- two", "it is:\n\n- one\n- two"),
        ("- one\n- two\n  more", "- one\n- two\n  more"),
        ("1. one\n   - inner", "1. one\n    - inner"),
        ("```\nit is:\n- one\n```", "```\nit is:\n- one\n```"),
    ],
)
def test_a_page_of_the_site(markdown: str, expected: str) -> None:
    assert SITE.page_for_site("docs/ci.md", markdown, SHOWN) == expected + "\n"


def test_requirements_are_pinned() -> None:
    lines = (ROOT / ".ci" / "site-requirements.txt").read_text(encoding="utf-8").splitlines()
    assert all(re.fullmatch(r"[\w-]+==[\w.]+", line) for line in lines if not line.startswith("#"))


def test_the_recording_is_of_its_scenes() -> None:
    recording = ROOT / "docs" / "pictures" / "terminal.svg"
    scenes = ET.parse(recording).getroot().findall("{*}g")
    typed = ["".join(scene[0].itertext()) for scene in scenes]
    assert typed == [f"$ {command}" for command, _ in tool("record_terminal").SCENES]
    assert "<script" not in recording.read_text(encoding="utf-8")
