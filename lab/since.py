"""What three frames cost now, beside what lab/data says they cost.

The tables of lab/data are measured by hand, at a commit that lab/data/made_from names. The code goes on. Three
frames, counted in QEMU in half a minute, say how far it has gone since; the pages show it (lab/data/since.csv).
"""

import csv
import dataclasses
import functools
import shlex
import typing

import measurements
from measurements import DATA, ROOT, WORK

import a9_perception  # it lies in lab/target/, which measurements adds to the path
import a9_runs
import a9_turning

TABLE = DATA / "since.csv"
NAMED = 0.02  # a smaller change is not worth a line


@dataclasses.dataclass(frozen=True)
class Frame:
    """words: its name on a page. key: of its capture in made_with.csv. count: place, capture -> rows."""

    words: str
    run: str
    key: str
    image: str
    count: typing.Callable


FRAMES = (
    Frame("ring road, four LUX units", f"frame_cost scene=ring_road sensors={a9_runs.ALL_SENSORS}",
          "capture scene=ring_road", "frame_cost-reference_car",
          lambda place, capture: a9_runs.frame_cost(place, "scene=ring_road", capture, "raw", a9_runs.ALL_SENSORS)),
    Frame("city with classes", "perception_cost drive=city", "capture drive=city", "perception_cost",
          lambda place, capture: a9_perception.counted(place, "city", capture)),
    Frame("VLP-16 over the ground", "turning vehicle=roof_vlp16", "capture vehicle=roof_vlp16",
          "frame_cost-roof_vlp16", lambda place, capture: a9_turning.counted(place, "roof_vlp16", capture)),
)


def table_of(name: str) -> list[list[str]]:
    with open(DATA / name, newline="") as table:
        return list(csv.reader(table))[1:]


def instructions_of(rows: typing.Iterable[typing.Sequence[str]]) -> int:
    return next(int(value) for _, stage, variant, counter, value in rows
                if (stage, variant, counter) == ("frame", "counted", "instructions"))


@functools.cache
def measured() -> dict[str, int]:
    """By run what the tables say."""
    rows = table_of(measurements.COUNTED)
    return {frame.run: instructions_of(row for row in rows if row[0] == frame.run) for frame in FRAMES}


def counted() -> dict[str, int]:
    """By run what these sources take. Fails if a grid or a class is not that of `iog fuse`."""
    place = a9_runs.Place(ROOT / "build/host/tools/iog", ROOT / "build/imx6/lab/target",
                          ROOT / "build/host/lab/a9_model", WORK)
    measurements.build("host", "iog", "larger_tlb")
    measurements.build("imx6", *(frame.image for frame in FRAMES))
    drives = dict(table_of("made_with.csv"))
    found = {}
    for number, frame in enumerate(FRAMES):
        capture = f"since_{number}.pcap"
        program, *words = shlex.split(drives[frame.key])
        assert program == "iog", program
        a9_runs.output_of(place.iog, *words, "--out", WORK / capture)
        found[frame.run] = instructions_of(frame.count(place, capture))
    return found


def write(found: dict[str, int]) -> None:
    counted_at = measurements.commit()  # before this table is changed, too
    with open(TABLE, "w", newline="") as out:
        csv.writer(out, lineterminator="\n").writerows(
            [["run", "commit", "instructions"], *([run, counted_at, value] for run, value in found.items())])


def change(run: str, now: int) -> float:
    return now / measured()[run] - 1


def far_off(found: dict[str, int]) -> list[str]:
    """A sentence for each frame that costs other than the pages say."""
    shown = {run: int(value) for run, _, value in table_of("since.csv")} if TABLE.is_file() else {}
    return [f"{frame.words}: a frame takes {now:,} instructions, {change(frame.run, now):+.1%} since the tables were "
            f"measured; the pages say {change(frame.run, shown.get(frame.run, measured()[frame.run])):+.1%}"
            for frame in FRAMES for now in [found[frame.run]]
            if abs(now - shown.get(frame.run, measured()[frame.run])) > NAMED * measured()[frame.run]]


def sentence() -> str:
    """For a page that shows costs on the target; empty if nothing was counted since."""
    rows = table_of("since.csv") if TABLE.is_file() else []
    if not rows:
        return ""
    words = {frame.run: frame.words for frame in FRAMES}
    changes = [f"{change(run, int(value)):+.1%} ({words[run]})" for run, _, value in rows]
    listed = " and ".join(filter(None, [", ".join(changes[:-1]), changes[-1]]))
    return f"At commit {rows[0][1]}, instruction counts differ from those on the pages by {listed}."
