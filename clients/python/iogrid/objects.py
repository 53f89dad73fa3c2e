"""Things with a speed (docs/spec.md, 3.12)."""

import dataclasses
import enum
import itertools
import math
import struct

from iogrid.protection import require

State = enum.IntEnum("State", "YOUNG STANDS MOVES STOPPED")  # a velocity is believed of the last two alone
LONGEST_US = 10_000_000  # no place is said of a time that is farther away than that
_HEADER, _OBJECT = struct.Struct(">HHHBBQHHI"), struct.Struct(">IBBHiiHHHHhhHHHHHH")
_OF_A_PART, _MOST_PARTS, _OR_MORE = 32, 8, 0xFFFF


@dataclasses.dataclass(frozen=True)
class Object:
    """A box on the ground. Places and velocities are of the local frame; Window.from_local() finds them in the car's."""

    time_us: int  # when it is where it is said to be, by the poses' clock
    id: int  # of no other thing of the run
    state: State
    existence: float  # how sure it is that it moves, 0 ... 1
    age_frames: int  # in which it was measured
    x_m: float  # of its middle
    y_m: float
    length_m: float  # along its heading
    width_m: float
    heading_rad: float | None  # 0 ... 2 pi, counter-clockwise from x; None: not known, length is along x
    is_hit: bool  # in this frame; else its place is a prediction
    is_end_hidden: bool  # it may be longer or wider
    vx_m_s: float  # 0 but for what moves
    vy_m_s: float
    sigma_v_m_s: tuple[float, float]  # along its heading and across; inf: its velocity is not believed
    sigma_m: tuple[float, float]  # of its place, likewise
    since_hit_s: float
    since_stopped_s: float | None  # None: it has not stopped, or 655 s ago

    @property
    def is_believed(self) -> bool:
        return self.state in (State.MOVES, State.STOPPED)

    def at(self, time_us: int) -> tuple[float, float, float] | None:
        """Where it is at a time of the poses' clock if it keeps its velocity: x, y, m, and the largest standard
        deviation that what was said allows. None where its velocity is not believed, and beyond LONGEST_US."""
        passed_us = time_us - self.time_us
        if not self.is_believed or abs(passed_us) > LONGEST_US:
            return None
        x, y = ((round(place * 1000) + (round(speed * 100) * passed_us + 50_000) // 100_000) / 1000
                for place, speed in ((self.x_m, self.vx_m_s), (self.y_m, self.vy_m_s)))
        sigma_mm = max(round(place * 1000) - (round(speed * 100) * -abs(passed_us)) // 100_000
                       for place, speed in zip(self.sigma_m, self.sigma_v_m_s, strict=True))
        return x, y, sigma_mm / 1000

    @classmethod
    def read(cls, time_us: int, record: bytes) -> "Object":
        """Of the first 40 bytes of a record. Unsound if it contradicts itself."""
        number, state, existence, age, x, y, length, width, heading, flags, vx, vy, *sigmas, since_hit, since_stopped = \
            _OBJECT.unpack_from(record)
        require(number > 0 and State.YOUNG <= state <= State.STOPPED, "malformed")
        require(state == State.MOVES or vx == vy == 0, "malformed")
        is_believed = state in (State.MOVES, State.STOPPED)
        require([sigma == _OR_MORE for sigma in sigmas[:2]] == 2 * [not is_believed], "malformed")
        return cls(time_us, number, State(state), existence / 255, age, x / 1000, y / 1000, length / 100, width / 100,
                   heading * math.tau / 2 ** 16 if flags & 1 else None, not flags & 2, flags & 4 != 0, vx / 100, vy / 100,
                   tuple(sigma / 100 if is_believed else math.inf for sigma in sigmas[:2]),
                   tuple(sigma / 1000 for sigma in sigmas[2:]), since_hit / 1000,
                   None if since_stopped == _OR_MORE else since_stopped / 100)


class ObjectParts:
    """What has come of a frame's list: all of it is of use, or nothing."""

    def __init__(self):
        self._says, self._parts = None, {}  # bytes 80, 81 and 83 ... 95, the same in all; objects by number

    def take(self, body: bytes) -> None:
        header_bytes, object_bytes, total, number, parts, time_us, refused, left, _ = _HEADER.unpack_from(body)
        require(len(body) >= header_bytes >= _HEADER.size and object_bytes >= _OBJECT.size, "malformed")
        count, rest = divmod(len(body) - header_bytes, object_bytes)
        others = parts - 1
        require(rest == 0 and number < parts <= _MOST_PARTS and count <= _OF_A_PART and (time_us > 0 or total == 0),
                "malformed")
        require(count == total if others == 0 else count > 0 and others <= total - count <= others * _OF_A_PART,
                "malformed")
        objects = [Object.read(time_us, body[at:at + object_bytes])
                   for at in range(header_bytes, len(body), object_bytes)]
        says = total, parts, time_us, refused, left
        came = self._parts | {number: objects}
        ids = [each.id for _, part in sorted(came.items()) for each in part]
        require(self._says in (None, says) and number not in self._parts, "malformed")
        require(len(ids) <= total and (len(came) < parts or len(ids) == total), "malformed")
        require(all(a < b for a, b in itertools.pairwise(ids)), "malformed")
        self._says, self._parts = says, came

    @property
    def are_complete(self) -> bool:
        return self._says is not None and len(self._parts) == self._says[1]

    @property
    def objects(self) -> list[Object] | None:
        """None: a part is missing, or nothing has a place and is known."""
        if not self.are_complete or self._says[2] == 0:
            return None
        return [each for _, part in sorted(self._parts.items()) for each in part]
