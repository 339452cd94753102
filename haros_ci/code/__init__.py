# SPDX-License-Identifier: Apache-2.0
"""What code does when it runs: a call graph over the programs of a workspace, what callbacks reach, and light flow facts."""
