# SPDX-License-Identifier: Apache-2.0
"""Launch files evaluated: which nodes they start, with which names, parameters and remappings, and under which arguments."""
