# SPDX-License-Identifier: Apache-2.0
"""What a change does to the interfaces, graph, parameters and QoS of a system."""
