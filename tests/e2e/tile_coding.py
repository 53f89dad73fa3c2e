"""Tiles from their encodings, read as docs/spec.md section 3.4 says."""

RAW, RUN_STARTS, RUN_STARTS_SINCE = 0, 4, 5
SIDE = 32
CELLS = SIDE * SIDE
UNKNOWN = bytes(CELLS)
FRAME_NUMBERS = 1 << 32  # they wrap


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

    def end(self) -> None:
        rest = self._text[self._at:]
        assert len(rest) < 8 and "1" not in rest, f"{rest} behind the code"


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
    return (frame - payload[0]) % FRAME_NUMBERS if encoding == RUN_STARTS_SINCE else None


def decode(encoding: int, payload: bytes, reference: bytes | None) -> bytes:
    """The 1024 cells, row by row. `reference` is the tile of the frame that reference_of names."""
    assert len(payload) <= CELLS, "longer than a raw tile"
    if encoding == RAW:
        assert len(payload) == CELLS and b"\x80" not in payload
        return payload
    if encoding == RUN_STARTS:
        return run_starts(payload, UNKNOWN)
    assert reference is not None and encoding == RUN_STARTS_SINCE, encoding
    return run_starts(payload[1:], reference)
