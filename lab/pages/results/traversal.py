"""Thesis, table 4.2 and figure 4.11: what walking in integers misses, and what it costs."""

import types

import plots
from claims import Claim, Verdict
from markdown import fixed, percent
from section import Section, select
from results import traversal_cost

# In percent: figure 4.11a at r = 1, table 4.2 at the others.
PAPER_FOUND = {1: "85 %", 20: "99.50 %", 100: "99.90 %", 200: "99.95 %"}
TABLE_4_2 = {20: 0.9950, 100: 0.9990, 200: 0.9995}
TOLERANCE_POINTS = 0.05  # what the digits of table 4.2 tell

# Walks by other libraries' rules, in the order of the page.
PEERS = {"discrete": "ours, r = 1024",
         "amanatides_woo_double": "Amanatides and Woo, double, as in OctoMap",
         "amanatides_woo_float": "Amanatides and Woo, float",
         "like_cartographer": "like Cartographer: thousandths of a cell",
         "bresenham": "Bresenham", "like_nav2": "like Nav2 and costmap_2d",
         "like_mrpt": "like MRPT: 9 fraction bits"}


class Trials:
    """Crossed cells by resolution and set-up: rounding, the lidar's place, the beams that count."""

    SET_UPS = {"nearest": ("nearest", "corner", "all"), "down": ("down", "corner", "all"),
               "nearest_from_centre": ("nearest", "cell_centre", "all"),
               "down_from_centre": ("down", "cell_centre", "all"),
               "without_special": ("nearest", "corner", "oblique")}

    def __init__(self, data):
        self._table = data["traversal_accuracy"].set_index(
            ["resolution", "rounding", "stand", "beams"]).sort_index()
        self.expected = dict(data["traversal_expected"].itertuples(index=False))
        self.resolutions = list(self.expected)

    def row(self, resolution, set_up="nearest"):
        return self._table.loc[(resolution, *self.SET_UPS[set_up])]

    def found(self, resolution, set_up="nearest"):
        row = self.row(resolution, set_up)
        return row.found_cells / row.crossed_cells

    def missed_cells(self, resolution):
        row = self.row(resolution)
        return row.crossed_cells - row.found_cells

    def largest_shift(self, set_up, resolutions):
        """By how many points a set-up changes what is found at most."""
        return 100 * max(abs(self.found(r, set_up) - self.found(r)) for r in resolutions)


def _claim_at_1(trials):
    ours = trials.found(1)
    down, centre, down_from_centre = (percent(trials.found(1, set_up), 1) for set_up in
                                      ("down", "nearest_from_centre", "down_from_centre"))
    return Claim("figure 4.11a", "crossed cells found at r = 1", PAPER_FOUND[1], percent(ours, 1),
                 Verdict.EQUALS if 0.845 <= ours < 0.855 else Verdict.DEPARTS,
                 f"rounded down {down}, from the centre of a cell {centre} and {down_from_centre}; "
                 "the thesis does not say how it rounds")


def _is_as_in_the_table(trials, resolution):
    return 100 * abs(trials.found(resolution) - TABLE_4_2[resolution]) <= TOLERANCE_POINTS


def _claim_at(trials, resolution):
    ours, paper = trials.found(resolution), TABLE_4_2[resolution]
    if _is_as_in_the_table(trials, resolution):
        verdict = (Verdict.EQUALS,)
    else:
        verdict = (Verdict.BEATS if ours > paper else Verdict.FALLS_SHORT, "see the section")
    return Claim("table 4.2", f"crossed cells found at r = {resolution}", PAPER_FOUND[resolution],
                 percent(ours, 2), *verdict)


def _claim_above_100(trials):
    least = min(trials.found(r) for r in trials.resolutions if r > 100)
    return Claim("figure 4.11a", "crossed cells found above r = 100", "more than 99.9 %",
                 f"at least {percent(least, 2)}",
                 *((Verdict.EQUALS,) if least > 0.999 else
                   (Verdict.FALLS_SHORT, "see the section")))


def _accuracy_table(trials):
    rows = []
    for r in trials.resolutions:
        nearest = trials.row(r)
        shares = [trials.found(r), nearest.beside_cells / nearest.crossed_cells,
                  1 - trials.expected[r], trials.found(r, "down"),
                  trials.found(r, "nearest_from_centre"), trials.found(r, "down_from_centre")]
        rows.append([r, PAPER_FOUND.get(r, ""), *(percent(share, 3) for share in shares)])
    return rows


def _accuracy(trials):
    """What the template says of the table."""
    # Beyond r = 200 a hundred cells and less are missed.
    tenths = [(1 - trials.found(r)) * r for r in trials.resolutions if r <= 200]
    assert all(0.05 < tenth < 0.2 for tenth in tenths), "the misses are not a tenth of 1 / r"
    return types.SimpleNamespace(
        table=_accuracy_table(trials), crossed=trials.row(1).crossed_cells,
        at_product=percent(trials.found(1024), 2),
        is_the_papers=all(_is_as_in_the_table(trials, r) for r in TABLE_4_2),
        tolerance=TOLERANCE_POINTS,
        shifts={set_up: fixed(trials.largest_shift(set_up, TABLE_4_2), 3)
                for set_up in trials.SET_UPS},
        shift_at_1=max(trials.largest_shift(set_up, [1]) for set_up in trials.SET_UPS),
        tenths=(min(tenths), max(tenths)),
        few_missed=[trials.missed_cells(r) for r in trials.resolutions if r >= 500])


def _figure(trials, title, y_label, share):
    """share: of the crossed cells that are found, what is drawn."""
    drawing, axes = plots.figure(title, "r, subcells along a cell", y_label)
    for set_up, label, style in (("nearest", "to the nearest subcell", "o-"),
                                 ("down", "rounded down", "s--")):
        axes.plot(trials.resolutions,
                  [100 * share(trials.found(r, set_up)) for r in trials.resolutions], style,
                  label=label)
    axes.plot(trials.resolutions, [100 * share(1 - trials.expected[r]) for r in trials.resolutions],
              ":", color="black", label="expected, to the nearest")
    axes.set_xscale("log")
    axes.set_xticks([1, 10, 100, 1000], ["1", "10", "100", "1000"])
    return drawing, axes


def _accuracy_figure(trials):
    drawing, axes = _figure(trials, f"At r = 20 the walk finds {percent(trials.found(20), 1)}",
                            "crossed cells found, %", lambda found: found)
    axes.plot(list(PAPER_FOUND), [float(found.split()[0]) for found in PAPER_FOUND.values()], "D",
              color=plots.PAPER, fillstyle="none", markersize=11, label="by the paper")
    axes.legend(loc="lower right")
    return drawing


def _misses_figure(trials):
    drawing, axes = _figure(trials, "Ten times the subcells, a tenth of the misses",
                            "crossed cells missed, %", lambda found: 1 - found)
    axes.set_yscale("log")
    axes.set_yticks([0.01, 0.1, 1, 10], ["0.01", "0.1", "1", "10"])
    axes.legend(loc="lower left")
    return drawing


def _peers(peers):
    rows = []
    for walk, name in PEERS.items():
        row = [name]
        for stand in ("corner", "cell_centre", "opposite_centre"):
            found = select(peers, walk=walk, stand=stand).iloc[0]
            row += [percent(found.found_cells / found.crossed_cells, 2),
                    percent(found.beside_cells / found.crossed_cells, 2)]
        rows.append(row)
    counts = ["found_cells", "beside_cells"]
    bresenham, nav2 = (select(peers, walk=walk) for walk in ("bresenham", "like_nav2"))
    corner = select(bresenham, stand="corner").iloc[0]
    return types.SimpleNamespace(
        table=rows, visited=(corner.found_cells + corner.beside_cells) / corner.crossed_cells,
        nav2_is_bresenham=bool((bresenham[counts].values == nav2[counts].values).all()))


def section(data) -> Section:
    trials = Trials(data)
    costs = traversal_cost.costs(data)
    return Section(
        found={"accuracy": _accuracy(trials), "peers": _peers(data["traversal_peers"]),
               "cost": traversal_cost.found(costs)},
        claims=[_claim_at_1(trials), *(_claim_at(trials, r) for r in TABLE_4_2),
                _claim_above_100(trials), *traversal_cost.claims(costs)],
        figures={"traversal_accuracy.svg": _accuracy_figure(trials),
                 "traversal_misses.svg": _misses_figure(trials)})
