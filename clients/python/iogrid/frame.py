"""What a frame says, and where."""

import dataclasses
import enum
import math
import struct

import numpy

from iogrid.grid import Geometry
from iogrid.objects import Object

Class = enum.IntEnum("Class", "UNKNOWN DRIVABLE_FREE NON_DRIVABLE_FREE FREE MOVING STOPPED STANDING INFRASTRUCTURE "
                     "OCCUPIED", start=0)  # 3.9; STANDING: stopped or unmapped
FREE_CLASSES = (Class.DRIVABLE_FREE, Class.NON_DRIVABLE_FREE, Class.FREE)
Cause = enum.IntFlag("Cause", "LATE LOST IMPRECISE JUMP RESTART OVER_BUDGET CONTRADICTED DRIFTING")  # 3.9


def probability(indexes: numpy.ndarray, epsilon: float) -> numpy.ndarray:
    """Of int8 indexes: how probably each cell is occupied, float64 of the same shape, 0.5: unknown. It is the
    recursive set of docs/model.md, section 2. epsilon: `frame.geometry.epsilon`. ValueError: it is not between 0 and
    0.5."""
    if not 0 < epsilon < 0.5:
        raise ValueError(f"epsilon is between 0 and 0.5, not {epsilon}")
    return 1 / (1 + ((0.5 - epsilon) / (0.5 + epsilon)) ** numpy.asarray(indexes, numpy.float64))


@dataclasses.dataclass(frozen=True)
class Pose:
    """Of the car in the local frame, when the frame's last slice ended (3.9)."""

    x_m: float
    y_m: float
    heading_rad: float  # 0 ... 2 pi, counter-clockwise from the local frame's x
    sigma_m: float  # of the motion in the second before; inf: 65 m or more
    sigma_rad: float  # likewise; inf: 0.65 rad or more


@dataclasses.dataclass(frozen=True)
class Window:
    """The rectangle of the local frame whose cells have classes (3.9)."""

    causes: Cause  # why slices of the frame have no place, or what was known before has lost it
    geometry: Geometry  # its cells
    corner: tuple[int, int]  # its tile of lowest x and y; a tile is 32 cells
    pose: Pose | None  # None: it is not known where the car is
    slices: int  # of the frame, that were placed
    begin_us: int  # when the first of them began, by the poses' clock
    end_us: int  # when the last one ended

    @classmethod
    def read(cls, header: bytes, geometry: Geometry) -> "Window":
        """Of the 48 bytes of its header in a message."""
        _, causes, a, b, x_mm, y_mm, heading, *sigmas, slices, _, _, begin_us, end_us = \
            struct.unpack(">HHiiiiIHHBBHQQ", header)
        sigma_m, sigma_rad = (math.inf if sigma == 0xFFFF else sigma * unit
                              for sigma, unit in zip(sigmas, (1e-3, 1e-5), strict=True))
        is_known = (x_mm, y_mm, heading, *sigmas) != (0, 0, 0, 0xFFFF, 0xFFFF)
        pose = Pose(x_mm / 1000, y_mm / 1000, heading * math.tau / 2 ** 32, sigma_m, sigma_rad) if is_known else None
        return cls(Cause(causes & 0xFF), geometry, (a, b), pose, slices, begin_us, end_us)

    def velocity_since(self, before: "Window | None") -> tuple[float, float] | None:
        """Of the car, m/s in the local frame, since another frame; None where its place is not known, or the local frame
        may be another."""
        passed_us = self.end_us - before.end_us if before else 0
        if not 0 < passed_us <= 500_000 or self.pose is None or before.pose is None or \
                self.causes & (Cause.LOST | Cause.JUMP | Cause.RESTART | Cause.CONTRADICTED | Cause.DRIFTING):
            return None
        return tuple((round(now * 1000) - round(then * 1000)) * 1000 / passed_us
                     for now, then in ((self.pose.x_m, before.pose.x_m), (self.pose.y_m, before.pose.y_m)))

    def to_cells(self, x_m, y_m):
        """Column and row in the classes, with fractions, of a place in the car's frame; it may be arrays."""
        c, s = math.cos(self.pose.heading_rad), math.sin(self.pose.heading_rad)
        return ((self.pose.x_m + c * x_m - s * y_m) / self.geometry.cell_m - 32 * self.corner[0],
                (self.pose.y_m + s * x_m + c * y_m) / self.geometry.cell_m - 32 * self.corner[1])

    def to_car(self, x, y):
        """The way back: of column and row, with fractions, the place in the car's frame, m."""
        c, s = math.cos(self.pose.heading_rad), math.sin(self.pose.heading_rad)
        x_m = (x + 32 * self.corner[0]) * self.geometry.cell_m - self.pose.x_m
        y_m = (y + 32 * self.corner[1]) * self.geometry.cell_m - self.pose.y_m
        return c * x_m + s * y_m, c * y_m - s * x_m

    def from_local(self, x_m, y_m):
        """The place in the car's frame, m, of one in the local frame, which objects are in; it may be arrays."""
        cell_m = self.geometry.cell_m
        return self.to_car(x_m / cell_m - 32 * self.corner[0], y_m / cell_m - 32 * self.corner[1])


def _is_set(bits: int, from_rad: float, to_rad: float) -> bool:
    """Whether any of the 64 sectors that these directions touch is set."""
    if not 0 <= to_rad - from_rad <= math.tau:
        raise ValueError(f"not counter-clockwise within a turn: {from_rad}, {to_rad}")
    sectors = range(math.floor(from_rad * 64 / math.tau), math.floor(to_rad * 64 / math.tau) + 1)
    return any(bits >> i % 64 & 1 for i in sectors)


@dataclasses.dataclass(frozen=True, eq=False)
class Frame:
    """What has come of a frame. A grid that the target does not send is None, and so is what belongs to it."""

    number: int
    closed_us: int  # by the target's clock
    vehicle: int  # CRC-32 of its description
    run: int  # of the target; another number after each of its starts
    complete: int  # bit i: sensor i has delivered its whole scan
    partial: int  # bit i: a part of it
    points_used: int
    unwatched: int | None  # bit i: no sensor watches sector i of 64 around the car now (3.5); None: not known
    blocked: int | None  # bit i: nearly nothing comes back to some sensor from there: a cap, ice or mud, no open sky
    is_whole: bool  # nothing of it was lost, and its grids have the names that the target gave them
    geometry: Geometry | None  # of the indexes: cells, epsilon, and where [0, 0] is
    indexes: numpy.ndarray | None  # int8 [rows, columns], above 0 occupied, below free
    indexes_lost: numpy.ndarray | None  # bool of tiles of 32 x 32 cells that did not come, and are 0
    classes: numpy.ndarray | None  # uint8 of Class [rows, columns], in the window
    sureness: numpy.ndarray | None  # uint8, likewise, 0 ... 7
    classes_lost: numpy.ndarray | None  # bool of tiles
    window: Window | None  # None, too: nothing of the classes has come
    velocity: tuple[float, float] | None  # of the car since the frame before, m/s in the local frame; None: not known
    objects: list[Object] | None  # by id; None: not known, since a part was lost or nothing has a place
    temperature_c: float | None  # of the target's chip (3.5); None: not known

    def closing(self, thing: Object) -> tuple[float, float] | None:
        """How far the middle of an object of the frame is from the car, m, and how fast that becomes less, m/s, the car's
        own motion included. None where one of both velocities is not known."""
        at = thing.at(self.window.end_us) if self.velocity is not None else None
        if at is None:
            return None
        x, y = at[0] - self.window.pose.x_m, at[1] - self.window.pose.y_m
        distance = math.hypot(x, y)
        rate = x * (thing.vx_m_s - self.velocity[0]) + y * (thing.vy_m_s - self.velocity[1])
        return distance, -rate / distance if distance > 0 else 0.0

    def is_watched(self, from_rad: float, to_rad: float) -> bool:
        """Whether sensors watch every direction from the one to the other now, counter-clockwise from straight ahead:
        -0.2 to 0.2 is the sector ahead. What is not known is not watched. ValueError if that is no sector."""
        return self.unwatched is not None and not _is_set(self.unwatched, from_rad, to_rad)

    def is_blocked(self, from_rad: float, to_rad: float) -> bool:
        """Whether a sensor that looks there is covered, likewise. Another one may watch nevertheless."""
        return _is_set(self.blocked or 0, from_rad, to_rad)

    def index_at(self, x_m: float, y_m: float) -> int:
        """The occupancy index of a place; 0, unknown, outside of the grid."""
        cell = self.geometry.index(x_m, y_m) if self.geometry else (-1, -1)
        return int(self.indexes[cell]) if self.geometry and self.geometry.has(*cell) else 0

    def cell_at(self, x_m: float, y_m: float) -> tuple[int, int] | None:
        """Row and column of a place in the classes; None outside of the window, and where the car's place in it is
        not known."""
        if self.window is None or self.window.pose is None:
            return None
        x, y = map(math.floor, self.window.to_cells(x_m, y_m))
        return (y, x) if self.window.geometry.has(y, x) else None

    def class_at(self, x_m: float, y_m: float) -> Class:
        cell = self.cell_at(x_m, y_m)
        return Class.UNKNOWN if cell is None else Class(self.classes[cell])

    def is_free(self, x_m: tuple[float, float], y_m: tuple[float, float]) -> bool:
        """Whether each cell that touches the rectangle x_m[0] ... x_m[1], y_m[0] ... y_m[1] is free. What is unknown,
        lost, or outside of the window is not. ValueError if that is no rectangle."""
        if not (x_m[0] <= x_m[1] and y_m[0] <= y_m[1]):
            raise ValueError(f"not from the lower to the higher: {x_m}, {y_m}")
        if self.window is None or self.window.pose is None:
            return False
        cells = self.window.geometry
        if max(map(abs, (*x_m, *y_m))) > 2 * cells.cell_m * max(cells.rows, cells.columns):
            return False
        corners = self.window.to_cells(numpy.repeat(x_m, 2), numpy.tile(y_m, 2))
        x, y = numpy.meshgrid(*(numpy.arange(math.floor(each.min()) - 1, math.floor(each.max()) + 2)
                                for each in corners))
        forward, left = self.window.to_car(x + 0.5, y + 0.5)
        reach = cells.cell_m * math.sqrt(0.5)  # of a cell from its middle
        touches = (abs(forward - sum(x_m) / 2) <= (x_m[1] - x_m[0]) / 2 + reach) & (
            abs(left - sum(y_m) / 2) <= (y_m[1] - y_m[0]) / 2 + reach)
        x, y = x[touches], y[touches]
        return bool(cells.has(y.min(), x.min()) and cells.has(y.max(), x.max()) and
                    numpy.isin(self.classes[y, x], FREE_CLASSES).all())

    def places(self, *classes: Class) -> numpy.ndarray:
        """Where the cells of these classes are: float64 [n, 2], m before and to the left of the car. None of them where
        the car's place is not known."""
        if self.window is None or self.window.pose is None:
            return numpy.empty((0, 2))
        y, x = numpy.nonzero(numpy.isin(self.classes, classes))
        return numpy.stack(self.window.to_car(x + 0.5, y + 0.5), axis=1)
