# SPDX-License-Identifier: Apache-2.0
"""Recordings of messages, read one message after the other within limits; what is in them is data of the workspace (docs/monitor.md)."""
