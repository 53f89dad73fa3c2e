"""A drive of some length in the browser: how many pictures a second, and how much memory."""

import pathlib
import time

from browser import Browser
from processes import descendants
from viewer import GridPage, Viewer, resident_bytes

SETTLED_S = 75  # when the page has its last minute together
GOES_ON, PATIENCE_S = 15, 60  # so many pictures and frames of the short run, however busy the machine is
MIN_RATE_HZ = 30
GROWTH = 1.15
MIB = 1 << 20


def check(iog: str, browser: Browser, seconds: int, is_long: bool) -> str:
    """Demands 30 pictures a second and steady memory of the long run; the short one, which shares the
    machine with other tests, is only asked to go on."""
    with Viewer(iog, "--simulate", "city") as viewer:
        page = GridPage(browser.open(viewer.address))
        page.wait_for_state("live")
        page.page.run("setInterval(() => iogPage.redraw(), 5)")  # a picture whenever there can be
        begin = time.monotonic()
        start = counts(page)
        pictures = frames = span = 0
        settled = None
        while span < seconds or (not is_long and min(pictures, frames) < GOES_ON and span < PATIENCE_S):
            time.sleep(1)
            span = time.monotonic() - begin
            if settled is None and span > SETTLED_S:
                settled = memory(browser, viewer)
            pictures, frames, draw_ms = (b - a for a, b in zip(start, counts(page)))
        kept = page.page.value("iogPage.history.frames.length")
        kept_bytes = page.page.value("iogPage.history.bytes")
        last = memory(browser, viewer)
        assert page.page.value("iogPage.errors") == 0
        assert not page.page.complaints(), page.page.complaints()
        page.page.close()
    words = (f"{span:.0f} s: {pictures / span:.1f} pictures a second, {draw_ms / pictures:.1f} ms each; "
             f"{frames / span:.1f} frames a second, {kept} kept in {kept_bytes / MIB:.0f} MiB; "
             + (f"after {SETTLED_S} s page {settled[0] / MIB:.0f} MiB, server {settled[1] / MIB:.0f} "
                "MiB; " if settled else "")
             + f"at the end page {last[0] / MIB:.0f} MiB, server {last[1] / MIB:.0f} MiB")
    if settled:
        assert kept <= 61 * 25 + 50, f"{kept} frames are kept"
        for before, now in zip(settled, last):
            assert now < before * GROWTH + 32 * MIB, words
    assert pictures > (MIN_RATE_HZ * span if is_long else GOES_ON - 1), words
    assert frames > (20 * span if is_long else GOES_ON - 1), words
    return words


def counts(page: GridPage) -> list[float]:
    """Pictures, frames, and ms of drawing since the page was opened."""
    return page.page.value("[iogPage.pictures, iogPage.history.count, iogPage.drawMs]")


def memory(browser: Browser, viewer: Viewer) -> tuple[int, int]:
    """Of the page's process and of the server's."""
    renderers = [resident_bytes(process) for process, _ in descendants(browser.service.process.pid)
                 if b"--type=renderer" in pathlib.Path(f"/proc/{process}/cmdline").read_bytes()]
    return max(renderers), viewer.memory_bytes
