# SPDX-License-Identifier: Apache-2.0
"""The example of docs/monitor.md is what the command says."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from haros_ci.cli import main

PAGE = (Path(__file__).resolve().parents[2] / "docs" / "monitor.md").read_text(encoding="utf-8")


def test_the_example(tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch) -> None:
    (lines,) = re.findall(r"```json\n(.*?)```", PAGE, re.DOTALL)
    said, _ = re.findall(r"```text\n(.*?)```", PAGE, re.DOTALL)  # the other is of model --observed
    (text,) = re.findall(r"on the lines above says of `([^`]*)`", PAGE)
    (tmp_path / "run.jsonl").write_text(lines, encoding="utf-8")
    monkeypatch.chdir(tmp_path)
    assert main(["monitor", "--jsonl", "run.jsonl", "--property", text, "--no-cache"]) == 1
    assert capsys.readouterr().out == said
