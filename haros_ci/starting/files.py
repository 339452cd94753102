# SPDX-License-Identifier: Apache-2.0
"""The texts of a workflow, a pre-commit configuration and a project file to start from."""

from __future__ import annotations

import json
from importlib.resources import files

from haros_ci.starting.seen import Seen, is_plain

_SCHEMA = "https://raw.githubusercontent.com/haros-ci/haros-ci/main/haros_ci/config/schema.json"


def workflow(branch: str) -> str:
    """A GitHub workflow for pull requests against *branch* and pushes to it; docs/workflows has it for ``main``."""
    return _template("workflow.yml").replace("@BRANCH@", yaml(branch))


def pre_commit() -> str:
    """A pre-commit configuration with the two hooks, and nothing else."""
    return _template("pre-commit.yaml")


def project(seen: Seen) -> str:
    """A project file that says what is the case without it, except for what *seen* gives reason to leave out."""
    lines = [
        f"# yaml-language-server: $schema={_SCHEMA}",
        f"# Seen here: {seen.in_words()}. Every key: docs/configuration.md of haros-ci.",
        "",
        "profile: ros  # bugs-only for less, strict for more",
    ]
    excluded = [
        *((directory, "not written here") for directory in seen.vendored),
        *((glob, "generated") for glob in seen.generated),
    ]
    if excluded:
        lines += ["", "exclude:", *(f"  - {yaml(glob)}  # {why}" for glob, why in excluded)]
    if seen.tools:
        lines += [
            "",
            "# Their settings are here, so you may want them on; they come with: pip install 'haros-ci[linters]'",
            "# linters:",
            *(f"#   {tool}: true  # {name}" for tool, name in seen.tools),
        ]
    return "\n".join(lines) + "\n"


def yaml(text: str) -> str:
    """*text* as a YAML scalar on one line."""
    return text if is_plain(text) else json.dumps(text)


def _template(name: str) -> str:
    return files("haros_ci.starting").joinpath(name).read_text(encoding="utf-8")
