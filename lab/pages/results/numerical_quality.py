"""Thesis, table 4.6: what the quantisation to a recursive set costs after fusion, and why."""

import types

import plots
from claims import Claim, Verdict
from markdown import fixed, grouped, percent, scientific
from section import Section, one, select

POLICIES = ("blurring", "nearest")
# Table 4.6 by epsilon, blurring first.
PAPER = {
    "mean": {1e-1: (4.65e-4, 4.65e-4), 1e-2: (1.12e-4, 7.19e-5), 1e-3: (2.81e-6, 2.56e-6),
             1e-4: (3.28e-7, 2.56e-7), 1e-5: (1.65e-7, 1.69e-8), 1e-6: (1.38e-8, 5.31e-9)},
    "standard_deviation": {
        1e-1: (1.58e-3, 1.58e-3), 1e-2: (5.48e-4, 3.61e-4), 1e-3: (2.65e-5, 2.12e-5),
        1e-4: (4.33e-6, 2.96e-6), 1e-5: (5.89e-7, 3.21e-7), 1e-6: (7.16e-8, 3.46e-8)}}
EPSILONS = list(PAPER["mean"])
TWO_ORDERS = 100  # below epsilon, "regardless of the quantization policy"
OF_EACH = len(EPSILONS) * len(POLICIES)


class Quality:
    """The table by epsilon and policy: the usual exponent, or equation 4.1 as printed."""

    def __init__(self, data, scene="city"):
        here = select(data["numerical_quality"], scene=scene)
        self.rows = select(here, exponent="halved")
        self.printed = select(here, exponent="as_printed")
        self._models = data["quantised_models"]

    def ours(self, statistic, epsilon, policy):
        return one(self.rows, statistic, epsilon=epsilon, policy=policy)

    def step(self, column, step, epsilon, policy, exponent="halved"):
        """Of one measurement in a cell so many steps from that of the scan point."""
        return one(self._models, column, exponent=exponent, epsilon=epsilon, policy=policy,
                   step=step)

    def indexes(self, epsilon, policy, exponent):
        return list(select(self._models, exponent=exponent, epsilon=epsilon,
                           policy=policy)["index"])

    def largest_error(self):
        """Of one measurement, in epsilons."""
        usual = select(self._models, exponent="halved")
        return (usual["error"] / usual["epsilon"]).max()

    def in_epsilons(self, column):
        return self.rows[column] / self.rows["epsilon"]


def _two_orders_below(quality, statistic):
    """How many of the paper's and of our numbers are; and those of the paper that are not."""
    count = types.SimpleNamespace(paper=0, ours=0, above=[])
    for epsilon in EPSILONS:
        for paper, policy in zip(PAPER[statistic][epsilon], POLICIES):
            limit = epsilon / TWO_ORDERS
            count.ours += quality.ours(statistic, epsilon, policy) <= limit
            count.paper += paper <= limit
            if paper > limit:
                count.above.append(f"{scientific(paper, 2)} at {scientific(epsilon, 0)} {policy}")
    return count


def _two_orders(quality):
    mean, deviation = (_two_orders_below(quality, statistic) for statistic in PAPER)
    return types.SimpleNamespace(mean=mean, deviation=deviation)


def _of_each(count):
    return f"{count} of {OF_EACH}"


def _verdict(count):
    if count.ours == OF_EACH:
        return Verdict.EQUALS if count.paper == OF_EACH else Verdict.BEATS
    return Verdict.FALLS_SHORT if count.ours < count.paper else Verdict.DEPARTS


def _falls_with_epsilon(quality, statistic):
    return all(quality.ours(statistic, small, policy) < quality.ours(statistic, large, policy)
               for large, small in zip(EPSILONS, EPSILONS[1:]) for policy in POLICIES)


def _claim_on_falling(quality):
    falls = all(_falls_with_epsilon(quality, statistic) for statistic in PAPER)
    return Claim("table 4.6", "mean and deviation fall with epsilon", "in every row",
                 "in every row" if falls else "not in every row",
                 *((Verdict.EQUALS,) if falls else (Verdict.FALLS_SHORT, "see the section")))


def _of_both(city, ring_road):
    return f"{_of_each(city.ours)} in the city, {_of_each(ring_road.ours)} on the ring road"


def _claims_on_two_orders(quality, city, ring_road):
    """Decided by the ring road, which is taken for the thesis's load; the tables are of the city."""
    near = quality.rows["near_share"]
    return [
        Claim("table 4.6", "mean two orders below epsilon",
              f"all; in its table {_of_each(city.mean.paper)}",
              _of_both(city.mean, ring_road.mean), _verdict(ring_road.mean),
              "decided by the ring road, taken for the thesis's load; of the paper's own these are "
              "not: " + ", ".join(city.mean.above)),
        Claim("table 4.6", "standard deviation two orders below epsilon",
              f"all; in its table {_of_each(city.deviation.paper)}",
              _of_both(city.deviation, ring_road.deviation), _verdict(ring_road.deviation),
              f"{percent(near.min(), 0)} to {percent(near.max(), 0)} of the difference is around "
              "scan points; our reading: there the errors of many beams add up")]


def _policies_agree(quality, exponent):
    return (quality.indexes(EPSILONS[0], "blurring", exponent) ==
            quality.indexes(EPSILONS[0], "nearest", exponent))


def _claim_on_first_row(quality):
    ours = [quality.ours("mean", EPSILONS[0], policy) for policy in POLICIES]
    paper = PAPER["mean"][EPSILONS[0]]
    return Claim("table 4.6", "both policies at epsilon = 1e-1",
                 ", ".join(scientific(mean, 2) for mean in paper),
                 ", ".join(scientific(mean, 2) for mean in ours),
                 Verdict.EQUALS if ours[0] == ours[1] else Verdict.DEPARTS,
                 "the policies agree only for equation 4.1 as printed, which table 4.3 excludes"
                 if _policies_agree(quality, "as_printed") else "see the section")


def _claims_on_errors(quality):
    single, fused = quality.largest_error(), quality.in_epsilons("largest").max()
    return [
        Claim("section 3.4.6.2", "error of one measurement, in epsilons", "at most 1",
              f"at most {fixed(single, 2)}",
              *((Verdict.EQUALS,) if single <= 1 else (Verdict.FALLS_SHORT, "see the section"))),
        Claim("section 3.4.6.3", "error after fusion, in epsilons", "none is added",
              f"up to {fixed(fused, 1)}", Verdict.EQUALS if fused <= 1 else Verdict.DEPARTS,
              "our reading: the sum adds none of its own, but the errors of a cell's N "
              "measurements add up: the bound is N epsilon")]


def _statistic(quality, statistic):
    """Paper and ours side by side, for both policies."""
    rows = []
    for epsilon in EPSILONS:
        row = [scientific(epsilon, 0)]
        for paper, policy in zip(PAPER[statistic][epsilon], POLICIES):
            ours = quality.ours(statistic, epsilon, policy)
            row += [scientific(paper, 2), scientific(ours, 2), fixed(epsilon / ours, 0)]
        rows.append(row)
    return rows


def _origin(quality):
    """Where the difference comes from, in epsilons."""
    rows = []
    for row in quality.rows.itertuples():
        errors = [quality.step("error", step, row.epsilon, row.policy) / row.epsilon
                  for step in range(-3, 3)]
        rows.append([scientific(row.epsilon, 0), row.policy,
                     *(fixed(error, 2) for error in errors), percent(row.near_share, 0),
                     fixed(row.mean_of_known / row.epsilon, 3), fixed(row.largest / row.epsilon, 1),
                     row.largest_of_measurements])
    return rows


def _figure(quality, mean):
    assert mean.ours == OF_EACH, "another title"
    drawing, axes = plots.figure("Our means are two orders below epsilon", "epsilon",
                                 "mean |p_integer - p_float|")
    for place, policy in enumerate(POLICIES):
        style = {"color": plots.COLOURS[place], "marker": plots.MARKERS[place]}
        axes.plot(EPSILONS, [quality.ours("mean", epsilon, policy) for epsilon in EPSILONS],
                  label=f"ours, {policy}", **style)
        axes.plot(EPSILONS, [PAPER["mean"][epsilon][place] for epsilon in EPSILONS], "--",
                  fillstyle="none", label=f"paper, {policy}", **style)
    axes.plot(EPSILONS, [epsilon / TWO_ORDERS for epsilon in EPSILONS], ":", color="black",
              label=f"epsilon / {TWO_ORDERS}")
    axes.set_xscale("log")
    axes.set_yscale("log")
    axes.legend()
    return drawing


def _setting(quality):
    row = quality.rows.iloc[0]
    return types.SimpleNamespace(
        frames=row.frames, cells=row.cells / row.frames, known_share=row.known_cells / row.cells,
        largest_index=quality.rows["largest_index"].max())


def _first_row(quality):
    """At the largest epsilon, where the thesis prints the same digits for both policies."""
    first = EPSILONS[0]
    return types.SimpleNamespace(
        ism=quality.step("ism", -2, first, "blurring"),
        blurring=quality.step("index", -2, first, "blurring"),
        nearest=quality.step("index", -2, first, "nearest"),
        printed_agree=_policies_agree(quality, "as_printed"),
        printed_means=[one(quality.printed, "mean", epsilon=first, policy=policy)
                       for policy in POLICIES])


def _rows(quality):
    """What two rows of the table of origins show."""
    def error(epsilon, step, policy):
        return fixed(quality.step("error", step, epsilon, policy) / epsilon, 2)
    means = [quality.ours("mean", 1e-3, policy) for policy in POLICIES]
    return types.SimpleNamespace(
        agree=all(quality.step("index", step, 1e-3, "blurring") ==
                  quality.step("index", step, 1e-3, "nearest") for step in (-3, -2)),
        apart=means[0] / means[1] - 1,
        free=[error(1e-5, -3, policy) for policy in POLICIES],
        before=[error(1e-5, -1, policy) for policy in POLICIES],
        part=quality.ours("mean", 1e-5, "blurring") / quality.ours("mean", 1e-5, "nearest"),
        paper_part=PAPER["mean"][1e-5][0] / PAPER["mean"][1e-5][1])


def _bounds(quality):
    row = quality.rows.iloc[0]
    rms = quality.in_epsilons("rms_of_known")
    allowed = 1 / TWO_ORDERS / (row.known_cells / row.cells) ** 0.5
    return types.SimpleNamespace(
        words=fixed(quality.in_epsilons("largest").max(), 1),
        above=quality.rows["cells_above_n_epsilon"].sum(),
        fewest=quality.rows["largest_of_measurements"].min(),
        before=quality.step("ism", -1, EPSILONS[0], "blurring"),
        behind=quality.step("ism", 1, EPSILONS[0], "blurring"),
        allowed=allowed, least=rms.min(), most=rms.max(), is_exceeded=bool(rms.min() > allowed))


def section(data) -> Section:
    quality = Quality(data)
    city, ring_road = (_two_orders(Quality(data, scene)) for scene in ("city", "ring_road"))
    return Section(
        found={"setting": _setting(quality), "means": _statistic(quality, "mean"),
               "deviations": _statistic(quality, "standard_deviation"),
               "counted": city, "on_ring_road": ring_road, "of_each": _of_each,
               "first": _first_row(quality), "origin": _origin(quality), "rows": _rows(quality),
               "bounds": _bounds(quality)},
        claims=[_claim_on_falling(quality), *_claims_on_two_orders(quality, city, ring_road),
                _claim_on_first_row(quality), *_claims_on_errors(quality)],
        figures={"numerical_quality.svg": _figure(quality, city.mean)})
