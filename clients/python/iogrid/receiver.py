"""Messages become frames."""

import collections
import contextlib
import struct
from collections.abc import Iterator

import numpy

from iogrid.frame import Frame, Window
from iogrid.grid import CLASSES, INDEXES, Grid, References
from iogrid.objects import ObjectParts
from iogrid.protection import Unsound, content_of, require

_HAS_CLASSES, _HAS_NO_INDEXES, _HAS_OBJECTS = 0x04, 0x08, 0x10
_CONTENTS = _HAS_CLASSES | _HAS_NO_INDEXES | _HAS_OBJECTS
_TILES, _FRAME_END, _CLASS_END, _CAR_REFUSED, _OBJECTS, _RECEPTIONS = range(1, 7)
_HEADER = struct.Struct(">BBHIIQIBBBBIIIII")
_WORD, _HALF = 0xFFFFFFFF, 0x80000000  # numbers wrap: those that are half of them ahead are behind


class _Waiting:
    """A frame that waits for its messages."""

    def __init__(self, flags: int):
        self.flags, self.header, self.sequences = flags & _CONTENTS, (), set()
        self.objects, self.unwatched, self.blocked, self.temperature_c = ObjectParts(), None, None, None
        self.indexes, self.classes = Grid(is_of_classes=False), Grid(is_of_classes=True)
        self.grids = [grid for grid, is_sent in ((self.indexes, not flags & _HAS_NO_INDEXES),
                                                 (self.classes, flags & _HAS_CLASSES)) if is_sent]

    def take(self, header: tuple, body: bytes) -> None:
        kind, flags, _, sequence, *_ = header
        require(flags & _CONTENTS == self.flags and len(self.sequences) < 3000, "malformed")
        require(sequence not in self.sequences, "repeated")
        if kind == _TILES:
            require(len(body) >= 24 and body[7] in (INDEXES, CLASSES), "unknown grid")
            grid = self.indexes if body[7] == INDEXES else self.classes
            require(grid in self.grids, "malformed")
            grid.take_tiles(sequence, body)
        elif kind == _OBJECTS:
            require(self.flags & _HAS_OBJECTS != 0, "malformed")
            self.objects.take(body)
        else:
            grid = self.indexes if kind == _FRAME_END else self.classes
            require(kind == _FRAME_END or grid in self.grids, "malformed")
            if kind == _FRAME_END:
                self.unwatched, self.blocked, self.temperature_c = grid.tail_of(body, header[7])
            grid.take_end(body)
        self.sequences.add(sequence)
        self.header = header if kind == _FRAME_END or not self.header else self.header

    @property
    def is_complete(self) -> bool:
        return self.indexes.end is not None and self.has_its_objects and \
            all(grid.end and grid.spoken_of.all() for grid in self.grids)

    @property
    def has_its_objects(self) -> bool:
        return not self.flags & _HAS_OBJECTS or self.objects.are_complete


class Receiver:
    """Puts messages together to frames, whatever the network did to them. It knows no socket and no clock."""

    def __init__(self):
        self.used = 0  # messages, each once
        self.lost = 0  # messages of the run that did not come, or not in time
        self.dropped: collections.Counter[str] = collections.Counter()  # messages and tiles, by cause
        self.refusal: str | None = None  # why the target has refused its car, and sends no grid (3.11)
        self._over: collections.deque[int] = collections.deque(maxlen=4096)
        self._begin_run(None)

    def take(self, datagram: bytes) -> list[Frame]:
        """Any bytes. The frames that this one completes, or that have waited for too long, in their order."""
        frames: list[Frame] = []
        with self._counting():
            for content in self._of_newest_run(*content_of(bytes(datagram)), frames):
                with self._counting():
                    self._take(content, frames)
        return frames

    def finish(self) -> list[Frame]:
        """Nothing more comes, or nothing has come for SILENCE_S: the frames that still wait, as they are."""
        return [self._hand_over(number) for number in sorted(self._waiting, key=self._ahead)]

    @contextlib.contextmanager
    def _counting(self) -> Iterator[None]:
        try:
            yield
        except (Unsound, struct.error) as fault:
            self.dropped[str(fault) if isinstance(fault, Unsound) else "malformed"] += 1

    def _begin_run(self, run: int | None) -> None:
        self._run, self._candidate, self._candidates = run, None, {}
        self._waiting: dict[int, _Waiting] = {}
        self._own = References(), References()  # of indexes, of classes
        self._before: tuple[int, Window | None] = (-1, None)  # the frame that was handed over last, and its window
        self._next = self._first = self._expected = None  # frame that was not handed over yet; sequence numbers
        self.refusal = None

    def _of_newest_run(self, content: bytes, counter: int, frames: list[Frame]) -> list[bytes]:
        """The messages that may be used now: none, this one, or the first three of a new run (3.2)."""
        _, _, size, sequence, *_, run = _HEADER.unpack_from(content)
        require(48 <= size <= len(content) and counter == sequence & 0xFFFF, "malformed")
        if self._run in (None, run):
            self._run, self._candidates = run, {}
            return [content]
        require(run not in self._over, "run that is over")
        if run != self._candidate:
            self._candidate, self._candidates = run, {}
        self._candidates.setdefault(sequence, content)
        require(len(self._candidates) == 3, "unconfirmed run")
        contents = [self._candidates[number] for number in sorted(self._candidates)]
        frames += self.finish()
        self._over.append(self._run)
        self._begin_run(run)
        return contents

    def _take(self, content: bytes, frames: list[Frame]) -> None:
        header = _HEADER.unpack_from(content)
        kind, flags, size, sequence, number, *_ = header
        body = content[size:]
        require(kind in (_TILES, _FRAME_END, _CLASS_END, _CAR_REFUSED, _OBJECTS, _RECEPTIONS), "unknown type")
        if kind == _CAR_REFUSED:
            require(len(body) >= 4 and len(body) >= 4 + body[1], "malformed")
            self.refusal = "".join(chr(byte) if 32 <= byte < 127 else "?" for byte in body[4:4 + body[1]])
            return
        if kind == _RECEPTIONS and self._next is not None:
            self._count(sequence)
        if kind == _RECEPTIONS:
            return  # for a PC that repeats the target's run
        if self._next is None:
            self._next, self._first, self._expected = (number - _HALF // 2) & _WORD, sequence, sequence
        require(self._ahead(number) < _HALF, "too late")
        waiting = self._waiting.get(number) or _Waiting(flags)
        waiting.take(header, body)
        self._waiting[number] = waiting
        self._count(sequence)
        while self._waiting:
            first = min(self._waiting, key=self._ahead)
            if not self._waiting[first].is_complete and len(self._waiting) <= 3:
                break
            frames.append(self._hand_over(first))

    def _ahead(self, number: int) -> int:
        return (number - self._next) & _WORD

    def _count(self, sequence: int) -> None:
        self.used += 1
        ahead = (sequence - self._expected) & _WORD
        if ahead < _HALF:
            self.lost, self._expected = self.lost + ahead, (sequence + 1) & _WORD
        elif (sequence - self._first) & _WORD < _HALF:
            self.lost -= 1  # late, but in time

    def _hand_over(self, number: int) -> Frame:
        waiting = self._waiting.pop(number)
        self._next = (number + 1) & _WORD
        (indexes, indexes_lost, are_indexes_whole), (classes, classes_lost, are_classes_whole) = (
            grid.decode(number, own, self.dropped) if grid in waiting.grids else (None, None, True)
            for grid, own in zip((waiting.indexes, waiting.classes), self._own, strict=True))
        geometry = waiting.indexes.geometry if waiting.indexes in waiting.grids else None
        window = Window.read(waiting.classes.window, waiting.classes.geometry) if waiting.classes.window else None
        is_next, before = (self._before[0] + 1) & _WORD == number, self._before[1]
        self._before = number, window
        is_whole = waiting.indexes.end is not None and are_indexes_whole and are_classes_whole and \
            waiting.has_its_objects
        _, _, _, _, _, closed_us, vehicle, _, complete, partial, _, points_used, *_, run = waiting.header
        return Frame(number, closed_us, vehicle, run, complete, partial, points_used, waiting.unwatched,
                     waiting.blocked, is_whole, geometry,
                     None if indexes is None else indexes.view(numpy.int8), indexes_lost,
                     None if classes is None else classes >> 3, None if classes is None else classes & 7, classes_lost,
                     window, window.velocity_since(before) if window and is_next else None, waiting.objects.objects,
                     waiting.temperature_c)
