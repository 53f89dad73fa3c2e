"""What the frames of a drive say, read by clients/python: numbers by frame, moving objects, the cells of the world."""

import collections
import math

import numpy as np
import pandas

from iogrid import FREE_CLASSES, Cause, Class, Frame, Object, State

# As the page names them, and the classes of docs/spec.md 3.9.
NAMED = {"free": FREE_CLASSES, "moving": (Class.MOVING,), "stopped": (Class.STOPPED,), "standing": (Class.STANDING,),
         "mapped": (Class.INFRASTRUCTURE,), "occupied": (Class.OCCUPIED,), "unknown": (Class.UNKNOWN,)}


def is_placed(frame: Frame) -> bool:
    return bool(frame.window and frame.window.pose and frame.window.slices)


class Followed:
    """An object over all frames that list it."""

    def __init__(self, number: int, time_s: float, world: "World"):
        self.id, self.first_s, self.last_s, self.world = number, time_s, time_s, world
        self.nearest_m, self.farthest_m, self.length_m, self.width_m = math.inf, 0.0, 0.0, 0.0
        self.way: list[tuple[float, float]] = []  # in the frame of the poses, of the frames in which it moves
        self._speeds: list[tuple[float, float]] = []  # m/s and twice its deviation, which it exceeds

    def add(self, thing: Object, time_s: float, frame: Frame) -> None:
        self.last_s = time_s
        away_m = math.hypot(*frame.window.from_local(thing.x_m, thing.y_m))
        self.nearest_m, self.farthest_m = min(self.nearest_m, away_m), max(self.farthest_m, away_m)
        self.length_m, self.width_m = max(self.length_m, thing.length_m), max(self.width_m, thing.width_m)
        if thing.state == State.MOVES:
            self.way.append((thing.x_m, thing.y_m))
            speed, give = math.hypot(thing.vx_m_s, thing.vy_m_s), 2 * thing.sigma_v_m_s[0]
            if speed > give:
                self._speeds.append((speed, give))

    @property
    def followed_s(self) -> float:
        return self.last_s - self.first_s

    @property
    def speed(self) -> tuple[float, float] | None:
        """Medians of the speed and of twice its deviation; None if it never was above that."""
        return tuple(np.median(self._speeds, axis=0)) if self._speeds else None


class World:
    """The last known class of every cell that a window has shown, by tile, in the frame of the poses."""

    def __init__(self):
        self.tiles: dict[tuple[int, int], np.ndarray] = {}
        self.cell_m = self.side_m = 0.0  # of the window
        self.way: list[tuple[float, float]] = []

    def add(self, frame: Frame) -> None:
        rows, columns = (side // 32 for side in frame.classes.shape)
        grid = frame.classes.reshape(rows, 32, columns, 32).swapaxes(1, 2)  # [tile y, tile x, y, x]
        (a, b), self.cell_m = frame.window.corner, frame.window.geometry.cell_m
        self.side_m = self.cell_m * len(frame.classes)
        for y, x in np.argwhere(grid.any(axis=(2, 3))).tolist():
            tile = self.tiles.setdefault((a + x, b + y), np.zeros((32, 32), np.uint8))
            np.copyto(tile, grid[y, x], where=grid[y, x] != Class.UNKNOWN)
        self.way.append((frame.window.pose.x_m, frame.window.pose.y_m))

    def area_m2(self, name: str) -> float:
        return self.cell_m ** 2 * sum(int(np.isin(tile, NAMED[name]).sum()) for tile in self.tiles.values())


class Drive:
    """chosen: numbers of frames that are kept for pictures, besides the one with the most moving cells."""

    def __init__(self, chosen: set[int]):
        self._chosen, self._rows, self._most_moving = chosen, [], 0
        self._followed: dict[int, Followed] = {}
        self.kept: list[tuple[float, Frame]] = []
        self.liveliest: tuple[float, Frame] | None = None
        self.geometry, self.has_objects = None, False  # the geometry of the index grid
        self.worlds = [World()]  # one more when the poses' source has restarted: its frame is another
        self.not_watched, self.blocked, self.told = np.zeros(64, int), np.zeros(64, int), 0  # frames, by sector
        self.causes: collections.Counter[str] = collections.Counter()

    def add(self, frame: Frame, time_s: float) -> None:
        row = {"time_s": time_s, "is_whole": frame.is_whole, "has_indexes": frame.indexes is not None,
               "has_classes": frame.classes is not None, "has_pose": is_placed(frame), "way_m": 0.0}
        self.has_objects |= frame.objects is not None
        if frame.geometry:
            self.geometry = frame.geometry
            cell_m2 = frame.geometry.cell_m ** 2
            row |= {"hit": cell_m2 * (frame.indexes > 0).sum(), "passed": cell_m2 * (frame.indexes < 0).sum()}
        if frame.unwatched is not None:
            self.told += 1
            self.not_watched += [frame.unwatched >> i & 1 for i in range(64)]
            self.blocked += [(frame.blocked or 0) >> i & 1 for i in range(64)]
        if frame.window:
            self.causes.update(cause.name.lower().replace("_", " ") for cause in Cause if cause in frame.window.causes)
        if is_placed(frame):
            row |= self._placed(frame, time_s)
        if frame.number in self._chosen:
            self.kept.append((time_s, frame))
        self._rows.append(row)

    def _placed(self, frame: Frame, time_s: float) -> dict:
        if Cause.RESTART in frame.window.causes and self.worlds[-1].tiles:
            self.worlds.append(World())
        self.worlds[-1].add(frame)
        counts = np.bincount(frame.classes.ravel(), minlength=len(Class))
        if counts[Class.MOVING] > self._most_moving:
            self._most_moving, self.liveliest = counts[Class.MOVING], (time_s, frame)
        things, world, way = frame.objects or [], self.worlds[-1], self.worlds[-1].way
        for thing in things:
            self._followed.setdefault(thing.id, Followed(thing.id, time_s, world)).add(thing, time_s, frame)
        return {"way_m": math.dist(way[-1], way[-2]) if frame.velocity is not None and len(way) > 1 else 0.0,
                "moving_objects": sum(thing.state == State.MOVES for thing in things),
                **{name: world.cell_m ** 2 * sum(counts[each] for each in classes) for name, classes in NAMED.items()}}

    @property
    def frames(self) -> pandas.DataFrame:
        """A row for each frame: seconds since the first, areas in m² of the classes (NAMED) and of the index grid."""
        return pandas.DataFrame(self._rows)

    @property
    def moved(self) -> list[Followed]:
        """The objects that were seen moving, those followed longest first."""
        moved = [each for each in self._followed.values() if each.way]
        return sorted(moved, key=lambda each: (-each.followed_s, each.id))

    def beside(self, footprint: dict) -> list[int]:
        """The moving objects that were followed for 2 s and never were farther away than the car is long."""
        length_m = footprint["x_max_m"] - footprint["x_min_m"]
        return [each.id for each in self.moved if each.farthest_m < length_m and each.followed_s >= 2]

    @property
    def world(self) -> World:
        """The largest one."""
        return max(self.worlds, key=lambda world: len(world.tiles))


def spans_of(places: np.ndarray, is_in: np.ndarray) -> list[tuple[float, float]]:
    """Where something holds, from its first place to its last."""
    edges = np.flatnonzero(np.diff(np.concatenate([[0], is_in.astype(int), [0]])))
    return [(places[begin], places[end - 1]) for begin, end in zip(edges[::2], edges[1::2])]


def directions_of(is_set: np.ndarray) -> str:
    """Of 64 sectors, counter-clockwise from straight ahead: "84° to 135°"."""
    if is_set.all() or not is_set.any():
        return "all around" if is_set.all() else "none"
    first = int(np.flatnonzero(~is_set)[0])  # from a sector that is not set, once around
    words = []
    for begin, end in spans_of(np.arange(first, first + 64), np.roll(is_set, -first)):
        begin, end = begin % 64, end % 64 + 1
        words.append(f"{360 * (begin - 64 * (begin >= 32)) / 64:.0f}° to {360 * (end - 64 * (end > 32)) / 64:.0f}°")
    return ", ".join(words)
