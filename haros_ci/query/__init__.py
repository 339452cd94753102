# SPDX-License-Identifier: Apache-2.0
"""Questions about the architecture in HAROS's query language, pyflwor: paths, sets and for-let-where-return."""
