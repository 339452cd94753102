# SPDX-License-Identifier: Apache-2.0
"""A tool's component of a SARIF run: driver, rules, notification descriptors and the CWE taxonomy (§3.19, §3.49)."""

from __future__ import annotations

import re
import uuid
from collections.abc import Iterable

from haros_ci import PROJECT_URL
from haros_ci.regex import regex
from haros_ci.report.escape import markdown, markdown_code, multiline, terminal, web_address
from haros_ci.report.message import sentence, shorten
from haros_ci.report.sarif_objects import om
from haros_ci.results.result import Notification, Run, Tool
from haros_ci.results.rule import Level, Rule

MAX_NAME, MAX_DESCRIPTION, MAX_HELP = 255, 1024, 20_000
MAX_DRIVER_WORDS = 3  # SARIF2005 of the SARIF multitool
PRECISIONS = ("very-high", "high", "medium", "low")
PROBLEM_SEVERITY = {Level.ERROR: "error", Level.WARNING: "warning", Level.NOTE: "recommendation"}
GUIDS = uuid.uuid5(uuid.NAMESPACE_URL, PROJECT_URL)
CWE_URL = "https://cwe.mitre.org/"
CWE_GUID = str(uuid.uuid5(uuid.NAMESPACE_URL, CWE_URL))
CWE_VERSION = "4.15"
#: Semantic Versioning 2.0.0; GitHub explains changed alerts by this property, so it must not lie.
_SEMVER = regex(r"(?:0|[1-9]\d*)(?:\.(?:0|[1-9]\d*)){2}(?:-[0-9A-Za-z.-]+)?(?:\+[0-9A-Za-z.-]+)?")
_WORDS = regex(r"[A-Z]+(?![a-z])|[A-Z]?[a-z]+|\d+")

#: What kinds of trouble there are; a notification's kind follows from what it names.
TROUBLE = {
    "configuration": "The configuration asks for something that has no effect or cannot be had.",
    "file-given-up": "The tool could not analyse this file, so its findings there are missing.",
    "tool-trouble": "The tool was missing, failed, was stopped or left results out.",
    "unreadable-input": "An input could not be read or understood and was left out.",
    "whole-run": "Something concerns the run as a whole.",
}


def trouble(notification: Notification) -> str:
    """The key in ``TROUBLE`` that describes a notification."""
    if notification.configuration:
        return "configuration"
    if notification.tool:
        return "file-given-up" if notification.path else "tool-trouble"
    return "unreadable-input" if notification.path else "whole-run"


def all_rules(run: Run) -> tuple[Rule, ...]:
    """The run's rules by id, each once, with a stand-in for those that only results name."""
    rules = {terminal(rule.id): rule for rule in reversed(run.rules)}
    for result in run.results:
        id = terminal(result.rule)
        if id not in rules:
            rules[id] = Rule(id, f"{run.tool.name} reports '{id}'.", result.level)
    return tuple(rules[id] for id in sorted(rules))


def weaknesses(rules: Iterable[Rule]) -> tuple[int, ...]:
    """The CWE numbers that any rule names, sorted."""
    return tuple(sorted({number for rule in rules for number in rule.cwe}))


def build_tool(run: Run, rules: tuple[Rule, ...]) -> om.Tool:
    """The driver. Where version or address are unknown it says so, as both are required (SARIF2005)."""
    tool = run.tool
    words = terminal(tool.name).split()
    version = sentence(tool.version).rstrip(".") if tool.version else ""
    cwe = weaknesses(rules)
    return om.Tool(
        driver=om.ToolComponent(
            name=shorten(" ".join(words[:MAX_DRIVER_WORDS]) or "unnamed", MAX_NAME),
            full_name=shorten(terminal(tool.full_name or f"{tool.name} {version}".strip()), MAX_NAME),
            version=version if version[:1].isdigit() else f"0 ({version or 'unknown'})",
            semantic_version=version if _SEMVER.fullmatch(version) else None,
            information_uri=web_address(tool.information_uri) or PROJECT_URL,
            rules=[build_rule(rule, run, cwe) for rule in rules],
            notifications=[_descriptor(id) for id in troubles(run)] or None,
            supported_taxonomies=[_cwe_component()] if cwe else None,
        ),
        extensions=[_extension(plugin) for plugin in tool.extensions] or None,
    )


def _extension(plugin: Tool) -> om.ToolComponent:
    """A plug-in (§3.18.3); its rules stand with the driver's, which reports them."""
    return om.ToolComponent(name=shorten(terminal(plugin.name), MAX_NAME), version=terminal(plugin.version) or None)


def troubles(run: Run) -> tuple[str, ...]:
    """The kinds of trouble that a run's notifications name, sorted: the driver's notification descriptors."""
    return tuple(sorted({trouble(notification) for notification in run.notifications}))


def build_rule(rule: Rule, run: Run, cwe: tuple[int, ...]) -> om.ReportingDescriptor:
    """A reporting descriptor with every property that GitHub reads; *cwe* are the run's taxa in order."""
    summary = shorten(sentence(rule.summary or rule.id), MAX_DESCRIPTION)
    prose = shorten(multiline(rule.help.removeprefix(f"# {rule.id}\n")).strip(), MAX_HELP)
    first = next((text for text in prose.split("\n\n") if not text.startswith("#")), "")
    help_url = web_address(rule.help_uri)
    silence = markdown_code(f"haros: ignore[{run.tool.name}:{rule.id}] reason")
    body = (markdown(rule.help[:MAX_HELP]) if run.imported else prose) or markdown(summary)
    more = f"\n\n[More on this rule]({help_url})" if help_url else ""
    return om.ReportingDescriptor(
        id=terminal(rule.id),
        name=pascal_name(rule.id, run.tool.name),
        short_description=om.MultiformatMessageString(text=summary),
        full_description=om.MultiformatMessageString(
            text=shorten(sentence(first), MAX_DESCRIPTION) if first and first[0].isalpha() else summary
        ),
        help=om.MultiformatMessageString(
            text=prose or summary,
            markdown=f"{body}{more}\n\nTo accept one place, write {silence} in a comment on its line.",
        ),
        help_uri=help_url,
        default_configuration=om.ReportingConfiguration(level=rule.level.value),
        deprecated_ids=sorted({terminal(id) for id in rule.deprecated_ids}) or None,
        relationships=[_superset(number, cwe) for number in sorted(set(rule.cwe))] or None,
        properties=_properties(rule),
    )


def build_taxonomy(cwe: tuple[int, ...]) -> om.ToolComponent:
    """The part of the Common Weakness Enumeration that rules refer to (§3.14.8)."""
    return om.ToolComponent(
        name="CWE",
        guid=CWE_GUID,
        version=CWE_VERSION,
        organization="MITRE",
        information_uri=CWE_URL,
        short_description=om.MultiformatMessageString(text="The Common Weakness Enumeration."),
        taxa=[_taxon(number) for number in cwe],
    )


def pascal_name(id: str, tool: str) -> str:
    """``build/include_order`` → ``BuildIncludeOrder``: readable, and never the id itself, whatever its case (SARIF1001, SARIF2012)."""
    name = _pascal(id)
    if not name or name.lower() == id.lower():
        name = (_pascal(tool) or "Rule") + name
    return shorten(name, MAX_NAME)


def _pascal(text: str) -> str:
    name = ""
    for word in _WORDS.findall(text):
        name += word.capitalize() if not name or (len(word) > 1 and word[0].isalpha()) else word.lower()
    return name


def _properties(rule: Rule) -> dict[str, object]:
    """GitHub's property bag. ``security-severity`` would fill the security dashboard with lint: only where it belongs."""
    security = "security" in rule.tags
    own = tuple(map(terminal, rule.tags))
    tags = dict.fromkeys(
        (
            *(["security"] if security else []),
            *(f"external/cwe/cwe-{n:03d}" for n in sorted(rule.cwe)),
            *(tag for tag in own if tag.startswith("external/")),
            *own,
        )
    )
    severity = rule.security_severity if security and _is_severity(rule.security_severity) else None
    properties: dict[str, object] = {"problem.severity": PROBLEM_SEVERITY[rule.level]}
    if rule.precision in PRECISIONS:
        properties["precision"] = rule.precision
    if rule.catalogue:
        properties["catalogueId"] = terminal(rule.catalogue)
    if severity:
        properties["security-severity"] = severity
    if tags:
        properties["tags"] = list(tags)
    return dict(sorted(properties.items()))


def _is_severity(text: str | None) -> bool:
    return bool(text and re.fullmatch(r"\d{1,2}(\.\d{1,2})?", text) and 0.1 <= float(text) <= 10.0)


def _superset(number: int, cwe: tuple[int, ...]) -> om.ReportingDescriptorRelationship:
    return om.ReportingDescriptorRelationship(
        target=om.ReportingDescriptorReference(
            id=f"CWE-{number}", index=cwe.index(number), tool_component=_cwe_component()
        ),
        kinds=["superset"],
    )


def _cwe_component() -> om.ToolComponentReference:
    return om.ToolComponentReference(name="CWE", index=0, guid=CWE_GUID)


def _taxon(number: int) -> om.ReportingDescriptor:
    text = om.MultiformatMessageString(text=f"Weakness CWE-{number} of the Common Weakness Enumeration.")
    page = f"{CWE_URL}data/definitions/{number}.html"
    return om.ReportingDescriptor(
        id=f"CWE-{number}",
        name=f"Weakness{number}",
        short_description=text,
        full_description=text,
        help=om.MultiformatMessageString(text=f"See {page}."),
        help_uri=page,
    )


def _descriptor(id: str) -> om.ReportingDescriptor:
    text = om.MultiformatMessageString(text=TROUBLE[id])
    return om.ReportingDescriptor(
        id=id,
        name=f"HarosCi{_pascal(id)}",
        short_description=text,
        full_description=text,
        help=text,
        help_uri=PROJECT_URL,
    )
