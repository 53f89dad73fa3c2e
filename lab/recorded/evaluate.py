"""What the class grids of a recorded drive say of its hits, kind by kind, in numpy.

A hit is a return between 0.1 m over the band's low end and 0.1 m under its high end, by the car's mount, from 2.8 to
70 m away and not on the car itself. Its cell is where the firmware puts it: the azimuth of its laser's firing, the
pose in the middle of its packet's slice. It counts by the first frame that has taken it.
"""

import collections
import dataclasses
import pathlib

import numpy as np

from car import BLOCK_S, BLOCKS_OF_PACKET, FIRES_AFTER_S, Hdl64e
from drive import Drive
from trajectories import MOVES_ABOVE_MPS, Trajectory, speed_band

SIDE, TILE, CELLS_PER_M = 1024, 32, 10
HEADER = 6  # int64 before the cells of a frame
FREE, MOVING, OCCUPIED = 3, 4, 8
SAID = {"unknown": [0], "free": [1, 2, 3], "moving": [4], "standing": [5, 6, 7], "open": [8]}
NEIGHBOURS = [(1, 1), (1, -1), (-1, 1), (-1, -1), (1, 0), (-1, 0), (0, 1), (0, -1)]
FIRST_CLOUD = 8       # before it little is known
ARRIVES_WITHIN_S = 0.002
NEAREST_M, FARTHEST_M = 2.8, 70
BAND_MARGIN_M = 0.1
OWN_MARGIN_M = 0.1
LABEL_MARGIN_M, NEAR_LABEL_M = 0.1, 0.6
RANGES_M = [(0, 25), (25, 50), (50, 100)]
ROAD_WITHIN_M, ROAD_HALF_ANGLE, ROAD_HEIGHT_M = 20, np.radians(45), 0.2
AREA_WITHIN_M = 40
WALKERS = {"Pedestrian", "Person (sitting)"}


class Frames:
    """As class_frames has written them."""

    def __init__(self, path: pathlib.Path):
        words = np.dtype([("head", "<i8", HEADER), ("cells", "u1", (SIDE, SIDE))])
        self.frames = np.memmap(path, words, mode="r")
        self.ends_s = self.frames["head"][:, 0] / 1e6
        self.slice_s = self.frames["head"][0, 1] / 1e3

    def __len__(self) -> int:
        return len(self.frames)

    def classes(self, number: int) -> np.ndarray:
        return self.frames[number]["cells"] >> 3

    def cells_of(self, number: int, x: np.ndarray, y: np.ndarray):
        """Columns and rows in the frame's grid; and which are inside."""
        head = self.frames[number]["head"]
        column = np.floor(x * CELLS_PER_M).astype(int) - head[2] * TILE
        row = np.floor(y * CELLS_PER_M).astype(int) - head[3] * TILE
        return column, row, (column >= 0) & (column < SIDE) & (row >= 0) & (row < SIDE)


def said_of(frames: Frames, number: np.ndarray, x: np.ndarray, y: np.ndarray, is_named: np.ndarray):
    """The class of each hit's cell, 255 outside; and the same where an occupied neighbour gives its name to a cell
    that is free or unknown: a hit beside a thing may be the thing's. Only where is_named."""
    alone, named = np.full(len(x), 255, np.uint8), np.full(len(x), 255, np.uint8)
    for frame in np.unique(number):
        its = np.flatnonzero(number == frame)
        column, row, inside = frames.cells_of(frame, x[its], y[its])
        its, column, row = its[inside], column[inside], row[inside]
        classes = frames.classes(frame)
        alone[its] = said = classes[row, column]
        best = said.copy()
        lone = is_named[its] & ((said == 0) | (said == FREE))
        inner_column, inner_row = column.clip(1, SIDE - 2), row.clip(1, SIDE - 2)
        for across, along in NEIGHBOURS:
            beside = classes[inner_row + along, inner_column + across]
            best = np.where(lone & (beside >= MOVING), beside, best)
        named[its] = best
    return alone, named


def squares(x: np.ndarray, y: np.ndarray, per_m: int) -> np.ndarray:
    """One number for the square of the world that each point is in; within 2 km."""
    return (np.floor(x * per_m).astype(np.int64) + 2000 * per_m) * 4000 * per_m \
        + np.floor(y * per_m).astype(np.int64) + 2000 * per_m


def grouped(codes: np.ndarray, values: np.ndarray):
    """The squares, the number of points in each, their lowest and their highest value."""
    order = np.argsort(codes, kind="stable")
    found, first, count = np.unique(codes[order], return_index=True, return_counts=True)
    return (found, count, np.minimum.reduceat(values[order], first), np.maximum.reduceat(values[order], first))


class Place:
    """What the clouds alone say of the place: where the road lies, what is flat, and what stands upright."""

    FLAT_PER_M, UPRIGHT_PER_M = 2, 5

    def __init__(self, drive: Drive):
        self.plane = np.median([road_of(drive.cloud(number)) for number in range(0, len(drive), 3)], axis=0)
        flat, upright = [], collections.Counter()
        for number in range(len(drive)):
            points = drive.cloud(number)
            r, height = np.hypot(points[:, 0], points[:, 1]), self.height_of(points)
            x, y = drive.unit_world(number, points)
            near = (r > 3) & (r < 22)
            flat.append((squares(x[near], y[near], self.FLAT_PER_M), height[near]))
            high = (r > 3) & (r < 60) & (height > 0.1) & (height < 2.6)
            code, _, low, top = grouped(squares(x[high], y[high], self.UPRIGHT_PER_M), height[high])
            upright.update(code[top - low > 0.7].tolist())
        codes, heights = (np.concatenate(part) for part in zip(*flat))
        code, count, _, top = grouped(codes, np.where(heights < 3, heights, -1))
        self.flat = code[(count >= 15) & (top < 0.22)]
        self.upright = np.array([square for square, scans in upright.items() if scans >= 5])

    def height_of(self, points: np.ndarray) -> np.ndarray:
        return points[:, 2] - points[:, :2] @ self.plane[:2] - self.plane[2]

    def is_flat(self, x, y):
        """Seen 15 times from near, in squares of 0.5 m, and never above 0.22 m."""
        return np.isin(squares(x, y, self.FLAT_PER_M), self.flat)

    def is_upright(self, x, y):
        """In squares of 0.2 m: in five turns at least 0.7 m of height were seen at once."""
        return np.isin(squares(x, y, self.UPRIGHT_PER_M), self.upright)


def road_of(points: np.ndarray) -> np.ndarray:
    """z = a x + b y + c of the road around, by least squares in ever narrower gates; a metre of range weighs as
    much as any other."""
    r = np.hypot(points[:, 0], points[:, 1])
    points = points[(r > 4) & (r < 18) & (np.abs(points[:, 1]) < 5)]
    r, plane = np.hypot(points[:, 0], points[:, 1]), np.array([0, 0, -1.73])
    for gate_m, gate_per_m in ((0.25, 0.03), (0.15, 0.02), (0.08, 0.01), (0.06, 0), (0.06, 0)):
        off = points[:, 2] - points[:, :2] @ plane[:2] - plane[2]
        used = np.abs(off) < gate_m + gate_per_m * r
        metre = r[used].astype(int)
        weight = 1 / np.sqrt(np.bincount(metre)[metre])
        design = np.column_stack([points[used, :2], np.ones(used.sum())])
        plane = np.linalg.lstsq(design * weight[:, None], points[used, 2] * weight, rcond=None)[0]
    return plane


def kind_of(thing, number: int) -> str:
    """By what it is and whether it moves at that cloud."""
    if thing.trajectory.speeds_mps[number] <= MOVES_ABOVE_MPS:
        return "parked car"
    if thing.kind == "Cyclist":
        return "cyclist"
    return "walker" if thing.kind in WALKERS else "moving car"


class Hits:
    """Of one cloud: what may be a hit, where the firmware puts it, and which frame has taken it."""

    def __init__(self, number: int, drive: Drive, car: Hdl64e, frames: Frames, place: Place):
        points = drive.cloud(number)
        seen_at = drive.seen_at(number, points)
        laser = car.lasers_of(points)
        # Firings are evenly spaced from the rear of the first turn on.
        grid_begin = drive.at_turns(np.array(-0.5))
        firing = np.round((seen_at - grid_begin - FIRES_AFTER_S[laser]) / BLOCK_S)
        azimuth = -2 * np.pi * drive.turns_at(grid_begin + firing * BLOCK_S + FIRES_AFTER_S[laser])
        r = np.hypot(points[:, 0], points[:, 1])
        vehicle = car.in_vehicle(np.column_stack([r * np.cos(azimuth), r * np.sin(azimuth), points[:, 2]]))
        packet = grid_begin + (np.floor(firing / BLOCKS_OF_PACKET) + 0.5) * BLOCKS_OF_PACKET * BLOCK_S
        slices = np.floor((packet + drive.begin_s) / frames.slice_s) + 0.5
        x, y = drive.world(vehicle[:, 0], vehicle[:, 1], slices * frames.slice_s - drive.begin_s)
        height = car.in_vehicle(points)[:, 2]
        frame = np.searchsorted(frames.ends_s - drive.begin_s, seen_at + ARRIVES_WITHIN_S)
        seen = ((r > NEAREST_M) & (r < FARTHEST_M) & (frame < len(frames))
                & ~car.is_own(points + car.place, OWN_MARGIN_M))
        in_band = seen & (height > car.low_m + BAND_MARGIN_M) & (height < car.high_m - BAND_MARGIN_M)
        ahead = np.abs(np.arctan2(points[:, 1], points[:, 0])) < ROAD_HALF_ANGLE
        road = (seen & ~in_band & ahead & (r < ROAD_WITHIN_M) & (np.abs(height) < ROAD_HEIGHT_M)
                & place.is_flat(x, y))
        kept = in_band | road
        self.points, self.r, self.x, self.y, self.frame, self.is_road = (
            values[kept] for values in (points, r, x, y, frame, road))


class Counts:
    """Rows of a table of hits: what is said of those with a key."""

    CLASSES = [f"{said}_hits" for said in SAID]
    COLUMNS = ["kind", "speed", "range_from_m", "range_to_m", "named_by_neighbour", *CLASSES]
    THINGS = ["thing", "kind", "after_gap", *CLASSES]

    def __init__(self):
        self.sums = collections.defaultdict(lambda: np.zeros(256, np.int64))

    def count(self, key: tuple, classes: np.ndarray):
        self.sums[key] += np.bincount(classes, minlength=256)

    def add(self, kind: str, speed: str, range_m: tuple[int, int], which: np.ndarray, alone: np.ndarray,
            named: np.ndarray):
        """Of a kind, a band of speed and a range, with and without neighbours' names."""
        for is_named, said in ((0, alone), (1, named)):
            self.count((kind, speed, *range_m, is_named), said[which])

    def rows(self) -> list[list]:
        return [[*key, *(int(sum(of_class[one] for one in classes)) for classes in SAID.values())]
                for key, of_class in sorted(self.sums.items()) if of_class[:255].sum()]


@dataclasses.dataclass
class Results:
    hits: list[list]       # rows of Counts.COLUMNS
    areas: list[float]     # the mean areas_of() the turns' last frames
    things: list[list]     # rows of Counts.THINGS
    trajectories: list[Trajectory]  # of things that move


def areas_of(frames: Frames, number: int) -> list[float]:
    """Square metres within AREA_WITHIN_M of the car: free, moving, standing, open."""
    head = frames.frames[number]["head"]
    column, row = head[4] // 100 - head[2] * TILE, head[5] // 100 - head[3] * TILE
    rows, columns = np.ogrid[:SIDE, :SIDE]
    near = frames.classes(number)[np.hypot(columns - column, rows - row) < AREA_WITHIN_M * CELLS_PER_M]
    return [np.isin(near, SAID[said]).sum() / CELLS_PER_M**2 for said in ("free", "moving", "standing", "open")]


def evaluate(drive: Drive, place: Place, car: Hdl64e, frames: Frames) -> Results:
    counts, moving, areas, things = Counts(), Counts(), [], drive.things()
    for number in range(FIRST_CLOUD, len(drive) - 1):
        hits = Hits(number, drive, car, frames, place)
        if not len(hits.frame):
            continue
        alone, named = said_of(frames, hits.frame, hits.x, hits.y, ~hits.is_road)
        rest = ~hits.is_road
        labelled, near = np.zeros(len(rest), bool), np.zeros(len(rest), bool)
        for thing in things:
            for at in np.flatnonzero(thing.clouds == number):
                its = thing.holds(hits.points, thing.places[at], LABEL_MARGIN_M) & rest
                near |= thing.holds(hits.points, thing.places[at], NEAR_LABEL_M)
                labelled |= its
                path, kind = thing.trajectory, kind_of(thing, at)
                path.hits[at] = its.sum()
                if path.speeds_mps[at] > MOVES_ABOVE_MPS:
                    moving.count((int(path.thing), kind, 0), named[its])
                for band in RANGES_M:
                    if band[0] <= path.away_m[at] < band[1]:
                        counts.add(kind, speed_band(path.speeds_mps[at]), band, its, alone, named)
        flat, upright = place.is_flat(hits.x, hits.y), place.is_upright(hits.x, hits.y)
        unlabelled = rest & ~labelled & ~near
        whole = (0, FARTHEST_M)
        counts.add("upright", "", whole, unlabelled & upright & ~flat, alone, named)
        counts.add("neither flat nor upright", "", whole, unlabelled & ~upright & ~flat, alone, named)
        counts.add("flat ground", "", whole, unlabelled & flat, alone, named)
        counts.add("road ahead", "", (0, ROAD_WITHIN_M), hits.is_road & ~near, alone, named)
        areas.append(areas_of(frames, hits.frame.max()))
    return Results(counts.rows(), list(np.mean(areas, axis=0)), moving.rows(),
                   [thing.trajectory for thing in things if (thing.trajectory.speeds_mps > MOVES_ABOVE_MPS).any()])
