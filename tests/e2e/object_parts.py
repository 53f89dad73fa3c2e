"""The messages of objects, read and written as docs/spec.md 3.12 says. What is wrong is an AssertionError."""

import dataclasses
import itertools
import struct

HEADER = struct.Struct(">HHHBBQHHI")
OBJECT = struct.Struct(">IBBHiiHHHHhhHHHHHH")
OF_A_PART, MOST_PARTS = 32, 8
YOUNG, STANDS, MOVES, STOPPED = range(1, 5)
HAS_HEADING, NOT_HIT, END_HIDDEN = 1, 2, 4
NOT_BELIEVED = 65535


@dataclasses.dataclass(frozen=True)
class Object:
    id: int
    state: int = YOUNG
    existence: int = 0
    age: int = 4
    x_mm: int = 0
    y_mm: int = 0
    length_cm: int = 0
    width_cm: int = 0
    heading: int = 0
    flags: int = 0
    vx_cm_s: int = 0
    vy_cm_s: int = 0
    sigma_v_along: int = NOT_BELIEVED
    sigma_v_across: int = NOT_BELIEVED
    sigma_along: int = 0
    sigma_across: int = 0
    since_hit_ms: int = 0
    since_stopped: int = 65535


@dataclasses.dataclass(frozen=True)
class Part:
    count: int  # of objects in the list
    number: int
    parts: int
    time_us: int
    refused: int
    left: int
    objects: list[Object]


@dataclasses.dataclass(frozen=True)
class List:
    time_us: int  # 0: nothing is known
    refused: int
    left: int
    objects: list[Object]


def read(body: bytes) -> Part:
    header_bytes, object_bytes, count, number, parts, time_us, refused, left, zero = HEADER.unpack_from(body)
    assert (header_bytes, object_bytes, zero) == (HEADER.size, OBJECT.size, 0)
    objects = [Object(*fields) for fields in OBJECT.iter_unpack(body[HEADER.size:])]
    for each in objects:
        assert each.id > 0 and YOUNG <= each.state <= STOPPED and each.flags < 8
        assert each.state == MOVES or (each.vx_cm_s, each.vy_cm_s) == (0, 0)
        deviations = (each.sigma_v_along, each.sigma_v_across)
        assert (NOT_BELIEVED in deviations) == (each.state in (YOUNG, STANDS)), each
        assert each.flags & NOT_HIT or each.since_hit_ms == 0
    return Part(count, number, parts, time_us, refused, left, objects)


def joined(parts: list[Part]) -> List:
    """Of the parts of a frame in the order in which they came, which is theirs."""
    first = parts[0]
    objects = [each for part in parts for each in part.objects]
    assert [part.number for part in parts] == list(range(first.parts)) and first.parts <= MOST_PARTS
    assert len({dataclasses.replace(part, number=0, objects=None) for part in parts}) == 1
    assert [len(part.objects) for part in parts] == \
        [min(OF_A_PART, len(objects) - at) for at in range(0, max(len(objects), 1), OF_A_PART)]
    assert len(objects) == first.count and (first.time_us > 0 or not objects)
    assert all(a.id < b.id for a, b in itertools.pairwise(objects)), "ids out of order"
    return List(first.time_us, first.refused, first.left, objects)


def bodies(objects: list[Object], time_us: int, refused: int = 0, left: int = 0) -> list[bytes]:
    """The messages' bodies of a list, which is in order."""
    parts = max(1, -(-len(objects) // OF_A_PART))
    return [HEADER.pack(HEADER.size, OBJECT.size, len(objects), number, parts, time_us, refused, left, 0) +
            b"".join(OBJECT.pack(*dataclasses.astuple(each))
                     for each in objects[OF_A_PART * number:OF_A_PART * (number + 1)])
            for number in range(parts)]
