"""What this project set out to reach on one Cortex-A9, what is reached, and how far both are from
what the memory alone would allow. A goal that is missed says where its cycles go."""

import dataclasses
import statistics

from claims import Goal
from cortex_a9 import FUSED, PUBLISH, STAGES, CortexA9, Cost, frame_run
from markdown import fixed, grouped, percent
from section import Section, one
from results.scaling import SWEEPS
from target_frames import SCENES, WHOLE, Floor, floor, target_frame

MATCHED = frame_run("ring_road")
MOST_INSTRUCTIONS = 1.9e6
WORK = {"receive": "receiving", "decode": "decoding", "beams": "turning points to beams",
        "carve": "carving", "mark": "marking", "encode": "encoding tiles", "send": "sending",
        "clear": "clearing", "tree": "building the tree"}
WORTH_NAMING = 0.1  # of the cycles


@dataclasses.dataclass(frozen=True)
class Rate:
    """A goal of which more is better, in Hz at 1 GHz, and what was found."""

    what: str
    hz: float
    cost: Cost
    floor: Floor
    floor_hz: float
    reason: str


def _shares(costs, of="cycles"):
    """Where they go: "of the cycles 57 % are carving, 41 % turning points to beams"."""
    amounts = {stage: cost.cycles.nominal if of == "cycles" else cost.instructions
               for stage, cost in costs.items()}
    whole = sum(amounts.values())
    largest = sorted((stage for stage in amounts if amounts[stage] >= WORTH_NAMING * whole),
                     key=amounts.get, reverse=True)
    first, *others = (f"{percent(amounts[stage] / whole, 0)} {'are ' * (place == 0)}{WORK[stage]}"
                      for place, stage in enumerate(largest))
    return ", ".join([f"of the {of} {first}", *others])


def _stage_costs(a9, run, stages):
    return {stage: a9.cost(run, stage) for stage in stages}


def _scaled(modelled, factor):
    """The model's cost of some frames, for the instructions that were counted of all."""
    return dataclasses.replace(modelled, cycles=modelled.cycles * factor,
                               instructions=modelled.instructions * factor)


def _fused_cost(a9, kept, run):
    """Those were counted with what is kept of lines; without it there are as many more as the
    model finds more."""
    frame = target_frame(a9, kept)
    return _scaled(a9.cost(run, *FUSED), frame.counted.fused / frame.fused.instructions)


def _fuse_goal(a9, what, hz, scene, paths="kept"):
    kept, run = frame_run(scene), frame_run(scene, paths=paths)
    costs = _stage_costs(a9, run, FUSED)
    reason = _shares(costs)
    if paths != "kept":
        times = costs["carve"].cycles.nominal / a9.cost(kept, "carve").cycles.nominal
        reason += f"; carving takes {fixed(times, 1)} times the cycles that it takes with tables"
    memory = floor(a9, f"scene={scene}")
    return Rate(what, hz, _fused_cost(a9, kept, run), memory, memory.fused_hz, reason)


def _worst_goal(a9, what, hz, kinds, all_paths=("kept", "forgotten")):
    """The dearest of the kinds by the nominal variant, with tables or without."""
    found = {(kind, paths): _fused_cost(a9, frame_run(worst=kind),
                                        frame_run(worst=kind, paths=paths))
             for kind in kinds for paths in all_paths}
    kind, paths = max(found, key=lambda each: found[each].cycles.nominal)
    reason = _shares(_stage_costs(a9, frame_run(worst=kind, paths=paths), FUSED))
    if "forgotten" in all_paths:
        saved = 1 - found[kind, "kept"].cycles.nominal / found[kind, "forgotten"].cycles.nominal
        reason += (f"; tables per line {'save' if saved > 0 else 'add'} "
                   f"{percent(abs(saved), 1)} of its cycles")
    memory = floor(a9, f"worst={kind}")
    return Rate(f"{what} (`{kind}`)", hz, found[kind, paths], memory, memory.fused_hz,
                reason)


def _whole_goal(a9):
    frame, memory = target_frame(a9, MATCHED), floor(a9, "scene=ring_road")
    cost = _scaled(frame.whole, frame.counted.whole / frame.whole.instructions)
    return Rate("matched load, from packet to last tile sent, raw", 260, cost, memory,
                memory.whole_hz, _shares(_stage_costs(a9, MATCHED, STAGES)))


def _whole_shortest_goal(a9):
    """As the firmware sends tiles. Without messages that are as short as can be there is no floor
    but that of fusing."""
    run, memory = frame_run("ring_road", coding="shortest"), floor(a9, "scene=ring_road")
    return Rate("the same, each tile in its shortest encoding", 200, a9.cost(run, WHOLE), memory,
                memory.fused_hz, _shares(_stage_costs(a9, run, STAGES)))


def _tree_goal(a9):
    """The tree is built from the tiles of the grid, after marking."""
    tree, memory = a9.cost("tree scene=ring_road", "tree"), floor(a9, "scene=ring_road")
    cost = _fused_cost(a9, MATCHED, MATCHED) + tree
    stages = _stage_costs(a9, MATCHED, FUSED) | {"tree": tree}
    return Rate("matched load, fuse + linear quadtree, one build a frame (thesis: 5 Hz, an update of the tree a "
                "cell)", 260, cost, memory,
                memory.fused_hz, _shares(stages))


def _rate_goals(a9, frames):
    forged, sendable = (list(frames[frames["sender"] == sender]["frame"])
                        for sender in ("forged", "lux"))
    return [_fuse_goal(a9, "matched load, best path", 550, "ring_road"),
            _fuse_goal(a9, "city drive, best path", 720, "city"),
            _fuse_goal(a9, "matched load, without tables per line", 290, "ring_road", "forgotten"),
            _worst_goal(a9, "worst forged frame, any path", 95, forged),
            _worst_goal(a9, "worst frame that four LUX could send, best path", 180, sendable,
                        ("kept",)),
            _whole_goal(a9), _whole_shortest_goal(a9), _tree_goal(a9)]


def _verdict(short_by, words, reason):
    return "met" if short_by <= 0 else f"**{words} {percent(short_by, 0)}**: {reason}"


def _rate_row(goal):
    hz = goal.cost.cycles.hz
    return [goal.what, f"≥ {grouped(goal.hz)} Hz", f"{hz.banded(0)} Hz",
            f"{grouped(goal.floor_hz)} Hz", fixed(goal.floor_hz / hz.nominal, 1),
            grouped(goal.cost.instructions), grouped(goal.cost.l1d_refills),
            grouped(goal.cost.l2_misses),
            _verdict(1 - hz.nominal / goal.hz, "short by", goal.reason)]


def _point_row(a9, what, most):
    """What the model finds in some frames, for the points of a mean frame of all."""
    cost = a9.cost(MATCHED, "beams", "mark")
    return _number_row(what, most, cost.instructions / a9.frame(MATCHED).points, 0)


def _tile_row(a9, what, most, run):
    frame = a9.frame(run)
    return _number_row(what, most, frame.publish / frame.tiles, 0,
                       _shares(_stage_costs(a9, run, PUBLISH), "instructions"))


def _block_row(a9, what, most, stage):
    found = a9.value("path_cost", "instructions", stage) / a9.value("path_cost", "blocks")
    return _number_row(what, most, found, 1)


def _piece_rows(a9):
    """With a bound where one is known: of a raw tile what it takes to copy and clear it."""
    shortest = frame_run("ring_road", coding="shortest")
    moved = a9.cost("floor scene=ring_road", "send", "clear").instructions
    rows = [(_point_row(a9, "a point of a kept line, until it waits and is marked", 180), None),
            (_block_row(a9, "a block of a path, to find it", 11, "find"), None),
            (_block_row(a9, "a block of a path, to carve it", 11, "carve"), None),
            (_tile_row(a9, "a tile published, raw", 4000, MATCHED),
             moved / a9.frame(MATCHED).tiles),
            (_tile_row(a9, "a tile published, in its shortest encoding", 5000, shortest), None)]
    return [[*row[:3], "none known" if bound is None else grouped(bound), row[3]]
            for row, bound in rows]


def _growth_rows(a9):
    """How many times as dear, nominal. The dearest sensor is beside the mean of the others."""
    def fused(sweep):
        return [a9.cost(load.run, *FUSED).cycles.nominal for load in SWEEPS[sweep].loads.values()]
    beams, cars = fused("beams"), fused("sensors")
    doubled = max(more / less for less, more in zip(beams, beams[1:]))
    *others, dearest = sorted(after - before for before, after in zip([0, *cars], cars))
    return [_number_row("twice the beams of a sensor", 2.2, doubled, 2),
            _number_row("a sensor beside the others, wherever it stands", 1.3,
                        dearest / statistics.mean(others), 2)]


def _number_row(what, most, found, decimals, reason=""):
    most_words = grouped(most) if decimals == 0 else f"{most:g}"
    verdict = "met" if found <= most else f"**over by {percent(found / most - 1, 0)}**"
    return [what, f"≤ {most_words}", f"{found:,.{decimals}f}",
            f"{verdict}: {reason}" if reason and found > most else verdict]


def _instructions_row(a9):
    frame = target_frame(a9, MATCHED)
    found = frame.counted.fused
    reason = _shares(_stage_costs(a9, MATCHED, FUSED), "instructions")
    return ["instructions a frame, matched load, fuse and clear",
            f"≤ {grouped(MOST_INSTRUCTIONS)}", grouped(found), grouped(frame.fused.l1d_refills),
            grouped(frame.fused.l2_misses),
            _verdict(found / MOST_INSTRUCTIONS - 1, "over by", reason)]


def _printed(a9):
    """The thesis's fusion as printed, at the matched load: up to the scan point, up to the end."""
    ours = target_frame(a9, MATCHED).counted
    found = {}
    for extent in ("scan_point", "whole_beam"):
        run = f"printed_cost scene=ring_road extent={extent}"
        assert a9.mean(run, "points") == ours.points, f"{run}: not the points of {MATCHED}"
        instructions = sum(a9.mean(run, "instructions", stage) for stage in ("fuse", "clear"))
        found[extent] = grouped(instructions)
        found[f"{extent}_times"] = fixed(instructions / ours.fused, 1)
    return found


def _floor_row(a9, words, frames, run):
    memory = floor(a9, frames)
    fused, whole = (a9.cost(run, *stages).cycles.nominal for stages in (FUSED, [WHOLE]))
    return [words, *map(grouped, (memory.lines, memory.fuse, memory.clear, memory.send,
                                  memory.fused_hz, memory.whole_hz)),
            fixed(fused / memory.fused, 1), fixed(whole / memory.whole, 1)]


def _floor_rows(a9, kinds):
    return [*(_floor_row(a9, words, f"scene={scene}", frame_run(scene))
              for scene, words in SCENES.items()),
            *(_floor_row(a9, f"`{kind}`", f"worst={kind}", frame_run(worst=kind))
              for kind in kinds)]


UNITS = {"pieces": " instructions", "growth": " times the cycles"}


def _goal(row, unit):
    """Of a table's row: what, how much is asked, how much is found, ..., the verdict."""
    return Goal(row[0], row[1] + unit, row[2], row[-1] == "met")


def section(data) -> Section:
    a9, frames = CortexA9(data), data["worst_frames"]
    kinds = list(frames[frames["sender"] != "drive"]["frame"])
    found = {"rates": [_rate_row(goal) for goal in _rate_goals(a9, frames)],
             "instructions": [_instructions_row(a9)], "pieces": _piece_rows(a9),
             "growth": _growth_rows(a9)}
    return Section(
        found={**found, "rule": one(data["frame_limits"], "rule"), "printed": _printed(a9),
               "floors": _floor_rows(a9, kinds)},
        goals=[_goal(row, UNITS.get(table, "")) for table, rows in found.items() for row in rows])
