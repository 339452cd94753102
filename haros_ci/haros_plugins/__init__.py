# SPDX-License-Identifier: Apache-2.0
"""HAROS's own plug-ins (``haros_plugin_*``), run in processes of their own (docs/haros-plugins.md)."""
