# SPDX-License-Identifier: Apache-2.0
"""What is known of values while a program is followed, and the state that holds them."""
