# SPDX-License-Identifier: Apache-2.0
"""Plug-ins: modules of others, imported from where haros-ci is installed and never from the workspace (docs/plugins.md)."""
