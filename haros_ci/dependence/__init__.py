# SPDX-License-Identifier: Apache-2.0
"""Which inputs of a node can cause which of its outputs: directly, or through state, and under which conditions."""
