"""A minute of a drive with faults, and what must be right at its end."""

import dataclasses
import pathlib
import random
import struct
import subprocess

import capture
import ethernet
import late_start
import map_chunks
import near_drive
import spells
import target_state
from grid_stream import Frame
from machine import PC
from receiver import Receiver
from watched_machine import WatchedMachine

PATIENCE_S = 300  # of this PC; all else waits for what the machine says or does
# Between two drives, by the clocks of poses and scanners: longer than the board's pauses and its reports, which are by its
# clock. So the window's time never runs ahead of the poses', and stays the same as theirs (docs/spec.md 5.3).
BETWEEN_S = 3
TURN_US = 300
FIRST_SPELL = 25
LINK_US, LOST_US = 700_000, 1_200_000  # till it is found to be up or down; till poses are lost
MOST_IDLES = 2000  # after what was sent for a frame; its time is over after 40
HELP, HELP_FROM_BYTES = "iog::work::Round::help(unsigned int, std::atomic<unsigned long>&)", 0x48
CALL, CALL_MASK = 0xE12FFF30, 0xFFFFFFF0  # blx, of whatever register (ARM DDI 0406C, A8.8.26)
HANG = "a core hangs"
CORE_FAULTS = ("a core faults", HANG)
MAP_SOURCE = ethernet.ip("10.0.2.111")
SP = 13
CHECK_US = 10_000_000  # a round of the check of memory (docs/safety.md)


class Minutes:
    """One board, minute by minute."""

    def __init__(self, iog: str, board: WatchedMachine, folder: pathlib.Path, places: dict[str, int], symbols: dict[str, int]):
        self._iog, self._board, self._folder, self._places, self._symbols = iog, board, folder, places, symbols
        town = near_drive.city_map(iog, folder)
        self._help = symbols["iog::work::Team<iog::imx6::Cores>::help_from(void*, unsigned int)"]
        self._calls_an_item = 0
        self._loop = symbols["Vectors"] + 0x14  # "b ." for the exception that does not exist
        self._maps = [map_chunks.contents_of(block) for block in (town, map_chunks.with_accuracy(town, 4_321))]
        self._receiver = Receiver()
        self._wire = spells.Wire(board.send, random.Random(0))
        self._cores = [1, 2, 3]
        self._rounds = (0, 0)
        self._newest_us = 0
        late_start.begin(board, places, symbols)
        board.take_turns(TURN_US)

    def play(self, number: int, seed: int, seconds: int) -> dict:
        """What of it stands in the table; what is wrong is an AssertionError."""
        rng = random.Random(f"{seed} {number}")
        self._wire.hostile = spells.HostileFrames(rng)
        its_drive = near_drive.simulated(self._iog, self._folder, rng, seconds, number * (seconds + BETWEEN_S))
        plan = spells.plan(rng, FIRST_SPELL, its_drive)
        core_faults = {rng.randrange(FIRST_SPELL, its_drive.quiet_from): kind for kind in CORE_FAULTS}
        before = dict(self._wire.counts)
        begin_us = self._pause(LOST_US)
        course = Course([], [], [], {})
        due: list[str] = []  # of core_faults
        for at, packets in enumerate(its_drive.frames):
            while plan and plan[0].end <= at:
                plan.pop(0).finish(self._wire)
            spell = plan[0] if plan and plan[0].begin <= at else None
            if spell and spell.begin == at:
                course.count(spell.kind)
                self._begin_spell(spell, rng)
            if at in core_faults:
                due.append(core_faults[at])
            # While the link is down nothing comes that a core could hang in, and waiting takes the board's time.
            is_cut = spell is not None and spell.kind == spells.CUT
            self._play_frame(packets, spell, [] if is_cut and HANG in due else due, course)
            if is_cut and at + 1 == spell.end:
                self._link(True)
        for kind in its_drive.pose_faults:
            course.count(kind)
        quiet = self._check(course, len(its_drive.frames) - its_drive.quiet_from)
        last = self._settled()
        self._check_counters(last)
        self._check_memory(last)
        self._check_time()
        return {"minute": number, "seed": seed, "drive_s": seconds, "frames": len(course.frames), "quiet_frames": quiet,
                "begin_us": begin_us, "end_us": last.closed_us, "last_frame": last.number, "cores": last.counters["cores at work"], "sent": self._wire.counts["frames received"] -
                before.get("frames received", 0), "deepest_stack_bytes": last.stack_bytes,
                "faults": course.faults}

    # Time passes without a drive.

    def _pause(self, span_us: int) -> int:
        """So long nothing is sent; the time at its end."""
        newest = self._taken([])
        until = newest + span_us

        def is_over() -> bool:
            nonlocal newest
            while self._board.messages:
                message = self._board.messages.popleft()
                newest = late_start.closed_us(message)
                self._receiver.take(message)
            return newest >= until

        self._board.rest(is_over, PATIENCE_S)
        self._newest_us = newest
        return newest

    def _taken(self, frames: list[Frame]) -> int:
        """What has come is added to frames; the time of a report that is waited for."""
        while not self._board.messages:
            self._board.to_idle(PATIENCE_S)
        newest = 0
        while self._board.messages:
            message = self._board.messages.popleft()
            newest = late_start.closed_us(message)
            if frame := self._receiver.take(message):
                frames.append(frame)
        return newest

    def _settled(self) -> Frame:
        """The first report after a pause: everything that was sent is counted."""
        self._pause(LOST_US)
        frames: list[Frame] = []
        while not frames:
            self._taken(frames)
        return frames[-1]

    # What happens.

    def _begin_spell(self, spell: spells.Spell, rng: random.Random) -> None:
        if spell.kind == spells.CUT:
            self._board.to_idle(PATIENCE_S)
            self._link(False)
        contents = self._maps[rng.randrange(2)]
        if spell.kind == "chunks of a map are lost":
            self._send_map([content for content in contents if rng.random() < 0.7])
        if spell.kind == "another map":
            self._send_map(contents)

    def _send_map(self, contents: list[bytes]) -> None:
        for content in contents:
            self._wire.chunk(MAP_SOURCE, map_chunks.PORT, map_chunks.message(content, self._wire.chunks))

    def _link(self, is_up: bool) -> None:
        self._board.stub.command(f"set_link wire {'on' if is_up else 'off'}")
        if is_up:
            self._receiver.was_cut()
            self._pause(LINK_US)

    def _play_frame(self, packets: list[capture.Packet], spell: spells.Spell | None, due: list[str],
                    course: "Course") -> None:
        taken = spell.play(packets, self._wire) if spell else spells.Spell("", 0, 0, random.Random(0)).play(packets, self._wire)
        course.sent.append(taken)
        course.times_us.append(self._newest_us)
        if due and self._cores and self._lose_core(due[0]):
            course.count(due.pop(0))
        if all(spells.is_pose(packet) for packet in taken):
            self._board.to_idle(PATIENCE_S)
            return
        unread = self._receiver.unread
        for _ in range(MOST_IDLES):
            while self._board.messages:
                frame = self._receiver.take(self._board.messages.popleft())
                if frame is not None and frame.has_evidence:
                    course.frames.append(frame)
                    course.times_us[-1] = frame.opened_us
                    self._newest_us = frame.closed_us
                    return
            if self._receiver.unread > unread:
                course.frames.append(None)
                return
            self._board.to_idle(PATIENCE_S)
        raise AssertionError(f"no frame of {len(taken)} packets came; {self._board.console()}")

    def _lose_core(self, kind: str) -> bool:
        """A helper comes to its work with a stack that is nowhere, or hangs in the midst of it; not if core 0 has done all
        of a frame before any other came to it."""
        stub, board = self._board.stub, self._board
        self._calls_an_item = self._calls_an_item or self._call_in_help()
        if kind == "a core faults":
            core = self._cores.pop()
            stub.choose(core)
            stub.flip_register(SP, 31)
            return True
        with board.stopped_at(self._help, board.frame_end):
            while not self._comes_to_an_item(core := board.go_on(PATIENCE_S)):
                if board.pc(0) == board.frame_end:
                    board.leave_break(board.frame_end)
                    return False
        stub.choose(core)
        stub.set_register(PC, self._loop)
        self._cores.remove(core)
        return True

    def _call_in_help(self) -> int:
        """Where a core in a round of work calls the item that it has taken."""
        begin = self._symbols[HELP]
        words = struct.unpack("<64I", self._board.stub.read(begin, 256))
        return begin + 4 * next(at for at, word in enumerate(words) if word & CALL_MASK == CALL)

    def _comes_to_an_item(self, core: int) -> bool:
        """Step by step, or it goes away again since others have taken all of them. Core 0 does not come by help()."""
        has_looked = False
        while core != 0:
            self._board.stub.step(core)
            pc = self._board.pc(core)
            if pc == self._calls_an_item:
                return True
            has_looked = has_looked or pc == self._symbols[HELP]
            if has_looked and self._help <= pc < self._help + HELP_FROM_BYTES:
                return False
        return False

    # What must be right.

    def _check(self, course: "Course", quiet: int) -> int:
        """Every grid is that of its packets; in the quiet end classes, sensors and sectors are right, too."""
        grids, classes = self._fused(course)
        frames = course.frames
        assert len(frames) == len(grids), f"{len(frames)} frames instead of {len(grids)}"
        for number, (frame, expected) in enumerate(zip(frames, grids)):
            if frame is not None:
                assert frame.record(number) == expected, f"{frame.record(number)} instead of {expected}"
                assert frame.crc == frame.crc_of_tiles and frame.classes.crc == frame.class_crc_of_tiles
        for number, frame in list(enumerate(frames))[-quiet + FRAMES_OF_A_START:]:
            assert frame is not None and frame.complete == 0b1111 and frame.tiles_lost == 0
            assert f"{frame.classes.crc:08x}" == classes[number].split()[9], f"classes of frame {number}"
        return quiet - FRAMES_OF_A_START

    def _fused(self, course: "Course") -> tuple[list[str], list[str]]:
        """What `iog fuse` says of these packets, as they came by the board's clock."""
        pcap, grids, classes = (self._folder / name for name in ("sent.pcap", "grids.txt", "classes.txt"))
        capture.write(pcap, [capture.Packet(time_us - course.times_us[0], spells.frame_of(packet))
                             for time_us, packets in zip(course.times_us, course.sent) for packet in packets])
        subprocess.run([self._iog, "fuse", "--pcap", pcap, "--hashes", grids, "--classes-hashes", classes], check=True,
                       stdout=subprocess.DEVNULL)
        return grids.read_text().splitlines()[1:], classes.read_text().splitlines()[1:]

    def _check_counters(self, last: Frame) -> None:
        counts = self._wire.counts
        replies = self._board.arp_replies
        expected = dict.fromkeys(target_state.PACKET_DROPS + target_state.NET_DROPS + MUST_BE_ZERO, 0) | counts
        expected |= {"frames received": counts["frames received"] + replies,
                     "port received": counts["frames received"] + replies, "ARP learned": replies,
                     "starts since power-up": 1, "cores at work": 1 + len(self._cores)}
        wrong = {name: (last.counters[name], count) for name, count in expected.items() if last.counters[name] != count}
        assert not wrong, f"counters (firmware, expected): {wrong}"
        assert sum(last.classes.pose_fates) == self._wire.poses, (last.classes.pose_fates, self._wire.poses)
        assert sum(last.classes.map.chunks) == self._wire.chunks, (last.classes.map, self._wire.chunks)
        assert self._board.strays == counts["pings answered"], "it sends what nobody has asked for"

    def _check_memory(self, last: Frame) -> None:
        rounds = int.from_bytes(self._board.stub.read(self._places["rounds of the check"], 4), "little")
        before, at_us = self._rounds
        least = (last.closed_us - at_us) // CHECK_US if at_us else 0
        assert rounds - before >= least, f"{rounds - before} rounds of the check of memory"
        self._rounds = (rounds, last.closed_us)

    def _check_time(self) -> None:
        """The window's is the poses', as it is on a PC that has seen this minute alone."""
        offset = int.from_bytes(self._board.stub.read(self._places["time beside the poses'"], 8), "little")
        assert offset == 0, f"the window's time is {offset} us beside the poses'"


FRAMES_OF_A_START = 25  # in which the poses of another run are not yet believed
MUST_BE_ZERO = ("ring full", "misuse", "port refused", "port without room", "fragments bad", "datagrams expired")


@dataclasses.dataclass
class Course:
    """What was sent frame by frame, and what came."""

    sent: list[list[capture.Packet]]
    times_us: list[int]
    frames: list[Frame | None]
    faults: dict[str, int]

    def count(self, kind: str) -> None:
        self.faults[kind] = self.faults.get(kind, 0) + 1
