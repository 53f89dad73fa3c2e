"""Table I of the many-core paper: an occupancy grid cell by cell (CBC) and beam by beam (BBB)."""

import types

import bars
import plots
from claims import Claim, Verdict
from cortex_a9 import CortexA9
from markdown import fixed, grouped
from section import Section, one, select

# Table I, on 64 cores, with cells of 0.1 m; in the text, with cells of 0.2 m.
PAPER_CBC_MS = 57.82
PAPER_BBB_MS = 6.26
PAPER_COARSE_BBB_MS = 3.5
PAPER_GPU_CBC_MS = 8  # of a GPU with other data, set beside the 3.5 ms
PAPER_CORE_MEGABYTES = 2  # of memory that its cores have of their own
PAPER_RATIO = PAPER_CBC_MS / PAPER_BBB_MS
FINE_M, COARSE_M = 0.1, 0.2
COUNTS = ("searches", "models_and_fusions")


def _operations_rows(operations):
    return [[f"{fixed(row.cell_m, 1)} m", row.approach,
             *(grouped(count / row.frames)
               for count in (row.searches, row.models_and_fusions, row.cell_accesses))]
            for row in operations.itertuples()]


def _count(operations, count, cell_m, approach):
    return one(operations, count, cell_m=cell_m, approach=approach)


def _ratio(operations, count, cell_m):
    """CBC by BBB."""
    return (_count(operations, count, cell_m, "CBC") / _count(operations, count, cell_m, "BBB"))


def _fine_by_coarse(operations, count):
    """Of BBB."""
    return (_count(operations, count, FINE_M, "BBB") / _count(operations, count, COARSE_M, "BBB"))


def _ratio_rows(operations):
    return [[count.replace("_", " "), *(fixed(_ratio(operations, count, cell_m), 1)
                                        for cell_m in (FINE_M, COARSE_M))] for count in COUNTS]


def _a9_instructions(data):
    """Of the drive's first frame, by approach and the side of a cell."""
    a9 = CortexA9(data)
    return {(approach, cell_m): a9.value(f"many_core approach={approach} cell_mm={mm}",
                                         "instructions")
            for approach, cell_m, mm in (("cbc", FINE_M, 100), ("bbb", FINE_M, 100),
                                         ("cbc", COARSE_M, 200), ("bbb", COARSE_M, 200),
                                         ("integer", FINE_M, 100))}


def _claims(differing, a9_ratio):
    return [
        Claim("many-core paper, section III", "cells in which CBC and BBB differ",
              "none, by equation 6", grouped(differing),
              *((Verdict.EQUALS,) if differing == 0 else
                (Verdict.FALLS_SHORT, "our reading: the model is not 1/2 where a beam stops"))),
        Claim("many-core paper, table I", "CBC by BBB, cells of 0.1 m",
              f"{fixed(PAPER_RATIO, 1)} times the time",
              f"{fixed(a9_ratio, 1)} times the instructions",
              Verdict.BEATS if a9_ratio >= PAPER_RATIO else Verdict.FALLS_SHORT,
              "not the same measure: instructions of one core. Our reading: they leave out the "
              "memory, through which CBC moves every cell")]


def _figure(operations, a9_ratio):
    ratios = {"time on 64 cores,\nby the paper": PAPER_RATIO,
              "instructions on\none Cortex-A9": a9_ratio,
              "searches": _ratio(operations, "searches", FINE_M),
              "models and fusions": _ratio(operations, "models_and_fusions", FINE_M)}
    drawing, _ = bars.horizontal(
        f"Beam by beam takes {fixed(a9_ratio, 1)} times fewer instructions",
        "times as much cell by cell, cells of 0.1 m", list(ratios), {"": list(ratios.values())},
        colours=[plots.PAPER, *[plots.COLOURS[0]] * (len(ratios) - 1)])
    return drawing


def _recordings(data):
    if "many_core_operations_recordings" not in data:
        return []
    return [types.SimpleNamespace(name=name, vehicle=of_it.iloc[0]["vehicle"],
                                  frames=of_it.iloc[0]["frames"], rows=_operations_rows(of_it),
                                  ratios=_ratio_rows(of_it))
            for name, of_it in data["many_core_operations_recordings"].groupby("recording",
                                                                               sort=False)]


def section(data) -> Section:
    operations, differences = data["many_core_operations"], data["many_core_differences"]
    a9 = _a9_instructions(data)
    a9_ratios = {cell_m: a9["cbc", cell_m] / a9["bbb", cell_m] for cell_m in (FINE_M, COARSE_M)}
    pc = data["many_core_on_this_pc"]
    differing = differences["differing_cells"].sum()
    ratios = [["time on 64 cores, by the paper", fixed(PAPER_RATIO, 1), ""],
              *_ratio_rows(operations),
              ["instructions on one Cortex-A9, measured",
               *(fixed(ratio, 1) for ratio in a9_ratios.values())],
              ["time on one core, on this PC",
               *(fixed(one(pc, "cbc_time_by_bbb_time", cell_m=cell_m), 1) for cell_m in a9_ratios)]]
    return Section(
        found={"stop_behind_m": differences.iloc[0]["bbb_stop_behind_m"],
               "frames": operations.iloc[0]["frames"], "operations": _operations_rows(operations),
               "differing": differing, "ratios": ratios, "paper_cbc_ms": PAPER_CBC_MS,
               "paper_bbb_ms": PAPER_BBB_MS, "paper_coarse_bbb_ms": PAPER_COARSE_BBB_MS,
               "paper_gpu_cbc_ms": PAPER_GPU_CBC_MS,
               "paper_core_megabytes": PAPER_CORE_MEGABYTES,
               "saved": {count: 1 - 1 / _ratio(operations, count, FINE_M) for count in COUNTS},
               "fine_by_coarse": {count: _fine_by_coarse(operations, count) for count in COUNTS},
               "a9_fine_by_coarse": a9["bbb", FINE_M] / a9["bbb", COARSE_M],
               "instructions_ratio": fixed(a9_ratios[FINE_M], 1), "paper_ratio": fixed(PAPER_RATIO, 1),
               "integer": a9["integer", FINE_M], "bbb": a9["bbb", FINE_M], "cbc": a9["cbc", FINE_M],
               "recordings": _recordings(data)},
        claims=_claims(differing, a9_ratios[FINE_M]),
        figures={"many_core.svg": _figure(operations, a9_ratios[FINE_M])})
