# SPDX-License-Identifier: Apache-2.0
"""Properties in HPL held against messages with times, one message after the other (docs/monitor.md)."""
