# SPDX-License-Identifier: Apache-2.0
"""Which interface an #include or an import means.

rosidl makes headers ``pkg/msg/foo_bar.hpp`` (``.h`` in C) with parts below ``detail/``, genmsg ``pkg/FooBar.h``; both make the Python
modules ``pkg.msg``, ``pkg.srv`` and ``pkg.action``. Of a service or action they make further types, each with an ending of its own.
"""

from __future__ import annotations

import re

from haros_ci.records import dataclass
from haros_ci.regex import regex

#: Endings of the types that are made of a service or action, besides its name.
ENDINGS = {
    "msg": ("",),
    "srv": ("", "Request", "Response", "_Request", "_Response", "_Event"),
    "action": (
        "", "Action", "Goal", "Result", "Feedback", "ActionGoal", "ActionResult", "ActionFeedback", "_Goal", "_Result", "_Feedback",
        "_SendGoal", "_GetResult", "_FeedbackMessage", "_SendGoal_Request", "_SendGoal_Response", "_GetResult_Request",
        "_GetResult_Response", "_SendGoal_Event", "_GetResult_Event",
    ),
}  # fmt: skip
_NEW_HEADER = regex(
    r"(?P<package>[a-z]\w*)/(?P<kind>msg|srv|action)/(?:detail/)?(?P<stem>\w+?)(?:__\w+)?\.h(?:pp)?\Z", re.ASCII
)
_OLD_HEADER = regex(r"(?P<package>[a-z]\w*)/(?P<stem>[A-Z][A-Za-z0-9_]*)\.h\Z", re.ASCII)
_MODULE = regex(r"(?P<package>[a-z]\w*)\.(?P<kind>msg|srv|action)\.(?P<name>[A-Z]\w*)\Z", re.ASCII)


@dataclass(frozen=True, slots=True)
class Reference:
    """A type that code names: *kind* is "" where the way it is named does not tell, *stem* has no underscores, in lower case."""

    package: str
    kind: str
    stem: str


def of_include(written: str) -> Reference | None:
    """What ``#include <written>`` means; None if it has not the form of an interface's header."""
    found = _NEW_HEADER.match(written)
    if found is not None:
        stem = found["stem"]
        return Reference(found["package"], found["kind"], _stem(stem))
    found = _OLD_HEADER.match(written)
    return Reference(found["package"], "", _stem(found["stem"])) if found is not None else None


def of_import(target: str) -> Reference | None:
    """What the Python name ``pkg.msg.T`` means; None if it has not that form."""
    found = _MODULE.match(target)
    return Reference(found["package"], found["kind"], _stem(found["name"])) if found is not None else None


def references_to(package: str, kind: str, name: str, ros: int | None) -> frozenset[Reference]:
    """All references that mean the interface *name* or a type that is made of it."""
    made = set()
    for ending in ENDINGS.get(kind, ("",)):
        stem = _stem(f"{name}{ending}")
        made.add(Reference(package, kind, stem))
        if ros != 2:
            made.add(Reference(package, "", stem))
            made.add(Reference(package, "msg", stem))  # what genaction makes are messages
    return frozenset(made)


def _stem(name: str) -> str:
    """How rosidl splits words at capitals differs between releases; without the splits it is the same."""
    return name.replace("_", "").lower()
