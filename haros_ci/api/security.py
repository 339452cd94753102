# SPDX-License-Identifier: Apache-2.0
"""Policies of SROS2, and access rules of project files."""

from __future__ import annotations

from haros_ci.model.access import AccessRule
from haros_ci.security.access import Access
from haros_ci.security.enclaves import enclave_of, is_common
from haros_ci.security.permissions import Permission, Rules, verdict
from haros_ci.security.policy import NodeProfile, Policy, read_policy

__all__ = [
    "Access",
    "AccessRule",
    "NodeProfile",
    "Permission",
    "Policy",
    "enclave_of",
    "is_common",
    "Rules",
    "read_policy",
    "verdict",
]
