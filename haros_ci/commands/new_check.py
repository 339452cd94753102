# SPDX-License-Identifier: Apache-2.0
"""``haros-ci new-check``: the two files of a new check, which its tests refuse until they are written."""

from __future__ import annotations

import os
from pathlib import Path

from haros_ci.errors import UserError
from haros_ci.regex import regex
from haros_ci.writing import cannot, create

_NAME = regex(r"[a-z][a-z0-9]*(-[a-z0-9]+)+")

MODULE = '''# SPDX-License-Identifier: Apache-2.0
"""What it finds, in one line."""

from __future__ import annotations

from collections.abc import Iterator

from haros_ci.api import Check, Finding, Level, Status, System


def check(system: System) -> Iterator[Finding]:
    for topic in system.topics:
        for publisher, subscriber in topic.pairs():
            if topic.name == "/wrong":  # here goes what is wrong with the two
                yield Finding(
                    at=subscriber.location,
                    message=f"{{subscriber.node}} and {{publisher.node}} on {{topic}}: what happens, and what to do",
                    about=(topic, publisher, subscriber),
                    related=((publisher.location, f"{{publisher.node}} publishes here"),),
                )


CHECK = Check(
    id="{id}",
    summary="What is wrong where the rule fires.",
    level=Level.WARNING,
    status=Status.PREVIEW,
    run=check,
)
'''

PAGE = """# {id}

## What it finds

## Why it matters

## Bad

```python title="talker.py"
import rclpy
from rclpy.node import Node
from std_msgs.msg import String

rclpy.init()
node = Node("talker")
pub = node.create_publisher(String, "chatter", 10)  # expect: {id}
```

## Good

### What looks alike and is right

```python title="talker.py"
import rclpy
from rclpy.node import Node
from std_msgs.msg import String

rclpy.init()
node = Node("talker")
pub = node.create_publisher(String, "chatter", 10)
```

## Limits
"""


def new_check(name: str, directory: Path) -> tuple[Path, Path]:
    """Write module and page of the check *name* below *directory*/checks; UserError if that is not possible.

    The two fail ``tests/test_checks.py`` until the check finds what the page says (docs/adding-a-check.md).
    """
    if not _NAME.fullmatch(name):
        raise UserError(
            f"{name} is no name of a check", help="words in lower case joined by hyphens: topic-type-mismatch"
        )
    folder = directory / "checks"
    if not (folder / "__init__.py").is_file():
        raise UserError(f"no checks in {directory}", help="run this at the top of a clone of haros-ci")
    module, page = (folder / f"{name.replace('-', '_')}{ending}" for ending in (".py", ".md"))
    for path in (module, page):
        if os.path.lexists(path):
            raise UserError(f"{path.name} is there already", help="choose another name")
    for path, text in ((module, MODULE), (page, PAGE)):
        try:
            create(directory, f"checks/{path.name}", text.format(id=name))
        except OSError as err:
            raise cannot(path, err, "check the permissions of the directory") from err
    return module, page
