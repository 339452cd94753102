# SPDX-License-Identifier: Apache-2.0
"""Paths in launch files that only one machine has."""

from __future__ import annotations

import re
from collections.abc import Iterator

from haros_ci.api import Check, Finding, Level, System
from haros_ci.api.launch import PathUse, included_by

#: Files that must not be installed with a package, where everybody reads them: keys, certificates and other credentials.
_SECRET = re.compile(
    r"\.(?:pem|key|crt|cer|der|csr|p12|pfx|jks|keystore|ppk|asc|gpg|htpasswd|token|secret|kdbx?|env)$"
    r"|(?:^|/)(?:id_(?:rsa|dsa|ecdsa|ed25519)|authorized_keys|known_hosts|\.netrc|\.pgpass)(?:\.pub)?$"
    r"|/\.(?:ssh|gnupg|aws|kube)/"
    r"|(?:^|[/_.-])(?:api_?keys?|tokens?|secrets?|passwords?|passwd|credentials?|private_?keys?)(?:[_.-][^/]*)?$",
    re.IGNORECASE,
)
_WHY = {"home": "lies in a user's home directory", "absolute": "is an absolute path"}


def check(system: System) -> Iterator[Finding]:
    said: set[str] = set()
    for use in system.facts(PathUse):
        if use.text in said:
            continue
        said.add(use.text)
        of = f" of {use.name!r}" if use.name else ""
        find = "$(find-pkg-share ...)" if use.ros == 2 else "$(find ...)"
        is_secret = _SECRET.search(use.text) is not None
        advice = f"write {find}, or use a launch argument" if not is_secret else "take the path from a launch argument"
        yield Finding(
            at=use.location,
            message=f"{use.text}{of} {_WHY[use.kind]}: other machines do not have this path; {advice}",
            about=(use.text,),
            flow=included_by(use),
            apart=(use.text,),
            presence=use.presence,
            level=Level.NOTE if is_secret else None,
        )


CHECK = Check(
    id="machine-specific-path",
    summary="Absolute or home directory path in a launch file.",
    level=Level.WARNING,
    catalogue="L06",
    tags=("launch",),
    run=check,
)
