"""Thesis, figure 3.6, and what its section 3.4.6.3 says of the range that an index needs."""

import plots
from claims import Claim, Verdict
from markdown import fixed, grouped, scientific
from section import Section, one, select

FIGURE_INDEXES = 25  # figure 3.6 shows -25 ... 25


def _figure(elements):
    drawing, axes = plots.figure("A small epsilon puts the set's elements close to 1/2",
                                 "index n", "probability p_n")
    for (epsilon, of_set), marker in zip(elements.groupby("epsilon", sort=False), plots.MARKERS):
        shown = of_set[of_set["n"].abs() <= FIGURE_INDEXES]
        axes.plot(shown["n"], shown["p"], marker, label=f"epsilon = {epsilon}")
    axes.legend()
    return drawing


def _p(elements, epsilon, n):
    return one(elements, "p", epsilon=epsilon, n=n)


def _claims(elements, properties, ranges):
    claims = []
    for epsilon in (0.01, 0.005):
        low, high = (_p(elements, epsilon, n) for n in (-FIGURE_INDEXES, FIGURE_INDEXES))
        claims.append(Claim(
            "figure 3.6", f"p_-25 ... p_25 at epsilon = {fixed(epsilon, 3)}", "inside ]0.2, 0.8[",
            f"{fixed(low, 3)} ... {fixed(high, 3)}", *_verdict(low > 0.2 and high < 0.8)))
    below = _p(elements, 0.05, -127)
    above = one(properties, "complement_of_p_127", epsilon=0.05)
    entries = 2 * one(ranges, "largest_index", epsilon=0.05, tail=1e-11) + 1
    place = "section 3.4.6.3"
    claims.append(Claim(place, "p_-127 at epsilon = 0.05", "below 1e-11", scientific(below, 2),
                        *_verdict(below < 1e-11)))
    claims.append(Claim(place, "1 - p_127 at epsilon = 0.05", "below 1e-11", scientific(above, 2),
                        *_verdict(above < 1e-11)))
    claims.append(Claim(place, "lookup table to a tail of 1e-11 at epsilon = 0.05",
                        "256 entries are enough", f"{grouped(entries)} are needed",
                        *_verdict(entries <= 256)))
    return claims


def _verdict(holds):
    return (Verdict.EQUALS,) if holds else (Verdict.FALLS_SHORT, "p_n by the formula of theorem 3")


def section(data) -> Section:
    elements, properties = data["recursive_sets"], data["recursive_set_properties"]
    ranges = data["recursive_set_ranges"]
    sets = [[fixed(row.epsilon, 3),
             f"{fixed(_p(elements, row.epsilon, -25), 4)} ... {fixed(_p(elements, row.epsilon, 25), 4)}",
             scientific(_p(elements, row.epsilon, -127), 2), scientific(row.complement_of_p_127, 2),
             row.elements_in_005_to_095, scientific(row.largest_difference_to_theorem_3, 0)]
            for row in properties.itertuples()]
    lengths = []
    for epsilon, rows in ranges.groupby("epsilon", sort=False):
        cells = [cell for row in rows.itertuples()
                 for cell in (grouped(2 * row.largest_index + 1), row.index_bytes)]
        lengths.append([scientific(epsilon, 0), *cells, grouped(rows.iloc[0]["free_index"])])
    return Section(
        found={"sets": sets, "lengths": lengths,
               "p_126": _p(elements, 0.05, -126), "p_127": _p(elements, 0.05, -127),
               "entries": 2 * one(ranges, "largest_index", epsilon=0.05, tail=1e-11) + 1,
               "p_127_of_001": _p(elements, 0.01, -127)},
        claims=_claims(elements, properties, ranges),
        figures={"recursive_sets.svg": _figure(select(elements))})
