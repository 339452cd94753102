# SPDX-License-Identifier: Apache-2.0
"""Results in files: whole or not at all, and nothing is replaced that is no plain file."""

from __future__ import annotations

import os
import stat
import threading
from pathlib import Path

import pytest

from haros_ci.errors import UserError
from haros_ci.output import write


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
