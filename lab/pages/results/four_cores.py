"""A frame with classes whose work is divided among four cores."""

import types

from claims import Goal
from markdown import fixed, grouped, percent
from section import Section, one, select

SCENES = {"ring_road": "ring road", "city": "city"}
MOST = 4
STAGES = ("fuse", "join", "window", "encode", "alone")

# Estimates, as nobody has measured them here: from the interrupt to the helper's first look at the
# ticket, for three helpers in turn; and the ticket's cache line from another core to take an item
# and back to raise its flag, twice the way to the second level cache.
WAKE_CYCLES = 500
MOVE_CYCLES = 46

GOAL_FRAME, GOAL_FUSING, GOAL_IMBALANCE, GOAL_SYNC = 2.5, 3, 0.15, 20_000
GOAL_FRAME_MS = {"ring_road": 14, "city": 8}


class Frames:
    """Of frames with classes, means in cycles."""

    def __init__(self, table, drive, variant):
        self.rows = select(table, drive=drive, variant=variant)
        self.frames = 1 + self.rows["frame"].max()

    def sum(self, column, stage, cores):
        return select(self.rows, stage=stage, cores=cores)[column].sum() / self.frames

    def whole(self, cores, column="bounded_cycles"):
        return sum(self.sum(column, stage, cores) for stage in STAGES)

    def undivided(self, what):
        row = select(self.rows, stage=f"undivided_{what}").iloc[0]
        return row["busy_cycles"] / row["items"]

    def fusing(self, cores):
        return sum(self.sum("bounded_cycles", stage, cores) for stage in ("fuse", "join"))

    def imbalance(self, stage, cores):
        return self.sum("longest_cycles", stage, cores) * cores / self.sum("busy_cycles", stage,
                                                                           cores) - 1

    def rounds(self, column):
        return sum(self.sum(column, stage, MOST) for stage in STAGES if stage != "alone")


def _synchronising(table, variant, frames):
    """Cycles of a frame, on the way to its end: by the model of empty rounds, and the estimates."""
    few, many = sorted(select(table, stage="empty_round", variant=variant)["items"])
    cost = {items: one(table, "busy_cycles", stage="empty_round", variant=variant, items=items)
            for items in (few, many)}
    item = (cost[many] - cost[few]) / (many - few)
    opening = cost[few] - item * few
    rounds, items = frames.rounds("rounds"), frames.rounds("items")
    return types.SimpleNamespace(
        item=item, opening=opening, rounds=rounds, items=items,
        cycles=rounds * (opening + WAKE_CYCLES) + items / MOST * (item + MOVE_CYCLES))


def _stage_rows(frames):
    rows = []
    for stage in STAGES:
        rows.append([stage, grouped(frames.sum("rounds", stage, MOST)),
                     grouped(frames.sum("items", stage, MOST)),
                     *(fixed(frames.sum("bounded_cycles", stage, cores) / 1e6, 2)
                       for cores in (1, 2, 3, 4)),
                     percent(frames.imbalance(stage, MOST), 1) if stage != "alone" else "",
                     grouped(frames.sum("ddr_lines", stage, MOST))])
    rows.append(["whole frame", grouped(frames.rounds("rounds")), grouped(frames.rounds("items")),
                 *(fixed(frames.whole(cores) / 1e6, 2) for cores in (1, 2, 3, 4)), "",
                 grouped(sum(frames.sum("ddr_lines", stage, MOST) for stage in STAGES))])
    return rows


def _goal(what, asked, found, is_met, reason=""):
    return Goal(what, asked, found, is_met, "" if is_met else reason)


def _memory_reason(frames, ddr_ns, stages, cycles):
    lines = sum(frames.sum("ddr_lines", stage, MOST) for stage in stages)
    return (f"of its {fixed(cycles / 1e6, 2)} ms the memory channel is busy for "
            f"{fixed(lines * ddr_ns / 1e6, 2)}")


def _whole_frame(table, drive):
    frames = Frames(table, drive, "nominal")
    return frames.whole(MOST) + _synchronising(table, "nominal", frames).cycles


def _goals(table, ddr_ns):
    road = Frames(table, "ring_road", "nominal")
    sync = _synchronising(table, "nominal", road).cycles
    whole = _whole_frame(table, "ring_road")
    gain = road.undivided("frame") / whole
    fusing = {drive: Frames(table, drive, "nominal").undivided("fusing") /
              Frames(table, drive, "nominal").fusing(MOST) for drive in SCENES}
    imbalance = max(Frames(table, drive, "nominal").imbalance(stage, MOST) for drive in SCENES
                    for stage in STAGES if stage != "alone")
    slower = [drive for drive in SCENES if Frames(table, drive, "nominal").whole(MOST) >=
              Frames(table, drive, "nominal").undivided("frame")]
    alone = percent(road.sum("bounded_cycles", "alone", MOST) / road.whole(MOST), 0)
    sync_goal = f"{grouped(GOAL_SYNC)} cycles"
    return [
        _goal("four cores: whole frame of the ring road, by one core's", f"≥ {GOAL_FRAME}", fixed(gain, 2),
              gain >= GOAL_FRAME, f"{alone} of it is core 0 alone"),
        *(_goal(f"four cores: whole frame, {SCENES[drive]}", f"≤ {goal} ms", f"{fixed(found / 1e6, 1)} ms",
                found <= goal * 1e6, _memory_reason(Frames(table, drive, "nominal"), ddr_ns, STAGES, found))
          for drive, goal in GOAL_FRAME_MS.items() for found in [_whole_frame(table, drive)]),
        *(_goal(f"four cores: fusing, {SCENES[drive]}, by one core's", f"≥ {GOAL_FUSING}", fixed(found, 2),
                found >= GOAL_FUSING,
                _memory_reason(Frames(table, drive, "nominal"), ddr_ns, ("fuse", "join"),
                               Frames(table, drive, "nominal").fusing(MOST)))
          for drive, found in fusing.items()),
        _goal("four cores: imbalance of a stage, the most", f"< {percent(GOAL_IMBALANCE, 0)}",
              percent(imbalance, 1), imbalance < GOAL_IMBALANCE),
        _goal("four cores: drives whose mean frame is slower than on one core", "none",
              ", ".join(slower) or "none", not slower),
        _goal("four cores: synchronisation a frame, ring road", f"≤ {sync_goal}", f"{grouped(sync)} cycles",
              sync <= GOAL_SYNC, f"{grouped(road.rounds('rounds'))} rounds of "
              f"{grouped(road.rounds('items'))} items"),
    ]


def section(data) -> Section:
    table = data["cores_modelled"]
    frames = {drive: Frames(table, drive, "nominal") for drive in SCENES}
    road = frames["ring_road"]
    sync = _synchronising(table, "nominal", road)
    ddr_ns = one(data["a9_constants"], "nominal", constant="ddr_line")
    lines = sum(road.sum("ddr_lines", stage, MOST) for stage in STAGES)
    return Section(
        found={"stages": {SCENES[drive]: _stage_rows(of_drive)
                          for drive, of_drive in frames.items()},
               "modelled_frames": road.frames, "sync": sync,
               "wake": WAKE_CYCLES, "move": MOVE_CYCLES, "ddr_ns": int(ddr_ns),
               "ddr_megabytes": lines * 32 / 1e6, "ddr_ms": lines * int(ddr_ns) / 1e6,
               "undivided_ms": {SCENES[drive]: of_drive.undivided("frame") / 1e6
                                for drive, of_drive in frames.items()},
               "one_ms": {SCENES[drive]: of_drive.whole(1) / 1e6
                          for drive, of_drive in frames.items()},
               "four_ms": {SCENES[drive]: fixed(_whole_frame(table, drive) / 1e6, 1) for drive in SCENES}},
        goals=_goals(table, int(ddr_ns)))
