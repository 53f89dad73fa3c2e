"""What the page says of a place: the words of a cell for mouse and touch, and the distance between two cells."""

from selenium.webdriver.common.keys import Keys

from browser import Browser
from made_classes import JUMP, OCCUPIED, class_byte
from made_objects import Thing
from object_parts import MOVES
from view_classes import Street, picture_of_window
from viewer import GridPage, Viewer, free_port

CAR = Thing(7, MOVES, x_m=9, y_m=0, turns=0.25, velocity=(0, -6), sigma=(0.7, 0.2))


def wait_for_words(page: GridPage, *words: str) -> None:
    for each in words:
        page.page.wait_for(f"document.getElementById('hover').innerText.replace(/\\s+/g, ' ').includes({each!r})")


def click(page: GridPage, x: int, y: int) -> None:
    """On the middle of a cell. Cells count from the corner of a car's or window's square of 102.4 m."""
    mouse = page.page.hands()
    mouse.w3c_actions.pointer_action.move_to_location(*page.place_of(x, y)).pointer_down().pointer_up()
    mouse.perform()


def check_meanings(street: Street) -> None:
    """Yellow and brown have words: the class, its confidence, what it means, the place, and whose box it is in."""
    page = street.page
    window = picture_of_window()
    window.fill(range(-100, -80), range(-10, 10), class_byte(OCCUPIED, 2))
    street.things = [CAR]
    street.show(window)
    for cell, words in (((422, 512), ("occupied, unclassified", "(2 of 7)", "whether it moves",
                                      "local frame -8.95, 0.05 m")),
                        ((512, 602), ("standing", "(7 of 7)", "Something has stayed here", "local frame 0.05, 9.05 m")),
                        ((556, 556), ("moving", "(0 of 7)", "has moved")),
                        ((572, 405), ("unknown", "No sensor has measured"))):
        said = page.hover(*cell)
        assert all(each in said for each in words), (said, words)
        assert "object" not in said, said
    said = page.hover(602, 512)
    assert "object 7: moves, 22 ± 6 km/h" in said, said


def check_touch(street: Street) -> None:
    """The words of a tap stay, with a mark at the place, until the finger draws the picture away or the words are
    tapped."""
    page = street.page
    street.show(picture_of_window())
    place = page.place_of(512, 602)
    for end in ("words", "picture"):
        page.page.touch("touchStart", place)
        page.page.touch("touchEnd")
        wait_for_words(page, "standing")
        assert page.page.value("iogPage.view.mark !== null")
        if end == "words":
            left, top = page.page.value("(({left, top}) => [left, top])"
                                        "(document.getElementById('hover').getBoundingClientRect())")
            page.page.touch("touchStart", (left + 20, top + 20))
        else:
            page.page.touch("touchStart", place)
            page.page.touch("touchMove", (place[0] + 40, place[1]))
        page.page.touch("touchEnd")
        page.page.wait_for("document.getElementById('hover').hidden && iogPage.view.mark === null")
    page.page.press("f")


def check_legend(street: Street) -> None:
    """Tab goes from class to class of the legend, and each says what it means."""
    page = street.page
    street.show(picture_of_window())
    page.page.wait_for("[...document.querySelectorAll('#legend-classes .key:not([hidden])')].some((key) => "
                       "key.textContent === 'standing')")
    said = {}
    page.page.run("document.getElementById('legend-fold').focus()")
    for _ in range(page.page.value("document.querySelectorAll('#legend-classes .key:not([hidden])').length")):
        page.page.press(Keys.TAB)
        said[page.page.value("document.activeElement.textContent")] = page.text("legend-meaning")
    assert "Something has stayed here" in said["standing"], said
    assert set(said) == {"free", "moving", "standing", "occupied, unclassified", "unknown"}, said
    assert len(set(said.values())) == len(said), said
    page.page.run("document.activeElement.blur()")
    assert page.text("legend-meaning") == ""


def check_measure(street: Street) -> None:
    """Two clicks are a distance. 30 and 40 cells apart are 5 m, whatever the scale; the ends stay on the ground while
    the car drives; Esc ends it, a jump of the pose ends it, and a drag is no click."""
    page = street.page
    window = picture_of_window()
    street.show(window)
    page.page.click("#measure")
    wait_for_words(page, "Click or tap the first place")
    click(page, 532, 522)
    wait_for_words(page, "Click or tap the second place", "2.05 m ahead, 1.05 m left")
    assert page.page.value("iogPage.view.isFollowing"), "a click has moved the picture"
    click(page, 562, 562)
    ends = ("5.00 m", "2.05 m ahead, 1.05 m left", "5.05 m ahead, 5.05 m left", "stay on the ground")
    wait_for_words(page, *ends)
    page.page.press("+")
    wait_for_words(page, *ends)
    # 3 m further and turned left by a quarter: x points to the right now, y ahead.
    street.show(picture_of_window(x_m=3, turns=0.25))
    wait_for_words(page, "5.00 m", "1.05 m ahead, 0.95 m left", "5.05 m ahead, 2.05 m right")
    page.page.press("v")
    wait_for_words(page, "5.00 m", "1.05 m ahead, 0.95 m left")
    page.page.press("v")
    jumped = picture_of_window(x_m=3, turns=0.25)
    jumped.history[JUMP] = (5, 1, jumped.stamp_us)
    street.show(jumped)
    wait_for_words(page, "The ground that was measured has lost its place")
    page.page.press(Keys.ESCAPE)
    page.page.wait_for("document.getElementById('measure').ariaPressed === 'false' && !iogPage.view.measured.isOn")
    page.page.press("f")
    page.page.press("-")


def check_measure_of_frame(street: Street) -> None:
    """A picture without poses has no ground: the ends go with the car, and the page says so. Where there is no
    cell, there is no end."""
    page = street.page
    for _ in range(2):
        street.target.send(street.grid)
        page.wait_for_frame(street.target.frames - 1)
    page.page.press("m")
    click(page, 522, 512)
    click(page, 518, 515)
    wait_for_words(page, "0.50 m", "1.05 m ahead, 0.05 m left", "0.65 m ahead, 0.35 m left", "go with the car")
    page.page.run("iogPage.view.pixelsPerMetre = 3; iogPage.redraw()")
    mouse = page.page.hands()
    left, top = page.place_of(512, 512)
    mouse.w3c_actions.pointer_action.move_to_location(left - 3 * 55, top).pointer_down().pointer_up()
    mouse.perform()
    wait_for_words(page, "outside of the grid")
    for _ in range(2):  # M ends it, too
        page.page.press("m")
    wait_for_words(page, "Click or tap the first place")
    page.page.press(Keys.ESCAPE)


def check(iog: str, browser: Browser) -> None:
    port = free_port()
    with Viewer(iog, "--port", str(port)) as viewer:
        page = GridPage(browser.open(viewer.address))
        street = Street(page, port)
        street.show(picture_of_window())
        for _ in range(4):  # so near that a cell is some pixels wide
            page.page.press("+")
        check_meanings(street)
        check_touch(street)
        check_legend(street)
        check_measure(street)
        check_measure_of_frame(street)
        assert page.page.value("iogPage.errors") == 0
        assert not page.page.complaints(), page.page.complaints()
        page.page.close()
