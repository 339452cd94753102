# SPDX-License-Identifier: Apache-2.0
"""A page of nothing but a change: what ``haros-ci diff`` has found."""

from __future__ import annotations

from haros_ci import __version__
from haros_ci.html_page.data import Input, data_of
from haros_ci.html_page.document import page
from haros_ci.model.changes import Changes
from haros_ci.model.workspace import Workspace
from haros_ci.results.result import Baseline, Provenance, Report, Run, Tool


def change_page(changes: Changes, workspace: Workspace, name: str, base: str, head: str | None) -> str:
    """The page; *base* and *head* are commits, None is the work tree. Of *workspace* it has no more than what the change touches."""
    report = Report(
        (Run(Tool("haros-ci", __version__), changes=changes),),
        baseline=Baseline("revision", base[:12]),
        provenance=None if head is None else Provenance("", head, ""),
    )
    bare = Workspace(workspace.root, (), (), workspace.reader)
    data = data_of(Input(report=report, workspace=bare, name=name))
    return page(f"{name} – haros-ci diff", {**data, "only": "changes"})
