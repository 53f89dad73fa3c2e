"""What each choice of the computation costs, held against the simulator's truth and, on recordings,
against the hits themselves."""

import math
from types import SimpleNamespace

from results import choice_maps
import plots
from results.choices import (BAYES, DOUBLE, HITS_WIN, MAXIMUM, NEAREST, POOL, SEQUENTIAL, both, on_drive,
                     on_recordings)
from claims import Claim, Verdict
from markdown import fixed, grouped, percent, scientific
from section import Section, one, select
from results.price_of_hits_win import Prices

DEFAULT_EPSILON = 0.05
INT8_LIMIT = 127
RARE = 1e-4  # of the visibly free cells
WIDE = [0.01, 0.001]  # epsilons that were also tried with an index that never saturates
BEAM_EVERY_DEGREES = 0.5  # an ibeo LUX
RANGE_NOISE_CM = 7  # of the simulated one (tools/simulate/scanners/echo_model.cpp)
RULES = [HITS_WIN, BAYES, SEQUENTIAL, DOUBLE, POOL, MAXIMUM]
TRAVERSALS = [HITS_WIN, "hits_win, Bresenham", BAYES, "bayes, Bresenham"]
SAMPLINGS = [HITS_WIN, "hits_win, cell centre", "hits_win, entry",
             BAYES, "bayes, cell centre", "bayes, entry"]
COLUMNS = ["choice", "occupied recall", "precision", "free recall", "precision", "area under ROC",
           "missed", "phantoms", "hits lost"]


def _at(rule, epsilon, wide=False):
    """The name of an index rule with another epsilon."""
    if epsilon == DEFAULT_EPSILON:
        return {"hits_win": HITS_WIN, "bayes": BAYES}[rule]
    return f"{rule}, epsilon {epsilon}{', wide' if wide else ''}"


class _Indexes:
    """What a scan point is worth under each epsilon of the sweep."""

    def __init__(self, data):
        self._indexes, self._sets = data["choice_indexes"], data["choice_sets"]
        self.p = dict(zip(data["choice_model"]["step"], data["choice_model"]["p"]))
        self.sweep = list(self._sets["epsilon"])  # from the largest

    def at(self, step, epsilon=DEFAULT_EPSILON, policy="blurring"):
        return int(one(self._indexes, "index", epsilon=epsilon, policy=policy, step=step))

    @property
    def free(self):
        return self.at(-12)

    def beams_to_fill(self, epsilon, policy="blurring"):
        return INT8_LIMIT // -self.at(-12, epsilon, policy) + 1

    def of_set(self, column, epsilon):
        return one(self._sets, column, epsilon=epsilon)

    def first(self, is_so):
        """The largest epsilon of the sweep at which that is so."""
        return next(epsilon for epsilon in self.sweep if is_so(epsilon))

    def rows(self):
        return [[fixed(epsilon, 3), policy, ", ".join(str(index) for index in rows["index"]),
                 scientific(self.of_set("p_minus_127", epsilon), 1),
                 self.beams_to_fill(epsilon, policy)]
                for (epsilon, policy), rows in
                self._indexes.groupby(["epsilon", "policy"], sort=False)]


def _quantisations(sweep):
    """Their names, in the order of the table."""
    return [name for rule in ("hits_win", "bayes")
            for name in [f"{rule}, nearest", *(_at(rule, epsilon) for epsilon in sweep),
                         *(_at(rule, epsilon, wide=True) for epsilon in WIDE)]]


def _recall(data, choice, free_share):
    """The best exact recall of a threshold that lets through no more visibly free cells."""
    rows = select(data["detection_quality_recall"], choice=choice)
    near = rows[(rows["largest_share_of_visibly_free"] / free_share - 1).abs() < 1e-9]
    assert len(near) == 1, f"no recall of {choice} at {free_share}"
    return near["share_of_visibly_occupied"].iloc[0]


def _displaced(data):
    """The shares of the hits that do not mark the cell that holds them."""
    rows = {row.sampling: row for row in data["choice_displaced_hits"].itertuples()}
    shares = {name: row.displaced_hits / row.hits for name, row in rows.items()}
    any_row = rows["own cell"]
    return SimpleNamespace(own=shares["own cell"], centre=shares["cell centre"],
                           entry=shares["entry"], hits=any_row.hits, points=any_row.points)


def _check_measures(choices):
    """What the explanation of the measures says of all choices."""
    known = choices[DOUBLE].known.occupied
    assert all(choice.occupied.recall <= known for choice in choices.values()), \
        "a recall is above what a scan says anything of"


def _check_quantisation(choices, indexes):
    """What the words on quantisation say of the indexes, beside what the template asks itself."""
    coarse = indexes.sweep[0]
    assert indexes.p[0] < indexes.of_set("p_1", coarse), "a hit is above p_1 of the coarsest set"
    assert choices[_at("hits_win", coarse)].occupied.called == 0, "the coarsest set marks cells"
    assert indexes.at(1, policy="nearest") > 0 == indexes.at(1), "nearest does not mark k + 1"
    for epsilon in WIDE:
        narrow, wide = (choices[_at("hits_win", epsilon, is_wide)] for is_wide in (False, True))
        assert (narrow.occupied, narrow.free) == (wide.occupied, wide.free), \
            "an int8 changes a sign under hits_win"


def _shipped(choices, indexes, data):
    """Why the shipped settings are what they are: asserted here, or asked by the template."""
    nine = [epsilon for epsilon in indexes.sweep if indexes.beams_to_fill(epsilon) > 9 and
            indexes.of_set("p_minus_127", epsilon) < 1e-11]
    assert min(nine) == DEFAULT_EPSILON, "0.05 is not the smallest epsilon with room for nine beams"
    finer = _at("hits_win", 0.02)
    assert choices[finer].occupied == choices[NEAREST].occupied, "0.02 is not nearest"
    others = [choices[name] for name in TRAVERSALS + SAMPLINGS
              if name.startswith("hits_win,")]
    blurring, nearest = choices[HITS_WIN], choices[NEAREST]
    prices = Prices(data)
    return SimpleNamespace(
        at_same_rate=_recall(data, NEAREST, blurring.false_alarms),
        room_at_002=INT8_LIMIT // -indexes.at(-12, 0.02),
        fill_below=[indexes.beams_to_fill(epsilon) for epsilon in indexes.sweep if epsilon < 0.02],
        gained=max(abs(indexes.p[step] - 0.5) for step in (-1, 2)),
        only_exact_keeps_all=(blurring.ended.occupied == blurring.ended.all and
                              all(each.ended.occupied < each.ended.all for each in others)),
        blurring_is_cheaper=(blurring.phantoms < nearest.phantoms and
                             prices.of_drop(HITS_WIN) < prices.of_drop(NEAREST) and
                             all(prices.narrowing_cm(metres, HITS_WIN) <
                                 prices.narrowing_cm(metres, NEAREST)
                                 for metres in prices.gap_distances)))


LOST_HITS = "hits_win: a beam that passes over a cell does not erase a hit in it"


def _better_if_fewer(ours, sum_):
    return Verdict.BEATS if ours < sum_ else Verdict.FALLS_SHORT


def _claim_on_lost_hits(choices):
    ours, of_sum = choices[HITS_WIN].ended.lost, choices[SEQUENTIAL].ended.lost
    return Claim("equation 4.4", "cells in which a beam ended that come out free, simulated drive",
                 f"{percent(of_sum, 1)} under its sum, counted here", percent(ours, 1),
                 _better_if_fewer(ours, of_sum), LOST_HITS)


def _claim_on_float(choices):
    ours, in_double = choices[_at("bayes", WIDE[-1], wide=True)].area, choices[DOUBLE].area
    is_same = abs(ours - in_double) < 0.01
    return Claim("section 4.3.2.1",
                 "area under ROC of the index sum as epsilon falls to 0.001, wide",
                 f"that of floating-point Bayes, {fixed(in_double, 3)} counted here",
                 fixed(ours, 3), Verdict.EQUALS if is_same else Verdict.DEPARTS,
                 "" if is_same else "our reading: values that epsilon still rounds to 1/2")


def _claim_on_maximum(choices):
    maximum, bayes = choices[MAXIMUM].occupied.wrong, choices[DOUBLE].occupied.wrong
    is_so = maximum > bayes
    return Claim("section 2.4.4", "wrongly occupied cells of the maximum policy",
                 "favours false positives", f"{grouped(maximum)} against {grouped(bayes)} of Bayes",
                 Verdict.EQUALS if is_so else Verdict.DEPARTS,
                 "" if is_so else "our reading: this drive has too few false echoes")


def _claim_on_nearest(choices):
    blurring, nearest = choices[HITS_WIN], choices[NEAREST]
    falls_short = blurring.occupied.recall < nearest.occupied.recall
    return Claim("section 3.4.4.1", "exact occupied recall, blurring (default) against nearest",
                 f"{percent(nearest.occupied.recall, 1)} with nearest, counted here",
                 percent(blurring.occupied.recall, 1),
                 Verdict.FALLS_SHORT if falls_short else Verdict.BEATS,
                 f"nearest also marks behind a hit: {fixed(nearest.phantoms, 1)} phantom cells a "
                 f"frame against {fixed(blurring.phantoms, 1)}")


def _claim_on_recording(name, ended):
    ours, of_sum = ended[HITS_WIN].lost, ended[SEQUENTIAL].lost
    return Claim("equation 4.4", f"hits lost on recording `{name}`",
                 f"{percent(of_sum, 1)} under its sum, counted here", percent(ours, 1),
                 _better_if_fewer(ours, of_sum), LOST_HITS)


def _recording_rows(recordings):
    """One row for each choice that leaves a hit out on any recording; the others' names."""
    rows, flawless = [], []
    for name in next(iter(recordings.values())).ended:
        ended = [recording.ended[name] for recording in recordings.values()]
        if all(each.occupied == each.all for each in ended):
            flawless.append(name)
        else:
            rows.append([name, *(both(each.lost, each.left_unknown) for each in ended)])
    return rows, flawless


def _roc(data, choices):
    ours = choices[HITS_WIN]
    of_sum = _recall(data, BAYES, ours.false_alarms)
    drawing, axes = plots.figure(
        f"At the line hits_win finds {percent(ours.occupied.recall, 0)}, "
        f"the sum {percent(of_sum, 0)}",
        "share of the visibly free cells at or above the threshold",
        "share of the visibly\noccupied cells")
    curves = data["detection_quality_roc"].groupby("choice", sort=False)
    for (name, curve), dash in zip(curves, plots.DASHES):
        axes.plot(curve["share_of_visibly_free"], curve["share_of_visibly_occupied"],
                  linestyle=dash, drawstyle="steps-post", label=name)
    axes.axvline(ours.false_alarms, color=plots.PAPER, linewidth=1)
    axes.annotate(f"{percent(ours.false_alarms, 2)} of the free", (ours.false_alarms, 0.02),
                  xytext=(6, 0), textcoords="offset points")
    axes.set_xscale("log")
    axes.set_xlim(3e-6, 1)
    axes.legend(fontsize=12)
    return drawing


def _pictures(data):
    """One for each question: the same frame under its choices."""
    truth = choice_maps.maps(data["choice_map_truth"])

    def shown(question, *also):
        maps = choice_maps.maps(data[f"choice_map_{question}"], truth["hits"])
        return {**maps, **{name: truth[name] for name in also}}
    rule, epsilon = shown("rule", "truth", "hits"), shown("epsilon", "truth", "hits")
    traversal, sampling = shown("traversal", "truth"), shown("sampling", "truth", "hits")
    _check_pictures(rule, epsilon, traversal, sampling)
    return {
        "choice_of_rule.png": choice_maps.figure(
            "Under every Bayes beams erase hits, under hits_win none", rule),
        "choice_of_epsilon.png": choice_maps.figure(
            "hits_win: the finer the quantisation, the thicker a hit", epsilon),
        "choice_of_traversal.png": choice_maps.figure(
            "Along Bresenham's line hits_win loses hits and free cells", traversal),
        "choice_of_sampling.png": choice_maps.figure(
            "Sampled at a cell's centre or entry, more hits are lost", sampling)}


def _check_pictures(rule, epsilon, traversal, sampling):
    """That they show what their titles say."""
    assert rule[HITS_WIN].lost == 0 < min(rule[name].lost for name in (BAYES, SEQUENTIAL, DOUBLE))
    occupied = [epsilon[_at("hits_win", each)].count("oO") for each in (0.2, 0.05, 0.02, 0.005)]
    assert occupied == sorted(set(occupied)), "a finer quantisation marks no more cells"
    exact, bresenham = (traversal[name] for name in TRAVERSALS[:2])
    assert exact.lost < bresenham.lost and exact.count("fF") > bresenham.count("fF")
    for own, *others in (SAMPLINGS[:3], SAMPLINGS[3:]):
        assert all(sampling[own].lost < sampling[other].lost for other in others)


def section(data) -> Section:
    choices, recordings = on_drive(data), on_recordings(data)
    indexes = _Indexes(data)
    _check_measures(choices)
    _check_quantisation(choices, indexes)
    rate = choices[HITS_WIN].false_alarms
    rows, flawless = _recording_rows(recordings)
    tables = {name: [choices[each].row() for each in names] for name, names in
              [("rules", RULES), ("quantisations", _quantisations(indexes.sweep)),
               ("traversals", TRAVERSALS), ("samplings", SAMPLINGS)]}
    return Section(
        found={"choices": choices, "columns": COLUMNS, "tables": SimpleNamespace(**tables),
               "indexes": indexes, "displaced": _displaced(data), "rate": rate,
               "recall": lambda name, free_share=rate: _recall(data, name, free_share),
               "marks_behind": lambda epsilon: indexes.at(1, epsilon) > 0,
               "carves_before": lambda epsilon: indexes.at(-1, epsilon) < 0,
               "fills_at_once": lambda epsilon: indexes.at(-12, epsilon) < -INT8_LIMIT,
               "noise_cm": RANGE_NOISE_CM, "rare": RARE,
               "shipped": _shipped(choices, indexes, data),
               "largest_area": max(choice.area for choice in choices.values()),
               "apart_cm": 100 * 50 * math.radians(BEAM_EVERY_DEGREES),
               "smallest": _at("bayes", WIDE[-1]), "smallest_wide": _at("bayes", WIDE[-1], True),
               "recordings": recordings,
               "recording_columns": ["choice", *(f"`{name}`" for name in recordings)],
               "recording_rows": rows, "flawless": flawless},
        claims=[_claim_on_lost_hits(choices), _claim_on_float(choices), _claim_on_maximum(choices),
                _claim_on_nearest(choices),
                *(_claim_on_recording(name, recording.ended)
                  for name, recording in recordings.items())],
        figures={**_pictures(data), "choice_roc.svg": _roc(data, choices)})
