# SPDX-License-Identifier: Apache-2.0
"""How often nodes publish: from the timers and rates of a configuration and the code around each call."""
