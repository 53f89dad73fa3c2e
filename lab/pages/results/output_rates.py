"""Thesis, table 4.4: grids a second on one Cortex-A9, at a load that its table 4.7 implies."""

import plots
from claims import Claim, Verdict
from cortex_a9 import STAGES, CortexA9, frame_run
from markdown import fixed, grouped, percent
from section import Section, one
from target_frames import SCENES, WHOLE, target_frame
from thesis import MOST_POINTS, TABLE_4_4_HZ

SCANNERS_HZ = 25
FOUR = 4
TABLE_4_2_FAN_S = 0.007   # the fan by the discrete traversal
TABLE_4_7_A_LEAF = 3.75   # cells, blurring at epsilon = 0.1; over all epsilons:
TABLE_4_7_ROW = ["thesis, table 4.7, blurring", "equation 4.4", "3.74 to 3.78", "2.81 to 2.84",
                 "not in the text"]
FAN = "traversal_cost walk=discrete r=1024"
STAGE_NAMES = {"beams": "to beams", WHOLE: "whole frame"}


def _matched(frames):
    return [frames["ring_road", sensors] for sensors in TABLE_4_4_HZ]


def _doubt(paper, ours):
    return "not by the pessimistic variant of the model" if ours.has_in_band(paper) else ""


def _claim_on_rate(sensors, frame):
    paper, hz = TABLE_4_4_HZ[sensors], frame.whole_cycles.hz
    reasons = ["load matched by us, on a ring road", _doubt(paper, hz),
               "receiving and sending are in it, whether in the thesis's timing it does not say; "
               f"without them {frame.fused_cycles.hz.banded(1)} Hz"]
    return Claim("table 4.4", f"grids a second with {sensors} LUX", f"{paper} Hz",
                 f"{hz.banded(1)} Hz, modelled", hz.verdict(paper),
                 "; ".join(filter(None, reasons)))


def _claim_on_real_time(frame):
    hz = frame.largest_cycles.hz
    doubt = _doubt(SCANNERS_HZ, hz)
    in_time = hz.nominal > SCANNERS_HZ
    reasons = ["on a ring road", doubt] if doubt or not in_time else []
    return Claim("table 4.4", "four LUX in real time, 25 Hz", "28 Hz on average",
                 f"{hz.banded(1)} Hz in the largest frame, modelled",
                 Verdict.EQUALS if in_time else Verdict.FALLS_SHORT,
                 "; ".join(filter(None, reasons)))


def _loads(loads):
    return [TABLE_4_7_ROW] + [
        [words, one(loads, "rule", scene=scene),
         fixed(one(loads, "cells_per_leaf", scene=scene), 2),
         fixed(one(loads, "cells_per_node", scene=scene), 2),
         grouped(one(loads, "known_cells", scene=scene))]
        for scene, words in SCENES.items()]


def _fan(a9, frames):
    """By the thesis's own time for a cell, how many a frame of its can have had."""
    cells = a9.value(FAN, "cells")
    s_a_cell = TABLE_4_2_FAN_S / cells
    paper_cells = 1 / TABLE_4_4_HZ[FOUR] / s_a_cell
    most_cells = MOST_POINTS * cells / a9.value(FAN, "beams")
    of_scene = {scene: frames[scene, FOUR].counted.cells for scene in SCENES}
    return {"cells": grouped(cells), "ns_a_cell": fixed(s_a_cell * 1e9, 0),
            "paper_cells": grouped(paper_cells), "most_points": grouped(MOST_POINTS),
            "most_cells": grouped(most_cells), "most_ms": fixed(most_cells * s_a_cell * 1e3, 0),
            **{scene: grouped(carved) for scene, carved in of_scene.items()},
            **{f"{scene}_times": fixed(carved / paper_cells, 2)
               for scene, carved in of_scene.items()}}


def _instructions(frames):
    return [[SCENES[scene], sensors, *(grouped(value) for value in (
        frame.counted.points, frame.counted.points_used, frame.counted.cells, frame.counted.fused,
        frame.counted.whole, frame.counted.largest, frame.whole.l1d_refills,
        frame.whole.l2_misses))] for (scene, sensors), frame in frames.items()]


def _rates(frames, rule):
    loads = {"ring_road": "ring road: load matched by us", "city": "city: a lighter load"}
    return [[loads[scene], rule, sensors, TABLE_4_4_HZ[sensors],
             *(cycles.hz.banded(1) for cycles in (frame.fused_cycles, frame.whole_cycles,
                                                  frame.largest_cycles))]
            for (scene, sensors), frame in frames.items()]


def _verdicts(frames):
    """2 LUX 61.9 Hz, short of the thesis's 66; ..."""
    words = []
    for (sensors, paper), frame in zip(TABLE_4_4_HZ.items(), _matched(frames)):
        hz = frame.whole_cycles.hz
        side = "better than" if hz.verdict(paper) is Verdict.BEATS else "short of"
        doubt = ", though not by the pessimistic variant" if hz.has_in_band(paper) else ""
        words.append(f"{sensors} LUX {fixed(hz.nominal, 1)} Hz, {side} the thesis's {paper}{doubt}")
    return "; ".join(words)


def _growth(frames):
    """What the third and the fourth LUX add."""
    ours = [frame.whole_cycles.nominal for frame in _matched(frames)]
    paper = [1 / hz for hz in TABLE_4_4_HZ.values()]
    return {"ours": [percent(ours[i] / ours[i - 1] - 1, 0) for i in (1, 2)],
            "paper": [percent(paper[i] / paper[i - 1] - 1, 0) for i in (1, 2)],
            "paper_ms": [fixed(1000 * ms, 1) for ms in (paper[0] / 2, paper[1] - paper[0],
                                                        paper[2] - paper[1])]}


def _stages(a9, scene):
    rows = []
    for stage in (*STAGES, WHOLE):
        cost = a9.cost(frame_run(scene, FOUR), stage)
        rows.append([STAGE_NAMES.get(stage, stage), grouped(cost.instructions),
                     cost.cycles.banded(0), fixed(cost.instructions / cost.cycles.nominal, 2),
                     *map(grouped, (cost.l1d_refills, cost.l2_misses, cost.mispredicts))])
    return rows


def _long_run(a9, frames):
    """What more frames of the drives change."""
    def change(scene):
        longer = a9.cost(frame_run(scene, FOUR, program="long_run"), WHOLE).cycles.nominal
        return f"{100 * (longer / frames[scene, FOUR].whole.cycles.nominal - 1):+.1f} %"
    run = frame_run("city", FOUR, program="long_run")
    return {"frames": grouped(a9.value(run, "frames", variant="nominal")),
            **{scene: change(scene) for scene in SCENES}}


def _bars(axes, places, rates, label, colour):
    """Nominal, and down to the pessimistic variant."""
    nominal = [hz.nominal for hz in rates]
    spans = [[hz.nominal - hz.low for hz in rates], [hz.high - hz.nominal for hz in rates]]
    axes.bar(places, nominal, 0.26, yerr=spans, capsize=5, label=label, color=colour)


def _figure(frames):
    four = frames["ring_road", FOUR].whole_cycles.hz.nominal
    drawing, axes = plots.figure(
        f"Four LUX: {four:.0f} grids a second, the thesis's {TABLE_4_4_HZ[FOUR]}",
        "ibeo LUX", "whole frames a second, Hz")
    sensors = list(TABLE_4_4_HZ)
    bars = axes.bar([x - 0.28 for x in sensors], TABLE_4_4_HZ.values(), 0.26,
                    label="thesis, measured", color=plots.PAPER)
    axes.bar_label(bars)
    for place, (scene, words) in enumerate(SCENES.items()):
        _bars(axes, [x + 0.28 * place for x in sensors],
              [frames[scene, count].whole_cycles.hz for count in sensors],
              f"{words}, modelled", plots.COLOURS[place])
    axes.axhline(SCANNERS_HZ, color="black", linestyle="--", label="the scanners, 25 Hz")
    axes.set_xticks(sensors)
    axes.grid(axis="x", visible=False)
    axes.legend()
    return drawing


def section(data) -> Section:
    a9, loads = CortexA9(data), data["scene_load"]
    frames = {(scene, sensors): target_frame(a9, frame_run(scene, sensors))
              for scene in SCENES for sensors in TABLE_4_4_HZ}
    four = frames["ring_road", FOUR]
    assert all(frame.fused_cycles.nominal < frame.whole_cycles.nominal
               for frame in frames.values()), "the whole frame is not the stricter of the two"
    a_leaf = one(loads, "cells_per_leaf", scene="ring_road")
    assert a_leaf < one(loads, "cells_per_leaf", scene="city"), "the city is no lighter load"
    rule = one(data["frame_limits"], "rule")
    return Section(
        found={"made_with": one(data["made_with"], "value", key="capture scene=ring_road"),
               "loads": _loads(loads), "paper_a_leaf": TABLE_4_7_A_LEAF,
               "load_rule": one(loads, "rule", scene="ring_road"), "rule": rule,
               "off": percent(abs(a_leaf / TABLE_4_7_A_LEAF - 1), 1), "fan": _fan(a9, frames),
               "frames": grouped(a9.value(four.run, "frames")),
               "instructions": _instructions(frames), "rates": _rates(frames, rule),
               "modelled_frames": grouped(a9.value(four.run, "frames", variant="nominal")),
               "before": grouped(a9.value(four.run, "before", variant="nominal")),
               "a_cycle": four.whole.cycles.map(
                   lambda cycles: four.whole.instructions / cycles).banded(2),
               "verdicts": _verdicts(frames),
               "four_lux": f"{four.whole_cycles.hz.banded(1)} grids a second", "growth": _growth(frames),
               "stages": {scene: _stages(a9, scene) for scene in SCENES},
               "long_run": _long_run(a9, frames)},
        claims=[*(_claim_on_rate(*pair) for pair in zip(TABLE_4_4_HZ, _matched(frames))),
                _claim_on_real_time(four)],
        figures={"output_rates.svg": _figure(frames)})
