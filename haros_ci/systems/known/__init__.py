# SPDX-License-Identifier: Apache-2.0
"""Nodes of packages outside the workspace: one data file per package, written from the package's documentation."""
