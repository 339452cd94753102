# SPDX-License-Identifier: Apache-2.0
"""Reports of many shapes, written down as values, for the tests of every renderer."""

from __future__ import annotations

from dataclasses import replace

from haros_ci.model.location import Location
from haros_ci.results.result import (
    Artifact,
    Baseline,
    BaselineState,
    Coverage,
    Graph,
    Identity,
    Notification,
    Provenance,
    Related,
    Report,
    Result,
    Run,
    Suppression,
    Tool,
    Vertex,
)
from haros_ci.results.rule import Level, Rule

CPP = "base/src/odometry.cpp"
PY = "base/scripts/teleop.py"
SOURCES = {
    CPP: "#include <base/odometry.hpp>\n\nvoid Odometry::update()\n{\n\tdouble x = 0.0;\n  int *p = 0;\n  *p = 1;\n}\n",
    PY: "#!/usr/bin/env python3\nimport os\nimport sys\n\n\ndef main():\n    print('größe 漢字', undefined)\n",
}
CPPCHECK = Tool("cppcheck", "2.22", "https://cppcheck.sourceforge.io/", "Cppcheck")
PYLINT = Tool("pylint", "4.1.0", "https://pylint.readthedocs.io/")

NULL = Rule(
    "nullPointer",
    "Null pointer dereference",
    Level.ERROR,
    help="A pointer that is null is dereferenced.\n\nCheck it first.",
    help_uri="https://cppcheck.sourceforge.io/",
    tags=("bugs", "security"),
    cwe=(476,),
    security_severity="5.5",
)
SCOPE = Rule(
    "variableScope",
    "The scope of a variable can be reduced.",
    Level.NOTE,
    tags=("style",),
    deprecated_ids=("reduceScope",),
)
UNDEFINED = Rule("undefined-variable", "Name that is not defined", Level.ERROR, precision="very-high")

NULL_RESULT = Result(
    "cppcheck",
    "nullPointer",
    Level.ERROR,
    "Null pointer dereference: p",
    Location(CPP, 7, 4, 7, 5),
    related=(Related(Location(CPP, 6, 12), "Assignment 'p=0', assigned value is 0"),),
    scope="Odometry::update",
    identity=Identity(
        scope="Odometry::update",
        text="ab" * 8,
        template="Null pointer dereference: p",
        line_hash="5b2c1f0d9e8a7c66:1",
        snippet="  *p = 1;",
    ),
)
SCOPE_RESULT = Result(
    "cppcheck", "variableScope", Level.NOTE, "The scope of the variable 'x' can be reduced.", Location(CPP, 5, 9)
)
UNDEFINED_RESULT = Result(
    "pylint",
    "undefined-variable",
    Level.ERROR,
    "Undefined variable 'undefined'",
    Location(PY, 7, 23, 7, 32),
    scope="main",
    also=("ruff:F821",),
    identity=Identity(scope="main", line_hash="77aa:1", snippet="    print('größe 漢字', undefined)"),
)
WHOLE_FILE = Result("pylint", "missing-module-docstring", Level.NOTE, "Missing module docstring", Location(PY))

ARTIFACTS = (
    Artifact(CPP, "0f" * 32, 120, "cpp"),
    Artifact(PY, "1e" * 32, 90, "python"),
    Artifact("base/package.xml", "2d" * 32, 300, "package"),
)
CPPCHECK_RUN = Run(CPPCHECK, (NULL, SCOPE), (SCOPE_RESULT, NULL_RESULT), analysed=frozenset({CPP}))
PYLINT_RUN = Run(PYLINT, (UNDEFINED,), (UNDEFINED_RESULT, WHOLE_FILE), analysed=frozenset({PY}))
COVERAGE = Coverage(packages=1, files=3, lines=1500, unseen=("base/gen is generated when building.",))

EMPTY = Report(())
NO_RESULTS = Report((Run(CPPCHECK, (NULL,)),), coverage=COVERAGE)
PLAIN = Report(
    (CPPCHECK_RUN, PYLINT_RUN),
    coverage=COVERAGE,
    artifacts=ARTIFACTS,
    provenance=Provenance("https://github.com/acme/base", "c0ffee" * 6 + "beef", "main"),
)


def with_state(result: Result, state: BaselineState, reason: str = "") -> Result:
    return replace(result, state=state, reason=reason)


BASELINE = Baseline("file", ".haros-ci-baseline.jsonl")
COMPARED = replace(
    PLAIN,
    runs=(
        replace(
            CPPCHECK_RUN,
            results=(
                with_state(NULL_RESULT, BaselineState.NEW, "no finding of this rule stood in this function"),
                with_state(SCOPE_RESULT, BaselineState.UNCHANGED, "same line, same text"),
                replace(SCOPE_RESULT, location=Location(CPP, 3), state=BaselineState.ABSENT),
                replace(SCOPE_RESULT, location=Location(CPP, 4), state=BaselineState.UPDATED, value=12.0, limit=10.0),
            ),
        ),
        PYLINT_RUN,
    ),
    baseline=BASELINE,
)
SUPPRESSED = replace(
    PLAIN,
    runs=(
        replace(
            CPPCHECK_RUN,
            results=(
                NULL_RESULT,
                replace(
                    SCOPE_RESULT, suppressions=(Suppression("inSource", "Read by the debugger", Location(CPP, 5)),)
                ),
                replace(SCOPE_RESULT, location=Location(CPP, 6), suppressions=(Suppression("external"),)),
            ),
        ),
    ),
)
FAILED = replace(
    PLAIN,
    runs=(
        replace(
            CPPCHECK_RUN,
            successful=False,
            notifications=(Notification(Level.ERROR, "timed out after 600 s", "cppcheck"),),
        ),
        Run(Tool("clang-tidy"), successful=False),
        replace(PYLINT_RUN, notifications=(Notification(Level.WARNING, "syntax error", "pylint", PY, 3),)),
    ),
    notifications=(
        Notification(Level.WARNING, "not UTF-8, read as Latin-1", path="base/src/umlaut.cpp"),
        Notification(Level.NOTE, ".haros-ci.yaml:3: 'cpplint' has no effect.", configuration=True),
    ),
    baseline=Baseline("revision", "origin/main", available=False, message="the clone is shallow"),
)
IMPORTED = replace(
    PLAIN,
    runs=(
        CPPCHECK_RUN,
        Run(
            Tool("cppcheck", "", "not an address", ""),
            (Rule("A/b", "", help="<b>*bold*</b> @team"), Rule("C0114", "Docstring", help_uri="javascript:alert(1)")),
            (
                Result("cppcheck", "A/b", Level.WARNING, "f", Location("x.cpp", 1)),
                replace(NULL_RESULT, rule="unheard-of"),
            ),
            imported=True,
        ),
        Run(Tool("A Tool With Many Words", "v1"), imported=True),
    ),
)

MISMATCH = Rule(
    "topic-type-mismatch", "Both ends of a topic have one type.", Level.ERROR, aliases=("G06",), catalogue="G06"
)
LAUNCH = "base/launch/base.launch"
ODOM_EDGES = (("node:/base", "topic:/odom"), ("topic:/odom", "node:/teleop"))
MISMATCH_RESULT = Result(
    "haros-ci",
    "topic-type-mismatch",
    Level.ERROR,
    "/teleop subscribes to /odom as Pose, but /base publishes Odometry",
    Location(PY, 6, 1),
    related=(Related(Location(CPP, 5, 2), "/base publishes Odometry"),),
    subject=("/base", "/odom", "/teleop"),
    roles=("publishers base/base", "subscribers base/teleop"),
    flow=(
        Related(Location(LAUNCH, 3), "starts /base"),
        Related(Location(LAUNCH, 4), "remaps odom to /odom"),
        Related(Location(PY, 6, 1), "subscribes to odom"),
    ),
    graph="base/launch/base.launch",
    edges=ODOM_EDGES,
    identity=Identity(text="cd" * 8, template="'_' subscribes", names="12" * 8, roles="34" * 8),
)
ODOM_GRAPH = Graph(
    "base/launch/base.launch",
    (
        Vertex("node:/base", "/base", "node", Location(LAUNCH, 3)),
        Vertex("node:/teleop", "/teleop", "node", Location(LAUNCH, 4)),
        Vertex("topic:/cmd_vel", "/cmd_vel", "topic"),
        Vertex("topic:/odom", "/odom", "topic"),
    ),
    (("node:/teleop", "topic:/cmd_vel"), ("topic:/cmd_vel", "node:/base"), *ODOM_EDGES),
)
OWN_RUN = Run(
    Tool("haros-ci", "0.1.0", "https://github.com/haros-ci/haros-ci"),
    (MISMATCH,),
    (MISMATCH_RESULT,),
    analysed=frozenset({CPP, PY}),
    graphs=(ODOM_GRAPH, Graph("base/launch/unused.launch", (Vertex("node:/n", "/n", "node"),))),
)
ARCHITECTURE = replace(PLAIN, runs=(OWN_RUN, PYLINT_RUN))

#: Names and texts that attack a terminal, a workflow command, Markdown or a reader.
HOSTILE = (
    "a\n::error file=x::owned",
    "\x1b]52;c;cm0gLXJm\x07\x1b[2J",
    "\u202egnp.exe\u2066",
    "%0A::set-output name=x::y",
    "a|b | c\r\n| d",
    "ping @acme/team @root",
    "<img src=x onerror=alert(1)><!-- -->",
    "[click](https://evil.example) ![i](http://evil.example/p.png) www.evil.example",
    "`` ` code `` **bold** $x$ # head",
    "file:a,b=c",
    "caf\udce9\x85\u2028",
)


def hostile(text: str) -> Report:
    """A report that says *text* wherever foreign text can stand."""
    rule = Rule(
        text, text, Level.ERROR, help=text, help_uri=text, tags=(text,), aliases=(text,), deprecated_ids=(text,),
        catalogue=text,
    )  # fmt: skip
    place = Location(f"src/{text}", 3, 2)
    result = Result(
        text,
        text,
        Level.ERROR,
        text,
        place,
        related=(Related(place, text),),
        scope=text,
        subject=(text,),
        roles=(text,),
        flow=(Related(place, text), Related(place, f"{text} "), Related(place, text)),
        graph=text,
        edges=((text, f"topic:{text}"),),
        also=(text,),
        reason=text,
        identity=Identity(scope=text, snippet=text),
        state=BaselineState.NEW,
    )
    old = replace(result, state=BaselineState.UNCHANGED, suppressions=(Suppression("inSource", text, place),))
    ends = (Vertex(text, text, text, place), Vertex(f"topic:{text}", text, text))
    graph = Graph(text, ends, ((text, f"topic:{text}"),))
    notes = (
        Notification(Level.ERROR, text, text, place.path, 1),
        Notification(Level.WARNING, text, configuration=True),
    )
    run = Run(Tool(text, text, text, text), (rule,), (result, old), notes, frozenset({place.path}), successful=False)
    return Report(
        (replace(run, graphs=(graph,)),),
        notifications=(Notification(Level.WARNING, text, path=place.path),),
        baseline=Baseline("revision", text, available=False, message=text),
        coverage=Coverage(1, 1, 1, 1, (text,)),
        artifacts=(Artifact(place.path, "ab" * 32, 1, text),),
        provenance=Provenance(text, text, text),
    )


SHAPES = {
    "empty": EMPTY,
    "no_results": NO_RESULTS,
    "plain": PLAIN,
    "compared": COMPARED,
    "suppressed": SUPPRESSED,
    "failed": FAILED,
    "imported": IMPORTED,
    "architecture": ARCHITECTURE,
}
