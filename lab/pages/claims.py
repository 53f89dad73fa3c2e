"""How a claim of a paper fares here: found by comparing numbers, never chosen by hand."""

import dataclasses
import enum


class Verdict(enum.Enum):
    EQUALS = "equal"
    BEATS = "better"
    FALLS_SHORT = "short of it"
    DEPARTS = "departs"


@dataclasses.dataclass(frozen=True)
class Claim:
    """One line of the overview. Every verdict but EQUALS needs a reason: what the same page shows,
    or our reading, which then begins with "our reading: "."""

    place: str  # "table 4.2"
    what: str   # "cells found at r = 100"
    paper: str
    ours: str
    verdict: Verdict
    reason: str = ""

    def __post_init__(self):
        assert self.verdict is Verdict.EQUALS or self.reason, f"no reason: {self.place}, {self.what}"

    def row(self) -> list[str]:
        word = self.verdict.value
        return [self.place, self.what, self.paper, self.ours,
                word if self.verdict is Verdict.EQUALS else f"**{word}**", self.reason]


def counts(claims: list[Claim]) -> str:
    """54 claims: 26 "equal", 12 "better", ..."""
    each = ", ".join(f'{sum(claim.verdict is verdict for claim in claims)} "{verdict.value}"'
                     for verdict in Verdict)
    return f"{len(claims)} claims: {each}."
