"""What a fault did, by what a receiver sees: the messages, beside those of the same drive without it."""

import dataclasses

import grid_stream
import protected_message
import target_state

NO_EFFECT, RECOVERED, STOPPED, SILENT, HANG, EMULATOR = \
    "no effect", "detected and recovered", "detected and stopped", "silent corruption", "hang", "emulator failed"
# What a frame may say of itself that excuses a grid, classes or objects that are others. A core less is no excuse.
EXCUSES = ("complete", "partial", "by time", "tiles lost", "packets", "placed", "fates", "causes", "drops", "damaged")
TIME_US = 100_000  # a frame that says of itself that it was closed so much earlier or later


def plain(message: bytes) -> bytes:
    """What of a message does not depend on when it was sent: all but the frame's end, and that is taken apart."""
    return message[28:32] + message[48:68] + message[72:] if message[28] != grid_stream.FRAME_END else b"end"


def protection_is_right(message: bytes) -> bool:
    return int.from_bytes(message[24:28], "big") == \
        protected_message.crc32_p4(protected_message.protected_part(message))


@dataclasses.dataclass(frozen=True)
class Seen:
    """A frame with evidence: what it claims of the world, what it says that it lacks, what a receiver finds."""

    parts: dict[str, object]
    lacks: dict[str, object]
    closed_us: int
    contradiction: str  # empty: it passes all checks


def seen(frame: grid_stream.Frame) -> Seen:
    classes = frame.classes
    window = dataclasses.replace(classes.window, begin_us=0, end_us=0)
    lacks = {"complete": frame.complete, "partial": frame.partial, "by time": frame.is_closed_by_time,
             "tiles lost": (frame.tiles_lost, classes.tiles_lost), "packets": frame.packets_fused,
             "placed": (classes.packets_placed, classes.packets_not_placed, classes.slices_over_budget),
             "groups": classes.groups, "fates": classes.pose_fates, "causes": [cause[:2] for cause in classes.causes],
             "drops": [frame.counters[name] for name in target_state.PACKET_DROPS],
             "cores": frame.counters["cores at work"], "items": frame.counters["items for lost cores"],
             "damaged": [frame.counters[name] for name in target_state.DAMAGED],
             "restarts": frame.counters["port restarts"], "unwatched": frame.unwatched}
    contradiction = ""
    if frame.crc != frame.crc_of_tiles:
        contradiction = "CRC of the grid"
    elif classes.crc != frame.class_crc_of_tiles:
        contradiction = "CRC of the classes"
    return Seen({"grid": (frame.crc_of_tiles, frame.tiles_received), "classes": (frame.class_crc_of_tiles, window),
                 "objects": frame.objects, "report": (frame.points_used, frame.flags, frame.sensors)},
                lacks, frame.closed_us, contradiction)


def frames_of(messages: list[bytes]) -> tuple[list[Seen], str]:
    """Frames with evidence, and what a receiver found wrong, after which it takes no more."""
    assembler = grid_stream.Assembler()
    frames = []
    try:
        for message in messages:
            frame = assembler.take(message)
            if frame is not None and frame.has_evidence:
                frames.append(seen(frame))
                if frames[-1].contradiction:
                    return frames[:-1], frames[-1].contradiction
    except Exception as error:  # whatever a reader of hostile bytes raises: it refuses them
        return frames, f"{type(error).__name__}: {error}"
    return frames, ""


@dataclasses.dataclass(frozen=True)
class Golden:
    messages: list[bytes]
    frames: list[Seen]

    def begun(self, messages: list[bytes]) -> str:
        """What is silently wrong of a run that was stopped in the middle of a frame; empty: nothing."""
        ends = [at for at, message in enumerate(messages) if message[28] == grid_stream.FRAME_END]
        outcome, by = self.difference(messages[:ends[-1] + 1] if ends else [])
        return by if outcome == SILENT else ""

    def difference(self, messages: list[bytes]) -> tuple[str, str]:
        """An outcome of a run that goes on, and what it is by."""
        is_same = [plain(a) for a in messages] == [plain(b) for b in self.messages]
        if is_same and all(a == b or protection_is_right(a) for a, b in zip(messages, self.messages)):
            ends = [message for message in messages if message[28] == grid_stream.FRAME_END]
            if [end_of(end) for end in ends] == [end_of(end) for end in self.messages
                                                 if end[28] == grid_stream.FRAME_END]:
                return NO_EFFECT, ""
        frames, refused = frames_of(messages)
        told, excused = "", False
        for number, (mine, right) in enumerate(zip(frames, self.frames)):
            lacking = [name for name in right.lacks if mine.lacks[name] != right.lacks[name]]
            told = told or (f"frame {number} says: {', '.join(lacking)}" if lacking else "")
            excused = excused or any(name in EXCUSES for name in lacking)
            wrong = [name for name in right.parts if mine.parts[name] != right.parts[name]]
            if abs(mine.closed_us - right.closed_us) > TIME_US:
                wrong.append("time")
            if wrong and not excused:
                return SILENT, f"frame {number}: {', '.join(wrong)}"
        if refused:
            return RECOVERED, f"refused: {refused}"
        if told:
            return RECOVERED, told
        if len(frames) < len(self.frames):
            return RECOVERED, f"{len(self.frames) - len(frames)} frames are missing"
        return NO_EFFECT, "counters alone" if not is_same else ""


def end_of(message: bytes) -> tuple:
    """A frame's end without times and counts of the loop."""
    body = message[28 + grid_stream.HEADER_BYTES:]
    end = grid_stream.read_frame_end(body)
    lossy = [*target_state.PACKET_DROPS, *target_state.DAMAGED, "port restarts", "cores at work", "items for lost cores"]
    return (message[29], message[52:72], end.tiles_sent, end.tiles_lost, end.crc, end.fates, end.sensors, end.unwatched,
            [end.counters[name] for name in lossy])


def items(end: bytes) -> list[int]:
    """Of each core, since the start."""
    counters = grid_stream.read_frame_end(end[28 + grid_stream.HEADER_BYTES:]).counters
    return [counters[f"items of core {core}"] for core in range(4)]
