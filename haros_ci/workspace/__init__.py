# SPDX-License-Identifier: Apache-2.0
"""Everything that reads the workspace: discovery, manifests, git, the cache."""
