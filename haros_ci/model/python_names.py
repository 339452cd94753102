# SPDX-License-Identifier: Apache-2.0
"""Names as Python reads them: in the form NFKC, so that letters of full width are those of ASCII (the language reference, "Names")."""

from __future__ import annotations

import unicodedata


def as_python_reads(text: str) -> str:
    """*text* with the letters that Python takes its names for: to look up names in it. Places in it are others than in *text*."""
    return text if text.isascii() else unicodedata.normalize("NFKC", text)
