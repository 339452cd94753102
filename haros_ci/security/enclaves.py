# SPDX-License-Identifier: Apache-2.0
"""In which enclave a node runs, and what it is allowed by every policy worth its name."""

from __future__ import annotations

from haros_ci.model.architecture import Node
from haros_ci.regex import regex

_ENCLAVE = regex(r"(?:^|\s)(?:--enclave|-e)\s+(/[\w/]*|[\w/]+)")
#: What the client libraries make and use in every node: the log, parameter events and services, time, types.
COMMON_TOPICS = frozenset(("/rosout", "/parameter_events", "/clock"))
COMMON_SERVICES = frozenset(
    "describe_parameters get_parameter_types get_parameters list_parameters set_parameters set_parameters_atomically"
    " get_type_description".split()
)


def enclave_of(node: Node) -> str | None:
    """The enclave that its arguments name (``--ros-args --enclave /x``); None if they do not."""
    text = node.arguments.partition("--ros-args")[2] or node.arguments
    found = _ENCLAVE.search(text)
    return None if found is None else f"/{found[1].strip('/')}"


def is_common(kind: str, name: str) -> bool:
    """Whether an end of this *kind* and full *name* is one that every node may have."""
    if kind in ("publishers", "subscribers"):
        return name in COMMON_TOPICS
    return kind in ("servers", "clients") and name.rpartition("/")[2] in COMMON_SERVICES
