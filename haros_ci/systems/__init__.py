# SPDX-License-Identifier: Apache-2.0
"""From packages and launch files to configurations: every node with its endpoints."""
