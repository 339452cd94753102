# SPDX-License-Identifier: Apache-2.0
"""Python: what ``finally`` returns counts, whatever the block before it returns or raises."""

from __future__ import annotations

import pytest
from follow_kit import follow, names, node, python_files, script

RETURNS = {
    "try:\n        return 'a'\n    finally:\n        return 'b'": ["/b"],
    "try:\n        pass\n    finally:\n        return 'b'": ["/b"],
    "try:\n        raise ValueError\n    except ValueError:\n        return 'a'\n    finally:\n        return 'b'": [
        "/b"
    ],
    "try:\n        if given():\n            return 'a'\n    finally:\n        return 'b'": ["/b"],
    "try:\n        try:\n            return 'a'\n        finally:\n            return 'c'\n    finally:\n        return 'b'": [
        "/b"
    ],
    "try:\n        inner = lambda: 'c'\n        return 'a'\n    finally:\n        return inner()": ["/c"],
    "try:\n        def inner():\n            return 'c'\n        return 'a'\n    finally:\n        return inner()": [
        "/?"
    ],
    # as it was
    "try:\n        return 'a'\n    finally:\n        print('b')": ["/a"],
    "try:\n        return 'a'\n    except ValueError:\n        return 'b'": ["/?"],
    "try:\n        return 'a'\n    finally:\n        def inner():\n            return 'b'": ["/a"],
    "return 'a'": ["/a"],
}


@pytest.mark.parametrize(("body", "made"), RETURNS.items())
def test_what_is_returned(body: str, made: list[str]) -> None:
    code = f"def name():\n    {body}\n\nmade = name()\nPUB(made)\n"
    assert names(node(follow(python_files(script(code))))) == made
