# SPDX-License-Identifier: Apache-2.0
"""What following a node gave, kept between runs as long as nothing that it consulted has changed."""
