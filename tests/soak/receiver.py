"""Frames from messages, also of a link that was down meanwhile."""

import struct

import grid_stream
from grid_stream import FRAME_NUMBERS, OLDEST_REFERENCE

ANY_CELLS = bytes([8]) * 1024  # of a tile that nobody can know


class Assembler(grid_stream.Assembler):
    """Of a frame that refers to tiles that were lost it takes those that stand by themselves."""

    def __init__(self):
        super().__init__()
        self.lacks = 0  # tiles of the frame at hand

    def _cells_of(self, frame: int, tile: grid_stream.Tile, own: dict[int, tuple[int, bytes]]) -> bytes:
        reference = tile.reference(frame)
        if reference is not None and own.get(tile.number, (None,))[0] != reference:
            self.lacks += 1
            return ANY_CELLS
        return super()._cells_of(frame, tile, own)


class Receiver:
    """`unread`: frames with evidence that lack something, and nothing else is known of."""

    def __init__(self):
        self._assembler = Assembler()
        self._is_skipping = False
        self._frames_since_cut = OLDEST_REFERENCE + 1
        self._last: tuple[int, int] | None = None
        self.unread = 0

    def was_cut(self) -> None:
        """Messages may be missing from now on."""
        self._is_skipping = True
        self._frames_since_cut = 0

    def take(self, message: bytes) -> grid_stream.Frame | None:
        """The frame that this message ends, if it is whole."""
        if self._is_skipping:
            self._is_skipping = message[28] != grid_stream.FRAME_END
            self._assembler.begin_behind(struct.unpack_from(">I", message, 32)[0])
            return None
        frame = self._assembler.take(message)
        if frame is None:
            return None
        self._check_course(frame)
        self._frames_since_cut += 1
        if self._assembler.lacks == 0:
            return frame
        assert self._frames_since_cut <= OLDEST_REFERENCE, f"frame {frame.number} refers to what has not come"
        self._assembler.lacks = 0
        self.unread += frame.has_evidence
        return None

    def _check_course(self, frame: grid_stream.Frame) -> None:
        """Numbers and times go on, also beyond 2^32."""
        if self._last is not None:
            number, closed_us = self._last
            went_on = (frame.number - number) % FRAME_NUMBERS
            assert went_on == 1 or self._frames_since_cut == 0 < went_on < FRAME_NUMBERS // 2, (frame.number, number)
            assert frame.closed_us > closed_us, (frame.closed_us, closed_us)
        assert 0 <= frame.closed_us - frame.opened_us < 1_000_000, (frame.opened_us, frame.closed_us)
        self._last = (frame.number, frame.closed_us)
