"""Time and memory of the evidential thesis's grid beside ours."""

from types import SimpleNamespace

from claims import Claim, Verdict
from cortex_a9 import CortexA9
from markdown import fixed, grouped
from section import Section, one, select

PRINTED_MS = 300  # section 8.1
PRINTED_CELLS = 160 * 160
WINDOW_CELLS = 1024 * 1024
SCENES = ("city", "street")
DRIVES = {"city": "city", "ring_road": "ring road"}
DOUBLE_BYTES = 8
EVERY_SET = 64


def _time_rows(data):
    rows = []
    for grid in data["evidential_city_on_this_pc"]["grid"]:
        cells = [grid]
        for scene in SCENES:
            row = select(data[f"evidential_{scene}_on_this_pc"], grid=grid).iloc[0]
            cells += [fixed(row["source_ms"], 1), fixed(row["fusion_ms"], 1)]
        rows.append(cells)
    return rows


def _cell_rows(data):
    return [[fixed(row.cell_m, 2), grouped(row.cells), fixed(row.source_ms, 1),
             fixed(row.fusion_ms, 1)] for row in data["evidential_cells_on_this_pc"].itertuples()]


def _frame_ms(a9, drive):
    return {variant: a9.mean(f"perception_cost drive={drive}", "cycles", "frame", variant) / 1e6
            for variant in ("nominal", "pessimistic")}


def _fused(a9, drive):
    """The share of the window's cells, in groups of eight."""
    return 8 * a9.mean(f"perception_cost drive={drive}", "groups_fused") / WINDOW_CELLS


def _memory(data, window_bytes):
    """Bytes of a cell: all sets, or those that its map lets have mass; and the accumulator."""
    order = data["evidential_map_order"]
    rows = [["all 64 sets of the frame, double", EVERY_SET,
             grouped((EVERY_SET + 1) * DOUBLE_BYTES)]]
    for ageing in ("conservative", "contextual"):
        of_ageing = select(order, ageing=ageing, specialised="every set")
        for contexts, words in ((["none"], "no map"), (["building", "road", "intermediate"],
                                                       "map in every scan, the most of a class")):
            sets = int(of_ageing[of_ageing["context"].isin(contexts)]["sets"].max())
            rows.append([f"focal sets, double: {words}, {ageing}", sets,
                         grouped((sets + 1) * DOUBLE_BYTES)])
    return rows + [["the firmware's window, all that it holds", 5,
                    fixed(window_bytes / WINDOW_CELLS, 1)]]


def section(data) -> Section:
    a9 = CortexA9(data)
    frames = {drive: _frame_ms(a9, drive) for drive in DRIVES}
    worst = max(frame["nominal"] for frame in frames.values())
    reference = one(data["evidential_city_on_this_pc"], "fusion_ms", grid="the thesis's") + \
        one(data["evidential_city_on_this_pc"], "source_ms", grid="the thesis's")
    window_bytes = a9.value("perception_cost drive=city", "window_bytes")
    cells = PRINTED_CELLS
    claim = Claim("section 8.1", f"a scan of {grouped(cells)} cells", f"{PRINTED_MS} ms, not real "
                  "time", f"a frame of {grouped(WINDOW_CELLS)} cells: {fixed(worst, 1)} ms at most, "
                  "modelled on a Cortex-A9", Verdict.BEATS if worst < PRINTED_MS
                  else Verdict.FALLS_SHORT, "mean frame of the dearer drive, nominal model; other "
                  "cells, other lidars")
    return Section(
        found={"rows": _time_rows(data), "cells": _cell_rows(data),
               "frames": [[words, fixed(frames[drive]["nominal"], 1),
                           fixed(frames[drive]["pessimistic"], 1)]
                          for drive, words in DRIVES.items()],
               "memory": _memory(data, float(window_bytes)),
               "fused": _fused(a9, "city"), "fused_ring": _fused(a9, "ring_road"),
               "printed_ms": PRINTED_MS, "printed_cells": grouped(cells),
               "reference_ms": reference,
               "per_cell": SimpleNamespace(printed_us=1e3 * PRINTED_MS / cells,
                                           ours_us=1e3 * worst / WINDOW_CELLS),
               "whole": SimpleNamespace(
                   thesis=grouped(cells * (EVERY_SET + 1) * DOUBLE_BYTES),
                   ours=grouped(float(window_bytes)),
                   of_window=grouped(WINDOW_CELLS * (EVERY_SET + 1) * DOUBLE_BYTES))},
        claims=[claim])
