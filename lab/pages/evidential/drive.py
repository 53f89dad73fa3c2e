"""The thesis's choices on the same simulated drives, beside the firmware's grid."""

import bars
import plots
from claims import Claim, Verdict
from markdown import fixed, grouped, percent
from section import Section, select

SCENES = {"city": "city", "street": "street"}
THESIS, NO_MAP, OURS = "the thesis's", "no map", "the firmware's"
WORDS = ["unknown", "drivable", "non_drivable", "mapped", "moving", "stopped", "unmapped", "free",
         "standing", "open"]
FREE = ["drivable", "non_drivable", "free"]
STANDING = ["mapped", "stopped", "unmapped", "standing"]
STANDS = ["house", "stopped", "beside"]
MOVES = ["moving car", "moving person"]
# Named so in the tables of lab/data, and what they differ in.
GROUPS = {
    "discounting": ["classical", "optimistic", "proportional", "contextual"],
    "rule for time": ["conjunctive", "Dempster", "Yager", "disjunctive"],
    "lidar model": ["reinforced", "imprecise"],
    "specialised": ["occupied sets"],
    "map": ["no map", "map at decision", "our decision"],
}
SHOWN_ON = ["house", "stopped", "beside", "moving car", "moving person"]


class Words:
    """What is said of echoes and of points of the ground, by what they are on."""

    def __init__(self, data, name, key="grid"):
        self.key = key
        self.echoes, self.ground = data[f"{name}_echoes"], data[f"{name}_ground"]

    def share(self, table, grid, on, words):
        rows = table[(table[self.key] == grid) & table["on"].isin(on)]
        return rows[words].to_numpy().sum() / rows[WORDS].to_numpy().sum()

    def of_echoes(self, grid, on, words):
        return self.share(self.echoes, grid, on, words)

    def of_ground(self, grid, on, words):
        return self.share(self.ground, grid, on, words)

    def called(self, grid, word, on):
        """Of the ground that is called so, the share that is on these."""
        rows = select(self.ground, **{self.key: grid})
        called = rows[word].sum()
        return rows[rows["on"].isin(on)][word].sum() / called if called else float("nan")

    def count(self, on):
        rows = self.echoes[self.echoes["on"].isin(on)]
        return rows[rows[self.key] == rows[self.key].iloc[0]][WORDS].to_numpy().sum()


def shown(value, decimals=1):
    return "–" if value != value else percent(value, decimals)


def _row(words, grid):
    return [shown(words.of_echoes(grid, STANDS, STANDING)),
            shown(words.of_echoes(grid, STANDS, ["moving"]), 2),
            shown(words.of_echoes(grid, STANDS, FREE)),
            shown(words.of_echoes(grid, MOVES, ["moving"])),
            shown(words.of_echoes(grid, MOVES, STANDING)),
            shown(words.called(grid, "moving", [*MOVES, "settling"])),
            shown(words.called(grid, "drivable", [*STANDS, *MOVES, "settling"]), 2)]


def _rows(words):
    rows = [["", THESIS, *_row(words, THESIS)]]
    for group, grids in GROUPS.items():
        rows += [[group, grid, *_row(words, grid)] for grid in grids]
    return [*rows, ["", OURS, *_row(words, OURS)]]


def _confusion(words, grid):
    return [[on, grouped(words.count([on])),
             *(shown(words.of_echoes(grid, [on], [word])) for word in WORDS)] for on in SHOWN_ON]


def _conflict_rows(data):
    rows = []
    grids = list(data["evidential_city_conflict"]["grid"])
    for grid in grids:
        cells = [grid]
        for scene in SCENES:
            table = select(data[f"evidential_{scene}_conflict"], grid=grid)
            cells += [fixed(table.iloc[0][f"{kind}_ppm"] / 1e4, 2)
                      for kind in ("appeared", "disappeared", "other")]
        rows.append(cells)
    return rows


def _figure(words, title, on, said):
    grids = [THESIS, *(grid for group in ("discounting", "rule for time", "lidar model")
                       for grid in GROUPS[group]), OURS]
    values = {SCENES[scene]: [100 * words[scene].of_echoes(grid, on, said) for grid in grids]
              for scene in SCENES}
    drawing, _ = bars.horizontal(title, "per cent", grids, values)
    drawing.set_size_inches(8, 8)
    return drawing


def _cells_figure(cells):
    drawing, axes = plots.figure("Echoes of what stands, by the size of cells", "cell, m",
                                 "per cent")
    sizes = list(cells.echoes["cell_m"].unique())
    for number, (name, said) in enumerate((("standing", STANDING), ("moving", ["moving"]),
                                           ("free", FREE))):
        axes.plot(sizes, [100 * cells.of_echoes(size, STANDS, said) for size in sizes],
                  color=plots.COLOURS[number], linestyle=plots.DASHES[number],
                  marker=plots.MARKERS[number], label=f"called {name}")
    axes.set_ylim(bottom=0)
    axes.legend()
    return drawing


def _cell_rows(cells):
    return [[fixed(cell_m, 2), *_row(cells, cell_m)] for cell_m in cells.echoes["cell_m"].unique()]


def _claims(words):
    claims = []
    for scene, name in SCENES.items():
        thesis, ours = (words[scene].of_echoes(grid, STANDS, ["moving"]) for grid in (THESIS, OURS))
        claims.append(Claim(
            "section 8.2", f"what stands and is called moving, {name}", "a clear difference",
            f"{percent(thesis, 1)} of its echoes; by our rule {percent(ours, 2)}",
            Verdict.BEATS if ours < thesis else Verdict.FALLS_SHORT,
            "the thesis's grid and the firmware's on the same scans, table below"))
    for scene, name in SCENES.items():
        thesis, ours = (words[scene].of_echoes(grid, MOVES, ["moving"]) for grid in (THESIS, OURS))
        claims.append(Claim(
            "section 8.2", f"what moves and is called moving, {name}", "clearly detected",
            f"{percent(thesis, 1)} of its echoes; by our rule {percent(ours, 1)}",
            Verdict.BEATS if ours > thesis else Verdict.FALLS_SHORT, "the same table"))
    for scene, name in SCENES.items():
        thesis, ours = (words[scene].called(grid, "drivable", [*STANDS, *MOVES, "settling"])
                        for grid in (THESIS, OURS))
        claims.append(Claim(
            "section 8.2", f"ground called drivable where something is, {name}",
            "well characterised", f"{percent(thesis, 2)}; by our rule {percent(ours, 2)}",
            Verdict.BEATS if ours < thesis else Verdict.FALLS_SHORT, "the same table"))
    found = {rule: max(words[scene].of_echoes(rule, MOVES, ["moving"]) for scene in SCENES)
             for rule in GROUPS["rule for time"]}
    least = min(words[scene].of_echoes(THESIS, MOVES, ["moving"]) for scene in SCENES)
    claims.append(Claim(
        "section 5.2.4", "its rule: echoes of what moves, called moving",
        "adapted to detect what moves", f"at least {percent(least, 1)}; others at most "
        f"{percent(max(found.values()), 1)}",
        Verdict.EQUALS if max(found.values()) < least else Verdict.FALLS_SHORT,
        "" if max(found.values()) < least else "the table below"))
    worst = max(abs(words[scene].of_echoes("reinforced", STANDS, STANDING) -
                    words[scene].of_echoes(THESIS, STANDS, STANDING)) for scene in SCENES)
    claims.append(Claim(
        "section 4.5.2.3", "what is lost without reinforcement", "it does not hinder",
        f"{fixed(100 * worst, 1)} points of the echoes of what stands",
        *((Verdict.EQUALS,) if worst < 0.02 else
          (Verdict.FALLS_SHORT, "what stands and is called standing, table below"))))
    unseen = max(words[scene].of_ground(OURS, ["house"], ["mapped"]) for scene in SCENES)
    named = min(words[scene].of_ground(THESIS, ["house"], ["mapped"]) for scene in SCENES)
    claims.append(Claim(
        "equations 8.1, 8.2", "the inside of houses, called mapped infrastructure",
        percent(named, 1), percent(unseen, 1), Verdict.DEPARTS,
        "nobody sees it: by the pignistic decision the map alone names a cell"))
    return claims


def section(data) -> Section:
    words = {scene: Words(data, f"evidential_{scene}") for scene in SCENES}
    cells = Words(data, "evidential_cells", "cell_m")
    return Section(
        found={"rows": {scene: _rows(words[scene]) for scene in SCENES},
               "counts": {scene: (grouped(words[scene].count(STANDS)),
                                  grouped(words[scene].count(MOVES))) for scene in SCENES},
               "confusion": {scene: {grid: _confusion(words[scene], grid)
                                     for grid in (THESIS, NO_MAP, OURS)} for scene in SCENES},
               "conflict": _conflict_rows(data), "cells": _cell_rows(cells), "words": WORDS,
               "of": words, "of_cells": cells, "thesis": THESIS, "no_map": NO_MAP, "ours": OURS, "stands": STANDS,
               "moves": MOVES, "standing": STANDING, "free": FREE,
               "named_nothing": {scene: words[scene].of_echoes("no map", STANDS, STANDING)
                                 for scene in SCENES},
               "disjunctive_knows": max(
                   1 - words[scene].of_echoes("disjunctive", [*STANDS, *MOVES], ["unknown"])
                   for scene in SCENES)},
        claims=_claims(words),
        figures={"standing_moving.svg": _figure(words, "Echoes of what stands, called moving",
                                                STANDS, ["moving"]),
                 "moving_moving.svg": _figure(words, "Echoes of what moves, called moving", MOVES,
                                              ["moving"]),
                 "cells.svg": _cells_figure(cells)})
