# SPDX-License-Identifier: Apache-2.0
"""All looks at what a change brings that linters, or the model, see in another way than whoever compiles or runs it: notes."""

from __future__ import annotations

from haros_ci.linters import (
    absent_parts,
    endpoint_macros,
    given_endpoints,
    lone_returns,
    lost_installs,
    lost_setup,
    missing_names,
    other_domains,
    refused_interfaces,
    seen_otherwise,
    started_instead,
    swapped_types,
    unbound_names,
    used_aside,
)
from haros_ci.model.workspace import Workspace
from haros_ci.results.result import Notification

_LOOKS = (
    seen_otherwise,
    used_aside,
    endpoint_macros,
    given_endpoints,
    lone_returns,
    lost_installs,
    lost_setup,
    started_instead,
    unbound_names,
    missing_names,
    other_domains,
    refused_interfaces,
    absent_parts,
    swapped_types,
)


def notifications(head: Workspace, base: Workspace | None) -> tuple[Notification, ...]:
    """What *head* has of this, and *base* has not; none without a base."""
    return tuple(note for look in _LOOKS for note in look.notifications(head, base))
