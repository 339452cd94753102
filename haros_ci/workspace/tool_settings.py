# SPDX-License-Identifier: Apache-2.0
"""The files that tools have their settings in, by name: each holds for its directory and what lies below."""

from __future__ import annotations

#: Read at the base revision where there is one, and also from above a directory that is analysed alone. What they refer to
#: may have any name.
TOOL_SETTINGS = (
    *("CPPLINT.cfg", ".clang-tidy", ".ruff.toml", "ruff.toml", "pyproject.toml", "setup.cfg", "tox.ini"),
    *("pylintrc", ".pylintrc", "pylintrc.toml", ".pylintrc.toml"),
    *(".bandit", ".codespellrc", ".flake8", ".isort.cfg", "mypy.ini", ".mypy.ini"),
    *(".clang-format", "_clang-format", ".clang-format-ignore"),
    *(".yamllint", ".yamllint.yaml", ".yamllint.yml", ".gitignore", ".yamllintignore"),
    *(".cmakelintrc", ".cmake-format", ".cmake-format.py", ".cmake-format.json", ".cmake-format.yaml"),
    *("cmake-format.py", "cmake-format.json", "cmake-format.yaml"),
    *(".shellcheckrc", "shellcheckrc", ".hadolint.yaml", ".hadolint.yml"),
)
