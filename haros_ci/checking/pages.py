# SPDX-License-Identifier: Apache-2.0
"""Files that tell people and machines how a workspace is built and used, and the distribution of ROS 1 that they name."""

from __future__ import annotations

from collections.abc import Iterator

from haros_ci.checking.project import Project
from haros_ci.model.named_distribution import MAX_PAGE, is_page, names_noetic, names_older


def pages(project: Project) -> Iterator[str]:
    """The texts of README files and other pages, Dockerfiles, scripts, services and settings of CI; no changelogs."""
    for path in sorted(project.workspace.names):
        if is_page(path):
            yield project.text(path)[:MAX_PAGE]


def is_for_noetic(project: Project) -> bool:
    """Whether pages and scripts are for Noetic and none names an older distribution of ROS 1; at the base revision, too, if there is one."""
    return names_noetic(pages(project)) and (project.base is None or names_noetic(pages(project.base)))


def is_for_older(project: Project) -> bool:
    """Whether pages and scripts are for distributions of ROS 1 before Noetic alone: their Python is Python 2."""
    return project.sources.once("pages for older distributions", lambda: names_older(pages(project)))
