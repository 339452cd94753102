# SPDX-License-Identifier: Apache-2.0
"""The names of message, service and action types as code spells them."""

from __future__ import annotations


def ros_type(name: str) -> str | None:
    """``pkg/T`` of a dotted or ``::``-qualified name of a message, service or action type; None for any other name."""
    parts = [part for part in name.replace(".", "::").split("::") if part]
    for suffix in ("ConstPtr", "Ptr", "ConstSharedPtr", "SharedPtr", "UniquePtr"):
        if parts[-1:] == [suffix]:
            parts.pop()
    if parts[-1:] in (["Request"], ["Response"]):
        parts.pop()
    if len(parts) >= 3 and parts[-2] in ("msg", "srv", "action"):
        return f"{parts[-3]}/{parts[-1]}"
    if len(parts) == 2 and parts[1][:1].isupper():
        last = parts[1].removesuffix("ConstPtr") if parts[1].endswith("ConstPtr") else parts[1].removesuffix("Ptr")
        return f"{parts[0]}/{last}"
    return None
