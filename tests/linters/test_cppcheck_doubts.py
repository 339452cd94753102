# SPDX-License-Identifier: Apache-2.0
"""Findings of cppcheck that the text refutes, and those that it does not."""

from __future__ import annotations

import pytest

from haros_ci.linters.cppcheck_doubts import is_refuted

UNREAD = "Variable 'kFirst' is assigned a value that is never used."
REFUTED = [
    ("unreadVariable", UNREAD, "const int kFirst = 1;\nswitch (a) {\n  case kFirst: return 1;\n}"),
    ("unreadVariable", UNREAD, "const int kFirst = 1;\nswitch (a) {\n  case (kBase + kFirst):\n    return 1;\n}"),
    ("unreadVariable", UNREAD, "const int kFirst = 1;\ncase\n  kFirst: return 1;\n"),
    ("assignBoolToPointer", "Boolean value assigned to pointer.", 'm.def("f", &f, "on"_a = false);'),
    ("selfAssignment", "Redundant assignment of '\"a\"' to itself.", 'm.def("f", &f, "a"_a="a");'),
]
STANDS = [
    ("unreadVariable", UNREAD, "int kFirst = 1;\nswitch (a) { case 1: return kSecond; }"),
    ("unreadVariable", UNREAD, "int kFirst = 1;\nswitch (a) { case kFirstOfAll: return 1; }"),
    ("unreadVariable", UNREAD, "int kFirst = 1;\nswitch (a) { case 1: kFirst = 2; }"),
    ("unreadVariable", UNREAD, "int kFirst = 1; // in this lowercase kFirst\n"),
    ("assignBoolToPointer", "Boolean value assigned to pointer.", "int* p = false;"),
    ("assignBoolToPointer", "Boolean value assigned to pointer.", 'p = "a"_s == b;'),
    ("assignBoolToPointer", "Boolean value assigned to pointer.", ""),
    ("nullPointer", "Null pointer dereference: 'p'", 'f("on"_a = *p);'),
]


@pytest.mark.parametrize(("rule", "message", "text"), REFUTED)
def test_refuted(rule: str, message: str, text: str) -> None:
    assert is_refuted(rule, message, 1, text)


@pytest.mark.parametrize(("rule", "message", "text"), STANDS)
def test_stands(rule: str, message: str, text: str) -> None:
    assert not is_refuted(rule, message, 1, text)
