"""Shares and how sure they are."""

import math

CONFIDENCE_Z = 1.959964  # of 95 %, two-sided


def wilson(count: int, of: int) -> tuple[float, float]:
    """The interval of a share (E. B. Wilson, 1927)."""
    z2 = CONFIDENCE_Z ** 2
    middle = (count + z2 / 2) / (of + z2)
    half = CONFIDENCE_Z / (of + z2) * math.sqrt(count * (of - count) / of + z2 / 4)
    return max(0.0, middle - half), min(1.0, middle + half)


def share(count: int, of: int) -> str:
    low, high = wilson(count, of)
    return f"{100 * count / of:.1f} % ({100 * low:.1f} to {100 * high:.1f})"
