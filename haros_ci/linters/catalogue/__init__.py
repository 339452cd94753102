# SPDX-License-Identifier: Apache-2.0
"""What is known of each tool's rules: tables, no code."""
