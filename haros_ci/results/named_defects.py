# SPDX-License-Identifier: Apache-2.0
"""Rules whose findings are about one name each: in an edited line, the same words of another name is another defect."""

from __future__ import annotations

import re
from collections.abc import Callable

from haros_ci.regex import regex
from haros_ci.results.fingerprint import quoted_names

#: Rules on names that are not there, or not declared: the name is the defect.
OF_MISSING_NAMES = frozenset(
    """
    flake8:F821 flake8:F822 haros-ci:missing-launch-file haros-ci:parameter-file-missing haros-ci:share-file-missing haros-ci:undeclared-dependency
    haros-ci:undeclared-import haros-ci:undeclared-launch-dependency haros-ci:undeclared-lookup-dependency
    haros-ci:undeclared-plugin-dependency haros-ci:undeclared-test-dependency haros-ci:undefined-attribute haros-ci:undefined-field
    haros-ci:undefined-in-xacro haros-ci:undefined-interface haros-ci:undefined-name haros-ci:unknown-executable haros-ci:unknown-package
    haros-ci:unknown-package-in-code haros-ci:unknown-plugin haros-ci:unknown-target haros-ci:unset-launch-argument
    mypy:attr-defined mypy:name-defined pylint:no-member pylint:no-name-in-module pylint:undefined-all-variable pylint:undefined-variable
    pylint:used-before-assignment ruff:F821 ruff:F822
    """.split()
)

#: Rules on names that nothing uses. Such a name may be changed; if the old one is still there, or the new one was, it is another one.
OF_UNUSED_NAMES = frozenset(
    """
    clang-tidy:misc-unused-parameters cppcheck:unreadVariable cppcheck:unusedAllocatedMemory cppcheck:unusedFunction
    cppcheck:unusedStructMember cppcheck:unusedVariable flake8:F401 flake8:F841 haros-ci:unused-launch-argument
    pylint:unused-argument pylint:unused-import pylint:unused-variable ruff:F401 ruff:F841
    """.split()
)

_AT_THE_END = regex(r": ([\w:.]+)\.?\Z")


def is_other_defect(rule: str, before: str, after: str, base: str | None, head: Callable[[], str]) -> bool:
    """Whether the message *after* of *rule* (``tool:rule``) is about another defect than the one *before*.

    *base* is the text of the old file, None where it cannot be had, and *head* gives that of today's. Advice behind a semicolon does not
    count. Messages without names are about the same.
    """
    if rule not in OF_MISSING_NAMES and rule not in OF_UNUSED_NAMES:
        return False
    old, new = _names(before), _names(after)
    if not old or not new or set(old) == set(new):
        return False
    if rule in OF_MISSING_NAMES:
        return True
    if set(old) & set(new) or base is None:
        return False
    text = head()
    return any(_is_in(name, text) for name in old) or any(_is_in(name, base) for name in new)


def _names(message: str) -> tuple[str, ...]:
    """The names that *message* is about: in quotes, or at its end."""
    words = message.partition("; ")[0]
    last = _AT_THE_END.search(words)
    return quoted_names(words) or ((last[1],) if last else ())


def _is_in(name: str, text: str) -> bool:
    return re.search(rf"(?<!\w){re.escape(name)}(?!\w)", text) is not None
