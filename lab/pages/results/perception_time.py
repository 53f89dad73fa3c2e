"""What a frame with classes takes: by the cost model, stage by stage, beside the goals."""

import dataclasses

from claims import Goal
from cortex_a9 import CortexA9
from markdown import fixed, grouped
from section import Section

WORDS = {"city": "city", "ring_road": "ring road"}
DRIVES = tuple(WORDS)
STAGES = ("receive", "decode", "slices", "beams", "carve", "mark", "join", "pull", "push", "clear",
          "arrivals", "list", "update", "refresh", "remember", "objects", "encode", "encode_classes", "send")
GOAL_MS = {"city": 19, "ring_road": 36}
MOST_PESSIMISTIC_MS = 40
GOAL_PER_CELL = 24
GOAL_OBJECTS_MS = 1.5
FORGED = {"anywhere": "16,384 hits anywhere", "things": "1,024 things of 4 hits that move",
          "walls": "40 walls of 400 hits", "crowd": "400 things of 10 hits that overlap"}
GOAL_FORGED_MS = 8
CELLS_OF_GROUP = 8


@dataclasses.dataclass(frozen=True)
class Time:
    """Milliseconds of a mean frame and of the dearest, by a variant."""

    mean: float
    most: float


def run_of(drive):
    return f"perception_cost drive={drive}"


def time_of(a9, drive, variant):
    cycles = a9.mean(run_of(drive), "cycles", "frame", variant)
    most = a9.value(run_of(drive), "cycles_max", "frame", variant)
    return Time(cycles / 1e6, most / 1e6)


def per_group(a9, drive, variant, counter):
    """Of updating and deciding a group."""
    groups = a9.mean(run_of(drive), "groups_fused", "", variant)
    return a9.mean(run_of(drive), counter, "update", variant) / groups


def stage_row(a9, stage):
    cells = [stage.replace("_", " ")]
    for drive in DRIVES:
        cells += [grouped(a9.mean(run_of(drive), "instructions", stage, "nominal")),
                  fixed(a9.mean(run_of(drive), "cycles", stage, "nominal") / 1e6, 2)]
    return cells


def forged_ms(a9, kind, variant):
    return a9.value(f"object_cost kind={kind}", "cycles_max", "objects", variant) / 1e6


def forged_row(a9, kind):
    run = f"object_cost kind={kind}"
    return [FORGED[kind], grouped(a9.value(run, "instructions_max", "objects")),
            *(fixed(forged_ms(a9, kind, variant), 1) for variant in ("nominal", "pessimistic"))]


def goals(a9):
    found = []
    for drive in DRIVES:
        mean = time_of(a9, drive, "nominal").mean
        found.append(Goal(f"{WORDS[drive]}: mean frame with classes, nominal", f"≤ {GOAL_MS[drive]} ms",
                          f"{fixed(mean, 1)} ms", mean <= GOAL_MS[drive]))
    most = time_of(a9, "city", "pessimistic").most
    found.append(Goal("city: dearest frame with classes, pessimistic", f"≤ {MOST_PESSIMISTIC_MS} ms",
                      f"{fixed(most, 1)} ms", most <= MOST_PESSIMISTIC_MS))
    for drive in DRIVES:
        cell = per_group(a9, drive, "nominal", "instructions") / CELLS_OF_GROUP
        found.append(Goal(f"{WORDS[drive]}: instructions to update and decide a cell",
                          f"≤ {GOAL_PER_CELL}", fixed(cell, 1), cell <= GOAL_PER_CELL))
        objects = a9.mean(run_of(drive), "cycles", "objects", "nominal") / 1e6
        found.append(Goal(f"{WORDS[drive]}: following things with a speed, nominal", f"≤ {GOAL_OBJECTS_MS} ms",
                          f"{fixed(objects, 2)} ms", objects <= GOAL_OBJECTS_MS))
    worst = max(forged_ms(a9, kind, "nominal") for kind in FORGED)
    found.append(Goal("following things in the dearest forged frame, nominal", f"≤ {GOAL_FORGED_MS} ms",
                      f"{fixed(worst, 1)} ms", worst <= GOAL_FORGED_MS))
    budgeted = int(a9.value(run_of("city"), "budgeted_cycles"))
    for drive in DRIVES:
        cycles = per_group(a9, drive, "nominal", "cycles")
        found.append(Goal(f"{WORDS[drive]}: cycles a group, by which the budget is made",
                          f"≤ {budgeted}", fixed(cycles, 0), cycles <= budgeted))
    return found


def section(data):
    a9 = CortexA9(data)
    counts = [[drive, grouped(a9.mean(run_of(drive), "slices")),
               grouped(a9.mean(run_of(drive), "groups_fused")),
               grouped(a9.value(run_of(drive), "most_groups")),
               grouped(a9.mean(run_of(drive), "class_tiles")),
               grouped(a9.mean(run_of(drive), "sent_bytes"))] for drive in DRIVES]
    bands = [[drive, *(f"{fixed(time.mean, 1)} ({fixed(time.most, 1)})" for time in
                       (time_of(a9, drive, variant) for variant in ("nominal", "pessimistic")))]
             for drive in DRIVES]
    return Section({
        "counts": counts,
        "bands": bands,
        "mean": {drive: fixed(time_of(a9, drive, "nominal").mean, 1) for drive in DRIVES},
        "stages": [stage_row(a9, stage) for stage in (*STAGES, "frame")],
        "forged": [forged_row(a9, kind) for kind in FORGED],
        "objects_bytes": grouped(a9.value("object_cost kind=anywhere", "bytes")),
        "frames": int(a9.value(run_of("city"), "frames", "", "nominal")),
        "before": int(a9.value(run_of("city"), "before", "", "nominal")),
        "group_budget": grouped(a9.value(run_of("city"), "group_budget")),
        "window_bytes": grouped(a9.value(run_of("city"), "window_bytes")),
    }, goals=goals(a9))
