# SPDX-License-Identifier: Apache-2.0
"""Monitors of properties as files of their own, that run beside a system and import nothing of haros-ci (decision 0033)."""
