# SPDX-License-Identifier: Apache-2.0
"""Paths in launch files that only one machine has."""

from __future__ import annotations

import re
from collections.abc import Iterator

from haros_ci.api import Check, Finding, Level, Location, System, regex
from haros_ci.api.launch import ArgumentDeclaration, PathUse, included_by

#: Files that must not be installed with a package, where everybody reads them: keys, certificates and other credentials.
_SECRET = regex(
    r"\.(?:pem|key|crt|cer|der|csr|p12|pfx|jks|keystore|ppk|asc|gpg|htpasswd|token|secret|kdbx?|env)$"
    r"|(?:^|/)(?:id_(?:rsa|dsa|ecdsa|ed25519)|authorized_keys|known_hosts|\.netrc|\.pgpass)(?:\.pub)?$"
    r"|/\.(?:ssh|gnupg|aws|kube)/"
    r"|(?:^|[/_.-])(?:api_?keys?|tokens?|secrets?|passwords?|passwd|credentials?|private_?keys?)(?:[_.-][^/]*)?$",
    re.IGNORECASE,
)
_WHY = {"home": "lies in a user's home directory", "absolute": "is an absolute path"}


#: An instruction of a Dockerfile that makes a directory, with its lines; and absolute paths in it.
_MAKES = regex(r"^[ \t]*(WORKDIR|VOLUME|COPY|ADD|RUN)\b((?:[^\n]*\\[ \t]*\n)*[^\n]*)", re.I | re.M)
_MADE = regex(r"\b(?:mkdir|git\s+clone)\b([^&;|\n]*)")
_ABSOLUTE = regex(r"(?<![\w./$}:-])/[\w.-]+(?:/[\w.-]+)*")
_MAX_TEXT = 200_000
#: Arguments with paths of which others may be made, in one launch.
_MAX_ORIGINS = 100


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
            found.update(other_match[0] for text in texts for other_match in _ABSOLUTE.finditer(text.replace('"', " ")))
    return frozenset(found)


def _is_below(path: str, directories: frozenset[str]) -> bool:
    parts = path.split("/")
    return any("/".join(parts[:count]) in directories for count in range(2, len(parts)))


def _is_written(system: System, use: PathUse) -> bool:
    """Whether the path stands in the file as it is: else it is made of arguments."""
    return system.workspace is None or use.text in system.workspace.text(use.location.path)


def _has_value(system: System, use: PathUse) -> bool:
    """Whether the argument there is an ``<arg>`` of ROS 1 with a value, which nobody can give another one."""
    if use.ros != 1 or system.workspace is None or not use.location.line:
        return False
    lines = system.workspace.text(use.location.path).split("\n")[use.location.line - 1 :][:8]
    tag = "\n".join(lines)[(use.location.column or 1) - 1 :].partition(">")[0]
    return re.search(r"\svalue\s*=", tag) is not None and re.search(r"\sdefault\s*=", tag) is None


def _derived(system: System, uses: tuple[PathUse, ...], origins: list[PathUse]) -> dict[PathUse, PathUse]:
    """The uses whose path is made of what another argument holds, each with the one that holds it."""
    found: dict[PathUse, PathUse] = {}
    for use in uses:
        path = use.text.rstrip("/")
        holders = [origin for origin in origins if path.startswith(origin.text.rstrip("/") + "/")]
        if holders and not _is_written(system, use):
            found[use] = holders[0]
    return found


def _places(derived: dict[PathUse, PathUse], use: PathUse) -> list[Location]:
    """The first places of the paths that are made of *use*."""
    places = (
        path_use.location for path_use, holder in derived.items() if holder is use and path_use.location != use.location
    )
    return list(dict.fromkeys(places))[:3]


def check(system: System) -> Iterator[Finding]:
    reported: set[str] = set()
    uses = tuple(system.facts(PathUse))
    if not uses:
        return
    defaults = {(fact.location, fact.name) for fact in system.facts(ArgumentDeclaration) if fact.default}
    origins = [use for use in uses if (use.location, use.name) in defaults][:_MAX_ORIGINS]
    derived = _derived(system, uses, origins)
    containers = _of_containers(system)
    for use in uses:
        if use.text in reported or use in derived:
            continue
        reported.add(use.text)
        of = f" of {use.name!r}" if use.name else ""
        find = "$(find-pkg-share ...)" if use.ros == 2 else "$(find ...)"
        is_secret = _SECRET.search(use.text) is not None
        is_default = (use.location, use.name) in defaults and not _has_value(system, use)
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
            related=tuple((place, "made of it") for place in _places(derived, use)),
            presence=use.presence,
            level=Level.NOTE if is_secret or is_default or is_inside else None,
        )


CHECK = Check(
    id="machine-specific-path",
    summary="Absolute or home directory path in a launch file.",
    level=Level.WARNING,
    profiles=("strict",),
    catalogue="L06",
    tags=("launch",),
    run=check,
)
