# SPDX-License-Identifier: Apache-2.0
"""Properties of nodes and systems: the language HPL, where its texts stand, and what can be said of them (docs/hpl.md)."""
