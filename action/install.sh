#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Install haros-ci from the action's own checkout into a virtual environment in $RUNNER_TEMP.
# Python always runs isolated (-I): the working directory holds the pull request's files and must not be on sys.path.
set -euo pipefail

fail() {
  printf '::error title=haros-ci::%s\n' "$1"
  exit 2
}

case "$INPUT_INSTALL" in
  true) ;;
  false) exit 0 ;;
  *) fail "The input 'install' is neither true nor false." ;;
esac

"$INPUT_PYTHON" -I -c 'import sys; sys.exit(sys.version_info < (3, 10))' ||
  fail "The input 'python' does not name a Python 3.10 or later. Put actions/setup-python before this step."

environment="$RUNNER_TEMP/haros-ci-environment"
made_from="$environment/made-from" # written last: a second use of the action in a job finds it and goes on
if [[ -f "$made_from" && "$(cat "$made_from")" == "$GITHUB_ACTION_PATH" ]]; then
  exit 0
fi
"$INPUT_PYTHON" -I -m venv --clear "$environment" ||
  fail "No virtual environment could be made. On Debian and Ubuntu images install python3-venv."
"$environment/bin/python" -I -m pip install --quiet --disable-pip-version-check --no-input "$GITHUB_ACTION_PATH" ||
  fail "haros-ci could not be installed; see the log above."
printf '%s' "$GITHUB_ACTION_PATH" > "$made_from"
