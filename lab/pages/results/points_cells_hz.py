"""Thesis, table 4.5: what its rate is worth, in scan points times cells a second."""

from claims import Claim
from cortex_a9 import CortexA9, frame_run
from markdown import fixed, grouped, scientific
from section import Section
from target_frames import target_frame
from thesis import MOST_POINTS, TABLE_4_4_HZ

# Table 4.5. The grid has as many cells there as here, and is counted as this many in both.
CELLS = 1000 * 1000
HZ = TABLE_4_4_HZ[4]
METRIC = 5
METRIC_A_WATT = 1030
HOMM_WATTS = 204
HOMM_CELLS = 512 * 512
NUSS_METRIC = 0.4
NUSS_CELLS = 533 * 533
UNIT = MOST_POINTS * CELLS * HZ / METRIC  # of the metric, for the thesis's row to come out


def _metric(points, hz):
    """Points cells Hz, in the thesis's unit."""
    return hz * (points * CELLS / UNIT)


def _claims(points, metric):
    reason = (f"as table 4.4, with {grouped(points)} points a frame; the unit counts "
              f"{grouped(MOST_POINTS)} for the thesis, the most that four LUX send")
    a_watt = metric * HOMM_WATTS
    return [Claim("table 4.5", "points cells Hz, a GPU being 1", f"{METRIC}",
                  f"{metric.banded(1)}, modelled", metric.verdict(METRIC), reason),
            Claim("table 4.5", "the same per watt, a GPU being 1", grouped(METRIC_A_WATT),
                  f"{a_watt.banded(0)} at the thesis's 1 W, modelled",
                  a_watt.verdict(METRIC_A_WATT), f"{reason}; no power was measured")]


def _rows(points, hz, metric):
    unknown = "not in the text"
    return [
        ["hardware", "GeForce 268GTX", "desktop", "one ARM A9", "one ARM A9"],
        ["power", f"{HOMM_WATTS} W", "about 80 W", "1 W", "1 W, by the thesis"],
        ["layers", "2", "4", "16", "16"],
        ["cells", "512 x 512", "533 x 533", "1000 x 1000", "as the thesis"],
        ["points a frame", unknown, unknown, grouped(MOST_POINTS), grouped(points)],
        ["frames a second", unknown, unknown, HZ, hz.banded(1)],
        ["points cells Hz", "1", NUSS_METRIC, METRIC, metric.banded(1)],
        ["points cells Hz / W", "1", "about 1", grouped(METRIC_A_WATT),
         (metric * HOMM_WATTS).banded(0)]]


def section(data) -> Section:
    frame = target_frame(CortexA9(data), frame_run("ring_road", 4))
    points, hz = frame.counted.points, frame.whole_cycles.hz
    metric = _metric(points, hz)
    return Section(
        found={"most_points": grouped(MOST_POINTS), "cells": grouped(CELLS), "hz": HZ,
               "metric": METRIC, "metric_a_watt": grouped(METRIC_A_WATT),
               "unit": scientific(UNIT, 3), "before_rounding": fixed(METRIC_A_WATT / HOMM_WATTS, 2),
               "rows": _rows(points, hz, metric),
               "fused": _metric(points, frame.fused_cycles.hz).banded(1),
               "with_our_points": (hz * (METRIC / HZ)).banded(1),
               "homm_points": grouped(UNIT / HOMM_CELLS),
               "nuss_points": grouped(NUSS_METRIC * UNIT / NUSS_CELLS),
               "million_cells": (hz * (frame.counted.cells / 1e6)).banded(0)},
        claims=_claims(points, metric))
