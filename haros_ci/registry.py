# SPDX-License-Identifier: Apache-2.0
"""Which linters there are: an explicit list that you can grep."""

from __future__ import annotations

from haros_ci.linters import cppcheck, cpplint, lizard, pylint, radon
from haros_ci.linters.linter import Linter

LINTERS: tuple[Linter, ...] = (cpplint, cppcheck, pylint, lizard, radon)
