# SPDX-License-Identifier: Apache-2.0
"""ROS architecture checks, one module and one page each; installed as haros_ci_checks."""

CHECKS: tuple[()] = ()
