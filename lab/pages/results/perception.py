"""How good the classes of the perception grid are: against the simulator's truth, beside the grid without things and
the rule of Kurdej's thesis, and with bad poses."""

from types import SimpleNamespace

import plots
from claims import Goal
from markdown import fixed, grouped, percent
from section import Section, select

SAID = ["moving", "open", "standing", "free", "unknown"]
SAID_CELLS = [f"{said}_cells" for said in SAID]
DEFAULT, ALONE, THESIS = RULES = ["default", "grid alone", "thesis"]
SCENES = {"city": "city", "ring_road": "ring road", "street": "street"}
HITS_ON = {"standing": "what stands", "moving_car": "a moving car",
           "followed_car": "a car that keeps ahead or behind", "moving_person": "a walker"}
CARS = ["moving_car", "followed_car"]
NEAR_GAP = 2
FAR_GAP = 5
LEAST_HITS = 5  # of a frame, that most of them say something


def share(part, whole):
    return part / whole if whole else float("nan")


def shown(value, decimals=1):
    """A share in per cent; nothing where there is none."""
    return "–" if value != value else percent(value, decimals)


class Scores:
    """What was counted of one drive, or of several together."""

    def __init__(self, data, prefix, **where):
        self.hits, self.moving, self.recent, self.gaps = (
            select(data[f"{prefix}_{name}"], **where)
            for name in ("hits", "moving", "recent", "gaps"))

    def said_of(self, hits_on, from_m=None):
        """Of the hits on these: how many, and the share of each word."""
        rows = self.hits[self.hits["hits_on"].isin(hits_on)]
        rows = rows if from_m is None else rows[rows["range_from_m"] == from_m]
        sums = rows[SAID_CELLS].sum()
        return SimpleNamespace(cells=sums.sum(), **{
            said: share(sums[f"{said}_cells"], sums.sum()) for said in SAID})

    def right(self, of="right", called="called"):
        return share(self.moving[f"{of}_cells"].sum(), self.moving[f"{called}_cells"].sum())

    def right_with_evidence(self):
        return self.right("right_with_evidence", "called_with_evidence")

    def kept(self, material=None):
        rows = self.recent if material is None else select(self.recent, material=material)
        return share(rows["kept_cells"].sum(), rows["hit_cells"].sum())

    def freed(self):
        """Of what is not kept, the share that is called free."""
        sums = self.recent[["hit_cells", "kept_cells", "freed_cells"]].sum()
        return share(sums["freed_cells"], sums["hit_cells"] - sums["kept_cells"])

    def lost_on(self, material):
        """Of what is not kept, the share that is of this material."""
        of_it = select(self.recent, material=material)
        lost, of_all = (rows["hit_cells"].sum() - rows["kept_cells"].sum()
                        for rows in (of_it, self.recent))
        return share(lost, of_all)

    def unknown(self, within=NEAR_GAP):
        rows = select(self.gaps, known_within_cells=within)
        return share(rows["unknown_cells"].sum(), rows["between_cells"].sum())


# What is measured, the goal in words, the value of a drive's scores, whether it is met, decimals.
MEASURES = [
    ("hit in 3 of the last 12 frames, and kept", "≥ 99 %", Scores.kept, lambda x: x >= 0.99, 2),
    ("hits on what stands: called moving, city", "≤ 0.5 %",
     lambda scores: scores.said_of(["standing"]).moving, lambda x: x <= 0.005, 2),
    ("hits on what stands: called moving, ring road", "≤ 1 %",
     lambda scores: scores.said_of(["standing"]).moving, lambda x: x <= 0.01, 2),
    ("hits on moving cars: called moving", "≥ 80 %",
     lambda scores: scores.said_of(CARS).moving, lambda x: x >= 0.8, 1),
    ("hits on walkers: called moving", "≥ 65 %",
     lambda scores: scores.said_of(["moving_person"]).moving, lambda x: x >= 0.65, 1),
    ("cells called moving, with evidence: right", "≥ 95 %", Scores.right_with_evidence,
     lambda x: x >= 0.95, 1),
    ("all cells called moving: right", "≥ 95 %", Scores.right, lambda x: x >= 0.95, 1),
    ("unknown beyond 20 m, known within 0.2 m", "< 5 %", Scores.unknown, lambda x: x < 0.05, 1),
]


def _is_asked(what, scene):
    """Some goals are of one scene; the ring road has no walkers."""
    if what.endswith((", city", ", ring road")):
        return what.endswith(f", {SCENES[scene]}")
    return not (scene == "ring_road" and "walkers" in what)


def _goals_and_rows(data, seeds):
    """Of each goal every drive has to meet it."""
    goals, rows = [], []
    for what, goal, value, is_met, decimals in MEASURES:
        for scene in ("city", "ring_road"):
            if not _is_asked(what, scene):
                continue
            together, alone, thesis = (value(Scores(data, "perception", scene=scene, rule=rule)) for rule in RULES)
            ours = [value(Scores(data, "perception", scene=scene, seed=int(seed), rule=DEFAULT)) for seed in seeds]
            met = sum(is_met(one) for one in ours)
            verdict = "met" if met == len(seeds) else f"**missed**: met by {met} of {len(seeds)}"
            short = what.removesuffix(", city").removesuffix(", ring road")
            shares = sorted(100 * one for one in ours)
            goals.append(Goal(f"classes, {SCENES[scene]}: {short}", f"{goal}, every drive",
                              f"{fixed(shares[0], decimals)} to {fixed(shares[-1], decimals)} %",
                              met == len(seeds), "" if met == len(seeds) else f"met by {met} of {len(seeds)}"))
            rows.append([short, SCENES[scene],
                         goal, shown(together, decimals), fixed(shares[0], decimals), fixed(shares[-1], decimals),
                         verdict, shown(alone, decimals), shown(thesis)])
    return goals, rows


def _hit_rows(data, rule):
    rows = []
    for scene in ("city", "ring_road", "street"):
        prefix = "perception_street" if scene == "street" else "perception"
        scores = Scores(data, prefix, scene=scene, rule=rule)
        for hits_on, name in HITS_ON.items():
            said = scores.said_of([hits_on])
            if said.cells:
                rows.append([SCENES[scene], name, grouped(said.cells),
                             *(fixed(100 * getattr(said, word), 2) for word in SAID)])
    return rows


def _range_rows(data):
    """By the grid alone and with things."""
    rows = []
    for scene in SCENES:
        prefix = "perception_street" if scene == "street" else "perception"
        alone, default = (Scores(data, prefix, scene=scene, rule=rule) for rule in (ALONE, DEFAULT))
        for hits_on, name in HITS_ON.items():
            cells = []
            for from_m in (0, 15, 30):
                before, after = (scores.said_of([hits_on], from_m) for scores in (alone, default))
                decimals = 2 if hits_on == "standing" else 1
                cells.append(f"{fixed(100 * before.moving, decimals)} → {fixed(100 * after.moving, decimals)} of "
                             f"{grouped(after.cells)}" if after.cells else "–")
            if set(cells) != {"–"}:
                rows.append([SCENES[scene], name, *cells])
    return rows


def _moving_rows(data):
    rows = []
    for scene in ("city", "ring_road"):
        for rule in RULES:
            scores = Scores(data, "perception", scene=scene, rule=rule)
            rows.append([SCENES[scene], rule, grouped(scores.moving["called_cells"].sum()),
                         shown(scores.right()), shown(scores.right("left_lately")),
                         shown(1 - scores.right() - scores.right("left_lately")),
                         shown(scores.right_with_evidence())])
    return rows


def _recent_rows(data, seeds):
    rows = []
    for scene in ("city", "ring_road"):
        together = Scores(data, "perception", scene=scene, rule=DEFAULT)
        drives = [Scores(data, "perception", scene=scene, seed=int(seed), rule=DEFAULT) for seed in seeds]
        for material in together.recent["material"].unique():
            kept = [one.kept(material) for one in drives]
            cells = select(together.recent, material=material)["hit_cells"].sum()
            rows.append([SCENES[scene], material, grouped(cells), shown(together.kept(material), 2),
                         shown(min(one for one in kept if one == one), 2)])
    return rows


def _gap_rows(data):
    rows = []
    for scene in ("city", "ring_road"):
        for rule in ("single frame", THESIS, DEFAULT):
            scores = Scores(data, "perception", scene=scene, rule=rule)
            rows.append([SCENES[scene], rule, shown(scores.unknown(NEAR_GAP)),
                         shown(scores.unknown(FAR_GAP))])
    return rows


def _rule_rows(data, seed):
    rows = []
    drive = {"scene": "city", "seed": seed}
    for rule in select(data["perception_moving"], **drive)["rule"]:
        scores = Scores(data, "perception", rule=rule, **drive)
        stands = scores.said_of(["standing"])
        rows.append([rule, shown(stands.moving, 2), shown(stands.standing),
                     shown(stands.free + stands.unknown, 2), shown(scores.said_of(CARS).moving),
                     shown(scores.said_of(["moving_person"]).moving),
                     shown(scores.right_with_evidence()), shown(scores.kept(), 2),
                     shown(scores.unknown())])
    return rows


def _stop_rows(data):
    stops = data["perception_stops"]
    rows = []
    for (what, from_s), half in stops.groupby(["what", "from_s"]):
        sums = half[SAID_CELLS].sum()
        until = "on" if from_s == stops["from_s"].max() else f"to {fixed(from_s + 0.5, 1)} s"
        rows.append([what, f"{fixed(from_s, 1)} s {until}", grouped(sums.sum()),
                     *(fixed(100 * sums[name] / sums.sum(), 1) for name in SAID_CELLS)])
    return rows


def _stops_figure(data):
    drawing, axes = plots.figure("What stops is soon called standing", "seconds since it stopped",
                                 "hits that are called so, %")
    sums = data["perception_stops"].groupby(["what", "from_s"])[SAID_CELLS].sum()
    for what, colour in zip(("car", "person"), plots.COLOURS):
        of_thing = sums.loc[what]
        for said, dash in zip(("moving", "standing"), plots.DASHES):
            axes.plot(of_thing.index + 0.25,
                      100 * of_thing[f"{said}_cells"] / of_thing.sum(axis=1), color=colour,
                      linestyle=dash, label=f"{what}: {said}")
    axes.legend()
    return drawing


def _stop_times(data):
    """Of cars: the latest frame in which not most of its hits were called standing, thing by
    thing; -1 where there is none."""
    frames = data["perception_stop_frames"]
    frames = frames[frames["hit_cells"] >= LEAST_HITS]
    is_late = 2 * frames["standing_cells"] <= frames["hit_cells"]
    late = [rows[is_late[rows.index]]["since_s"].max()
            for _, rows in frames.groupby(["seed", "thing"])]
    late = [-1 if time_s != time_s else time_s for time_s in late]
    return SimpleNamespace(cars=len(late), at_once=sum(time_s < 0 for time_s in late),
                           latest_s=max(late), is_met=max(late) <= 3)


def _left(data):
    left = data["perception_left"]
    seen = left[left["cleared_after_s"] >= 0]
    free = seen[seen["free_after_s"] >= 0]
    total = seen["cells"].sum()

    def within(column, seconds):
        return share(select_within(seen, column, seconds), total)

    return SimpleNamespace(
        things=len(seen[["seed", "thing"]].drop_duplicates()), cells=total,
        cleared_at_once=within("cleared_after_s", 0), cleared_by_next=within("cleared_after_s", 0.05),
        cleared_at_last_s=seen["cleared_after_s"].max(), free_in_time=within("free_after_s", 1),
        late=free[free["free_after_s"] > 1]["cells"].sum(),
        at_last_s=free["free_after_s"].max(),
        never=seen[seen["free_after_s"] < 0]["cells"].sum())


def select_within(rows, column, seconds):
    return rows[(rows[column] >= 0) & (rows[column] <= seconds)]["cells"].sum()


def _pose_rows(data):
    frames, causes = data["perception_poses_frames"], data["perception_poses_causes"]
    rows = []
    for row in frames.itertuples():
        scores, alone = (Scores(data, "perception_poses", poses=row.poses, rule=rule) for rule in (DEFAULT, ALONE))
        stands = scores.said_of(["standing"])
        of_drive = select(causes, poses=row.poses)
        named = [f"{cause.cause} {cause.times}" for cause in of_drive.itertuples() if cause.times]
        rows.append([row.poses, ", ".join(named) or "none", row.frames_not_placed,
                     row.frames_forgotten, shown(alone.said_of(["standing"]).moving, 2), shown(stands.moving, 2),
                     shown(stands.free, 3),
                     shown(scores.said_of(CARS).moving), shown(scores.right_with_evidence()),
                     shown(scores.kept(), 2)])
    return rows


def _poses(data):
    def of(poses):
        scores = Scores(data, "perception_poses", poses=poses, rule=DEFAULT)
        return SimpleNamespace(stands=scores.said_of(["standing"]).moving,
                               right=scores.right_with_evidence())
    causes = data["perception_poses_causes"].groupby("poses")["times"].sum()
    return SimpleNamespace(of=of, is_silent=lambda poses: causes[poses] == 0)


def section(data) -> Section:
    seeds = [str(seed) for seed in data["perception_moving"]["seed"].unique()]
    first = int(seeds[0])

    def pooled(scene, rule=DEFAULT):
        return Scores(data, "perception", scene=scene, rule=rule)

    def of_first(scene, rule):
        return Scores(data, "perception", scene=scene, seed=first, rule=rule)

    goals, goal_rows = _goals_and_rows(data, seeds)
    return Section(
        found={"seeds": seeds, "goal_rows": goal_rows,
               "hit_rows": _hit_rows(data, DEFAULT), "thesis_rows": _hit_rows(data, THESIS),
               "range_rows": _range_rows(data), "moving_rows": _moving_rows(data),
               "recent_rows": _recent_rows(data, seeds), "gap_rows": _gap_rows(data),
               "rule_rows": _rule_rows(data, first), "stop_rows": _stop_rows(data),
               "stops": _stop_times(data), "left": _left(data), "pose_rows": _pose_rows(data),
               "poses": _poses(data), "pooled": pooled, "of_first": of_first,
               "said": SAID, "least_hits": LEAST_HITS},
        goals=goals,
        figures={"perception_stops.svg": _stops_figure(data)})
