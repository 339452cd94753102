# SPDX-License-Identifier: Apache-2.0
"""The table of contents: from settings to a report, each stage a function from values to values."""
