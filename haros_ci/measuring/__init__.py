# SPDX-License-Identifier: Apache-2.0
"""Metrics of functions from their syntax, and of classes over the whole workspace; docs/metrics.md defines them."""
