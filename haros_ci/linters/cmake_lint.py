# SPDX-License-Identifier: Apache-2.0
"""cmake-lint of cmakelang on CMake files; its configuration only where it is JSON or YAML, unless that is trusted."""

from __future__ import annotations

import json
from collections.abc import Iterable, Iterator
from typing import Any

from haros_ci.linters import settings_files, texts, yaml_settings
from haros_ci.linters.linter import Batch, Command, Finding, GaveUp, LintOptions, Output, Program, Unit, When
from haros_ci.model.package import SourceFile
from haros_ci.model.workspace import Store, Workspace

NAME = "cmake-lint"
LANGUAGES = frozenset({"cmake"})
WHEN = When.ASKED
COST = 40.0

_STEMS = (".cmake-format", "cmake-format")
DATA = tuple(stem + suffix for stem in _STEMS for suffix in (".json", ".yaml"))
#: What cmake-lint itself looks for; the first may be JSON, YAML or Python, and the others with .py are Python.
NAMES = (".cmake-format", ".cmake-format.py", *DATA[:2], "cmake-format.py", *DATA[2:])
#: ``include`` reads further files; texts come to the tool decoded.
LEFT_OUT = ("include", "encode", "input_encoding", "output_encoding", "emit_byteorder_mark")


def locate(options: LintOptions) -> Program | None:
    return texts.locate("cmakelang", NAME)


def fingerprint(workspace: Workspace, options: LintOptions) -> str:
    return json.dumps([options.trust_config])


def dependencies(workspace: Workspace, file: SourceFile) -> Iterable[str]:
    return ()  # plan() knows it


def plan(workspace: Workspace, options: LintOptions, store: Store) -> Iterator[Unit]:
    names = (name for name in NAMES if options.trust_config or not name.endswith(".py"))
    return settings_files.units(workspace, LANGUAGES, dict.fromkeys(names, ()))


def command(program: Program, batch: Batch) -> Command:
    try:
        settings = _settings(batch)
    except ValueError as err:
        raise ValueError(f"{batch.group}: {err}") from err
    return texts.command(program, batch, settings)


def parse(output: Output, batch: Batch) -> Iterator[Finding | GaveUp]:
    return texts.parse(output, batch, NAME)


def _settings(batch: Batch) -> dict[str, Any]:
    if batch.group and batch.options.trust_config:
        return {"file": str(batch.workspace.root / batch.group)}
    text = batch.workspace.setting(batch.group) if batch.group else ""
    try:
        options = yaml_settings.read(text)
    except ValueError:
        if batch.group.endswith(DATA):
            raise
        options = {}  # Python, as far as one can tell
    return {"config": {key: value for key, value in options.items() if key not in LEFT_OUT}}
