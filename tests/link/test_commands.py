# SPDX-License-Identifier: Apache-2.0
"""Programs of commands (click, Typer, argparse): each command is a way that the program may run, conditional on its name."""

from __future__ import annotations

import pytest
from follow_kit import explicit, follow, names, only, python

from haros_ci.model.architecture import Node

SETUP = (
    "from setuptools import setup\nsetup(name='p', packages=['p'], entry_points={'console_scripts': ['n = p.n:cli']})\n"
)
HEAD = "import click\nimport typer\nimport rclpy\nfrom rclpy.node import Node\nfrom std_msgs.msg import String\n"
GROUP = "@click.group()\n@click.pass_context\ndef cli(ctx):\n    rclpy.init()\n    ctx.obj = Node('tool')\n"
TYPER = "rclpy.init()\nnode = Node('tool')\ncli = typer.Typer()\n"
TALK = "@cli.command()\n@click.pass_obj\ndef talk(node):\n    node.create_publisher(String, 'a', 1)\n"


def node(text: str, **modules: str) -> Node:
    """The only node of the Python package ``p`` whose console script is ``cli`` of *text*."""
    more = {f"p/p/{name}.py": content for name, content in modules.items()}
    (found,) = only(follow({"p/setup.py": SETUP, "p/p/__init__.py": "", "p/p/n.py": HEAD + text, **more}, 2)).nodes
    return found


def made(found: Node) -> list[str]:
    """The publishers and the commands that each stands under; ``-`` before what is ruled out."""
    return sorted(
        ("-" if end.is_ruled_out else "") + " ".join((end.name, *(c.condition for c in end.conditions)))
        for end in explicit(found)
    )


FIRES = {
    "a command": (GROUP + TALK, ["/a talk"]),
    "its name": (GROUP + TALK.replace("command()", "command('say')"), ["/a say"]),
    "its name as a keyword": (GROUP + TALK.replace("command()", "command(name='say')"), ["/a say"]),
    "an underscore": (GROUP + TALK.replace("def talk", "def talk_on"), ["/a talk-on"]),
    "two commands": (GROUP + TALK + TALK.replace("talk", "b").replace("'a'", "'b'"), ["/a talk", "/b b"]),
    "a group in a group": (
        GROUP + "@cli.group()\ndef sub():\n    pass\n" + TALK.replace("@cli.", "@sub."),
        ["/a sub talk"],
    ),
    "a method": (GROUP + TALK + "if __name__ == '__main__':\n    cli.main()\n", ["/a talk"]),
    "a class's own decorator": (
        GROUP + "passed = click.make_pass_decorator(Node)\n" + TALK.replace("click.pass_obj", "passed"),
        ["/a talk"],
    ),
    "an object that is made": (
        "class C:\n    def __init__(self):\n        rclpy.init()\n        self.node = Node('tool')\n"
        "passed = click.make_pass_decorator(C, ensure=True)\n@click.group()\ndef cli():\n    pass\n"
        "@cli.command()\n@passed\ndef talk(c):\n    c.node.create_publisher(String, 'a', 1)\n",
        ["/a talk"],
    ),
    "a dictionary": (
        GROUP.replace("ctx.obj =", "ctx.ensure_object(dict)\n    ctx.obj['node'] =")
        + TALK.replace("pass_obj", "pass_context")
        .replace("(node)", "(ctx)")
        .replace("    node.", "    ctx.obj['node']."),
        ["/a talk"],
    ),
    "the context and the object": (
        GROUP
        + TALK.replace("@click.pass_obj\n", "@click.pass_obj\n@click.pass_context\n").replace("(node)", "(c, node)"),
        ["/a talk"],
    ),
    "the current context": (
        GROUP + "@cli.command()\ndef talk():\n    click.get_current_context().obj.create_publisher(String, 'a', 1)\n",
        ["/a talk"],
    ),
    "another command": (
        GROUP + TALK + "@cli.command()\n@click.pass_context\ndef b(ctx):\n    ctx.invoke(talk)\n",
        ["/a"],
    ),
    "a command that is added": (GROUP + TALK.replace("@cli.", "@click.") + "cli.add_command(talk)\n", ["/a talk"]),
    "an object": (
        "rclpy.init()\nnode = Node('tool')\ncli = click.Group()\n"
        "@cli.command()\ndef talk():\n    node.create_publisher(String, 'a', 1)\n",
        ["/a talk"],
    ),
    "a command alone": (
        "@click.command()\ndef cli():\n    rclpy.init()\n    Node('tool').create_publisher(String, 'a', 1)\n",
        ["/a"],
    ),
    "Typer": (
        TYPER + "@cli.command()\ndef talk():\n    node.create_publisher(String, 'a', 1)\n"
        "@cli.command()\ndef b(ctx: typer.Context, times: int = 3):\n    node.create_publisher(String, 'b', times)\n",
        ["/a talk", "/b b"],
    ),
    "Typer with one command": (
        TYPER + "@cli.command()\ndef talk():\n    node.create_publisher(String, 'a', 1)\n",
        ["/a"],
    ),
    "Typer with a callback": (
        TYPER + "@cli.callback()\ndef first():\n    node.create_publisher(String, 'b', 1)\n"
        "@cli.command()\ndef talk():\n    node.create_publisher(String, 'a', 1)\n",
        ["/a talk", "/b"],
    ),
    "Typer in Typer": (
        TYPER + "sub = typer.Typer()\ncli.add_typer(sub, name='sub')\n"
        "@sub.command()\ndef talk():\n    node.create_publisher(String, 'a', 1)\n"
        "@sub.command()\ndef b():\n    node.create_publisher(String, 'b', 1)\n"
        "@cli.command()\ndef c():\n    node.create_publisher(String, 'c', 1)\n",
        ["/a sub talk", "/b sub b", "/c c"],
    ),
    "Typer in Typer without a name": (
        TYPER + "sub = typer.Typer()\ncli.add_typer(sub)\n"
        "@sub.command()\ndef talk():\n    node.create_publisher(String, 'a', 1)\n"
        "@sub.command()\ndef b():\n    node.create_publisher(String, 'b', 1)\n",
        ["/a talk", "/b b"],
    ),
    "Typer without a group": (
        "def talk():\n    rclpy.init()\n    Node('tool').create_publisher(String, 'a', 1)\ndef cli():\n    typer.run(talk)\n",
        ["/a"],
    ),
}


@pytest.mark.parametrize("name", FIRES)
def test_commands(name: str) -> None:
    text, expected = FIRES[name]
    assert made(node(text)) == expected


QUIET = {
    "a command of another group": GROUP + "@click.group()\ndef other():\n    pass\n" + TALK.replace("@cli.", "@other."),
    "a decorator of the same name": GROUP + "class D:\n    def command(self):\n        return lambda f: f\n"
    "d = D()\n" + TALK.replace("@cli.", "@d."),
    "a method of a class": GROUP + "class C:\n" + "".join(f"    {line}\n" for line in TALK.splitlines()),
    "a command that nobody adds": GROUP + TALK.replace("@cli.", "@click."),
    "a decorator that is not known": GROUP + "import lib\n" + TALK.replace("@cli.", "@lib."),
}


@pytest.mark.parametrize("name", QUIET)
def test_what_is_no_command_of_the_program(name: str) -> None:
    assert made(node(QUIET[name])) == []


def test_what_an_option_says_is_not_known() -> None:
    text = "@cli.command()\n@click.option('--to', default='x')\n@click.pass_obj\ndef t(node, to):\n    node.create_publisher(String, to, 1)\n"
    (end,) = explicit(node(GROUP + text))
    assert (end.name, [each.reason for each in end.unknowns]) == ("/?", ["the command line is not known"])


def test_a_default_of_a_function_is_not_what_the_command_line_says() -> None:
    text = "@cli.command()\ndef t(to: str = 'x'):\n    node.create_publisher(String, to, 1)\n"
    assert made(node(TYPER + text)) == ["/?"]


def test_commands_in_modules_that_are_imported() -> None:
    command = "import click\nfrom std_msgs.msg import String\nfrom .n import cli\n"
    command += TALK.replace("talk", "b").replace("'a'", "'b'")
    assert made(node(GROUP + "from . import b\n", b=command)) == ["/b b"]
    assert made(node(GROUP, b=command)) == []


def test_the_command_that_a_launch_file_names() -> None:
    text = "import click\n@click.group()\ndef cli():\n    pass\n"
    for word in "ab":
        text += f"@cli.command()\ndef {word}():\n    PUB('{word}')\n"
    launch = '<launch><node pkg="p" type="n.py" name="n" args="{}"/></launch>'
    for words, expected in (("a", ["/a a", "-/b b"]), ("", ["/a a", "/b b"]), ("--x a", ["/a a", "/b b"])):
        assert made(python(text + "cli()\n", launch.format(words))) == sorted(expected), words


GIVING = (
    "class Inner:\n    def go(self):\n        PUB('a')\n    @property\n    def name(self):\n        return 'b'\n"
    "class C:\n    def __init__(self):\n        self.inner = Inner()\n    def own(self):\n        PUB('own')\n"
    "    def __getattr__(self, key):\n        {}\n"
)
TRIED = "try:\n            return object.__getattribute__(self, key)\n        except AttributeError:\n            return getattr(self.inner, key)"


@pytest.mark.parametrize("body", ["return getattr(self.inner, key)", TRIED])
def test_attributes_that_a_class_gives(body: str) -> None:
    head = GIVING.format(body)
    assert names(python(head + "C().go()\n")) == ["/a"]
    assert names(python(head + "PUB(C().name)\n")) == ["/b"]
    assert names(python(head + "C().own()\n")) == ["/own"]


def test_attributes_of_a_base_that_is_not_here_are_not_given() -> None:
    head = GIVING.format("return getattr(self.inner, key)").replace("class C:", "import lib\nclass C(lib.Base):")
    assert names(python(head + "C().go()\n")) == ["/own"]  # the library's class may call it


def test_an_object_is_not_none() -> None:
    body = "p = PUB('a')\nif p is None:\n    PUB('b')\nif p is not None:\n    PUB('c')\nif [] is None:\n    PUB('d')\n"
    found = python(body)
    assert sorted(end.name for end in found.endpoints if end.is_ruled_out) == ["/b", "/d"]


def test_what_may_be_none_stays_open() -> None:
    body = "p = None\nif rospy.get_param('~x'):\n    p = PUB('a')\nif p is None:\n    PUB('b')\n"
    launch = (
        '<launch><arg name="x"/><node pkg="p" type="n.py" name="n"><param name="x" value="$(env X)"/></node></launch>'
    )
    assert not any(end.is_ruled_out for end in python(body, launch).endpoints)


PARSER = (
    "import argparse\ndef talk(o):\n    PUB('a')\ndef hear(o):\n    PUB('b')\ndef other(o):\n    PUB(o.to)\n"
    "p = argparse.ArgumentParser()\np.add_argument('-n', default='x')\ns = p.add_subparsers(dest='command')\n"
    "q = s.add_parser('talk', help='x', aliases=['t'])\nq.set_defaults(func=talk)\n"
    "r = s.add_parser('hear')\nr.add_argument('--to', default='y')\nr.set_defaults(func=hear)\n"
)
LAUNCH = '<launch><node pkg="p" type="n.py" name="n" args="{}"/></launch>'
SENT = "o = p.parse_args()\no.func(o)\n"


def test_commands_of_argparse() -> None:
    assert made(python(PARSER + SENT)) == ["/a talk", "/b hear"]


@pytest.mark.parametrize(
    "words", ["rospy.myargv()[1:]", "rospy.myargv(argv=sys.argv)[1:]", "sys.argv[1:]", "args=sys.argv[1:]"]
)
def test_commands_of_argparse_with_the_words_of_the_command_line(words: str) -> None:
    """Of a program that no launch file starts."""
    body = "import sys\n" + PARSER + SENT.replace("parse_args()", f"parse_args({words})")
    assert made(python(body)) == ["/a talk", "/b hear"]


OWN = PARSER.replace("PUB('a')", "PUB(o.n)").replace("PUB('b')", "PUB(o.to)")


@pytest.mark.parametrize(
    ("before", "expected"),
    [
        ("", ["/? hear", "/x talk"]),
        ("r.add_argument('-n')\n", ["/? hear", "/? talk"]),
        ("r.set_defaults(n='y')\n", ["/? hear", "/? talk"]),
        ("r.add_subparsers().add_parser('in').add_argument('--more', dest='n')\n", ["/? hear", "/? talk"]),
        ("p.add_argument('file')\n", ["/? hear", "/? talk"]),
    ],
)
def test_options_beside_commands_have_their_defaults(before: str, expected: list[str]) -> None:
    body = "import sys\n" + OWN + before + SENT.replace("parse_args()", "parse_args(sys.argv[1:])")
    assert made(python(body)) == expected


@pytest.mark.parametrize("words", ["['talk']", "['t', '--'][:1]"])
def test_commands_of_argparse_with_words_of_the_program(words: str) -> None:
    assert made(python(PARSER + SENT.replace("parse_args()", f"parse_args({words})"))) == ["/a"]


def test_commands_in_commands_of_argparse() -> None:
    inner = "i = r.add_subparsers().add_parser('in')\ni.set_defaults(func=talk)\n"
    assert made(python(PARSER + inner + SENT)) == ["/a", "/b hear"]  # by talk or by hear in
    inner = inner.replace("func=talk", "func=lambda o: PUB('c')")
    assert made(python(PARSER + inner + SENT)) == ["/a talk", "/b hear", "/c hear in"]


def test_options_of_no_command_have_their_defaults() -> None:
    assert made(python(PARSER + SENT.replace("o.func(o)", "PUB(o.n)"))) == ["/x"]


def test_options_of_commands_stay_unknown() -> None:
    (end,) = python(PARSER + "r.set_defaults(func=other)\nq.set_defaults(func=other)\n" + SENT).endpoints[:1]
    assert (end.name, [each.reason for each in end.unknowns if each.field == "name"]) == (
        "/?",
        ["the command line is not known"],
    )


@pytest.mark.parametrize(
    ("words", "expected"),
    [("talk", ["/a"]), ("t", ["/a"]), ("hear --to z", ["/b"]), ("-n x talk", ["/a"]), ("no", ["/a talk", "/b hear"])],
)
def test_the_words_of_a_launch_file_choose_the_command(words: str, expected: list[str]) -> None:
    body = PARSER + "o = p.parse_args(rospy.myargv()[1:])\no.func(o)\n"
    assert made(python(body, LAUNCH.format(words))) == expected


@pytest.mark.parametrize(
    "body",
    [
        PARSER.replace("q.set_defaults(func=talk)", "").replace("r.set_defaults(func=hear)", "") + SENT,
        PARSER + "o = p.parse_args()\n",
        PARSER + "class F:\n    func = None\no = F()\no.func = print\no.func(o)\n",
        PARSER.replace("=talk", "='talk'").replace("=hear", "='hear'") + SENT,
    ],
)
def test_commands_of_argparse_that_are_not_called(body: str) -> None:
    assert made(python(body)) == []


def test_parsers_without_end() -> None:
    body = PARSER + "for i in range(200):\n    q = q.add_subparsers().add_parser('x')\n    q.set_defaults(func=talk)\n"
    assert [name.partition(" ")[0] for name in made(python(body + SENT))] == ["/a", "/b"]
    body = PARSER + "for i in range(200):\n    s.add_parser('x%d' % i).set_defaults(func=talk)\n"
    assert [name.partition(" ")[0] for name in made(python(body + SENT))] == ["/a", "/b"]
