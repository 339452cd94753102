# SPDX-License-Identifier: Apache-2.0
"""Messages of pylint that the text refutes, and those that it does not."""

from __future__ import annotations

import pytest

from haros_ci.linters.pylint_doubts import is_refuted

CLICK = "import click\n\n@click.command()\n@click.option('--name')\ndef main(name):\n    print(name)\n\nmain()\n"
REFUTED = [
    ("no-value-for-parameter", CLICK, "main()"),
    ("no-value-for-parameter", CLICK.replace("click.command()", "app.command"), "main()"),
    ("no-value-for-parameter", "@mock.patch('a.b')\nasync def main(b):\n    pass\n\nx = main()\n", "x = main()"),
    ("no-value-for-parameter", "@staticmethod\n@hydra.main(config_path='.')\ndef go(c):\n    pass\ngo()\n", "go()\n"),
    (
        "pointless-statement",
        "def f(self):\n    self.s = 1\n    self.s  # prevent unused variable warning\n",
        "self.s  #",
    ),
    ("pointless-statement", "    self.timer  # To avoid unused warnings\n", "self"),
    ("pointless-statement", "with pytest.raises(ValueError):\n    stage.name\n", "stage"),
    ("pointless-statement", "    with self.assertRaises(KeyError) as e:\n        a = 1\n\n        d['x']\n", "d["),
    ("pointless-statement", "try:\n    unicode\nexcept NameError:\n    pass\n", "unicode"),
    ("pointless-statement", "self.sub = create(\n    1)\n\nself.sub\nself.pub = 1\n", "self.sub\nself.p"),
    ("expression-not-assigned", "self.x = 1\nself.x  # noqa\n", "self.x  #"),
    ("dangerous-default-value", "x = 1\ndef f(a=[]):\n    print(a)\n", "def f"),
    ("not-callable", "def f(done=None):\n    if done and x:\n        done(1)\n", "done(1)"),
    ("not-callable", "def f(self):\n    if self.done is not None:\n        self.done(1)\n", "self.done(1)"),
    ("not-callable", "def f(done):\n    x and (done) and done(1)\n", "done(1)"),
    ("not-callable", "def f(done):\n    if a and \\\n       done:\n        done(1)\n", "done(1)"),
    ("not-callable", "def f():\n    if callable(done):\n        done(1)\n", "done(1)"),
    (
        "possibly-used-before-assignment",
        "def go():\n    use(args)\nif __name__ == '__main__':\n    args = 1\n    go()\n",
        "args)",
    ),
    (
        "possibly-used-before-assignment",
        "if '__main__' == __name__:\n    x, args = 1, 2\ndef go():\n    use(args)\n",
        "args)",
    ),
]
MODULE = "if os.name == 'nt':\n    import msvcrt\nelse:\n    import tty, termios\n"
GET = "def get():\n    if os.name == 'nt':\n        return 1\n    termios.tcsetattr(x)\n"
REFUTED += [
    ("too-many-function-args", "a = points.reshape(-1, 1, 2)\n", "a = "),
    ("too-many-function-args", "a.transpose (0, 2, 1)\n", "a.tr"),
    ("possibly-used-before-assignment", MODULE + GET, "termios.tcsetattr"),
    ("possibly-used-before-assignment", MODULE + GET.replace("termios.tc", "tty.tc"), "tty.tcsetattr"),
    ("possibly-used-before-assignment", "if a:\n  from b import c\nc()\n", "c()\n"),
]
STANDS = [
    ("too-many-function-args", "shape(1, 2, 3)\n", "shape"),
    ("too-many-function-args", "reshape(1, 2, 3)\n", "reshape"),
    ("too-many-function-args", "a.reshape(1).fill\nf(1, 2)\n", "f(1"),
    (
        "possibly-used-before-assignment",
        "try:\n    import termios\nexcept ImportError:\n    pass\n" + GET,
        "termios.tcs",
    ),
    ("possibly-used-before-assignment", "if a:\n    termios = 1\n" + GET, "termios.tcs"),
    ("possibly-used-before-assignment", MODULE + "if a:\n    speed = 1\nuse(speed)\n", "speed)"),
    ("pointless-statement", "fid = open(x)\nfid.close\n", "fid.close\n"),
    ("pointless-statement", "if x == 1:\n    pass\nx\n", "x\n"),
    ("pointless-statement", "sub = 1\nself.sub\n", "self.sub\n"),
    ("dangerous-default-value", "def f(self, a=[]):\n    self.a = a\n", "def f"),
    ("not-callable", "done = 5\ndone(1)\n", "done(1)"),
    ("not-callable", "done = 5\nif done():\n    done(1)\n", "done(1)"),
    ("not-callable", "def f():\n    if a:\n        done(1)\ndef g():\n    if done:\n        pass\n", "done(1)"),
    ("not-callable", "(lambda: 1)()()\n", "(lambda"),
    ("possibly-used-before-assignment", "if a:\n    args = 1\ndef go():\n    use(args)\n", "args)"),
    (
        "possibly-used-before-assignment",
        "if __name__ == '__main__':\n    if a:\n        args = 1\n    use(args)\n",
        "args)",
    ),
    (
        "possibly-used-before-assignment",
        "def go():\n    if a:\n        args = 1\n    use(args)\nif __name__ == '__main__':\n    go()\n",
        "args)",
    ),
    ("no-value-for-parameter", "def main(name):\n    pass\n\nmain()\n", "main()\n"),
    (
        "no-value-for-parameter",
        "class A:\n    @staticmethod\n    def main(name):\n        pass\n\nA.main()\n",
        "A.main()",
    ),
    ("no-value-for-parameter", "@lru_cache()\ndef main(name):\n    pass\n\nmain()\n", "main()\n"),
    ("no-value-for-parameter", CLICK + "other()\n", "other()"),
    ("no-value-for-parameter", "@click.command()\nclass A:\n    pass\ndef main(name):\n    pass\nmain()\n", "main()\n"),
    ("no-value-for-parameter", "x = yaml.load(f)\n", "yaml"),
    ("pointless-statement", "def f(self):\n    self.s\n", "self.s\n"),
    ("pointless-statement", "a == b  # compare\n", "a"),
    ("pointless-statement", "if x:\n    rospy.spin\n", "rospy"),
    ("pointless-statement", "with open(x) as f:\n    f.close\n", "f.close"),
    ("pointless-statement", "with pytest.raises(A):\n    pass\nb.c\n", "b.c"),
    ("undefined-variable", "self.s  # prevent unused variable warning\n", "self"),
]


def refuted(rule: str, text: str, at: str) -> bool:
    before = text[: text.rindex(at)]
    return is_refuted(rule, before.count("\n") + 1, len(before) - before.rfind("\n") - 1, text)


@pytest.mark.parametrize(("rule", "text", "at"), REFUTED)
def test_refuted(rule: str, text: str, at: str) -> None:
    assert refuted(rule, text, at)


@pytest.mark.parametrize(("rule", "text", "at"), STANDS)
def test_stands(rule: str, text: str, at: str) -> None:
    assert not refuted(rule, text, at)


@pytest.mark.parametrize("line", [0, 7, -1])
def test_a_line_that_is_not_there(line: int) -> None:
    assert not is_refuted("pointless-statement", line, 0, "a\n")
    assert not is_refuted("no-value-for-parameter", line, 0, "a\n")
