# SPDX-License-Identifier: Apache-2.0
"""Parameter files that launch files load and that are no YAML, or have no parameters for rcl."""

from __future__ import annotations

import re
from collections.abc import Iterator

from haros_ci.api import Check, Finding, Level, Location, System, regex
from haros_ci.api.launch import FileUse, ParameterFileUse, yaml_fault
from haros_ci.api.packages import conflicts

_SECTION = "ros__parameters"
#: A key that is meant to be the one below which a node's parameters stand.
_MEANT = regex(r"^([ \t]*)[\"']?((?i:ros[_-]{0,3}param(?:eter)?s?))[\"']?[ \t]*:(?=[ \t]*(?:\{|#|\r?$))", re.M)
_KEY = regex(r"^([ \t]*)[\"']?([^\s#\"':][^\n\"':]*)[\"']?[ \t]*:", re.M)


def check(system: System) -> Iterator[Finding]:
    if system.workspace is None:
        return
    reported: set[str] = set()
    for finding in _malformed(system):
        reported.add(finding.at.path)
        yield finding
    for use in system.facts(ParameterFileUse):
        refused = use.refused
        if refused is None or refused.path in reported:
            continue
        reported.add(refused.path)
        yield Finding(
            at=Location(refused.path, refused.line),
            message=f"{refused.problem}, which rcl refuses: the node that is given {refused.path} does not start; {refused.advice}",
            about=(refused.path, refused.problem),
            flow=(
                (use.location, "the file is given to a node"),
                (Location(refused.path, refused.line), refused.problem),
            ),
            presence=use.presence,
        )


def _malformed(system: System) -> Iterator[Finding]:
    """Files that are no YAML, and a key in another form."""
    assert system.workspace is not None, system
    seen: set[str] = set()
    for use in system.facts(FileUse):
        path = use.path
        if use.kind != "parameters" or use.is_found is not True or path is None or path in seen:
            continue
        seen.add(path)
        if conflicts(system.workspace.text(path)):
            continue  # merge-conflict says it
        text = system.workspace.text(path)
        fault = yaml_fault(text) if path.endswith((".yaml", ".yml")) else None
        if fault is None:
            if use.ros == 2 and path.endswith((".yaml", ".yml")):
                yield from _misspelt(text, path, use)
            continue
        line, why = fault
        effect = "roslaunch stops here" if use.ros == 1 else "the node that is given it does not start"
        yield Finding(
            at=Location(path, line),
            message=f"{path} is not valid YAML: {why}; {effect}; correct the line, or the one before it",
            about=(path,),
            presence=use.presence,
        )


def _misspelt(text: str, path: str, use: FileUse) -> Iterator[Finding]:
    """The key ``ros__parameters`` in another form: rcl takes it for a name, and what stands below for values outside of any node's parameters."""
    above: list[tuple[int, str]] = []
    meant = {match.start(2) for match in _MEANT.finditer(text) if match[2] != _SECTION}
    for match in _KEY.finditer(text) if meant else ():
        depth = len(match[1])
        while above and above[-1][0] >= depth:
            above.pop()
        if match.start(2) in meant and _SECTION not in {key for _, key in above}:
            yield Finding(
                at=Location(path, text.count("\n", 0, match.start()) + 1),
                message=f"{match[2]} is no key of parameter files: the node that is given {path} does not start; write {_SECTION}",
                about=(path, match[2]),
                presence=use.presence,
            )
            return
        above.append((depth, match[2].strip()))


CHECK = Check(
    id="malformed-parameter-file",
    summary="Parameter file that is not valid YAML, or that rcl refuses.",
    level=Level.ERROR,
    tags=("parameters", "launch"),
    run=check,
)
