"""Does the page show the classes of the window where they are, as fresh as they are, and with the
reason where there are none?"""

import math
import pathlib

import made_stream
from browser import Browser
from made_classes import CONTRADICTED, DRIFTING, FREE, IMPRECISE, JUMP, LATE, LOST, MOVING, OCCUPIED, RESTART, STANDING, \
    Window, class_byte, map_part
from made_objects import Thing, objects_of
from viewer import GridPage, Viewer, free_port

CELL_M = 0.1
# tools/formats/picture/class_picture.cpp at their surest; the weakest is 55 % of the way from dark.
COLOURS = {0: (30, 33, 38), FREE: (172, 200, 222), MOVING: (255, 40, 160), STANDING: (214, 120, 40),
           OCCUPIED: (240, 230, 120)}
WEAKEST = tuple(round(dark + 0.55 * (light - dark)) for dark, light in zip(COLOURS[0], COLOURS[MOVING]))


def picture_of_window(**places) -> Window:
    """Free ground around the origin, something that moves ahead (x) and something that stands to the
    left (y)."""
    window = Window(**places)
    window.fill(range(-100, 160), range(-100, 160), class_byte(FREE))
    window.fill(range(80, 100), range(-10, 10), class_byte(MOVING))
    window.fill(range(-10, 10), range(80, 100), class_byte(STANDING))
    window.fill(range(40, 50), range(40, 50), class_byte(MOVING, 0))
    return window


def alike(a: tuple[int, int, int], b: tuple[int, int, int]) -> bool:
    """But for what edges that lie between pixels do to a colour that is drawn twice."""
    return max(abs(one - other) for one, other in zip(a, b)) <= 4


class Street:
    """A stream of windows, and the page that shows it."""

    def __init__(self, page: GridPage, port: int):
        self.page = page
        self.target = made_stream.Target(port)
        self.things: list[Thing] | None = None  # that it tells of
        self.grid = made_stream.Grid()
        self.grid.fill(range(592, 612), range(502, 522), 10)

    def show(self, window: Window) -> None:
        window.objects = None if self.things is None else objects_of(self.things)
        self.target.send(self.grid, points_used=100, window=window)
        self.page.wait_for_frame(self.target.frames - 1)

    def show_with_banner(self, window: Window, title: str) -> None:
        for _ in range(10):  # a busy machine may be too slow for a picture of now
            self.show(window)
            if title in self.page.banner:
                return
        raise AssertionError(f"{self.page.banner!r} instead of {title!r}")

    def colour_at(self, window: Window, column: float, row: float) -> tuple[int, int, int]:
        """Of a place so many pixels right of and below the picture's middle."""
        return self.page.page.pixel(*self._place_in(window, column, row))

    def colours_around(self, window: Window, column: float, row: float) -> list[tuple[int, int, int]]:
        """Of that place and of the eight pixels around it, of one picture."""
        left, top = self._place_in(window, column, row)
        return self.page.page.pixels(left - 1, top - 1, 3, 3)

    def around(self, window: Window, forward_m: float, left_m: float, reach: int) -> list[tuple[int, int, int]]:
        """The colours of what is so far from a car that drives upwards, and of so many pixels to every side."""
        scale = self.page.page.value("iogPage.view.pixelsPerMetre")
        left, top = self._place_in(window, -left_m * scale, -forward_m * scale)
        return self.page.page.pixels(left - reach, top - reach, 2 * reach + 1, 2 * reach + 1)

    def _place_in(self, window: Window, column: float, row: float) -> tuple[float, float]:
        """On the page, which shows a picture of now."""
        self.show(window)  # or the picture would soon be an old one
        left, top, width, height = self.page.page.value(
            "(({x, y, width, height}) => [x, y, width, height])"
            "(document.getElementById('grid').getBoundingClientRect())")
        return left + width / 2 + column, top + height / 2 + row

    def expect(self, window: Window, forward_m: float, left_m: float, colour, up_turns: float = 0):
        """What is so far from the car, on a screen on which the car points up, or is turned."""
        scale = self.page.page.value("iogPage.view.pixelsPerMetre")
        angle = 2 * math.pi * up_turns
        up = forward_m * math.cos(angle) - left_m * math.sin(angle)
        left = forward_m * math.sin(angle) + left_m * math.cos(angle)
        self.expect_at(window, -left * scale, -up * scale, colour)

    def expect_at(self, window: Window, column: float, row: float, colour) -> None:
        for _ in range(5):  # on a busy machine the picture may be an old one, which is grey
            found = self.colour_at(window, column, row)
            if alike(found, colour):
                return
        raise AssertionError(f"{found} instead of {colour} at {column:.1f}, {row:.1f}")


def check_picture(street: Street) -> None:
    """Classes come first, each in its colour, and the brighter the surer; V shows the index grid."""
    page = street.page
    window = picture_of_window()
    street.show(window)
    page.switch_overlays_off()
    page.page.press("u")  # is an overlay, too
    for _ in range(3):
        page.page.press("+")
    street.expect(window, 9, 0, COLOURS[MOVING])
    street.expect(window, 0, 9, COLOURS[STANDING])
    street.expect(window, 4.5, 4.5, WEAKEST)
    street.expect(window, 6, -6, COLOURS[FREE])
    street.expect(window, 6, -10.5, COLOURS[0])
    assert "What is there" in page.text("legend")
    words = page.hover(592, 512)  # x = 592 cells from -51.2 m
    for part in ("moving", "as sure as can be", "local frame 8.05, 0.05 m"):
        assert part in words, (part, words)
    assert "unknown" in page.hover(572, 405)
    rectangle = picture_of_window(corner=(-5, -4), sides=(9, 7))
    street.expect(rectangle, 9, 0, COLOURS[MOVING])
    street.expect(rectangle, 0, 9, COLOURS[STANDING])
    assert page.page.value("[iogPage.view.shape.columns, iogPage.view.shape.rows]") == [288, 224]
    street.show(window)
    page.page.press("v")
    page.page.wait_for("!iogPage.view.showsClasses")
    assert "Occupancy index" in page.text("legend")
    street.expect(window, 9, 0, (214, 26, 8))
    page.page.click("#layer")
    page.page.wait_for("iogPage.view.showsClasses")


def check_turns(street: Street) -> None:
    """A car that is turned still drives upwards, unless the ground stands still; things stay where they
    are in the world while the window moves."""
    page = street.page
    # A quarter of a turn: y is ahead, and x is to the right. The window is three tiles further.
    turned = picture_of_window(turns=0.25, x_m=2, y_m=1, corner=(-13, -14))
    for up_turns in (0, 0.25):
        street.expect(turned, 9 - 1, 2, COLOURS[STANDING], up_turns)
        street.expect(turned, -1, -7, COLOURS[MOVING], up_turns)
        street.expect(turned, -6, 8.5, COLOURS[FREE], up_turns)
        page.page.press("u")
    away = picture_of_window(x_m=-3, y_m=2, corner=(-16, -16))
    street.expect(away, 12, -2, COLOURS[MOVING])
    # The ground stands still under whoever has moved the picture away from the car.
    page.page.press("u")
    street.show(away)
    page.page.run("iogPage.view.pan(30, 0)")
    scale = page.page.value("iogPage.view.pixelsPerMetre")
    for x_m in (-3, -1, 1):
        moved = picture_of_window(x_m=x_m, y_m=2)
        column, row = 30 - (0 - 2) * scale, -(9 + 3) * scale
        street.expect_at(moved, column, row, COLOURS[MOVING])
    page.page.press("u")
    page.page.press("f")


def check_losses(street: Street) -> None:
    """A tile that did not come is shown as it was, and never as fresh."""
    page = street.page
    window = picture_of_window()
    street.expect(window, 9, 0, COLOURS[MOVING])
    messages = street.target.messages_of(street.grid, 100, window)
    slot = -1 % 32 * 32 + 2  # tile (2, -1) holds the cell of 9 m ahead and 0.05 m right
    def is_of_tile(message: bytes) -> bool:
        storage, first = message[83], int.from_bytes(message[148:150], "big")
        return message[28] == 1 and storage == 2 and first == slot

    assert sum(map(is_of_tile, messages)) == 1
    lost = street.target.frames - 1
    for message in messages:
        if not is_of_tile(message):
            street.target.send_bytes(message)
    shown = (f"iogPage.grid.frame.status.frame.number >= {lost} && "
             f"iogPage.grid.classAges[{slot}] > 0 && iogPage.grid.classAges[{slot}] < 255")
    for longest_s in (4, 4, 4, 20):  # on a busy PC more is lost than was meant
        for _ in range(4):  # the frame is given up when others have begun
            for message in street.target.messages_of(street.grid, 100, window):
                if not is_of_tile(message):
                    street.target.send_bytes(message)
        if page.page.has_come(shown, longest_s):
            break
    else:
        raise AssertionError(f"a frame without a tile was not shown: {page.page.complaints()}")
    page.wait_for_state("live, tiles missing")
    assert "frames old" in page.hover(592, 511)
    left, top = page.place_of(592, 511)
    faded = page.page.pixel(left, top)
    assert not alike(faded, COLOURS[MOVING]) and faded[0] > COLOURS[0][0] + 20, faded
    street.expect(window, 9, 0, COLOURS[MOVING])


def check_causes(street: Street, folder: pathlib.Path) -> None:
    """Why nothing is placed, in words, and since when."""
    page = street.page
    for cause, since_s, title, text in (
            (LOST, None, "No pose has come yet", "Without poses nothing can be placed."),
            (LATE, 0.3, "No pose for 0.3 s", "Nothing is placed. What was known stays"),
            (IMPRECISE, 2.5, "The pose is too imprecise for 2.5 s", "Nothing is placed"),
            (LOST, 3.2, "No pose for 3.2 s", "Nothing is placed, and where things were")):
        window = Window()
        since_us = 0 if since_s is None else window.stamp_us - round(since_s * 1e6)
        window.without_place(cause, since_us, times=0 if since_s is None else 1)
        street.show_with_banner(window, f"{title} {text}")
    page.page.screenshot(folder / "no_pose.png")
    for cause, title in ((JUMP, "The pose jumped 1.2 s ago"),
                         (RESTART, "The source of the poses started anew 1.2 s ago"),
                         (CONTRADICTED, "The sensors contradicted the poses 1.2 s ago"),
                         (DRIFTING, "Poses came later and later 1.2 s ago"),
                         (LOST, "Poses were lost 1.2 s ago, and are back")):
        window = picture_of_window()
        window.causes = cause
        window.history[cause] = (5, 2, window.stamp_us - 1_200_000)
        street.show_with_banner(window, f"{title} What was known has lost its place: the window began")
        page.page.wait_for("document.querySelector('#chart-places .chart-notes').textContent"
                           ".includes('1.2 s ago, 2 times')")
    for _ in range(2):
        street.show(picture_of_window())
    page.page.wait_for("document.getElementById('banner').hidden")


def check_track(street: Street) -> None:
    """Where the car was is a line; it breaks off where the pose jumped. How well the pose is known is
    said, and drawn where it is more than a cell."""
    page = street.page
    page.page.press("k")
    for x_m in range(-8, 1):
        street.show(picture_of_window(x_m=x_m))
    ends = page.page.value("iogPage.view.track.map((at) => at && at.x).slice(-9)")
    assert ends == list(range(-8, 1)), ends
    far = picture_of_window(x_m=-9)
    street.show(far)
    street.show(picture_of_window().without_pose())  # it is not at the origin all of a sudden
    assert page.page.value("!iogPage.view.hasPlace && iogPage.view.pose.x") == -9
    assert page.page.value("iogPage.view.track.at(-1).x") == -9
    page.page.wait_for("document.querySelector('#chart-places .chart-head').textContent"
                       ".includes('no place')")
    street.show(picture_of_window())
    street.expect(picture_of_window(), -5, 0, (255, 255, 255))
    jumped = picture_of_window(y_m=5)
    jumped.causes = JUMP
    street.show(jumped)
    assert page.page.value("iogPage.view.track.at(-1).y === 5 && iogPage.view.track.at(-2) === null")
    doubtful = picture_of_window()
    doubtful.sigma_mm = 140
    street.show(doubtful)
    page.page.wait_for("document.querySelector('#chart-places .chart-head').textContent"
                       ".includes('±0.14 m, ±0.06°')")
    nose_m = page.page.value("iogPage.view.vehicle.footprint.x_max")
    for _ in range(4):
        page.page.press("+")  # 14 cm are several pixels then
    halo = street.colour_at(doubtful, 0, -(nose_m + 0.07) * page.page.value(
        "iogPage.view.pixelsPerMetre"))
    assert not alike(halo, COLOURS[FREE]), halo
    street.expect(picture_of_window(), nose_m + 0.07 + CELL_M, 0, COLOURS[FREE])


def check_map(street: Street, folder: pathlib.Path) -> None:
    """Whose the map is stands there as long as one is in use, however small the page; else the reason is
    told in words. What the map names has a colour, and a line of the legend."""
    page = street.page

    def expect_words(part: bytes, *words: str) -> None:
        window = picture_of_window()
        window.map = part
        street.show(window)
        for word in words:
            page.page.wait_for(f"document.getElementById('legend-map').textContent.includes({word!r})")

    expect_words(map_part(cause=1, attribution=None), "No map: no road or house classes.")
    expect_words(map_part(cause=1, attribution=None, missing=3), "No map yet: receiving 5e6f7081, 7 of 10")
    expect_words(map_part(cause=3), "Map: me", "Not used: the poses name another origin")
    expect_words(map_part(waiting=12), "Map: me", "12 tiles wait")
    named = picture_of_window()
    named.map = map_part(attribution="\u00a9 <b>OpenStreetMap</b>, ODbL 1.0")
    for number, name in ((1, "drivable"), (2, "free, not drivable"), (5, "stopped"), (7, "infrastructure")):
        named.fill(range(-100, 0), range(-100 + 20 * number, -80 + 20 * number), class_byte(number))
        street.show(named)
        page.page.wait_for(f"document.getElementById('legend-classes').innerText.includes({name!r})")
    assert page.text("legend-map") == "Map: \u00a9 <b>OpenStreetMap</b>, ODbL 1.0", page.text("legend-map")
    page.page.screenshot(folder / "map.png")


def check(iog: str, folder: pathlib.Path, browser: Browser) -> None:
    port = free_port()
    with Viewer(iog, "--port", str(port)) as viewer:
        page = GridPage(browser.open(viewer.address))
        street = Street(page, port)
        check_picture(street)
        check_turns(street)
        check_losses(street)
        check_causes(street, folder)
        check_track(street)
        check_map(street, folder)
        assert page.page.value("iogPage.errors") == 0
        assert not page.page.complaints(), page.page.complaints()
        page.page.close()
