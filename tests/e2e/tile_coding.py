"""Tiles from their encodings, read as docs/spec.md section 3.4 says."""

import struct

RAW, RUN_LENGTH, QUADTREE, CHANGED_SINCE, RUN_STARTS, RUN_STARTS_SINCE = range(6)
SIDE = 32
CELLS = SIDE * SIDE
UNKNOWN = bytes(CELLS)
FRAME_NUMBERS = 1 << 32  # they wrap


def symbol_bits(symbols: int) -> int:
    """The logarithm to base 2, rounded up."""
    return (symbols - 1).bit_length()


class Bits:
    """The bits of a payload, from the highest of a byte."""

    def __init__(self, data: bytes):
        self._text = f"{int.from_bytes(data, 'big'):0{8 * len(data)}b}" if data else ""
        self._at = 0

    def number(self, bits: int) -> int:
        if bits == 0:
            return 0
        begin, self._at = self._at, self._at + bits
        assert self._at <= len(self._text), "bits are missing"
        return int(self._text[begin:self._at], 2)

    def gamma(self) -> int:
        """A number in Elias' gamma code."""
        one = self._text.find("1", self._at)
        assert one >= 0, "a length without end"
        zeros = one - self._at
        self._at = one
        return self.number(zeros + 1)

    def end(self) -> None:
        rest = self._text[self._at:]
        assert len(rest) < 8 and "1" not in rest, f"{rest} behind the code"


def _values(payload: bytes) -> tuple[list[bytes], Bits]:
    count = payload[0]
    values = [payload[1 + i:2 + i] for i in range(count)]
    assert len(payload) > count and len(set(values)) == count and b"\x80" not in values
    return values, Bits(payload[1 + count:])


def runs(payload: bytes, reference: bytes | None) -> bytes:
    """With a reference, symbol 0 is as there and the values count from 1."""
    values, bits = _values(payload)
    first_value = 0 if reference is None else 1
    symbols = len(values) + first_value
    width, next_width = symbol_bits(symbols), symbol_bits(symbols - 1)
    cells = bytearray()
    before = symbols
    while len(cells) < CELLS:
        symbol = bits.number(width)
        symbol += symbol >= before
        assert symbol < symbols, f"symbol {symbol} of {symbols}"
        length = bits.gamma()
        assert length <= CELLS - len(cells), "a run beyond the tile"
        if symbol < first_value:
            cells += reference[len(cells):len(cells) + length]
        else:
            cells += values[symbol - first_value] * length
        before, width = symbol, next_width
    bits.end()
    return bytes(cells)


def quadtree(payload: bytes) -> bytes:
    values, bits = _values(payload)
    cells = bytearray(CELLS)

    def node(x: int, y: int, side: int) -> None:
        if side > 1 and bits.number(1):
            half = side // 2
            for dy in (0, half):
                for dx in (0, half):
                    node(x + dx, y + dy, half)
            return
        value = values[bits.number(symbol_bits(len(values)))]
        for row in range(y, y + side):
            cells[row * SIDE + x:row * SIDE + x + side] = value * side

    node(0, 0, SIDE)
    bits.end()
    return bytes(cells)


def packed_digits(bits: Bits, base: int, count: int) -> list[int]:
    """So many digits to this base, four by four in numbers below 2^31."""
    if base == 1:
        return [0] * count
    most = max(fours for fours in range(1, 8) if base ** (4 * fours) <= 2 ** 31)
    whole, of_four = (base ** (4 * most) - 1).bit_length(), (base ** 4 - 1).bit_length()
    digits, left = [], -(-count // 4)
    while left > 0:
        fours = min(most, left)
        number = bits.number(whole if fours == most else min(whole, fours * of_four))
        for place in reversed(range(4 * fours)):
            digit, number = divmod(number, base ** place)
            assert digit < base
            digits.append(digit)
        left -= fours
    assert not any(digits[count:]), "symbols behind the last run"
    return digits[:count]


def run_starts(payload: bytes, reference: bytes) -> bytes:
    """Symbol 0 is as in the reference, and so the tile begins; the values count from 1."""
    count = payload[0]
    values, rest = payload[1:1 + count], payload[1 + count:]
    assert len(values) == len(set(values)) == count <= 215 and 0x80 not in values
    if count == 0:
        assert not rest
        return reference
    blocks = [block for block in range(128) if rest[block // 8] >> block % 8 & 1]
    starts = set()
    for block, cells in zip(blocks, rest[16:16 + len(blocks)], strict=True):
        assert cells > 0, "no run starts in a block"
        corner = block // 8 * 2 * SIDE + block % 8 * 4
        starts |= {corner + i // 4 * SIDE + i % 4 for i in range(8) if cells >> i & 1}
    bits = Bits(rest[16 + len(blocks):])
    digits = iter(packed_digits(bits, count, len(starts)))
    bits.end()
    cells, symbol = bytearray(), 0
    for cell in range(CELLS):
        if cell in starts:
            digit = next(digits)
            symbol = digit + (digit >= symbol)
        cells.append(values[symbol - 1] if symbol else reference[cell])
    return bytes(cells)


def reference_of(encoding: int, payload: bytes, frame: int) -> int | None:
    """The number of the frame that a tile of this frame refers to; None if it stands by itself."""
    if encoding == CHANGED_SINCE:
        return struct.unpack_from(">I", payload)[0]
    return (frame - payload[0]) % FRAME_NUMBERS if encoding == RUN_STARTS_SINCE else None


def decode(encoding: int, payload: bytes, reference: bytes | None) -> bytes:
    """The 1024 cells, row by row. `reference` is the tile of the frame that reference_of names."""
    assert len(payload) <= CELLS, "longer than a raw tile"
    if encoding == RAW:
        assert len(payload) == CELLS and b"\x80" not in payload
        return payload
    if encoding == RUN_LENGTH:
        return runs(payload, None)
    if encoding == QUADTREE:
        return quadtree(payload)
    if encoding == RUN_STARTS:
        return run_starts(payload, UNKNOWN)
    assert reference is not None and encoding in (CHANGED_SINCE, RUN_STARTS_SINCE), encoding
    if encoding == CHANGED_SINCE:
        return runs(payload[4:], reference)
    return run_starts(payload[1:], reference)
