# SPDX-License-Identifier: Apache-2.0
"""Data, functions and statements of launch files: what is known of them, and (longer) what is not."""

from __future__ import annotations

import pytest
from launch_python_kit import actions, describe, unknowns, value_of

KNOWN = [
    ("'a' + 'b' * 2", "abb"),
    ("f'{1 + 1}-{\"x\":>3}-{True!r}'", "2-  x-True"),
    ("'%s/%d' % ('n', 3)", "n/3"),
    ("'%(k)s' % {'k': 'v'}", "v"),
    ("'{}_{name}_{0}'.format('a', name='b')", "a_b_a"),
    ("'a,b'.split(',')[1].upper()", "B"),
    ("'-'.join(sorted(['c', 'a', 'b'], reverse=True))", "c-b-a"),
    ("sorted([3, 1, 2], key=lambda v: -v)", "[3, 2, 1]"),
    ("[x * y for x in range(3) for y in (1, 2) if x]", "[1, 2, 2, 4]"),
    ("{k: v for k, v in zip('ab', [1, 2])}", "{'a': 1, 'b': 2}"),
    ("list(enumerate('ab', 1))", "[(1, 'a'), (2, 'b')]"),
    ("len([*range(4), 9])", "5"),
    ("{**{'a': 1}, 'b': 2}", "{'a': 1, 'b': 2}"),
    ("[1, 2, 3][::-1]", "[3, 2, 1]"),
    ("any(x > 2 for x in [1, 3]) and all([])", "True"),
    ("list(map(str, [1, 2])) + list(filter(None, [0, 4]))", "['1', '2', 4]"),
    ("isinstance('a', (int, str)) and not isinstance(Path('a'), str)", "True"),
    ("'yes' if 2 in [1, 2] and 'a' not in {'b': 1} else 'no'", "yes"),
    ("(lambda a, *b, c=3, **d: [a, b, c, d])(1, 2, e=4)", "[1, (2,), 3, {'e': 4}]"),
    ("os.path.join('a', 'b', '..', 'c.yaml')", "a/b/../c.yaml"),
    ("os.path.join('a', '/b')", "/b"),
    ("os.path.join('a', get_package_share_directory('p'))", "$(find-pkg-share p)"),
    ("os.path.join(get_package_share_directory('p'), 'config', 'x.yaml')", "$(find-pkg-share p)/config/x.yaml"),
    ("os.path.dirname(get_package_share_directory('p'))", "$(find-pkg-prefix p)/share"),
    ("os.path.dirname(__file__)", "$(workspace robot/launch)"),
    ("os.path.dirname(os.path.dirname(os.path.abspath(__file__)))", "$(workspace robot)"),
    ("Path(__file__).resolve().parents[1] / 'config' / 'a.yaml'", "$(workspace robot)/config/a.yaml"),
    ("get_package_share_path('p') / 'x.tar.gz'", "$(find-pkg-share p)/x.tar.gz"),
    ("Path('a/b.yaml').stem + Path('a/b.yaml').suffix + Path('a/b').name", "b.yamlb"),
    ("os.path.splitext('a/b.yaml')", "('a/b', '.yaml')"),
    ("FindPackageShare('p').find('p')", "$(find-pkg-share p)"),
    ("os.environ['HOME_OF'] + os.getenv('HOME_OF', 'd')", "hh"),
    ("'HOME_OF' in os.environ and os.environ.get('HOME_OF')", "h"),
    ("json.loads('{\"a\": [1, null]}')", "{'a': [1, None]}"),
    ("yaml.safe_load('a: {b: [1, 2.5, yes, x]}')['a']['b']", "[1, 2.5, True, 'x']"),
    ("yaml.safe_load(open('$(find-pkg-share p)/a.yaml'))['k']", "v"),
    ("Path('$(find-pkg-share p)/a.yaml').read_text().strip()", "k: v"),
    ("(n := 3) + n", "6"),
    ("max(1, 4) + min([2, 3]) + sum([1, 1]) + abs(-1) + round(1.4)", "10"),
    ("next(iter([7, 8]))", "7"),
    ("not None is None", "False"),
    ("1 < 2 < 3 != 4", "True"),
    ("eval('False') or eval('[1, -2.5, None]')", "[1, -2.5, None]"),
    ("eval('1' + '0') + 1", "11"),
    ("2 ** 10 // 3 % 7 | 8", "13"),
]


@pytest.mark.parametrize(("expression", "text"), KNOWN, ids=[item[0] for item in KNOWN])
def test_known_values(expression: str, text: str) -> None:
    files = {"$(find-pkg-share p)/a.yaml": "k: v\n"}
    assert value_of(expression, files=files, environment={"HOME_OF": "h", "A": ""}) == (text,)


@pytest.mark.parametrize(
    ("text", "known"), [("{'a': 1}", "{'a': 1}"), ("'x'", "x"), ("None", "None"), ("f()", ""), ("1j", "")]
)
def test_literals(text: str, known: str) -> None:
    found = value_of(f"ast.literal_eval({text!r})", "import ast")
    assert found == (known,) if known else unknowns(found) == ["what ast.literal_eval gives is not followed"]


UNKNOWN = [
    "os.environ['MODEL']",
    "os.getenv('MODEL')",
    "os.path.expanduser('~/x')",
    "__import__('os').getcwd()",
    "eval('os')",
    "eval('f()')",
    "eval('true')",
    "eval('2 ** 9')",
    "eval('[' * 300)",
    "eval('1,' * 300)",
    "eval(\"__import__('os').getcwd()\")",
    "eval(os.environ['MODEL'])",
    "exec('1')",
    "open('/etc/passwd').read()",
    "open('../x').read()",
    "open('$(workspace ../..)/etc/passwd').read()",
    "open('$(workspace /etc)/passwd').read()",
    "open('$(find-pkg-share ../x)/y').read()",
    "open('$(find-pkg-share p)/../../../../etc/passwd').read()",
    "open('$(find-pkg-share p)/none.yaml').read()",
    "yaml.safe_load('a: [')",
    "yaml.safe_load('!!python/object:os.system {}')",
    "json.loads('{')",
    "json.loads('[' * 100000)",
    "yaml.safe_load('[' * 10000)",
    "{}['missing']",
    "[][0]",
    "1 / 0",
    "'a' + 1",
    "int('x')",
    "undefined_name",
    "unknown_module.f()",
    "10 ** 10 ** 10",
    "1 << 10 ** 9",
    "'a' * 10 ** 9",
    "[0] * 10 ** 9",
    "'a'.ljust(10 ** 9)",
    "'%1000000000d' % 1",
    "f'{1:1000000000}'",
    "'{:1000000000}'.format(1)",
    "'ab'.replace('', 'x' * 100000)",
    "list(range(10 ** 12))",
    "[x for x in range(10 ** 9)]",
    "Path('a').glob('*')",
    "os.listdir('.')",
    "LaunchConfiguration('x').perform(launch.LaunchContext())",
    "len(os.environ)",
    "random.random()",
    "(lambda f: f(f))(lambda f: f(f))",
    "tuple(set([1, 2]))",
    "sorted([1, 'a'])",
    "'x' if os.environ['MODEL'] == 'a' else 'y'",
    "[1, 2][os.environ['I']]",
    "{'a': 1}[os.environ['I']]",
    "os.environ['A'] in ['b']",
    "object()",
    "re.match('a', 'a').group()",
    "{os.environ['K']: 1}['a']",
    "dict(unknown)['a']",
    "Node(package='a', executable='b').name",
    "str(LaunchConfiguration('x'))",
    "f'{LaunchConfiguration(\"x\")}'",
]


@pytest.mark.parametrize("expression", UNKNOWN)
def test_unknown_values(expression: str) -> None:
    asked: list[str] = []
    found = value_of(expression, asked=asked)
    assert unknowns(found), found
    assert all(reason for reason in unknowns(found))
    assert set(asked) <= {"$(find-pkg-share p)/none.yaml"}


STATEMENTS = [
    (
        "x = []\nfor i in range(3):\n    if i == 1:\n        continue\n    x.append(i)\nelse:\n    x.append('e')",
        "[0, 2, 'e']",
    ),
    ("x = 0\nwhile True:\n    x += 1\n    if x > 4:\n        break", "5"),
    ("a, (b, *c) = 1, (2, 3, 4)\nx = [a, b, c]", "[1, 2, [3, 4]]"),
    ("x = {'a': [1]}\nx['a'].append(2)\nx.setdefault('b', []).append(3)\ndel x['a'][0]", "{'a': [2], 'b': [3]}"),
    ("try:\n    x = 1\nexcept ValueError:\n    x = 2\nfinally:\n    y = 3\nx += y", "4"),
    ("try:\n    raise ValueError\nexcept ValueError as e:\n    x = 2", "2"),
    ("with open('$(find-pkg-share p)/a.yaml') as f:\n    x = yaml.safe_load(f)['k']", "v"),
    ("def f(a, b=[]):\n    b.append(a)\n    return b\nf(1)\nx = f(2)", "[1, 2]"),
    ("def g():\n    yield 1\n    yield from [2, 3]\nx = list(g())", "[1, 2, 3]"),
    (
        "def outer():\n    n = 1\n    def inner():\n        nonlocal n\n        n += 1\n    inner()\n    return n\nx = outer()",
        "2",
    ),
    ("import copy\na = [[1]]\nb = copy.deepcopy(a)\na[0].append(2)\nx = b", "[[1]]"),
    (
        "class P:\n    kind = 'k'\n    def __init__(self, n):\n        self.n = n\n    @property\n    def twice(self):\n"
        "        return self.n * 2\n    @staticmethod\n    def s():\n        return 's'\n"
        "class Q(P):\n    def __init__(self):\n        super().__init__(4)\nx = [Q().twice, P.s(), Q.kind]",
        "[8, 's', 'k']",
    ),
    ("match 'b':\n    case 'a' | 'c':\n        x = 1\n    case _:\n        x = 2", "2"),
    ("os.environ['NEW'] = 'v'\nx = os.environ['NEW']", "v"),
    ("if os.environ['U'] == '1':\n    x = 5\nelse:\n    x = 5", "5"),
    ("x = 1\nif os.environ['U'] == '1':\n    raise ValueError", "1"),
    ("if os.environ['U'] == '1':\n    x = 7", "7"),
    ("x = [1]\nx += [2]\ny = x\ny.insert(0, 0)\nx.remove(2)", "[0, 1]"),
    ("assert False\nx = 1", "1"),
]


@pytest.mark.parametrize(("body", "text"), STATEMENTS, ids=[item[0] for item in STATEMENTS])
def test_statements(body: str, text: str) -> None:
    assert value_of("x", body=body, files={"$(find-pkg-share p)/a.yaml": "k: v\n"}) == (text,)


UNDECIDED = [
    "x = 1\nif os.environ['U'] == '1':\n    x = 2",
    "x = 0\nfor i in os.environ['U'].split():\n    x += 1",
    "x = 0\nwhile os.environ['U']:\n    x += 1",
    "x = {'a': 1}\nx[os.environ['U']] = 2\nx = x['a']",
    "x = {}\nif os.environ['U']:\n    x['a'] = 1\nx = x.get('a', 2)",
    "x = {}\nif os.environ['U']:\n    x['a'] = 1\nx = 'a' in x",
    "x = []\nif os.environ['U']:\n    x.append(1)\nx = len(x)",
    "x = [1, 2]\nif os.environ['U']:\n    x.pop()\nx = x[1]",
    "x = [2, 1]\nunknown_function(x)\nx = x[0]",
    "x = [1, 2]\nimport random\nrandom.shuffle(x)\nx = x[0]",
    "d = {'l': [1]}\nl = d['l']\nunknown_function(d)\nx = l[0]",
    "def f():\n    if os.environ['U']:\n        return 1\n    return 2\nx = f()",
    "def f():\n    for i in os.environ['U']:\n        return 1\n    return 2\nx = f()",
    "try:\n    x = int(os.environ['U'])\nexcept ValueError:\n    x = 3",
    "l = [1]\nm = l if os.environ['U'] else [2]\nm[0] = 9\nx = l[0]",
    "l = [1]\nm = l if os.environ['U'] else [2]\nm.append(9)\nx = len(l)",
    "class C:\n    a = 1\nc = C()\nif os.environ['U']:\n    c.a = 2\nx = c.a",
    "@unknown_decorator\ndef f():\n    return 1\nx = f()",
    "@unknown_decorator\nclass C:\n    a = 1\nx = C.a",
    "async def f():\n    return 1\nx = f()",
    "def f(n):\n    return f(n + 1)\nx = f(0)",
    "os.environ['HOME_OF'] = os.environ['U']\nx = os.environ['HOME_OF']",
]


@pytest.mark.parametrize("body", UNDECIDED)
def test_what_depends_on_the_unknown_is_unknown(body: str) -> None:
    assert unknowns(value_of("x", body=body, environment={"HOME_OF": "h"}))


def test_modules_of_the_workspace_are_interpreted() -> None:
    modules = {
        "my_pkg.parts": "from my_pkg.base import word as w\ndef f(x):\n    return w + x\n",
        "my_pkg.base": "word = 'w'\nimport my_pkg.parts\n",
    }
    assert value_of("f('x')", "from my_pkg.parts import f", modules=modules) == ("wx",)
    assert unknowns(value_of("g('x')", "from my_pkg.parts import g", modules=modules))
    assert unknowns(value_of("f('x')", "from other.parts import f", modules=modules))


@pytest.mark.parametrize(
    ("text", "problem"),
    [
        ("def broken(:\n", "this is not valid Python; correct the syntax"),
        ("x = 1\n", "there is no function generate_launch_description; define it"),
        ("(" * 5000, "this is not valid Python; correct the syntax"),
    ],
)
def test_problems(text: str, problem: str) -> None:
    assert describe(text).problems == ((1, problem),)


def test_the_description_of_a_test_is_followed_too() -> None:
    made = describe(
        "import launch_testing\nimport pytest\n@pytest.mark.x\ndef generate_test_description(arg):\n"
        "    n = Node(package='p', executable='e')\n"
        "    return LaunchDescription([n, launch_testing.actions.ReadyToTest()]), {'n': n}\n"
    )
    assert [action.kind for action in made.actions] == ["node", "log"]


def test_unknown_results_are_an_unknown_action() -> None:
    found = describe("def generate_launch_description():\n    return unknown_function()\n").actions
    assert [(action.kind, action.reason) for action in found] == [("?", "`unknown_function` has no value here")]
    assert [a.kind for a in actions("ld.add_action(os.environ['X'])\nld.add_action(3)")] == ["?", "?"]
