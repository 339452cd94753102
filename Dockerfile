# SPDX-License-Identifier: Apache-2.0
# haros-ci with its linters, for CI systems that run containers:
#   docker build --tag haros-ci . && docker run --rm --volume "$PWD:/workspace:ro" haros-ci check .
# hadolint global ignore=DL3008
FROM python:3.13-slim AS build
COPY . /source
RUN python -m venv /opt/haros-ci && \
    /opt/haros-ci/bin/pip install --no-cache-dir --constraint /source/action/constraints.txt "/source[linters,exact]"

FROM python:3.13-slim
# git for baselines and changes; its version is the distribution's.
RUN apt-get update && apt-get install --yes --no-install-recommends git && rm -rf /var/lib/apt/lists/*
COPY --from=build /opt/haros-ci /opt/haros-ci
ENV PATH="/opt/haros-ci/bin:$PATH" HAROS_CI_CACHE=/tmp/haros-ci-cache
RUN useradd --uid 1000 --create-home haros-ci
USER 1000
WORKDIR /workspace
ENTRYPOINT ["haros-ci"]
CMD ["check", "."]
