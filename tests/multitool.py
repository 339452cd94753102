# SPDX-License-Identifier: Apache-2.0
"""Validates SARIF logs with Microsoft's SARIF Multitool, the checker that GitHub's documentation names.

The program is the platform binary of the npm package ``@microsoft/sarif-multitool-linux`` (``Sarif.Multitool``): the
wrapper package passes its arguments through a shell, so it is not used. It is found through ``SARIF_MULTITOOL``, else
under ``node_modules`` of the repository root, and must be executable, which npm does not always make it.
"""

from __future__ import annotations

import json
import os
import subprocess
import tempfile
from collections.abc import Mapping
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parent.parent
INSTALLED = ROOT / "node_modules" / "@microsoft" / "sarif-multitool-linux" / "Sarif.Multitool"

#: SARIF2006 is always off: it fetches every address over the network. GH1004 still takes 5 runs and 1000 results for the
#: limits, where GitHub documents 20 and 25 000 (which our own tests hold); it is off for logs with more.
ALWAYS_OFF = ("SARIF2006.UrisShouldBeReachable",)
OFF_FOR_LARGE_LOGS = ("GH1004.ReviewArraysThatExceedConfigurableDefaults",)


def policy(off: tuple[str, ...]) -> str:
    rules = "".join(
        f'<Properties Key="{rule}.Options">'
        '<Property Key="RuleEnabled" Value="Disabled" Type="Driver.RuleEnabledState" /></Properties>'
        for rule in off
    )
    return f'<?xml version="1.0" encoding="utf-8"?><Properties>{rules}</Properties>'


def binary() -> Path:
    """The program; skips the test where it is not installed, but fails it on CI."""
    path = Path(os.environ.get("SARIF_MULTITOOL") or INSTALLED)
    if not path.is_file():
        message = f"SARIF Multitool is not at {path}: npm install @microsoft/sarif-multitool-linux"
        if os.environ.get("CI"):
            pytest.fail(message)
        pytest.skip(message)
    return path


Said = list[tuple[str, str, str]]


def validate(log: str | Path, *, notes: bool = False, large: bool = True) -> Said:
    """(level, rule id, message) of all that rule kinds Sarif and Ghas say of *log* (its text or its path).

    Notes are left out unless asked for: they recommend what GitHub does not read.
    """
    return validate_all({"log": log}, notes=notes, large=large)["log"]


def validate_all(logs: Mapping[str, str | Path], *, notes: bool = False, large: bool = True) -> dict[str, Said]:
    """The same for many logs by name, in one process, as starting it takes most of the time."""
    program = binary()
    with tempfile.TemporaryDirectory() as scratch:
        names = {f"log{i}.sarif": name for i, name in enumerate(logs)}
        for file, name in names.items():
            log = logs[name]
            Path(scratch, file).write_bytes(log.read_bytes() if isinstance(log, Path) else log.encode("utf-8"))
        said, settings = Path(scratch, "said.json"), Path(scratch, "policy.xml")
        settings.write_text(policy(ALWAYS_OFF + OFF_FOR_LARGE_LOGS * large), encoding="utf-8")
        levels = "Error;Warning;Note" if notes else "Error;Warning"
        arguments = ["--rule-kind", "Sarif;Ghas", "--level", levels, "--log", "ForceOverwrite"]
        arguments += ["--config", str(settings), "--output", str(said), *(str(Path(scratch, file)) for file in names)]
        done = subprocess.run(
            [str(program), "validate", *arguments],
            env={**os.environ, "DOTNET_SYSTEM_GLOBALIZATION_INVARIANT": "1"},
            capture_output=True,
            text=True,
            timeout=600,
            check=False,
        )
        assert said.is_file(), f"the validator wrote nothing: {done.stdout}{done.stderr}"
        (run,) = json.loads(said.read_text(encoding="utf-8-sig"))["runs"]
    assert f"{len(names)} files scanned" in done.stdout, done.stdout
    (invocation,) = run["invocations"]
    trouble = invocation.get("toolExecutionNotifications", []) + invocation.get("toolConfigurationNotifications", [])
    assert not [note for note in trouble if note.get("level") == "error"], trouble
    rules = {rule["id"]: rule for rule in run["tool"]["driver"].get("rules", [])}
    findings: dict[str, Said] = {name: [] for name in logs}
    for result in run.get("results", []):
        uri = result["locations"][0]["physicalLocation"]["artifactLocation"]["uri"]
        findings[names[uri.rpartition("/")[2]]].append(_finding(result, rules))
    return {name: sorted(found) for name, found in findings.items()}


def _finding(result: dict[str, object], rules: dict[str, dict[str, object]]) -> tuple[str, str, str]:
    message, rule = result["message"], result["ruleId"]
    assert isinstance(message, dict) and isinstance(rule, str)
    text = message.get("text")
    if text is None:
        strings = rules[rule]["messageStrings"]
        assert isinstance(strings, dict)
        text = strings[message["id"]]["text"]
        for i, argument in enumerate(message.get("arguments", [])):
            text = text.replace(f"{{{i}}}", argument)
    return str(result.get("level", "warning")), rule, text
