# SPDX-License-Identifier: Apache-2.0
"""SARIF §3.55–§3.57: how a result can be mended, for tools that apply it. An execute bit cannot be said in SARIF."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator

from haros_ci.report.message import literal, sentence
from haros_ci.report.sarif_objects import om
from haros_ci.results.fix import Edit, Fix


def build_fixes(fixes: Iterable[Fix], artifact: Callable[[str], om.ArtifactLocation]) -> Iterator[om.Fix]:
    """The fixes that are edits of text alone."""
    for fix in fixes:
        if any(edit.is_executable for edit in fix.edits):
            continue
        by_path: dict[str, list[Edit]] = {}
        for edit in fix.edits:
            by_path.setdefault(edit.path, []).append(edit)
        yield om.Fix(
            description=om.Message(text=literal(sentence(fix.description))),
            artifact_changes=[
                om.ArtifactChange(artifact_location=artifact(path), replacements=[_replacement(edit) for edit in edits])
                for path, edits in sorted(by_path.items())
            ],
        )


def _replacement(edit: Edit) -> om.Replacement:
    (line, column), (end_line, end_column) = edit.start, edit.end
    region = om.Region(start_line=line, start_column=column, end_line=end_line, end_column=end_column)
    return om.Replacement(
        deleted_region=region, inserted_content=om.ArtifactContent(text=edit.text) if edit.text else None
    )
