"""Thesis, table 4.3 and figure 4.14: what a scan point says of the cells around it. Figure 4.6:
what the length of a cell does to that."""

import types

import plots
from claims import Claim, Verdict
from markdown import fixed
from section import Section, one, select

# Table 4.3 by its columns: the cell, the offset of the nearest to k if it stands for many, the ISM
# with two digits, the last of them cut off or rounded, and the index by both policies.
TABLE_4_3 = [("up to k-3", -3, 0.05, -14, -15), ("k-2", -2, 0.18, -7, -7), ("k-1", -1, 0.48, 0, 0),
             ("k", 0, 0.60, 2, 2), ("k+1", 1, 0.54, 0, 1), ("from k+2", 2, 0.50, 0, 0)]
OFFSETS = [column[1] for column in TABLE_4_3]
PAPER_ISM = [column[2] for column in TABLE_4_3]
PAPER_INDEXES = {"blurring": [column[3] for column in TABLE_4_3],
                 "nearest": [column[4] for column in TABLE_4_3]}

# Section 4.2.1.2 on figures 4.6b to 4.6d. Of the middle length it says nothing; table 4.3 does.
PAPER_PEAKS = {0.5: "close to 1", 0.1: "0.6", 0.025: "does not overtake 1/2"}
LONG, SHORT = 0.5, 0.025
P_1 = 0.55  # of the recursive set of epsilon = 0.05


def _at_the_columns(profile, column):
    return [one(profile, column, offset_cells=offset) for offset in OFFSETS]


def _indexes(profile, policy):
    return _at_the_columns(profile, f"{policy}_index")


def _listed(indexes):
    return ", ".join(str(index) for index in indexes)


def _largest_difference(profile):
    """Of the ISM to the paper's, over the six columns."""
    return max(abs(ours - paper)
               for ours, paper in zip(_at_the_columns(profile, "ism"), PAPER_ISM))


def _has_the_indexes(profile, ends, policy):
    """Those of the table; and the cells further away have the outer columns', as far as a beam
    reaches."""
    of_policy = select(ends, policy=policy, exponent="halved")
    return (_indexes(profile, policy) == PAPER_INDEXES[policy] and
            one(of_policy, "same_until_cells") >= OFFSETS[0] and
            one(of_policy, "same_from_cells") <= OFFSETS[-1])


def _has_table_4_3(usual, ends):
    return (_largest_difference(usual) < 0.01 and
            all(_has_the_indexes(usual, ends, policy) for policy in PAPER_INDEXES))


def _equal_or_short(holds):
    return (Verdict.EQUALS,) if holds else (Verdict.FALLS_SHORT, "see the section")


def _claims_on_table_4_3(usual, printed, ends):
    difference = _largest_difference(usual)
    claims = [Claim("table 4.3", "ISM of the six columns", "two digits",
                    f"within {fixed(difference, 3)}", *_equal_or_short(difference < 0.01))]
    for policy, paper in PAPER_INDEXES.items():
        claims.append(Claim("table 4.3", f"indexes, {policy}", _listed(paper),
                            _listed(_indexes(usual, policy)),
                            *_equal_or_short(_has_the_indexes(usual, ends, policy))))
    as_printed = _indexes(printed, "blurring")
    is_needed = as_printed != PAPER_INDEXES["blurring"]
    claims.append(Claim("equation 4.1", "exponent of the sensor model", "-(z-d)^2 / sigma^2",
                        "-(z-d)^2 / (2 sigma^2)",
                        Verdict.DEPARTS if is_needed else Verdict.FALLS_SHORT,
                        f"as printed it gives {_listed(as_printed)} for table 4.3" +
                        (", with the usual 1/2 it gives the table"
                         if _has_table_4_3(usual, ends) else "")))
    return claims


def _claims_on_peaks(peaks):
    usual = select(peaks, exponent="halved")
    long_cell = one(usual, "largest_ism", cell_length_m=LONG)
    short_cell = one(usual, "largest_ism", cell_length_m=SHORT)
    index = one(usual, "blurring_index", cell_length_m=SHORT)
    return [
        Claim("figure 4.6b", "largest ISM with cells of 5 sigma", PAPER_PEAKS[LONG],
              fixed(long_cell, 5), *_equal_or_short(long_cell > 0.99)),
        Claim("figure 4.6d", "largest ISM with cells of sigma / 4", PAPER_PEAKS[SHORT],
              fixed(short_cell, 5),
              *((Verdict.DEPARTS,
                 f"by Theorem 6 it is above 1/2; its index is {index} all the same")
                if short_cell > 0.5 else (Verdict.EQUALS,)))]


def _table_4_3(usual, printed):
    rows = []
    for (cell, offset, ism, blurring, nearest) in TABLE_4_3:
        ours, by_printed = (select(profile, offset_cells=offset).iloc[0]
                            for profile in (usual, printed))
        rows.append([cell, fixed(ism, 2), fixed(ours.ism, 4), blurring, ours.blurring_index,
                     nearest, ours.nearest_index, fixed(by_printed.ism, 4),
                     by_printed.blurring_index, by_printed.nearest_index])
    return rows


def _peaks_table(peaks):
    rows = []
    for length, paper in PAPER_PEAKS.items():
        usual, printed = (select(peaks, exponent=exponent, cell_length_m=length).iloc[0]
                          for exponent in ("halved", "as_printed"))
        rows.append([fixed(length, 3), paper, fixed(usual.largest_ism, 5), usual.blurring_index,
                     fixed(printed.largest_ism, 5), printed.blurring_index])
    return rows


def _profile_figure(usual):
    assert (abs(usual["blurring_p"] - 0.5) <= abs(usual["ism"] - 0.5)).all(), "another title"
    drawing, axes = plots.figure("Blurring never says more than the model", "cell", "probability")
    offsets = usual["offset_cells"]
    axes.plot(offsets, usual["ism"], "-", color=plots.PAPER, label="sensor model, not below 0.05")
    axes.plot(offsets, usual["blurring_p"], "o", label="blurring")
    axes.plot(offsets, usual["nearest_p"], "D", fillstyle="none", markersize=11, label="nearest")
    axes.set_xticks(offsets, ["k" if offset == 0 else f"k{offset:+}" for offset in offsets])
    axes.legend()
    return drawing


def _sensor_model_figure(models):
    drawing, axes = plots.figure("As printed, the Gaussian is narrower",
                                 "z, m (a target at 25 m, sigma = 0.10 m)", "p(z|d), 1/m")
    for exponent, label, dash in (("halved", "usual exponent", "-"),
                                  ("as_printed", "equation 4.1 as printed", "--")):
        curve = select(models, exponent=exponent)
        axes.plot(curve["z_m"], curve["p_per_m"], dash, label=label)
    axes.legend()
    return drawing


def _lengths_figure(lengths):
    drawing, axes = plots.figure("The shorter the cells, the less a beam marks",
                                 "distance from z, m", "P(o_i|z)")
    peaks = []
    for length, dash in zip(PAPER_PEAKS, plots.DASHES):
        cells = select(lengths, exponent="halved", cell_length_m=length)
        peaks.append(cells["ism"].max())
        edges = [*(cells["from_z_m"] - length / 2), cells["from_z_m"].iloc[-1] + length / 2]
        axes.stairs(cells["ism"], edges, baseline=None, linestyle=dash, linewidth=2,
                    label=f"cells of {length} m")
    assert peaks == sorted(peaks, reverse=True), "another title"
    axes.set_xlim(-1.25, 1.25)
    axes.legend(loc="lower right")
    return drawing


def _equation_4_1(usual, printed, ends, models):
    """What it gives as printed, and whether the factor 1/2 makes the difference."""
    curve = select(models, exponent="as_printed")
    step_m = curve["z_m"].iloc[1] - curve["z_m"].iloc[0]
    return types.SimpleNamespace(
        sigma_m=printed["sigma_m"].iloc[0], integral=curve["p_per_m"].sum() * step_m,
        misses=(_largest_difference(printed) >= 0.01 and
                all(_indexes(printed, policy) != paper for policy, paper in PAPER_INDEXES.items())),
        usual_hits=_has_table_4_3(usual, ends))


def _short_cells(peaks, lengths):
    usual, printed = (select(peaks, exponent=exponent, cell_length_m=SHORT).iloc[0]
                      for exponent in ("halved", "as_printed"))
    cells = select(lengths, exponent="halved", cell_length_m=SHORT)
    behind = cells[cells["from_z_m"] >= 0]
    return types.SimpleNamespace(
        above=usual.largest_ism - 0.5, printed_above=printed.largest_ism - 0.5, p_1=P_1,
        overtakes=bool((behind["ism"] >= 0.5).all() and usual.largest_ism > 0.5),
        says_nothing=usual.blurring_index == 0 and printed.blurring_index == 0)


def section(data) -> Section:
    usual, printed = (select(data["profiles"], exponent=exponent)
                      for exponent in ("halved", "as_printed"))
    ends, peaks, lengths = data["profile_ends"], data["cell_length_peaks"], data["cell_lengths"]
    models = data["sensor_models"]
    return Section(
        found={"table_4_3": _table_4_3(usual, printed), "peaks": _peaks_table(peaks),
               "equation_4_1": _equation_4_1(usual, printed, ends, models),
               "short": _short_cells(peaks, lengths)},
        claims=[*_claims_on_table_4_3(usual, printed, ends), *_claims_on_peaks(peaks)],
        figures={"profile.svg": _profile_figure(usual),
                 "sensor_model.svg": _sensor_model_figure(models),
                 "ism_by_cell_length.svg": _lengths_figure(lengths)})
