# SPDX-License-Identifier: Apache-2.0
"""Texts of launch files and YAML as values: names, paths, substitutions and conditions of which a part may be unknown."""
