# SPDX-License-Identifier: Apache-2.0
"""Write the file of common definitions: ``python -m haros_ci.interfaces.collect OUT DISTRIBUTION_DIRECTORY...``.

Each directory holds the checkouts of one distribution; their .msg, .srv and .action files are taken, not those of tests. For
``common_ros2.txt`` they are common_interfaces, rcl_interfaces, unique_identifier_msgs, example_interfaces and geometry2 of each
distribution, for ``common_ros1.txt`` std_msgs, common_msgs, ros_comm_msgs and geometry2.
"""

from __future__ import annotations

import sys
from pathlib import Path

from haros_ci.interfaces.common import line_of
from haros_ci.workspace.interfaces import read_interface

KINDS = ("msg", "srv", "action")
HEAD = "# Field names, types and constants of {} (see haros_ci/interfaces/collect.py), {} definitions.\n"


def collect(roots: list[Path]) -> list[str]:
    """One line for each definition, several for a name whose definition was not always the same."""
    lines: set[str] = set()
    for root in roots:
        for path in sorted(root.rglob("*.*")):
            kind = path.suffix[1:]
            if kind not in KINDS or path.parent.name != kind or "test" in path.parts:
                continue
            package = path.parent.parent.name
            read, problems = read_interface(path.name, path.read_text(encoding="utf-8"), package)
            if not problems:
                lines.add(line_of(read))
    return sorted(lines)


def main(arguments: list[str]) -> None:
    """Collect from the directories in *arguments* into the file that is first."""
    out, *roots = map(Path, arguments)
    lines = collect(roots)
    packages = sorted({line.partition("/")[0] for line in lines})
    out.write_text(HEAD.format(", ".join(packages), len(lines)) + "".join(f"{line}\n" for line in lines), "utf-8")


if __name__ == "__main__":
    main(sys.argv[1:])
