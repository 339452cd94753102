# SPDX-License-Identifier: Apache-2.0
"""What ends a run with a sentence: the mistakes of a user (exit code 2), and what the machine refuses (3)."""

from __future__ import annotations

#: Exit codes beside 0 and 1, as docs/first-steps.md lists them.
EXIT_USAGE, EXIT_TOOL_TROUBLE, EXIT_INTERRUPTED = 2, 3, 130


class UserError(Exception):
    """Wrong usage or configuration: *message* names file, line and fault, *help* what to do."""

    def __init__(self, message: str, *, help: str | None = None) -> None:
        super().__init__(message)
        self.message = message
        self.help = help


class RunFailure(Exception):
    """What ends a run with exit code 3: the call is right, but the machine cannot do it. *message* and *help* as in UserError."""

    def __init__(self, message: str, *, help: str | None = None) -> None:
        super().__init__(message)
        self.message = message
        self.help = help
