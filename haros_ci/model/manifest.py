# SPDX-License-Identifier: Apache-2.0
"""What a package.xml tells people."""

from __future__ import annotations

from haros_ci.records import dataclass


@dataclass(frozen=True, slots=True, kw_only=True)
class Manifest:
    """The texts of a package.xml; *authors* and *maintainers* are names, the addresses are as written, "" if there is none."""

    description: str = ""
    authors: tuple[str, ...] = ()
    maintainers: tuple[str, ...] = ()
    website: str = ""
    repository: str = ""
    bugtracker: str = ""
