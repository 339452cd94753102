# SPDX-License-Identifier: Apache-2.0
"""Policies of SROS2."""

from __future__ import annotations

from haros_ci.security.enclaves import enclave_of, is_common
from haros_ci.security.permissions import Permission, Rules, verdict
from haros_ci.security.policy import NodeProfile, Policy, read_policy

__all__ = [
    "NodeProfile",
    "Permission",
    "Policy",
    "enclave_of",
    "is_common",
    "Rules",
    "read_policy",
    "verdict",
]
