# SPDX-License-Identifier: Apache-2.0
"""Asks a linter written in Python about texts that come through stdin, so that it opens no file of the workspace.

Run as a script in isolated mode: ``text_worker.py DIRECTORY TOOL``. The request is ``{"settings", "files": [{"path",
"name", "text"}]}``; each answer is a line ``{"path", "said": [[rule, line, column, message], …]}`` or ``{"path",
"problem"}``. One file's trouble never reaches the next.
"""

from __future__ import annotations

import io
import json
import sys
from collections.abc import Callable, Iterable
from contextlib import redirect_stdout
from pathlib import Path
from typing import Any

if not __package__:  # run as a script: haros_ci itself, also where it is not installed
    sys.path.append(str(Path(__file__).resolve().parents[2]))

from haros_ci.linters.metrics_worker import begin, cpu_limit, seconds_for

#: Rule, line and column (from 1, None or 0 for the whole file), message.
Said = tuple[str, int | None, int | None, str]
Check = Callable[[str, str], Iterable[Said]]


def yamllint(settings: Any) -> Check:
    """*settings* is a configuration without ``extends`` of a file, as yamllint reads it from YAML."""
    from yamllint import linter
    from yamllint.config import YamlLintConfig

    config = YamlLintConfig(content=json.dumps(settings))

    def check(name: str, text: str) -> Iterable[Said]:
        for problem in linter.run(text, config, name):
            message = problem.desc.removesuffix(" (syntax)")
            yield problem.rule or "syntax", problem.line, problem.column, message

    return check


def cmakelint(settings: Any) -> Check:
    """*settings*: ``lines`` of a .cmakelintrc, and ``length``, how long a line may be if they do not tell."""
    from cmakelint import main as tool

    state, messages = tool._lint_state, []
    state.SetLineLength(settings["length"])
    tool.ParseOptionFile(settings["lines"], False)
    filters = list(state.filters)

    def record(name: str, line: int, category: str, message: str) -> None:
        if tool.ShouldPrintError(category):
            messages.append((category, line, None, message))

    tool.Error = record
    tool.IsValidFile = lambda name: True

    def check(name: str, text: str) -> Iterable[Said]:
        messages.clear()
        state.filters = list(filters)  # a file's own pragma is for that file
        tool.open = lambda *_: io.StringIO(text, newline=None)
        tool.ProcessFile(name)
        return messages

    return check


def cmake_lint(settings: Any) -> Check:
    """*settings*: ``config``, a configuration as a map, or ``file``, the name of one that may be Python."""
    from cmakelang import configuration
    from cmakelang.format.__main__ import get_config
    from cmakelang.lint import __main__ as tool
    from cmakelang.lint import lint_util

    values = get_config(None, [settings["file"]]) if "file" in settings else settings["config"]
    config = configuration.Configuration(**values)

    def check(name: str, text: str) -> Iterable[Said]:
        context = lint_util.GlobalContext(None).get_file_ctx(name, config)
        tool.process_file(config, context, text)
        for record in context.get_lint():
            line, column, *_ = (*tuple(record.location or ()), None, None)
            yield record.spec.idstr, line, None if column is None else column + 1, " ".join(record.msg.split())

    return check


TOOLS: dict[str, Callable[[Any], Check]] = {"yamllint": yamllint, "cmakelint": cmakelint, "cmake-lint": cmake_lint}


def answer(check: Check, name: str, text: str) -> dict[str, Any]:
    """What the tool says of one text, or the problem that it has with it."""
    limit = seconds_for(len(text))
    try:
        with redirect_stdout(sys.stderr), cpu_limit(limit):
            return {"said": list(check(name, text))}
    except TimeoutError:
        return {"problem": f"not done within {limit:.0f} s"}
    except (RecursionError, MemoryError):
        return {"problem": "nested too deeply"}
    except Exception as error:  # a fault of the tool costs one file, not the run
        return {"problem": f"a fault of the tool ({type(error).__name__})"}


def main() -> None:
    begin()
    request = json.load(sys.stdin.buffer)
    check = TOOLS[sys.argv[2]](request["settings"])
    for file in request["files"]:
        reported = {"path": file["path"], **answer(check, file["name"], file["text"])}
        sys.stdout.write(json.dumps(reported) + "\n")


if __name__ == "__main__":
    main()
