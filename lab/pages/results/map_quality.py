"""What a map adds to the names of the perception grid: held against the simulator's truth, with
maps that are right, off and wrong, and without one."""

from types import SimpleNamespace

import matplotlib.colors
import matplotlib.patches
import matplotlib.pyplot as plt
import numpy

import plots  # noqa: F401 ; the look of every plot
from claims import Goal
from markdown import grouped, percent
from section import Section, select

GOAL = 0.005  # drivable where truth is not, with map and pose right
MAPS = ["none", "right", "off, stated", "off, not stated", "wrong"]
SCENES = {"city": "city", "street": "street", "ring_road": "ring road"}
CLASSES = ["drivable", "non_drivable", "free", "moving", "stopped", "stopped_or_unmapped",
           "infrastructure", "occupied"]
FREE = ["drivable", "non_drivable", "free"]
TRUTHS = {"road": "road", "beside": "beside", "moving": "moving", "stopped": "stopped",
          "house": "house", "other": "other"}
COVERED = ["moving", "stopped", "house", "other"]
CELL_M = 0.2  # of a picture: every second cell

# A letter of lab/data/map_quality_pictures.csv: colour, words.
KEY = {".": ("#FFFFFF", "unknown"), "D": ("#8CC9A1", "drivable; in truth: free road"),
       "N": ("#E3D8B8", "non-drivable; in truth: free ground beside"),
       "F": ("#C2E2F5", "free"), "M": ("#0072B2", "moving"), "S": ("#CC79A7", "stopped"),
       "U": ("#D55E00", "stopped or unmapped; in truth: other"),
       "I": ("#333333", "infrastructure; in truth: house"), "O": ("#E69F00", "occupied")}
TRUE_LETTERS = {"r": "D", "b": "N", "m": "M", "s": "S", "h": "I", "o": "U"}


def share(part, whole):
    return part / whole if whole else float("nan")


def shown(value, decimals=3):
    return "–" if value != value else percent(value, decimals)


def not_drivable(rows, counted="cells"):
    """Of what is called drivable, where truth is not: the ground beside, what covers the road."""
    drivable = select(rows, **{"class": "drivable"}).groupby("truth")[counted].sum()
    return SimpleNamespace(cells=drivable.sum(),
                           beside=share(drivable["beside"], drivable.sum()),
                           covered=share(drivable[COVERED].sum(), drivable.sum()),
                           all=share(drivable.drop("road").sum(), drivable.sum()))


def free_on_things(rows):
    """Of what is called free by any name, the share on which something stands or moves."""
    free = rows[rows["class"].isin(FREE)].groupby("truth")["cells"].sum()
    return share(free[COVERED].sum(), free.sum())


def _drivable_rows(cells):
    rows = []
    for scene, name in SCENES.items():
        for kind in MAPS[1:]:
            of_map = select(cells, scene=scene, map=kind)
            wrong, seen = not_drivable(of_map), not_drivable(of_map, "seen_cells")
            rows.append([name, kind, grouped(wrong.cells), shown(wrong.beside),
                         shown(wrong.covered), shown(seen.beside), shown(seen.covered)])
    return rows


def _verdicts(cells):
    """Drive by drive, for the ground alone and for everything."""
    def met(kind, of, limit):
        drives = [getattr(not_drivable(drive), of) <= limit
                  for _, drive in select(cells, map=kind).groupby(["scene", "seed"])]
        return SimpleNamespace(met=sum(drives), of=len(drives), all=all(drives))
    return SimpleNamespace(
        ground=met("right", "beside", GOAL), everything=met("right", "all", GOAL),
        ground_off=met("off, stated", "beside", 2 * GOAL),
        everything_off=met("off, stated", "all", 2 * GOAL),
        ground_silent=met("off, not stated", "beside", 2 * GOAL))


def _goals(verdicts, wrong):
    def drives(what, limit, verdict):
        return Goal(f"map: {what}", f"≤ {percent(limit, 1)} of drivable in every drive",
                    f"met by {verdict.met} of {verdict.of} drives", verdict.all)
    missing = wrong.missing_drivable + wrong.missing_static
    return [
        drives("ground that is no road called drivable", GOAL, verdicts.ground),
        drives("ground that is no road called drivable, map off by 0.5 m and saying so", 2 * GOAL,
               verdicts.ground_off),
        drives("ground that is no road, or covered, called drivable", GOAL, verdicts.everything),
        drives("ground that is no road, or covered, called drivable, map off by 0.5 m and saying so",
               2 * GOAL, verdicts.everything_off),
        Goal("map: free cells in the outlines of ghosts", f"{grouped(wrong.free_before)}, as without a map",
             grouped(wrong.free_with), wrong.free_before == wrong.free_with),
        Goal("map: cells of missing houses called drivable, stopped or infrastructure", "0",
             grouped(missing), missing == 0)]


def _confusion_rows(cells, scene, kind):
    sums = select(cells, scene=scene, map=kind).groupby(["class", "truth"])["cells"].sum()
    return [[name.replace("_", " "), *(grouped(sums[name, truth]) for truth in TRUTHS)]
            for name in CLASSES if sums[name].sum()]


def _recall_rows(cells):
    """Of the free road and of the free ground beside that is called free, the share with a name."""
    rows = []
    for scene, name in SCENES.items():
        for kind in MAPS[1:]:
            sums = select(cells, scene=scene, map=kind).groupby(["class", "truth"])["cells"].sum()
            road, beside, stopped = (
                [sums[called, truth] for called in called_so] for truth, called_so in
                (("road", FREE), ("beside", FREE),
                 ("stopped", ["stopped", "stopped_or_unmapped", "occupied", "infrastructure"])))
            rows.append([name, kind, shown(share(road[0], sum(road)), 1),
                         shown(share(road[1], sum(road)), 1),
                         shown(share(beside[1], sum(beside)), 1),
                         shown(share(beside[0], sum(beside)), 2),
                         shown(share(stopped[0], sum(stopped)), 1)])
    return rows


def _wrong_rows(wrong):
    words = {"ghost_beside": "a ghost beside a road", "ghost_on_road": "a ghost on a road",
             "missing": "a house that is not on the map"}
    rows = []
    for place, what in words.items():
        for kind in ("none", "wrong"):
            sums = select(wrong, place=place, map=kind).groupby("class")["cells"].sum()
            rows.append([what, kind, *(grouped(sums[name]) for name in CLASSES)])
    return rows


def _wrong(wrong):
    def of(place, kind, names):
        rows = select(wrong, place=place, map=kind)
        return rows[rows["class"].isin(names)]["cells"].sum()
    ghosts = ("ghost_beside", "ghost_on_road")
    return SimpleNamespace(
        free_before=sum(of(ghost, "none", FREE) for ghost in ghosts),
        free_with=sum(of(ghost, "wrong", FREE) for ghost in ghosts),
        missing_drivable=of("missing", "wrong", ["drivable"]),
        missing_static=of("missing", "wrong", ["stopped", "infrastructure"]),
        missing_named=of("missing", "wrong", ["stopped_or_unmapped"]))


def _infrastructure(cells):
    def of(kind):
        sums = select(cells, map=kind).groupby(["class", "truth"])["cells"].sum()
        return SimpleNamespace(named=sums["infrastructure"].sum(),
                               right=share(sums["infrastructure", "house"],
                                           sums["infrastructure"].sum()),
                               seen=sum(sums[name, "house"] for name in CLASSES[4:]))
    return SimpleNamespace(right=of("right"), silent=of("off, not stated"))


def _on_things(data):
    """Of what is called free without a map, where something is."""
    rows = data["free_on_things"]
    things = rows[rows["truth"] != "free"]

    def of(scene, **where):
        return select(things, scene=scene, **where)["cells"].sum()

    def row(scene):
        free, on = select(rows, scene=scene)["cells"].sum(), of(scene)
        came = of(scene, truth_when_seen="free")
        over = of(scene, truth_when_seen="covered")
        over_edge = of(scene, truth_when_seen="covered", depth="edge")
        over_now = of(scene, truth_when_seen="covered", last_seen="this frame")
        return SimpleNamespace(free=free, on=on, share=on / free, came=came / on, over=over / on,
                               moving=of(scene, truth="moving") / on, stands=of(scene, truth="stands") / on,
                               inside=of(scene, depth="inside") / on, edge=of(scene, depth="edge") / on,
                               over_edge=over_edge / on, now=of(scene, last_seen="this frame") / on,
                               longer=of(scene, last_seen="longer") / on,
                               near=of(scene, range="15 m") / on, far=of(scene, range="farther") / on,
                               over_now=over_now / free,
                               over_now_within=(over_now - of(
                                   scene, truth_when_seen="covered", last_seen="this frame",
                                   depth="edge")) / free)
    found = {scene: row(scene) for scene in SCENES}
    columns = ["share", "moving", "stands", "came", "over", "edge", "inside", "now", "longer", "near", "far"]
    return SimpleNamespace(
        of=found, rows=[[SCENES[scene], grouped(one.free),
                         *(shown(getattr(one, column), 2 if column == "share" else 0) for column in columns)]
                        for scene, one in found.items()])


def _figure(pictures):
    drawing, panels = plt.subplots(3, 2, figsize=(9, 10.5), dpi=120, height_ratios=[4, 4, 1])
    drawing.suptitle("The same masses, named by maps", fontsize=16, fontweight="bold", x=0.01,
                     ha="left")
    colours = matplotlib.colors.ListedColormap([colour for colour, _ in KEY.values()])
    titles = {"none": "no map", "right": "map", "wrong": "map with errors", "truth": "truth"}
    for axes, (name, title) in zip(panels[:2].flat, titles.items()):
        rows = select(pictures, map=name).sort_values("y_cell")
        letters = numpy.array([list(row) for row in rows["cells"]])
        numbers = numpy.vectorize(lambda letter: list(KEY).index(TRUE_LETTERS.get(letter, letter)))(letters)
        half = letters.shape[0] * CELL_M / 2
        axes.imshow(numbers, origin="lower", interpolation="nearest", cmap=colours, vmin=0,
                    vmax=len(KEY) - 1, extent=(-half, half, -half, half))
        axes.grid(False)
        axes.set_title(title, fontsize=13, fontweight="normal")
        axes.tick_params(labelsize=10)
    patches = [matplotlib.patches.Patch(facecolor=colour, edgecolor="#777777", label=words)
               for colour, words in KEY.values()]
    for axes in panels[2]:
        axes.set_axis_off()
    drawing.legend(handles=patches, loc="lower center", ncols=2, fontsize=11)
    return drawing


def section(data) -> Section:
    cells, wrong = data["map_quality"], data["map_quality_wrong"]
    seeds = [str(seed) for seed in cells["seed"].unique()]
    without = {kind: free_on_things(select(cells, map=kind)) for kind in ("none", "right")}
    verdicts, on_ghosts = _verdicts(cells), _wrong(wrong)
    recall = _recall_rows(cells)
    return Section(
        found={"seeds": seeds, "drivable_rows": _drivable_rows(cells), "goal": GOAL,
               "verdicts": verdicts, "recall_rows": recall,
               "road_drivable": next(row[2] for row in recall if row[:2] == [SCENES["city"], "right"]),
               "confusion": lambda scene, kind: _confusion_rows(cells, scene, kind),
               "truths": list(TRUTHS.values()), "classes": [c.replace("_", " ") for c in CLASSES],
               "wrong_rows": _wrong_rows(wrong), "wrong": on_ghosts,
               "infrastructure": _infrastructure(cells), "without": without,
               "on_things": _on_things(data)},
        goals=_goals(verdicts, on_ghosts),
        figures={"map_quality.png": _figure(data["map_quality_pictures"])})
