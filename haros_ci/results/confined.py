# SPDX-License-Identifier: Apache-2.0
"""What a report says of how linters were confined; linters/sandbox.py knows the machine, this the words."""

from __future__ import annotations

from collections.abc import Collection

#: By the word that stands for it in shard files; the strongest first.
SENTENCES = {
    "files-network": "Linters run in a sandbox: they can open the analysed files only, and have no network.",
    "files": "Linters run in a sandbox: they can open the analysed files only. The network is not switched off for them.",
    "trusted": "Linters run without a sandbox, as the workspace is trusted (--trust-config).",
    "off": "Linters run without a sandbox, as HAROS_CI_SANDBOX is off.",
    "none": "Linters run without a sandbox: this system has none (Landlock, Linux 5.13 or later).",
}


def sentence(ways: Collection[str]) -> str:
    """Of machines that confine linters in these *ways*: the weakest, and that not all are like it; "" for no machine."""
    if not ways:
        return ""
    weakest = max(ways, key=list(SENTENCES).index)
    return SENTENCES[weakest] if len(set(ways)) == 1 else f"On a part of the machines: {SENTENCES[weakest]}"
