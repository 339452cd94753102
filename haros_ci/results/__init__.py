# SPDX-License-Identifier: Apache-2.0
"""The vocabulary of findings, and the pure functions that work on them."""
