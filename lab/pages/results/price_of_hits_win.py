"""Where hits_win pays for losing no hit: false echoes that the sensor does not flag, ghosts, and
narrow gaps."""

import math
from types import SimpleNamespace

import plots
from results.choices import BAYES, HITS_WIN, NEAREST, SEQUENTIAL
from claims import Claim, Verdict
from markdown import fixed, percent
from section import Section, one, select

FUSIONS = [HITS_WIN, NEAREST, BAYES, SEQUENTIAL]
BEAM_EVERY_DEGREES = 0.5  # an ibeo LUX
SECOND = "comes second"   # what becomes of the true echo behind a drop
CLAIMED_RAIN = 0.01
CLAIMED_GAP = {"distance_m": 20, "gap_m": 0.5}


class Prices:
    """What the default, nearest and the sum pay."""

    def __init__(self, data):
        self.rain, self.ghosts, self.gaps = (
            data[f"price_of_{name}"] for name in ("rain", "ghosts", "gaps"))
        self.rates = list(self.rain["rate"].unique())
        self.gap_distances = list(self.gaps["distance_m"].unique())

    def wet(self, fusion, rate, true_echo=SECOND):
        """A row of the rain, with means of a frame."""
        row = next(select(self.rain, fusion=fusion, rate=rate, true_echo=true_echo).itertuples())
        return SimpleNamespace(
            drops=row.drops / row.frames, phantoms=row.phantom_cells / row.frames,
            missed=row.missed_near_cells / row.visibly_occupied_cells,
            free=row.share_of_visibly_free_at_1, occupied=row.share_of_visibly_occupied_at_1,
            sure_free=row.share_of_visibly_free_at_3,
            sure_occupied=row.share_of_visibly_occupied_at_3)

    def of_drop(self, fusion):
        """Phantoms for each drop."""
        dry, wet = self.wet(fusion, 0), self.wet(fusion, self.rates[-1])
        return (wet.phantoms - dry.phantoms) / wet.drops

    def ghost(self, fusion, period):
        """Wrongly occupied cells, frame by frame: of that frame, and of all until then."""
        return select(self.ghosts, fusion=fusion, period_frames=period)

    def gap(self, fusion, distance_m, gap_m):
        row = next(select(self.gaps, fusion=fusion, distance_m=distance_m,
                          gap_m=gap_m).itertuples())
        return SimpleNamespace(free=row.free_cells / row.cells,
                               occupied=row.occupied_cells / row.cells)

    def narrowings_cm(self, distance_m, fusion):
        """By how much a gap looks narrower, for each width."""
        rows = select(self.gaps, fusion=fusion, distance_m=distance_m)
        return 100 * rows["gap_m"] * rows["occupied_cells"] / rows["cells"]

    def narrowing_cm(self, distance_m, fusion):
        return self.narrowings_cm(distance_m, fusion).mean()


def _rain_rows(prices):
    rows = []
    for (true_echo, rate), _ in prices.rain.groupby(["true_echo", "rate"], sort=False):
        wet = {fusion: prices.wet(fusion, rate, true_echo) for fusion in FUSIONS}
        rows.append([percent(rate, 1), true_echo if rate else "-", fixed(wet[HITS_WIN].drops, 1),
                     *(fixed(wet[fusion].phantoms, 1) for fusion in FUSIONS),
                     *(percent(wet[fusion].missed, 1) for fusion in (HITS_WIN, BAYES))])
    return rows


def _rain_figure(prices):
    drawing, axes = plots.figure(
        f"A drop costs hits_win {fixed(prices.of_drop(HITS_WIN), 2)} phantoms, "
        f"the sum {fixed(prices.of_drop(BAYES), 2)}",
        "beams with an unflagged drop, %", "phantoms a frame")
    phantoms = {fusion: [prices.wet(fusion, rate).phantoms for rate in prices.rates]
                for fusion in FUSIONS}
    names = {fusion: fusion for fusion in FUSIONS}
    if phantoms[BAYES] == phantoms[SEQUENTIAL]:  # one line, as the other would hide it
        del names[SEQUENTIAL]
        names[BAYES] = f"{BAYES} and {SEQUENTIAL}"
    for (fusion, name), marker, dash in zip(names.items(), plots.MARKERS, plots.DASHES):
        axes.plot([100 * rate for rate in prices.rates], phantoms[fusion], marker=marker,
                  linestyle=dash, label=name)
    axes.legend()
    return drawing


def _ghost_rows(prices):
    rows = []
    for period in prices.ghosts["period_frames"].unique():
        for grid, column in (("one frame", "occupied_cells"),
                             ("added up", "occupied_cells_of_sum")):
            means = [prices.ghost(fusion, period)[column].mean() for fusion in FUSIONS]
            rows.append([period, grid, *(fixed(mean, 2) for mean in means)])
    return rows


def _ghost(prices):
    """The ghost under hits_win, and what the words on it say."""
    rows = prices.ghosts
    coming = rows[(rows["period_frames"] > 1) & (rows["frame"] > 0)]
    rarely = prices.ghost(HITS_WIN, rows["period_frames"].max())
    always = prices.ghost(HITS_WIN, 1)
    return SimpleNamespace(
        frames=rows["frame"].nunique(), cells=always["occupied_cells"].mean(),
        cells_of_first=rarely["occupied_cells_of_sum"].iloc[0],
        is_seen_whenever_there=(always["occupied_cells"] > 0).all(),
        is_never_in_sum=(select(rows, fusion=BAYES)["occupied_cells"] == 0).all(),
        fades_at_once=(select(coming, fusion=HITS_WIN)["occupied_cells_of_sum"] == 0).all(),
        stays=(always["occupied_cells_of_sum"] > 0).all())


def _gap_rows(prices):
    rows = []
    for (distance_m, gap_m), _ in prices.gaps.groupby(["distance_m", "gap_m"], sort=False):
        gaps = [prices.gap(fusion, distance_m, gap_m) for fusion in FUSIONS]
        rows.append([f"{distance_m} m", f"{fixed(gap_m, 1)} m",
                     *(f"{fixed(100 * gap.free, 1)} / {percent(gap.occupied, 1)}" for gap in gaps)])
    return rows


def _gap_figure(prices):
    drawing, axes = plots.figure("Gaps come out narrower under hits_win",
                                 "width of the gap, m", "free cells of the gap, %")
    for fusion, dash, colour in zip((HITS_WIN, BAYES), plots.DASHES, plots.COLOURS):
        for distance_m, marker in zip(prices.gap_distances, plots.MARKERS):
            rows = select(prices.gaps, fusion=fusion, distance_m=distance_m)
            axes.plot(rows["gap_m"], 100 * rows["free_cells"] / rows["cells"], color=colour,
                      marker=marker, linestyle=dash, label=f"{fusion}, {distance_m} m")
    axes.set_ylim(40, 102)
    axes.legend(ncol=2, loc="lower right")
    return drawing


def _gap(prices):
    """What the words on gaps say."""
    far = prices.gap_distances[-1]
    of_sum = select(prices.gaps, fusion=BAYES, distance_m=far)
    unknown = (of_sum["cells"] - of_sum["free_cells"] - of_sum["occupied_cells"]).sum()
    return SimpleNamespace(
        places=prices.gaps["places"].iloc[0],
        by=lambda fusion: ", ".join(f"{fixed(prices.narrowing_cm(metres, fusion), 1)} cm at "
                                    f"{metres} m" for metres in prices.gap_distances),
        most_cm=max(prices.narrowings_cm(metres, fusion).max()
                    for metres in prices.gap_distances for fusion in FUSIONS),
        far_m=far, apart_cm=100 * far * math.radians(BEAM_EVERY_DEGREES),
        is_rather_unknown=unknown > of_sum["occupied_cells"].sum())


def _claim_on_rain(prices):
    ours, of_sum = (prices.wet(fusion, CLAIMED_RAIN).phantoms for fusion in (HITS_WIN, BAYES))
    share = percent(CLAIMED_RAIN, 0)
    return Claim("equation 4.4",
                 f"phantom cells a frame, {share} of the beams meet unflagged rain",
                 f"{fixed(of_sum, 1)} under its sum, counted here", fixed(ours, 1),
                 Verdict.FALLS_SHORT if ours > of_sum else Verdict.BEATS,
                 "our reading: hits_win believes every echo that is not flagged")


def _claim_on_gaps(prices):
    ours, of_sum = (prices.gap(fusion, **CLAIMED_GAP).free for fusion in (HITS_WIN, BAYES))
    is_less = ours < of_sum
    return Claim("equation 4.4", "free cells of a gap {gap_m} m wide {distance_m} m away".format(
                     **CLAIMED_GAP),
                 f"{percent(of_sum, 1)} under its sum, counted here", percent(ours, 1),
                 Verdict.FALLS_SHORT if is_less else Verdict.EQUALS,
                 "our reading: hits at the gap's edges keep their cells" if is_less else "")


def section(data) -> Section:
    prices = Prices(data)
    free, free_by_sum = (select(prices.gaps, fusion=fusion)["free_cells"].to_numpy()
                         for fusion in (HITS_WIN, BAYES))
    assert (free < free_by_sum).all(), "a gap that is no narrower under hits_win"
    return Section(
        found={"fusions": FUSIONS, "rain_rows": _rain_rows(prices), "of_drop": prices.of_drop,
               "wet": prices.wet(HITS_WIN, CLAIMED_RAIN), "rain": CLAIMED_RAIN,
               "hit": one(data["choice_indexes"], "index", epsilon=0.05, policy="blurring", step=0),
               "ghost_rows": _ghost_rows(prices), "ghost": _ghost(prices),
               "gap_rows": _gap_rows(prices), "gap": _gap(prices)},
        claims=[_claim_on_rain(prices), _claim_on_gaps(prices)],
        figures={"price_of_rain.svg": _rain_figure(prices),
                 "price_of_gaps.svg": _gap_figure(prices)})
