# SPDX-License-Identifier: Apache-2.0
"""``haros-ci check --output FORMAT`` as CI systems call it: files, stdout, and what stderr says beside it."""

from __future__ import annotations

import csv
import io
import json
import sys
from collections.abc import Callable
from pathlib import Path
from xml.etree import ElementTree

import pytest
from commandline import write

from haros_ci import cli
from haros_ci.commands import output

MANIFEST = """<package format="3">
  <name>lift</name><version>1.0.0</version><description>A lift.</description>
  <maintainer email="a@example.org">A</maintainer><license>Apache-2.0</license>
</package>
"""
NEW = [format for format in output.FORMATS if format not in ("text", "sarif", "github", "json")]

#: How many findings each format tells of, read by a program that knows nothing of us.
READERS: dict[str, Callable[[str], int]] = {
    "junit": lambda text: sum(
        (failure.text or "").count(" [") for failure in ElementTree.fromstring(text).iter("failure")
    ),
    "gitlab": lambda text: len(json.loads(text)),
    "rdjson": lambda text: len(json.loads(text)["diagnostics"]),
    "checkstyle": lambda text: len(list(ElementTree.fromstring(text).iter("error"))),
    "csv": lambda text: len(list(csv.DictReader(io.StringIO(text), strict=True))),
    "markdown": lambda text: text.count("\n| error | "),
}
FLAGS = ("check", ".", "--profile", "architecture", "--no-cache")


@pytest.fixture
def lift(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    root = write(tmp_path / "lift", {"package.xml": MANIFEST, "launch/lift.launch": "<launch>\n  <node\n"})
    monkeypatch.chdir(root)
    return root


def run(*arguments: str) -> int:
    code = cli.haros_ci.main(list(arguments), standalone_mode=False)
    assert isinstance(code, int)
    return code


@pytest.mark.parametrize("format", NEW)
def test_a_format_on_stdout_is_pure(lift: Path, format: str, capfd: pytest.CaptureFixture[str]) -> None:
    assert run(*FLAGS, "--output", format, "--statistics", "--timings") == 1
    said = capfd.readouterr()
    assert READERS[format](said.out) == 1
    assert "malformed-launch-file" in said.out and "lift.launch" in said.out
    assert "per 1000 lines" in said.err and "per 1000 lines" not in said.out


@pytest.mark.parametrize("format", NEW)
def test_a_format_in_a_file(lift: Path, format: str, capfd: pytest.CaptureFixture[str]) -> None:
    assert run(*FLAGS, "--output", f"{format}=out/report", "--output", "text") == 1
    assert READERS[format]((lift / "out/report").read_text(encoding="utf-8")) == 1
    said = capfd.readouterr()
    assert "lift.launch:" in said.out and said.err == ""
    again = (lift / "out/report").read_bytes()
    assert run(*FLAGS, "--output", f"{format}=out/report", "--output", "text") == 1
    assert (lift / "out/report").read_bytes() == again


@pytest.mark.parametrize("format", NEW)
def test_known_findings_are_not_open(lift: Path, format: str, capfd: pytest.CaptureFixture[str]) -> None:
    assert run("baseline", "create", *FLAGS[1:]) == 0
    capfd.readouterr()
    assert run(*FLAGS, "--output", format) == 0
    said = capfd.readouterr().out
    if format == "csv":
        assert [row["state"] for row in csv.DictReader(io.StringIO(said))] == ["unchanged"]
    else:
        assert READERS[format](said) == 0
        assert ("unchanged: launch/lift.launch" in said) == (format == "junit")


@pytest.mark.parametrize("format", sorted(output.SILENT))
def test_formats_without_a_place_for_trouble_say_it_on_stderr(
    lift: Path, format: str, capfd: pytest.CaptureFixture[str]
) -> None:
    assert run(*FLAGS, "--output", format, "--baseline-rev", "nowhere", "--no-require-baseline") == 1
    said = capfd.readouterr()
    assert "no baseline" in said.err and READERS[format](said.out) == 1


@pytest.mark.parametrize("format", NEW)
def test_two_formats_never_share_stdout(lift: Path, format: str) -> None:
    from haros_ci.errors import UserError

    with pytest.raises(UserError, match="cannot share stdout"):
        run(*FLAGS, "--output", format, "--output", "text")


def test_a_format_is_imported_when_it_is_asked_for() -> None:
    import subprocess

    code = "import sys, haros_ci.commands.output, haros_ci.commands.common; print(sorted(m for m in sys.modules if 'haros_ci.report' in m))"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True, timeout=60)
    assert done.stdout.strip() == "[]"
