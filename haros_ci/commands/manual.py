# SPDX-License-Identifier: Apache-2.0
"""Help that reads like a manual page: options by what they are about, and examples, for every command."""

from __future__ import annotations

from collections.abc import Mapping

import click

EXIT_CODES = """
\b
Exit codes:
  0    clean, or nothing new
  1    a new, unsuppressed result at or above --fail-on
  2    wrong usage or configuration; a base revision that cannot be had, unless --no-require-baseline
  3    a tool was missing, crashed or timed out; no baseline under --require-baseline; an output could not be written
  130  interrupted; 128+N where signal N ended it: 129 SIGHUP, 131 SIGQUIT, 143 SIGTERM

\b
Environment:
  HAROS_CI_CACHE       directory of the cache, if --cache-dir is not given
  HAROS_CI_PLUGINS     plug-ins, separated by commas, before those of --plugin
  HAROS_CI_SANDBOX     off: linters run without the sandbox of the kernel
  HAROS_CI_DEBUG       show the traceback of an error in haros-ci
  NO_COLOR             no colours
  COLUMNS              width of the text format
  TMPDIR               where temporary files lie (otherwise /dev/shm for a small workspace, or /tmp)
  GITHUB_STEP_SUMMARY  where the format github writes the job summary

\b
Files:
  .haros-ci.yaml             the project file, else haros.yaml; the first found counts
  .haros-ci-baseline.jsonl   known findings, as haros-ci baseline create writes them

Every command has a --help of its own. The pages: https://github.com/haros-ci/haros-ci/tree/main/docs
"""

#: The section that an option stands in, by its first name; what is named nowhere stands under Options.
SECTIONS: Mapping[str, tuple[str, ...]] = {
    "What is looked at": ("--project", "--isolated", "--exclude", "--compile-database", "--stdin-filename", "--configuration", "--launch", "--arg", "--env", "--path", "--no-known-nodes", "--as-running", "--exact"),
    "What is reported": ("--profile", "--tool", "--select", "--ignore", "--import", "--metric", "--level", "--scope", "--expect", "--non-finite", "--patience", "--check-readme", "--coverage", "--rates", "--dependence", "--affects", "--caused-by", "--observed"),
    "What is known already": ("--baseline", "--baseline-rev", "--base", "--no-baseline", "--require-baseline", "--file", "--accept-new", "--force"),
    "What comes out": (
        "--output", "--format", "--sarif-for", "--why", "--statistics", "--show-settings", "--fail-on", "--allow-tool-failure",
        "--exit-code", "--fail-on-match", "--fix", "--diff", "--watch", "--json", "--checks", "--standards", "--quiet", "--worst", "--full", "--enabled",
    ),
    "How it runs": (
        "--run", "--examples", "--jobs", "--verbose", "--plugin", "--plugin-whitelist", "--plugin-blacklist", "--plugin-export", "--trust-config", "--cache-dir", "--no-cache", "--timings",
        "--shard", "--shard-costs", "--write-costs",
    ),
}  # fmt: skip

#: Examples by command: what it does, and how it is said.
EXAMPLES: Mapping[str, tuple[tuple[str, str], ...]] = {
    "check": (
        ("everything below here", "haros-ci check ."),
        (
            "what a branch makes new, as GitHub annotations and a log",
            "haros-ci check . --baseline-rev origin/main --output github --output sarif=haros-ci.sarif",
        ),
        (
            "defects only, and two rules besides",
            "haros-ci check . --profile bugs-only --select pylint:unused-import,topic-type-mismatch",
        ),
        ("the nodes and topics alone, without linters", "haros-ci check . --profile architecture"),
        ("what could be mended, then mend it", "haros-ci check . --diff && haros-ci check . --fix"),
        ("a linter that only runs if asked for", "haros-ci check . --select flake8"),
        ("what each change of a file makes new", "haros-ci check . --watch"),
        ("what an editor has not saved yet", "haros-ci check - --stdin-filename src/arm.cpp --quiet < buffer"),
        ("the second of three parts, for haros-ci merge", "haros-ci check . --shard 2/3 --output shard=2.shard.jsonl"),
    ),
    "baseline create": (
        ("make today's findings known", "haros-ci baseline create && git add .haros-ci-baseline.jsonl"),
    ),
    "baseline update": (("follow code that has moved; new findings stay new", "haros-ci baseline update"),),
    "baseline prune": (("forget what is mended", "haros-ci baseline prune"),),
    "baseline show": (("what is known", "haros-ci baseline show"),),
    "model": (
        ("the running systems, in words", "haros-ci model"),
        (
            "one launch file with an argument, as a picture",
            "haros-ci model --launch robot/launch/robot.launch.xml --arg sim:=true --format dot | dot -Tsvg",
        ),
        (
            "a picture for a README",
            "haros-ci model --launch robot/launch/robot.launch.xml --format svg --output robot.svg",
        ),
        ("for other tools", "haros-ci model --format json --output model.json"),
        ("which calls of ROS APIs are not in the model", "haros-ci model --coverage"),
    ),
    "query": (
        ("topics with more than one publisher", 'haros-ci query "topics[len(self.publishers) > 1]"'),
        (
            "fail if a node subscribes to a global name",
            'haros-ci query --fail-on-match "nodes/subscribers[self.rosname.is_global]"',
        ),
    ),
    "report": (
        ("everything in one file, to open in a browser", "haros-ci report"),
        ("what a branch changes", "haros-ci report --base origin/main --output change.html"),
        ("the nodes and topics alone, without linters", "haros-ci report --profile architecture"),
    ),
    "diff": (
        ("what this branch does to the system", "haros-ci diff origin/main --merge-base"),
        ("between two tags, for a changelog", "haros-ci diff 1.0.0 1.1.0 --format markdown"),
    ),
    "metrics": (
        ("the twenty worst, and nothing else", "haros-ci metrics --worst 20 --quiet"),
        ("packages and files at a glance", "haros-ci metrics --level package --level file"),
        ("every value for a spreadsheet", "haros-ci metrics --format csv --output metrics.csv"),
        ("how many paths each function has", "haros-ci metrics --metric static-path-count --level function"),
    ),
    "policy": (
        (
            "allow what the nodes do, and nothing else",
            "haros-ci policy robot/launch/robot.launch.xml --output robot.policy.xml",
        ),
    ),
    "hpl": (
        ("the properties of a file, about all systems", "haros-ci hpl robot/hpl/robot.hpl"),
        ("those of one node", "haros-ci hpl robot/hpl/driver.hpl --node robot/driver"),
        ("those of a project file, as SARIF", "haros-ci hpl haros.yaml --output sarif=hpl.sarif"),
    ),
    "monitor": (
        ("the properties of a configuration", "haros-ci monitor --bag run.bag --configuration robot"),
        (
            "one property, not in any project file",
            "haros-ci monitor --jsonl run.jsonl --property 'globally: no /error'",
        ),
        ("findings for code scanning", "haros-ci monitor --bag run --output sarif=monitor.sarif"),
        ("a program that does it while the system runs", "haros-ci monitor --generate monitors --configuration robot"),
        ("what ROSMonitoring records for it", "haros-ci monitor --export rosmonitoring=monitor.yaml"),
    ),
    "testgen": (
        ("tests for the team's repository", "haros-ci testgen robot/test/properties --configuration robot"),
        (
            "and run them, in the environment of the built workspace",
            "haros-ci testgen /tmp/tests --configuration robot --run",
        ),
    ),
    "verify": (
        ("the properties of a configuration", "haros-ci verify --configuration robot"),
        ("with messages that take up to 20 ms", "haros-ci verify --network async --latency 20"),
        ("a question, not in any project file", "haros-ci verify --property 'globally: no /cmd_vel {linear.x > 1.0}'"),
        (
            "counterexamples that the monitor replays",
            "haros-ci verify --traces found",
        ),
    ),
    "rules": (
        ("what is on in a profile", "haros-ci rules --profile strict --enabled"),
        ("rules of one tool, by a part of the name", "haros-ci rules undeclared --tool haros-ci"),
    ),
    "explain": (
        ("a rule by its id, its number in docs/checks.md, or its name in HAROS", "haros-ci explain G06"),
        ("the whole page, with all examples", "haros-ci explain topic-type-mismatch --full"),
    ),
    "init": (("see first what would be written", "haros-ci init --dry-run"),),
    "merge": (
        (
            "one log of three parts",
            "haros-ci merge 1.shard.jsonl 2.shard.jsonl 3.shard.jsonl --output sarif=haros-ci.sarif",
        ),
    ),
    "new-check": (("begin a check, here of names of topics", "haros-ci new-check topic-without-namespace"),),
    "cache": (("how much there is", "haros-ci cache stats"),),
    "completion": (("for this shell, now", "source <(haros-ci completion bash)"),),
}


#: What a command's first sentence does not say.
ABOUT: Mapping[str, str] = {
    "check": """
PATHS are files and directories of one workspace: a package, a repository of packages, or a colcon or catkin workspace; paths in the
output are relative to the git repository that they lie in. Given files are reported on alone, but seen with all the rest.
A single - is the text of one file from standard input, as an editor has it, which need not be on disk (docs/editors.md).

Linters, metrics and checks run side by side; what has not changed since the last run comes from the cache. Comments in the code
(haros: ignore[RULE] reason) and exceptions of the project file set findings aside, a baseline those that are known; the others
are new, and fail the run at or above --fail-on.

On a pull request give --baseline-rev: project file and baseline then are the base revision's, so that a change cannot silence itself.
""",
    "baseline update": """
Known findings that have moved or changed are followed as --why of haros-ci check tells it. New ones are not made known without
--accept-new.
""",
    "model": """
Every launch file that no other includes is a configuration, and so is every node that no launch file starts; launch files of tests
are none (below test/, named test_…, in packages named …_test). What cannot be known is shown as ?, with the reason. docs/model.md describes the formats.
""",
    "diff": """
BASE and HEAD are git revisions. Nothing is checked out. The job summary of the action holds the same text for a pull request.
""",
    "hpl": """
A project file (YAML) says itself what its properties are about; those of other files are about the configurations and nodes that are
named, or about all systems of the workspace. haros-ci check does the same for the project file, among all the rest.
""",
    "monitor": """
PATH is the workspace (default: here) with the project file. Properties are those of the configuration and of its nodes, under the names
that its launch files give them; --property takes the id of one, or a text in HPL. Bags need the extra: pip install 'haros-ci[bags]'.
""",
    "testgen": """
PATH is the workspace (default: here) with the project file. The properties of the configuration and of its nodes become tests for pytest
and Hypothesis, which import nothing of haros-ci. With --run they are run: on a master of their own, with the nodes that the
configuration's launch files start and no others. --run needs the extra: pip install 'haros-ci[testgen]'.
""",
    "verify": """
PATH is the workspace (default: here) with the project file. Properties of the configuration are verified; those of its nodes, and its
assumptions, are taken for granted. Nothing is run. It needs the extra: pip install 'haros-ci[verify]'.
""",
    "init": """
Looks at PATH (default: here): packages, languages, other people's code, settings of linters. What is there already is left as it is,
and haros-ci says what to add by hand.
""",
    "rules": """
A + marks what the profile turns on. The list is that of docs/rules; haros-ci explain describes one rule.
""",
    "completion": """
Put the line of the example into ~/.bashrc or ~/.zshrc; for fish, write the output to ~/.config/fish/completions/haros-ci.fish.
""",
}


#: What stands beside a command in the list of all, where its first sentence is too long for a narrow terminal.
SHORT: Mapping[str, str] = {
    "check": "Analyse a workspace and report what is new.",
    "completion": "Print the completion script for a shell.",
    "diff": "Say what a change does to the system.",
    "hpl": "Check properties that are written in HPL.",
    "init": "Write a workflow, a pre-commit entry and a project file.",
    "merge": "Report what all shards have found, as one check.",
    "metrics": "Measure functions, classes, files and packages.",
    "model": "Reconstruct the running system from source.",
    "monitor": "Hold properties against a recording.",
    "new-check": "Begin a new check in a clone of haros-ci.",
    "policy": "Write a security policy (SROS2) of what the nodes do.",
    "query": "Ask a query of the running systems, as HAROS does.",
    "rules": "List the rules, all or those of a FILTER.",
    "testgen": "Write property-based tests of running nodes.",
    "verify": "Look for runs that violate properties.",
}


class Command(click.Command):
    """A command whose options are shown by section, and whose examples follow them."""

    def get_short_help_str(self, limit: int = 45) -> str:
        return SHORT.get(self.name or "") or super().get_short_help_str(limit)

    def format_help_text(self, ctx: click.Context, formatter: click.HelpFormatter) -> None:
        super().format_help_text(ctx, formatter)
        for paragraph in ABOUT.get(name_of(ctx), "").strip().split("\n\n"):
            if paragraph:
                formatter.write_paragraph()
                with formatter.indentation():
                    formatter.write_text(" ".join(paragraph.split()))

    def format_options(self, ctx: click.Context, formatter: click.HelpFormatter) -> None:
        sections: dict[str, list[tuple[str, str]]] = {name: [] for name in (*SECTIONS, "Options")}
        for param in self.get_params(ctx):
            record = param.get_help_record(ctx) if isinstance(param, click.Option) else None
            if record is not None:
                sections[section_of(param)].append(record)
        for name, records in sections.items():
            if records:
                with formatter.section(name):
                    formatter.write_dl(records, col_max=28)

    def format_epilog(self, ctx: click.Context, formatter: click.HelpFormatter) -> None:
        examples = EXAMPLES.get(name_of(ctx), ())
        if examples:
            with formatter.section("Examples"):
                for what, command in examples:
                    formatter.write(
                        f"{'':{formatter.current_indent}}# {what}\n{'':{formatter.current_indent}}{command}\n"
                    )
        super().format_epilog(ctx, formatter)


class Group(click.Group):
    """A group of such commands."""

    command_class = Command
    group_class = type


def section_of(param: click.Parameter) -> str:
    names = {*param.opts, *param.secondary_opts}
    return next((name for name, options in SECTIONS.items() if names & {*options}), "Options")


def name_of(ctx: click.Context) -> str:
    """The words of the command without the program: ``baseline create``."""
    return " ".join(ctx.command_path.split()[1:])
