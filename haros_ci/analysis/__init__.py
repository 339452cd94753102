# SPDX-License-Identifier: Apache-2.0
"""From a workspace to its architecture, and what is said of it: checks, queries, comparison, what was kept."""
