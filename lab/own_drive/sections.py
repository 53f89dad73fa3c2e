"""The sentences and tables of the page that need more than a number of the drive."""

from drawings import COLOURS, HIT, NOTHING, PASSED, class_picture, index_picture
from drive import NAMED, Drive, Followed, directions_of, is_placed, spans_of
from iogrid import Class
from said import Rows, budgets_of

MOST_ROWS = 20
# docs/spec.md 1.3.
OUTCOMES = {"used": "evidence of an obstacle in the grid", "no return": "nothing came back",
            "too near": "nearer than the unit measures, or on the car itself",
            "too far": "beyond the range of the model", "height band": "below or above the height band",
            "flagged": "the unit calls it ground, dirt or rain", "later echo": "behind the first echo of the beam",
            "malformed": "in a packet that was wrong or over budget",
            "stale": "in a packet that was a duplicate, late, frozen or too soon",
            "not taken": "in a packet that was left because the target is too slow",
            "ground": "on the estimated ground", "overhang": "above the height limit over the ground",
            "under the ground": "a mirror image, a hole or a drop"}
KEYS = {"free": Class.FREE, "moving, with its box and an arrow of 1 s": Class.MOVING, "stopped": Class.STOPPED,
        "standing": Class.STANDING, "mapped": Class.INFRASTRUCTURE, "occupied, too new to be standing": Class.OCCUPIED,
        "unknown": Class.UNKNOWN}


def share(part: float, whole: float) -> str:
    return f"{100 * part / whole:.1f} %" if whole else "–"


def cell_keys(drive: Drive) -> list[tuple[str, tuple]]:
    """Of the classes that the drive has."""
    if not drive.frames.has_pose.any():
        return [("occupied", HIT), ("free", PASSED), ("unknown", NOTHING)]
    seen = {which for name in classes_of(drive) for which in NAMED[name]}
    return [(words, COLOURS[which]) for words, which in KEYS.items() if which in seen]


def classes_of(drive: Drive) -> list[str]:
    """Those that some frame has."""
    return [name for name in NAMED if drive.frames[name].max() > 0]


def facts(drive: Drive) -> list[tuple[str, str]]:
    frames, moved = drive.frames, drive.moved
    found = [(f"{frames.time_s.max():,.1f} s", "from the first frame to the last"), (f"{len(frames):,}", "frames")]
    if frames.has_classes.any():
        found.append((share(frames.has_pose.sum(), len(frames)), "of the frames have a pose"))
    if frames.has_pose.any():
        sure = sum(each.speed is not None for each in moved)
        found.append((f"{frames.way_m.sum():,.0f} m", "driven, by the poses"))
        if drive.has_objects:
            found.append((str(len(moved)), f"objects were seen moving, {sure} with a sure speed"))
        found.append((f"{drive.world.area_m2('free'):,.0f} m²", "free when last seen"))
    return found


def is_assumed(words: str) -> bool:
    """A row of the poses about a standard deviation that the log does not state: usual with odometry."""
    return "assumed (`iog pose" in words


def points_a_frame(drive: Drive, fused: Rows) -> int:
    return round(sum(fused.counts("scan points").values()) / len(drive.frames))


def attention(drive: Drive, fused: Rows, remarks: list[str], car: dict, budget: str) -> list[str]:
    """What a reader has to know before the rest."""
    frames, words = drive.frames, fused.loud + remarks
    words += [f"{key.capitalize()}: {value}" for key in ("not looked at", "capture") for value in fused.all(key)]
    words += [f"Poses: {value}" for value in fused.all("poses")[:-1] if not is_assumed(value)]
    if drive.geometry and drive.geometry.cell_m < 0.1:
        words.append(f"This car sends the index grid alone, in cells of {drive.geometry.cell_m:g} m. Classes need cells of "
                     "at least 0.1 m.")
    elif not frames.has_classes.any():
        words.append("This car sends the index grid alone (the key grids of its file, or the default of its units). "
                     "With grids = \"both\" and poses, it also has classes, moving objects and a map.")
    elif not frames.has_pose.any():
        words.append("No frame has a pose, so this report shows the index grid alone: what is occupied and free in "
                     "each frame. With --poses LOG, it also shows what is moving and standing, moving objects with their "
                     "speeds, and a map of the whole drive. For a car that stood still, iog pose --standing makes the "
                     "poses.")
    elif frames.has_pose.mean() < 0.95:
        words.append(f"{share((~frames.has_pose).sum(), len(frames))} of the frames have no pose.")
    if len(drive.worlds) > 1:
        words.append(f"The source of the poses restarted {len(drive.worlds) - 1} times. The map has the largest part.")
    if (drops := fused["packets dropped"]) not in ("", "none"):
        words.append(f"Packets were dropped: {drops}.")
    if drive.told and (never := drive.not_watched == drive.told).any():
        words.append(f"No sensor watched {directions_of(never)} in any frame (0° is ahead, 90° is left).")
    if beside := drive.beside(car["footprint"]):
        words.append(f"Objects {', '.join(map(str, beside))} move, but stay beside the car all the time. They may be "
                     "parts of it: then the footprint in the car's file is too small.")
    words += [f"On the board, a typical frame of this car takes {each.ms} ms, {each.share_of_period} % of its period: "
              "too slow for one core (modelled)." for each in budgets_of(budget)
              if each.name == "typical" and each.is_too_slow]
    return words


def points(fused: Rows, fates: dict[str, dict[str, int]]) -> tuple[list[str], list[tuple]]:
    """The heads of the columns, and rows: outcome, meaning, points and share of each column. Sensors have columns of
    their own only if they add up."""
    total = fused.counts("scan points")
    adds_up = fates and all(sum(each.get(name, 0) for each in fates.values()) == total[name] for name in total)
    columns = {**fates, "all": total} if adds_up else {"points": total}
    sums = {head: sum(column.values()) for head, column in columns.items()}
    rows = [(name, OUTCOMES.get(name, ""), [(column.get(name, 0), share(column.get(name, 0), sums[head]))
                                            for head, column in columns.items()])
            for name in sorted(total, key=total.get, reverse=True)]
    return list(columns), rows


def gaps(drive: Drive) -> list[str]:
    """When frames had no pose, the longest first."""
    spans = spans_of(drive.frames.time_s.to_numpy(), ~drive.frames.has_pose.to_numpy(bool))
    spans.sort(key=lambda span: span[0] - span[1])
    return [f"{begin:.1f} s to {end:.1f} s" for begin, end in spans[:5]] + ["…"] * (len(spans) > 5)


def longest(moved: list[Followed]) -> list[tuple]:
    """Rows of the table, with speeds in km/h."""
    return [(each.id, f"{each.first_s:.1f}", f"{each.followed_s:.1f}", len(each.way),
             *((f"{3.6 * value:.0f}" for value in each.speed) if each.speed else ("not sure", "–")),
             f"{each.nearest_m:.0f}", f"{each.farthest_m:.0f}", f"{each.length_m:.1f} × {each.width_m:.1f}")
            for each in moved[:MOST_ROWS]]


def pictures(drive: Drive, footprint: dict) -> list[tuple[str, str]]:
    """Words and pictures, by time: of the chosen frames, and of the one with the most moving cells."""
    frames = {frame.number: (time_s, frame) for time_s, frame in filter(None, (*drive.kept, drive.liveliest))}
    found = []
    for number, (time_s, frame) in sorted(frames.items()):
        where = f"of frame {number} at {time_s:.1f} s"
        if frame.indexes is not None:
            found.append(("Index grid " + where, index_picture(frame, time_s, footprint)))
        if is_placed(frame):
            found.append(("Classes " + where, class_picture(frame, time_s, footprint)))
    return found
