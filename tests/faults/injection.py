"""One injected fault: from the start of the machine to what became of it."""

import contextlib
import dataclasses
import pathlib
import random
import time
from collections.abc import Callable

import drive
import judge
import machine
from machine import Ended, Hung, Machine
from places import CHECKED, Places, draw

FRAMES = 6  # that are played from the start
HIT_FRAMES = (3, 4)  # a fault hits in one of these; by then there are objects
BOOT_PATIENCE_S, HANG_PATIENCE_S = 120, 180  # on a busy PC; a hang ends by the watchdog after 2.5 s of its own time
FOREIGN_HITS = 300  # of a breakpoint by other cores than the one that is meant
SAMPLES = 250
WFI = bytes.fromhex("03f020e3")
# How long the machine goes on after the drive, by its own time: a round of the check of memory, the time in which a
# core has to come when it is woken, or some frames.
ROUND_US, SILENT_CORE_US, REST_US = 5_000_000, 6_000_000, 300_000


@contextlib.contextmanager
def started(image: str, folder: pathlib.Path):
    """A machine that knows its peer."""
    with Machine(image, folder) as board:
        board.go_on(BOOT_PATIENCE_S)
        board.take_turns(machine.TURN_US)
        for _ in range(2):
            board.to_idle(BOOT_PATIENCE_S)
        yield board


def golden(image: str, frames: list[list[bytes]], folder: pathlib.Path) -> judge.Golden:
    """What comes without a fault."""
    with started(image, folder) as board:
        messages = [message for frame in frames for message in drive.play(board, frame, BOOT_PATIENCE_S)]
    found, refused = judge.frames_of(messages)
    assert len(found) == len(frames) and not refused, refused
    return judge.Golden(messages, found)


def sample(image: str, folder: pathlib.Path, frames: list[list[bytes]], number: int) -> list[tuple[int, int]]:
    """Interrupts a frame again and again, and asks every core that does not sleep where it is."""
    found: list[tuple[int, int]] = []
    while len(found) < SAMPLES:
        with started(image, folder) as board:
            for frame in frames[:number]:
                drive.play(board, frame, BOOT_PATIENCE_S)
            for each in frames[number]:
                board.send(each)
            while not any(drive.is_end_with_evidence(message) for message in board.messages):
                board.leave_break(board.idle)
                board.stub.go_on()
                time.sleep(random.uniform(0.0003, 0.003))
                board.stub.interrupt()
                board.wait_for_stop(BOOT_PATIENCE_S)
                for core in range(machine.CORES):
                    # A core sleeps behind its WFI, and nobody stops there while it does.
                    pc = board.pc(core)
                    if pc != board.idle and board.stub.read(pc - 4, 4) != WFI:
                        found.append((core, pc))
    return found


@dataclasses.dataclass
class Prepared:
    """What all runs of a campaign begin with."""

    image: str
    frames: list[list[bytes]]
    golden: judge.Golden
    moments: dict[int, list[tuple[int, int]]]  # by frame: where a core was, at random times
    places: Places

    @classmethod
    def make(cls, image: str, layout: str, iog: str, folder: pathlib.Path) -> "Prepared":
        frames = drive.frames(iog, folder)[:FRAMES]
        moments = {number: sample(image, folder, frames, number) for number in HIT_FRAMES}
        return cls(image, frames, golden(image, frames, folder), moments, Places(image, layout, folder))


@dataclasses.dataclass
class Run:
    """One of a drive in which something happens in one frame."""

    image: str
    frames: list[list[bytes]]
    golden: judge.Golden
    folder: pathlib.Path
    is_checked: bool = False  # whether the check of memory may find it later
    messages: list[bytes] = dataclasses.field(default_factory=list)

    def outcome(self, hit_frame: int, hit: Callable[[Machine], None]) -> tuple[str, str, str]:
        """What it is by judge's names, by what that is known, and what of a silent corruption was found later."""
        with started(self.image, self.folder) as board:
            try:
                for number, frame in enumerate(self.frames):
                    self._play(board, frame, hit if number == hit_frame else None)
                outcome, by = self.golden.difference(self.messages)
                self._rest(board)
                said = words(board)
                if outcome == judge.NO_EFFECT and said:
                    return judge.RECOVERED, said, ""
                return outcome, by, ""
            except Ended:
                if board.status() != 0:
                    return judge.EMULATOR, f"status {board.status()}", ""
                told = words(board) or "reset without a word"
                before = self.golden.begun(self.messages)
                return (judge.SILENT, before, told) if before else (judge.STOPPED, told, "")
            except Hung:
                return judge.HANG, words(board), ""

    def _play(self, board: Machine, frame: list[bytes], hit: Callable[[Machine], None] | None) -> None:
        for each in frame:
            board.send(each)
        if hit is not None:
            hit(board)
        for _ in range(drive.IDLES):
            if self._took_the_end(board):
                return
            board.to_idle(HANG_PATIENCE_S)
        self._took_the_end(board)

    def _took_the_end(self, board: Machine) -> bool:
        while board.messages:
            self.messages.append(board.messages.popleft())
            if drive.is_end_with_evidence(self.messages[-1]):
                return True
        return False

    def _rest(self, board: Machine) -> None:
        """The machine goes on by itself for a while."""
        if not self.messages:
            return
        span = ROUND_US if self.is_checked else SILENT_CORE_US if self._has_silent_core() else REST_US
        deadline = closed_us(self.messages[-1]) + span
        newest = 0

        def is_over() -> bool:
            nonlocal newest
            while board.messages:
                newest = closed_us(board.messages.popleft())
            return newest >= deadline

        board.run_free(is_over, HANG_PATIENCE_S)

    def _has_silent_core(self) -> bool:
        """Whether one had nothing to do in the last frame."""
        ends = [judge.items(message) for message in self.messages if drive.is_end_with_evidence(message)]
        return len(ends) >= 2 and any(a == b for a, b in zip(ends[-2], ends[-1]))


def closed_us(message: bytes) -> int:
    return int.from_bytes(message[40:48], "big")


def words(board: Machine) -> str:
    """What the console says after the start, beside times."""
    lines = board.console().partition(f"cores: {machine.CORES} at work\n")[2].splitlines()
    lines = [line for line in lines if line and not line.startswith("worst ")]
    return "; ".join(line.removeprefix("LAST WORD ") for line in lines)[:200]


def drawn(prepared: Prepared, seed: int, number: int, folder: pathlib.Path) -> dict:
    """Run `number` of a campaign: what was drawn, and what became of it."""
    begin_s = time.monotonic()
    plan, rng = draw(seed, number, prepared.moments)
    record = {"seed": seed, "number": number, **plan}
    pc, wanted = int(plan["moment_pc"], 16), plan["moment_core"]

    def hit(board: Machine) -> None:
        """At the moment that is drawn, or, if it does not come in this frame, at its end."""
        record["at"] = prepared.places.function_at(pc) if reach(board, pc, wanted, plan["moment_hit"]) \
            else "end of the frame"
        core = wanted if plan["core"] is None else plan["core"]
        record.update(prepared.places.hit(board.stub, plan["kind"], core, rng))

    run = Run(prepared.image, prepared.frames, prepared.golden, folder, plan["kind"] in CHECKED)
    record["outcome"], record["by"], record["found_later"] = run.outcome(plan["frame"], hit)
    record["seconds"] = round(time.monotonic() - begin_s, 2)
    return record


def reach(board: Machine, pc: int, wanted: int, hits: int) -> bool:
    """Whether a core comes so often to a place before the frame is over; if others do too often, they stand for it."""
    board.leave_break(board.idle)
    board.stub.break_at(pc)
    mine = foreign = idles = 0
    while mine < hits and foreign < FOREIGN_HITS:
        board.go_on(HANG_PATIENCE_S)
        stopped = [core for core in range(machine.CORES) if board.pc(core) == pc]
        mine += wanted in stopped
        foreign += bool(stopped) and wanted not in stopped
        idles += not stopped
        if idles > drive.IDLES or any(drive.is_end_with_evidence(message) for message in board.messages):
            break
        if mine < hits and foreign < FOREIGN_HITS:
            board.leave_break(pc)
            board.leave_break(board.idle)
    else:
        board.stub.forget_break(pc)
        return True
    board.stub.forget_break(pc)
    return False
