# SPDX-License-Identifier: Apache-2.0
"""How long ten queries with three variables each take on a workspace: python tests/bench/query_bench.py WORKSPACE [CACHE].

The workspace is linked once; then each query is asked of every configuration, and of all their nodes together.
"""

from __future__ import annotations

import sys
import time

from haros_ci.analysis.architecture import architecture
from haros_ci.commands.common import cores, settings_from, store_for
from haros_ci.query.engine import Query
from haros_ci.query.queries import VARIABLES, Scenes
from haros_ci.workspace.discover import discover

QUERIES = {
    "a message's way over two topics": """
        for p in <nodes/publishers>, s in <nodes/subscribers>, n in <nodes>
        where p.topic_name == s.topic_name and s.node == n and p.node != n and len(n.publishers) > 0
        return p, s, n""",
    "two publishers and a subscriber": """
        for p in <nodes/publishers>, q in <nodes/publishers>, s in <nodes/subscribers>
        where p.topic_name == q.topic_name and q.topic_name == s.topic_name and p.node.id < q.node.id
        return p, q, s""",
    "types that differ on a topic": """
        for t in <topics>, p in <nodes/publishers>, s in <nodes/subscribers>
        where p.topic == t and s.topic == t and p.type != s.type return t, p, s""",
    "a best-effort publisher for a reliable subscriber": """
        for t in <topics>, p in <nodes/publishers[self.qos]>, s in <nodes/subscribers[self.qos]>
        where p.topic_name == t.id and s.topic_name == t.id and p.qos.reliability == 'best_effort'
              and s.qos.reliability == 'reliable' return p, s""",
    "names that end alike": """
        for p in <nodes/publishers[self.topic.is_disconnected]>, s in <nodes/subscribers[self.topic.is_disconnected]>,
            t in <topics>
        where p.type == s.type and t == p.topic and (p.topic.id.endswith(s.topic.name) or s.topic.id.endswith(p.topic.name))
        return p, s, t""",
    "services and who calls them": """
        for s in <services>, a in <nodes/servers>, c in <nodes/clients>
        where a.service == s and c.service == s and a.node != c.node return s, a, c""",
    "nodes of one type with the same parameter": """
        for a in <nodes>, b in <nodes>, d in <nodes/declarations>
        where a.type == b.type and d.node == a and a.id < b.id return a, b, d""",
    "parameters that differ between nodes": """
        for d in <nodes/declarations>, e in <nodes/declarations>, n in <nodes>
        let name = d.param_name.split(':')[1]
        where d.type == e.type and name == e.param_name.split(':')[1] and e.node == n and d.node.id < n.id
              and d.value != e.value
        return d, e, n""",
    "a circle of two nodes": """
        for p in <nodes/publishers>, s in <nodes/subscribers>, q in <nodes/publishers>
        where p.topic == s.topic and s.node == q.node and q.topic.id != p.topic.id
              and some r in <nodes/subscribers> satisfies (r.topic == q.topic and r.node == p.node)
        return p, s, q""",
    "queues of unlike length": """
        for p in <nodes/publishers>, s in <nodes/subscribers>, t in <topics>
        where t.id == p.topic_name and t.id == s.topic_name and p.queue_size > s.queue_size return t, p, s""",
}


def main() -> None:
    settings = settings_from(
        {"paths": (sys.argv[1],), "isolated": True, "cache_dir": sys.argv[2] if len(sys.argv) > 2 else None}
    )
    workspace = discover(settings.root, settings.paths, exclude=settings.exclude, max_file_size=settings.max_file_size)
    store = store_for(settings)
    found = architecture(workspace, settings, store, processes=cores())
    store.flush()
    ends = sum(not end.implicit for c in found.configurations for node in c.nodes for end in node.endpoints)
    print(f"{len(found.configurations)} configurations, {ends} ends")
    started = time.perf_counter()
    scenes = Scenes(found, workspace.files, {})
    for name, text in QUERIES.items():
        before = time.perf_counter()
        query = Query(text, VARIABLES["configuration"])
        count = sum(len(query.matches(variables)) for _, variables in scenes.of("configuration"))
        print(f"{time.perf_counter() - before:7.3f} s  {count:6} matches  {query.taken:9} steps  {name}")
    print(f"{time.perf_counter() - started:7.3f} s  all")


if __name__ == "__main__":
    main()
