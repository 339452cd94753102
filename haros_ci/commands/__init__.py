# SPDX-License-Identifier: Apache-2.0
"""The commands: what each does with its flags, where its output goes, and its exit code."""
