# SPDX-License-Identifier: Apache-2.0
"""An example plug-in for haros-ci: each of these four names may be left out."""

from __future__ import annotations

from haros_ci_example_plugin import todo
from haros_ci_example_plugin.api_rows import API_ROWS
from haros_ci_example_plugin.camel_case_topic import CHECK
from haros_ci_example_plugin.tsv import render

__version__ = "1.0.0"

#: The version of haros_ci.api that this was written against; a haros-ci that is too old or too new refuses it.
REQUIRES_API = (2, 0)

CHECKS = (CHECK,)
LINTERS = (todo,)
RENDERERS = {"acme-tsv": render}

__all__ = ["API_ROWS", "CHECKS", "LINTERS", "RENDERERS", "REQUIRES_API"]
