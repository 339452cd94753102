# SPDX-License-Identifier: Apache-2.0
"""The colours of the page against what they stand on, light and dark (WCAG 2.2: 4.5 for texts, 3 for the outlines of what is used)."""

from __future__ import annotations

import re

import pytest

from haros_ci.html_page.document import STYLE, asset

TEXTS = ("ink", "quiet", "link", "error", "warning", "note", "added", "removed", "changed")
FILLS = ("node", "topics", "services", "actions")


def colours(scheme: str) -> dict[str, str]:
    """The variables of the style by name, those of the dark scheme over the others."""
    every = [
        dict(re.findall(r"--([\w-]+): (#[0-9a-f]{6});", block))
        for block in re.findall(r":root \{([^}]*)\}", asset(STYLE))
    ]
    light, dark, *_ = every  # and those of paper
    return light if scheme == "light" else {**light, **dark}


def parts(colour: str) -> list[int]:
    return [int(colour[at : at + 2], 16) for at in (1, 3, 5)]


def luminance(colour: str) -> float:
    """Relative luminance, as WCAG 2.2 defines it."""
    red, green, blue = (
        share / 12.92 if share <= 0.04045 else ((share + 0.055) / 1.055) ** 2.4
        for share in (part / 255 for part in parts(colour))
    )
    return 0.2126 * red + 0.7152 * green + 0.0722 * blue


def contrast(one: str, other: str) -> float:
    low, high = sorted((luminance(one), luminance(other)))
    return (high + 0.05) / (low + 0.05)


def mixed(one: str, other: str, share: float) -> str:
    """``color-mix(in srgb, one SHARE, other)``."""
    pairs = zip(parts(one), parts(other), strict=True)
    return "#" + "".join(f"{round(a * share + b * (1 - share)):02x}" for a, b in pairs)


@pytest.mark.parametrize("scheme", ["light", "dark"])
def test_texts_stand_out_from_their_ground(scheme: str) -> None:
    known = colours(scheme)
    pairs = [(text, known[ground]) for text in TEXTS for ground in ("ground", "raised")]
    pairs += [(text, known[fill]) for text in ("ink", "quiet", "error", "warning") for fill in FILLS]
    pairs += [("ground", known["accent"]), ("ink", known["mark"])]
    pairs += [(text, mixed(known["accent"], known["ground"], 0.18)) for text in ("ink", "quiet", *TEXTS[3:6])]
    pairs += [(text, mixed(known["mark"], known["raised"], 0.35)) for text in ("ink", "quiet")]
    shares = [
        int(share) / 100
        for share in re.findall(
            r"\.heat-\d > \.shape \{ fill: color-mix\(in srgb, var\(--warning\) (\d+)%", asset(STYLE)
        )
    ]
    assert len(shares) == 3
    for share in shares:
        heated = mixed(known["warning"], known["ground"], share)
        pairs += [(text, heated) for text in (("ink", "quiet", "error") if share < 0.2 else ("ink",))]
    found = {(text, ground): round(contrast(known[text], ground), 2) for text, ground in pairs}
    assert not {pair: ratio for pair, ratio in found.items() if ratio < 4.5}


@pytest.mark.parametrize("scheme", ["light", "dark"])
def test_what_is_used_has_an_outline_that_is_seen(scheme: str) -> None:
    known = colours(scheme)
    for ground in ("ground", "raised"):
        assert min(contrast(known[one], known[ground]) for one in ("edge", "accent", "chosen", "error")) >= 3
    for rule in ("button", "input, select, textarea"):
        (style,) = re.findall(rf"^{rule} \{{([^}}]*)\}}", asset(STYLE), re.MULTILINE)
        assert "border: 1px solid var(--edge)" in style, rule
