"""How a claim of a paper fares here, and how a goal of this project: found by comparing numbers,
never chosen by hand."""

import dataclasses
import enum

import markdown


class Verdict(enum.Enum):
    EQUALS = "equal"
    BEATS = "better"
    FALLS_SHORT = "short of it"
    DEPARTS = "departs"


@dataclasses.dataclass(frozen=True)
class Claim:
    """Every verdict but EQUALS needs a reason: what the same page shows, or our reading, which then
    begins with "our reading: "."""

    place: str  # "table 4.2"
    what: str   # "cells found at r = 100"
    paper: str
    ours: str
    verdict: Verdict
    reason: str = ""

    def __post_init__(self):
        assert self.verdict is Verdict.EQUALS or self.reason, f"no reason: {self.place}, {self.what}"

    @property
    def word(self) -> str:
        return self.verdict.value if self.verdict is Verdict.EQUALS else f"**{self.verdict.value}**"


def claim(place: str, what: str, paper: str, ours: str, verdict: str, reason: str = "see the section",
          note: str = "") -> Claim:
    """As a template declares it. reason: of a verdict that is not "equal", note: of one that is."""
    found = Verdict(verdict)
    return Claim(place, what, str(paper), str(ours), found, note if found is Verdict.EQUALS else reason)


@dataclasses.dataclass(frozen=True)
class Goal:
    """One that is missed needs no reason: which work takes how much stands on its page."""

    what: str
    asked: str  # "≥ 550 Hz"
    found: str
    is_met: bool
    reason: str = ""

    @property
    def word(self) -> str:
        return "met" if self.is_met else "**missed**"

    def row(self) -> list[str]:
        return [self.what, self.asked, self.found, self.word, self.reason]


def table(claims: list[Claim], paper: str = "paper") -> str:
    """All of them with their reasons, as their own page shows them."""
    return markdown.table(["place", "what", paper, "here", "verdict", "reason"],
                          [[claim.place, claim.what, claim.paper, claim.ours, claim.word,
                            claim.reason] for claim in claims])


def goal_table(goals: list[Goal]) -> str:
    """Without a column that is empty."""
    columns = ["goal", "asked", "found", "verdict", "reason"]
    kept = len(columns) if any(goal.reason for goal in goals) else len(columns) - 1
    return markdown.table(columns[:kept], [goal.row()[:kept] for goal in goals])


def counts(claims: list[Claim]) -> str:
    """Of the 54 claims, 26 are marked "equal", 12 "better", ..."""
    each = [f'{sum(claim.verdict is verdict for claim in claims)} "{verdict.value}"' for verdict in Verdict]
    first = each[0].replace(" ", " is marked " if each[0].startswith("1 ") else " are marked ", 1)
    return f"Of the {len(claims)} claims, {', '.join([first, *each[1:-1]])} and {each[-1]}."
