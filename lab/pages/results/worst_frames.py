"""The worst frames that could be put together, beside those of a drive, and the bound above both.

The bound is counts times costs. The counts follow from the constants of the code, the costs are the
largest that the frames show of a point, a cell, a mark, a tile.

Why the costs bound: a point costs p, a cell c. The short beams have the most points and hardly a
cell, so their cost per point is at least p for points that are fused the usual way. c is what a
frame of long beams costs beyond that, by its cells; where a point costs more than p, because the
height band or the edge of the grid cuts its beam, the rest is charged to the cells of a beam that
is shorter than the longest, so that p + c * (cells of the longest) is still above it.
"""

import dataclasses

from cortex_a9 import CLOCK_HZ, CortexA9, Modelled, VARIANTS, frame_run
from markdown import fixed, grouped, percent
from section import Section
from target_frames import Floor, TargetFrame, floor, target_frame

SHORT_BEAMS = "short_beams"
SENDERS = {"lux": "a LUX could", "forged": "forged"}


@dataclasses.dataclass(frozen=True)
class Kind:
    """A kind of frames, or those of a drive."""

    name: str
    sender: str  # drive, lux or forged
    strain: str
    marks: float
    frame: TargetFrame
    floor: Floor

    @property
    def fuse_and_mark(self) -> float:
        return self.frame.counted.fuse + self.frame.counted.mark


@dataclasses.dataclass(frozen=True)
class Bound:
    """Counts of a frame, and instructions for each of them."""

    points: float
    cells_per_beam: float
    cells: float
    tiles: float
    per_point: float
    per_cell: float
    per_mark: float
    per_tile: float
    receive: float

    @property
    def fuse_and_mark(self) -> float:
        return self.points * (self.per_point + self.per_mark) + self.cells * self.per_cell

    @property
    def publish(self) -> float:
        return self.tiles * self.per_tile

    @property
    def whole(self) -> float:
        return self.receive + self.fuse_and_mark + self.publish

    def of_its_points(self, kind: Kind) -> float:
        """What a frame takes, as a share of what the bound is for as many points."""
        return kind.fuse_and_mark / (self.fuse_and_mark * kind.frame.counted.points / self.points)


def kind_of(a9, row):
    is_scene = row.sender == "drive"
    run = frame_run(row.frame) if is_scene else frame_run(worst=row.frame)
    return Kind(row.frame, row.sender, row.strain, row.marks, target_frame(a9, run),
                floor(a9, f"{'scene' if is_scene else 'worst'}={row.frame}"))


def bound_of(kinds, limits):
    worst = {kind.name: kind.frame.counted for kind in kinds if kind.sender != "drive"}
    short = worst[SHORT_BEAMS]
    per_point = short.fuse / short.points
    most_tiles = max(worst.values(), key=lambda frame: frame.tiles)
    return Bound(limits.points, limits.cells_per_beam, limits.cells, limits.tiles, per_point,
                 per_cell=max((frame.fuse - frame.points * per_point) / frame.cells
                              for name, frame in worst.items() if name != SHORT_BEAMS),
                 per_mark=short.mark / short.points,
                 per_tile=most_tiles.publish / most_tiles.tiles,
                 receive=max(frame.receive for frame in worst.values()))


def _check(bound, kinds):
    """It is above every frame that was measured, or it is none."""
    for kind in kinds:
        counted = kind.frame.counted
        for value, limit in ((counted.points, bound.points),
                             (counted.cells, counted.points * bound.cells_per_beam),
                             (kind.fuse_and_mark, bound.fuse_and_mark),
                             (counted.publish, bound.publish), (counted.receive, bound.receive),
                             (counted.largest, bound.whole)):
            assert value <= limit, f"{kind.name} exceeds the bound: {value} > {limit}"


def _costs(kinds):
    rows = []
    for kind in kinds:
        counted, whole = kind.frame.counted, kind.frame.whole
        rows.append([kind.name, *map(grouped, (
            counted.points, counted.cells, kind.marks, counted.tiles, counted.fused, counted.whole,
            counted.largest, whole.l1d_refills, whole.l2_misses))])
    return rows


def _rates(kinds, period_ms):
    rows = []
    for kind in kinds:
        fused, largest = kind.frame.fused_cycles.hz, kind.frame.largest_cycles.ms
        rows.append([kind.name, fused.banded(0), grouped(kind.floor.fused_hz),
                     fixed(kind.floor.fused_hz / fused.nominal, 1), largest.banded(1),
                     percent(largest.nominal / period_ms, 0)])
    return rows


def _fewest_a_cycle(kinds):
    """Instructions of the whole frames: each variant's fewest."""
    return Modelled(*(min(kind.frame.whole.instructions / getattr(kind.frame.whole.cycles, variant)
                          for kind in kinds) for variant in VARIANTS))


def _bound_words(bound, kinds, limits):
    dearest = max(kinds, key=lambda kind: kind.fuse_and_mark)
    with_more = [kind for kind in kinds if kind.frame.counted.points > dearest.frame.counted.points]
    a_cycle = _fewest_a_cycle(kinds)
    return {"cell_m": fixed(limits.cell_mm / 1000, 2), "range_m": fixed(limits.range_m, 0),
            **{name: grouped(getattr(bound, name)) for name in (
                "points", "cells_per_beam", "cells", "tiles", "per_tile", "receive",
                "fuse_and_mark", "whole")},
            "per_point": fixed(bound.per_point, 0), "per_cell": fixed(bound.per_cell, 1),
            "per_mark": fixed(bound.per_mark, 1), "short_beams": SHORT_BEAMS,
            "dearest": dearest.name, "dearest_takes": grouped(dearest.fuse_and_mark),
            "dearest_share": percent(bound.of_its_points(dearest), 1),
            "most_share_with_more": percent(max(map(bound.of_its_points, with_more)), 1),
            "a_cycle": a_cycle.banded(2),
            "ms": a_cycle.map(lambda rate: bound.whole / CLOCK_HZ * 1e3 / rate).banded(0)}


def _names(kinds):
    """`a`, `b` and `c`"""
    *first, last = [f"`{kind.name}`" for kind in kinds] or ["none"]
    return f"{', '.join(first)} and {last}" if first else last


def _late(kinds, period_ms):
    """Which break real time, by sender and variant."""
    return {f"{sender}_{variant}": _names([
        kind for kind in kinds if (kind.sender == "forged") == (sender == "forged") and
        getattr(kind.frame.largest_cycles.ms, variant) > period_ms])
        for sender in ("lux", "forged") for variant in ("nominal", "pessimistic")}


@dataclasses.dataclass(frozen=True)
class ClassKind:
    """A kind of frames with classes, of a car that goes ahead."""

    name: str
    most_groups: float
    groups_left: float
    tiles: float
    mean: float  # instructions of a frame
    largest: float


def class_kind_of(a9, name):
    run = f"perception_cost drive=worst_{name}"
    return ClassKind(name, a9.value(run, "most_groups"), a9.mean(run, "groups_left"), a9.mean(run, "class_tiles"),
                     a9.mean(run, "instructions", "frame"), a9.value(run, "instructions_max", "frame"))


@dataclasses.dataclass(frozen=True)
class ClassBound:
    """Instructions of a frame with classes: those of the bound without, and what classes and things add."""

    without: float
    groups: float
    per_group: float
    things: float

    @property
    def whole(self) -> float:
        return self.without + self.groups * self.per_group + self.things


def class_bound_of(a9, classes, kinds, bound):
    """What classes add is charged to the groups, of frames that have many; the rest is that of things."""
    without = {kind.name: kind.frame.counted.largest for kind in kinds}
    budget = a9.value(f"perception_cost drive=worst_{classes[0].name}", "group_budget")
    many = [kind for kind in classes if kind.most_groups > budget / 2]
    return ClassBound(bound.whole, budget,
                      max((kind.largest - without[kind.name]) / kind.most_groups for kind in many),
                      max(a9.value(run, "instructions_max", "objects") for run in a9.runs("object_cost")))


def _class_words(a9, classes, kinds, bound):
    of_classes = class_bound_of(a9, classes, kinds, bound)
    for kind in classes:
        assert kind.largest <= of_classes.whole and kind.most_groups <= of_classes.groups, f"{kind.name} is above its bound"
    a_cycle = {variant: min(a9.value(run, "instructions", "frame", variant) / a9.value(run, "cycles", "frame", variant)
                            for run in a9.runs("perception_cost", variant)) for variant in ("nominal", "pessimistic")}

    def ms(instructions):
        nominal, pessimistic = (instructions / CLOCK_HZ * 1e3 / a_cycle[variant] for variant in ("nominal", "pessimistic"))
        return f"{fixed(nominal, 0)} ({fixed(pessimistic, 0)})"

    of_lux = {kind.name for kind in kinds if kind.sender == "lux"}
    dearest = max(classes, key=lambda kind: kind.largest)
    dearest_of_lux = max((kind for kind in classes if kind.name in of_lux), key=lambda kind: kind.largest)
    return {"rows": [[kind.name, *map(grouped, (kind.most_groups, kind.groups_left, kind.tiles, kind.mean, kind.largest)),
                      ms(kind.largest)] for kind in classes],
            "frames": grouped(a9.value(f"perception_cost drive=worst_{dearest.name}", "frames")),
            "a_cycle": f"{fixed(a_cycle['nominal'], 2)} ({fixed(a_cycle['pessimistic'], 2)})",
            "groups": grouped(of_classes.groups), "per_group": grouped(of_classes.per_group),
            "things": grouped(of_classes.things), "whole": grouped(of_classes.whole), "ms": ms(of_classes.whole),
            "dearest": dearest.name, "dearest_ms": ms(dearest.largest),
            "dearest_share": percent(dearest.largest / of_classes.whole, 0),
            "of_lux": dearest_of_lux.name, "of_lux_ms": ms(dearest_of_lux.largest)}


def section(data) -> Section:
    a9 = CortexA9(data)
    kinds = [kind_of(a9, row) for row in data["worst_frames"].itertuples()]
    limits = next(data["frame_limits"].itertuples())
    bound = bound_of(kinds, limits)
    _check(bound, kinds)
    period_ms = limits.frame_period_us / 1000
    made_up = [kind for kind in kinds if kind.sender != "drive"]
    reach_m = [fixed(metres, 1) for metres in data["layers_in_band"]["furthest_m"]]
    run = made_up[-1].frame.run
    return Section(found={
        "kinds": [[kind.name, kind.strain, SENDERS[kind.sender]] for kind in made_up],
        "reach_m": reach_m, "frames": grouped(a9.value(run, "frames")),
        "modelled_frames": grouped(a9.value(run, "frames", variant="nominal")),
        "costs": _costs(kinds), "rates": _rates(kinds, period_ms),
        "period_ms": fixed(period_ms, 0), "hz": fixed(1000 / period_ms, 0),
        "dearest_share": percent(max(kind.frame.largest_cycles.ms.nominal for kind in made_up) / period_ms, 0),
        "bound": _bound_words(bound, kinds, limits), "late": _late(kinds, period_ms),
        "classes": _class_words(a9, [class_kind_of(a9, kind.name) for kind in made_up], made_up, bound)})
