# SPDX-License-Identifier: Apache-2.0
"""Macros that make endpoints are named where a change brings them."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import pytest
from linter_samples import workspace

from haros_ci.linters.endpoint_macros import notifications
from haros_ci.model.workspace import Workspace

MAKE = "#define ARM_MAKE(T, n) create_publisher<T>(n, 10)\n"


def space(root: Path, files: dict[str, str]) -> Workspace:
    made = workspace(root, files)
    return replace(made, files=tuple(replace(file, language="cpp") for file in made.files))


def said(place: Path, base: dict[str, str], head: dict[str, str]) -> list[tuple[str | None, int | None]]:
    return [(note.path, note.line) for note in notifications(space(place / "head", head), space(place / "base", base))]


@pytest.mark.parametrize(
    "text",
    [
        MAKE,
        "#define ARM_MAKE(n) \\\n  nh.advertise<T>(n, 10)\n",
        "# define SUB node->create_subscription\n",
        "#define T(x) nh.subscribe(x)\n",
    ],
)
def test_named(tmp_path: Path, text: str) -> None:
    assert said(tmp_path, {"a.hpp": "int a;\n"}, {"a.hpp": "int a;\n" + text}) == [("a.hpp", 2)]


@pytest.mark.parametrize(
    "text",
    [
        "auto p = create_publisher<T>(n, 10);\n",
        "// " + MAKE,
        f'auto text = R"(\n{MAKE})";\n',
        "#define ARM_LOG(x) log(x)\nauto p = create_publisher<T>(n, 10);\n",
        "#define ARM_MAKE(x) create_publishers(x)\n",
        '#define ARM_SAY(x) say("create a subscribe", x)\n',
    ],
)
def test_quiet(tmp_path: Path, text: str) -> None:
    assert said(tmp_path, {"a.hpp": "int a;\n"}, {"a.hpp": "int a;\n" + text}) == []


def test_what_the_base_had(tmp_path: Path) -> None:
    assert said(tmp_path, {"a.hpp": MAKE}, {"a.hpp": MAKE + "int a;\n"}) == []
    assert said(tmp_path, {"a.hpp": MAKE}, {"b.hpp": "int a;\n" + MAKE}) == []
    assert notifications(space(tmp_path, {"a.hpp": MAKE}), None) == ()
