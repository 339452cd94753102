# SPDX-License-Identifier: Apache-2.0
"""Names of Python that have no value where they are used, though their scope binds them somewhere."""

from __future__ import annotations

import pytest

from haros_ci.linters.never_bound import never_bound

USE = "\n\ndef use():\n    return json.dumps({})\n"
FIRES = {
    "false": "if False:\n    import json" + USE,
    "zero": "if 0:\n    import json" + USE,
    "none": "if None:\n    import json" + USE,
    "not_true": "if not True:\n    import json" + USE,
    "else_of_true": "if True:\n    pass\nelse:\n    import json" + USE,
    "empty": "if []:\n    import json" + USE,
    "compared": "if 1 == 2:\n    import json" + USE,
    "calculated": "if 1 - 1:\n    import json" + USE,
    "a_chain": "if 1 < 3 < 2:\n    import json" + USE,
    "length": "if len(''):\n    import json" + USE,
    "member": "if 'a' in ('b', 'c'):\n    import json" + USE,
    "identity": "if None is not None:\n    import json" + USE,
    "method": "if 'a'.startswith('b'):\n    import json" + USE,
    "any": "if any([0, '']):\n    import json" + USE,
    "formatted": "if f'':\n    import json" + USE,
    "either_way": "if 0 if True else print():\n    import json" + USE,
    "else_of_lambda": "if lambda: 0:\n    pass\nelse:\n    import json" + USE,
    "named": "if (x := 0):\n    import json" + USE,
    "calculated_constant": "A = 2\nB = A - 2\nif B:\n    import json" + USE,
    "two_names": "A = B = False\nif A or B:\n    import json" + USE,
    "equal_to_false": "A = True\nif A == False:\n    import json" + USE,
    "constant_of_a_function": "def use():\n    off = False\n    if off:\n        json = 1\n    return json\n",
    "of_a_type": "if isinstance(1, (str, bytes)):\n    import json" + USE,
    "nothing_in_it": "if {}.get('a'):\n    import json" + USE,
    "range": "for _ in range(3, 3):\n    import json" + USE,
    "range_back": "for _ in range(-1):\n    import json" + USE,
    "deleted_in_brackets": "import json\nother = 1\ndel (other, json)" + USE,
    "later": "x = json.loads('1') if 1 else None\nimport json\n",
    "later_in_a_class": "class A:\n    x = json()\n\n\ndef json():\n    return 1\n",
    "later_decorated": "@json\ndef f():\n    pass\n\n\ndef json(f):\n    return f\n",
    "later_local": "def use():\n    x = json\n    json = x\n    return json\n",
    "loop": "while False:\n    import json" + USE,
    "no_turn": "for _ in ():\n    import json" + USE,
    "constant": "DEBUG = False\nif DEBUG:\n    import json" + USE,
    "and": "DEBUG = False\nif DEBUG and print():\n    import json" + USE,
    "types": "from typing import TYPE_CHECKING\nif TYPE_CHECKING:\n    import json" + USE,
    "types_of_module": "import typing\nif typing.TYPE_CHECKING:\n    import json" + USE,
    "annotation": "from typing import TYPE_CHECKING\nif TYPE_CHECKING:\n    import json\ndef use(x: json.JSONDecoder):\n    return x\n",
    "old": "import sys\nif sys.version_info < (3,):\n    import json" + USE,
    "major": "import sys\nif sys.version_info[0] == 2:\n    import json" + USE,
    "name": "if __name__ == 'nobody':\n    import json" + USE,
    "harmless": "try:\n    pass\nexcept ImportError:\n    import json" + USE,
    "function": "if 0:\n    def json():\n        pass" + USE,
    "walrus": "False and (json := 3)" + USE,
    "global": "def late():\n    global json\n    import json" + USE,
    "deleted": "import json\ndel json" + USE,
    "deleted_here": "def use():\n    json = 1\n    del json\n    return json\n",
    "deleted_around": "def use():\n    import json\n    del json\n    def inner():\n        return json\n    return inner\n",
    "case": "match 1:\n    case 2:\n        import json" + USE,
    "case_of_several": "A = 'a'\nmatch A:\n    case 'b' | 'c' | None:\n        import json" + USE,
    "case_behind_one_that_fits": "match 1:\n    case 1:\n        pass\n    case _:\n        import json" + USE,
    "case_of_a_list": "match 1:\n    case [json]:\n        pass" + USE,
    "case_with_a_guard": "match input():\n    case 'a' if False:\n        import json" + USE,
    "called_before": "def use():\n    def inner():\n        return json.loads('1')\n    x = inner()\n    import json\n    return x, json\n",
    "called_before_in_a_module": "def use():\n    x = json.loads('1')\n    return x\n\n\nuse()\nimport json\n",
    "called_before_in_a_condition": "def use():\n    def inner():\n        json()\n    if print():\n        inner()\n    json = 1\n    return json\n",
    "local": "def use():\n    if False:\n        json = 1\n    return json\n",
    "declared": "def use():\n    json: int\n    return json\n",
    "handled": "def use(a):\n    try:\n        a()\n    except ValueError as json:\n        pass\n    return json\n",
    "behind_return": "def use():\n    if a:\n        return json\n    return 1\n    json = 2\n",
    "behind_both": "def use(a):\n    while a:\n        print(json)\n    if a:\n        return 1\n    else:\n        return 2\n    json = 2\n",
}
QUIET = {
    "case": "match input():\n    case 'a':\n        import json" + USE,
    "case_that_fits": "match 1:\n    case 1:\n        import json" + USE,
    "case_behind_a_guard": "match 1:\n    case 1 if input():\n        pass\n    case _:\n        import json" + USE,
    "case_of_a_class": "match 1:\n    case int(json):\n        pass" + USE,
    "case_of_a_name": "match 1:\n    case json:\n        pass" + USE,
    "case_of_a_known_name": "import a\nmatch 1:\n    case a.B:\n        import json" + USE,
    "case_of_a_list": "match [1]:\n    case [1]:\n        import json" + USE,
    "given_before": "def use(t):\n    def inner():\n        return json\n    t(inner)\n    import json\n",
    "called_behind": "def use():\n    def inner():\n        return json\n    import json\n    return inner()\n",
    "called_in_turns": "def use():\n    def inner():\n        return json\n    for i in range(2):\n        if i:\n            inner()\n        json = 1\n    return json\n",
    "left_before": "def use():\n    def inner():\n        if print():\n            return 1\n        return json\n    inner()\n    import json\n",
    "used_in_part": "def use():\n    def inner():\n        return print() and json\n    inner()\n    import json\n",
    "generator": "def use():\n    def inner():\n        yield json\n    x = inner()\n    import json\n    return list(x)\n",
    "coroutine": "def use():\n    async def inner():\n        return json\n    x = inner()\n    import json\n    return x\n",
    "decorated": "def use(t):\n    @t\n    def inner():\n        return json\n    inner()\n    import json\n",
    "two_functions": "def use(t):\n    def inner():\n        return json\n    inner = t\n    inner()\n    import json\n",
    "awaited_around_a_call": "def use():\n    def inner():\n        return json\n    try:\n        inner()\n    except NameError:\n        pass\n    import json\n",
    "own_name": "def use():\n    def inner(json):\n        return json\n    inner(1)\n    import json\n    return json\n",
    "plain": "import json" + USE,
    "either": "if False:\n    import json\nelse:\n    import ujson as json" + USE,
    "unknown": "import os\nif os.environ:\n    import json" + USE,
    "optional": "try:\n    import json\nexcept ImportError:\n    json = None" + USE,
    "both_off": "DEBUG = False\nif DEBUG:\n    import json\ndef use():\n    if DEBUG:\n        json.dumps({})\n",
    "switched": "DEBUG = False\ndef on():\n    global DEBUG\n    DEBUG = True\nif DEBUG:\n    import json" + USE,
    "twice": "DEBUG = False\nDEBUG = bool(input())\nif DEBUG:\n    import json" + USE,
    "calculated": "import os\nif 1 - os.getpid():\n    import json" + USE,
    "divided": "if 1 / 0:\n    import json" + USE,
    "a_chain": "import os\nif 1 < os.getpid() < 2:\n    import json" + USE,
    "list_and_tuple": "if [] == ():\n    pass\nelse:\n    import json" + USE,
    "identity": "if 1 is 1:\n    pass\nelse:\n    import json" + USE,
    "long": "if 'a' * 2000 == '':\n    import json" + USE,
    "filled": "NAMES = []\nNAMES.append(1)\nif NAMES:\n    import json" + USE,
    "formatted": "import os\nif f'{os.name}':\n    import json" + USE,
    "method": "import os\nif os.name.startswith('b'):\n    import json" + USE,
    "one_of_two_functions": "def a():\n    off = False\n    return off\ndef use():\n    off = a()\n    if off:\n        json = 1\n    return json\n",
    "changed_in_a_loop": "def use():\n    seen = False\n    for _ in range(3):\n        if seen:\n            json = 1\n        seen = True\n    return json\n",
    "counted": "def use(a):\n    n = 0\n    for _ in a:\n        n += 1\n    if n:\n        json = 1\n    return json\n",
    "nonlocal_switch": "def use():\n    on = False\n    def turn():\n        nonlocal on\n        on = True\n    turn()\n    if on:\n        json = 1\n    return json\n",
    "of_a_class": "class A:\n    on = False\non = bool(input())\nif on:\n    import json" + USE,
    "of_a_class_of_its_own": "if isinstance(1, Number):\n    import json" + USE,
    "of_a_variable": "import os\nif isinstance(os.name, str):\n    import json" + USE,
    "range": "import os\nfor _ in range(os.getpid()):\n    import json" + USE,
    "range_of_no_steps": "for _ in range(1, 2, 0):\n    import json" + USE,
    "later_in_a_function": "def use():\n    return json.dumps({})\n\n\nimport json\n\nuse()\n",
    "later_in_a_lambda": "use = lambda: json.dumps({})\nimport json\n",
    "later_in_a_loop": "for i in range(2):\n    if i:\n        print(json)\n    json = 1\n",
    "later_in_a_loop_of_a_function": "def use():\n    while True:\n        if x:\n            return json\n        json = 1\n",
    "later_again": "import json\nx = json.dumps({})\nimport json\n",
    "later_by_a_function": "def late():\n    global json\n    import json\n\n\nlate()\njson.dumps({})\njson = 1\n",
    "later_awaited": "try:\n    json\nexcept NameError:\n    pass\nimport json\n",
    "later_argument": "def use(json):\n    x = json\n    json = x\n    return json\n",
    "later_in_a_text": "def use(x: 'json') -> 'json':\n    return x\n\n\nclass json:\n    pass\n",
    "one_line": "import json; x = json.dumps({})\n",
    "in_its_own_class": "class json:\n    def copy(self):\n        return json()\n",
    "argument": "x = 0\ndef use(x):\n    if x:\n        json = 1\n    return json\n",
    "types_only": "from __future__ import annotations\nfrom typing import TYPE_CHECKING\nif TYPE_CHECKING:\n    import json\ndef use(x: json.JSONDecoder):\n    return x\n",
    "types_in_text": "from typing import TYPE_CHECKING\nif TYPE_CHECKING:\n    import json\ndef use(x: 'json.JSONDecoder'):\n    return x\n",
    "types_of_locals": "from typing import TYPE_CHECKING\nif TYPE_CHECKING:\n    import json\ndef use(x):\n    y: json.JSONDecoder = x\n    return y\n",
    "types_or_not": "from typing import TYPE_CHECKING\nif TYPE_CHECKING:\n    import json\nelse:\n    json = None"
    + USE,
    "new": "import sys\nif sys.version_info >= (3, 11):\n    import json\nelse:\n    import tomli as json" + USE,
    "newer": "import sys\nif sys.version_info >= (3, 11):\n    import json" + USE,
    "main": "if __name__ == '__main__':\n    import json" + USE,
    "builtin": "if False:\n    print = 1\ndef use():\n    print(1)\n",
    "global_main": "def main():\n    global json\n    import json\n    use()"
    + USE
    + "if __name__ == '__main__':\n    main()\n",
    "global_called": "def late():\n    global json\n    import json\nlate()" + USE,
    "global_given": "def late():\n    global json\n    import json\nstart(late)" + USE,
    "global_by_name": "def late():\n    global json\n    import json\nstart('late')" + USE,
    "global_decorated": "@hook\ndef late():\n    global json\n    import json" + USE,
    "global_method": "class A:\n    def setUp(self):\n        global json\n        import json" + USE,
    "global_test": "def setup_module():\n    global json\n    import json" + USE,
    "given_by_text": "if False:\n    import json\nglobals()['json'] = 1" + USE,
    "star": "if False:\n    import json\nfrom tools import *" + USE,
    "deleted_helper": "def _make():\n    return _a\n_a = 1\nb = _make()\ndel _make, _a\n",
    "deleted_called": "import json" + USE + "use()\ndel json\n",
    "deleted_again": "import json\ndel json\nimport json" + USE,
    "deleted_in_branch": "import json\nif input():\n    del json" + USE,
    "deleted_in_loop": "def use():\n    for _ in range(3):\n        json = 1\n        del json\n    json = 2\n    return json\n",
    "handled_inside": "def use(a):\n    try:\n        a()\n    except ValueError as json:\n        print(json)\n        def say():\n            return json\n        say()\n",
    "handled_and_set": "def use(a):\n    json = None\n    try:\n        a()\n    except ValueError as json:\n        pass\n    return json\n",
    "awaited": "if False:\n    import json\ntry:\n    json.dumps({})\nexcept NameError:\n    pass\n",
    "awaited_any": "if False:\n    import json\ntry:\n    json.dumps({})\nexcept Exception:\n    pass\n",
    "declared_here": "def use():\n    json: int\n    json = 1\n    return json\n",
    "declared_above": "json: int\nclass A:\n    json: int\ndef use():\n    return json\n",
    "class_body": "class A:\n    if False:\n        json = 1\n    def use(self):\n        return self.json\n",
    "unpacked": "def use():\n    if False:\n        pass\n    json, (x, *y) = 1, (2, 3)\n    return json, x, y\n",
    "with": "def use():\n    with open('x') as json:\n        return json\n",
    "comprehension": "def use():\n    return [json for json in range(3) if (y := json)] + [y]\n",
    "match": "def use(a):\n    match a:\n        case {'x': json, **rest}:\n            return json, rest\n",
    "nonlocal": "def use():\n    json: int\n    def inner():\n        nonlocal json\n        json = 1\n    inner()\n    return json\n",
    "dead_use": "if False:\n    import json\n    json.dumps({})\n",
    "not_parsed": "if False:\n    import json\nprint json\n",
    "attribute": "import json\nif False:\n    json.tool = 1\ndef use():\n    return json.tool\n",
}


@pytest.mark.parametrize("name", FIRES)
def test_fires(name: str) -> None:
    found = list(never_bound(FIRES[name], lambda name: False))
    assert [one.name for one in found] == ["json"]


@pytest.mark.parametrize("name", QUIET)
def test_stays_quiet(name: str) -> None:
    assert list(never_bound(QUIET[name], lambda name: False)) == []


def test_a_function_that_another_file_calls() -> None:
    assert list(never_bound(FIRES["global"], lambda name: name == "late")) == []


def test_a_long_or_deep_file_is_no_trouble() -> None:
    deep = "".join(f"{' ' * i}if x{i}:\n" for i in range(90)) + " " * 90 + "import json" + USE
    wide = "if False:\n    import json\n" + "x = [" + "[" * 80 + "]" * 80 + "]\n" + "y = " + "+".join(["a"] * 900) + USE
    assert list(never_bound(deep)) == []
    large = "".join(f"A{i + 1} = A{i} + A{i}\n" for i in range(90)) + "if A90:\n    import json"
    chain = "if " + " < ".join(["1"] * 900) + ":\n    pass\nelse:\n    import os"
    assert list(never_bound(f"A0 = 'a'\n{large}{USE}")) == [] == list(never_bound(chain))
    assert [one.name for one in never_bound(wide)] == ["json"]
    assert list(never_bound("if False:\n    import json" + USE + "#" * 400_000)) == []
