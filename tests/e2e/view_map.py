"""Does the page draw the outlines of the map that the target uses, where they are, and of no other?"""

import json
import pathlib
import struct
import subprocess

from browser import Browser
from made_classes import FREE, Window, class_byte, map_part
from view_classes import COLOURS, Street, alike
from viewer import GridPage, Viewer, free_port

METRES_PER_DEGREE = (111_319.5, 110_574.3)  # east and north, at 0, 0 on WGS 84
HOUSE = ((5, 5), (15, 5), (15, 12), (5, 12))  # metres east and north of the origin
ROAD = ((-12, -30), (-6, -30), (-6, 30), (-12, 30))


def block_of(iog: str, folder: pathlib.Path) -> pathlib.Path:
    def feature(kind: str, corners) -> dict:
        ring = [[x / METRES_PER_DEGREE[0], y / METRES_PER_DEGREE[1]] for x, y in (*corners, corners[0])]
        return {"type": "Feature", "properties": {"kind": kind},
                "geometry": {"type": "Polygon", "coordinates": [ring]}}

    source, block = folder / "outlines.geojson", folder / "outlines.iogmap"
    source.write_text(json.dumps({"type": "FeatureCollection", "features": [
        feature("building", HOUSE), feature("road", ROAD)]}))
    subprocess.run([iog, "map", source, "--origin=0,0", "--attribution", "me", "--out", block],
                   check=True, capture_output=True)
    return block


def window_of(part: bytes) -> Window:
    window = Window()
    window.fill(range(-200, 200), range(-200, 200), class_byte(FREE))
    window.map = part
    return window


class Ground:
    """The car stands at the local frame's origin and looks along its x, which is up on the page."""

    def __init__(self, street: Street, window: Window):
        self.street = street
        self.window = window

    def expect(self, is_drawn: bool, x_m: float, y_m: float) -> None:
        """Whether a line goes through there; on a busy machine the picture may be an old one."""
        assert any(self._is_drawn(x_m, y_m) == is_drawn for _ in range(8)), (is_drawn, x_m, y_m)

    def _is_drawn(self, x_m: float, y_m: float) -> bool:
        """Whether its pixel, or one beside it, has no colour of the ground."""
        scale = self.street.page.page.value("iogPage.view.pixelsPerMetre")
        seen = self.street.colours_around(self.window, -y_m * scale, -x_m * scale)
        return any(not alike(colour, COLOURS[FREE]) for colour in seen)


def check(iog: str, folder: pathlib.Path, browser: Browser) -> None:
    block = block_of(iog, folder)
    crc = struct.unpack_from(">I", block.read_bytes(), 12)[0]
    port = free_port()
    with Viewer(iog, "--port", str(port), "--map", str(block)) as viewer:
        page = GridPage(browser.open(viewer.address))
        street = Street(page, port)
        # The local frame lies 2 m east of the plane's origin and is turned by a quarter: its x is north,
        # and its y is west.
        used = window_of(map_part(crc=crc, place=(2000, 0, 0.25)))
        street.show(used)
        page.page.wait_for("iogPage.view.outlines !== null")
        page.switch_overlays_off(but=("outlines", "up"))
        ground = Ground(street, used)
        # Walls and kerbs by (north, west): the house is 3 to 13 m to the right.
        for place in ((5, -8), (12, -8), (8, -3), (8, -13), (-10, 8), (10, 14)):
            ground.expect(True, *place)
        for place in ((8, -8), (-8, 3), (0, 11), (3, -8)):
            ground.expect(False, *place)
        page.page.screenshot(folder / "outlines.png")
        page.page.press("o")
        ground.expect(False, 5, -8)
        page.page.press("o")
        ground.expect(True, 5, -8)

        # Another map, one whose place is not known, or one that is not used: no line, and the page says why.
        for part, words in ((map_part(crc=crc ^ 1, place=(2000, 0, 0.25)), "this PC has"),
                            (map_part(cause=3, crc=crc, place=(2000, 0, 0.25)), "Not used"),
                            (map_part(crc=0, attribution=None), "No map")):
            other = window_of(part)
            street.show(other)
            page.page.wait_for(f"document.getElementById('legend-map').textContent.includes('{words}')")
            Ground(street, other).expect(False, 5, -8)
        check_empty_frames(street, used)
        assert page.page.value("iogPage.errors") == 0
        assert not page.page.complaints(), page.page.complaints()
        page.page.close()


def check_empty_frames(street: Street, window: Window) -> None:
    """Where every other frame is empty the numbers beside the picture stay those of the others."""
    page = street.page.page
    seen = set()
    for i in range(40):
        street.target.complete = 0b1111 * (i % 2)
        street.target.send(street.grid, points_used=100 * (i % 2), window=window)
        street.page.wait_for_frame(street.target.frames - 1)
        page.run("iogPage.showWords()")
        if i > 1:
            seen.add(page.value("document.querySelector('#chart-fates .chart-head span').textContent"))
    assert seen == {"100 "}, seen
