# SPDX-License-Identifier: Apache-2.0
"""Results in files: whole or not at all, and nothing is replaced that is no plain file."""

from __future__ import annotations

import ast
import errno
import os
import re
import stat
import subprocess
import sys
import threading
from pathlib import Path

import pytest
from every import every

from haros_ci.errors import RunFailure, UserError
from haros_ci.interruption import Interrupted
from haros_ci.writing import append, create, put_below, write


def test_a_file_is_replaced_as_a_whole(tmp_path: Path) -> None:
    target = tmp_path / "a" / "log.sarif"
    write("first\n", target)
    before = target.stat().st_ino
    write("é\n", target)
    assert target.read_bytes() == "é\n".encode()
    assert target.stat().st_ino != before
    assert [path.name for path in target.parent.iterdir()] == ["log.sarif"]


def test_a_link_stays_a_link(tmp_path: Path) -> None:
    (tmp_path / "real").write_text("old")
    (tmp_path / "link").symlink_to("real")
    write("new", tmp_path / "link")
    assert (tmp_path / "link").is_symlink()
    assert (tmp_path / "real").read_text() == "new"


def test_a_pipe_stays_a_pipe(tmp_path: Path) -> None:
    pipe = tmp_path / "pipe"
    os.mkfifo(pipe)
    read: list[str] = []
    reader = threading.Thread(target=lambda: read.append(pipe.read_text()), daemon=True)
    reader.start()
    write("through", pipe)
    reader.join(10)
    assert read == ["through"]
    assert stat.S_ISFIFO(pipe.stat().st_mode)


def test_devices_are_written_to() -> None:
    write("gone", Path(os.devnull))
    assert not Path(os.devnull).is_file()


@pytest.mark.parametrize("name", ["", "file/below"])
def test_what_cannot_be_written_is_said(tmp_path: Path, name: str) -> None:
    (tmp_path / "file").write_text("")
    with pytest.raises(UserError, match="cannot be written"):
        write("x", tmp_path / name)


# -- what is left behind ------------------------------------------------------------------------------------------


class Full(OSError):
    """What a file system says that has no room."""

    def __init__(self) -> None:
        super().__init__(errno.ENOSPC, os.strerror(errno.ENOSPC))


@pytest.fixture
def is_full(monkeypatch: pytest.MonkeyPatch) -> None:
    """The first bytes of a file fit, the rest does not."""
    left = [4]

    def little(descriptor: int, data: memoryview) -> int:
        if not left[0]:
            raise Full
        taken, left[0] = left[0], 0
        return really(descriptor, data[:taken])

    really = os.write
    monkeypatch.setattr(os, "write", little)


def test_a_full_disk_leaves_the_old_file_and_no_draft(tmp_path: Path, is_full: None) -> None:
    (tmp_path / "log").write_text("old")
    with pytest.raises(RunFailure, match="No space left"):
        write("something new", tmp_path / "log")
    assert {path.name: path.read_text() for path in tmp_path.iterdir()} == {"log": "old"}


def test_a_full_disk_leaves_no_half_of_a_directory(tmp_path: Path, is_full: None) -> None:
    with pytest.raises(RunFailure, match="No space left"):
        put_below(tmp_path / "out", {"a/b": "something new"})
    assert [path.name for path in tmp_path.rglob("*") if path.is_file()] == []


def test_a_full_disk_leaves_what_was_appended_to(tmp_path: Path, is_full: None) -> None:
    (tmp_path / "page").write_text("old\n")
    with pytest.raises(RunFailure, match="No space left"):
        append(tmp_path / "page", "something new")
    assert (tmp_path / "page").read_text() == "old\n"


def test_a_full_disk_leaves_no_half_of_a_new_file(tmp_path: Path, is_full: None) -> None:
    with pytest.raises(OSError, match="No space left"):
        create(tmp_path, "a/b", "something new")
    assert [path.name for path in tmp_path.rglob("*") if path.is_file()] == []


@pytest.mark.parametrize("err", [KeyboardInterrupt, Interrupted(15), MemoryError])
def test_no_draft_is_left_by_what_ends_a_run(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, err: BaseException | type[BaseException]
) -> None:
    def ended(*_: object) -> None:
        raise err

    monkeypatch.setattr(os, "replace", ended)
    with pytest.raises(BaseException) as raised:
        write("new", tmp_path / "log")
    assert raised.type is (err if isinstance(err, type) else type(err))
    assert list(tmp_path.iterdir()) == []


def test_a_device_that_is_full_is_no_mistake_of_the_user() -> None:
    with pytest.raises(RunFailure, match="/dev/full: cannot be written: No space left"):
        write("x", Path("/dev/full"))


# -- what stays as it was -----------------------------------------------------------------------------------------


def test_permissions_are_kept(tmp_path: Path) -> None:
    (tmp_path / "log").write_text("old")
    (tmp_path / "log").chmod(0o600)
    write("new", tmp_path / "log")
    assert (tmp_path / "log").stat().st_mode & 0o777 == 0o600


def test_other_names_of_a_file_keep_what_it_was(tmp_path: Path) -> None:
    (tmp_path / "log").write_text("old")
    os.link(tmp_path / "log", tmp_path / "other")
    write("new", tmp_path / "log")
    assert (tmp_path / "other").read_text() == "old"


def test_the_longest_name(tmp_path: Path) -> None:
    write("x", tmp_path / ("n" * 255))
    assert [path.name for path in tmp_path.iterdir()] == ["n" * 255]


def test_a_new_file_is_made_once(tmp_path: Path) -> None:
    create(tmp_path, "a/b", "first")
    with pytest.raises(FileExistsError):
        create(tmp_path, "a/b", "second")
    assert (tmp_path / "a" / "b").read_text() == "first"


@pytest.mark.parametrize("name", ["/dev/stdout", "/dev/fd/1", "/proc/self/fd/1"])
def test_stdout_by_name_goes_on_where_it_is(tmp_path: Path, name: str) -> None:
    """``> file`` keeps what was written before, and is not replaced by another file."""
    code = f"import sys\nfrom pathlib import Path\nfrom haros_ci.writing import write\nprint('before')\nwrite('through', Path('{name}'))"
    with (tmp_path / "out").open("w") as out:
        subprocess.run([sys.executable, "-c", code], stdout=out, check=True, timeout=60)
    assert (tmp_path / "out").read_text() == "before\nthrough"
    assert [path.name for path in tmp_path.iterdir()] == ["out"]


# -- no other writer ----------------------------------------------------------------------------------------------

PACKAGE = Path(__file__).resolve().parent.parent / "haros_ci"
SCRATCH = "its own temporary directory"
#: Modules that open files for writing besides the writer, and why they may.
ALLOWED = {
    "writing.py": "the writer",
    "scratch.py": "makes temporary directories and removes them",
    "analysis/exactness.py": SCRATCH,
    "streams.py": "opens /dev/null in place of streams that are closed",
    "forks.py": "pipes to its children",
    "workspace/cache.py": "its own directory: drafts by mkstemp, which replace links",
    "workspace/base.py": SCRATCH,
    "workspace/revision.py": SCRATCH,
    "workspace/renames.py": SCRATCH,
    "linters/": "scratch directories of tools",
    "recordings/sqlite.py": "unpacks a database into a scratch directory, and opens it for reading alone (mode=ro, immutable)",
    "haros_plugins/run.py": SCRATCH,
    "report/model_sqlite.py": SCRATCH,
    "api/testing.py": SCRATCH,
    "interfaces/collect.py": "a tool of the project's developers, no command",
    "monitor_files/parts/": "copied into files that a user runs, beside a system and not here",
    "test_files/property_tests/": "copied beside tests that a user runs; --run starts them in a directory of the user's",
    "knowledge/facts.py": "a tool of the project's developers, no command",
}
NAMES = {"write_text", "write_bytes", "mkdir", "makedirs", "touch", "symlink_to", "hardlink_to"}
#: What has methods of these names and is no path: variables of launch files, and click's help.
NO_FILES = {"heap", "self", "formatter"}
OF_OS = {"open", "mkdir", "makedirs", "replace", "rename", "renames", "link", "symlink", "truncate", "mkfifo", "mknod"}
OF_SHUTIL = {"copy", "copy2", "copyfile", "copyfileobj", "copytree", "move", "unpack_archive", "make_archive"}


def writes(tree: ast.AST) -> set[int]:
    """The lines on which a file may be opened for writing, made or moved."""
    found = set()
    for call in (node for node in ast.walk(tree) if isinstance(node, ast.Call)):
        function = call.func
        receiver = function.value if isinstance(function, ast.Attribute) else None
        owner = getattr(receiver, "attr", getattr(receiver, "id", ""))
        if owner in NO_FILES:
            continue
        name = function.attr if isinstance(function, ast.Attribute) else getattr(function, "id", "")
        flags = {node.attr for argument in call.args for node in ast.walk(argument) if isinstance(node, ast.Attribute)}
        mode = [
            *call.args[: 2 if isinstance(function, ast.Name) or owner == "io" else 1],
            *(k.value for k in call.keywords if k.arg == "mode"),
        ]
        modes = [m.value for m in mode if isinstance(m, ast.Constant) and isinstance(m.value, str)]
        if owner == "os" and name == "open":
            if flags & {"O_WRONLY", "O_RDWR", "O_CREAT", "O_TRUNC", "O_APPEND"}:
                found.add(call.lineno)
        elif name == "open" and any(re.fullmatch("[rwxabt+]{1,4}", m) and set(m) & set("wxa+") for m in modes):
            found.add(call.lineno)
        elif name in NAMES or (owner == "os" and name in OF_OS) or (owner == "shutil" and name in OF_SHUTIL):
            found.add(call.lineno)
        elif owner == "tempfile" or name in (
            "TemporaryFile",
            "NamedTemporaryFile",
            "TemporaryDirectory",
            "mkstemp",
            "mkdtemp",
        ):
            found.add(call.lineno)
        elif owner == "sqlite3" and name == "connect" and not modes[:1] == [":memory:"]:
            found.add(call.lineno)
        elif (
            name in ("replace", "rename")
            and isinstance(function, ast.Attribute)
            and len(call.args) == 1
            and not flags & {"args"}
            and not call.keywords
        ):
            found.add(call.lineno)  # of pathlib: str.replace takes two
    return found


@every("path", sorted(PACKAGE.rglob("*.py")), ids=lambda path: path.relative_to(PACKAGE).as_posix())
def test_nobody_else_writes_files(path: Path) -> None:
    name = path.relative_to(PACKAGE).as_posix()
    if not any(name == allowed or (allowed.endswith("/") and name.startswith(allowed)) for allowed in ALLOWED):
        assert not writes(ast.parse(path.read_text(encoding="utf-8"))), "write through haros_ci/writing.py"


@pytest.mark.parametrize("name", sorted(ALLOWED))
def test_the_list_has_nothing_that_does_not_write(name: str) -> None:
    paths = [PACKAGE / name] if name.endswith(".py") else sorted((PACKAGE / name).glob("*.py"))
    assert any(writes(ast.parse(path.read_text(encoding="utf-8"))) for path in paths)


@pytest.mark.parametrize(
    "code",
    [
        "open(p, 'w')",
        "open(p, mode='ab')",
        "p.open('x')",
        "p.open('r+')",
        "p.write_text(t)",
        "os.open(p, os.O_WRONLY | os.O_CREAT)",
        "os.replace(a, b)",
        "draft.replace(path)",
        "shutil.copyfile(a, b)",
        "tempfile.mkstemp()",
        "sqlite3.connect(p)",
    ],
)
def test_the_search_finds(code: str) -> None:
    assert writes(ast.parse(code))


@pytest.mark.parametrize(
    "code",
    [
        "open(p)",
        "open(p, 'rb')",
        "p.open(encoding='utf-8')",
        "heap.open()",
        "text.replace('a', 'b')",
        "replace(run, results=())",
        "os.open(p, os.O_RDONLY)",
        "sqlite3.connect(':memory:')",
    ],
)
def test_the_search_passes_over(code: str) -> None:
    assert not writes(ast.parse(code))
