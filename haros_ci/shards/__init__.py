# SPDX-License-Identifier: Apache-2.0
"""A run divided over machines: who does what, the file that each writes, and whether files belong together."""
