"""The bound above every frame: counts times costs. The counts follow from the constants of the code, the costs are the
largest that the worst frames show of a point, a cell, a mark, a tile.

Why the costs bound: a point costs p, a cell c. The short beams have the most points and hardly a cell, so their cost per
point is at least p for points that are fused the usual way. c is what a frame of long beams costs beyond that, by its
cells; where a point costs more than p, because the height band or the edge of the grid cuts its beam, the rest is charged
to the cells of a beam that is shorter than the longest, so that p + c * (cells of the longest) is still above it.
"""

import dataclasses

from cortex_a9 import frame_run
from target_frames import Floor, TargetFrame, floor, target_frame

SHORT_BEAMS = "short_beams"


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
    """It is above every frame that was measured, or it is none."""
    worst = {kind.name: kind.frame.counted for kind in kinds if kind.sender != "drive"}
    short = worst[SHORT_BEAMS]
    per_point = short.fuse / short.points
    most_tiles = max(worst.values(), key=lambda frame: frame.tiles)
    bound = Bound(limits.points, limits.cells_per_beam, limits.cells, limits.tiles, per_point,
                  per_cell=max((frame.fuse - frame.points * per_point) / frame.cells
                               for name, frame in worst.items() if name != SHORT_BEAMS),
                  per_mark=short.mark / short.points,
                  per_tile=most_tiles.publish / most_tiles.tiles,
                  receive=max(frame.receive for frame in worst.values()))
    for kind in kinds:
        counted = kind.frame.counted
        for value, limit in ((counted.points, bound.points), (counted.cells, counted.points * bound.cells_per_beam),
                             (kind.fuse_and_mark, bound.fuse_and_mark), (counted.publish, bound.publish),
                             (counted.receive, bound.receive), (counted.largest, bound.whole)):
            assert value <= limit, f"{kind.name} exceeds the bound: {value} > {limit}"
    return bound
