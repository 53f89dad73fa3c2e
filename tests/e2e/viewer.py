"""`iog view`, running, and what its page says."""

import os
import pathlib
import re
import signal
import socket
import subprocess
import typing

from browser import Page



def free_port() -> int:
    """A UDP port of this PC that nobody has right now."""
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as probe:
        probe.bind(("127.0.0.1", 0))
        return probe.getsockname()[1]


class Viewer:
    """The process. Use it in a `with` statement, or it stays."""

    def __init__(self, iog: str, *options: str, http_port: int = 0, errors: typing.TextIO | None = None):
        self._process = subprocess.Popen([iog, "view", "--http", str(http_port), *options],
                                         stdout=subprocess.PIPE, stderr=errors, text=True)
        line = self._process.stdout.readline()
        found = re.match(r"Look at (http://127\.0\.0\.1:(\d+)/)$", line)
        assert found, f"iog view says {line!r}"
        self.address = found.group(1)
        self.port = int(found.group(2))
        if "--foxglove" in options:
            line = self._process.stdout.readline()
            found = re.match(r"Foxglove: (ws://127\.0\.0\.1:(\d+))$", line)
            assert found, f"iog view says {line!r}"
            self.foxglove = found.group(1)
            self.foxglove_port = int(found.group(2))

    def __enter__(self) -> "Viewer":
        return self

    def __exit__(self, *_) -> None:
        self.stop()

    def stop(self) -> int:
        self.go_on()
        self._process.terminate()
        return self._process.wait(20)

    def halt(self) -> None:
        """It does nothing until it is told to go on."""
        self._process.send_signal(signal.SIGSTOP)

    def go_on(self) -> None:
        self._process.send_signal(signal.SIGCONT)

    @property
    def process(self) -> int:
        return self._process.pid

    @property
    def memory_bytes(self) -> int:
        return resident_bytes(self.process)

    @property
    def files(self) -> int:
        """That are open, connections among them."""
        return len(os.listdir(f"/proc/{self.process}/fd"))

    @property
    def processor_s(self) -> float:
        """Time that it has used so far."""
        fields = pathlib.Path(f"/proc/{self.process}/stat").read_text().rpartition(")")[2].split()
        return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")


def resident_bytes(process: int) -> int:
    status = pathlib.Path(f"/proc/{process}/status").read_text()
    return int(re.search(r"^VmRSS:\s+(\d+) kB", status, re.M).group(1)) * 1024


class GridPage:
    """The page, in the words of somebody who looks at it."""

    def __init__(self, page: Page, cell_m: float = 0.1, car_cell: tuple[int, int] = (512, 512)):
        self.page, self.cell_m, self.car_cell = page, cell_m, car_cell
        page.wait_for("window.iogPage && iogPage.status && iogPage.pictures > 0")

    def text(self, element: str) -> str:
        """What can be read there; nothing where it is hidden."""
        return self.page.value(f"document.getElementById('{element}').innerText")

    @property
    def banner(self) -> str:
        return " ".join(self.text("banner").split())

    @property
    def state(self) -> str:
        return self.text("state-word")

    def wait_for_state(self, words: str) -> None:
        self.page.wait_for(f"document.getElementById('state-word').textContent.includes('{words}')")

    def wait_for_banner(self, words: str) -> None:
        self.page.wait_for("((banner) => banner && !banner.hidden && "
                           f"banner.textContent.includes('{words}'))"
                           "(document.getElementById('banner'))")

    def wait_for_frame(self, number: int) -> None:
        """Until this frame of the target is the one that is shown."""
        self.page.wait_for("iogPage.grid.frame && "
                           f"iogPage.grid.frame.status.frame.number === {number}")

    def wait_for_fact(self, name: str, value: str) -> None:
        self.page.wait_for("[...document.querySelectorAll('.facts dt')]"
                           f".find((term) => term.textContent === '{name}')"
                           f"?.nextSibling.textContent === '{value}'")

    def hold_still(self) -> None:
        """From now on it takes nothing, shows what it has as if that were of now, and draws only when told to."""
        self.page.run("iogPage.socket.onmessage = null; iogPage.lastMessageMs = Infinity")

    def place_of(self, x: int, y: int) -> tuple[float, float]:
        """Where the middle of a cell is on the page: x of the car points up, y to the left."""
        left, top, width, height = self.page.value(
            "(({x, y, width, height}) => [x, y, width, height])"
            "(document.getElementById('grid').getBoundingClientRect())")
        scale, centre_x, centre_y = self.page.value(
            "[iogPage.view.pixelsPerMetre, iogPage.view.centre.x, iogPage.view.centre.y]")
        x_m, y_m = ((cell + 0.5 - of_car) * self.cell_m
                    for cell, of_car in zip((x, y), self.car_cell, strict=True))
        return (left + width / 2 - (y_m - centre_y) * scale,
                top + height / 2 - (x_m - centre_x) * scale)

    def hover(self, x: int, y: int) -> str:
        """What is said of that cell."""
        self.page.move_to(*self.place_of(x, y))
        self.page.wait_for(f"document.getElementById('hover').dataset.cell === '{x},{y}'")
        return " ".join(self.text("hover").split())

    def index_at(self, x: int, y: int) -> int:
        return int(re.search(r"index (-?\d+)", self.hover(x, y)).group(1))

    def colour_at(self, x: int, y: int) -> tuple[int, int, int]:
        return self.page.pixel(*self.place_of(x, y))

    def switch_overlays_off(self, but: tuple[str, ...] = ()) -> None:
        """Those that have a button now."""
        for name in self.page.value("[...document.querySelectorAll('[data-overlay]:not([hidden])')]"
                                    ".map(({dataset}) => dataset.overlay)"
                                    ".filter((name) => iogPage.view.overlays.has(name))"):
            if name not in but:
                self.page.click(f'[data-overlay="{name}"]')
