# SPDX-License-Identifier: Apache-2.0
"""What ``haros-ci init`` writes: what is seen of a workspace, and the files that follow from it. Pure texts, no I/O."""
