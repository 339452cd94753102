#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Run haros-ci as the inputs ask, set the outputs, and end with the command's exit code.
# Inputs come through the environment and reach the command as one argument each; nothing is evaluated.
# Works with bash 3.2 (macOS).
set -euo pipefail

fail() { # MESSAGE [CODE]
  printf '::error title=haros-ci::%s\n' "$1"
  printf 'exit-code=%d\n' "${2:-2}" >> "$GITHUB_OUTPUT"
  exit "${2:-2}"
}

if [[ "$INPUT_WORKING_DIRECTORY" == *$'\n'* ]] || ! CDPATH='' cd -- "${INPUT_WORKING_DIRECTORY:-.}"; then
  fail "The input 'working-directory' is no directory."
fi

arguments=()

option() { # NAME VALUE: give the option if there is a value
  [[ -z "$2" ]] || arguments+=("--$1=$2")
}

options() { # NAME VALUES: give the option once for each line
  local line
  while IFS= read -r line; do
    option "$1" "$line"
  done < <(lines "$2")
}

lines() { # TEXT: its lines without surrounding blanks, empty ones left out
  printf '%s\n' "$1" | tr -d '\r' | sed -e 's/^[[:blank:]]*//' -e 's/[[:blank:]]*$//' -e '/^$/d'
}

flag() { # INPUT VALUE: whether it is true
  case "$2" in
    true) return 0 ;;
    false) return 1 ;;
    *) fail "The input '$1' is neither true nor false." ;;
  esac
}

repository_of() { # PATH: the nearest directory upwards with a .git; none of git's own search, which a planted bare repository deceives
  local directory
  directory="$1"
  [[ -d "$directory" ]] || directory="$(dirname -- "$directory")"
  directory="$(CDPATH='' cd -- "$directory" && pwd -P)" || return 1
  while [[ ! -e "$directory/.git" ]]; do
    [[ "$directory" != / ]] || return 1
    directory="$(dirname -- "$directory")"
  done
  printf '%s\n' "$directory"
}

git_here() {
  GIT_TERMINAL_PROMPT=0 GIT_HTTP_LOW_SPEED_LIMIT=1000 GIT_HTTP_LOW_SPEED_TIME=60 \
    git --git-dir="$repository/.git" --work-tree="$repository" -c core.fsmonitor=false -c core.hooksPath=/dev/null "$@"
}

has_merge_base() {
  git_here merge-base HEAD "$base" > /dev/null 2>&1
}

fetch_merge_base() { # REVISION REFSPEC: make the merge-base of HEAD and what origin has known, deepening a shallow clone as far as needed
  local base="$1" refspec="$2" head step
  ! has_merge_base || return 0
  if [[ "$(git_here rev-parse --is-shallow-repository)" != true ]]; then
    git_here fetch --quiet --no-tags origin "$refspec" || return 1
    has_merge_base
    return
  fi
  head="$(git_here rev-parse --verify --quiet HEAD)" || return 1
  git_here rev-parse --verify --quiet "$base^{commit}" > /dev/null ||
    git_here fetch --quiet --no-tags --depth=1 origin "$refspec" || return 1
  for step in --deepen=1 --deepen=50 --deepen=1000 --unshallow; do
    ! has_merge_base || return 0
    git_here fetch --quiet --no-tags "$step" origin "$refspec" "$head" || return 1
  done
  has_merge_base
}

base_of_merge_group() { # the commit that a merge queue's group of changes is to be put on, from the event; nothing if this is no such event
  [[ "${GITHUB_EVENT_NAME:-}" == merge_group && -f "${GITHUB_EVENT_PATH:-}" ]] || return 0
  "$python" -I -c '
import json, re, sys
with open(sys.argv[1], "rb") as stream:
    group = json.load(stream).get("merge_group")
sha = group.get("base_sha") if isinstance(group, dict) else None
print(sha if isinstance(sha, str) and re.fullmatch("[0-9a-f]{40}|[0-9a-f]{64}", sha) else "")' "$GITHUB_EVENT_PATH"
}

python="$INPUT_PYTHON"
! flag install "$INPUT_INSTALL" || python="$RUNNER_TEMP/haros-ci-environment/bin/python"
sarif="${INPUT_SARIF_FILE:-$RUNNER_TEMP/haros-ci.sarif}"
counts="$RUNNER_TEMP/haros-ci.json"
annotations="$RUNNER_TEMP/haros-ci-annotations"
page="$RUNNER_TEMP/haros-ci-report.html"
shard="$RUNNER_TEMP/haros-ci-${INPUT_SHARD//\//-of-}.shard.jsonl"
[[ -z "$INPUT_SHARD" || -z "$INPUT_MERGE" ]] || fail "The inputs 'shard' and 'merge' are for different jobs."
[[ -z "$INPUT_SHARD" || "$INPUT_SHARD" =~ ^[0-9]+/[0-9]+$ ]] || fail "The input 'shard' is not like 2/4."
[[ "$sarif" != *$'\n'* && "$sarif" != *$'\r'* ]] || fail "The input 'sarif-file' is more than one line."

compares=false # whether a base revision is asked for: without it the command cannot say what is new
# With a revision the command reads project file and baseline file from there, so that a pull request cannot bring its own.
if [[ -z "$INPUT_BASELINE_REV" ]]; then
  if [[ -n "${GITHUB_BASE_REF:-}" ]]; then
    INPUT_BASELINE_REV="refs/remotes/origin/$GITHUB_BASE_REF"
    refspec="+refs/heads/$GITHUB_BASE_REF:$INPUT_BASELINE_REV"
  else
    INPUT_BASELINE_REV="$(base_of_merge_group)" || INPUT_BASELINE_REV=""
    refspec="$INPUT_BASELINE_REV"
    [[ "${GITHUB_EVENT_NAME:-}" != merge_group || -n "$INPUT_BASELINE_REV" || "$INPUT_REQUIRE_BASELINE" == false ]] ||
      fail "No baseline: the event does not tell the commit that the merge group is put on. Nothing was checked; give the input baseline-rev." 3
  fi
  if [[ -n "$INPUT_BASELINE_REV" ]]; then
    first="$(lines "$INPUT_PATHS" | sed -n 1p)"
    if ! { repository="$(repository_of "${first:-.}")" && fetch_merge_base "$INPUT_BASELINE_REV" "$refspec"; }; then
      message="No baseline: the merge-base with the target branch could not be fetched."
      advice="Use fetch-depth: 0 in actions/checkout"
      [[ "$INPUT_REQUIRE_BASELINE" == false ]] ||
        fail "$message Nothing was checked, as every finding would count as new. $advice, or the input require-baseline: false to see them all." 3
      printf '::warning title=haros-ci::%s\n' "$message Every finding counts as new. $advice."
    fi
  fi
fi
[[ -z "$INPUT_BASELINE_REV" ]] || compares=true

option project "$INPUT_PROJECT"
option profile "$INPUT_PROFILE"
options select "$INPUT_SELECT"
options ignore "$INPUT_IGNORE"
option baseline "$INPUT_BASELINE"
option baseline-rev "$INPUT_BASELINE_REV"
if flag require-baseline "${INPUT_REQUIRE_BASELINE:-$compares}"; then
  arguments+=(--require-baseline)
elif [[ -n "$INPUT_REQUIRE_BASELINE" ]]; then
  arguments+=(--no-require-baseline)
fi
option fail-on "$INPUT_FAIL_ON"
options allow-tool-failure "$INPUT_ALLOW_TOOL_FAILURE"
options plugin "$INPUT_PLUGINS"
option compile-database "$INPUT_COMPILE_DATABASE"
! flag exact "$INPUT_EXACT" || arguments+=(--exact)
option jobs "$INPUT_JOBS"
option cache-dir "${INPUT_CACHE_DIR:-$RUNNER_TEMP/haros-ci-cache}"
if [[ -n "$INPUT_SHARD" ]]; then
  option shard "$INPUT_SHARD"
  option shard-costs "$INPUT_SHARD_COSTS"
  option output "shard=$shard"
else
  option sarif-for "$INPUT_SARIF_FOR"
  option output text
  ! flag annotations "$INPUT_ANNOTATIONS" || option output "github=$annotations"
  option output "sarif=$sarif"
  option output "json=$counts"
  ! flag report "$INPUT_REPORT" || option output "html=$page"
  while IFS= read -r report; do
    [[ "$report" == ?*=?* ]] || fail "A line of the input 'reports' is not FORMAT=FILE."
    option output "$report"
  done < <(lines "$INPUT_REPORTS")
fi
while IFS= read -r argument; do
  [[ "$argument" == -* ]] || fail "A line of the input 'args' is no option; paths are for the input 'paths'."
  arguments+=("$argument")
done < <(lines "$INPUT_ARGS")
command=check
if [[ -n "$INPUT_MERGE" ]]; then
  command=merge
  options path "$INPUT_PATHS"
  option write-costs "$INPUT_SHARD_COSTS"
  arguments+=(--)
  for file in "$INPUT_MERGE"/*.shard.jsonl; do
    arguments+=("$file") # with none there the pattern itself, which the command calls a file that is not there
  done
else
  arguments+=(--)
  while IFS= read -r path; do
    arguments+=("$path")
  done < <(lines "$INPUT_PATHS")
fi

rm -f -- "$sarif" "$counts" "$annotations" "$page" "$shard" # what stands there afterwards is this run's
code=0
token="$("$python" -I -c 'import secrets; print(secrets.token_hex(16))')"
printf '::stop-commands::%s\n' "$token" # the log quotes the pull request's file names and code: none of it is a command
"$python" -I -m haros_ci "$command" "${arguments[@]}" || code=$?
printf '::%s::\n' "$token"

[[ ! -f "$annotations" ]] || cat -- "$annotations"
printf 'exit-code=%d\n' "$code" >> "$GITHUB_OUTPUT"
[[ ! -f "$page" ]] || printf 'report=%s\n' "$page" >> "$GITHUB_OUTPUT"
if [[ -n "$INPUT_SHARD" && -f "$shard" ]]; then
  printf 'shard-file=%s\n' "$shard" >> "$GITHUB_OUTPUT"
elif [[ -f "$sarif" && -f "$counts" ]]; then
  new="$("$python" -I -c 'import json, sys; print(json.load(open(sys.argv[1], "rb"))["counts"]["open"])' "$counts")"
  [[ "$sarif" == /* || "${INPUT_WORKING_DIRECTORY:-.}" == . ]] || sarif="$INPUT_WORKING_DIRECTORY/$sarif"
  printf 'sarif=%s\nnew-count=%d\n' "$sarif" "$new" >> "$GITHUB_OUTPUT"
else
  printf '::error title=haros-ci::Nothing was checked, because of wrong inputs or configuration, a base revision that cannot be had, or shards that make no whole; see the log.\n'
fi
exit "$code"
