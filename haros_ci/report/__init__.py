# SPDX-License-Identifier: Apache-2.0
"""One renderer per format: a Report goes in, text comes out."""
