# SPDX-License-Identifier: Apache-2.0
"""What a release is made of: metadata, archives of the same bytes, workflows without loose ends, versions that are the same everywhere."""

from __future__ import annotations

import gzip
import io
import re
import sys
import tarfile
from pathlib import Path
from typing import Any

import pytest
import yaml

ROOT = Path(__file__).resolve().parent.parent
sys.path.append(str(ROOT / "tools"))

from build_release import packed_anew  # noqa: E402 - a script, which lies beside the package

PROJECT = (ROOT / "pyproject.toml").read_text(encoding="utf-8")
OURS = sorted((ROOT / ".github" / "workflows").glob("*.yml"))
FOR_USERS = sorted((ROOT / "docs" / "workflows").glob("*.yml"))
#: ``owner/name@40 digits # version``.
PINNED = re.compile(r"[\w.-]+(?:/[\w.-]+)+@[0-9a-f]{40} # v[0-9]+(?:\.[0-9]+)+(?: - .*)?\Z")


def packed(moment: int, owner: str, names: tuple[str, ...]) -> bytes:
    """An sdist as another machine at another time would pack it."""
    data = io.BytesIO()
    with tarfile.open(fileobj=data, mode="w:gz") as archive:
        for name in names:
            member = tarfile.TarInfo(name)
            member.mtime, member.uname, member.size = moment, owner, 1
            member.mode = 0o775 if name.endswith(".sh") else 0o664
            archive.addfile(member, io.BytesIO(b"x"))
    return data.getvalue()


def test_the_same_files_are_the_same_bytes() -> None:
    one = packed_anew(packed(1_000_000_000, "a", ("p/b", "p/a", "p/run.sh")), 1_700_000_000)
    other = packed_anew(packed(1_111_111_111, "b", ("p/run.sh", "p/a", "p/b")), 1_700_000_000)
    assert one == other
    with tarfile.open(fileobj=io.BytesIO(one), mode="r:gz") as archive:
        members = archive.getmembers()
        assert [member.name for member in members] == ["p/a", "p/b", "p/run.sh"]
        assert [member.mode for member in members] == [0o644, 0o644, 0o755]
        assert {(member.mtime, member.uid, member.uname) for member in members} == {(1_700_000_000, 0, "")}


@pytest.mark.parametrize("names", [("p/a",), ("p/a", "p/b", "p/c")])
def test_other_files_are_other_bytes(names: tuple[str, ...]) -> None:
    assert packed_anew(packed(1, "a", ("p/a", "p/b")), 5) != packed_anew(packed(1, "a", names), 5)
    assert gzip.decompress(packed_anew(packed(1, "a", names), 5))[:3] == b"p/a"


def uses(path: Path) -> list[str]:
    return re.findall(r"^\s*(?:- )?uses: (.*)$", path.read_text(encoding="utf-8"), re.M)


@pytest.mark.parametrize("path", [*OURS, *FOR_USERS], ids=lambda path: path.name)
def test_actions_are_pinned(path: Path) -> None:
    loose = [use for use in uses(path) if not PINNED.match(use) and not use.startswith("haros-ci/haros-ci@v")]
    assert loose == []


@pytest.mark.parametrize(
    "use",
    [
        "actions/checkout@v4",
        "actions/checkout@main # v4.0.0",
        "actions/checkout@3d3c42e5aac5ba805825da76410c181273ba90b1",
        "actions/checkout@3d3c42e # v7.0.1",
        "actions/checkout@3d3c42e5aac5ba805825da76410c181273ba90b1 # newest",
    ],
)
def test_what_is_not_pinned(use: str) -> None:
    assert PINNED.match(use) is None


@pytest.mark.parametrize("path", [*OURS, *FOR_USERS], ids=lambda path: path.name)
def test_a_job_has_the_least_permissions(path: Path) -> None:
    workflow: dict[str, Any] = yaml.safe_load(path.read_text(encoding="utf-8"))
    assert workflow["permissions"] in ({}, {"contents": "read"})
    for job in workflow["jobs"].values():
        for step in job["steps"]:
            if step.get("uses", "").startswith("actions/checkout@"):
                assert step["with"]["persist-credentials"] is False, path.name


def test_a_tag_publishes_files_image_and_the_major_tag() -> None:
    release = yaml.safe_load((ROOT / ".github/workflows/release.yml").read_text(encoding="utf-8"))
    jobs = release["jobs"]
    assert jobs["index"]["permissions"] == {"id-token": "write"}, "trusted publishing stores no token"
    for name in ("index", "image", "release"):
        assert jobs[name]["environment"] == "release", "a person approves"
    attested = {
        name
        for name, job in jobs.items()
        for step in job["steps"]
        if step.get("uses", "").startswith("actions/attest-build-provenance@")
    }
    assert attested == {"build", "image"}
    scripts = {name: "\n".join(step.get("run", "") for step in job["steps"]) for name, job in jobs.items()}
    assert "docker push" in scripts["image"] and "refs/tags/$major" in scripts["release"]
    assert not any("${{" in script for script in scripts.values()), "no expression reaches a shell"


def test_what_is_tested_is_what_is_declared() -> None:
    workflow = yaml.safe_load((ROOT / ".github/workflows/ci.yml").read_text(encoding="utf-8"))
    tested = workflow["jobs"]["test"]["strategy"]["matrix"]
    assert tested["python"] == re.findall(r'"Programming Language :: Python :: (3\.\d+)"', PROJECT)
    assert any(extra["runner"].endswith("-arm") for extra in tested["include"])


def test_contributors_have_the_same_versions() -> None:
    hooks = yaml.safe_load((ROOT / ".pre-commit-config.yaml").read_text(encoding="utf-8"))["repos"][0]["hooks"]
    for pin in (pin for hook in hooks for pin in hook["additional_dependencies"]):
        assert f'"{pin}"' in PROJECT


@pytest.mark.parametrize(
    "key", ["authors", "classifiers", "description", "keywords", "license", "license-files", "readme"]
)
def test_metadata_is_complete(key: str) -> None:
    assert re.search(rf"^{key} = ", PROJECT, re.M)


def test_urls() -> None:
    section = PROJECT.split("[project.urls]\n")[1].split("\n\n")[0]
    assert {line.split(" = ")[0] for line in section.splitlines()} >= {
        "Homepage",
        "Documentation",
        "Source",
        "Issues",
        "Changelog",
    }


def test_the_papers_on_haros_are_named() -> None:
    cited = yaml.safe_load((ROOT / "CITATION.cff").read_text(encoding="utf-8"))
    assert cited["cff-version"] == "1.2.0" and cited["license"] == "Apache-2.0"
    assert {paper["doi"] for paper in cited["references"]} >= {
        "10.1109/IROS.2016.7759661",
        "10.1109/RoSE52553.2021.00013",
    }
