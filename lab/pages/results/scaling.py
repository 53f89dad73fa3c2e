"""What a frame costs one Cortex-A9 as its load grows: sensors, beams, range, cells, cell size; and
where that stops being real time. Frames are synthetic (lab/target/scaling.cpp), cycles modelled."""

import dataclasses

import plots
from cortex_a9 import FUSED, CortexA9, Cost
from markdown import fixed, grouped
from section import Section
from target_frames import WHOLE

PERIOD_MS = 40  # 25 Hz
LAYERS = 4      # of a LUX


@dataclasses.dataclass(frozen=True)
class Load:
    """What a run of lab/target/scaling is given. The base: one thing at a time is changed."""

    cells_per_side: int = 1024
    cell_mm: int = 100
    sensors: int = 4
    azimuths: int = 201  # directions of a layer
    range_cm: int = 2500

    @property
    def run(self) -> str:
        return " ".join(["scaling", *(f"{key}={value}" for key, value in
                                      dataclasses.asdict(self).items())])


@dataclasses.dataclass(frozen=True)
class Point:
    x: float
    name: str
    points: float
    messages: float
    fused: Cost
    whole: Cost  # without receiving

    @property
    def fused_ms(self) -> float:
        return self.fused.cycles.ms.nominal

    @property
    def whole_ms(self) -> float:
        return self.whole.cycles.ms.nominal

    @property
    def is_late(self) -> bool:
        return self.whole_ms > PERIOD_MS


@dataclasses.dataclass(frozen=True)
class Sweep:
    """One thing that grows."""

    load: str    # one of its values in words
    axis: str
    loads: dict  # by the axis's value and its name
    has_trend: bool = True  # whether a line through two points says where 25 Hz ends


RANGES_CM = (625, 1250, 2500, 3750, 5000)
FAR = Load(cells_per_side=2048, range_cm=10_000)
CELL_SIZES = {5: Load(2048, 50), 10: Load(1024, 100), 20: Load(512, 200)}  # cm
SWEEPS = {
    "sensors": Sweep("with {} LUX", "LUX",
                     {(count, str(count)): Load(sensors=count) for count in range(1, 9)}),
    "beams": Sweep("with {} beams a LUX", "beams of a LUX: four layers",
                   {(LAYERS * each, grouped(LAYERS * each)): Load(azimuths=each)
                    for each in (51, 101, 201, 401, 801)}),
    "range": Sweep("at {} m", "range, m",
                   {(each / 100, fixed(each / 100, 2)): Load(range_cm=each) for each in RANGES_CM} |
                   {(FAR.range_cm / 100, "100 (2048 x 2048)"): FAR}),
    "cells": Sweep("with {} cells a side", "cells per side",
                   {(side, str(side)): Load(side) for side in (512, 1024, 2048, 4096)},
                   has_trend=False),
    "cell_size": Sweep("with cells of {} cm", "side of a cell, cm",
                       {(size, str(size)): load for size, load in CELL_SIZES.items()},
                       has_trend=False),
}


def _point(a9, x, name, load):
    def count(counter):
        return a9.value(load.run, counter, variant="nominal")
    return Point(x, name, count("points"), count("messages"), a9.cost(load.run, *FUSED),
                 a9.cost(load.run, WHOLE))


def _rows(points):
    return [[point.name, grouped(point.points), grouped(point.messages),
             grouped(point.whole.instructions), grouped(point.whole.l1d_refills),
             grouped(point.whole.l2_misses), fixed(point.fused_ms, 2), fixed(point.whole_ms, 2),
             grouped(1000 / point.whole_ms)] for point in points]


def _end_of_real_time(points):
    """By the line through the neighbours of 40 ms, or through the last two points."""
    upper = next((i for i, point in enumerate(points) if i > 0 and point.is_late), len(points) - 1)
    a, b = points[upper - 1], points[upper]
    return a.x + (PERIOD_MS - a.whole_ms) * (b.x - a.x) / (b.whole_ms - a.whole_ms)


def _dearest(points):
    return max(points, key=lambda point: point.whole_ms)


def _sentence(sweep, points):
    dearest = _dearest(points)
    at = f"{dearest.name} ({sweep.axis}): {fixed(dearest.whole_ms, 1)} ms"
    if not sweep.has_trend:
        return f"No longer real time at {at}." if dearest.is_late else \
            f"Real time everywhere, the dearest at {at}."
    end = grouped(_end_of_real_time(points))
    return f"Real time ends at about {end} ({sweep.axis})." if dearest.is_late else \
        (f"Real time everywhere, the dearest at {at}; by the last two points it would end at about "
         f"{end}.")


def _title(sweep, points):
    dearest = _dearest(points)
    if dearest.is_late and sweep.has_trend:
        return f"Real time ends {sweep.load.format(f'about {_end_of_real_time(points):.0f}')}"
    return (f"{'No longer real' if dearest.is_late else 'Real'} time "
            f"{sweep.load.format(f'{dearest.x:,.0f}')}: {dearest.whole_ms:.1f} of {PERIOD_MS} ms")


def _figure(sweep, points):
    drawing, axes = plots.figure(_title(sweep, points), sweep.axis, "a frame, modelled, ms")
    x = [point.x for point in points]
    axes.plot(x, [point.whole_ms for point in points], "o-", label="whole frame")
    axes.plot(x, [point.fused_ms for point in points], "s--", label="fuse + mark + clear")
    axes.axhline(PERIOD_MS, color="black", linestyle=":")
    axes.text(0, PERIOD_MS + 0.5, " 25 Hz")
    axes.set_xlim(left=0)
    axes.set_ylim(0, max(PERIOD_MS, _dearest(points).whole_ms) + 5)
    axes.legend(loc="upper left", bbox_to_anchor=(0, 0.82))
    return drawing


def section(data) -> Section:
    a9 = CortexA9(data)
    limits = next(data["frame_limits"].itertuples())
    points = {name: [_point(a9, x, words, load) for (x, words), load in sweep.loads.items()]
              for name, sweep in SWEEPS.items()}
    assert max(point.x for point in points["sensors"]) == limits.core_sensors
    dearest = _dearest([point for sweep in points.values() for point in sweep])
    return Section(
        found={"tables": {name: _rows(rows) for name, rows in points.items()},
               "axes": {name: sweep.axis for name, sweep in SWEEPS.items()},
               "sentences": {name: _sentence(sweep, points[name])
                             for name, sweep in SWEEPS.items()},
               "core_sensors": limits.core_sensors, "core_marks": grouped(limits.core_marks),
               "dearest_ms": fixed(dearest.whole_ms, 1), "is_real_time": not dearest.is_late},
        figures={f"scaling_{name}.svg": _figure(sweep, points[name])
                 for name, sweep in SWEEPS.items()})
