"""A board that is stopped by its loop's word that nothing is left to do.

At each stop at a breakpoint QEMU forgets all that it has translated (gdb_vm_state_change() of its gdbstub), which was most of
its work. At a watchpoint it does not. So a byte of the loop is watched instead of the begin of idle(): the first one of its
Backlog, which it sets when it has woken and clears when it has found nothing more.
"""

import contextlib
import pathlib
import struct
from collections.abc import Iterator

import debugger
from machine import PC, Machine

BACKLOG = 3  # an argument of the loop's pass(), by its register (AAPCS32, 6.4)
STRB, STRB_MASK = 0x0540_0000, 0x0F70_0000  # with any condition, without writeback (ARM DDI 0406C, A8.8.207)


class WatchedMachine(Machine):
    def __init__(self, image: str, folder: pathlib.Path):
        super().__init__(image, folder)
        symbols = debugger.symbols_of(image)
        self.frame_end = symbols[
            "iog::app::Frame::describe(unsigned long long, iog::stream::Header&, iog::stream::FrameEnd&)"]
        self._pass, = (address for name, address in symbols.items() if name.startswith("bool iog::app::pass<"))
        self._busy = 0  # address of the byte
        self._store: tuple[int, int] | None = None  # that it is stopped before: where, and of what
        self._sources: dict[int, int] = {}  # registers of such stores by their addresses

    def watch_idle(self, patience_s: float) -> None:
        """From where it is stopped before it sleeps. Until then it is any machine."""
        self.leave_break(self.idle)
        self.stub.forget_break(self.idle)
        self.stub.break_at(self._pass)
        self.go_on(patience_s)
        self.stub.choose(0)
        self._busy = self.stub.register(BACKLOG)
        self.leave_break(self._pass)
        self.stub.forget_break(self._pass)
        self.stub.watch(self._busy)
        self.to_idle(patience_s)

    def to_idle(self, patience_s: float) -> None:
        if not self._busy:
            super().to_idle(patience_s)
            return
        while True:
            self.go_on(patience_s)
            if self._store and self._store[1] == 0:
                return

    def go_on(self, patience_s: float) -> int:
        if self._store:  # QEMU has stopped before it, and would again
            pc, value = self._store
            self.stub.choose(0)
            self.stub.write(self._busy, bytes([value]))
            self.stub.set_register(PC, pc + 4)
        core = super().go_on(patience_s)
        self._store = self._read_store() if self.stub.is_at_watch else None
        return core

    def rest(self, until, patience_s: float) -> None:
        """It goes on by itself, and is looked at where a frame ends, until until() says so of the messages that have come."""
        with self.stopped_at(self.frame_end):
            while not until():
                self.go_on(patience_s)
                self.leave_break(self.frame_end)
        self.to_idle(patience_s)

    @contextlib.contextmanager
    def stopped_at(self, *addresses: int) -> Iterator[None]:
        """Where any core comes there, and not before it sleeps: of two cores that stop at once QEMU tells of one."""
        self.stub.forget_watch(self._busy)
        for address in addresses:
            self.stub.break_at(address)
        yield
        for address in addresses:
            self.stub.forget_break(address)
        self.stub.watch(self._busy)

    def _read_store(self) -> tuple[int, int]:
        """Of the core that was stopped before one."""
        pc = self.stub.register(PC)
        if pc not in self._sources:
            store, = struct.unpack("<I", self.stub.read(pc, 4))
            assert store & STRB_MASK == STRB, f"{store:08x} is no store of a byte"
            self._sources[pc] = store >> 12 & 15
        return pc, self.stub.register(self._sources[pc]) & 0xFF
