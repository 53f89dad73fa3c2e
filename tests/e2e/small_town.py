"""A town of one street and three houses, as OpenStreetMap has it, for tests of what becomes of a map."""

import pathlib
import struct
import subprocess

ORIGIN = (48.41, 15.6)
# Degrees from the origin, latitude first; a ten-thousandth is 11 m north and 7 m east.
HOUSES = (((1, 2), (1, 4), (2, 4), (2, 2)), ((1, 6), (1, 9), (3, 9), (3, 6)), ((-1, 2), (-1, 5), (-3, 5), (-3, 2)))
STREET = ((0, -10), (0, 0), (0.2, 15))


def osm() -> str:
    nodes, ways = [], []

    def way(places, tags: dict[str, str], is_closed: bool) -> None:
        first = len(nodes) + 1
        for north, east in places:
            nodes.append(f'<node id="{len(nodes) + 1}" version="1" lat="{ORIGIN[0] + north * 1e-4:.7f}" '
                         f'lon="{ORIGIN[1] + east * 1e-4:.7f}"/>')
        ids = [*range(first, len(nodes) + 1), *([first] if is_closed else [])]
        ways.append(f'<way id="{len(ways) + 1}" version="1">' + "".join(f'<nd ref="{i}"/>' for i in ids) +
                    "".join(f'<tag k="{k}" v="{v}"/>' for k, v in tags.items()) + "</way>")

    for house in HOUSES:
        way(house, {"building": "yes"}, True)
    way(STREET, {"highway": "residential", "width": "7"}, False)
    return '<?xml version="1.0"?>\n<osm version="0.6">\n' + "\n".join([*nodes, *ways]) + "\n</osm>\n"


def block_of(iog: str, folder: pathlib.Path) -> pathlib.Path:
    """What `iog map` makes of it."""
    source, block = folder / "small_town.osm", folder / "small_town.iogmap"
    source.write_text(osm())
    subprocess.run([iog, "map", source, f"--origin={ORIGIN[0]},{ORIGIN[1]}", "--out", block], check=True,
                   capture_output=True)
    return block


def crc_of(block: bytes) -> int:
    return struct.unpack_from(">I", block, 12)[0]
