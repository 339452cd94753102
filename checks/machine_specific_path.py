# SPDX-License-Identifier: Apache-2.0
"""Paths in launch files that only one machine has."""

from __future__ import annotations

import re
from collections.abc import Iterator

from haros_ci.api import Check, Finding, Level, System
from haros_ci.api.launch import ArgumentDeclaration, PathUse, included_by

#: Files that must not be installed with a package, where everybody reads them: keys, certificates and other credentials.
_SECRET = re.compile(
    r"\.(?:pem|key|crt|cer|der|csr|p12|pfx|jks|keystore|ppk|asc|gpg|htpasswd|token|secret|kdbx?|env)$"
    r"|(?:^|/)(?:id_(?:rsa|dsa|ecdsa|ed25519)|authorized_keys|known_hosts|\.netrc|\.pgpass)(?:\.pub)?$"
    r"|/\.(?:ssh|gnupg|aws|kube)/"
    r"|(?:^|[/_.-])(?:api_?keys?|tokens?|secrets?|passwords?|passwd|credentials?|private_?keys?)(?:[_.-][^/]*)?$",
    re.IGNORECASE,
)
_WHY = {"home": "lies in a user's home directory", "absolute": "is an absolute path"}


#: An instruction of a Dockerfile that makes a directory, with its lines; and absolute paths in it.
_MAKES = re.compile(r"^[ \t]*(WORKDIR|VOLUME|COPY|ADD|RUN)\b((?:[^\n]*\\[ \t]*\n)*[^\n]*)", re.I | re.M)
_MADE = re.compile(r"\b(?:mkdir|git\s+clone)\b([^&;|\n]*)")
_ABSOLUTE = re.compile(r"(?<![\w./$}:-])/[\w.-]+(?:/[\w.-]+)*")
_MAX_TEXT = 200_000


def _is_dockerfile(path: str) -> bool:
    name = path.rpartition("/")[2].lower()
    return name.startswith(("dockerfile", "containerfile")) or name.endswith(".dockerfile")


def _of_containers(system: System) -> frozenset[str]:
    """The directories that the Dockerfiles of the workspace make or copy to: inside the container they are there."""
    if system.workspace is None:
        return frozenset()
    found: set[str] = set()
    for path in sorted(filter(_is_dockerfile, system.workspace.names)):
        for match in _MAKES.finditer(system.workspace.text(path)[:_MAX_TEXT]):
            word, rest = match[1].upper(), match[2].replace("\\\n", " ")
            texts = [rest]
            if word in ("COPY", "ADD"):
                texts = re.split(r"[\s,]+", rest.strip().rstrip("]").strip())[-1:]
            elif word == "RUN":
                texts = [made[1] for made in _MADE.finditer(rest)]
            found.update(each[0] for text in texts for each in _ABSOLUTE.finditer(text.replace('"', " ")))
    return frozenset(found)


def _is_below(path: str, directories: frozenset[str]) -> bool:
    parts = path.split("/")
    return any("/".join(parts[:count]) in directories for count in range(2, len(parts)))


def check(system: System) -> Iterator[Finding]:
    said: set[str] = set()
    uses = system.facts(PathUse)
    if not uses:
        return
    defaults = {(each.location, each.name): each.default or "" for each in system.facts(ArgumentDeclaration)}
    containers = _of_containers(system)
    for use in uses:
        if use.text in said:
            continue
        said.add(use.text)
        of = f" of {use.name!r}" if use.name else ""
        find = "$(find-pkg-share ...)" if use.ros == 2 else "$(find ...)"
        is_secret = _SECRET.search(use.text) is not None
        is_default = use.text in defaults.get((use.location, use.name), "")
        is_inside = _is_below(use.text, containers)
        if is_secret:
            advice = "take the path from a launch argument"
        elif is_default:
            advice = f"write {find}, or leave the default out"
        else:
            advice = f"write {find}, or use a launch argument"
        yield Finding(
            at=use.location,
            message=f"{use.text}{of} {_WHY[use.kind]}: other machines do not have this path; {advice}",
            about=(use.text,),
            flow=included_by(use),
            apart=(use.text,),
            presence=use.presence,
            level=Level.NOTE if is_secret or is_default or is_inside else None,
        )


CHECK = Check(
    id="machine-specific-path",
    summary="Absolute or home directory path in a launch file.",
    level=Level.WARNING,
    catalogue="L06",
    tags=("launch",),
    run=check,
)
