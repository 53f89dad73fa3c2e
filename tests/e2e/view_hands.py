"""What keyboard, mouse and touch do to the page of `iog view`, and what they leave to the browser."""

import time

from selenium.webdriver.common.actions.mouse_button import MouseButton
from selenium.webdriver.common.keys import Keys

import made_stream
from browser import Browser
from viewer import GridPage, Viewer, free_port

# An obstacle on free ground, 3 m across, ahead of the car and to its left.
GROUND = (range(515, 600), range(515, 590))
OBSTACLE = (range(530, 560), range(530, 560))
FREE, OCCUPIED = -56, 10
# tools/view/page/palette.js, dark: what the legend says these indexes look like.
COLOUR_OF_FREE, COLOUR_OF_OCCUPIED = (188, 212, 228), (214, 26, 8)


def scene() -> made_stream.Grid:
    grid = made_stream.Grid()
    grid.fill(*GROUND, FREE)
    grid.fill(*OBSTACLE, OCCUPIED)
    return grid


def check_edges(page: GridPage, target: made_stream.Target, where: str,
                left: float, top: float, side: float) -> None:
    """The obstacle is drawn from there, so many pixels wide and high, with free ground around it."""
    middle = (left + side / 2, top + side / 2)
    for column, row, expected in (
            (*middle, COLOUR_OF_OCCUPIED),
            (left + 2, middle[1], COLOUR_OF_OCCUPIED), (left - 3, middle[1], COLOUR_OF_FREE),
            (left + side - 3, middle[1], COLOUR_OF_OCCUPIED),
            (left + side + 2, middle[1], COLOUR_OF_FREE),
            (middle[0], top + 2, COLOUR_OF_OCCUPIED), (middle[0], top - 3, COLOUR_OF_FREE),
            (middle[0], top + side - 3, COLOUR_OF_OCCUPIED),
            (middle[0], top + side + 2, COLOUR_OF_FREE)):
        for _ in range(5):  # on a busy machine the picture may be an old one, which is grey
            target.send(scene())
            page.wait_for_frame(target.frames - 1)
            colour = page.page.pixel(column, row)
            if colour == expected:
                break
        assert colour == expected, (where, column, row, colour, expected)


def edges_of(page: GridPage) -> tuple[float, float, float]:
    """Left, top and side of the obstacle: the corner of its cell of largest x and y, where the page
    says that it draws it."""
    cell = page.page.value("iogPage.view.pixelsPerMetre * iogPage.view.cellM")
    column, row = page.place_of(OBSTACLE[0].stop - 1, OBSTACLE[1].stop - 1)
    return column - cell / 2, row - cell / 2, len(OBSTACLE[0]) * cell


def check_touch(page: GridPage, target: made_stream.Target) -> None:
    """One finger takes the obstacle along; two draw it out, and what is between them stays there."""
    for _ in range(4):  # so near that a cell is more than 2.4 pixels wide
        page.page.press("+")
    left, top, side = edges_of(page)
    check_edges(page, target, "before", left, top, side)
    start = (left + side / 2, top + side / 2)
    page.page.touch("touchStart", start)
    for step in range(1, 9):
        page.page.touch("touchMove", (start[0] + 20 * step, start[1] - 5 * step))
    page.page.touch("touchEnd")
    left, top = left + 160, top - 40
    check_edges(page, target, "one finger", left, top, side)

    # The left lower quarter of the obstacle is between the fingers: not its middle.
    column, row = left + side / 4, top + 3 * side / 4
    def fingers(distance: float, down: float = 0) -> tuple:
        return (column - distance, row + down), (column + distance, row + down)

    page.page.touch("touchStart", *fingers(60))
    for distance in range(65, 121, 5):
        page.page.touch("touchMove", *fingers(distance))
    check_edges(page, target, "two fingers", column - side / 2, row - 3 * side / 2, 2 * side)
    for distance in range(115, 59, -5):  # back, and 24 pixels down
        page.page.touch("touchMove", *fingers(distance, down=24 * (120 - distance) / 60))
    page.page.touch("touchEnd")
    check_edges(page, target, "back", left, top + 24, side)

    # A finger that is taken away does not make the picture leap.
    page.page.touch("touchStart", *fingers(60))
    page.page.touch("touchEnd", fingers(60)[0])
    page.page.touch("touchEnd")
    check_edges(page, target, "up", left, top + 24, side)
    page.page.click("#follow")
    page.page.wait_for("iogPage.view.isFollowing && document.getElementById('follow').hidden")


def check_mouse(page: GridPage) -> None:
    """Only the main button moves the grid: the other one opens the browser's menu."""
    def drag(button: int) -> None:
        hands = page.page.hands()
        mouse = hands.w3c_actions.pointer_action
        mouse.move_to_location(400, 500).pointer_down(button)
        mouse.move_to_location(430, 500).pointer_up(button)
        hands.perform()

    drag(MouseButton.RIGHT)
    assert page.page.value("iogPage.view.isFollowing"), "the right button has moved the grid"
    drag(MouseButton.LEFT)
    assert not page.page.value("iogPage.view.isFollowing")
    page.page.press("f")


def check_keys(page: GridPage) -> None:
    """Space pauses, unless a button was chosen by Tab; what is the browser's is left to it."""
    page.page.run("window.left = []; addEventListener('keydown', (event) => "
                  "left.push(event.key, event.defaultPrevented))")
    page.page.hands().key_down(Keys.CONTROL).send_keys("rd").key_up(Keys.CONTROL).perform()
    page.page.run("document.getElementById('help-open').focus()")
    page.page.press(Keys.TAB)  # from the last of the header to the panel of the overlays
    page.page.press(Keys.TAB)  # and to the first of them
    assert page.page.value("left") == ["Control", False, "r", False, "d", False,
                                       "Tab", False, "Tab", False]
    assert page.page.value("document.documentElement.dataset.theme") == "dark"
    assert not page.page.value("iogPage.status.recording.open")
    assert page.page.value("document.activeElement.dataset.overlay") == "mounts"
    assert page.page.value("getComputedStyle(document.activeElement).outlineStyle") == "solid"
    page.page.run("document.getElementById('pause').focus()")
    for word in ("paused", ""):
        page.page.press(" ")  # presses the button, once
        page.page.wait_for(f"document.title.startsWith('paused') === {str(bool(word)).lower()}")
        assert page.page.value("document.activeElement.id") == "pause", "the focus is lost"
    page.page.press("?")
    page.page.press("p")
    page.page.press(" ")  # closes the dialog, by its button
    page.page.wait_for("!document.getElementById('help').open")
    assert "paused" not in page.state, "a key has gone through the dialog"
    assert not page.page.value("iogPage.view.overlays.has('points')")
    page.page.click("#theme")
    page.page.click("#theme")
    page.page.press(" ")  # a button that was clicked does not keep the space key
    page.wait_for_state("paused")
    page.page.press(" ")
    nameless = page.page.value("[...document.querySelectorAll('button, input')].filter((one) => "
                               "!(one.innerText || one.ariaLabel || one.title).trim()).length")
    assert nameless == 0


def check_title(page: GridPage, target: made_stream.Target) -> None:
    """The tab says what the page says."""
    for word, frames in (("stale", 0), ("live", 3)):
        for _ in range(frames):
            target.send(scene())
            time.sleep(0.04)
        page.page.wait_for(f"document.title === '{word} – iogrid'")


def check(iog: str, browser: Browser) -> None:
    port = free_port()
    with Viewer(iog, "--port", str(port)) as viewer:
        page = GridPage(browser.open(viewer.address))
        target = made_stream.Target(port)
        target.send(scene())
        page.wait_for_frame(0)
        page.switch_overlays_off()
        check_touch(page, target)
        check_mouse(page)
        check_keys(page)
        check_title(page, target)
        assert page.page.value("iogPage.errors") == 0
        assert not page.page.complaints(), page.page.complaints()
        page.page.close()
