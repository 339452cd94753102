# SPDX-License-Identifier: Apache-2.0
"""Checks over the architecture: what they see of a system, what they say, and how that becomes results."""
