# SPDX-License-Identifier: Apache-2.0
"""Security policies of ROS 2 (SROS2): read, compared with what nodes do, and written from it."""
