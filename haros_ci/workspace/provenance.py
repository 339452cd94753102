# SPDX-License-Identifier: Apache-2.0
"""Where a workspace comes from: the address, commit and branch of the repository that it lies in."""

from __future__ import annotations

from pathlib import Path

from haros_ci.results.result import Provenance
from haros_ci.workspace.git import BaselineUnavailable, Repository, control_text, repository_of, resolve_commit


def provenance(root: Path) -> Provenance | None:
    """Remote address without credentials, commit and branch of the repository *root* lies in; None outside git.

    Reads git's control files; git itself is asked only where the commit is not in them (reftable).
    """
    top = repository_of(root)
    if top is None:
        return None
    repository = Repository(top)
    common = repository.common_directory
    head = control_text(repository.git_directory / "HEAD").strip()
    reference = head.removeprefix("ref:").strip() if head.startswith("ref:") else ""
    revision = head if not reference else _reference(common, reference)
    if not _is_object_name(revision):
        try:
            revision = resolve_commit(repository, "HEAD")
        except BaselineUnavailable:  # no commit yet, or not a repository
            revision = ""
    branch = reference.removeprefix("refs/heads/") if _is_reference(reference, "refs/heads/") else ""
    return Provenance(
        repository_uri=_remote(control_text(common / "config")),
        revision=revision,
        branch="" if branch == ".invalid" else branch,  # what git writes into HEAD beside a reftable
    )


def public_uri(url: str) -> str:
    """*url* of a remote as a URI without user, password, query and fragment; "" if it is no network address."""
    scheme, separator, rest = url.strip().partition("://")
    if not separator:  # scp-like: [user@]host:path
        host, colon, path = url.strip().rpartition("@")[2].partition(":")
        if not colon or "/" in host or len(host) < 2:
            return ""
        scheme, rest = "ssh", f"{host}/{path.lstrip('/')}"
    if scheme not in ("http", "https", "ssh", "git"):
        return ""
    host, _, path = rest.partition("/")
    path = path.partition("?")[0].partition("#")[0]
    clean = f"{scheme}://{host.rpartition('@')[2]}/{path}"
    return clean if clean.isascii() and clean.isprintable() and " " not in clean and "@" not in clean else ""


def _remote(config: str) -> str:
    """The address of ``origin``, else of the first remote by name; included files and rewriting rules are not followed."""
    remotes: dict[str, str] = {}
    section = ""
    for line in config.splitlines():
        line = line.strip()
        if line.startswith("["):
            section = line
        elif section.startswith('[remote "') and section.endswith('"]'):
            key, _, value = line.partition("=")
            if key.strip().lower() == "url":
                remotes.setdefault(section[len('[remote "') : -2], value.strip().strip('"'))
    if not remotes:
        return ""
    return public_uri(remotes.get("origin", remotes[min(remotes)]))


def _reference(common: Path, name: str) -> str:
    """The object that a loose or packed reference names, "" if there is no such file."""
    if not _is_reference(name, "refs/"):
        return ""
    loose = control_text(common / name).strip()
    if loose:
        return loose
    for line in control_text(common / "packed-refs").splitlines():
        value, _, packed = line.partition(" ")
        if packed == name:
            return value
    return ""


def _is_reference(name: str, prefix: str) -> bool:
    return name.startswith(prefix) and ".." not in name and name.isprintable()


def _is_object_name(text: str) -> bool:
    return len(text) in (40, 64) and all(c in "0123456789abcdef" for c in text)
