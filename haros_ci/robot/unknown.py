# SPDX-License-Identifier: Apache-2.0
"""The value that stands for all that are not known while a description is expanded."""

from __future__ import annotations


class UnknownValue:
    """Never a value of a Robot, where what is not known is None."""

    __slots__ = ()

    def __repr__(self) -> str:
        return "UNKNOWN"


UNKNOWN = UnknownValue()
