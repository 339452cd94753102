# SPDX-License-Identifier: Apache-2.0
"""haros-ci: linters, metrics and ROS architecture checks as SARIF, with baselines."""

__version__ = "0.1.0"

#: The project's address; informationUri, helpUri and generated files start from it.
PROJECT_URL = "https://github.com/haros-ci/haros-ci"
