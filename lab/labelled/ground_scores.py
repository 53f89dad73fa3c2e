"""How good the ground is on labelled clouds, in numpy: the classes of SemanticKITTI (Behley and others, 2019)
against the fates that point_fates wrote.

Ground are road 40, parking 44, pavement 48, other ground 49, marking 60 and terrain 72; vegetation 70, what has no
label 0 and outliers 1 are not judged, as Patchwork++ (Lee and others, 2022) does. Nor are points that no packet
holds, and those that the target drops or that are beyond its model's range.
"""

import dataclasses

import numpy as np

GROUND = (40, 44, 48, 49, 60, 72)
ROAD = (40, 44, 60)
NOT_JUDGED = (0, 1, 70)
SQUARE_M, FILLED_SQUARES = 0.5, 6   # the true ground: medians in squares, and up to 3 m around them
REACH_M = 60
NEAREST_M, FARTHEST_M = 2.7, 50     # of what is asked of cells and heights
CELL_M = 0.1
LOW_M, MEDIUM_M, TOP_M, OVER_M = 0.3, 0.5, 2.2, 2.5


def labels_in(words: np.ndarray) -> np.ndarray:
    """The lower half of a word is the class, the upper half the number of the thing."""
    return words & 0xFFFF


def true_heights(points: np.ndarray, is_ground: np.ndarray) -> np.ndarray:
    """Of each point over the labelled ground below it or next to it; nan where none is near."""
    side = round(2 * REACH_M / SQUARE_M)
    column, row = (np.floor(points[:, axis] / SQUARE_M).astype(int) + side // 2 for axis in (0, 1))
    inside = (column >= 0) & (column < side) & (row >= 0) & (row < side)
    known = np.full((side, side), np.nan)
    chosen = np.flatnonzero(is_ground & inside)
    square = column[chosen] * side + row[chosen]
    order = np.lexsort((points[chosen, 2], square))
    found, first, count = np.unique(square[order], return_index=True, return_counts=True)
    known.flat[found] = points[chosen, 2][order][first + count // 2]
    heights = np.full(len(points), np.nan)
    heights[inside] = points[inside, 2] - filled(known)[column[inside], row[inside]]
    return heights


def filled(known: np.ndarray) -> np.ndarray:
    """Where nothing is known, what the nearest square knows."""
    most = FILLED_SQUARES
    around = sorted(((a, b) for a in range(-most, most + 1) for b in range(-most, most + 1)
                     if 0 < a * a + b * b <= most * most), key=lambda way: way[0] ** 2 + way[1] ** 2)
    padded = np.pad(known, most, constant_values=np.nan)
    result = known.copy()
    for a, b in around:
        near = padded[most + a:most + a + known.shape[0], most + b:most + b + known.shape[1]]
        result = np.where(np.isnan(result), near, result)
    return result


def cells_of(points: np.ndarray) -> np.ndarray:
    return (np.floor(points[:, 0] / CELL_M).astype(np.int64) << 32) + np.floor(points[:, 1] / CELL_M).astype(np.int64)


@dataclasses.dataclass
class Scores:
    """Sums over scans."""

    scans: int = 0
    points: int = 0
    not_sent: int = 0
    right_ground: int = 0      # called ground, and is
    wrong_ground: int = 0      # called ground, and is not
    missed_ground: int = 0
    things: int = 0            # LOW_M to TOP_M over the ground
    marked_things: int = 0
    low_things: int = 0        # below MEDIUM_M
    marked_low_things: int = 0
    high_things: int = 0       # from OVER_M on
    marked_high_things: int = 0
    false_cells: int = 0
    false_road_cells: int = 0

    def __add__(self, other: "Scores") -> "Scores":
        return Scores(*(a + b for a, b in zip(dataclasses.astuple(self), dataclasses.astuple(other))))

    @property
    def precision(self) -> float:
        return share(self.right_ground, self.right_ground + self.wrong_ground)

    @property
    def recall(self) -> float:
        return share(self.right_ground, self.right_ground + self.missed_ground)

    @property
    def f1(self) -> float:
        return share(2 * self.right_ground, 2 * self.right_ground + self.wrong_ground + self.missed_ground)


def share(part: int, whole: int) -> float:
    """In per cent; nan of nothing."""
    return 100 * part / whole if whole else float("nan")


def score(points: np.ndarray, labels: np.ndarray, fates: np.ndarray) -> Scores:
    """Of one cloud: x, y, z in the unit's frame in metres, the classes, and the letters of point_fates."""
    is_known = (fates != b".") & (fates != b"-")
    is_ground = np.isin(labels, GROUND)
    called_ground, is_marked = fates == b"g", fates == b"o"
    judged = is_known & ~np.isin(labels, NOT_JUDGED)
    r = np.hypot(points[:, 0], points[:, 1])
    near = is_known & (r > NEAREST_M) & (r < FARTHEST_M)
    heights = true_heights(points, is_ground)
    thing = near & ~is_ground & (labels > 1)
    with np.errstate(invalid="ignore"):
        standing = thing & (heights >= LOW_M) & (heights <= TOP_M)
        low, high = standing & (heights < MEDIUM_M), thing & (heights > OVER_M)
    cells = cells_of(points)
    others = np.unique(cells[near & ~is_ground])

    def false_cells(of: np.ndarray) -> int:
        """Cells that only ground marks."""
        return len(np.setdiff1d(np.unique(cells[near & of & is_marked]), others))

    return Scores(
        scans=1, points=len(points), not_sent=int((fates == b".").sum()),
        right_ground=int((judged & called_ground & is_ground).sum()),
        wrong_ground=int((judged & called_ground & ~is_ground).sum()),
        missed_ground=int((judged & ~called_ground & is_ground).sum()),
        things=int(standing.sum()), marked_things=int((standing & is_marked).sum()),
        low_things=int(low.sum()), marked_low_things=int((low & is_marked).sum()),
        high_things=int(high.sum()), marked_high_things=int((high & is_marked).sum()),
        false_cells=false_cells(is_ground), false_road_cells=false_cells(np.isin(labels, ROAD)))
