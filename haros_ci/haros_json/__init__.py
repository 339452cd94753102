# SPDX-License-Identifier: Apache-2.0
"""The JSON files that HAROS exports and its visualizer shows, made of a run of ours (``--output haros-json=DIR``)."""
