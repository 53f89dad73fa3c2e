"""What a scan point of a unit that turns costs one Cortex-A9: frames of three units in the simulated
city, from packet to last tile, and made-up turns without packets and stream."""

import dataclasses

from claims import Goal
from cortex_a9 import CLOCK_HZ, STAGES, CortexA9, Cost
from markdown import fixed, grouped, percent
from section import Section

TURNS_HZ = 10
UNITS = {"roof_vlp16": "VLP-16", "roof_hdl32e": "HDL-32E", "roof_hdl64e": "HDL-64E S3"}


@dataclasses.dataclass(frozen=True)
class Kind:
    """Of a unit's turn: what its returns are judged by, and how long its lines are; goals have those of 50 m."""

    heights: str
    lines: str
    goals_ns: dict = dataclasses.field(default_factory=dict)


# By the end of the image's name. Lines of the cars reach the corners of the grid.
BAND = "_band"
SHORT_BAND = "_band_50m"
KINDS = {SHORT_BAND: Kind("band", "50 m", dict.fromkeys(UNITS, 400)),
         "_50m": Kind("ground", "50 m", {"roof_hdl64e": 440}),
         BAND: Kind("band", "73 m"), "": Kind("ground", "73 m")}
PATTERNS = {"column": "all layers at one azimuth", "spread": "layer after layer",
            "offsets": "at four azimuths"}
BANDS = {"car": "0.3 to 2.2 m", "open": "none"}
# What is done to a point, and what is done to lines and tiles, which no point knows of.
POINT = ("receive", "decode", "beams", "mark")
WORK = {"carve": "carving", "encode": "encoding tiles", "beams": "turning points to beams"}
WORTH_NAMING = 0.1


@dataclasses.dataclass(frozen=True)
class Turn:
    run: str
    points: float
    costs: dict  # by stage

    @property
    def whole(self) -> Cost:
        return sum(self.costs.values(), Cost())

    def ns(self, *stages: str) -> float:
        cycles = sum(self.costs[stage].cycles.nominal for stage in stages or self.costs)
        return cycles / self.points * (1e9 / CLOCK_HZ)


def _turn(a9, run, stages, frames=1.0):
    return Turn(run, a9.value(run, "points") / frames, {stage: a9.cost(run, stage) for stage in stages})


def units(a9, kind) -> dict[str, Turn]:
    """A mean turn of each unit in the city, of this kind."""
    runs = {vehicle: f"turning vehicle={vehicle}{kind}" for vehicle in UNITS}
    return {vehicle: _turn(a9, run, STAGES, a9.value(run, "frames")) for vehicle, run in runs.items()}


def _shares(turn):
    whole = turn.ns()
    shares = {stage: turn.ns(stage) / whole for stage in WORK}
    named = sorted((stage for stage in shares if shares[stage] >= WORTH_NAMING), key=shares.get,
                   reverse=True)
    return "of the cycles " + ", ".join(
        f"{percent(shares[stage], 0)} {'are ' * (place == 0)}{WORK[stage]}"
        for place, stage in enumerate(named))


def _verdict(found, goal, reason):
    return "met" if found <= goal else f"**over by {percent(found / goal - 1, 0)}**: {reason}"


def _unit_row(a9, vehicle, kind, turn):
    counted = a9.mean(turn.run, "instructions", "frame") / turn.points
    bound = turn.ns("carve", "encode", "send", "clear")
    share = turn.ns() * turn.points * TURNS_HZ / 1e9
    goal = KINDS[kind].goals_ns.get(vehicle)
    return [UNITS[vehicle], KINDS[kind].lines, KINDS[kind].heights, grouped(turn.points), grouped(counted),
            f"≤ {goal}" if goal else "", grouped(turn.ns()),
            *(grouped(turn.ns(*stages)) for stages in (POINT, ("carve",), ("encode", "send", "clear"))),
            grouped(bound), percent(share, 0), _verdict(turn.ns(), goal, _shares(turn)) if goal else ""]


def _made_up_rows(a9):
    rows = []
    for run in a9.runs("turning_cost"):
        keys = dict(word.split("=") for word in run.split()[1:])
        turn = _turn(a9, run, ("fuse", "mark"))
        counted = sum(a9.value(run, "instructions", stage) for stage in turn.costs) / turn.points
        rows.append([keys["layers"], grouped(float(keys["azimuths"])), PATTERNS[keys["pattern"]],
                     BANDS[keys["band"]], grouped(turn.points),
                     percent(a9.value(run, "points_used") / turn.points, 0), grouped(counted),
                     grouped(turn.ns()), fixed(turn.whole.l2_misses / turn.points, 2)])
    return rows


def section(data) -> Section:
    a9 = CortexA9(data)
    turns = {(vehicle, kind): turn for kind in KINDS for vehicle, turn in units(a9, kind).items()}
    late = [f"{UNITS[vehicle]} ({KINDS[kind].heights}, {KINDS[kind].lines})"
            for (vehicle, kind), turn in turns.items() if turn.ns() * turn.points * TURNS_HZ > 1e9]
    words = {"band": "", "ground": " over the ground"}
    return Section(found={
        "hz": TURNS_HZ, "goal_ns": KINDS[SHORT_BAND].goals_ns["roof_hdl64e"],
        "found_ns": [grouped(turn.ns()) for turn in units(a9, SHORT_BAND).values()],
        "ground_ns": [grouped(turn.ns()) for turn in units(a9, "_50m").values()],
        "units": [_unit_row(a9, *which, turn) for which, turn in turns.items()],
        "made_up": _made_up_rows(a9),
        "late": " and ".join(late),
        "misses": [[UNITS[vehicle], KINDS[kind].lines, KINDS[kind].heights,
                    fixed(turn.whole.l2_misses / turn.points, 2), fixed(turn.whole.l1d_refills / turn.points, 1)]
                   for (vehicle, kind), turn in turns.items()]},
        goals=[Goal(f"{UNITS[vehicle]}: a point{words[of.heights]}, lines of {of.lines}", f"≤ {goal} ns",
                    f"{grouped(turns[vehicle, kind].ns())} ns", turns[vehicle, kind].ns() <= goal)
               for kind, of in KINDS.items() for vehicle, goal in of.goals_ns.items()])
