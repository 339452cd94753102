# SPDX-License-Identifier: Apache-2.0
"""The cross-file index: what names mean, what code mentions, what can matter."""
