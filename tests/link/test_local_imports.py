# SPDX-License-Identifier: Apache-2.0
"""Python: imports inside of functions, in blocks that have no scopes of their own."""

from __future__ import annotations

import pytest
from follow_kit import ends, python

CODE = "def f():\n    %s\n    rospy.Publisher('a', %s, queue_size=1)\nf()\n"
BLOCKS = {
    "plain": "from geometry_msgs.msg import Twist",
    "try": "try:\n        from geometry_msgs.msg import Twist\n    except ImportError:\n        return",
    "try with a note": "try:\n        from geometry_msgs.msg import Twist\n    except ImportError as err:\n        print(err)\n        raise",
    "if": "if True:\n        from geometry_msgs.msg import Twist",
    "with": "with lock:\n        from geometry_msgs.msg import Twist",
    "try or none": "try:\n        from geometry_msgs.msg import Twist\n    except ImportError:\n        Twist = None",
    "none, then try": "Twist = None\n    try:\n        from geometry_msgs.msg import Twist\n    except ImportError:\n        pass",
    "once more": "from std_msgs.msg import String as Twist\n    from geometry_msgs.msg import Twist",
}


@pytest.mark.parametrize("name", BLOCKS)
def test_a_type_that_a_block_imports(name: str) -> None:
    (end,) = ends(python(CODE % (BLOCKS[name], "Twist")))
    assert (end.name, end.type) == ("/a", "geometry_msgs/Twist")


@pytest.mark.parametrize(
    "block",
    [
        "try:\n        from geometry_msgs.msg import Twist\n    except ImportError:\n        from other.msg import Twist",
        "try:\n        from geometry_msgs.msg import Twist\n    except ImportError:\n        Twist = String",
    ],
)
def test_one_of_several_is_not_known(block: str) -> None:
    (end,) = ends(python(CODE % (block, "Twist")))
    assert end.type is None and [u.field for u in end.unknowns] == ["type"]


def test_a_name_of_another_function() -> None:
    other = (
        "def g():\n    try:\n        from geometry_msgs.msg import Twist\n    except ImportError:\n        pass\ng()\n"
    )
    (end,) = ends(python(other + CODE % ("pass", "String")))
    assert end.type == "std_msgs/String"
