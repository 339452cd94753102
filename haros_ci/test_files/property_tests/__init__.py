# SPDX-License-Identifier: Apache-2.0
"""What generated tests stand on: messages and plans of messages (Hypothesis), examples, processes, and ROS.

These modules are copied beside the tests and import nothing of haros_ci there. They run with Python 3.8, as ROS Noetic has it.
"""
