# SPDX-License-Identifier: Apache-2.0
"""What message, service and action definitions are on the wire: their hashes, and the definitions that most of them use."""
