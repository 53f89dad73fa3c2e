"""Can the page be read on every screen, from a phone's to a large one?"""

import itertools
import pathlib

from browser import Browser
from viewer import GridPage, Viewer

SIZES = [(1366, 768), (640, 400), (360, 640), (844, 390)]  # of every day: a usual one, and those with the least room
MORE_SIZES = [(1280, 800), (1024, 600), (800, 500), (390, 844), (420, 800), (768, 1024), (1920, 1080), (3840, 2160)]
MOST_COVERED = 0.35  # of the grid, by what lies on it
FOLDS = ("overlays", "legend", "charts")

# A banner, a state and a rate as long as any, which stay.
SAY = """(() => {
  iogPage.showState = iogPage.showWords = () => {};
  const show = (id, words) => { document.getElementById(id).textContent = words; };
  show('state-word', 'paused, live, poses contradicted');
  show('rate', '10.3 of 25.0 Hz');
  show('banner-title', 'The source of the poses started anew 1.2 s ago');
  show('banner-text', 'What was known has lost its place: the window began anew.');
  document.getElementById('banner').dataset.state = 'live';
  document.getElementById('banner').hidden = false;
})()"""

# Boxes of what lies on the grid and is seen, with those that they must stay within.
BOXES = """(() => {
  const box = (element) => {
    const {left, top, right, bottom} = element.getBoundingClientRect();
    return [left, top, right, bottom];
  };
  const ids = ['overlays', 'legend', 'hover', 'follow', 'measure', 'banner'];
  const [x, y] = box(document.getElementById('stage'));
  const bar = iogPage.view.scaleBar;
  const seen = ids.map((id) => document.getElementById(id)).filter(
      (e) => e && !e.hidden && getComputedStyle(e).visibility === 'visible');
  return {
    stage: box(document.getElementById('stage')),
    cards: {...Object.fromEntries(seen.map((element) => [element.id, box(element)])),
            'scale bar': [bar[0] + x, bar[1] + y, bar[2] + x, bar[3] + y]},
    controls: Object.fromEntries([...document.querySelectorAll('header > [id], footer > *')]
        .filter((e) => getComputedStyle(e).display !== 'none').map((e) => [e.id, box(e)])),
    grid: box(document.getElementById('grid')),
    charts: box(document.getElementById('charts')),
    car: ((scale, {x_min: rear, x_max: nose, y_min: right, y_max: left}) =>
        [x + iogPage.view.width / 2 - left * scale, y + iogPage.view.height / 2 - nose * scale,
         x + iogPage.view.width / 2 - right * scale, y + iogPage.view.height / 2 - rear * scale])(
        iogPage.view.pixelsPerMetre, iogPage.view.vehicle.footprint),
    page: [0, 0, innerWidth, innerHeight],
    scrolls: document.documentElement.scrollWidth > innerWidth ||
             document.documentElement.scrollHeight > innerHeight,
  };
})()"""


def overlap(a: list[float], b: list[float]) -> bool:
    return (min(a[2], b[2]) - max(a[0], b[0]) > 0.5 and min(a[3], b[3]) - max(a[1], b[1]) > 0.5)


def within(inner: list[float], outer: list[float]) -> bool:
    return (inner[0] >= outer[0] - 0.5 and inner[1] >= outer[1] - 0.5 and
            inner[2] <= outer[2] + 0.5 and inner[3] <= outer[3] + 0.5)


def faults_of(boxes: dict) -> list[str]:
    """What lies over something else, or is not on the screen."""
    cards = boxes["cards"]
    names = sorted(cards)
    faults = [f"{a} over {b}" for i, a in enumerate(names) for b in names[i + 1:]
              if overlap(cards[a], cards[b])]
    faults += [f"{name} is cut" for name in names if not within(cards[name], boxes["stage"])]
    controls = boxes["controls"]
    faults += [f"{name} is cut" for name, box in controls.items() if not within(box, boxes["page"])]
    faults += [f"{a} over {b}" for a, b in itertools.combinations(controls, 2) if overlap(controls[a], controls[b])]
    left, top, right, bottom = boxes["grid"]
    width, height = boxes["page"][2:]
    if width < 450 and height > width:  # an upright phone
        faults += [f"{name} over the grid" for name in ("legend", "hover")
                   if overlap(cards.get(name, [0] * 4), boxes["grid"])]
    if right - left < 250 or bottom - top < 150:
        faults.append(f"the grid has {right - left:.0f} x {bottom - top:.0f} pixels")
    return faults + (["the page has to be scrolled"] if boxes["scrolls"] else [])


def area(box: list[float]) -> float:
    return max(0, box[2] - box[0]) * max(0, box[3] - box[1])


def faults_of_begin(boxes: dict) -> list[str]:
    """Of a page that has just been opened, in which the car is in the middle of the grid."""
    seen = {name: box for name, box in boxes["cards"].items() if name not in ("follow", "hover")}
    faults = [f"{name} over the car" for name, box in seen.items() if overlap(box, boxes["car"])]
    grid = boxes["grid"]
    covered = sum(area([*map(max, box[:2], grid[:2]), *map(min, box[2:], grid[2:])])
                  for box in seen.values()) / area(grid)
    return faults + ([f"{covered:.0%} of the grid are covered"] if covered > MOST_COVERED else [])


def faults_of_folds(page: GridPage) -> list[str]:
    """Each panel can be folded away and back, by its button, and then what it covered is seen."""
    def area_of(panel: str) -> float:
        return area(page.page.value(BOXES)["charts"] if panel == "charts" else page.page.value(
            f"(({{left, top, right, bottom}}) => [left, top, right, bottom])"
            f"(document.getElementById('{panel}').getBoundingClientRect())"))

    faults = []
    for panel in FOLDS:
        areas = [area_of(panel)]
        for _ in range(2):
            page.page.click(f"#{panel}-fold")
            areas.append(area_of(panel))
        if areas[0] != areas[2] or min(areas) > 0.6 * max(areas):
            faults.append(f"{panel} cannot be folded: {areas}")
        expanded = page.page.value(f"document.getElementById('{panel}-fold').ariaExpanded")
        if expanded != str(areas[0] > areas[1]).lower():
            faults.append(f"{panel} says that it is expanded: {expanded}")
    return faults


def check(iog: str, folder: pathlib.Path, browser: Browser, sizes: list[tuple[int, int]]) -> None:
    """Nothing covers anything else, and no words the car: at the beginning, and with a cell under the mouse, the
    picture moved away from the car, and the legends of two overlays. Panels fold."""
    faults = []
    with Viewer(iog, "--simulate", "city") as viewer:
        window = browser.open(viewer.address)
        for width, height in sizes:
            viewer.go_on()
            window.load(viewer.address, width, height)
            page = GridPage(window)
            page.page.wait_for("iogPage.history.count > 2 && iogPage.view.scaleBar && iogPage.view.vehicle")
            # What does not change need not be drawn: in software that takes seconds each time.
            page.hold_still()
            viewer.halt()
            page.page.press("v")
            page.page.value(SAY)
            page.page.run("return new Promise((done) => setTimeout(done, 100))")  # the grid may be less high now
            page.page.wait_for("!iogPage.isDirty")
            faults += [f"{width}x{height}, index grid: {fault}" for fault in faults_of(page.page.value(BOXES))]
            page.page.press("v")
            page.page.screenshot(folder / f"begin_{width}x{height}.png")
            boxes = page.page.value(BOXES)
            faults += [f"{width}x{height}: {fault}" for fault in
                       faults_of(boxes) + faults_of_begin(boxes) + faults_of_folds(page)]
            page.page.press("?")
            if page.page.value("document.getElementById('help').scrollTop") > 0:
                faults.append(f"{width}x{height}: the keys do not begin at the first")
            page.page.press("?")
            page.page.run("delete iogPage.showState; delete iogPage.showWords")
            page.page.press("p")
            page.page.press(" ")
            page.page.run("iogPage.view.pan(20, 20); iogPage.redraw()")
            page.page.wait_for("iogPage.view.scaleBar && !document.getElementById('follow').hidden")
            page.page.run("iogPage.pointing.hover([iogPage.view.width / 2, iogPage.view.height / 2])")
            page.page.wait_for("document.getElementById('legend-more').childElementCount > 3")
            page.page.screenshot(folder / f"size_{width}x{height}.png")
            faults += [f"{width}x{height}: {fault}" for fault in faults_of(page.page.value(BOXES))]
        viewer.go_on()
        window.close()
    assert not faults, "\n".join(faults)
