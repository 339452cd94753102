# SPDX-License-Identifier: Apache-2.0
"""The mistakes of a user that end a run with exit code 2."""

from __future__ import annotations


class UserError(Exception):
    """Wrong usage or configuration: *message* names file, line and fault, *help* what to do."""

    def __init__(self, message: str, *, help: str | None = None) -> None:
        super().__init__(message)
        self.message = message
        self.help = help
