# SPDX-License-Identifier: Apache-2.0
"""What all tests stand on: Hypothesis looks at the same examples in every run, and a shell's ignored signals are not inherited."""

from __future__ import annotations

import signal

from hypothesis import settings

settings.register_profile("steady", derandomize=True, database=None, deadline=None)
settings.load_profile("steady")

# A shell starts what runs in the background with SIGINT ignored, and so would every command that a test interrupts.
if signal.getsignal(signal.SIGINT) is signal.SIG_IGN:
    signal.signal(signal.SIGINT, signal.default_int_handler)
