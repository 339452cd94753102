# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import shutil
import subprocess
from collections.abc import Callable
from pathlib import Path

import pytest
from git_histories import Git, manifest, plant

from haros_ci.model.workspace import Workspace
from haros_ci.workspace.base import BaselineUnavailable, base_workspace
from haros_ci.workspace.discover import discover

TEXT = "".join(f"int a{n} = {n};\n" for n in range(40)).encode()
OTHER = "".join(f"double other_{n}();\n" for n in range(40)).encode()


def paths(workspace: Workspace) -> list[str]:
    return [file.path for file in workspace.files]


def test_an_unchanged_tree_is_the_same_in_the_base(git: Git) -> None:
    commit = git.commit(
        {
            "arm/package.xml": manifest("arm"),
            "arm/src/arm.cpp": b"\xef\xbb\xbfint arm;\r\n",
            "arm/scripts/teleop": b"#!/usr/bin/env python3\n",
            "arm/scripts/run.v2": b"#!/usr/bin/env python3\n",
            "arm/src/old.cpp": b"// \xe9\n",
            "leg/package.xml": b"<package>",
            "leg/big.yaml": b"a" * 300,
            "vendor/v.cpp": b"",
            "build/COLCON_IGNORE": b"",
            "build/b.py": b"",
            "README.rst": b"",
        }
    )
    (git.top / "arm" / "scripts" / "run.v2").chmod(0o755)
    (git.top / "alias.cpp").symlink_to("arm/src/arm.cpp")
    commit = git.commit()
    options = {"exclude": ("vendor/",), "max_file_size": 200}
    present = discover(git.top, (".",), **options)  # type: ignore[arg-type]
    with base_workspace(present, "HEAD", **options) as base:  # type: ignore[arg-type]
        assert base.revision == commit
        assert base.renames == {}
        assert base.workspace.files == present.files
        assert base.workspace.packages == present.packages
        assert base.workspace.problems == present.problems
        assert base.workspace.faults == present.faults
        assert base.workspace.text("arm/src/arm.cpp") == "int arm;\r\n"
        assert (base.workspace.root / "arm/src/arm.cpp").read_bytes() == b"\xef\xbb\xbfint arm;\r\n"
        assert not (base.workspace.root / "alias.cpp").exists()
        place = base.workspace.root
        assert not place.is_relative_to(git.top)
    assert not place.exists()


def test_the_base_is_the_merge_base_or_the_revision_itself(git: Git) -> None:
    parting = git.commit({"a.cpp": b"int a;\n"})
    git("checkout", "-q", "-b", "topic")
    git.commit({"b.cpp": b""})
    git("checkout", "-q", "main")
    main = git.commit({"c.cpp": b""})
    git("checkout", "-q", "topic")
    plant(git.top, {"a.cpp": b"int changed;\n", "d.cpp": b""})
    present = discover(git.top, (".",))
    with base_workspace(present, "main") as base:
        assert (base.revision, paths(base.workspace)) == (parting, ["a.cpp"])
        assert base.workspace.text("a.cpp") == "int a;\n"
    with base_workspace(present, "main", use_merge_base=False) as base:
        assert (base.revision, paths(base.workspace)) == (main, ["a.cpp", "c.cpp"])


def test_it_is_removed_when_its_user_fails(git: Git) -> None:
    git.commit({"a.cpp": b""})
    with pytest.raises(ZeroDivisionError), base_workspace(discover(git.top, (".",)), "HEAD") as base:
        place = base.workspace.root
        raise ZeroDivisionError
    assert not place.exists()


# -- renames ------------------------------------------------------------------------------------------------------


def renames(git: Git, change: Callable[[Path], object], **base: bytes) -> dict[str, str]:
    git.commit({"pkg/a.cpp": TEXT, "pkg/b.cpp": OTHER, **base})
    change(git.top)
    with base_workspace(discover(git.top, (".",)), "HEAD") as found:
        return found.renames


def move(old: str, new: str, data: bytes | None = None) -> Callable[[Path], object]:
    def change(root: Path) -> None:
        (root / new).parent.mkdir(parents=True, exist_ok=True)
        (root / old).rename(root / new)
        if data is not None:
            (root / new).write_bytes(data)

    return change


EDITED = TEXT.replace(b"int a1", b"long a1")


@pytest.mark.parametrize(
    ("change", "expected"),
    [
        (move("pkg/a.cpp", "pkg/z.cpp"), {"pkg/a.cpp": "pkg/z.cpp"}),
        (move("pkg/a.cpp", "other/deep/a.cpp"), {"pkg/a.cpp": "other/deep/a.cpp"}),
        (move("pkg/a.cpp", "pkg/z.cpp", EDITED), {"pkg/a.cpp": "pkg/z.cpp"}),
        (move("pkg", "package"), {"pkg/a.cpp": "package/a.cpp", "pkg/b.cpp": "package/b.cpp"}),
        (move("pkg/a.cpp", "pkg/ä ü.cpp"), {"pkg/a.cpp": "pkg/ä ü.cpp"}),
        (move("pkg/a.cpp", "pkg/-M.cpp"), {"pkg/a.cpp": "pkg/-M.cpp"}),
        (move("pkg/a.cpp", '"a.cpp'), {"pkg/a.cpp": '"a.cpp'}),
        (move("pkg/a.cpp", "-w.cpp"), {"pkg/a.cpp": "-w.cpp"}),
        (move("pkg/a.cpp", "pkg/a\\n.cpp"), {"pkg/a.cpp": "pkg/a\\n.cpp"}),
        (move("pkg/a.cpp", 'pkg/\x1b".cpp'), {"pkg/a.cpp": 'pkg/\x1b".cpp'}),
    ],
)
@pytest.mark.parametrize("committed", [False, True])
def test_renames(git: Git, change: Callable[[Path], object], expected: dict[str, str], committed: bool) -> None:
    assert renames(git, change) == expected
    if committed:
        git.commit()
        with base_workspace(discover(git.top, (".",)), "HEAD~1") as base:
            assert base.renames == expected


@pytest.mark.parametrize(
    "change",
    [
        lambda root: (root / "pkg/a.cpp").unlink(),
        lambda root: (root / "pkg/new.cpp").write_bytes(TEXT),  # a copy: the original is still there
        lambda root: (root / "pkg/a.cpp").write_bytes(OTHER),
        move("pkg/a.cpp", "pkg/z.cpp", b"struct Z {};\n"),
        move("pkg/a.cpp", "pkg/a.txt"),
        lambda root: None,
    ],
)
def test_no_renames(git: Git, change: Callable[[Path], object]) -> None:
    assert renames(git, change) == {}


def test_renames_in_a_repository_with_longer_names(tmp_path: Path) -> None:
    git = Git(tmp_path / "first")
    shutil.rmtree(git.top / ".git")
    git("init", "-q", "-b", "main", "--object-format=sha256")
    assert renames(git, move("pkg/a.cpp", "pkg/z.cpp", EDITED)) == {"pkg/a.cpp": "pkg/z.cpp"}


def test_renames_with_line_endings_that_git_converts(git: Git) -> None:
    git("config", "core.autocrlf", "true")
    data = TEXT.replace(b"\n", b"\r\n")
    assert renames(git, move("pkg/a.cpp", "pkg/z.cpp", data)) == {"pkg/a.cpp": "pkg/z.cpp"}


# -- parts, subdirectories, several repositories ------------------------------------------------------------------


def test_targets_are_known_by_what_they_were_called(git: Git) -> None:
    git.commit({"a.cpp": TEXT, "b.cpp": OTHER})
    (git.top / "a.cpp").rename(git.top / "z.cpp")
    plant(git.top, {"new.cpp": b""})
    given = ("z.cpp", "new.cpp")
    with base_workspace(discover(git.top, given), "HEAD", paths=given) as base:
        assert paths(base.workspace) == ["a.cpp", "b.cpp"]
        assert base.workspace.targets == {"a.cpp"}


def test_a_directory_is_the_subtree(git: Git) -> None:
    git.commit({"arm/package.xml": manifest("arm"), "arm/src/a.cpp": b"", "arm/src/b.cpp": b"", "leg/l.cpp": b""})
    given = ("arm/src",)
    with base_workspace(discover(git.top, given), "HEAD", paths=given) as base:
        assert paths(base.workspace) == ["arm/src/a.cpp", "arm/src/b.cpp"]
        assert {file.package for file in base.workspace.files} == {"arm"}


def test_a_root_below_the_repository(git: Git) -> None:
    git.commit({"ws/src/a.cpp": TEXT, "b.cpp": b"", "ws2/c.cpp": b""})
    (git.top / "ws/src/a.cpp").rename(git.top / "ws/a.cpp")
    with base_workspace(discover(git.top / "ws", (".",)), "HEAD") as base:
        assert paths(base.workspace) == ["src/a.cpp"]
        assert base.renames == {"src/a.cpp": "a.cpp"}


def test_a_root_above_its_only_repository(tmp_path: Path, new_git: Callable[[str], Git]) -> None:
    arm = new_git("ws/src/arm")
    arm.commit({"a.cpp": TEXT})
    (arm.top / "a.cpp").rename(arm.top / "z.cpp")
    with base_workspace(discover(tmp_path / "ws", (".",)), "HEAD") as base:
        assert paths(base.workspace) == ["src/arm/a.cpp"]
        assert base.renames == {"src/arm/a.cpp": "src/arm/z.cpp"}


def test_several_repositories(tmp_path: Path, new_git: Callable[[str], Git]) -> None:
    new_git("ws/src/arm").commit({"a.cpp": b""})
    new_git("ws/src/leg").commit({"l.cpp": b""})
    present = discover(tmp_path / "ws", (".",))
    with (
        pytest.raises(BaselineUnavailable, match="the files lie in 2; use a baseline"),
        base_workspace(present, "HEAD"),
    ):
        pass
    given = ("src/leg",)
    with base_workspace(discover(tmp_path / "ws", given), "HEAD", paths=given) as base:
        assert paths(base.workspace) == ["src/leg/l.cpp"]


def test_no_repository(tmp_path: Path) -> None:
    plant(tmp_path, {"a.cpp": b""})
    present = discover(tmp_path, (".",))
    with pytest.raises(BaselineUnavailable, match="not in a git repository"), base_workspace(present, "HEAD"):
        pass


def with_submodule(git: Git, new_git: Callable[[str], Git]) -> Git:
    other = new_git("other")
    other.commit({"o.cpp": b"int one;\n", "p.cpp": TEXT})
    git.commit({"a.cpp": b""})
    git("submodule", "add", "-q", other.top.as_uri(), "lib")
    git.commit()
    return Git(git.top / "lib")


def test_submodules_are_followed(git: Git, new_git: Callable[[str], Git]) -> None:
    lib = with_submodule(git, new_git)
    (lib.top / "p.cpp").rename(git.top / "moved.cpp")
    lib.commit({"o.cpp": b"int two;\n"})
    git.commit()
    with base_workspace(discover(git.top, (".",)), "HEAD~1") as base:
        assert paths(base.workspace) == ["a.cpp", "lib/o.cpp", "lib/p.cpp"]
        assert base.workspace.text("lib/o.cpp") == "int one;\n"
        assert base.renames == {"lib/p.cpp": "moved.cpp"}
    given = ("lib",)
    with base_workspace(discover(git.top, given), "HEAD~1", paths=given) as base:  # the submodule's own HEAD
        assert base.workspace.text("lib/o.cpp") == "int one;\n"


def test_a_submodule_without_the_commit(git: Git, new_git: Callable[[str], Git], tmp_path: Path) -> None:
    with_submodule(git, new_git)
    Git(tmp_path / "other").commit({"o.cpp": b"int two;\n"})
    git("submodule", "update", "-q", "--remote", "lib")
    git.commit()
    shutil.rmtree(git.top / "lib")
    shutil.rmtree(git.top / ".git" / "modules")
    git("submodule", "update", "-q", "--init", "--depth=1")
    present = discover(git.top, (".",))
    with pytest.raises(BaselineUnavailable, match="submodule lib"), base_workspace(present, "HEAD~1"):
        pass
    given = ("a.cpp",)
    with pytest.raises(BaselineUnavailable), base_workspace(discover(git.top, given), "HEAD~1", paths=given):
        pass


# -- settings and traps -------------------------------------------------------------------------------------------


SETTINGS = {
    "arm/a.cpp": b"",
    "CPPLINT.cfg": b"linelength=80\n",
    "arm/.clang-tidy": b"Checks: old\n",
    "arm/setup.cfg": b"[flake8]\n",
    "any/shared.toml": b"# shared\n",
    ".hadolint.yaml": b"ignored: []\n",
    "pylintrc": b"\xef\xbb\xbf[MAIN]\r\n",
}


def changed_settings(git: Git) -> Workspace:
    """Today's workspace, whose settings are all another."""
    git.commit(SETTINGS)
    plant(git.top, {"CPPLINT.cfg": b"linelength=120\n", "arm/CPPLINT.cfg": b"filter=-legal\n", "leg/ruff.toml": b"x"})
    plant(git.top, {".hadolint.yaml": b"ignored: [DL3006]\n", "any/shared.toml": b"# mine\n"})
    (git.top / "arm" / ".clang-tidy").unlink()
    return discover(git.top, (".",))


def test_tools_have_the_settings_of_the_base(git: Git) -> None:
    with base_workspace(changed_settings(git), "HEAD") as base:
        assert base.settings is not None
        for path, data in SETTINGS.items():
            assert base.settings.data(path) == data
            assert base.workspace.setting(path) == base.settings.text(path) == data.decode("utf-8-sig")
        for path in ("arm/CPPLINT.cfg", "leg/ruff.toml", "../x", "arm", "gone"):
            assert base.workspace.setting(path) == "" and base.settings.data(path) is None
        assert base.settings.head("CPPLINT.cfg", 4) == b"line"
        assert base.workspace.text(".hadolint.yaml") == "ignored: []\n"  # which is analysed, too
        assert base.workspace.problems == ()
        assert not (base.workspace.root / "arm/CPPLINT.cfg").exists()


def test_tools_keep_todays_settings_where_they_are_trusted(git: Git) -> None:
    with base_workspace(changed_settings(git), "HEAD", trusted=True) as base:
        assert base.settings is None
        assert base.workspace.setting("CPPLINT.cfg") == "linelength=120\n"
        assert (base.workspace.root / "arm/CPPLINT.cfg").read_text() == "filter=-legal\n"
        assert base.workspace.setting("arm/.clang-tidy") == ""
        assert not (base.workspace.root / "arm/.clang-tidy").exists()
        assert not (base.workspace.root / "leg").exists()


def test_links_and_large_files_are_no_settings(git: Git) -> None:
    (git.top / "ruff.toml").symlink_to("real.toml")
    git.commit({"a.py": b"", "real.toml": b"# real\n", "setup.cfg": b"#" * 900, "tox.ini": b"\0[flake8]\n"})
    with base_workspace(discover(git.top, (".",)), "HEAD", max_file_size=800) as base:
        assert [path for path in ("ruff.toml", "setup.cfg", "tox.ini") if base.workspace.setting(path)] == []
        assert base.workspace.setting("real.toml") == "# real\n"


def test_settings_outside_the_repository_are_no_part_of_a_change(git: Git) -> None:
    git.commit({"a.py": b"", "ruff.toml": b"# old\n"})
    plant(git.top, {"ruff.toml": b"# new\n", "sub/ruff.toml": b"# new\n"})
    plant(git.top.parent, {"ruff.toml": b"# around\n"})
    with base_workspace(discover(git.top.parent, (".",)), "HEAD") as base:
        assert base.workspace.setting("ruff.toml") == "# around\n"
        assert base.workspace.setting(f"{git.top.name}/ruff.toml") == "# old\n"
        assert base.workspace.setting(f"{git.top.name}/sub/ruff.toml") == ""


def test_without_a_commit_of_settings_there_are_none(git: Git) -> None:
    git.commit({"a.py": b""})
    plant(git.top, {"ruff.toml": b"# new\n"})
    present = discover(git.top, (".",))
    assert present.setting("ruff.toml") == "# new\n"
    with base_workspace(present, "HEAD") as base:
        assert base.workspace.setting("ruff.toml") == ""


def craft(git: Git, entries: bytes) -> str:
    """A commit of a tree that no checkout would write."""
    made = subprocess.run(
        ["git", "hash-object", "-t", "tree", "-w", "--literally", "--stdin"],
        cwd=git.top,
        input=entries,
        capture_output=True,
        check=True,
    )
    return git("commit-tree", "-m", "crafted", made.stdout.decode().strip())


@pytest.mark.parametrize("name", [b"..", b".", b"../evil.cpp", b"/tmp/evil.cpp", b".git", b".GIT", b"a/../../evil.cpp"])
def test_names_that_lead_out_of_the_base(git: Git, tmp_path: Path, name: bytes) -> None:
    git.commit({"a.cpp": b"int evil;\n"})
    blob = bytes.fromhex(git("rev-parse", "HEAD:a.cpp"))
    tree = bytes.fromhex(git("rev-parse", "HEAD^{tree}"))
    entry = b"100644 " + name + b"\0" + blob if b"cpp" in name else b"40000 " + name + b"\0" + tree
    commit = craft(git, entry + b"100644 good.cpp\0" + blob)
    with base_workspace(discover(git.top, (".",)), commit, use_merge_base=False) as base:
        assert paths(base.workspace) == ["good.cpp"]
        written = list(base.workspace.root.parent.rglob("*.cpp"))
        assert written == [base.workspace.root / "good.cpp"]


def test_a_file_and_a_directory_of_one_name(git: Git) -> None:
    git.commit({"a.cpp": b"int evil;\n"})
    blob = bytes.fromhex(git("rev-parse", "HEAD:a.cpp"))
    tree = bytes.fromhex(git("rev-parse", "HEAD^{tree}"))
    commit = craft(git, b"100644 x.cpp\0" + blob + b"40000 x.cpp\0" + tree + b"120000 l.cpp\0" + blob)
    with base_workspace(discover(git.top, (".",)), commit, use_merge_base=False) as base:
        assert paths(base.workspace) == ["x.cpp"]
        assert [problem.path for problem in base.workspace.problems] == ["x.cpp/a.cpp"]


def test_names_and_contents_that_are_skipped_on_disk_are_skipped_here(git: Git) -> None:
    git.commit({"a\nb.cpp": b"", "bin.cpp": b"\0", "big.cpp": b"x\n" * 500, "ok.cpp": b"", "LICENSE": b"x\n" * 500})
    present = discover(git.top, (".",), max_file_size=500)
    with base_workspace(present, "HEAD", max_file_size=500) as base:
        assert paths(base.workspace) == ["ok.cpp"]
        assert base.workspace.problems == present.problems
        assert len(present.problems) == 3


def test_nothing_is_left_of_a_tree_with_no_files(git: Git) -> None:
    git.commit({"README.rst": b""})
    git.commit({"a.cpp": b""})
    with base_workspace(discover(git.top, (".",)), "HEAD~1") as base:
        assert base.workspace.files == () and base.workspace.packages == ()


def test_a_base_larger_than_one_batch(git: Git, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("haros_ci.workspace.objects.BATCH", 1000)
    files = {f"d{n}/f{n}.cpp": bytes([65 + n]) * (n * 100) + b"\n" for n in range(20)}
    git.commit(files)
    present = discover(git.top, (".",))
    with base_workspace(present, "HEAD") as base:
        assert base.workspace.files == present.files and len(present.files) == 20
