# SPDX-License-Identifier: Apache-2.0
"""Programs followed without running them: one node from its entry, on all paths."""
