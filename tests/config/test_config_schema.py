# SPDX-License-Identifier: Apache-2.0
"""The schema for editors says what the loader does."""

from __future__ import annotations

import json
import re
from functools import cache
from pathlib import Path
from typing import Any

import pytest

import haros_ci.config
from haros_ci import PROJECT_URL
from haros_ci.config import access, exemptions, on_violation, project, shapes
from haros_ci.config.declared import EXEC_KEYS
from haros_ci.config.haros import CONFIGURATION_KEYS, IGNORE_KEYS
from haros_ci.config.project import read_project
from haros_ci.config.settings import PROFILES, Settings
from haros_ci.config.yaml_lines import parse, plain
from haros_ci.errors import UserError
from haros_ci.model.api import ENTRY_KEYS, ENTRY_KINDS, ROW_KEYS
from haros_ci.model.declared_tool import OUTPUTS, PARTS, STREAMS
from haros_ci.model.package import LANGUAGES
from haros_ci.results.linear_regex import MAX_PATTERN

SCHEMA: dict[str, Any] = json.loads((Path(haros_ci.config.__file__).parent / "schema.json").read_text(encoding="utf-8"))
DEFS = SCHEMA["$defs"]


def test_the_same_keys() -> None:
    assert set(SCHEMA["properties"]) == set(project.KNOWN_KEYS)
    assert set(DEFS["perPath"]["properties"]) == {"profile", *project.POLICY_KEYS}
    assert set(DEFS["linter"]["properties"]) == {*project.LINTER_KEYS, *EXEC_KEYS}
    assert set(DEFS["linter"]["else"]["properties"]) == set(project.LINTER_KEYS)
    assert set(DEFS["linter"]["properties"]["fields"]["properties"]) == {"results", *PARTS}
    assert set(DEFS["exception"]["properties"]) == set(exemptions.KEYS)
    assert set(SCHEMA["properties"]["analysis"]["properties"]["ignore"]["properties"]) == set(IGNORE_KEYS)
    configuration = SCHEMA["properties"]["configurations"]["additionalProperties"]["anyOf"][1]
    assert set(configuration["properties"]) == set(CONFIGURATION_KEYS)
    assert set(SCHEMA["properties"]["access"]["properties"]) == set(access.KEYS)
    assert set(DEFS["onViolation"]["properties"]) == set(on_violation.KEYS)
    assert DEFS["onViolation"]["properties"]["log"]["enum"] == list(on_violation.LEVELS)
    row = DEFS["apiRow"]["properties"]
    assert set(row) == set(ROW_KEYS)
    assert set(row["makes"]["items"]["properties"]) == set(ENTRY_KEYS)


def test_the_same_words_and_limits() -> None:
    assert DEFS["apiRow"]["properties"]["makes"]["items"]["properties"]["kind"]["enum"] == list(ENTRY_KINDS)
    assert DEFS["template"]["maxLength"] == DEFS["apiName"]["maxLength"] == project.MAX_ROW_TEXT
    assert SCHEMA["properties"]["apis"]["maxItems"] == shapes.MAX_ENTRIES
    assert DEFS["profile"]["enum"] == list(PROFILES)
    linter = DEFS["linter"]["properties"]
    assert linter["languages"]["items"]["enum"] == list(LANGUAGES)
    assert set(linter["output"]["enum"]) - {None} == set(OUTPUTS) and set(linter["stream"]["enum"]) - {None} == set(
        STREAMS
    )
    assert SCHEMA["properties"]["exceptions"]["maxItems"] == exemptions.MAX_EXEMPTIONS
    assert linter["pattern"]["maxLength"] == DEFS["exception"]["properties"]["message"]["maxLength"] == MAX_PATTERN
    assert set(DEFS["levels"]["additionalProperties"]["enum"]) - {False, None} == set(project.LEVELS)
    assert set(SCHEMA["properties"]["fail-on"]["enum"]) - {None} == set(project.FAIL_ON)
    assert DEFS["selectors"]["maxItems"] == DEFS["texts"]["maxItems"] == shapes.MAX_ENTRIES
    defaults = Settings(root=Path("/"))
    for key, value in (("max-file-size", defaults.max_file_size), ("profile", defaults.profile)):
        assert re.search(rf"Default: {value}\.", SCHEMA["properties"][key]["description"])
    assert f"Default: {defaults.linter_timeout:.0f}." in DEFS["linter"]["properties"]["timeout"]["description"]
    assert SCHEMA["$id"].startswith(PROJECT_URL)


VALID = [
    "configurations: {a: {launch: [p/x.launch], hpl: {on_violation: {'*': [{log: warn}], a: [{publish: /b, type: }, {call: /c, type: d/E}]}}}}",
    "configurations: {a: {launch: [p/x.launch], hpl: {on_violation: }}, b: {launch: [p/x.launch], hpl: [a]}}",
    "",
    "profile: strict",
    "profile:\nselect:\nlevels:\nper-path:\nexclude:\nlinters:\nfail-on:\nanalysis:\nconfigurations:",
    "select: [pylint, 'cpplint:build/*']\nignore: [formatting]",
    "levels: {a: off, b: 'off', c: error}",
    "per-path: {'test/**, doc': {profile: all, select: [a], ignore: [b], levels: {c: note}}, x: }",
    "per-package: {a: strict, 'b, c*': {ignore: [x], levels: {y: off}}, d: }",
    "exceptions: [{files: [a]}, {packages: ['b*'], rules: [c], message: '^d', reason: e}]\nper-package:",
    "exceptions:",
    "linters: {t: {exec: [t, '{files}'], languages: [cpp], enabled: false, timeout: 3}}",
    "linters: {t: {exec: [t], files: ['*.c'], reads: [.t], output: regex, pattern: '(?P<path>a)(?P<message>b)'}}",
    "linters: {t: {exec: [t], files: [a], output: json, fields: {results: a.*, end-line: b}, stream: both, exit: 3}}",
    "linters: {t: {exec: [t], files: [a], levels: {E: error, '*': off}, exit: [0, 255]}, u: {exec: [u], files: [a], exit: any}}",
    "exclude: [third_party, './a', /build, '!a/b', 'b/**', '..a', 'a..b']",
    "linters: {ruff: true, pylint: {enabled: false, timeout: 1.5, arguments: [-v]}, radon: }",
    "fail-on: never\nmax-file-size: 10\ncompile-database: build\nbaseline: a.jsonl\nplugins: [mine]",
    "project: x\npackages: [a, 1]\nanalysis: {ignore: {tags: x, rules: [y], metrics: [ploc], files: ['*']}}",
    "configurations: {a: [p/x.launch], b: {launch: [p/y.launch], hints: {}}}\nnodes: {p/x: {hpl: {}}, p/y: }",
    "configurations: {a: {launch: [p/x.launch], args: {a: b, c: 1, d: 1.5, e: true}, environment: {HOME: /h}}}",
    "configurations: {a: {launch: [p/x.launch], hints: , hpl: , user_data: , args: , environment: }}",
    "apis: []\nknown_nodes: {}",
    "apis:\nknown_nodes:",
    "apis: [{call: a, args: [1, 2], when: {1: x}, sets: {1: '{parameter}'}, makes: [{kind: getters, value: 1}]}]",
    "apis: [{class: a::B, bases: [c::D], entry: [onInit]}, {call: a, transparent: '{0}'}, {call: b, returns: c}]",
    "apis: [{call: a, calls: ['0'], fills: {topic: '{0}'}, makes: [{kind: servers, latched: true, implicit: true}]}]",
    "known_nodes: {p: {n: {publishers: [{name: a, type: b/C}]}}, q: }",
    "rules: {a: {name: n, description: d, tags: [t], query: q}}",
    "access:",
    "access: {groups: {g: [/a]}, publish: {/*/a: ['@g', p/n], /**: []}, subscribe: , call: {}, serve: {/a/b.c: [/**]}}",
    "repositories: {a: {type: git, url: u, version: v, packages: [p]}}",
    "workspace: /x\nenvironment: copy\nplugin_blacklist: [radon]\ncpp: {parser_lib: x}",
]
INVALID = [
    "configurations: {a: {launch: [p/x.launch], hpl: {on_violation: [a]}}}",
    "configurations: {a: {launch: [p/x.launch], hpl: {on_violation: {a: {log: warn}}}}}",
    "configurations: {a: {launch: [p/x.launch], hpl: {on_violation: {a: [{log: loud}]}}}}",
    "configurations: {a: {launch: [p/x.launch], hpl: {on_violation: {a: [{publish: b}]}}}}",
    "configurations: {a: {launch: [p/x.launch], hpl: {on_violation: {a: [{publish: /b, rate: 3}]}}}}",
    "access: [a]",
    "access: {publsh: {}}",
    "access: {publish: {a: []}}",
    "access: {publish: {/a: /b}}",
    "access: {publish: {/a: }}",
    "access: {publish: {/a: [1]}}",
    "exlude: [a]",
    "[a]",
    "profile: roz",
    "profile: 3",
    "select: a",
    "select: [1]",
    "ignore: ['']",
    "levels: [a]",
    "levels: {a: errors}",
    "levels: {a: true}",
    "per-path: [a]",
    "per-path: {a: [b]}",
    "per-path: {a: {ignored: [b]}}",
    "per-path: {'!a': {}}",
    "per-path: {'a, ../b': {}}",
    "exclude: a",
    "exclude: [../a]",
    "exclude: [a/../b]",
    "exclude: ['./']",
    "linters: [a]",
    "linters: {a: text}",
    "linters: {a: {time: 1}}",
    "linters: {a: {timeout: 0}}",
    "linters: {a: {timeout: long}}",
    "linters: {a: {enabled: 1}}",
    "linters: {a: {arguments: -v}}",
    "per-package: [a]",
    "per-package: {a: strikt}",
    "per-package: {a: {ignored: [b]}}",
    "per-package: {' , ': strict}",
    "exceptions: {files: [a]}",
    "exceptions: [{}]",
    "exceptions: [{reason: a}]",
    "exceptions: [{files: []}]",
    "exceptions: [{file: [a]}]",
    "exceptions: [{message: [a]}]",
    "linters: {t: {exec: t, files: [a]}}",
    "linters: {t: {exec: [], files: [a]}}",
    "linters: {t: {exec: [t]}}",
    "linters: {t: {exec: [t], languages: [c]}}",
    "linters: {t: {exec: [t], files: [a], output: text}}",
    "linters: {t: {exec: [t], files: [a], output: regex}}",
    "linters: {t: {exec: [t], files: [a], output: json, fields: {file: a}}}",
    "linters: {t: {exec: [t], files: [a], arguments: [-v]}}",
    "linters: {t: {exec: [t], files: [a], exit: [256]}}",
    "linters: {t: {exec: [t], files: [a], exit: all}}",
    "linters: {t: {files: [a]}}",
    "fail-on: warnings",
    "max-file-size: 0",
    "max-file-size: 1.5",
    "max-file-size: true",
    "compile-database: [a]",
    "baseline: ' '",
    "plugins: a",
    "packages: [[a]]",
    "configurations: {a: {hints: {}}}",
    "configurations: {a: [x]}",
    "configurations: {a: {launch: [p/x], hint: {}}}",
    "configurations: {a: {launch: [p/x], hints: [b]}}",
    "configurations: {a: {launch: [p/x], args: [b]}}",
    "configurations: {a: {launch: [p/x], args: {b: }}}",
    "configurations: {a: {launch: [p/x], args: {b: [c]}}}",
    "configurations: {a: {launch: [p/x], environment: {B: {c: d}}}}",
    "configurations: {a: {launch: [p/x], environment: copy}}",
    "nodes: {a: {b: c}}",
    "apis: {call: a}",
    "apis: [a]",
    "apis: [null]",
    "apis: [{}]",
    "apis: [{call: }]",
    "apis: [{call: a, class: b}]",
    "apis: [{call: a, return: b}]",
    "apis: [{call: a, args: 1}]",
    "apis: [{call: a, args: ['1']}]",
    "apis: [{call: a, makes: {kind: publishers}}]",
    "apis: [{call: a, makes: [{name: b}]}]",
    "apis: [{call: a, makes: [{kind: publisher}]}]",
    "apis: [{call: a, makes: [{kind: publishers, name: {0}}]}]",
    "apis: [{call: a, makes: [{kind: timer, period: 0.5}]}]",
    "apis: [{call: a, makes: [{kind: publishers, topic: b}]}]",
    "known_nodes: [a]",
    "known_nodes: a",
    "rules: {a: {name: n}}",
    "repositories: {a: {type: git}}",
    "analysis: {ignored: {}}",
    "analysis: {ignore: {tag: []}}",
    "analysis: {ignore: {tags: [[a]]}}",
]


@pytest.mark.parametrize("text", VALID)
def test_valid_in_both(text: str) -> None:
    read_project(text.encode(), ".haros-ci.yaml")
    assert not faults(text)


@pytest.mark.parametrize("text", INVALID)
def test_invalid_in_both(text: str) -> None:
    with pytest.raises(UserError):
        read_project(text.encode(), ".haros-ci.yaml")
    assert faults(text)


def faults(text: str) -> list[str]:
    """What a JSON Schema validator says of *text*."""
    top = parse(text.encode(), "f").top
    data = None if top is None else plain(top)
    return [error.message for error in validator().iter_errors(data)]


@cache
def validator() -> Any:
    """One for all texts; the schema itself is checked first."""
    jsonschema = pytest.importorskip("jsonschema")
    jsonschema.Draft202012Validator.check_schema(SCHEMA)
    return jsonschema.Draft202012Validator(SCHEMA)
