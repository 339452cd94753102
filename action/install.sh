#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Install haros-ci, from the action's own checkout unless a release is named, into a virtual environment in $RUNNER_TEMP.
# Python always runs isolated (-I): the working directory holds the pull request's files and must not be on sys.path.
set -euo pipefail

fail() {
  printf '::error title=haros-ci::%s\n' "$1"
  exit 2
}

case "$INPUT_INSTALL" in
  true) ;;
  false)
    [[ -z "$INPUT_PLUGIN_PACKAGES" ]] || fail "The input 'plugin-packages' needs install: true; put them into your image."
    exit 0
    ;;
  *) fail "The input 'install' is neither true nor false." ;;
esac

extra=""
case "$INPUT_LINTERS" in
  true) extra="linters" ;;
  false) ;;
  *) fail "The input 'linters' is neither true nor false." ;;
esac
case "$INPUT_EXACT" in
  true) extra="${extra:+$extra,}exact" ;;
  false) ;;
  *) fail "The input 'exact' is neither true nor false." ;;
esac
extra="${extra:+[$extra]}"

constraint=()
case "$INPUT_TOOL_VERSIONS" in
  pinned) constraint=(--constraint "$GITHUB_ACTION_PATH/action/constraints.txt") ;;
  newest) ;;
  *) fail "The input 'tool-versions' is neither pinned nor newest." ;;
esac

source="$GITHUB_ACTION_PATH$extra"
if [[ -n "$INPUT_VERSION" ]]; then
  [[ "$INPUT_VERSION" =~ ^[0-9]+(\.[0-9]+){1,3}((a|b|rc)[0-9]+)?$ ]] || fail "The input 'version' is no release, as in 0.1.0."
  source="haros-ci$extra==$INPUT_VERSION"
fi

"$INPUT_PYTHON" -I -c 'import sys; sys.exit(sys.version_info < (3, 10))' ||
  fail "The input 'python' does not name a Python 3.10 or later. Put actions/setup-python before this step."

# Names, with versions or an address of https: a path would be the pull request's own code, an option anything at all.
requirement='^[A-Za-z0-9][A-Za-z0-9._-]*(\[[A-Za-z0-9,._-]+\])?([[:blank:]]*([=<>!~]=?=?[A-Za-z0-9.*+!,<>=~ -]+)|[[:blank:]]+@[[:blank:]]+(git\+)?https://[^[:blank:]]+)?$'
packages=()
while IFS= read -r line; do
  [[ "$line" =~ $requirement ]] || fail "The input 'plugin-packages' has a line that is no requirement by name: only names, versions and https addresses."
  packages+=("$line")
done < <(printf '%s\n' "$INPUT_PLUGIN_PACKAGES" | tr -d '\r' | sed -e 's/^[[:blank:]]*//' -e 's/[[:blank:]]*$//' -e '/^$/d')

environment="$RUNNER_TEMP/haros-ci-environment"
made_from="$environment/made-from" # written last: a second use of the action in a job finds it and goes on
wanted="$source $INPUT_TOOL_VERSIONS ${packages[*]-}"
if [[ -f "$made_from" && "$(cat "$made_from")" == "$wanted" ]]; then
  exit 0
fi
"$INPUT_PYTHON" -I -m venv --clear "$environment" ||
  fail "No virtual environment could be made. On Debian and Ubuntu images install python3-venv."
"$environment/bin/python" -I -m pip install --quiet --disable-pip-version-check --no-input ${constraint[@]+"${constraint[@]}"} "$source" ||
  fail "haros-ci could not be installed; see the log above."
if [[ ${#packages[@]} -gt 0 ]]; then
  (CDPATH='' cd -- "$RUNNER_TEMP" && "$environment/bin/python" -I -m pip install --quiet --disable-pip-version-check --no-input -- "${packages[@]}") ||
    fail "The packages of the input 'plugin-packages' could not be installed; see the log above."
fi
printf '%s' "$wanted" > "$made_from"
