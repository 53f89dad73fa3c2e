"""What the class grids of a recorded drive say of its hits, setting by setting."""

from types import SimpleNamespace

from claims import Goal
from markdown import fixed, grouped
from section import Section, one, select

SAID = ["moving", "open", "standing", "free", "unknown"]
WHOLE = (0, 70)
NEAR, FAR = (0, 25), (25, 50)
# In the order of the page; with the ranges that are shown.
KINDS = {"parked car": [NEAR, FAR], "cyclist": [NEAR, FAR], "walker": [NEAR, FAR], "moving car": [NEAR, FAR],
         "upright": [WHOLE], "neither flat nor upright": [WHOLE], "road ahead": [(0, 20)]}
# What is no ground for sure.
THINGS = ["parked car", "cyclist", "walker", "moving car", "upright"]
NAMED, ALONE = 1, 0


class Hits:
    """The table's rows of a setting."""

    def __init__(self, data, setting):
        self.rows = select(data["recorded_hits"], setting=setting)

    def of(self, kinds, range_m=None, named=NAMED):
        """How many hits, and the share of each word; no hits where nothing of the kind is labelled."""
        rows = self.rows[self.rows["kind"].isin(kinds)]
        rows = select(rows, named_by_neighbour=named)
        if range_m:
            rows = select(rows, range_from_m=range_m[0], range_to_m=range_m[1])
        sums = rows[[f"{said}_hits" for said in SAID]].sum()
        hits = sums.sum()
        return SimpleNamespace(hits=hits, **{said: sums[f"{said}_hits"] / hits if hits else float("nan")
                                             for said in SAID})


def shown(share, decimals=2):
    return "–" if share != share else fixed(100 * share, decimals)


def range_of(range_m):
    return f"{range_m[0]} to {range_m[1]} m"


# What is asked, of which hits, of which word, the limit in per cent, and whether more is better.
ASKED = [
    ("parked cars below 25 m: called moving", ["parked car"], NEAR, "moving", 0.2, False),
    ("parked cars at 25 to 50 m: called moving", ["parked car"], FAR, "moving", 0.5, False),
    ("what stands upright: called moving", ["upright"], WHOLE, "moving", 0.05, False),
    ("what is neither flat nor upright: called moving", ["neither flat nor upright"], WHOLE, "moving", 1, False),
    ("cyclists below 25 m: called moving", ["cyclist"], NEAR, "moving", 97, True),
    ("cyclists at 25 to 50 m: called moving", ["cyclist"], FAR, "moving", 95, True),
    ("moving cars below 25 m: called moving", ["moving car"], NEAR, "moving", 99, True),
    ("road ahead within 20 m: called free", ["road ahead"], (0, 20), "free", 99.9, True),
]
FREE_OF_THINGS = [("labelled and upright things, by a neighbour's name where there is one: called free", NAMED, 0.1),
                  ("labelled and upright things: called free", ALONE, 2)]
LEAST_FREE_M2 = 2650


def goals_of(data, setting):
    """Of things that the drive has."""
    hits = Hits(data, setting)
    found = [(what, hits.of(kinds, range_m), said, limit, more) for what, kinds, range_m, said, limit, more in ASKED]
    found += [(what, hits.of(THINGS, named=named), "free", limit, False) for what, named, limit in FREE_OF_THINGS]
    goals = []
    for what, its, said, limit, more in found:
        if its.hits:
            share = 100 * getattr(its, said)
            goals.append(Goal(f"recorded drive: {what}", f"{'≥' if more else '≤'} {limit} %", f"{fixed(share, 2)} %",
                              share >= limit if more else share <= limit))
    free_m2 = one(data["recorded_areas"], "free_m2", setting=setting)
    within_m = one(data["recorded_areas"], "within_m", setting=setting)
    goals.append(Goal(f"recorded drive: free area within {within_m} m", f"≥ {grouped(LEAST_FREE_M2)} m²",
                      f"{grouped(free_m2)} m²", free_m2 >= LEAST_FREE_M2))
    return goals


def goals_by_setting(data, settings):
    """What was found for each goal, a column a setting; what misses it is bold."""
    columns = [goals_of(data, setting) for setting in settings]
    return [[goals[0].what.removeprefix("recorded drive: "), goals[0].asked,
             *(goal.found if goal.is_met else f"**{goal.found}**" for goal in goals)]
            for goals in zip(*columns)]


def section(data):
    settings = list(data["recorded_runs"]["setting"])
    hits = {setting: Hits(data, setting) for setting in settings}
    rows = []
    for kind, ranges in KINDS.items():
        for range_m in ranges:
            for setting in settings:
                its, alone = (hits[setting].of([kind], range_m, named) for named in (NAMED, ALONE))
                if its.hits:
                    rows.append([kind, range_of(range_m), setting, grouped(its.hits),
                                 *(shown(getattr(its, said)) for said in SAID), shown(alone.moving), shown(alone.free)])
    areas = [[row.setting, *(fixed(value, 0) for value in (row.free_m2, row.moving_m2, row.standing_m2, row.open_m2))]
             for row in data["recorded_areas"].itertuples()]
    runs = [[row.setting, str(row.clouds), str(row.frames), grouped(row.points_used), grouped(row.packets_placed),
             grouped(row.packets_not_placed)] for row in data["recorded_runs"].itertuples()]
    off = [setting for setting in settings if "pitch" in setting]
    last, run = settings[-1], data["recorded_runs"].iloc[0]
    return Section(
        found={"settings": settings, "last": last, "rows": rows, "areas": areas, "runs": runs,
               "off": off, "goals_off": goals_by_setting(data, [last, *off]) if off else [],
               "run": run,
               "within_m": data["recorded_areas"]["within_m"].iloc[0],
               "first_parked": hits[settings[0]].of(["parked car"], NEAR),
               "last_parked": hits[last].of(["parked car"], NEAR), "last_cyclists": hits[last].of(["cyclist"], NEAR)},
        goals=goals_of(data, last))
