"""How well things with a speed are told, and what names they give to cells: against the simulator's truth, beside
the grid alone."""

import dataclasses
import typing
from types import SimpleNamespace


from claims import Goal
from markdown import fixed, grouped
from results.perception import CARS, SCENES, Scores, share, shown
from section import Section, select

WALKERS = ["moving_person"]
ALONE, DEFAULT = "grid alone", "default"
CUT_M = 4  # of GOSPA
KINDS = [("city", "car"), ("city", "person"), ("ring_road", "car"), ("street", "car"), ("street", "person")]
KIND_NAMES = {"car": "cars", "person": "walkers"}


class Things:
    """What was counted of one drive, or of several together, and of cars or walkers alone."""

    def __init__(self, data, scene, what=None, **where):
        prefix = "objects_street" if scene == "street" else "objects"
        self.drives = select(data[f"{prefix}_drives"], scene=scene, **where)
        kind = {"what": what} if what else {}
        self.views, self.errors = (select(data[f"{prefix}_{name}"], scene=scene, **kind, **where)
                                   for name in ("views", "errors"))

    def _of_views(self, part, whole):
        return share(self.views[part].sum(), self.views[whole].sum())

    @property
    def frames(self):
        return self.views["frames"].sum()

    def recall(self):
        return self._of_views("told_frames", "frames")

    def late_recall(self):
        return self._of_views("late_told_frames", "late_frames")

    def delay_s(self, part):
        """Of those that are told at last: the one that such a part of them is not slower than."""
        delays = sorted(self.views[self.views["delay_ms"] >= 0]["delay_ms"])
        return delays[min(int(part * len(delays)), len(delays) - 1)] / 1000 if delays else float("nan")

    def never_told(self):
        """Of those that were in view for a second."""
        long = self.views[self.views["lasted_ms"] >= 1000]
        return (long["delay_ms"] < 0).sum(), len(long)

    def velocity(self, part):
        """m/s that such a part of the errors is below, rounded up to the tables' steps."""
        sums = self.errors.groupby("below_cm_s")["velocities"].sum().sort_index()
        reached = sums.cumsum() >= part * sums.sum()
        return reached.idxmax() / 100 if len(sums) else float("nan")

    def velocity_rms(self):
        return self._of_views("squared_errors_m2_s2", "velocities") ** 0.5

    def within_two_deviations(self):
        return self._of_views("within_two_deviations", "velocities")

    def other_ids_a_minute(self):
        return share(self.views["other_ids"].sum(), self.views["seen_ms"].sum() / 60_000)

    def wrong(self):
        return share(self.drives["wrong"].sum(), self.drives["reported"].sum())

    def a_frame(self, column):
        return share(self.drives[column].sum(), self.drives["frames"].sum())

    def gospa(self):
        return self.a_frame("gospa_place_m") + CUT_M / 2 * (self.a_frame("gospa_missed") + self.a_frame("gospa_wrong"))


class Drives:
    """One scene: all of its drives together, and each."""

    def __init__(self, data, scene):
        self._data, self.scene = data, scene
        self.prefix = "perception_street" if scene == "street" else "perception"
        self.seeds = [int(seed) for seed in Things(data, scene).drives["seed"]]

    def things(self, what=None, **where):
        return Things(self._data, self.scene, what, **where)

    def cells(self, rule=DEFAULT, **where):
        return Scores(self._data, self.prefix, scene=self.scene, rule=rule, **where)

    def together(self, measure):
        return measure(self)

    def each(self, measure):
        return [measure(self, seed=seed) for seed in self.seeds]


def called(hits_on, rule=DEFAULT):
    return lambda drives, **where: drives.cells(rule, **where).said_of(hits_on).moving


def right(drives, rule=DEFAULT, **where):
    return drives.cells(rule, **where).right()


def of_things(measure, what=None):
    return lambda drives, **where: measure(drives.things(what, **where))


@dataclasses.dataclass(frozen=True)
class Asked:
    """A goal of the table: of all drives together, or of each. Of scenes that have none there is no limit."""

    what: str
    measure: typing.Callable
    limits: dict             # by scene
    is_share: bool = True
    is_least: bool = False   # else the most
    decimals: int = 1
    of_each: typing.Sequence[str] = ()  # scenes in which every drive has to meet it

    def meets(self, value, limit):
        return value >= limit if self.is_least else value <= limit

    def words(self, value):
        return shown(value, self.decimals) if self.is_share else fixed(value, self.decimals)

    def limit_words(self, scene):
        limit = self.limits[scene]
        number = f"{100 * limit:g} %" if self.is_share else f"{limit:g}"
        return f"{'≥' if self.is_least else '≤'} {number}{', each drive' if scene in self.of_each else ''}"


GOALS = [
    Asked("hits on moving cars: called moving", called(CARS), {"city": 0.88, "ring_road": 0.8, "street": 0.7},
          is_least=True, of_each=["ring_road"]),
    Asked("hits on walkers: called moving", called(WALKERS), {"city": 0.65, "street": 0.82}, is_least=True,
          of_each=["city"]),
    Asked("hits on what stands: called moving", called(["standing"]),
          {"city": 0.005, "ring_road": 0.01, "street": 0.005}, decimals=2, of_each=["city"]),
    Asked("all cells called moving: right", right, dict.fromkeys(SCENES, 0.95), is_least=True),
    Asked("velocity of cars, half of the errors below, m/s", of_things(lambda its: its.velocity(0.5), "car"),
          {"city": 0.3, "ring_road": 0.4, "street": 0.4}, is_share=False, decimals=2),
    Asked("velocity of cars, root mean square error, m/s", of_things(Things.velocity_rms, "car"),
          {"city": 1.0, "ring_road": 1.3, "street": 1.5}, is_share=False, decimals=2),
    Asked("reported to move and does not", of_things(Things.wrong),
          {"city": 0.015, "ring_road": 0.015, "street": 0.02}, decimals=2),
    Asked("cars: other ids a minute in view", of_things(Things.other_ids_a_minute, "car"),
          {"city": 5, "ring_road": 15, "street": 8}, is_share=False),
    Asked("velocity of cars within two stated deviations", of_things(Things.within_two_deviations, "car"),
          dict.fromkeys(SCENES, 0.95), is_least=True),
]


def _goals_and_rows(scenes):
    goals, rows = [], []
    for asked in GOALS:
        for scene, limit in asked.limits.items():
            together, each = asked.measure(scenes[scene]), scenes[scene].each(asked.measure)
            met = sum(asked.meets(value, limit) for value in each)
            is_met = met == len(each) if scene in asked.of_each else asked.meets(together, limit)
            span = [asked.words(value) for value in (min(each), max(each))]
            rows.append([asked.what, SCENES[scene], asked.limit_words(scene), asked.words(together), *span,
                         f"{met} of {len(each)}", "met" if is_met else "**missed**"])
            goals.append(Goal(f"things, {SCENES[scene]}: {asked.what}", asked.limit_words(scene),
                              f"{span[0]} to {span[1]}" if scene in asked.of_each else asked.words(together),
                              is_met))
    return goals, rows


def _from_to(measure_of_rule, drives, decimals, **where):
    alone, default = (measure_of_rule(rule)(drives, **where) for rule in (ALONE, DEFAULT))
    if default != default:
        return "–"
    return f"{fixed(100 * alone, decimals)} → {fixed(100 * default, decimals)}"


def _cell_row(drives, **where):
    return [_from_to(lambda rule: called(["standing"], rule), drives, 2, **where),
            _from_to(lambda rule: called(CARS, rule), drives, 1, **where),
            _from_to(lambda rule: called(WALKERS, rule), drives, 1, **where),
            _from_to(lambda rule: lambda its, **which: right(its, rule, **which), drives, 1, **where)]


def _cell_rows(scenes):
    return [[SCENES[scene], *_cell_row(drives)] for scene, drives in scenes.items()]


def _drive_rows(scenes):
    rows = []
    for scene, drives in scenes.items():
        for seed in drives.seeds:
            cars, all_things = drives.things("car", seed=seed), drives.things(seed=seed)
            rows.append([SCENES[scene], seed, *_cell_row(drives, seed=seed), shown(all_things.wrong()),
                         fixed(cars.velocity(0.5), 2), fixed(cars.velocity_rms(), 2), shown(cars.recall()),
                         fixed(all_things.gospa(), 2)])
    return rows


def _thing_rows(scenes):
    """A column a kind of mover."""
    kinds = [scenes[scene].things(what) for scene, what in KINDS]
    never = [its.never_told() for its in kinds]
    return [
        ["frames of movers", *(grouped(its.frames) for its in kinds)],
        ["told", *(shown(its.recall()) for its in kinds)],
        ["told, from 0.5 s in view on", *(shown(its.late_recall()) for its in kinds)],
        ["told first after, half of them", *(f"{fixed(its.delay_s(0.5), 2)} s" for its in kinds)],
        ["told first after, 9 of 10", *(f"{fixed(its.delay_s(0.9), 2)} s" for its in kinds)],
        ["never told, of those in view for 1 s", *(f"{few} of {many}" for few, many in never)],
        ["error of the velocity, m/s: half below", *(fixed(its.velocity(0.5), 2) for its in kinds)],
        ["root mean square", *(fixed(its.velocity_rms(), 2) for its in kinds)],
        ["95 % below", *(fixed(its.velocity(0.95), 2) for its in kinds)],
        ["within two stated deviations", *(shown(its.within_two_deviations()) for its in kinds)],
        ["other ids a minute in view", *(fixed(its.other_ids_a_minute(), 1) for its in kinds)]]


def _frame_rows(scenes):
    """A row a scene, of all its frames."""
    rows = []
    for scene, drives in scenes.items():
        its = drives.things()
        rows.append([SCENES[scene], fixed(its.a_frame("movers"), 2), fixed(its.a_frame("reported"), 2),
                     shown(its.wrong()), fixed(its.gospa(), 2), fixed(its.a_frame("gospa_place_m"), 2),
                     fixed(its.a_frame("gospa_missed"), 2), fixed(its.a_frame("gospa_wrong"), 2),
                     fixed(its.a_frame("tracks"), 0), int(its.drives["most_tracks"].max())])
    return rows


def _poses(data):
    """Hits on what stands that are called moving after a leap of the poses without a cause."""
    def of(poses, rule):
        scores = Scores(data, "perception_poses", poses=poses, rule=rule)
        return shown(scores.said_of(["standing"]).moving, 2)
    return SimpleNamespace(alone=of("jump of 0.25 m", ALONE), default=of("jump of 0.25 m", DEFAULT),
                           usual=of("usual", DEFAULT))


def section(data) -> Section:
    scenes = {scene: Drives(data, scene) for scene in SCENES}
    goals, goal_rows = _goals_and_rows(scenes)
    left = sum(int(drives.things().drives[column].sum()) for drives in scenes.values()
               for column in ("hits_left", "tracks_refused"))
    return Section(
        found={"seeds": scenes["city"].seeds, "goal_rows": goal_rows, "met": sum(goal.is_met for goal in goals),
               "asked": len(goals), "cell_rows": _cell_rows(scenes), "drive_rows": _drive_rows(scenes),
               "kinds": [f"{SCENES[scene]}: {KIND_NAMES[what]}" for scene, what in KINDS],
               "thing_rows": _thing_rows(scenes), "frame_rows": _frame_rows(scenes), "cut_m": CUT_M,
               "city_cars": scenes["city"].things("car"), "ring_cars": scenes["ring_road"].things("car"),
               "poses": _poses(data), "left": left},
        goals=goals)
