"""Recordings in `iog view`: their end, their silences, any place in them, and who else gets them."""

import dataclasses
import pathlib
import subprocess
import time

from selenium.webdriver.common.keys import Keys

import capture
from browser import Browser
from viewer import GridPage, Viewer, free_port

LAST_FRAME = 24  # of a second
SHIFT_US = 5_000_000


def check_recording(iog: str, folder: pathlib.Path, browser: Browser) -> None:
    """A recording begins when somebody looks, is then over, and every frame of it can be shown."""
    drive = folder / "drive.pcap"
    subprocess.run([iog, "simulate", "--seconds", "1", "--out", drive], check=True,
                   stdout=subprocess.DEVNULL)
    with Viewer(iog, "--pcap", str(drive)) as viewer:
        time.sleep(1.5)
        page = GridPage(browser.open(viewer.address))
        page.wait_for_state("end of recording")
        # Of its 25 frames, a slow browser misses some of the first.
        assert page.page.value("iogPage.history.frames[0].status.frame.number") < 20
        page.page.press(Keys.HOME)
        page.wait_for_state("paused")
        page.page.close()


def check_unfinished(iog: str, folder: pathlib.Path, browser: Browser) -> None:
    """A recorded stream has the target's times, and ends with its last whole frame."""
    drive, stream, cut = (folder / f"{name}.pcap" for name in ("drive", "stream", "cut"))
    for command in (["simulate", "--seconds", "1", "--out", drive],
                    ["fuse", "--pcap", drive, "--stream", stream]):
        subprocess.run([iog, *command], check=True, stdout=subprocess.DEVNULL)
    packets = capture.read(str(stream))
    capture.write(str(cut), packets[:-2])  # the last frame's end and its last tiles
    with Viewer(iog, "--pcap", str(cut)) as viewer:
        page = GridPage(browser.open(viewer.address))
        page.wait_for_state("end of recording, in mid-frame")
        assert page.banner == "", page.banner
        assert page.page.value("iogPage.status.frame.number") == LAST_FRAME - 1
        assert page.page.value("iogPage.status.frame.missing_tiles") == 0
        page.page.wait_for("document.querySelector('#chart-times h2').textContent === "
                           "'Time on the target'")
        assert not page.page.complaints(), page.page.complaints()
        page.page.close()
    with Viewer(iog, "--pcap", str(stream)) as viewer:
        page = GridPage(browser.open(viewer.address))
        page.wait_for_state("end of recording")
        assert page.state == "end of recording" and page.banner == "", (page.state, page.banner)
        assert page.page.value("iogPage.status.frame.number") == LAST_FRAME
        page.page.close()


def check_places(iog: str, folder: pathlib.Path, browser: Browser) -> None:
    """The bar leads to any place of the file, also after its end; an MCAP file has what the capture has."""
    stream, mcap = folder / "stream.pcap", folder / "stream.mcap"
    subprocess.run([iog, "record", "--stream", stream, "--out", mcap, "--topics", "/iogrid/messages"], check=True,
                   stdout=subprocess.DEVNULL)
    for file in (stream, mcap):
        with Viewer(iog, str(file), "--speed", "4") as viewer:
            page = GridPage(browser.open(viewer.address))
            page.wait_for_state("end of recording")
            assert page.text("place-words") == "0:00 of 0:00", page.text("place-words")
            page.page.run("iogPage.playback.jump(0)")
            page.wait_for_state("live")
            page.wait_for_state("end of recording")
            assert page.page.value("iogPage.status.frame.number") == LAST_FRAME
            page.page.run("window.framesBefore = iogPage.history.count; iogPage.playback.jump(900)")
            page.page.wait_for("iogPage.history.count > framesBefore")
            page.wait_for_state("end of recording")
            assert page.page.value("iogPage.errors") == 0
            assert not page.page.complaints(), page.page.complaints()
            page.page.close()


def check_silence(iog: str, folder: pathlib.Path, browser: Browser) -> None:
    """Where the recording has a gap, the picture is not of now; behind it nothing is known of before."""
    stream, gap = folder / "stream.pcap", folder / "gap.pcap"
    packets = capture.read(str(stream))
    middle = len(packets) // 2
    capture.write(str(gap), packets[:middle] + [dataclasses.replace(packet, time_us=packet.time_us + SHIFT_US)
                                                for packet in packets[middle:]])
    with Viewer(iog, str(gap), "--speed", "0.25") as viewer:
        page = GridPage(browser.open(viewer.address))
        page.wait_for_banner("Nothing has come for")
        page.wait_for_state("live")
        page.wait_for_state("end of recording")
        page.page.close()


def check_forward(iog: str, folder: pathlib.Path, browser: Browser) -> None:
    """Another receiver gets what is shown, of a recorded stream and of scans that are fused here."""
    for file in ("drive", "stream"):
        port = free_port()
        with subprocess.Popen([iog, "receive", "--port", str(port), "--frames", "20", "--notify", "--idle-timeout", "20"],
                              stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True) as receiver:
            assert receiver.stdout.readline() == "listening\n"
            with Viewer(iog, str(folder / f"{file}.pcap"), "--forward", str(port)) as viewer:
                page = browser.open(viewer.address)
                said, _ = receiver.communicate(timeout=60)
                page.close()
        assert receiver.returncode == 0, said


def check(iog: str, folder: pathlib.Path, browser: Browser) -> None:
    check_recording(iog, folder, browser)
    check_unfinished(iog, folder, browser)
    check_places(iog, folder, browser)
    check_silence(iog, folder, browser)
    check_forward(iog, folder, browser)
