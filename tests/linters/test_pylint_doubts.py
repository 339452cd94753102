# SPDX-License-Identifier: Apache-2.0
"""Messages of pylint that the text refutes, and those that it does not."""

from __future__ import annotations

import pytest

from haros_ci.linters import pylint_names
from haros_ci.linters.noqa import is_silenced
from haros_ci.linters.pylint_doubts import is_refuted
from haros_ci.linters.pylint_statements import is_made_by_hand

CLICK = "import click\n\n@click.command()\n@click.option('--name')\ndef main(name):\n    print(name)\n\nmain()\n"
REFUTED = [
    ("no-value-for-parameter", "x = self.delta(*args)\n", "self.delta"),
    ("no-value-for-parameter", "x = delta(1, **options)\n", "delta("),
    ("no-value-for-parameter", "x = a.b.delta(first, *rest, key=1)\n", "a.b"),
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
COUNTED = "def f(vec):\n    for i in vec:\n        if i > 2:\n            total = i\n    total += 1\n    return total\n"
REFUTED += [
    ("undefined-variable", COUNTED, "total += 1"),
    ("undefined-variable", COUNTED.replace("for i in vec", "while i := vec()"), "total += 1"),
    ("undefined-variable", COUNTED.replace("total = i", "a, total = i, i"), "total += 1"),
    ("undefined-variable", COUNTED.replace("def f(vec)", "if vec"), "total += 1"),
]
THREAD = "class A:\n    def __init__(self):\n        self.worker = {}()\n    def go(self):\n        self.worker = {}(target=f)\n"
ENTRY = "class Entry(ABC):\n    kind = None\n    def __init__(self):\n        self.value = self.kind()\n"
REFUTED += [
    ("bad-thread-instantiation", THREAD.format("threading.Thread", "threading.Thread"), "()\n    def"),
    ("bad-thread-instantiation", THREAD.format("Thread", "Thread"), "()\n    def"),
    ("bad-thread-instantiation", THREAD.format("Thread", "StoppableThread"), "()\n    def"),
    ("bad-thread-instantiation", THREAD.replace("f)", "\n            f)").format("Thread", "Thread"), "()\n    def"),
    (
        "bad-thread-instantiation",
        THREAD.replace("{}(target", "{}(\n            target").format(*("Thread",) * 2),
        "()\n    def",
    ),
    ("not-callable", ENTRY, "self.kind()"),
    ("not-callable", ENTRY + "class More(Entry):\n    def go(self):\n        self.kind()\n", "self.kind()"),
    ("not-callable", ENTRY.replace("kind = None", "kind: type | None = None"), "self.kind()"),
    ("not-callable", ENTRY.replace("(ABC)", "(metaclass=abc.ABCMeta)"), "self.kind()"),
    (
        "not-callable",
        ENTRY.replace("(ABC)", "(object)") + "    def read(self):\n        raise NotImplementedError()\n",
        "self.kind()",
    ),
    ("expression-not-assigned", "def f(x):\n    x.a() if x.b == 'c' else x.d()\n", "x.a()"),
    ("expression-not-assigned", "x.a() if x.b else None\n", "x.a()"),
    ("expression-not-assigned", "x.a(\n  1) if b else (\n    c() if d else e())\n", "x.a("),
    ("self-assigning-variable", "def f():\n    status, message = A.B, message\n", "message ="),
    ("self-assigning-variable", "a, b, c = a, 1, c\n", "a, b"),
    ("self-assigning-variable", "a, b = (\n    a, 1)\n", "a, b"),
]
MODULE = "if os.name == 'nt':\n    import msvcrt\nelse:\n    import tty, termios\n"
GET = "def get():\n    if os.name == 'nt':\n        return 1\n    termios.tcsetattr(x)\n"
REFUTED += [
    ("too-many-function-args", "a = points.reshape(-1, 1, 2)\n", "a = "),
    ("too-many-function-args", "a.transpose (0, 2, 1)\n", "a.tr"),
    ("invalid-envvar-default", "RANK = int(os.getenv('RANK', -1))\n", "os.getenv"),
    ("invalid-envvar-default", "rate = 2 * float( os.environ.get('RATE', 1.5))\n", "os.environ"),
    ("too-many-function-args", "a = np.array([\n    f(1),\n]).reshape(3, 3)\n", "np.array"),
    ("too-many-function-args", "a = np.array(\n    [f(1)]\n)[0].T.reshape(\n    3, 3)\n", "np.array"),
    ("possibly-used-before-assignment", MODULE + GET, "termios.tcsetattr"),
    ("possibly-used-before-assignment", MODULE + GET.replace("termios.tc", "tty.tc"), "tty.tcsetattr"),
    ("possibly-used-before-assignment", "if a:\n  from b import c\nc()\n", "c()\n"),
]
VALIDATED = "class A(BaseModel):\n    @root_validator\n    def check(cls, values):\n        return values\n"
PLATFORMS = "if sys.platform == 'linux':\n    path = 1\nelif sys.platform == 'win32':\n    path = 2\nuse(path)\n"
REFUTED += [
    ("no-self-argument", VALIDATED, "def check"),
    ("no-self-argument", VALIDATED.replace("@root_validator", "@house.of_class(\n        1)"), "def check"),
    ("no-self-argument", VALIDATED.replace("@root_validator", "@pydantic.field_validator('a')"), "def check"),
    ("no-self-argument", VALIDATED.replace("cls", "model"), "def check"),
    ("possibly-used-before-assignment", PLATFORMS, "path)"),
    ("possibly-used-before-assignment", PLATFORMS.replace("sys.platform", "platform.system()"), "path)"),
    ("anomalous-backslash-in-string", "for k in d.iteritems():\n    re.sub('\\(', k)\n", "'\\("),
    ("anomalous-backslash-in-string", "#!/usr/bin/env python2\nre.sub('\\(', k)\n", "'\\("),
    ("anomalous-backslash-in-string", "import urllib2\nre.sub('\\(', k)\n", "'\\("),
]
GLOBAL = """def tick():
    global total
    use(total)

if __name__ == '__main__':
    total = 0
    tick()
"""
REFUTED += [
    ("undefined-variable", GLOBAL, "total)"),
    ("used-before-assignment", GLOBAL, "total)"),
    ("expression-not-assigned", "[show(label) for label in labels]\n", "[show"),
    ("expression-not-assigned", "[\n    label.show()\n    for label in labels\n]\n", "["),
    ("unreachable", "    raise NotImplementedError('later')\n    return 1\n", "return 1"),
    ("unreachable", "    raise NotImplementedError(\n        'later'\n    )\n\n    # so\n    return 1\n", "return 1"),
    ("trailing-comma-tuple", "a = 1, 2, 3,\n", "a"),
]
STANDS = [
    ("bad-thread-instantiation", THREAD.format("Thread", "list"), "()\n    def"),
    ("bad-thread-instantiation", THREAD.replace("target=f", "").format("Thread", "Thread"), "()\n    def"),
    (
        "bad-thread-instantiation",
        THREAD.replace("    def go", "class B:\n    def go").format(*("Thread",) * 2),
        "()\nclass B",
    ),
    ("bad-thread-instantiation", "Thread().start()\n", "Thread"),
    ("not-callable", ENTRY.replace("(ABC)", ""), "self.kind()"),
    ("not-callable", ENTRY.replace("kind = None", "kind = 1"), "self.kind()"),
    (
        "not-callable",
        ENTRY.replace("    kind = None\n", "").replace("        self.v", "        kind = None\n        self.v"),
        "self.kind()",
    ),
    ("expression-not-assigned", "a if b else c()\n", "a if"),
    ("expression-not-assigned", "x.a() == 1\n", "x.a()"),
    ("expression-not-assigned", "[x.a() if b else c()]\n", "[x"),
    ("self-assigning-variable", "a = a\n", "a = "),
    ("self-assigning-variable", "a, b = a, b\n", "a, b"),
    ("self-assigning-variable", "a, b = b, a\na = a\n", "a = a"),
    ("undefined-variable", GLOBAL.replace("    global total\n", ""), "total)"),
    ("undefined-variable", GLOBAL.replace("total = 0", "totals = 0"), "total)"),
    ("undefined-variable", GLOBAL.replace("if __name__ == '__main__'", "def main()"), "total)"),
    ("expression-not-assigned", "[1, 2]\n", "["),
    ("expression-not-assigned", "[label for label in labels]\n", "["),
    ("expression-not-assigned", "speed(3) == 4\n", "speed"),
    ("unreachable", "    raise ValueError('never')\n    return 1\n", "return 1"),
    ("unreachable", "    if a:\n        raise NotImplementedError\n    return 0\n    return 1\n", "return 1"),
    ("trailing-comma-tuple", "a = 1,\n", "a"),
    ("trailing-comma-tuple", "a = f(1, 2),\n", "a"),
    ("trailing-comma-tuple", "a = '1, 2',\n", "a"),
    ("trailing-comma-tuple", "a = b[1, 2],  # so, so\n", "a"),
    ("no-self-argument", VALIDATED.replace("    @root_validator\n", ""), "def check"),
    ("no-self-argument", VALIDATED.replace("root_validator", "log").replace("cls", "values"), "def check"),
    ("no-self-argument", "def (:\n" + VALIDATED, "def check"),
    ("possibly-used-before-assignment", PLATFORMS.replace("sys.platform", "kind"), "path)"),
    ("possibly-used-before-assignment", "if a:\n    path = 1\n" + PLATFORMS, "path)"),
    ("possibly-used-before-assignment", "if sys.platform == 'linux':\n    path = 1\nuse(path)\n", "path)"),
    ("anomalous-backslash-in-string", "for k in d.items():\n    re.sub('\\(', k)\n", "'\\("),
    ("anomalous-backslash-in-string", "import six\nd.iteritems()\nre.sub('\\(', k)\n", "'\\("),
    (
        "anomalous-backslash-in-string",
        "try:\n    import urllib2\nexcept ImportError:\n    urllib2 = 1\nre.sub('\\(', k)\n",
        "'\\(",
    ),
    ("too-many-function-args", "shape(1, 2, 3)\n", "shape"),
    ("invalid-envvar-default", "RANK = os.getenv('RANK', -1)\n", "os.getenv"),
    ("invalid-envvar-default", "print(os.getenv('RANK', -1))\n", "os.getenv"),
    ("too-many-function-args", "a = f(\n    b.reshape(3, 3),\n    2)\n", "f("),
    ("too-many-function-args", "a = f(\n    2)\nb.reshape(3, 3)\n", "f("),
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
    ("no-value-for-parameter", "x = f(a * b)\n", "f("),
    ("no-value-for-parameter", "x = f(a, b ** c)\n", "f("),
    ("no-value-for-parameter", "x = f(1) + g(*a)\n", "f("),
    ("no-value-for-parameter", "x = f(g(*a))\n", "f("),
    ("pointless-statement", "def f(self):\n    self.s\n", "self.s\n"),
    ("pointless-statement", "a == b  # compare\n", "a"),
    ("pointless-statement", "if x:\n    rospy.spin\n", "rospy"),
    ("pointless-statement", "with open(x) as f:\n    f.close\n", "f.close"),
    ("pointless-statement", "with pytest.raises(A):\n    pass\nb.c\n", "b.c"),
    ("undefined-variable", "self.s  # prevent unused variable warning\n", "self"),
]
STANDS += [
    ("undefined-variable", COUNTED.replace("total = i", "totals = i"), "total += 1"),
    ("undefined-variable", COUNTED.replace("total += 1", "print(total + 1)"), "total + 1"),
    ("undefined-variable", "def f(vec):\n    total += 1\n    for i in vec:\n        total = i\n", "total += 1"),
    ("undefined-variable", "def f(vec):\n    for i in vec:\n        total += 1\n        total = i\n", "total += 1"),
    ("undefined-variable", "for i in v:\n    def g():\n        total = i\ntotal += 1\n", "total += 1"),
    ("undefined-variable", "for i in v:\n    total = i\n\ndef g():\n    total += 1\n", "total += 1"),
    ("undefined-variable", "def g():\n    total += 1\n", "total += 1"),
]


FALLBACK = "try:\n    import imp\nexcept {}:\n    import importlib as imp\n"
REFUTED += [
    *(
        ("deprecated-module", FALLBACK.format(each), "import imp")
        for each in ("ImportError", "(ImportError, OSError)", "ModuleNotFoundError as err", "Exception")
    ),
    ("deprecated-module", "try:\n    import imp\n\n# old\nexcept:\n    pass\n", "import imp"),
    ("deprecated-module", "try:\n    if x:\n        import imp\nexcept ImportError:\n    pass\n", "import imp"),
    ("deprecated-module", "try:\n    import a\nexcept ImportError:\n    import imp\n", "import imp"),
    (
        "deprecated-module",
        "def f():\n    try:\n        from imp import x\n    except ImportError:\n        x = 1\n",
        "from imp",
    ),
]
STANDS += [
    ("deprecated-module", "import imp\n", "import imp"),
    ("deprecated-module", "import imp\ntry:\n    import a\nexcept ImportError:\n    pass\n", "import imp"),
    ("deprecated-module", "try:\n    import imp\nexcept ValueError:\n    pass\n", "import imp"),
    ("deprecated-module", "try:\n    import imp\nfinally:\n    pass\n", "import imp"),
    ("deprecated-module", "if x:\n    import imp\nelse:\n    pass\n", "import imp"),
    ("deprecated-module", "try:\n    import a\nexcept ImportError:\n    pass\nelse:\n    import imp\n", "import imp"),
]


def refuted(rule: str, text: str, at: str) -> bool:
    before = text[: text.rindex(at)]
    return is_refuted(rule, before.count("\n") + 1, len(before) - before.rfind("\n") - 1, text)


DELETED = """def on_mode(data):
    global recorder, state
    if data.mode == 'stop':
        recorder.stop()
        del recorder
    elif state == 0:
        recorder = Recorder(data.file)

def on_change(data):
    global recorder
    recorder = Recorder(data.file, 'a')
"""
CHOSEN = "if source == 'a':\n    pos = 1\nelif source == 'b':\n    pos = 2\n\npos += 3\n"
REFUTED += [
    ("undefined-variable", CHOSEN, "pos += 3"),
    ("undefined-variable", CHOSEN.replace("elif source == 'b':\n    pos = 2\n", ""), "pos += 3"),
    ("undefined-variable", CHOSEN.replace("pos = 2", "(pos, x) = 2, 3"), "pos += 3"),
    ("undefined-variable", "try:\n    pos = int(a)\nexcept ValueError:\n    pass\npos -= 1\n", "pos -= 1"),
]
STANDS += [
    ("undefined-variable", "pos += 3\n" + CHOSEN.replace("pos += 3\n", ""), "pos += 3"),
    ("undefined-variable", CHOSEN.replace("pos = ", "pos += "), "pos += 3"),
    ("undefined-variable", CHOSEN.replace("pos += 3", "def f():\n    pos += 3"), "pos += 3"),
    ("undefined-variable", CHOSEN.replace("pos = ", "self.pos = "), "pos += 3"),
]
PRODUCT = "import numpy as np\n\ndef f(a, b):\n    length = np.inner(a, b)\n    return -length\n"
REFUTED += [
    ("invalid-unary-operand-type", PRODUCT, "-length"),
    ("invalid-unary-operand-type", PRODUCT.replace("inner", "vdot"), "-length"),
    ("invalid-unary-operand-type", "import numpy as np\nx = -np.inner(a, b)\n", "-np"),
    ("unsupported-assignment-operation", PRODUCT.replace("return -length", "length[0] = 1"), "length[0]"),
    ("invalid-sequence-index", PRODUCT.replace("return -length", "return length[1:, 2]"), "length[1"),
]
STANDS += [
    ("invalid-unary-operand-type", PRODUCT.replace("np.inner(a, b)", "(a, b)"), "-length"),
    ("invalid-unary-operand-type", PRODUCT.replace("return -length", "return -other"), "-other"),
    ("invalid-unary-operand-type", PRODUCT.replace("length = np.inner", "lengths = np.inner"), "-length"),
    ("invalid-unary-operand-type", PRODUCT.replace("np.inner(a, b)", "np.unravel_index(a, b)"), "-length"),
    (
        "invalid-unary-operand-type",
        PRODUCT.replace("    length", "    # length = np.inner(a, b)\n    length").replace(
            "= np.inner(a, b)\n    r", "= (a, b)\n    r"
        ),
        "-length",
    ),
]
STOP = "import numpy as np\n\ndef f(q):\n    if np.any(np.isnan(q)):\n        breakpoint()\n    return q\n"
REFUTED += [
    ("undefined-variable", DELETED, "recorder.stop"),
    (
        "undefined-variable",
        DELETED.replace("    elif state == 0:\n        recorder = Recorder(data.file)\n", ""),
        "recorder.stop",
    ),
    ("undefined-variable", DELETED.replace("    global recorder\n    recorder =", "    recorder ="), "recorder.stop"),
    ("forgotten-debug-statement", STOP, "breakpoint"),
    ("forgotten-debug-statement", STOP.replace("breakpoint", "print(q)\n        breakpoint"), "breakpoint"),
    ("forgotten-debug-statement", STOP.replace("breakpoint()", "breakpoint()  # for debugging"), "breakpoint"),
    (
        "forgotten-debug-statement",
        STOP.replace("    return", "    elif q:\n        pdb.set_trace()\n    return"),
        "pdb.set",
    ),
]
STANDS += [
    ("undefined-variable", DELETED.replace("        del recorder\n", ""), "recorder.stop"),
    (
        "undefined-variable",
        DELETED.replace("recorder = Recorder(data.file", "use(recorder"),
        "recorder.stop",
    ),
    ("undefined-variable", DELETED.replace("global recorder, state", "global state"), "recorder.stop"),
    ("undefined-variable", DELETED, "Recorder(data.file)"),
    ("forgotten-debug-statement", "def f(q):\n    breakpoint()\n    return q\n", "breakpoint"),
    (
        "forgotten-debug-statement",
        STOP.replace("        breakpoint()", "        q = 1\n        breakpoint()"),
        "breakpoint",
    ),
    ("forgotten-debug-statement", STOP.replace("breakpoint()", "import pdb; pdb.set_trace()"), "pdb.set"),
    ("forgotten-debug-statement", STOP.replace("breakpoint()", "breakpoint()\n        q = 1"), "breakpoint"),
    ("forgotten-debug-statement", STOP.replace("np.any(np.isnan(q))", "True"), "breakpoint"),
    (
        "forgotten-debug-statement",
        STOP.replace("    return q", "    else:\n        q = 1\n        breakpoint()"),
        "breakpoint",
    ),
    ("forgotten-debug-statement", "for q in v:\n    breakpoint()\n", "breakpoint"),
]


@pytest.mark.parametrize(("rule", "text", "at"), REFUTED)
def test_refuted(rule: str, text: str, at: str) -> None:
    assert refuted(rule, text, at)


#: A module, and whether its function of PEP 562 gives names.
LAZY = [
    ("def __getattr__(name):\n    if name == 'A':\n        return 1\n    raise AttributeError(name)\n", True),
    ("def __getattr__(name: str) -> Any:\n    return importlib.import_module(name)\n", True),
    ("__getattr__, __dir__, __all__ = lazy.attach(__name__, ['A'])\n", True),
    ("__getattr__ = make()\n", True),
    ("class B:\n    def __getattr__(self, name):\n        return 1\n", False),
    ("def f():\n    def __getattr__(name):\n        return 1\n", False),
    ("def __getattr__(name):\n    raise AttributeError(name)\n", False),
    ("def __getattr__(name):\n    return\n", False),
    ("def __getattribute__(name):\n    return 1\n", False),
    ("# def __getattr__(name): return 1\n", False),
    ("TEXT = 'def __getattr__(name): return 1'\n", False),
    ("print(b.__getattr__)\n", False),
    ("def __getattr__(name):\n    return (\n", False),
]


@pytest.mark.parametrize(("text", "expected"), LAZY)
def test_names_that_a_module_gives_when_they_are_asked_for(text: str, expected: bool) -> None:
    assert is_refuted("undefined-all-variable", 1, 11, "__all__ = ['A']\n" + text) is expected


@pytest.mark.parametrize(("rule", "text", "at"), STANDS)
def test_stands(rule: str, text: str, at: str) -> None:
    assert not refuted(rule, text, at)


@pytest.mark.parametrize("line", [0, 7, -1])
def test_a_line_that_is_not_there(line: int) -> None:
    assert not is_refuted("pointless-statement", line, 0, "a\n")
    assert not is_refuted("no-value-for-parameter", line, 0, "a\n")


@pytest.mark.parametrize(
    ("rule", "line", "expected"),
    [
        ("anomalous-backslash-in-string", "a = '\\d'  # noqa: E501, W605", True),
        ("anomalous-backslash-in-string", "a = '\\d'  # NOQA:W605", True),
        ("anomalous-backslash-in-string", "a = '\\d'  # type: ignore # noqa: W605 as meant", True),
        ("bare-except", "except:  # noqa: E722", True),
        ("wildcard-import", "from a import *  # noqa: F401,F403", True),
        ("anomalous-backslash-in-string", "a = '\\d'  # noqa: E501", False),
        ("anomalous-backslash-in-string", "a = '\\d'  # noqa", False),
        ("anomalous-backslash-in-string", "a = '\\d'  # W605 is meant", False),
        ("no-such-rule", "a = 1  # noqa: W605", False),
        ("anomalous-backslash-in-string", "a = '\\d' + '# noqa: W605'", False),
        ("anomalous-backslash-in-string", 'a = """\n# noqa: W605 """ + \'\\d\'', False),
    ],
)
def test_codes_of_other_tools_for_the_same(rule: str, line: str, expected: bool) -> None:
    assert is_silenced(rule, line, line.count("\n") + 1) is expected


@pytest.mark.parametrize(
    ("text", "line", "expected"),
    [
        ("def hook():\n    None\n", 2, True),
        ("def hook():\n    ...\n", 2, True),
        ("def hook(): ...\n", 1, True),
        ("class A:\n    async def hook(self):\n        None  # nothing to do\n", 3, True),
        ('def hook():\n    """Is called once."""\n    None\n', 3, True),
        ("def hook(\n    a,\n):\n    # nothing\n    None\n\nb = 1\n", 5, True),
        ("def hook():\n    a = 1\n    None\n", 3, False),
        ("def hook():\n    None\n    return 1\n", 2, False),
        ("if a:\n    None\n", 2, False),
        ("def hook():\n    if a:\n        None\n", 3, False),
        ("def hook():\n    a == None\n", 2, False),
        ("def hook():\n    a\n", 2, False),
        ("None\n", 1, False),
        ("def hook(:\n    None\n", 2, False),
    ],
)
def test_what_stands_for_pass(text: str, line: int, expected: bool) -> None:
    assert is_refuted("pointless-statement", line, 4, text) is expected
    assert is_refuted("expression-not-assigned", line, 4, text) is expected


#: The first line of a block, and whether what it calls wrongly is to fail there.
AWAITED = [
    ("with pytest.raises(TypeError):", True),
    ("with raises(TypeError, match='missing'):", True),
    ("with pytest.raises(expected_exception=TypeError):", True),
    ("with pytest.raises((ValueError, TypeError)) as told:", True),
    ("with pytest.raises(Exception):", True),
    ("with pytest.raises(errors.Refused):", True),
    ("with self.assertRaises(TypeError):", True),
    ("with self.assertRaisesRegex(TypeError, 'missing'):", True),
    ("with quiet(), pytest.raises(TypeError):", True),
    ("with pytest.raises(ValueError):", False),
    ("with self.assertRaises(KeyError):", False),
    ("with pytest.warns(UserWarning):", False),
    ("with open(raises):", False),
    ("if raises(TypeError):", False),
]


@pytest.mark.parametrize("rule", ["missing-kwoa", "no-value-for-parameter", "unexpected-keyword-arg"])
@pytest.mark.parametrize(("head", "expected"), AWAITED)
def test_a_call_that_a_test_expects_to_fail(rule: str, head: str, expected: bool) -> None:
    text = f"def test_it(self):\n    {head}\n        Moved(\n            name='a',\n        )\n    Moved()\n"
    text += "import pytest\nfrom pytest import raises\n"
    assert is_refuted(rule, 3, 8, text) is expected
    assert not is_refuted(rule, 6, 4, text)
    assert not is_refuted("no-member", 3, 8, text)


#: The block's first line, what else the file has, and whether ``raises`` is that of a test framework.
OWNERS = [
    ("with pt.raises(TypeError):", "import pytest as pt\n", True),
    ("with fails(TypeError):", "from pytest import raises as fails\n", False),
    ("with raises(TypeError):", "from nose.tools import raises\n", True),
    ("with assert_raises(TypeError):", "from numpy.testing import assert_raises\n", True),
    ("with np.testing.assert_raises(TypeError):", "import numpy as np\n", True),
    ("with testing.assert_raises(TypeError):", "from numpy import testing\n", True),
    ("with self.assertRaises(TypeError):", "", True),
    ("with cls.assertRaises(TypeError):", "", True),
    ("with raises(TypeError):", "", False),
    ("with raises(TypeError):", "# from pytest import raises\n", False),
    ("with raises(TypeError):", "from contextlib import nullcontext as raises\n", False),
    ("with raises(TypeError):", "from .pytest import raises\n", False),
    ("with raises(TypeError):", "from pytest import raises\nraises = quiet\n", False),
    ("with raises(TypeError):", "from pytest import raises\ndef raises(kind):\n    return quiet\n", False),
    ("with pytest.raises(TypeError):", "import tools as pytest\n", False),
    ("with pytest.raises(TypeError):", "class pytest:\n    raises = quiet\n", False),
    ("with self.raises(TypeError):", "", False),
    ("with self.assertRaises(TypeError):", "def assertRaises(self, kind):\n    return quiet\n", False),
    ("with arm.assertRaises(TypeError):", "", False),
]


@pytest.mark.parametrize(("head", "rest", "expected"), OWNERS)
def test_raises_is_that_of_a_test_framework(head: str, rest: str, expected: bool) -> None:
    text = f"def test_it(self):\n    {head}\n        Moved()\n{rest}"
    assert is_refuted("no-value-for-parameter", 3, 8, text) is expected


def test_a_lambda_that_a_test_expects_to_fail() -> None:
    text = (
        "def test_it(self):\n    self.assertRaises(TypeError, lambda: Moved())\n    self.assertRaises(kind(), Moved)\n"
    )
    assert is_refuted("too-many-function-args", 2, 41, text)
    assert not is_refuted("no-value-for-parameter", 3, 22, text)
    assert not is_refuted("missing-kwoa", 2, 4, text + "def (:\n")


RETURNED = "def f():\n    return 1\n    {}\n"
SUPER = "class T(Case):\n    def setUp(self):\n        self.it = A()\n        super({}).__init__(1)\n"
#: The rule, the file, what is at the place, and whether the file refutes it.
MEANT = [
    ("unreachable", RETURNED.format('"""Why."""'), '"""Why', True),
    ("unreachable", RETURNED.format("'''Why.\n\n    So.\n    '''\n    \"more\""), "'''Why", True),
    ("unreachable", "for a in b:\n    continue\n    'never'\nelse:\n    raise A\n    'so'\n", "'so'", True),
    ("unreachable", RETURNED.format("'a'\n    b = 1"), "'a'", False),
    ("unreachable", RETURNED.format("b = 'a'"), "b =", False),
    ("unreachable", RETURNED.format("f'{b()}'"), "f'{", False),
    ("unreachable", RETURNED.format("1"), "1\n", False),
    ("unreachable", "def (:\n" + RETURNED.format("'a'"), "'a'", False),
    ("too-many-format-args", "a = '{} and'.format(b, c)\n", "'{}", True),
    ("too-many-format-args", "log(u'äö', '{{{}}} and'.format(b, c))\n", "'{{", True),
    ("too-many-format-args", "a = (\n    'a {x!r}'\n    ' b'.format(b, x=c)\n)\n", "'a {", True),
    ("too-many-format-args", "a = '%s and' % (b, c)\n", "'%s", False),
    ("too-many-format-args", "a = '{} %s'.format(b) % (b, c)\n", "'{}", False),
    ("too-many-format-args", "a = 'and: '.format(b)\n", "'and", False),
    ("too-many-format-args", "a = 'and {{}}'.format(b)\n", "'and", False),
    ("too-few-format-args", "a = '{} and'.format(b, c)\n", "'{}", False),
    ("bad-super-call", SUPER.format("A, self.it"), "super", True),
    ("bad-super-call", SUPER.format("A, made()"), "super", True),
    ("bad-super-call", SUPER.format("A, self"), "super", False),
    ("bad-super-call", SUPER.format("type(self), self"), "super", False),
    ("bad-super-call", SUPER.format("A"), "super", False),
    ("bad-super-call", SUPER.format(""), "super", False),
    ("bad-super-call", "super(A, b).go()\n", "super", False),
    ("comparison-with-itself", "def f(a=float('nan')):\n    if a != a:\n        pass\n", "a != a", True),
    ("comparison-with-itself", "# of NaN\nb = [a for a in c if a.x[0] != a.x[0]]\n", "a.x[0] !=", True),
    ("comparison-with-itself", "b = np.nan\nif a == a:\n    pass\n", "a == a", False),
    ("comparison-with-itself", "b = np.nan\nif a < a:\n    pass\n", "a < a", False),
    ("comparison-with-itself", "if a != a:\n    pass\n", "a != a", False),
    ("nan-comparison", "a = np.nan\nif b:\n    a = b / c\nif a is np.nan:\n    pass\n", "a is", True),
    ("nan-comparison", "a = np.nan\nif a is not np.nan and b:\n    pass\n", "a is", True),
    ("nan-comparison", "def f(b, a=math.nan):\n    return a is math.nan\n", "a is", True),
    ("nan-comparison", "def f(b, *, c, a=np.nan):\n    return np.nan is a\n", "np.nan is", True),
    (
        "nan-comparison",
        "class A:\n    b = None\n    def f(self):\n        self.a = nan\n        return self.a is nan\n",
        "self.a is",
        True,
    ),
    ("nan-comparison", "a = [np.nan] * 3\nif a[0] is np.nan:\n    pass\n", "a[0] is", True),
    ("nan-comparison", "a = [1.0, np.nan]\nif a[0] is np.nan:\n    pass\n", "a[0] is", True),
    ("nan-comparison", "a = np.full(3, np.nan, dtype=object)\nif a[0] is np.nan:\n    pass\n", "a[0] is", True),
    ("nan-comparison", "a = np.full(3, np.nan)\nif a[0] is np.nan:\n    pass\n", "a[0] is", False),
    ("nan-comparison", "a = np.nan\nif a == np.nan:\n    pass\n", "a ==", False),
    ("invalid-character-zero-width-space", "def f():\n    '''\n    one\u200b\n    '''\n", "one", True),
    ("invalid-character-zero-width-space", '"one\u200b"\nx = 1\n', "one", True),
    ("invalid-character-zero-width-space", "x = '''\n    one\u200b\n    '''\n", "one", False),
    ("invalid-character-zero-width-space", 'node.advertise("one\u200b")\n', "one", False),
    ("nan-comparison", "a = np.nan\nif a is np.nan or b == np.nan:\n    pass\n", "a is", False),
    ("nan-comparison", "a = b / c\nif a is np.nan:\n    pass\n", "a is", False),
    ("nan-comparison", "def f(a, b=np.nan):\n    return a is np.nan\n", "a is", False),
    ("nan-comparison", "a = msg.ranges[0]\nif a is np.nan:\n    pass\n", "a is", False),
    ("nan-comparison", "a = np.nan\nif f(a) is np.nan:\n    pass\n", "f(a)", False),
    ("condition-evals-to-constant", "if a is None or True:\n    pass\n", "a is", True),
    ("condition-evals-to-constant", "if a and False:\n    pass\n", "a and", True),
    ("condition-evals-to-constant", "while True or a:\n    pass\n", "True", True),
    ("condition-evals-to-constant", "if 0 and a:  # or True\n    pass\n", "0 and", False),
    ("condition-evals-to-constant", "if a == 'b' or 'c':\n    pass\n", "a ==", False),
    ("condition-evals-to-constant", "if a or 1 == b:\n    pass\n", "a or", False),
    ("condition-evals-to-constant", "if a or []:\n    pass\n", "a or", False),
    ("comparison-with-itself", "banana = 1\nif a != a:\n    pass\n", "a != a", False),
]


@pytest.mark.parametrize(("rule", "text", "at", "expected"), MEANT)
def test_what_is_meant_or_does_no_harm(rule: str, text: str, at: str, expected: bool) -> None:
    assert refuted(rule, text, at) is expected


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("log('Connected to a ' 'service!')\n", True),
        ("log(\n    'Connected to a ' 'service!'\n)\n", True),
        ("log(f'Connected to {a} ' 'service!')\n", True),
        ("log(f'{a[\"b\"]} is ' f'there')\n", True),
        ("log('a b ' 'c', 'd')\n", False),
        ("log('a b ' 'c', end='')\n", False),
        ("x = ['a b ' 'c']\n", False),
        ("log(['a b ' 'c'])\n", False),
        ("join('a' 'b')\n", False),
        ("parser.add_argument('-f' '--file')\n", False),
        ("log('a b ' 'c'); x = ['d' 'e']\n", False),
        ("log('a b c')\n", False),
        ("log('a b c'\n", False),
        ("", False),
    ],
)
def test_one_text_in_two_literals(text: str, expected: bool) -> None:
    line = 2 if text.startswith("log(\n") else 1
    assert is_refuted("implicit-str-concat", line, 0, text) is expected


TWICE = "def make():\n    return later\n\n\ndef make():\n    return 1\n"


@pytest.mark.parametrize("rule", ["undefined-variable", "no-value-for-parameter", "not-callable"])
def test_what_a_function_does_that_is_defined_again(rule: str) -> None:
    assert is_refuted(rule, 2, 11, TWICE)


@pytest.mark.parametrize(
    ("rule", "line", "text"),
    [
        ("undefined-variable", 6, TWICE),
        ("function-redefined", 2, TWICE),
        ("unused-variable", 2, TWICE),
        ("undefined-variable", 2, TWICE.replace("\n\n\n", "\n\n\nmake()\n")),
        ("undefined-variable", 2, "@route\n" + TWICE),
    ],
)
def test_what_such_a_function_does_not_hide(rule: str, line: int, text: str) -> None:
    assert not is_refuted(rule, line, 11, text)


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("x = Arm.__new__(Arm)\n", True),
        ("x = arms.Arm.__new__(arms.Arm, 1)\n", True),
        ("x = Arm.__new__()\n", False),
        ("x = Arm.load(Arm)\n", False),
        ("x = Arm(Arm.__new__)\n", False),
        ("x = 1\n", False),
    ],
)
def test_objects_that_are_made_without_their_constructor(text: str, expected: bool) -> None:
    assert is_made_by_hand(text, 1, 4) is expected


ARRAYS = "import numpy as np\n\n\ndef f(names, m):\n    at = np.unravel_index(np.argmax(m), m.shape)\n    print({})\n"


@pytest.mark.parametrize(
    "use",
    [
        "names[at[0]]",
        "f'{names[at[0]]} of {len(names)}'",
        "names[np.argmax(m)]",
        "m[at]",
        "at[0, 2]",
        "np.dot(m, m)[0, 1:]",
    ],
)
def test_elements_of_arrays_as_an_index(use: str) -> None:
    assert is_refuted("invalid-sequence-index", 6, 10, ARRAYS.format(use))


@pytest.mark.parametrize(
    "text", ["names['a']", "names[1.5]", "at[names]", "names[0, 2]", "at['a']", "names[:]", "names", "[at]"]
)
def test_what_is_no_index_of_an_array(text: str) -> None:
    assert not is_refuted("invalid-sequence-index", 6, 10, ARRAYS.format(text))
    assert not is_refuted("invalid-sequence-index", 6, 10, ARRAYS.format("names[at[0]]").replace("numpy", "other"))


IMPORTED = "from tf.transformations import (\n    rotate,\n    turn,\n)\n{}\n\ndef rotate(axis):\n    return axis\n\n\nprint(rotate(1))\n"


def test_a_function_instead_of_an_import() -> None:
    """The import is not used before: the function alone is ever called."""
    assert is_refuted("function-redefined", 7, 0, IMPORTED.format(""))


@pytest.mark.parametrize(
    "text",
    [
        IMPORTED.format("x = rotate(2)"),
        IMPORTED.format("def other():\n    return rotate(2)"),
        IMPORTED.format("def rotate():\n    pass"),
        IMPORTED.format("").replace("    rotate,", "    rotate as spin,"),
        IMPORTED.format("").replace("def rotate(axis):\n    return axis", "class A:\n    def rotate(self): pass"),
        "def rotate():\n    pass\n\n\n\n\ndef rotate():\n    return 1\n",
    ],
)
def test_a_function_that_is_defined_twice(text: str) -> None:
    line = max(number for number, part in enumerate(text.split("\n"), 1) if "def rotate(" in part)
    assert not is_refuted("function-redefined", line, 0, text)


@pytest.mark.parametrize(
    ("first", "expected"),
    [("q", True), ("axis", True), ("self", False), ("cls", False), ("mcs", False), ("this", False)],
)
def test_an_assignment_to_what_is_no_object(first: str, expected: bool) -> None:
    text = f"class A:\n    def unit({first}):\n        {first} = {first} / 2\n"
    assert is_refuted("self-cls-assignment", 3, 8, text) is expected


ALL = "def f(a):\n    had = {}\n    for key in had:\n        {}\n    return had\n"


@pytest.mark.parametrize(
    ("made", "change", "expected"),
    [
        ("{'all': True, 'a': a}", "had['all'] = had['all'] and had[key]", True),
        ("{'all': 0, 'a': a}", "had['all'] += had[key]", True),
        ("{'a': a}", "had['all'] = had[key]", False),
        ("dict(a)", "had['all'] = had[key]", False),
        ("{'all': 0}\n    had = {}", "had['all'] = had[key]", False),
        ("{'all': 0}", "had[key + 'x'] = 1", False),
        ("{'all': 0}", "del had['all']", False),
        ("{'all': 0}", "had.pop('all')", False),
        ("{**a}", "had['all'] = 1", False),
    ],
)
def test_a_key_that_the_dictionary_has(made: str, change: str, expected: bool) -> None:
    """What is iterated over keeps its size if a key that is there gets another value."""
    text = ALL.replace("had = {}", f"had = {made}").replace("        {}", f"        {change}")
    line = next(number for number, part in enumerate(text.split("\n"), 1) if part.strip() == change)
    assert is_refuted("modified-iterating-dict", line, 8, text) is expected


@pytest.mark.parametrize("rule", ["modified-iterating-list", "modified-iterating-dict", "modified-iterating-set"])
@pytest.mark.parametrize(
    ("statement", "expected"),
    [
        ("del one", True),
        ("del one, other  # not needed", True),
        ("del (one)", True),
        ("del had[one]", False),
        ("del had.one", False),
        ("had.remove(one)", False),
    ],
)
def test_a_name_that_is_taken_away_is_no_change_to_what_is_iterated_over(
    rule: str, statement: str, expected: bool
) -> None:
    assert is_refuted(rule, 2, 4, f"for one in had:\n    {statement}\n") is expected


def test_functions_are_looked_through_once_for_all_names(monkeypatch: pytest.MonkeyPatch) -> None:
    text = "".join(f"def f{number}():\n    return missing\n\n" for number in range(30))
    walked = 0

    def counting(*arguments: object) -> object:
        nonlocal walked
        walked += 1
        return before(*arguments)  # type: ignore[arg-type]

    before = pylint_names.own_nodes
    monkeypatch.setattr(pylint_names, "own_nodes", counting)
    assert not any(pylint_names.is_deleted_global(text, 3 * number + 2, 11) for number in range(30))
    assert walked == 30
