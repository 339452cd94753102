# SPDX-License-Identifier: Apache-2.0
"""The text of a file of code as evidence against a finding: without comments, and without what stands in texts."""

from __future__ import annotations

from haros_ci.code.codebase import Codebase
from haros_ci.results.code_alone import code_alone


def alone(code: Codebase, path: str) -> str:
    """The text of the C++ or Python file at *path*, with blanks for comments and for texts of more than a word."""
    is_python = any(source.program.language == "python" for source in code.sources if source.path == path)
    return code_alone(code.text(path), "python" if is_python else "c")
