"""A drive of some length in the browser: how many pictures a second, and how much memory."""

import pathlib
import time

from browser import Browser
from processes import descendants
from viewer import GridPage, Viewer, resident_bytes

SETTLED_S = 75  # when the page has its last minute together
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
        start = page.page.value("[iogPage.pictures, iogPage.history.count, iogPage.drawMs]")
        settled = None
        while time.monotonic() - begin < seconds:
            time.sleep(1)
            if settled is None and time.monotonic() - begin > SETTLED_S:
                settled = memory(browser, viewer)
        span = time.monotonic() - begin
        end = page.page.value("[iogPage.pictures, iogPage.history.count, iogPage.drawMs]")
        pictures, frames, draw_ms = (b - a for a, b in zip(start, end))
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
    assert pictures / span > (MIN_RATE_HZ if is_long else 3), words
    assert frames / span > (20 if is_long else 3), words
    return words


def memory(browser: Browser, viewer: Viewer) -> tuple[int, int]:
    """Of the page's process and of the server's."""
    renderers = [resident_bytes(process) for process, _ in descendants(browser.service.process.pid)
                 if b"--type=renderer" in pathlib.Path(f"/proc/{process}/cmdline").read_bytes()]
    return max(renderers), viewer.memory_bytes
