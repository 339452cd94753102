# SPDX-License-Identifier: Apache-2.0
"""The built-in linters, in the order of their runs."""

from __future__ import annotations

from haros_ci.linters import catkin_lint, clang_tidy, cppcheck, cpplint, lizard, pylint, radon, ruff
from haros_ci.linters.linter import Linter

LINTERS: tuple[Linter, ...] = (cppcheck, cpplint, pylint, lizard, radon, ruff, clang_tidy, catkin_lint)
