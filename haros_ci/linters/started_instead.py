# SPDX-License-Identifier: Apache-2.0
"""Commands of launch files that start something else than the model has: a prefix in place of the node (``launch-prefix="echo"``), a shell's own words."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Iterator
from html import unescape

from haros_ci.linters.changed_code import Found, brought, notes
from haros_ci.model.package import SourceFile
from haros_ci.model.workspace import Workspace
from haros_ci.regex import regex
from haros_ci.results.code_alone import without_comments
from haros_ci.results.result import Notification

#: Prefixes that are named; the rest is counted. And characters of what is quoted.
MOST = 10
_QUOTED = 80
#: Programs that start the one that follows them: debuggers, terminals, priorities, measurements, other users and displays.
_STARTERS = regex(
    r"(?:gdb|cgdb|ddd|lldb|rr|valgrind|heaptrack|strace|ltrace|perf|operf|uftrace|time|catchsegv|xterm|uxterm|lxterminal|gnome-terminal|xfce4-terminal|mate-terminal|konsole"
    r"|terminator|tilix|kitty|alacritty|urxvt|rxvt|x-terminal-emulator|screen|tmux|nice|ionice|renice|taskset|chrt|numactl|schedtool|sudo|doas|gosu|su|setpriv|env|stdbuf|unbuffer"
    r"|nohup|setsid|timeout|python[\d.]*|ipython[\d]?|pypy[\d]?|kernprof|optirun|primusrun|prime-run|vglrun|nvprof|nsys|ncu|cuda-gdb|compute-sanitizer|xvfb-run|ssh|docker|rosrun|ros2"
    r"|wine|mpirun|mpiexec|cpulimit|firejail|coverage|kcov|scalene|py-spy|viztracer|mprof|ddr|rosbag|ros_prefix|systemd-run|proxychains\d?|qemu-[\w-]+)"
)
_SHELL = regex(r"(?:ba|da|z|k)?sh")
#: What a shell starts of what it is given.
_GIVEN = regex(r"\$(?:\{?[0@*]|\(|\{)")
_SETS = regex(r"\w+=\S*")
_COMMENT = regex(r"<!--(?:[^-]|-(?!->))*(?:-->|\Z)")
_IN_XML = regex(
    r"<\s*(?:node|executable|node_container|lifecycle_node|test)\s[^<>]*?(?<![\w-])(?:launch-)?prefix\s*=\s*(?:\"([^\"<>]*)\"|'([^'<>]*)')"
)
_IN_YAML = regex(
    r"^[ \t-]*[\"']?launch-prefix[\"']?[ \t]*:[ \t]*(?:\"([^\"\n]*)\"|'([^'\n]*)'|([^\"'#\s][^#\n]*))", re.M
)
_IN_PYTHON = regex(r"(?<![\w.])prefix\s*=\s*(?:\[\s*)?(?:\"([^\"\n]*)\"|'([^'\n]*)')")
#: A shell's variable, function or alias that stands for what starts programs.
_STANDS = regex(
    r"(?<![\w$-])(?:\w+=\\?[\"']?(?:[\w./]*/)?(?:ros2|rosrun|roslaunch)\b|(?:\w+[ \t]*\([ \t]*\)|function[ \t]+\w+)[ \t]*\{[^{}\n]{0,200}\b(?:ros2|rosrun|roslaunch)\b"
    r"|alias[ \t]+\w+=[^\n]{0,20}?\b(?:ros2|rosrun|roslaunch)\b)"
)
_SHELL_TEXT = regex(r"\b(?:ba|da|z|k)?sh\b[^\n]{0,40}-\w?c\b")
_OF_LAUNCH = regex(r"\blaunch(?:_ros)?\.actions\b|\blaunch_ros\b")


def notifications(head: Workspace, base: Workspace | None) -> tuple[Notification, ...]:
    """A note for each such prefix of *head* that no file of *base* which changed or is gone has; none without a base."""
    if base is None:
        return ()
    rest = "commands of launch files may start something else than the model has, since this change"
    return notes(brought(head, base, _look), MOST, rest)


def _look(workspace: Workspace) -> Callable[[SourceFile], Iterable[Found]]:
    def look(file: SourceFile) -> Iterator[Found]:
        is_read = file.language in ("launch", "python", "xml", "yaml")
        for line, words in odd_prefixes(workspace.text(file.path), file.language) if is_read else ():
            yield line, words, f"since this change {words}; look at it"

    return look


def odd_prefixes(text: str, language: str) -> Iterator[tuple[int, str]]:
    """The lines of such prefixes in a file of that *language*, and what they do, in words; takes linear time."""
    if not any(word in text for word in ("prefix", "ros2", "rosrun", "roslaunch")):
        return
    if language == "python":
        if _OF_LAUNCH.search(text) is None:
            return
        pattern, code = _IN_PYTHON, without_comments(text, "python")
    elif text.lstrip("\ufeff \t\r\n").startswith("<"):
        pattern, code = _IN_XML, _COMMENT.sub(lambda match: "\n" * match[0].count("\n"), text)
    else:
        pattern, code = _IN_YAML, text
    for match in pattern.finditer(code):
        prefix = unescape(next(group for group in match.groups() if group is not None)).strip()
        if _is_odd(prefix):
            line = code.count("\n", 0, match.start(match.lastindex or 0)) + 1
            yield (
                line,
                f"the prefix '{_quoted(prefix)}' may start something else than the node, which the model has all the same",
            )
    plain = unescape(code)
    if _SHELL_TEXT.search(plain) is not None:
        for match in _STANDS.finditer(plain):
            line = plain.count("\n", 0, match.start()) + 1
            yield (
                line,
                f"'{_quoted(match[0])}' of a shell stands for what starts programs: the model does not have them",
            )


def _quoted(text: str) -> str:
    plain = " ".join(text.split())
    return plain if len(plain) <= _QUOTED else f"{plain[:_QUOTED]}…"


def _is_odd(prefix: str) -> bool:
    words = [word.strip("\"'") for word in prefix.split()]
    while words and _SETS.fullmatch(words[0]):
        del words[0]
    if not words or words[0].startswith("$"):
        return False
    program = words[0].rpartition("/")[2]
    if _SHELL.fullmatch(program):
        return "-c" in words and _GIVEN.search(prefix) is None
    return "/" not in words[0] and _STARTERS.fullmatch(program) is None
