"""Can the page be read on every screen, from a phone's to a large one?"""

import pathlib

from browser import Browser
from viewer import GridPage, Viewer

SIZES = [(1366, 768), (1280, 800), (1024, 600), (800, 500), (640, 400), (360, 640), (390, 844),
         (844, 390), (768, 1024), (1920, 1080), (3840, 2160)]

# Boxes of what lies on the grid and is seen, with those that they must stay within.
BOXES = """(() => {
  const box = (element) => {
    const {left, top, right, bottom} = element.getBoundingClientRect();
    return [left, top, right, bottom];
  };
  const ids = ['overlays', 'legend', 'hover', 'follow', 'banner'];
  const [x, y] = box(document.getElementById('stage'));
  const bar = iogPage.view.scaleBar;
  const seen = ids.map((id) => document.getElementById(id)).filter((e) => e && !e.hidden);
  return {
    stage: box(document.getElementById('stage')),
    cards: {...Object.fromEntries(seen.map((element) => [element.id, box(element)])),
            'scale bar': [bar[0] + x, bar[1] + y, bar[2] + x, bar[3] + y]},
    controls: Object.fromEntries([...document.querySelectorAll('header button, footer *')]
        .filter((e) => getComputedStyle(e).display !== 'none').map((e) => [e.id, box(e)])),
    charts: box(document.getElementById('charts')),
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
    faults += [f"button {name} is cut" for name, box in boxes["controls"].items()
               if not within(box, boxes["page"])]
    left, top, right, bottom = boxes["stage"]
    if right - left < 250 or bottom - top < 150:
        faults.append(f"the grid has {right - left:.0f} x {bottom - top:.0f} pixels")
    return faults + (["the page has to be scrolled"] if boxes["scrolls"] else [])


def check(iog: str, folder: pathlib.Path, browser: Browser) -> None:
    """Nothing covers anything else: with a cell under the mouse, the picture moved away from the car,
    and the legends of two overlays."""
    faults = []
    with Viewer(iog, "--simulate", "city") as viewer:
        for width, height in SIZES:
            page = GridPage(browser.open(viewer.address, width, height))
            page.page.wait_for("iogPage.history.count > 2")
            page.page.press("p")
            page.page.press(" ")
            page.page.value("iogPage.view.pan(20, 20); iogPage.redraw(); 0")
            page.page.wait_for("iogPage.view.scaleBar && !document.getElementById('follow').hidden")
            page.page.value("iogPage.pointer = [iogPage.view.width / 2, iogPage.view.height / 2]; "
                            "iogPage.showHover(); 0")
            page.page.wait_for("document.getElementById('legend-more').childElementCount > 3")
            page.page.screenshot(folder / f"size_{width}x{height}.png")
            faults += [f"{width}x{height}: {fault}" for fault in faults_of(page.page.value(BOXES))]
            page.page.close()
    assert not faults, "\n".join(faults)
