# SPDX-License-Identifier: Apache-2.0
"""A plug-in of HAROS with every hook and every method of the interface; its log.json tells what it was called with."""

from __future__ import unicode_literals

import json
import os


def pre_analysis():
    return {"calls": ["pre_analysis"], "cwd": os.getcwd()}


def file_analysis(iface, scope):
    iface.state["calls"].append("file_analysis " + scope.id)
    print("NOISE")
    os.system("echo NOISE")
    with open(scope.path) as stream:
        lines = [number for number, line in enumerate(stream, 1) if "\t" in line]
    for line in lines:
        iface.report_violation("tab", "a tab<br>in <b>%s</b>" % scope.name, line=line, function="f", class_="C")
    iface.report_metric("tabs", len(lines))
    iface.report_metric("tabs", 1000)  # outside its bounds
    iface.report_metric("haros_plugin_demo:tabs", 1, line=1)
    iface.report_violation("no_such_rule", "dropped")
    iface.report_metric("no_such_metric", 1)


def package_analysis(iface, scope):
    iface.state["calls"].append("package_analysis " + scope.id)
    assert iface.find_package(scope.name) is scope and iface.find_package(scope.id) is scope
    assert iface.find_package("nowhere") is None
    assert os.path.isdir(scope.path)
    iface.report_violation("haros_plugin_demo:many_files", "%d files" % len(scope.source_files))
    iface.report_metric("files", len(scope.source_files))


def configuration_analysis(iface, scope):
    iface.state["calls"].append("configuration_analysis " + scope.id)
    assert iface.find_configuration(scope.name) is scope
    for topic in scope.topics:
        if topic.publishers and not topic.subscribers:
            assert topic.configuration is scope
            iface.report_runtime_violation("lonely_topic", topic.id, resources=[topic])
            iface.report_runtime_violation("lonely_topic", "by its publisher", resources=list(topic.publishers))
    iface.report_metric("ends", sum(len(node.publishers) for node in scope.nodes))


def post_analysis(iface):
    iface.state["calls"].append("post_analysis")
    with open(iface.get_file("note.txt")) as stream:
        iface.log_debug(stream.read())
    iface.log_warning("be warned")
    iface.log_error("an error")
    with open("log.json", "w") as stream:
        json.dump(iface.state, stream)
    iface.export_file("log.json")
    iface.export_file("not-there.json")
    iface.export_file("../model")
    iface.export_file("/etc/passwd")


def pre_process():
    return {"violations": [], "metrics": []}


def process_file_violation(iface, datum):
    iface.state["violations"].append((datum.rule.id, datum.scope.id, datum.location.line, datum.details))


def process_package_violation(iface, datum):
    process_file_violation(iface, datum)


def process_configuration_violation(iface, datum):
    iface.state["violations"].append((datum.rule.id, datum.affected[0].id, None, datum.details))


def process_file_metric(iface, datum):
    iface.state["metrics"].append((datum.metric.id, datum.location.smallest_scope.id, datum.value))
    if datum.metric.id == "ploc" and not datum.location.function:
        iface.report_violation("bad_metric", "%d lines" % datum.value, scope=datum.scope)


def process_package_metric(iface, datum):
    iface.state["metrics"].append((datum.metric.id, datum.scope.id, datum.value))


def process_configuration_metric(iface, datum):
    iface.state["metrics"].append((datum.metric.id, str(datum.location), datum.value))


def post_process(iface):
    with open("processed.json", "w") as stream:
        json.dump(iface.state, stream)
    iface.export_file("processed.json")
