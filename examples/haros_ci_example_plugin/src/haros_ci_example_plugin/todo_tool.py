# SPDX-License-Identifier: Apache-2.0
"""A small linter: TODO comments without an owner, as JSON rows of path, line, column and text."""

import json
import re
import sys

TODO = re.compile(r"(?:#|//)\s*(TODO)\b(?!\(\w+\))[:\s]*(.{0,60})")

found = []
for path in sys.argv[1:]:
    with open(path, encoding="utf-8", errors="replace") as stream:
        for number, line in enumerate(stream, 1):
            match = TODO.search(line)
            if match is not None:
                found.append([path, number, match.start(1) + 1, match[2].strip()])
json.dump(found, sys.stdout)
