"""The encodings of a tile (docs/spec.md, 3.4). What does not follow the specification is an Unsound, whatever it is."""

import functools
import typing

import numpy

from iogrid.protection import require

CELLS = 1024  # of a tile, 32 x 32, row by row
RAW, RUN_STARTS, RUN_STARTS_SINCE = 0, 4, 5


class RunStarts(typing.NamedTuple):
    """A tile of encoding 4 or 5, before it is drawn."""

    values: bytes
    is_set: bytes  # a bit for each block
    sets: bytes  # a byte for each of these
    runs: int
    numbers: list[int]  # of their digits


def _read_run_starts(values: bytes, rest: bytes) -> RunStarts:
    if not values:
        require(not rest)
        return RunStarts(values, bytes(16), b"", 0, [])
    require(len(values) <= 215 and len(rest) >= 16)
    end = 16 + int.from_bytes(rest[:16], "big").bit_count()
    sets = rest[16:end]
    require(len(rest) >= end and 0 not in sets)
    runs = int.from_bytes(sets, "big").bit_count()
    return RunStarts(values, rest[:16], sets, runs, _read_numbers(rest[end:], len(values), runs))


@functools.cache
def _packing(base: int) -> tuple[int, int, int, numpy.ndarray]:
    """Digits in a number, its bits, the bits of a number of four digits, and what the digits are worth."""
    digits = 4 * max(fours for fours in range(1, 8) if base ** (4 * fours) <= 2 ** 31)
    worth = (base ** numpy.arange(digits)[::-1]).astype(numpy.int32)
    return digits, (base ** digits - 1).bit_length(), (base ** 4 - 1).bit_length(), worth


def _read_numbers(data: bytes, base: int, count: int) -> list[int]:
    """So many digits to this base, many to a number of at most 31 bits, and nothing behind them. Digits that the last
    number has not are 0 here."""
    if base == 1:
        require(not data)
        return []
    per_number, width, width_of_four, _ = _packing(base)
    wholes, rest = divmod(-(-count // 4) * 4, per_number)
    rest_width = min(width, rest // 4 * width_of_four)
    bits, left = int.from_bytes(data, "big"), 8 * len(data) - wholes * width - rest_width  # padding
    require(0 <= left < 8 and bits & (1 << left) - 1 == 0)
    last, bits = bits >> left & (1 << rest_width) - 1, bits >> left + rest_width
    numbers = [bits >> width * (wholes - 1 - i) & (1 << width) - 1 for i in range(wholes)]
    require(last < base ** rest and max(numbers, default=0) < base ** per_number)
    numbers.append(last * base ** (per_number - rest))
    require((last if rest else numbers[wholes - 1]) % base ** (-count % 4) == 0)
    return numbers


def _digits_of(tiles: list[RunStarts]) -> list[numpy.ndarray]:
    """Those of tiles with as many values at once."""
    digits = [numpy.zeros(tile.runs, numpy.int32) for tile in tiles]
    for base in {len(tile.values) for tile in tiles} - {0, 1}:
        members = [i for i, tile in enumerate(tiles) if len(tile.values) == base]
        per_number, _, _, worth = _packing(base)
        numbers = numpy.array([number for i in members for number in tiles[i].numbers], numpy.int32)
        of_all, at = (numbers[:, None] // worth % base).ravel(), 0
        for i in members:
            digits[i] = of_all[at:at + tiles[i].runs]
            at += per_number * len(tiles[i].numbers)
    return digits


def draw(tiles: list[RunStarts], references: numpy.ndarray) -> numpy.ndarray:
    """The cells of tiles, [tile, cell]; all at once, which is several times as fast as one by one. references: what
    symbol 0 of each stands for, likewise."""
    is_set = numpy.unpackbits(_array(b"".join(tile.is_set for tile in tiles)), bitorder="little").astype(bool)
    is_start = numpy.zeros((len(is_set), 8), numpy.uint8)  # [block of a tile, cell of it]
    sets = numpy.unpackbits(_array(b"".join(tile.sets for tile in tiles)), bitorder="little")
    is_start[is_set] = sets.reshape(-1, 8)
    is_start = is_start.reshape(-1, 16, 8, 2, 4).swapaxes(2, 3).reshape(-1, CELLS)
    # Run 0 of each tile is what comes before the first that starts. Its digit stands for symbol 0.
    runs = numpy.array([1 + tile.runs for tile in tiles])
    values = numpy.array([1 + len(tile.values) for tile in tiles])
    symbols = _symbols(numpy.concatenate([part for digits in _digits_of(tiles) for part in ((-1,), digits)]))
    table = _array(b"".join(b"\0" + tile.values for tile in tiles))
    value_of_run = table[symbols + numpy.repeat(values.cumsum() - values, runs)]
    run_of_cell = is_start.cumsum(axis=1, dtype=numpy.int32) + (runs.cumsum() - runs)[:, None]
    return numpy.where((symbols == 0)[run_of_cell], references, value_of_run[run_of_cell])


def _symbols(digits: numpy.ndarray) -> numpy.ndarray:
    """A symbol above the one before it was written less one, as no run has that. So it is one more than its digit if
    that is above the digit before, and not if it is below; among equal ones the two take turns. -1 is symbol 0."""
    places, steps = numpy.arange(len(digits)), numpy.diff(digits, prepend=digits[:1])
    first = numpy.maximum.accumulate(numpy.where(steps != 0, places, 0))  # of the equal digits around each
    is_more = (steps[first] > 0) ^ ((places - first) % 2 == 1)
    return numpy.where(digits < 0, 0, digits + is_more)


def _array(data: bytes) -> numpy.ndarray:
    return numpy.frombuffer(data, numpy.uint8)


def reference_of(encoding: int, payload: bytes, frame: int) -> tuple[int | None, bytes]:
    """The frame that a tile of this frame refers to, None if it stands by itself; and the payload behind that."""
    if encoding != RUN_STARTS_SINCE:
        return None, payload
    require(bool(payload))
    return (frame - payload[0]) & 0xFFFFFFFF, payload[1:]


def read_tile(encoding: int, payload: bytes) -> bytes | RunStarts:
    """Its cells, or how they are to be drawn."""
    require(encoding in (RAW, RUN_STARTS, RUN_STARTS_SINCE), "unknown encoding")
    if encoding == RAW:
        require(len(payload) == CELLS)
        return payload
    count = payload[0] if payload else 255
    values, rest = payload[1:1 + count], payload[1 + count:]
    require(len(values) == count and 0x80 not in values)
    return _read_run_starts(values, rest)
