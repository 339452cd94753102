# SPDX-License-Identifier: Apache-2.0
"""Property-based tests of nodes and configurations as files of a team's own (docs/testgen.md): what is in them, and how they are written."""
