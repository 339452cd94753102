# SPDX-License-Identifier: Apache-2.0
"""The cross-file part: from facts and launch files to configurations."""
