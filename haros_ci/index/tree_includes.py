# SPDX-License-Identifier: Apache-2.0
"""Which headers bring the factory of BehaviorTree.CPP, by which programs make trees and register the types of their nodes."""

from __future__ import annotations

#: The factory's own header, and those of the library that include it: its parser, and what logs a tree (versions 3 and 4).
_FACTORY, _LIBRARY = "/bt_factory.h", "behaviortree_cpp"
_INCLUDING = ("/xml_parsing.h", "/bt_parser.h", "/loggers/")


def brings_trees(include: str) -> bool:
    """Whether *include*, as it is written, is of a header that brings the factory."""
    return _FACTORY in include or (_LIBRARY in include and any(part in include for part in _INCLUDING))
