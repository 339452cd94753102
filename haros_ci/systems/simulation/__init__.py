# SPDX-License-Identifier: Apache-2.0
"""What plug-ins of simulated robots and worlds make the simulator publish, subscribe to and serve."""
