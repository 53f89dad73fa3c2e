"""Thesis, table 4.1: the Bayesian approach by enumeration against Theorem 6."""

import plots
from claims import Claim, Verdict
from markdown import grouped, scientific
from section import Section

ROUNDING = 1e-12  # more would be another formula, not another order of sums


def _figure(grids):
    last = grids.iloc[-1]
    drawing, axes = plots.figure(
        f"{last.cells:.0f} cells: {grouped(last.configurations)} configurations or "
        f"{grouped(last.terms)} terms", "N, cells of the local grid", "likelihoods added up")
    axes.plot(grids["cells"], grids["configurations"], "o-", label="enumeration: configurations")
    axes.plot(grids["cells"], grids["terms"], "s--", label="Theorem 6: terms")
    axes.set_yscale("log")
    axes.legend()
    return drawing


def _has_the_counts(grids):
    return bool((grids["configurations"] == 2 ** grids["cells"]).all() and
                (grids["terms"] == 2 * grids["cells"]).all())


def _claims(grids):
    largest = grids["difference_below"].max()
    last = grids.iloc[-1]
    return [
        Claim("table 4.1", f"Theorem 6 against the enumeration, N up to {last.cells:.0f}",
              "mathematically equivalent", f"difference below {scientific(largest, 0)}",
              *((Verdict.EQUALS,) if largest <= ROUNDING else
                (Verdict.FALLS_SHORT, "more than rounding"))),
        Claim("table 4.1", f"cost of one cell's ISM, N = {last.cells:.0f}",
              "O(2^(N-1)) against O(N)",
              f"{grouped(last.configurations)} configurations against {grouped(last.terms)} terms",
              *((Verdict.EQUALS,
                 "2^(N-1) configurations for each of the two states; at most 2 N terms")
                if _has_the_counts(grids) else (Verdict.FALLS_SHORT, "see the section")))]


def section(data) -> Section:
    grids, lux = data["inverse_sensor_model"], data["inverse_sensor_model_of_lux"].iloc[0]
    firmware = data["inverse_sensor_model_in_firmware"]
    return Section(
        found={"grids": [[row.cells, scientific(row.difference_below, 0),
                          grouped(row.configurations), grouped(row.terms)]
                         for row in grids.itertuples()],
               "has_the_counts": _has_the_counts(grids), "lux": lux,
               "largest": scientific(grids["difference_below"].max(), 0),
               "firmware_lengths": [f"{length:g}" for length in firmware["cell_length_sigmas"]],
               "firmware_difference": firmware["difference_below"].max()},
        claims=_claims(grids), figures={"theorem_6_cost.svg": _figure(grids)})
