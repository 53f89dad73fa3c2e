"""An emulated board for which no time passes while this PC lets whoever sends to it wait, so that nothing depends on how busy
this PC is.

QEMU's clock counts instructions, and jumps to the next tick where the board sleeps. QEMU's debugger stub stops the board
before it sleeps: it goes on when all of a frame has come, and stands still when it has answered.
"""

import os
import pathlib
import sys
import time

sys.dont_write_bytecode = True
sys.path.append(str(pathlib.Path(__file__).resolve().parents[1] / "tests/e2e"))
import debugger  # noqa: E402 ; it lies in the folder above

IDLE = ("iog::imx6::Board::idle()", "iog::zcu102::Board::idle()")
TICK_S = 0.001  # that a board sleeps at most: its clock is no faster than this PC's
FRAME_END = 2  # docs/spec.md 3.3
SHARE = 64  # datagrams that come at once: a dense unit spreads its turn, and the loop leaves what waits for 80 ms


class StandingBoard:
    """`debugger.socket` in the folder is QEMU's stub. `iog replay --step` writes to the pipe `sent` in it: a line
    "frame ..." when it has sent a frame, another line when all is sent."""

    def __init__(self, folder: str, image: str, maps_port: int | None):
        self._offer = debugger.Stub(pathlib.Path(folder))
        symbols = debugger.symbols_of(image)
        self._idle = next(symbols[name] for name in IDLE if name in symbols)
        self._maps_port = maps_port
        pipe = os.path.join(folder, "sent")
        os.mkfifo(pipe)
        self._sent = os.open(pipe, os.O_RDWR)  # both, or it would end with the first who writes
        self._frame: list = []  # what has come of it
        self._rest: list = []  # of a whole one, what the board does not have yet
        self._is_driving = True  # a drive is played in frames, or will be
        self._has_begun = self._is_whole = self._is_answer_due = self._is_standing = False

    def begin(self) -> None:
        """QEMU has started."""
        self._stub = debugger.Debugger(self._offer)
        self.inputs = (self._sent, self._stub)
        self._stub.begin()
        self._stub.break_at(self._idle)
        self._stub.go_on()

    def has_stopped(self) -> bool:
        """It is known without a look at the inputs."""
        return self._stub.has_answer()

    def admit(self, come: list, ready: list, has_later: bool) -> list:
        """Of what has come, each with its port at the end, what the board is to have now. Maps are of no frame."""
        if self._stub in ready or self.has_stopped():
            if self._stub.stopped_core() is None:
                sys.exit()  # QEMU has gone
            self._is_standing = True
        if self._sent in ready:
            lines = os.read(self._sent, 65536).splitlines()
            self._is_whole = True
            self._is_driving &= all(line.startswith(b"frame ") for line in lines)
        if self._is_driving:
            self._frame += [each for each in come if each[-1] != self._maps_port]
            come = [each for each in come if each[-1] == self._maps_port]
        is_next = self._is_whole and not has_later
        if is_next:
            self._rest, self._frame = self._rest + self._frame, []
            self._is_whole, self._is_answer_due, self._has_begun = False, True, True
        if is_next or self._is_standing:
            come, self._rest = self._rest[:SHARE] + come, self._rest[SHARE:]
        return come

    def note(self, message: bytes) -> None:
        """From the board. With the end of a frame of any sensor it has answered."""
        if len(message) > 58 and message[28] == FRAME_END and message[53:55] != b"\0\0":
            self._is_answer_due = False

    def go_on(self, has_more: bool) -> None:
        """Unless it has to stand still. has_more: it has not taken all that it may have."""
        is_waited_for = self._has_begun and self._is_driving and not self._is_answer_due and not self._rest
        if not self._is_standing or not has_more and (self._frame or is_waited_for):
            return
        if not has_more:
            time.sleep(TICK_S)
        self._is_standing = False
        self._stub.step(0)  # or it would stop there again
        self._stub.go_on()
