# SPDX-License-Identifier: Apache-2.0
"""Bags of all kinds, whole and damaged, and bags that name files which are not theirs."""

from __future__ import annotations

import bz2
import struct
from pathlib import Path
from typing import Any

import pytest
from recordings.bags import BEGIN, MS, Row, demanded, ros1, ros2

from haros_ci.errors import UserError
from haros_ci.recordings import bag, packed
from haros_ci.recordings.bag import Bag
from haros_ci.recordings.mcap import McapFile
from haros_ci.recordings.recording import LONGEST_DEFINITION, Channel, Cut, Unreadable
from haros_ci.recordings.types import checked, decoder_of

ROWS: list[Row] = [("/a", 1, 0), ("/b", 2, 5), ("/a", 3, 10), ("/a", 4, 20)]
WANTED = frozenset(("/a",))


def read(path: Path, wanted: frozenset[str] = WANTED) -> tuple[list[tuple[str, Any, int, int]], Bag]:
    recording = Bag(path)
    found = []
    for topic, message, time, number in recording.messages(wanted):
        what = message.reason if isinstance(message, Unreadable) else (message.data, message.LOW, list(message.values))
        found.append((topic, what, (time - BEGIN) // MS, number))
    return found, recording


EXPECTED = [("/a", (1, 3, [1.0, 0.5]), 0, 1), ("/a", (3, 3, [3.0, 0.5]), 10, 3), ("/a", (4, 3, [4.0, 0.5]), 20, 4)]


@pytest.mark.parametrize("compression", ["", "bz2", "lz4"])
def test_ros1(tmp_path: Path, compression: str) -> None:
    found, recording = read(ros1(tmp_path / "run.bag", ROWS, compression))
    assert found == EXPECTED and not recording.notes
    assert (recording.count, recording.first, recording.last) == (4, BEGIN, BEGIN + 20 * MS)
    assert recording.topics == {"/a": {"demo/Level"}, "/b": {"demo/Level"}}


@pytest.mark.parametrize(
    ("storage", "compression"),
    [("sqlite3", ""), ("sqlite3", "file"), ("sqlite3", "message"), ("mcap", ""), ("mcap", "file"), ("mcap", "message"), ("mcap", "storage")],
)  # fmt: skip
def test_ros2(tmp_path: Path, storage: str, compression: str) -> None:
    found, recording = read(ros2(tmp_path / "run", ROWS, storage, compression))
    assert found == EXPECTED and not recording.notes
    assert recording.topics == {"/a": {"demo/msg/Level"}, "/b": {"demo/msg/Level"}}


def test_a_file_of_a_bag_alone(tmp_path: Path) -> None:
    ros2(tmp_path / "run", ROWS, "mcap")
    (file,) = (tmp_path / "run").glob("*.mcap")
    assert read(file)[0] == EXPECTED


@pytest.mark.parametrize("kind", ["ros1", "mcap"])
def test_a_bag_that_was_cut_off_is_read_up_to_there(tmp_path: Path, kind: str) -> None:
    rows = [("/a", number % 200, number) for number in range(2_000)]
    if kind == "ros1":
        path = ros1(tmp_path / "run.bag", rows)
    else:
        ros2(tmp_path / "run", rows, "mcap")
        (path,) = (tmp_path / "run").glob("*.mcap")
    content = path.read_bytes()
    seen = set()
    for share in (0.1, 0.3, 0.6, 0.9):
        path.write_bytes(content[: int(len(content) * share)])
        found, recording = read(path)
        seen.add(len(found))
        assert [each[3] for each in found] == list(range(1, len(found) + 1))
        if len(found) < 2_000:
            (note,) = recording.notes
            assert "can be read up to message" in note
    assert seen


@pytest.mark.parametrize("kind", ["ros1", "mcap"])
def test_of_a_chunk_that_was_cut_off_the_beginning_is_read(tmp_path: Path, kind: str) -> None:
    rows: list[Row] = [("/a", number % 200, number) for number in range(2_000)]
    path = ros1(tmp_path / "run.bag", rows) if kind == "ros1" else _mcap(tmp_path, rows)
    path.write_bytes(path.read_bytes()[:20_000])
    found, recording = read(path)
    assert 100 < len(found) < 1_000 and [each[3] for each in found] == list(range(1, len(found) + 1))
    assert recording.notes == [f"{path.name} can be read up to message {len(found)} only: it ends early"]


def _mcap(directory: Path, rows: list[Row]) -> Path:
    (path,) = ros2(directory / "run", rows, "mcap").glob("*.mcap")
    return path


def test_a_bag_without_its_index_may_lack_messages(tmp_path: Path) -> None:
    path = ros1(tmp_path / "run.bag", ROWS)
    content = path.read_bytes()
    index = content.index(b"index_pos=") + len("index_pos=")
    (place,) = struct.unpack_from("<q", content, index)
    for cut, open_ in ((content[: place - 3], content[index : index + 8]), (content[:place], bytes(8))):
        path.write_bytes(cut[:index] + open_ + cut[index + 8 :])
        found, recording = read(path)
        why = "it ends early" if any(open_) else "it was not closed"
        assert found == EXPECTED and recording.notes == [f"run.bag can be read up to message 4 only: {why}"]


def test_a_chunk_whose_checksum_does_not_fit(tmp_path: Path) -> None:
    path = _mcap(tmp_path, ROWS)
    content = bytearray(path.read_bytes())
    at = content.index(b"lz4") if b"lz4" in content else content.index(b"demo/msg/Level")
    chunk = content.index(b"\x06", 8)
    assert chunk < at
    content[chunk + 9 + 24 : chunk + 9 + 28] = b"\x01\x02\x03\x04"
    path.write_bytes(content)
    found, recording = read(path)
    assert found == [] and recording.notes == [f"{path.name} can be read up to message 0 only: a chunk is damaged"]


def test_a_type_that_is_not_known(tmp_path: Path) -> None:
    import sqlite3

    ros2(tmp_path / "run", ROWS)
    (path,) = (tmp_path / "run").glob("*.db3")
    with sqlite3.connect(path) as database:
        database.execute("DELETE FROM message_definitions")
    found, _ = read(path)
    assert {each[1] for each in found} == {
        f"message {number}, on /a, cannot be read: the bag does not say what a demo/msg/Level is"
        for number in (1, 3, 4)
    }


@pytest.mark.parametrize(
    ("type", "definition", "why"),
    [
        ("demo/Level", "uint8 data\n%%%", "Could not parse"),
        ("demo/Level", "Other other", ""),
        ("demo/Level", "Level again", ""),
        ("demo/Level", "uint8 class\nuint8 data", "no demo/Level"),
        ("demo/Level", "uint8 data\n" * 30_000, "too long"),
        ("demo/Level", "Empty[] all\n" + "=" * 80 + "\nMSG: demo/Empty\n", "without any field"),
        ("demo/Level\nimport os", "uint8 data", "no name"),
        ("../Level", "uint8 data", "no name"),
        ("Level", "uint8 data", "no name"),
        ("demo/Level", None, "does not say"),
        ("demo/Level", "Other other\nuint8 data", "the bag does not say what a demo/msg/Other is"),
        ("demo/Level", "Other[3] others\nuint8 data", "the bag does not say what a demo/msg/Other is"),
        ("demo/Level", "string s='''\"\"\"\nimport os\nuint8 data", ""),
    ],
)
def test_definitions_that_cannot_be_read(type: str, definition: str | None, why: str) -> None:
    demanded()
    from haros_ci.recordings.types import decoder_of

    found = decoder_of(Channel("/a", type, definition, "ros1"))(b"\x01\x02\x03\x04\x05", 7)
    assert (
        isinstance(found, Unreadable)
        and why in found.reason
        and found.reason.startswith("message 7, on /a, cannot be read: ")
    )
    assert "\n" not in found.reason.replace(type, "")


HEADER = "\n" + "=" * 80 + "\nMSG: std_msgs/Header\nuint32 seq\ntime stamp\nstring frame_id\n"


@pytest.mark.parametrize(
    ("definition", "raw", "expected"),
    [
        ("Header header\nuint8 data" + HEADER, struct.pack("<IIII3sB", 1, 12, 5, 3, b"map", 7), ("map", 12, 5, 7)),
        ("std_msgs/Header header\nuint8 data" + HEADER, struct.pack("<IIIIB", 1, 12, 5, 0, 7), ("", 12, 5, 7)),
    ],
)
def test_times_of_ros1_need_no_definition(definition: str, raw: bytes, expected: tuple[Any, ...]) -> None:
    demanded()
    found = decoder_of(Channel("/a", "demo/Level", definition, "ros1"))(raw, 1)
    stamp = found.header.stamp
    assert (found.header.frame_id, stamp.sec, stamp.nanosec, found.data) == expected
    assert isinstance(decoder_of(Channel("/a", "demo/Level", definition, "ros1"))(raw[:15], 1), Unreadable)


@pytest.mark.parametrize(
    ("encoding", "type", "raw"),
    [
        ("ros1", "std_msgs/Empty", b""),
        ("ros1", "demo/Reset", b""),
        ("cdr", "demo/msg/Reset", b"\x00\x01\x00\x00\x00"),
    ],
)
@pytest.mark.parametrize("definition", ["", "# nothing\n"])
def test_messages_without_fields(encoding: str, type: str, raw: bytes, definition: str) -> None:
    demanded()
    assert not isinstance(decoder_of(Channel("/a", type, definition, encoding))(raw, 1), Unreadable)


def test_times_and_durations_alone_and_in_arrays() -> None:
    demanded()
    decode = decoder_of(Channel("/a", "demo/Level", "time at\nduration[2] waits\ntime[] more\n", "ros1"))
    found = decode(struct.pack("<II4iIII", 9, 8, -1, 7, 2, 6, 1, 5, 4), 1)
    assert (found.at.sec, found.waits[0].sec, found.more[0].nanosec) == (9, -1, 4)


@pytest.mark.parametrize("topic", ["a", "/a"])
@pytest.mark.parametrize("kind", ["ros1", "sqlite3", "mcap"])
def test_names_without_a_slash_are_below_the_root(tmp_path: Path, kind: str, topic: str) -> None:
    rows: list[Row] = [(topic, 1, 0)]
    path = ros1(tmp_path / "run.bag", rows) if kind == "ros1" else ros2(tmp_path / "run", rows, kind)
    found, recording = read(path)
    assert [each[0] for each in found] == ["/a"] and list(recording.topics) == ["/a"]


@pytest.mark.parametrize("raw", [b"", b"\xff\xff\xff\xff", b"\x00\x01\x00\x00\xff\xff\xff\x7f", b"\x28\xb5\x2f\xfdxx"])
def test_bytes_that_are_no_message(raw: bytes) -> None:
    demanded()
    from haros_ci.recordings.types import decoder_of

    decode = decoder_of(Channel("/a", "demo/msg/Level", "string data\n", "cdr"))
    assert isinstance(decode(raw, 1), Unreadable)


@pytest.mark.parametrize(
    "name",
    [
        "../other.db3",
        "/etc/passwd",
        "link.db3",
        "directory",
        "missing.db3",
        "sub/run.db3",
        "..",
        ".",
        "",
        "run/../../x",
        "a\x00b",
    ],
)
def test_no_file_outside_the_directory_is_opened(tmp_path: Path, name: str) -> None:
    demanded()
    directory = tmp_path / "run"
    (directory / "directory").mkdir(parents=True)
    (directory / "sub").mkdir()
    for path in (tmp_path / "other.db3", directory / "sub" / "run.db3"):
        path.write_bytes(bag.MAGIC_SQLITE)
    (directory / "link.db3").symlink_to(tmp_path / "other.db3")
    quoted = name.replace("\x00", "\\0")
    (directory / "metadata.yaml").write_text(f'rosbag2_bagfile_information:\n  relative_file_paths: ["{quoted}"]\n')
    with pytest.raises(UserError):
        Bag(directory)


@pytest.mark.parametrize(
    "text",
    [
        "",
        "[]",
        "rosbag2_bagfile_information: 3",
        "a: &a [*a]",
        "rosbag2_bagfile_information: {relative_file_paths: [1]}",
        "\x00",
    ],
)
def test_metadata_that_is_none(tmp_path: Path, text: str) -> None:
    demanded()
    (tmp_path / "metadata.yaml").write_text(text)
    with pytest.raises(UserError):
        Bag(tmp_path)


def test_metadata_is_no_link(tmp_path: Path) -> None:
    demanded()
    ros2(tmp_path / "real", ROWS)
    (tmp_path / "run").mkdir()
    (tmp_path / "run" / "metadata.yaml").symlink_to(tmp_path / "real" / "metadata.yaml")
    with pytest.raises(UserError, match="has no metadata"):
        Bag(tmp_path / "run")


def test_older_metadata_has_the_directory_in_names(tmp_path: Path) -> None:
    ros2(tmp_path / "run", ROWS)
    path = tmp_path / "run" / "metadata.yaml"
    text = path.read_text()
    path.write_text(text.replace("run.db3", "run/run.db3"))
    assert read(tmp_path / "run")[0] == EXPECTED


@pytest.mark.parametrize("form", ["bz2", "lz4", "zstd"])
def test_what_unpacks_to_too_much_is_cut(form: str) -> None:
    demanded()
    packed_zeros = _packed(form, bytes(1_000_000))
    assert packed.unpacked(packed_zeros, form, 1_000_000) == bytes(1_000_000)
    with pytest.raises(Cut, match="when unpacked"):
        packed.unpacked(packed_zeros, form, 999_999)
    for damaged in (packed_zeros[:-5], b"xx" + packed_zeros, b""):
        with pytest.raises(Cut):
            packed.unpacked(damaged, form)


def _packed(form: str, content: bytes) -> bytes:
    if form == "bz2":
        return bz2.compress(content)
    if form == "lz4":
        import lz4.frame

        return bytes(lz4.frame.compress(content))
    return bytes(packed._zstd().compress(content))


def test_a_chunk_that_unpacks_to_too_much(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    path = ros1(tmp_path / "run.bag", [("/a", 1, number) for number in range(5_000)], "bz2")
    monkeypatch.setattr(packed.unpacked, "__defaults__", (10_000,))
    found, recording = read(path)
    assert not found and "when unpacked" in recording.notes[0]


@pytest.mark.parametrize(
    "content",
    [
        b"", b"nothing", b"#ROSBAG V1.2\n", b"#ROSBAG V2.0\n" + b"\xff" * 40, b"#ROSBAG V2.0\n" + struct.pack("<I", 5) + b"\x01\0\0\0x" + b"\0\0\0\0",
        bag.MAGIC_MCAP, bag.MAGIC_MCAP + b"\x06" + b"\xff" * 8, bag.MAGIC_MCAP + b"\x05" + struct.pack("<Q", 3) + b"abc",
        bag.MAGIC_MCAP + b"\x09" + struct.pack("<Q", 1 << 60), bag.MAGIC_SQLITE + b"x" * 4_000, bag.MAGIC_ZSTD + b"x",
    ],
)  # fmt: skip
def test_what_is_no_bag(tmp_path: Path, content: bytes) -> None:
    demanded()
    path = tmp_path / "run.bag"
    path.write_bytes(content)
    try:
        found, recording = read(path)
    except UserError as err:
        assert "run.bag" in err.message
    else:
        assert not found and recording.notes


def test_a_database_whose_tables_are_calculated(tmp_path: Path) -> None:
    demanded()
    import sqlite3

    path = tmp_path / "run.db3"
    with sqlite3.connect(path) as database:
        database.execute("CREATE TABLE topics(id, name, type, serialization_format)")
        database.execute(
            "CREATE VIEW messages AS WITH RECURSIVE c(x) AS (SELECT 1 UNION ALL SELECT x+1 FROM c) SELECT x AS topic_id, x AS timestamp, x AS data FROM c"
        )
    _, recording = read(path)
    assert "no tables" in recording.notes[0]


def test_without_the_extra(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    monkeypatch.setattr(bag, "find_spec", lambda name: None)
    with pytest.raises(UserError, match="not installed") as err:
        Bag(tmp_path)
    assert err.value.help == "pip install 'haros-ci[bags]'"


@pytest.mark.parametrize("name", ["none", "/dev/zero", "fifo"])
def test_what_is_no_file(tmp_path: Path, name: str) -> None:
    import os

    demanded()
    os.mkfifo(tmp_path / "fifo")
    with pytest.raises(UserError):
        Bag(tmp_path / name)


RULE = "=" * 80 + "\n"


@pytest.mark.parametrize(
    ("definition", "reason"),
    [
        ("B[1000000] b\n" + RULE + "MSG: demo/B\nuint8 y\n", "its arrays of a fixed size have more than 2,000 messages or texts"),
        ("string[1000000] b\n", "its arrays of a fixed size have more than 2,000 messages or texts"),
        ("float64[1000000000] b\n", "an array has more than 10,000,000 elements"),
        ("A a\n", "demo/msg/A contains itself"),
        (
            "T0 a\n" + "".join(f"{RULE}MSG: demo/T{n}\nT{n + 1} a\nT{n + 1} b\n" for n in range(40)) + f"{RULE}MSG: demo/T40\nuint8 y\n",
            "demo/msg/T16 has more than 10,000,000 values",
        ),
        ("float64[10] b\n", "it is shorter than a demo/A"),
    ],
    ids=["messages", "texts", "numbers", "itself", "doubling", "short"],
)  # fmt: skip
@pytest.mark.parametrize("encoding", ["ros1", "cdr"])
def test_definitions_that_are_out_of_bounds(definition: str, reason: str, encoding: str) -> None:
    demanded()
    found = decoder_of(Channel("/t", "demo/A", definition, encoding))(b"\x00\x01\x00\x00", 1)
    assert isinstance(found, Unreadable) and found.reason == f"message 1, on /t, cannot be read: {reason}"


NUMBER = (1, ("uint8", 0))


@pytest.mark.parametrize(
    "types",
    [
        {"demo/msg/A:\n    pass\nimport os\nclass B": ([], [("x", NUMBER)])},
        {"demo/msg/A": ([], [("x: int = open('f', 'w')\n    y", NUMBER)])},
        {"demo/msg/A": ([("K = 1\n    Z", "int32", 1)], [("x", NUMBER)])},
        {"demo/msg/A": ([("K", "int32]\n    Z: ClassVar[int", 1)], [("x", NUMBER)])},
        {"demo/msg/A": ([("K", "string", object())], [("x", NUMBER)])},
        {"demo/msg/A": ([], [("x", (2, "demo/msg/B', 1), open('f'), ('"))])},
        {"demo/msg/A": ([], [("x", (1, ("uint8', 0)), open('f'", 0)))])},
        {"demo/msg/A": ([], [("x", (3, (NUMBER, "open('f')")))])},
        {"demo/msg/A": ([], [("x", (3, (NUMBER, -1)))])},
        {"demo/msg/А": ([], [("x", NUMBER)])},
    ],
)
def test_nothing_but_names_values_and_sizes_becomes_code(types: dict[str, Any]) -> None:
    with pytest.raises(ValueError, match="is no name|no plain value|elements"):
        checked(types)


def test_a_usual_definition_is_in_bounds() -> None:
    checked(
        {
            "geometry_msgs/msg/Pose": (
                [("K", "int32", 1), ("S", "string", "a\"'\n")],
                [("p", (2, "geometry_msgs/msg/Point")), ("c", (3, (NUMBER, 36)))],
            )
        }
    )


def text(value: str) -> bytes:
    """A text of MCAP."""
    return struct.pack("<I", len(value)) + value.encode()


def test_what_is_kept_of_definitions_has_a_bound(monkeypatch: pytest.MonkeyPatch) -> None:
    """Packed, a chunk of a few kB can have gigabytes of them."""
    file = McapFile(Path("run.mcap"))
    file.schema(b"\x01\x00" + text("demo/A") + text("ros2msg") + text("# " + "x" * 500_000))
    assert len(file.schemas[1][2]) == LONGEST_DEFINITION + 1
    monkeypatch.setattr(file.definitions, "left", 10)
    file.schema(b"\x02\x00" + text("demo/B") + text("ros2msg") + text("uint8 x"))
    assert file.schemas[2] == ("demo/B", "ros2msg", "uint8 x")
    with pytest.raises(Cut, match="definitions of its types are too long"):
        file.schema(b"\x03\x00" + text("demo/C") + text("ros2msg") + text("uint8 x"))


@pytest.mark.parametrize("topic, type", [("/" + "a" * 1_000, "demo/A"), ("/a", "demo/" + "A" * 1_000)])
def test_names_have_a_bound(topic: str, type: str) -> None:
    with pytest.raises(Cut, match="a name of more than 1,000 characters"):
        Channel(topic, type, "", "cdr")
    with pytest.raises(Cut, match="a name of more than 1,000 characters"):
        McapFile(Path("run.mcap")).schema(b"\x01\x00" + text("A" * 1_001) + text("ros2msg") + text(""))
    assert Channel(topic[:1_000], type[:1_000], "", "cdr").count == 0


def test_a_chunk_that_ends_in_its_head_is_cut() -> None:
    with pytest.raises(Cut, match="a record is damaged"):
        list(McapFile(Path("run.mcap")).chunk(b"", {}))
