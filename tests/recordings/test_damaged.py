# SPDX-License-Identifier: Apache-2.0
"""Recordings that end early, are empty, or lie: what can be read is, and the rest is named."""

from __future__ import annotations

import random
import sqlite3
from pathlib import Path

import pytest
from recordings.bags import Row, demanded, ros1, ros2

from haros_ci.errors import UserError
from haros_ci.recordings.bag import Bag
from haros_ci.recordings.jsonl import JsonLines
from haros_ci.recordings.recording import Cut, Recording
from haros_ci.recordings.sqlite_pages import Pages, ends_early

ROWS: list[Row] = [("/a" if number % 3 else "/b", number % 200, number) for number in range(1_500)]
TOPICS = frozenset(("/a", "/b"))


def values(recording: Recording) -> list[tuple[str, int]]:
    """Topic and value of each message; all must be there as they were written."""
    return [(topic, message.data) for topic, message, _, _ in recording.messages(TOPICS)]


def written(directory: Path, kind: str) -> Path:
    """The file of a bag of ``ROWS``: bag, db3, mcap, or one of these packed as a whole (zstd) or by message (message)."""
    if kind == "bag":
        return ros1(directory / "run.bag", ROWS)
    storage, _, packed = kind.partition("+")
    (path,) = ros2(directory / "run", ROWS, "sqlite3" if storage == "db3" else "mcap", packed).glob(f"*.{storage}*")
    return path


@pytest.mark.parametrize("kind", ["bag", "db3", "mcap", "db3+message", "db3+file", "mcap+file"])
def test_of_a_file_that_was_cut_off_the_beginning_is_read_and_the_rest_named(tmp_path: Path, kind: str) -> None:
    path = written(tmp_path, kind)
    content = path.read_bytes()
    counts = []
    for share in (10, 50, 99):
        path.write_bytes(content[: len(content) * share // 100])
        recording = Bag(path)
        found = values(recording)
        assert found == [row[:2] for row in ROWS[: len(found)]]
        (note,) = recording.notes
        assert note.startswith(f"{path.name} can be read up to message {len(found)} only: ") and recording.damage
        counts.append(len(found))
    assert counts == sorted(counts)
    if not kind.endswith("+file"):  # of these half may be one block of zstd
        assert counts[1] > 400 and counts[2] > 1_000


def test_of_a_database_that_was_cut_off_no_message_is_left_out_before_another(tmp_path: Path) -> None:
    """The bytes of large messages go on in pages of their own: a small one that is whole can stand beside one that is not."""
    rows = [(1, number, bytes([number]) * (30_000 if number % 3 else 10)) for number in range(60)]
    path = database(tmp_path, rows)
    content = path.read_bytes()
    for share in range(5, 100, 2):
        path.write_bytes(content[: len(content) * share // 100])
        found = list_of(path)
        assert found == [row[1:] for row in rows[: len(found)]]
        assert len(found) >= 60 * share // 100 - 4


def test_behind_a_page_that_is_no_longer_there_nothing_is_read(tmp_path: Path) -> None:
    path = database(tmp_path, [(1, number, bytes([number]) * 1_000) for number in range(90)])
    content = bytearray(path.read_bytes())
    leaves = [at for at in range(4_096, len(content), 4_096) if content[at] == 13 and bytes([40]) * 1_000 in content[at : at + 4_096]]  # fmt: skip
    (hole,) = leaves
    content[hole : hole + 4_096] = bytes(4_096)
    path.write_bytes(content[:-4_096])
    found = list_of(path)
    assert 20 < len(found) <= 40 and [time for time, _ in found] == list(range(len(found)))


@pytest.mark.parametrize("page_size", [512, 4_096, 65_536])
@pytest.mark.parametrize("size", [0, 1, 80, 470, 480, 3_000, 4_090, 70_000])
def test_rows_of_all_sizes_are_read_as_sqlite_reads_them(tmp_path: Path, page_size: int, size: int) -> None:
    draw = random.Random(size)
    rows = [(1, draw.choice([0, 1, 127, 128, 40_000, 1 << 23, 1 << 35, 1 << 47, 1 << 60]), draw.randbytes(size)) for _ in range(5)]  # fmt: skip
    path = database(tmp_path, rows, page_size)
    assert not ends_early(path)
    with path.open("rb") as file:
        pages = Pages(file)
        root, sql = pages.tables()["messages"]
        assert [tuple(row[1:]) for _, row in pages.rows(root)] == rows and sql.startswith("CREATE TABLE messages")


def database(directory: Path, rows: list[tuple[int, int, bytes]], page_size: int = 4_096) -> Path:
    """A file as rosbag2 makes it, with messages of one topic."""
    path = directory / "run.db3"
    with sqlite3.connect(path) as made:
        made.execute(f"PRAGMA page_size = {page_size}")
        made.execute(
            "CREATE TABLE topics(id INTEGER PRIMARY KEY, name TEXT NOT NULL, type TEXT NOT NULL, serialization_format TEXT NOT NULL, offered_qos_profiles TEXT NOT NULL)"
        )
        made.execute(
            "CREATE TABLE messages(id INTEGER PRIMARY KEY, topic_id INTEGER NOT NULL, timestamp INTEGER NOT NULL, data BLOB NOT NULL)"
        )
        made.execute("CREATE INDEX timestamp_idx ON messages (timestamp ASC)")
        made.execute("INSERT INTO topics VALUES (1, '/a', 'demo/msg/Level', 'cdr', '')")
        made.executemany("INSERT INTO messages (topic_id, timestamp, data) VALUES (?, ?, ?)", rows)
    made.close()
    return path


def list_of(path: Path) -> list[tuple[int, bytes]]:
    """Time and bytes of the messages of a database."""
    from haros_ci.recordings.sqlite import SqliteFile

    found = []
    try:
        for _, time, raw in SqliteFile(path).raw({}):
            found.append((time, raw))
    except Cut:
        pass
    return found


def test_bytes_of_a_database_that_are_changed_end_in_a_note(tmp_path: Path) -> None:
    """Whatever a file holds, reading it ends, with messages or a Cut, and of a loop of pages nothing is read without end."""
    whole = database(tmp_path, [(1, number, bytes(2_000)) for number in range(30)]).read_bytes()
    path = tmp_path / "changed.db3"
    draw = random.Random(7)
    for _ in range(300):
        content = bytearray(whole[: draw.randrange(100, len(whole))])
        for _ in range(draw.randrange(12)):
            at = draw.choice([draw.randrange(100), draw.randrange(len(content))])
            content[min(at, len(content) - 1)] = draw.choice([0, 5, 13, 255, draw.randrange(256)])
        path.write_bytes(content)
        assert len(list_of(path)) <= 2 * len(whole)


def test_pages_that_go_in_circles_are_cut(tmp_path: Path) -> None:
    page = 512
    head = bytearray(b"SQLite format 3\0".ljust(100, b"\0"))
    head[16:18], head[59], head[28:32], head[24:28] = page.to_bytes(2, "big"), 1, (99).to_bytes(4, "big"), b"\0\0\0\1"
    head[92:96] = head[24:28]
    root = bytes(head) + bytes([5, 0, 0, 0, 0, 0, 0, 0]) + (1).to_bytes(4, "big")
    path = tmp_path / "run.db3"
    path.write_bytes(root.ljust(page, b"\0") + bytes(page))
    assert ends_early(path)
    with path.open("rb") as file, pytest.raises(Cut, match="a table ends early"):
        Pages(file).tables()


def test_the_log_of_a_database_is_named(tmp_path: Path) -> None:
    ros2(tmp_path / "run", ROWS[:10])
    (path,) = (tmp_path / "run").glob("*.db3")
    (tmp_path / "run" / f"{path.name}-wal").write_bytes(b"x")
    recording = Bag(path)
    assert len(values(recording)) == 10
    (note,) = recording.notes
    assert note.endswith(f" up to message 10 only: what follows is in {path.name}-wal, which is not read")


@pytest.mark.parametrize("name", ["run.bag", "run.db3", "run.mcap"])
def test_an_empty_file_is_one(tmp_path: Path, name: str) -> None:
    demanded()
    (tmp_path / name).write_bytes(b"")
    with pytest.raises(UserError, match=f"{name}: is empty"):
        values(Bag(tmp_path / name))


def test_what_has_no_message_at_all_is_an_error_where_something_is_damaged(tmp_path: Path) -> None:
    path = written(tmp_path, "db3")
    path.write_bytes(path.read_bytes()[:9_000])
    recording: Recording = Bag(path)
    assert not values(recording)
    with pytest.raises(UserError, match=r"run\.db3: no message of it can be read: "):
        recording.demand_messages()
    lines = tmp_path / "run.jsonl"
    lines.write_text('{"topic": "/a"\n')
    recording = JsonLines(lines)
    assert not values(recording)
    with pytest.raises(UserError, match="line 1 is not a message: it is not JSON"):
        recording.demand_messages()


def test_a_recording_without_messages_says_so(tmp_path: Path) -> None:
    lines = tmp_path / "run.jsonl"
    lines.write_text("")
    for recording in (JsonLines(lines), Bag(ros1(tmp_path / "run.bag", []))):
        assert not values(recording)
        recording.demand_messages()
        assert recording.notes == [f"{recording.name} has no messages"]


@pytest.mark.parametrize(
    ("was", "becomes", "notes"),
    [
        ("\n  message_count: 10\n", "\n  message_count: 10\n", []),
        ("\n  message_count: 10\n", "\n", []),
        ("\n  message_count: 10\n", "\n  message_count: many\n", []),
        ("\n  message_count: 10\n", "\n  message_count: 12\n", ["metadata.yaml counts 12 messages, and 10 were read"]),
        ("\n  message_count: 10\n", "\n  message_count: -1\n", ["metadata.yaml counts -1 messages, and 10 were read"]),
        ("paths:\n  - run.db3\n", "paths:\n  - run.db3\n  - run.db3\n", []),
        ("storage_identifier: sqlite3", "storage_identifier: mcap", []),
        ("nanoseconds: ", "nanoseconds: 9", []),
    ],
)
def test_what_metadata_says_of_the_messages_is_held_to_them(
    tmp_path: Path, was: str, becomes: str, notes: list[str]
) -> None:
    directory = ros2(tmp_path / "run", ROWS[:10])
    metadata = directory / "metadata.yaml"
    text = metadata.read_text()
    assert was in text
    metadata.write_text(text.replace(was, becomes))
    recording = Bag(directory)
    assert len(values(recording)) == 10 and recording.notes == notes


def test_files_that_metadata_does_not_name_are_named(tmp_path: Path) -> None:
    directory = ros2(tmp_path / "run", ROWS[:10])
    for name in ("run_1.db3", "run_2.mcap.zstd", "notes.txt"):
        (directory / name).write_bytes(b"x")
    recording = Bag(directory)
    assert len(values(recording)) == 10
    assert recording.notes == ["metadata.yaml does not name run_1.db3, run_2.mcap.zstd: not read"]


@pytest.mark.parametrize(("content", "why"), [(b"", "is empty"), (b"nothing", "is no bag of ROS 1")])
def test_one_of_several_files_that_is_no_bag(tmp_path: Path, content: bytes, why: str) -> None:
    directory = ros2(tmp_path / "run", ROWS[:10])
    (directory / "run_1.db3").write_bytes(content)
    metadata = directory / "metadata.yaml"
    metadata.write_text(metadata.read_text().replace("- run.db3", "- run_1.db3\n  - run.db3", 1))
    recording = Bag(directory)
    assert len(values(recording)) == 10
    (note,) = recording.notes
    assert note.startswith("run_1.db3 is not read: ") and why in note


def test_a_directory_without_files_is_none(tmp_path: Path) -> None:
    demanded()
    (tmp_path / "metadata.yaml").write_text(
        "rosbag2_bagfile_information: {relative_file_paths: [], message_count: 0}\n"
    )
    with pytest.raises(UserError, match="names no files"):
        Bag(tmp_path)


@pytest.mark.parametrize(
    "kind", ["bag", "db3", "mcap", "db3+message", "db3+file", "mcap+file", "mcap+message", "jsonl"]
)
def test_how_much_has_been_read_is_known_of_every_recording(tmp_path: Path, kind: str) -> None:
    """The time that is left stands on it."""
    if kind == "jsonl":
        path = tmp_path / "run.jsonl"
        path.write_text(
            "".join(f'{{"topic": "{topic}", "time": {time}, "msg": {{"data": 1}}}}\n' for topic, _, time in ROWS)
        )
        recording: Recording = JsonLines(path)
    else:
        recording = Bag(written(tmp_path, kind))
    shares = [recording.share() for _ in recording.messages(TOPICS)]
    known = [share for share in shares if share is not None]
    assert len(known) == len(ROWS) and known == sorted(known) and 0 < known[0] and 0.5 < known[-1] <= 1


def test_how_much_has_been_read_of_a_database_that_was_cut_off(tmp_path: Path) -> None:
    path = written(tmp_path, "db3")
    path.write_bytes(path.read_bytes()[: path.stat().st_size // 2])
    recording = Bag(path)
    shares = [recording.share() or 0 for _ in recording.messages(TOPICS)]
    assert shares == sorted(shares) and 0 < shares[0] < shares[-1] <= 1
