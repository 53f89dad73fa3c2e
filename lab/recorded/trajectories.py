"""The true trajectories of labelled things, and how well the published objects follow them, in numpy."""

import dataclasses
import pathlib

import numpy as np

MOVES_ABOVE_MPS = 1.0
SPEED_OVER_TURNS = 5  # before and after
SEEN_HITS, SEEN_WITHIN_M = 20, 40
MARGIN_M = 0.5  # around a thing's box, for the middle of an object
SPEEDS_MPS = (0.3, 1, 3, 8)


def speed_band(speed_mps: float) -> str:
    """Of a true speed; one that nobody knows is no number."""
    if not speed_mps >= 0:
        return "unknown"
    band = int(np.searchsorted(SPEEDS_MPS, speed_mps))
    names = ["still", *(f"{low} to {high} m/s" for low, high in zip(SPEEDS_MPS, SPEEDS_MPS[1:])), "over 8 m/s"]
    return names[band]


@dataclasses.dataclass
class Trajectory:
    """A labelled thing turn by turn, in order: when it was seen, the middle of its box and its heading in the world,
    its speed, and of its hits the number and the distance."""

    thing: str
    kind: str
    length_m: float
    width_m: float
    times: np.ndarray
    x: np.ndarray
    y: np.ndarray
    heading: np.ndarray
    speeds_mps: np.ndarray
    away_m: np.ndarray
    hits: np.ndarray

    def velocity(self) -> tuple[np.ndarray, np.ndarray]:
        return over_turns(self.times, self.x), over_turns(self.times, self.y)


def over_turns(times: np.ndarray, values: np.ndarray) -> np.ndarray:
    """The change in a second, from five turns before to five after."""
    turns = np.arange(len(values))
    first, last = np.maximum(turns - SPEED_OVER_TURNS, 0), np.minimum(turns + SPEED_OVER_TURNS, len(values) - 1)
    return (values[last] - values[first]) / np.maximum(times[last] - times[first], 1e-3)


class MovingObjects:
    """As class_frames has written them: objects that are published as moving, with their velocity."""

    def __init__(self, path: pathlib.Path, begin_s: float):
        rows = np.array([line.split(",") for line in path.read_text().splitlines()[1:]], np.int64).reshape(-1, 6)
        self.times = rows[:, 0] / 1e6 - begin_s
        self.x, self.y = rows[:, 2] / 1e3, rows[:, 3] / 1e3
        self.vx, self.vy = rows[:, 4] / 1e2, rows[:, 5] / 1e2

    def of(self, its: Trajectory) -> tuple[np.ndarray, np.ndarray]:
        """At each time when there is one in the thing's box, that time and the number of the nearest."""
        near = np.flatnonzero((self.times >= its.times[0]) & (self.times <= its.times[-1]))
        x, y, heading = (np.interp(self.times[near], its.times, values)
                         for values in (its.x, its.y, np.unwrap(its.heading)))
        dx, dy = self.x[near] - x, self.y[near] - y
        along, across = np.cos(heading) * dx + np.sin(heading) * dy, np.cos(heading) * dy - np.sin(heading) * dx
        inside = (np.abs(along) < its.length_m / 2 + MARGIN_M) & (np.abs(across) < its.width_m / 2 + MARGIN_M)
        found, off = near[inside], np.hypot(dx, dy)[inside]
        order = np.lexsort((off, self.times[found]))
        times, first = np.unique(self.times[found][order], return_index=True)
        return times, found[order][first]


@dataclasses.dataclass
class Followed:
    """How a thing that moves is followed from the first turn on in which it is seen: with SEEN_HITS hits within
    SEEN_WITHIN_M. delay_s: until the first published speed, infinite if there is none. errors_mps: of the velocity,
    one for each frame that has it while the thing moves."""

    delay_s: float
    errors_mps: np.ndarray


def followed(its: Trajectory, objects: MovingObjects) -> Followed | None:
    """None if it is never seen while it moves."""
    moves = its.speeds_mps > MOVES_ABOVE_MPS
    seen = its.times[moves & (its.hits >= SEEN_HITS) & (its.away_m < SEEN_WITHIN_M)]
    if not len(seen):
        return None
    times, number = objects.of(its)
    does_move = np.interp(times, its.times, its.speeds_mps) > MOVES_ABOVE_MPS
    times, number = times[does_move], number[does_move]
    delay_s = max(0.0, times[0] - seen[0]) if len(times) else np.inf
    vx, vy = (np.interp(times, its.times, values) for values in its.velocity())
    return Followed(delay_s, np.hypot(objects.vx[number] - vx, objects.vy[number] - vy))
