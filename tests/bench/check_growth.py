# SPDX-License-Identifier: Apache-2.0
"""How the processor time of each check grows with the packages of a workspace: twice as many should take twice as long.

    python tests/bench/check_growth.py [--copies 2 4 8] [--shown 25]

Makes workspaces of the first bad example of every rule, copied so often, each package under a name of its own, and runs ``haros-ci check`` with
the profile ``architecture`` on each. Prints the seconds of the dearest stages and checks, and by how much the last step is more than in proportion.
"""

from __future__ import annotations

import argparse
import re
import subprocess
import sys
import tempfile
from pathlib import Path

from haros_ci.checking.page import Example, read_page
from haros_ci.registry import checks, page_of

NAME = re.compile(r"<name>\s*([\w-]+)\s*</name>")
LINE = re.compile(r" *[\d.]+ +([\d.]+)  ( *)(.+)")
#: The command, with all checks in its table of times.
RUN = "import haros_ci.timing as t; t.IN_FULL |= {'checks'}; from haros_ci.cli import main; main()"


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--copies", type=int, nargs="+", default=[2, 4, 8], help="of each example (2 4 8)")
    parser.add_argument("--shown", type=int, default=25, help="rows that are printed (25)")
    options = parser.parse_args()
    examples = [
        (check.id, example)
        for check in checks()
        for example in read_page(page_of(check)).examples
        if example.is_bad and example.base is None
    ]
    first = dict(reversed(examples))
    columns = []
    for copies in options.copies:
        with tempfile.TemporaryDirectory() as place:
            count = sum(
                write(Path(place), f"{id}_{n}", example) for id, example in first.items() for n in range(copies)
            )
            columns.append(seconds(Path(place)))
        print(f"{copies} copies: {count} packages, {columns[-1]['all']:.1f} s of the processor")
    *_, before, last = columns
    step = options.copies[-1] / options.copies[-2]
    for name in sorted(last, key=last.__getitem__, reverse=True)[: options.shown]:
        growth = last[name] / max(before.get(name, 0.0), 0.02) / step
        print(
            f"{'  '.join(f'{column.get(name, 0.0):8.2f}' for column in columns)}  {growth:5.2f} x in proportion  {name}"
        )


def write(place: Path, tag: str, example: Example) -> int:
    """Write *example* below *place*, with *tag* behind the names of its packages; how many these are."""
    tag = tag.replace("-", "_")
    manifests = [text for path, text in example.files.items() if path.endswith("package.xml")]
    names = sorted({name for text in manifests for name in NAME.findall(text)[:1]}, key=len, reverse=True)
    whole = re.compile(rf"\b({'|'.join(map(re.escape, names))})\b" if names else r"(?!)")
    for path, text in example.files.items():
        file = place / tag / whole.sub(rf"\1_{tag}", path)
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_text(whole.sub(rf"\1_{tag}", text))
        if path in example.executables:
            file.chmod(0o755)
    return len(names)


def seconds(root: Path) -> dict[str, float]:
    """The processor seconds of each stage and check, and of ``all``."""
    command = [
        sys.executable,
        "-c",
        RUN,
        "check",
        ".",
        "--isolated",
        "--no-cache",
        "--jobs=1",
        "--profile=architecture",
    ]
    done = subprocess.run(
        [*command, "--fail-on=never", "--timings", "--output=json=/dev/null"], cwd=root, capture_output=True, text=True
    )
    if done.returncode:
        sys.exit(done.stderr)
    rows = [match for line in done.stderr.splitlines() if (match := LINE.fullmatch(line))]
    found = {f"{match[2]}{match[3]}": float(match[1]) for match in rows}
    return {("all" if name.startswith("done") else name): spent for name, spent in found.items()}


if __name__ == "__main__":
    main()
