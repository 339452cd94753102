# SPDX-License-Identifier: Apache-2.0
"""Recordings and command-line tools that a launch file starts: the topics, services and actions that their command lines name.

rosbag, rostopic and rosservice of ROS 1, ``ros2 bag``, ``topic``, ``service`` and ``action`` of ROS 2. What their entries in the data files say holds beside that.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import replace

from haros_ci.graph.names import UNKNOWN
from haros_ci.records import dataclass, field
from haros_ci.regex import regex
from haros_ci.systems.known.entry import KnownEndpoint, KnownNode
from haros_ci.systems.known.text import Hole

#: Topics of one recording, or of one command line.
MOST = 1_000

_TOPIC = regex(r"[~/]?[A-Za-z_][A-Za-z0-9_]*(?:/[A-Za-z_][A-Za-z0-9_]*)*")
_TYPE = regex(r"[A-Za-z]\w*/(?:(?:msg|srv|action)/)?[A-Za-z]\w*")
_OPTION = regex(r"-(?:[A-Za-z-]|1\Z)")
#: What a data file is asked for: its content as data, None if there is none.
File = Callable[[str], object | None]

_OF_BAG = "the recording decides"
_OF_PUBLISHER = "whoever publishes decides"
_OF_SERVER = "the service decides"
_OF_LINE = "the command line tells it, and is not known"
_CHOSEN = "its options tell which topics it records, and these depend on the running system"


@dataclass(slots=True)
class Line:
    """A command line in its parts: *words* without options, *options* with the words that follow each."""

    words: list[str] = field(default_factory=list)
    options: dict[str, list[str]] = field(default_factory=dict)

    def has(self, *names: str) -> bool:
        return any(name in self.options for name in names)


def parsed(words: Sequence[str], valued: str, listed: str = "") -> Line:
    """*words* in their parts; the options *valued* take a word, the options *listed* all up to the next option.

    A flag of one letter may have its value behind it, as in ``-r10``. Behind ``--`` nothing is an option.
    """
    takes, collects = valued.split(), listed.split()
    line = Line()
    at, is_over = 0, False
    while at < len(words):
        word = words[at]
        at += 1
        if is_over or not _OPTION.match(word):
            line.words.append(word)
            continue
        if word == "--":
            is_over = True
            continue
        name, equals, value = word.partition("=")
        if not name.startswith("--") and len(name) > 2 and name[:2] in takes:
            name, equals, value = name[:2], "=", word[2:]
        found = line.options.setdefault(name, [])
        if equals:
            found.append(value)
        elif name in takes:
            found += words[at : at + 1]
            at += 1
        elif name in collects:
            while at < len(words) and not _OPTION.match(words[at]):
                found.append(words[at])
                at += 1
    return line


def specialised(known: KnownNode, words: Sequence[str], ros: int, file: File | None = None) -> KnownNode:
    """*known*, a node type as the data files have it, with the topics of its command line *words*."""
    made = _TOOLS.get((ros, known.package, known.type))
    if made is None:
        return known
    kept = [end for end in known.endpoints if not _is_open(end)]
    return replace(known, endpoints=(*kept, *made(list(words), file)))


def _is_open(end: KnownEndpoint) -> bool:
    """Whether it is an entry that stands for what the command line decides."""
    return end.each is None and len(end.name) == 1 and isinstance(end.name[0], Hole) and end.name[0].kind != "option"


# --- ROS 1


def _rosbag_record(words: Sequence[str], file: File | None) -> Iterator[KnownEndpoint]:
    line = parsed(
        words,
        "-x --exclude -b --buffsize --chunksize -l --limit -o --output-prefix -O --output-name --max-splits --size --duration --node -e",
    )
    if line.has("-a", "--all", "-e", "--regex", "--node"):
        yield _unknown("subscribers", _CHOSEN)
    for name in line.words if not line.has("-e", "--regex") else ():
        yield _end("subscribers", name, _OF_PUBLISHER)


def _rosbag_play(words: Sequence[str], file: File | None) -> Iterator[KnownEndpoint]:
    line = parsed(
        words,
        "-p --prefix -r --rate -s --start -u --duration --skip-empty --queue --hz -d --delay --rate-control-topic "
        "--rate-control-max-delay",
        "--topics --pause-topics --bags",
    )
    topics = line.options.get("--topics", [])
    if not topics or line.has("-p", "--prefix"):
        yield _unknown("publishers", "the topics of the bag")
        return
    for name in topics:
        yield _end("publishers", name, _OF_BAG)


def _rosbag(words: Sequence[str], file: File | None) -> Iterator[KnownEndpoint]:
    """The program ``rosbag``, which starts one of those two."""
    if words[:1] == ["record"]:
        yield from _rosbag_record(words[1:], file)
    elif words[:1] == ["play"]:
        yield _end("publishers", "/clock", "rosgraph_msgs/Clock", queue=1, latched=False)
        yield from _rosbag_play(words[1:], file)
    elif not words or UNKNOWN in words[0]:
        yield from _anything()


def _rostopic(words: Sequence[str], file: File | None) -> Iterator[KnownEndpoint]:
    if not words or UNKNOWN in words[0]:
        yield from _anything()
        return
    command, *rest = words
    if command == "pub":
        yield _rostopic_pub(rest)
    elif command in ("echo", "hz", "bw", "delay"):
        yield from _rostopic_read(command, rest)


def _rostopic_pub(words: Sequence[str]) -> KnownEndpoint:
    line = parsed(words, "-r --rate -f --file")
    is_latched: bool | None = True if line.has("-l", "--latch") else None
    if line.has("-r", "--rate") and is_latched is None:
        is_latched = False
    elif len(line.words) > 2 and not line.has("-f", "--file"):
        is_latched = True  # without a rate it is
    return _of_line("publishers", line, _OF_LINE, queue=100, latched=is_latched)


def _rostopic_read(command: str, words: Sequence[str]) -> Iterator[KnownEndpoint]:
    line = parsed(words, "-b --bag -n -w --window --filter --offset")
    for name in line.words[: 1 if command == "echo" else MOST] or [UNKNOWN]:
        if command == "echo" and not line.has("-b", "--bag"):
            yield _end("subscribers", name, "the topic decides", is_field=True)
        elif command != "echo":
            yield _end("subscribers", name, "the topic decides")


def _rosservice(words: Sequence[str], file: File | None) -> Iterator[KnownEndpoint]:
    if not words or UNKNOWN in words[0]:
        yield _end("clients", UNKNOWN, _OF_SERVER)
    elif words[0] == "call":
        yield _end("clients", (*parsed(words[1:], "--wait-timeout").words, UNKNOWN)[0], _OF_SERVER)


# --- ROS 2


_PLAY_VALUES = (
    "-s --storage --read-ahead-queue-size -r --rate --qos-profile-overrides-path --storage-config-file --start-offset -d --delay "
    "--playback-duration --playback-until-sec --playback-until-nsec --wait-for-all-acked -e --regex --log-level -p --progress-bar "
    "--publish-service-requests-timeout --message-order --exclude-regex"
)
_PLAY_LISTS = "--topics --remap -m --clock --exclude-topics --services --exclude-services --actions --exclude-actions -i --input -x --exclude"


def _bag_play(words: Sequence[str], file: File | None) -> Iterator[KnownEndpoint]:
    line = parsed(words, _PLAY_VALUES, _PLAY_LISTS)
    if line.has("--clock", "--clock-topics", "--clock-topics-all"):
        yield _end("publishers", "/clock", "rosgraph_msgs/msg/Clock")
    topics = _played(line, file)
    if isinstance(topics, str):
        yield _unknown("publishers", topics)
        return
    left_out = {f"/{name.lstrip('/')}" for name in line.options.get("--exclude-topics", [])}
    remapped = _remapped(line)
    if any(UNKNOWN in old for old in remapped):
        yield _unknown("publishers", "a remapping of its command line is not known")
        return
    for name, kind in topics.items():
        full = f"/{name.lstrip('/')}" if UNKNOWN not in name else name
        if full not in left_out:
            yield _end("publishers", remapped.get(full, full), kind or _OF_BAG)


def _played(line: Line, file: File | None) -> dict[str, str] | str:
    """The topics that are played, with their types ("": not known), or why they are not known."""
    topics = _recorded(line, file)
    requested = dict.fromkeys(line.options.get("--topics", []))
    if topics is None:
        return dict.fromkeys(requested, "") if requested else "what the recording has decides"
    if requested:
        return {
            name: kind
            for name, kind in topics.items()
            if name in requested or f"/{name}" in requested or name.lstrip("/") in requested
        }
    if line.has("-e", "--regex", "--exclude-regex", "-x", "--exclude"):
        return "its options choose among the topics of the recording"
    return topics


def _remapped(line: Line) -> dict[str, str]:
    """The new names of topics that are remapped, by their full names."""
    pairs = (word.partition(":=") for name in ("-m", "--remap") for word in line.options.get(name, ()))
    return {f"/{old.lstrip('/')}": new for old, assigned, new in pairs if assigned}


def _metadata_file(line: Line) -> str | None:
    """The file with the metadata of the one recording that is played; None: which one it is, is not known."""
    bags = [*line.words, *(word for name in ("-i", "--input") for word in line.options.get(name, ())[:1])]
    if len(bags) != 1 or UNKNOWN in bags[0]:
        return None
    bag = bags[0].rstrip("/")
    if bag.endswith((".db3", ".mcap", ".zstd")):
        bag = bag.rpartition("/")[0]
    return f"{bag}/metadata.yaml"


def _recorded(line: Line, file: File | None) -> dict[str, str] | None:
    """The topics of the one recording that is played, with their types, where its metadata is in the workspace."""
    path = _metadata_file(line)
    if path is None or file is None:
        return None
    found = file(path)
    about = found.get("rosbag2_bagfile_information") if isinstance(found, Mapping) else None
    listed = about.get("topics_with_message_count") if isinstance(about, Mapping) else None
    if not isinstance(listed, (list, tuple)) or len(listed) > MOST:
        return None
    topics: dict[str, str] = {}
    for item in listed:
        topic = item.get("topic_metadata") if isinstance(item, Mapping) else None
        name, kind = (topic.get("name"), topic.get("type")) if isinstance(topic, Mapping) else (None, None)
        if not isinstance(name, str) or not isinstance(kind, str):
            return None
        if (
            _TYPE.fullmatch(kind) and "/srv/" not in kind and "/action/" not in kind
        ):  # services and actions have topics of their own, which are no topics to be played
            topics[name] = kind
    return topics


_RECORD_VALUES = (
    "-o --output -s --storage -f --serialization-format -b --max-bag-size -d --max-bag-duration --max-cache-size --compression-mode "
    "--compression-format --compression-queue-size --compression-threads --compression-threads-priority --qos-profile-overrides-path "
    "--storage-preset-profile --storage-config-file -p --polling-interval --node-name --log-level -e --regex --exclude-regex -x --exclude"
)
_RECORD_LISTS = "--topics --services --actions --topic-types --exclude-topics --exclude-topic-types --exclude-services --exclude-actions --custom-data"


def _bag_record(words: Sequence[str], file: File | None) -> Iterator[KnownEndpoint]:
    line = parsed(words, _RECORD_VALUES, _RECORD_LISTS)
    if line.has("-a", "--all", "--all-topics", "-e", "--regex", "--topic-types"):
        yield _unknown("subscribers", _CHOSEN)
    for name in dict.fromkeys((*line.words, *line.options.get("--topics", []))):
        yield _end("subscribers", name, _OF_PUBLISHER)


_TOPIC_VALUES = (
    "-r --rate -p --print -t --times -w --wait-matching-subscriptions --keep-alive -n --node-name --qos-profile --qos-depth --qos-history "
    "--qos-reliability --qos-durability --qos-liveliness --qos-liveliness-lease-duration-seconds --spin-time --max-wait-time-secs "
    "--field --timeout --filter --window --truncate-length -f"
)


def _topic_pub(words: Sequence[str], file: File | None) -> Iterator[KnownEndpoint]:
    yield _of_line("publishers", parsed(words, _TOPIC_VALUES), _OF_LINE)


def _topic_echo(words: Sequence[str], file: File | None) -> Iterator[KnownEndpoint]:
    yield _of_line("subscribers", parsed(words, _TOPIC_VALUES), _OF_PUBLISHER)


def _service_call(words: Sequence[str], file: File | None) -> Iterator[KnownEndpoint]:
    yield _of_line("clients", parsed(words, _TOPIC_VALUES), _OF_LINE)


def _send_goal(words: Sequence[str], file: File | None) -> Iterator[KnownEndpoint]:
    yield _of_line("action_clients", parsed(words, "-t --timeout"), _OF_LINE)


_TOOLS: Mapping[tuple[int, str, str], Callable[[Sequence[str], File | None], Iterator[KnownEndpoint]]] = {
    (1, "rosbag", "record"): _rosbag_record,
    (1, "rosbag", "play"): _rosbag_play,
    (1, "rosbag", "rosbag"): _rosbag,
    (1, "rostopic", "rostopic"): _rostopic,
    (1, "rosservice", "rosservice"): _rosservice,
    (2, "ros2bag", "play"): _bag_play,
    (2, "ros2bag", "record"): _bag_record,
    (2, "ros2topic", "pub"): _topic_pub,
    (2, "ros2topic", "echo"): _topic_echo,
    (2, "ros2topic", "hz"): _topic_echo,
    (2, "ros2topic", "bw"): _topic_echo,
    (2, "ros2topic", "delay"): _topic_echo,
    (2, "ros2service", "call"): _service_call,
    (2, "ros2action", "send_goal"): _send_goal,
}


def _of_line(
    kind: str, line: Line, untyped: str, queue: int | None = None, latched: bool | None = None
) -> KnownEndpoint:
    """An endpoint on the topic that is the first word, of the type that is the second; *untyped* says why there is none."""
    name, type_ = (*line.words[:2], UNKNOWN, UNKNOWN)[:2]
    return _end(kind, name, type_ if _TYPE.fullmatch(type_) else untyped, queue, latched)


def _end(
    kind: str, name: str, type_: str, queue: int | None = None, latched: bool | None = None, is_field: bool = False
) -> KnownEndpoint:
    """An endpoint; *type_* is a type, or why it is not known. With *is_field* the name may go on into the message."""
    part: str | Hole = name
    if not _TOPIC.fullmatch(name) or is_field and name.count("/") > 1:
        part = Hole("unknown", _OF_LINE if UNKNOWN in name else "it is no name of a topic")
    is_type = _TYPE.fullmatch(type_) is not None
    return KnownEndpoint(
        kind=kind,
        name=(part,),
        type=type_ if is_type else None,
        type_reason="" if is_type else type_,
        queue_size=queue,
        latched=latched,
    )


def _unknown(kind: str, why: str) -> KnownEndpoint:
    return KnownEndpoint(kind=kind, name=(Hole("unknown", why),), type=None, type_reason=why)


def _anything() -> Iterator[KnownEndpoint]:
    """What a program may have of which it is not known what it does."""
    for kind in ("publishers", "subscribers"):
        yield _unknown(kind, "what it does is not known")
