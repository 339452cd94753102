# SPDX-License-Identifier: Apache-2.0
"""Bounded search for runs of a system that keep the properties of its nodes and break one of its own (docs/verify.md)."""
