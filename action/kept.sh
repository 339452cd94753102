#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Say under which keys the environment and the results are kept between runs; an output that is empty is not kept.
# Wrong inputs are for install.sh and check.sh to refuse.
set -euo pipefail

case "$INPUT_CACHE" in
  true) ;;
  false) exit 0 ;;
  *)
    printf '::error title=haros-ci::%s\n' "The input 'cache' is neither true nor false."
    exit 2
    ;;
esac

system="${RUNNER_OS:-}-${RUNNER_ARCH:-}"

# Who names a directory keeps it; a job that merges shards looks at no file.
if [[ -z "$INPUT_CACHE_DIR" && -z "$INPUT_MERGE" ]]; then
  printf 'results=haros-ci-results-%s-%s-%s\n' "$system" "${GITHUB_JOB:-}" "$(printf '%s' "$INPUT_SHARD" | tr -c 'A-Za-z0-9' -)" >> "$GITHUB_OUTPUT"
fi

# An environment is the same as long as the action, the interpreter, its place and the inputs are. Packages of plug-ins may come from a branch.
if [[ "$INPUT_INSTALL" == true && -z "$INPUT_PLUGIN_PACKAGES" ]]; then
  digest="$("$INPUT_PYTHON" -I - "$GITHUB_ACTION_PATH" "$RUNNER_TEMP" "$INPUT_LINTERS" "$INPUT_EXACT" "$INPUT_TOOL_VERSIONS" "$INPUT_VERSION" << 'PYTHON'
import hashlib
import os
import sys

action = sys.argv[1]
digest = hashlib.sha256(repr((sys.argv[1:], sys.version, os.path.realpath(sys.executable))).encode())
paths = [os.path.join(action, name) for name in ("pyproject.toml", os.path.join("action", "constraints.txt"))]
for top in ("haros_ci", "checks"):
    for directory, _, names in os.walk(os.path.join(action, top)):
        paths += [os.path.join(directory, name) for name in names if not name.endswith(".pyc")]
for path in sorted(paths):
    with open(path, "rb") as file:
        digest.update(repr((os.path.relpath(path, action), hashlib.sha256(file.read()).hexdigest())).encode())
print(digest.hexdigest()[:32])
PYTHON
)" || exit 0 # no such interpreter: install.sh says so
  # The newest versions of tools are looked up anew in another week.
  [[ "$INPUT_TOOL_VERSIONS" != newest ]] || digest="$digest-$(date -u +%G-%V)"
  printf 'environment=haros-ci-environment-%s-%s\n' "$system" "$digest" >> "$GITHUB_OUTPUT"
fi
