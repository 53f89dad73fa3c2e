"""The runs of lab/data/cores_modelled.csv: frames with classes whose work is divided among cores, and
what a round of the cores costs by itself; a9_runs.py says what a run is.

One modelled core does all items of all rounds, one after the other, and the model says what each took.
Here the items are dealt out as the firmware does it: each to the core that is idle first. A round ends
with its last item, but not before the one memory channel has moved the lines of all of its items.
"""

import collections
import csv
import typing

import a9_moved
import a9_perception
import a9_runs

# A frame is taken apart into the items of its rounds. What is not in one of these functions is the
# pass's own; what the benchmark does is left out.
FUNCTIONS = {
    "fuse": ["fusion/shared_fusion:fuse_part"],
    "join": ["fusion/shared_fusion:join_row"],
    "encode": ["tile_coding/encode:encode"],
    "other": ["target/perception_pass:take", "target/perception_pass:tick"],
}
OUTSIDE = a9_perception.OUTSIDE
VARIANTS = ("nominal",)
WARM_UP = 12
FRAMES = 4
ITEMS_OF_A_ROUND = (8, 64)


CORES = (1, 2, 3, 4)
COUNTERS = ("cycles", "l2_misses", "ddr_reads", "ddr_writes")


class Row(typing.NamedTuple):
    """Of the rounds of a stage in a frame; `alone` is what core 0 does between them."""

    drive: str
    variant: str
    cores: int
    frame: int
    stage: str
    rounds: int
    items: int
    busy_cycles: int  # of all cores together
    longest_cycles: int  # of the core that is busy longest, round by round
    ddr_lines: int  # of 32 bytes, read and written
    bounded_cycles: int  # as longest_cycles, but no round is shorter than its lines take


class Item(typing.NamedTuple):
    cycles: int
    ddr_lines: int


class Round(typing.NamedTuple):
    """What core 0 does alone has one item."""

    frame: int
    stage: str
    items: list[Item]


def _ends(printed: list[str]) -> list[dict[str, collections.Counter]]:
    """What each function took since the end of the item before."""
    ends = []
    for pairs in map(a9_runs.pairs_of, printed):
        if "round" in pairs and "of" in pairs:
            if int(pairs["round"]) == len(ends):
                ends.append(collections.defaultdict(collections.Counter))
            # A name may be that of several functions.
            ends[-1][pairs["of"]].update({counter: int(pairs[counter]) for counter in COUNTERS})
    return ends


def _item(end: dict[str, dict[str, int]]) -> Item:
    def of(counter: str) -> int:
        return sum(counters[counter] for name, counters in end.items() if name not in OUTSIDE)
    return Item(of("cycles"), of("ddr_reads") + of("ddr_writes"))


def _stage(items: list[dict[str, dict[str, int]]]) -> str:
    """Of a round: which of the functions its items were, else the window's. The first one may be what
    core 0 does beside them."""
    return next((name for name in ("fuse", "join", "encode")
                 if any(item[name]["cycles"] > 0 for item in items)), "window")


def rounds_of(printed: list[str]) -> list[Round]:
    counts = next(pairs["rounds"] for pairs in map(a9_runs.pairs_of, printed) if "rounds" in pairs)
    ends = iter(_ends(printed))
    rounds, frame = [], 0
    for count in map(int, counts.split(",")):
        rounds.append(Round(frame, "alone", [_item(next(ends))]))
        if count == 0:
            frame += 1
            continue
        items = [next(ends) for _ in range(count)]
        rounds.append(Round(frame, _stage(items), [_item(end) for end in items]))
    return rounds


def dealt(items: list[Item], cores: int) -> list[int]:
    """The cycles of each core."""
    loads = [0] * cores
    for item in items:
        loads[loads.index(min(loads))] += item.cycles
    return loads


def divided(drive: str, variant: str, cores: int, rounds: list[Round], ddr_line: int) -> list[Row]:
    found = collections.defaultdict(list)
    for each in rounds:
        found[each.frame, each.stage].append(each.items)
    rows = []
    for (frame, stage), of_stage in found.items():
        loads = [dealt(items, 1 if stage == "alone" else cores) for items in of_stage]
        lines = [sum(item.ddr_lines for item in items) for items in of_stage]
        bounded = sum(max(max(load), count * ddr_line) for load, count in zip(loads, lines))
        rows.append(Row(drive, variant, cores, frame, stage, len(of_stage), sum(map(len, of_stage)),
                        sum(map(sum, loads)), sum(map(max, loads)), sum(lines), bounded))
    return rows


def ddr_line(place: a9_runs.Place, variant: str) -> int:
    """Cycles of the memory channel for a line. ",constant=value" behind the variant is ignored."""
    constants = csv.DictReader(a9_runs.output_of(place.model / "a9_constants", "--csv").splitlines())
    return next(int(row[variant.split(",")[0]]) for row in constants if row["constant"] == "ddr_line")


def image_of(drive: str) -> str:
    return "perception_cost" if drive != a9_moved.TRACKED else f"perception_cost-{drive}_objects"


def of_drive(place: a9_runs.Place, drive: str, variant: str, capture: str, frames: int = FRAMES,
             before: int = WARM_UP) -> list[Row]:
    printed = a9_runs.printed_by_model(place, variant, FUNCTIONS | OUTSIDE,
                                       place.images / image_of(drive), capture, frames, before,
                                       max(CORES))
    rounds, line = rounds_of(printed), ddr_line(place, variant)
    return [row for cores in CORES for row in divided(drive, variant, cores, rounds, line)]


UNDIVIDED = {
    "fuse": a9_runs.STAGES["beams"],
    "join": a9_perception.STAGES["join"],
    "window": ["placing/slice_cells:copy", "placing/slice_cells:note"],
    "other": FUNCTIONS["other"],
}


def of_one_core(place: a9_runs.Place, drive: str, variant: str, capture: str) -> list[Row]:
    """The same frames as one core has them, which divides nothing: all of them together. What it
    hands to the window while it joins is not of fusing."""
    functions = UNDIVIDED | OUTSIDE
    _, own = a9_runs.own_of(
        a9_runs.printed_by_model(place, variant, functions, place.images / image_of(drive),
                                 capture, FRAMES, WARM_UP), functions)

    def row(stage: str, *names: str) -> Row:
        cycles = sum(own[name]["cycles"] for name in names)
        return Row(drive, variant, 1, 0, stage, 0, FRAMES, cycles, cycles, 0, cycles)
    return [row("undivided_fusing", "fuse", "join"), row("undivided_frame", *UNDIVIDED)]


def of_round(place: a9_runs.Place, variant: str, items: int) -> list[Row]:
    """A round of empty items, as one core has it."""
    printed = a9_runs.printed_by_model(
        place, variant, {"round": ["target/round_cost:run_rounds"]},
        place.images / "round_cost", items)
    pairs = list(map(a9_runs.pairs_of, printed))
    rounds = next(int(each["rounds"]) for each in pairs if "items" in each)
    cycles = next(int(each["cycles"]) for each in pairs if each.get("self") == "round") // rounds
    return [Row("", variant, 1, 0, "empty_round", 1, items, cycles, cycles, 0, cycles)]


def runs(place: a9_runs.Place, drives: dict[str, str]) -> list:
    return ([lambda d=drive, c=capture, v=variant, run=run: run(place, d, v, c)
             for run in (of_drive, of_one_core)
             for variant in VARIANTS for drive, capture in drives.items()] +
            [lambda v=variant, n=count: of_round(place, v, n)
             for variant in VARIANTS for count in ITEMS_OF_A_ROUND])
