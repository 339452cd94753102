# SPDX-License-Identifier: Apache-2.0
"""Names, parameters and command lines of nodes: what a configuration gives each."""
