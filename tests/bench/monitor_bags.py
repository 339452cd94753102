# SPDX-License-Identifier: Apache-2.0
"""Public bags, judged by ``haros-ci monitor`` and by a reading of their own.

    python tests/bench/monitor_bags.py ROSBAG_JS/fixtures ROSBAG2

ROSBAG_JS is a checkout of cruise-automation/rosbag.js (its bags are of turtlesim, ROS 1), ROSBAG2 one of ros2/rosbag2. Messages of ROS 1 are read by rosbags'
reader, those of MCAP files by the package mcap, those of databases by sqlite3 alone; properties are judged by a few lines of Python about the whole recording.
"""

from __future__ import annotations

import json
import sqlite3
import subprocess
import sys
import tempfile
from bisect import bisect_right
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

Heard = list[tuple[int, str, Any]]
Event = Callable[[str, Any], bool]
Verdict = Callable[[Heard], str]
SECOND = 1_000_000_000


def on(topic: str, test: Callable[[Any], bool] | None = None) -> Event:
    return lambda name, message: name == topic and (test is None or (message is not None and test(message)))


def no(b: Event) -> Verdict:
    return lambda heard: "violated" if any(b(name, message) for _, name, message in heard) else "held"


def some(b: Event) -> Verdict:
    return lambda heard: "held" if any(b(name, message) for _, name, message in heard) else "violated"


def causes(a: Event, b: Event, seconds: float) -> Verdict:
    def judge(heard: Heard) -> str:
        answers = [at for at, (_, name, message) in enumerate(heard) if b(name, message)]
        is_open = False
        for at, (time, name, message) in enumerate(heard):
            if a(name, message):
                next_ = bisect_right(answers, at)
                if next_ < len(answers) and heard[answers[next_]][0] - time < seconds * SECOND:
                    continue
                if heard[-1][0] - time >= seconds * SECOND:
                    return "violated"
                is_open = True
        return "undecided" if is_open else "held"

    return judge


def forbids(a: Event, b: Event, seconds: float, is_required: bool = False) -> Verdict:
    """Also ``b requires a``: then every b needs an a in the window before it."""

    def judge(heard: Heard) -> str:
        last: int | None = None
        for time, name, message in heard:
            is_near = last is not None and time - last < seconds * SECOND
            if b(name, message) and is_near != is_required:
                return "violated"
            if a(name, message):
                last = time
        return "held"

    return judge


TURTLES: list[tuple[str, Verdict]] = [
    ("no /turtle1/pose {x > 11.1}", no(on("/turtle1/pose", lambda m: m.x > 11.1))),
    ("no /turtle1/pose {x > 9.0}", no(on("/turtle1/pose", lambda m: m.x > 9.0))),
    ("no /turtle1/pose {x > 6.0 and y < 5.0}", no(on("/turtle1/pose", lambda m: m.x > 6 and m.y < 5))),
    ("/turtle1/cmd_vel causes /turtle1/pose within 50 ms", causes(on("/turtle1/cmd_vel"), on("/turtle1/pose"), 0.05)),
    ("/turtle1/cmd_vel causes /turtle1/pose within 15 ms", causes(on("/turtle1/cmd_vel"), on("/turtle1/pose"), 0.015)),
    (
        "/turtle1/cmd_vel {linear.x > 0} causes /turtle1/pose {linear_velocity > 0} within 40 ms",
        causes(
            on("/turtle1/cmd_vel", lambda m: m.linear.x > 0), on("/turtle1/pose", lambda m: m.linear_velocity > 0), 0.04
        ),
    ),
    ("/turtle2/cmd_vel requires /tf within 100 ms", forbids(on("/tf"), on("/turtle2/cmd_vel"), 0.1, True)),
    ("/turtle2/cmd_vel requires /tf within 5 ms", forbids(on("/tf"), on("/turtle2/cmd_vel"), 0.005, True)),
    (
        "/turtle2/cmd_vel requires /turtle1/cmd_vel within 1 s",
        forbids(on("/turtle1/cmd_vel"), on("/turtle2/cmd_vel"), 1, True),
    ),
    ("/turtle1/pose forbids /turtle1/pose within 10 ms", forbids(on("/turtle1/pose"), on("/turtle1/pose"), 0.01)),
    ("/turtle1/pose forbids /turtle1/pose within 20 ms", forbids(on("/turtle1/pose"), on("/turtle1/pose"), 0.02)),
    ("no /rosout {level > 4}", no(on("/rosout", lambda m: m.level > 4))),
    ("no /rosout {header.stamp.secs = 0}", no(on("/rosout", lambda m: m.header.stamp.sec == 0))),
    ('no /rosout {name = "/turtlesim"}', no(on("/rosout", lambda m: m.name == "/turtlesim"))),
    (
        'no /tf {transforms[0].child_frame_id = "turtle2"}',
        no(on("/tf", lambda m: m.transforms[0].child_frame_id == "turtle2")),
    ),
    (
        'no /tf {exists i in transforms: not transforms[@i].header.frame_id = "world"}',
        no(on("/tf", lambda m: any(each.header.frame_id != "world" for each in m.transforms))),
    ),
    (
        "some /turtle1/color_sensor {r in [179 to 255]}",
        some(on("/turtle1/color_sensor", lambda m: 179 <= m.r <= 255)),
    ),
]
TALKER: list[tuple[str, Verdict]] = [
    ('no /topic {data = "Hello, world! 3"}', no(on("/topic", lambda m: m.data == "Hello, world! 3"))),
    ("/topic forbids /topic within 400 ms", forbids(on("/topic"), on("/topic"), 0.4)),
    ("/topic forbids /topic within 600 ms", forbids(on("/topic"), on("/topic"), 0.6)),
    ("/topic causes /rosout within 100 ms", causes(on("/topic"), on("/rosout"), 0.1)),
    ("/topic requires /rosout within 100 ms", forbids(on("/rosout"), on("/topic"), 0.1, True)),
]
STRINGS: list[tuple[str, Verdict]] = [
    ("no /BBB", no(on("/BBB"))),
    ("/AAA causes /BBB within 1 ms", causes(on("/AAA"), on("/BBB"), 0.001)),
    ("/HHH requires /AAA within 1 ms", forbids(on("/AAA"), on("/HHH"), 0.001, True)),
    ('no /CCC {data = "nothing"}', no(on("/CCC", lambda m: m.data == "nothing"))),
]
ARRAYS: list[tuple[str, Verdict]] = [
    ("no /test_topic {int32_value > 1000000}", no(on("/test_topic", lambda m: m.int32_value > 1_000_000))),
    ("no /array_topic {bool_values[0]}", no(on("/array_topic", lambda m: bool(m.bool_values[0])))),
    ("no /array_topic {float32_values[1] = 2.5}", no(on("/array_topic", lambda m: m.float32_values[1] == 2.5))),
    ("/test_topic requires /array_topic within 1 s", forbids(on("/array_topic"), on("/test_topic"), 1, True)),
]


def bags(fixtures: Path, rosbag2: Path) -> Iterator[tuple[Path, list[tuple[str, Verdict]]]]:
    for name in ("example.bag", "example-bz2.bag", "example-lz4.bag"):
        yield fixtures / name, TURTLES
    for kind in ("mcap", "sqlite3"):
        yield rosbag2 / "rosbag2_py/test/resources" / kind / "talker", TALKER
        yield rosbag2 / "rosbag2_py/test/resources" / kind / "wbag", STRINGS
        yield rosbag2 / "rosbag2_tests/resources" / kind / "cdr_test", ARRAYS


def heard_in(path: Path) -> Heard:
    if path.is_file():
        from rosbags.highlevel import AnyReader

        with AnyReader([path]) as reader:
            return [(time, on_.topic, reader.deserialize(raw, on_.msgtype)) for on_, time, raw in reader.messages()]
    found: Heard = []
    for file in sorted(path.glob("*.mcap")):
        from mcap.reader import NonSeekingReader

        with file.open("rb") as stream:
            for schema, channel, message in NonSeekingReader(stream).iter_messages():
                value = _decoded(message.data, schema.name, schema.data.decode())
                found.append((message.log_time, _full(channel.topic), value))
    for file in sorted(path.glob("*.db3")):
        database = sqlite3.connect(file)
        tables = {name for (name,) in database.execute("SELECT name FROM sqlite_master")}
        query = "SELECT topic_type, encoded_message_definition FROM message_definitions"
        texts = dict(database.execute(query)) if "message_definitions" in tables else {}
        topics = {
            key: (_full(name), type_) for key, name, type_ in database.execute("SELECT id, name, type FROM topics")
        }
        for key, time, raw in database.execute("SELECT topic_id, timestamp, data FROM messages ORDER BY timestamp, id"):
            topic, type_ = topics[key]
            found.append((time, topic, _decoded(raw, type_, texts.get(type_))))
    return found


def _decoded(raw: bytes, type_: str, definition: str | None) -> Any:
    from rosbags.typesys import Stores, get_types_from_msg, get_typestore

    store = get_typestore(Stores.LATEST if definition is None else Stores.EMPTY)
    try:
        if definition is not None:
            store.register(get_types_from_msg(definition, type_))
        return store.deserialize_cdr(raw, type_)
    except Exception:  # noqa: BLE001 (then the one under test must not have it either)
        return None


def _full(topic: str) -> str:
    return topic if topic.startswith("/") else f"/{topic}"


def judged(path: Path, properties: list[str]) -> list[str]:
    command = [
        sys.executable,
        "-m",
        "haros_ci",
        "monitor",
        "--isolated",
        "--no-cache",
        "--bag",
        str(path),
        "--output",
        "json",
    ]
    for text in properties:
        command += ["--property", f"globally: {text}"]
    with tempfile.TemporaryDirectory() as empty:
        done = subprocess.run(command, capture_output=True, text=True, check=False, cwd=empty)
    return [each["verdict"] for each in json.loads(done.stdout)["properties"]]


def main() -> None:
    compared = differences = 0
    for path, rows in bags(Path(sys.argv[1]).absolute(), Path(sys.argv[2]).absolute()):
        heard = heard_in(path)
        for (text, verdict), found in zip(rows, judged(path, [text for text, _ in rows])):
            expected = verdict(heard)
            compared += 1
            if found != expected:
                differences += 1
                print(f"{path.name}: {text}: {found}, expected {expected}")
    print(f"{compared} compared, {differences} differences")


if __name__ == "__main__":
    main()
