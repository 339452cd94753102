# SPDX-License-Identifier: Apache-2.0
"""Messages per second of processor time, and the memory that a large recording takes.

    python tests/bench/monitor_speed.py speed [--count 200000]
    python tests/bench/monitor_speed.py large [--megabytes 1024]

``speed`` holds small messages of 25 topics, that are in memory, against one property and against fifty (two for each topic, all patterns). ``large``
writes a bag of ROS 1 (messages of 1 MB, and small ones between them), an MCAP and a SQLite file likewise, and reads each in a process of its own. The peak
is that of the process itself (VmHWM of Linux): getrusage's goes over from the process that has written the bag, whose memory grows with it.
"""

from __future__ import annotations

import argparse
import subprocess
import sys
import tempfile
import time
from pathlib import Path

TOPICS = 25
PATTERNS = (
    "globally: no /t{n} {{data > 1000000}}",
    "globally: /t{n} {{data > 3}} causes /t{m} within 500 ms",
    "globally: /t{n} as A causes /t{m} {{data >= @A.data}} within 10 s",
    "globally: /t{m} requires /t{n} within 500 ms",
    "globally: /t{n} {{data = 5}} forbids /t{m} {{data < 0}} within 1 s",
    "after /t{n} until /t{m} {{data < 0}}: no /t{n} {{data < 0}}",
)


def speed(count: int) -> None:
    """Prints a line for one property, and one for fifty."""
    from haros_ci.behaviour.parser import parse_property
    from haros_ci.monitoring.patterns import monitor_of
    from haros_ci.monitoring.watch import Watch

    def text(number: int) -> str:
        return PATTERNS[number % len(PATTERNS)].format(n=number % TOPICS, m=(number + 1) % TOPICS)

    for texts, busy in (([text(0)], 1), ([text(1)], 2), ([text(number) for number in range(50)], TOPICS)):
        watch = Watch(monitor_of(parse_property(each)) for each in texts)
        watch.begin(0)
        first = 0 if busy < 2 else 1 if busy == 2 else 0
        messages = [(f"/t{first + number % busy}", {"data": number}) for number in range(count)]
        start = time.process_time()
        for number, (topic, message) in enumerate(messages, 1):
            watch.take(topic, message, number * 1_000_000, number)
        used = time.process_time() - start
        verdicts = [each.verdict.value for each in watch.finish(count * 1_000_000)]
        counts = ", ".join(f"{verdicts.count(name)} {name}" for name in sorted(set(verdicts)))
        print(f"{len(texts)} properties on {busy} topics: {count / used:,.0f} messages per second ({counts})")


def large(megabytes: int) -> None:
    """Prints the peak of memory for each kind of bag."""
    with tempfile.TemporaryDirectory() as directory:
        for name in ("run.bag", "run.mcap.d", "run.db3.d"):
            path = Path(directory, name)
            _write(path, megabytes)
            code = [sys.executable, __file__, "read", "--bag", str(path)]
            print(name, subprocess.run(code, check=True, capture_output=True, text=True).stdout, end="", flush=True)


def _write(path: Path, megabytes: int) -> None:
    import numpy
    from rosbags import rosbag1, rosbag2
    from rosbags.typesys import Stores, get_typestore

    is_ros1 = path.suffix == ".bag"
    store = get_typestore(Stores.ROS1_NOETIC if is_ros1 else Stores.LATEST)
    types = "std_msgs/msg/UInt8MultiArray", "std_msgs/msg/Int32"
    layout = store.types["std_msgs/msg/MultiArrayLayout"](dim=[], data_offset=0)
    messages = (
        store.types[types[0]](layout=layout, data=numpy.zeros(1 << 20, dtype=numpy.uint8)),
        store.types[types[1]](data=7),
    )
    pack = store.serialize_ros1 if is_ros1 else store.serialize_cdr
    raw = [pack(message, name) for message, name in zip(messages, types)]
    plugin = rosbag2.StoragePlugin.SQLITE3 if ".db3" in path.suffixes else rosbag2.StoragePlugin.MCAP
    writer = rosbag1.Writer(path) if is_ros1 else rosbag2.Writer(path, version=9, storage_plugin=plugin)
    with writer:
        made = [writer.add_connection(topic, name, typestore=store) for topic, name in zip(("/image", "/count"), types)]
        for number in range(megabytes):
            for step in range(101):
                which = 1 if step else 0
                writer.write(made[which], 10**18 + number * 10**8 + step * 10**6, raw[which])


def read(bag: str) -> None:
    """Holds a bag against two properties; prints messages, processor seconds and the peak of memory."""
    from haros_ci.behaviour.parser import parse_property
    from haros_ci.monitoring.patterns import monitor_of
    from haros_ci.monitoring.watch import Watch
    from haros_ci.recordings.bag import Bag

    texts = ("globally: /image as I causes /count {data > @I.data[0]} within 50 ms", "globally: no /count {data > 100}")
    watch = Watch(monitor_of(parse_property(each)) for each in texts)
    recording = Bag(Path(bag))
    start = time.process_time()
    for topic, message, at, number in recording.messages(watch.topics):
        watch.take(topic, message, at, number)
    verdicts = [each.verdict.value for each in watch.finish(recording.last)]
    peak = _peak()
    size = sum(each.stat().st_size for each in recording.files) / (1 << 20)
    used = time.process_time() - start
    print(
        f"{size:,.0f} MB, {recording.count:,} messages: {used:.1f} s of processor time, peak {peak:.0f} MB, {verdicts}, {recording.notes}"
    )


def _peak() -> float:
    """The most memory, in MB, that this process had since it began."""
    (line,) = (each for each in Path("/proc/self/status").read_text().splitlines() if each.startswith("VmHWM:"))
    return int(line.split()[1]) / 1024


def main() -> None:
    sys.path.insert(0, str(Path(__file__).resolve().parents[2]))
    parser = argparse.ArgumentParser()
    parser.add_argument("what", choices=["speed", "large", "read"])
    parser.add_argument("--count", type=int, default=200_000)
    parser.add_argument("--megabytes", type=int, default=1024)
    parser.add_argument("--bag", default="")
    given = parser.parse_args()
    if given.what == "speed":
        speed(given.count)
    elif given.what == "large":
        large(given.megabytes)
    else:
        read(given.bag)


if __name__ == "__main__":
    main()
