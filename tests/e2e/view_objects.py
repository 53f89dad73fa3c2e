"""Does the page draw the boxes of objects where they are, as they are, and only those that it knows of?"""

import dataclasses
import math
import pathlib

import grid_stream
from browser import Browser
from colour_vision import READABLE, contrast
from made_classes import FREE, Window, class_byte
from made_objects import Thing, objects_of
from object_parts import MOVES, STOPPED, YOUNG
from view_classes import COLOURS, Street, alike
from viewer import GridPage, Viewer, free_port

CARD = (20, 23, 27, 0.86)  # below words, tools/view/page/palette.js
MAGENTA, AMBER, YELLOW = (255, 40, 160), (250, 190, 40), (240, 230, 120)
CAR = Thing(7, MOVES, x_m=10, y_m=2, turns=0.25, velocity=(0, -6), sigma=(0.7, 0.2), age_frames=50)
PARKED = Thing(9, STOPPED, x_m=6, y_m=-6, length_m=4, width_m=2, turns=0.125)
WHAT = Thing(300, YOUNG, x_m=-8, y_m=5, length_m=1, width_m=1)


def ground(**places) -> Window:
    window = Window(**places)
    window.fill(range(-160, 160), range(-160, 160), class_byte(FREE))
    return window


def is_seen(street: Street, window: Window, forward_m: float, left_m: float, colour) -> bool:
    """Whether a line of that colour goes by there, within two pixels."""
    # On a busy machine the picture may be an old one, which is grey.
    return any(colour_near(street.around(window, forward_m, left_m, 2), colour) for _ in range(5))


def colour_near(pixels: list[tuple[int, int, int]], colour) -> bool:
    return any(alike(pixel, colour) for pixel in pixels)


def dashes(street: Street, window: Window, colour) -> float:
    """Which share of a long side of the car, which is level, has its colour: of a whole line all."""
    reach = 40
    side = 2 * reach + 1
    pixels = street.around(window, CAR.x_m + CAR.width_m / 2, CAR.y_m, reach)
    rows = [pixels[row * side:(row + 1) * side] for row in range(reach - 2, reach + 3)]
    return sum(colour_near(list(column), colour) for column in zip(*rows)) / side


def corners(thing: Thing) -> list[tuple[float, float]]:
    cos, sin = math.cos(math.tau * thing.turns), math.sin(math.tau * thing.turns)
    return [(thing.x_m + along * cos - across * sin, thing.y_m + along * sin + across * cos)
            for along in (-thing.length_m / 2, thing.length_m / 2)
            for across in (-thing.width_m / 2, thing.width_m / 2)]


def check_boxes(street: Street, folder: pathlib.Path) -> None:
    """Corners and arrow stand where the stream says, in the colours of the legend; the middle of a box is free
    to be seen. B takes all of it away."""
    page = street.page
    window = ground()
    street.things = [CAR, PARKED, WHAT]
    street.show(window)
    page.page.wait_for("!document.querySelector('[data-overlay=\"objects\"]').hidden")
    page.switch_overlays_off()
    page.page.press("u")  # is an overlay, too
    for _ in range(3):
        page.page.press("+")
    for colour, is_on in ((MAGENTA, False), (MAGENTA, True)):
        for forward_m, left_m in corners(CAR):
            assert is_seen(street, window, forward_m, left_m, colour) == is_on, (forward_m, left_m, is_on)
        if not is_on:
            page.page.press("b")
    for thing, colour in ((PARKED, AMBER), (WHAT, YELLOW)):
        for forward_m, left_m in corners(thing):
            assert is_seen(street, window, forward_m, left_m, colour), (thing, forward_m, left_m)
    # The way of a second, from the middle; beyond its tip and beside it there is none.
    for way_m, is_there in ((0.3, True), (3, True), (5.9, True), (6.6, False), (-1, False)):
        assert is_seen(street, window, CAR.x_m, CAR.y_m - way_m, MAGENTA) == is_there, way_m
    street.expect(window, CAR.x_m + 0.5, CAR.y_m + 0.5, COLOURS[FREE])
    page.page.screenshot(folder / "objects.png")


def check_turned(street: Street) -> None:
    """They stand in the local frame, wherever the car is and however it is turned."""
    turned = ground(turns=0.25, x_m=2, y_m=1, corner=(-13, -14))
    for x_m, y_m in corners(CAR):
        assert is_seen(street, turned, y_m - 1, -(x_m - 2), MAGENTA), (x_m, y_m)


def check_list(street: Street) -> None:
    """The list says what the boxes do not: 6 m/s are 22 km/h, two deviations 5.04, rounded up; 50 frames are 5 s."""
    page = street.page
    street.show(ground())
    def rows() -> list[list[str]]:
        return page.page.value("[...document.querySelectorAll('#objects tbody tr')]"
                               ".map((row) => [...row.cells].map((cell) => cell.textContent))")

    # The list of the frame before, in which the car was elsewhere, has three rows, too.
    page.page.wait_for("document.querySelector('#objects tbody tr')?.cells[3].textContent === '10'")
    assert rows() == [["7", "moves", "22 ± 6", "10", "5.0"], ["9", "stopped", "–", "8", "10"],
                      ["300", "something", "–", "9", "10"]], rows()
    assert "1 of 3 move" in page.text("objects")
    many = [Thing(20 + i, YOUNG, x_m=-12 + i % 20, y_m=-12 + i // 20) for i in range(230)]
    street.things = [CAR, *many]
    crowded = ground()
    crowded.objects_left = (3, 40)
    street.show(crowded)
    page.page.wait_for("document.getElementById('objects').textContent.includes('1 of 231 move')")
    assert [row[0] for row in rows()][0] == "7" and len(rows()) == 6
    page.wait_for_fact("objects without room, hits left", "3, 40")


def words_on_picture(street: Street, window: Window) -> list[tuple[str, float, float, float, str]]:
    """Each text that the picture has, where it begins, its row, its width and its colour."""
    page = street.page.page
    page.run("const fill = CanvasRenderingContext2D.prototype.fillText; window.said ??= [];"
             "CanvasRenderingContext2D.prototype.fillText = function (words, x, y) {"
             "  if (this.canvas.id === 'grid') {"
             "    const width = this.measureText(words).width;"
             "    said.push([words, this.textAlign === 'center' ? x - width / 2 : x, y, width, this.fillStyle]); }"
             "  return fill.call(this, words, x, y); };")
    street.show(window)
    page.run("said.length = 0; iogPage.redraw()")
    page.wait_for("said.length > 0")
    return list(dict.fromkeys(map(tuple, page.value("said"))))


def check_words(street: Street) -> None:
    """A speed that may as well be none is not said; others can be read, whatever lies there and whoever looks."""
    page = street.page
    ahead = dataclasses.replace(CAR, y_m=-3)  # its name lies over the ring of 10 m, straight ahead
    doubted = Thing(8, MOVES, x_m=-6, y_m=5, turns=0.25, velocity=(0, -1.4), sigma=(4.2, 0.2))
    street.things = [ahead, doubted]
    page.page.press("g")
    said = words_on_picture(street, ground())
    names = [text for text in said if text[0].startswith(("7", "8"))]
    assert sorted(text[0] for text in names) == ["7: 22 km/h", "8"], said
    rings = [text for text in said if text[0].endswith(" m")]
    assert "10 m" in [text[0] for text in rings], said
    for name, left, row, width, colour in names:
        hidden = [ring for ring in rings[:-1] if ring[1] - 4 < left + width + 4 and ring[1] + ring[3] + 4 > left - 4
                  and abs(ring[2] - row) < 15]
        assert not hidden, (name, hidden)
        words = [int(colour[i:i + 2], 16) for i in (1, 3, 5)]
        for below in ((0, 0, 0), (255, 255, 255), *COLOURS.values()):
            assert contrast(words, CARD, below) > READABLE, (name, colour, below)
    page.page.wait_for("document.querySelectorAll('#objects tbody tr').length === 2")
    assert "moves – " in " ".join(page.text("objects").split()), page.text("objects")
    switches, keys = page.page.value("[[...document.querySelectorAll('[data-overlay] span')].map(({textContent}) => "
                                     "textContent), document.getElementById('keys').textContent]")
    assert "true movers" in switches and all(words in keys for words in switches), (switches, keys)


def check_not_hit(street: Street) -> None:
    """What was not hit in this frame has a broken outline."""
    window = ground()
    shares = []
    for is_hit in (True, False):
        street.things = [dataclasses.replace(CAR, is_hit=is_hit)]
        street.expect(window, CAR.x_m + 0.5, CAR.y_m + 0.5, COLOURS[FREE])  # the picture is of now
        shares.append(dashes(street, window, MAGENTA))
    assert shares[0] == 1 and 0.3 < shares[1] < 0.8, shares


def check_unknown(street: Street) -> None:
    """Nothing is drawn where a part of the list is lost, or where the frame has no place; an empty list is one."""
    page = street.page
    window = ground()
    corner = corners(CAR)[0]
    street.things = [CAR]
    assert is_seen(street, window, *corner, MAGENTA)
    nowhere = ground()
    nowhere.slices = 0
    assert not is_seen(street, nowhere, *corner, MAGENTA)
    page.page.wait_for("document.getElementById('objects').textContent.includes('not known')")
    street.things = []
    street.show(window)
    page.page.wait_for("document.getElementById('objects').textContent.includes('0 of 0 move')")
    street.things = [Thing(i + 1, YOUNG, x_m=-12 + i % 20, y_m=-12) for i in range(40)] + [
        dataclasses.replace(CAR, id=99)]
    assert is_seen(street, window, *corner, MAGENTA)
    lost = street.target.frames
    for _ in range(5):  # a frame is given up when others have begun
        window.objects = objects_of(street.things)
        for message in street.target.messages_of(street.grid, 100, window):
            if not (message[28] == grid_stream.OBJECTS and message[76 + 6] == 1):  # the second part of two
                street.target.send_bytes(message)
    page.page.wait_for(f"iogPage.grid.frame.status.frame.number >= {lost} && iogPage.grid.objects === null")
    page.page.wait_for("document.getElementById('objects').textContent.includes('not known')")
    assert page.page.value("document.querySelectorAll('#objects tbody tr').length") == 0


def check_still(street: Street) -> None:
    """A page that shows what it showed before draws nothing: paused, and while words alone come."""
    page = street.page
    street.things = [CAR]
    street.show(ground())
    page.wait_for_state("stale")
    page.page.run("window.drawn = 0; for (const name of ['fillRect', 'clearRect', 'stroke', 'drawImage', 'fillText']) {"
                  "  const draw = CanvasRenderingContext2D.prototype[name];"
                  "  CanvasRenderingContext2D.prototype[name] = function (...all) {"
                  "    window.drawn += 1; return draw.apply(this, all); }; }")
    settle = "new Promise((done) => setTimeout(done, {}))"
    page.page.run(f"return {settle.format(600)}")
    drawn, pictures = page.page.value("[drawn, iogPage.pictures]")
    said = page.page.value("iogPage.status.now_ms")
    page.page.run(f"return {settle.format(1500)}")
    assert page.page.value("iogPage.status.now_ms") > said, "no words came"
    assert page.page.value("[drawn, iogPage.pictures]") == [drawn, pictures], "a still page was drawn anew"
    street.show(ground())
    assert page.page.value("drawn") > drawn and page.page.value("iogPage.pictures") > pictures


def check(iog: str, folder: pathlib.Path, browser: Browser) -> None:
    port = free_port()
    with Viewer(iog, "--port", str(port)) as viewer:
        page = GridPage(browser.open(viewer.address))
        street = Street(page, port)
        street.target.frame_us = 100_000  # a turn; the longest frame of the car is 40 ms
        street.show(ground())
        assert page.page.value("document.getElementById('objects').hidden && "
                               "document.querySelector('[data-overlay=\"objects\"]').hidden")
        check_boxes(street, folder)
        check_turned(street)
        check_list(street)
        check_not_hit(street)
        check_unknown(street)
        check_still(street)
        check_words(street)
        assert page.page.value("iogPage.errors") == 0
        assert not page.page.complaints(), page.page.complaints()
        page.page.close()
