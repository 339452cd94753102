# SPDX-License-Identifier: Apache-2.0
"""Hypothesis looks at the same examples in every run: a test that fails does so for everybody."""

from __future__ import annotations

from hypothesis import settings

settings.register_profile("steady", derandomize=True, database=None, deadline=None)
settings.load_profile("steady")
