"""What lab/run measures: which steps there are, what they write into lab/data, and at which commit they did."""

import csv
import dataclasses
import pathlib
import shutil
import subprocess
import sys
import typing

ROOT = pathlib.Path(__file__).resolve().parents[1]
sys.path.insert(0, str(ROOT / "lab/target"))
import a9_runs  # noqa: E402 ; it lies in lab/target/

DATA = ROOT / "lab/data"
WORK = ROOT / "build/lab"
MADE_FROM = DATA / "made_from"
COUNTED = "cortex_a9.csv"  # of all parts of the target


class Failed(Exception):
    """A step could not be done; the one line says why."""


def run(*words, out: pathlib.Path | None = None) -> None:
    """A command in the project's root; into a file, so that a failure leaves no half of it."""
    stdout = open(out, "w") if out else None
    try:
        done = subprocess.run([str(word) for word in words], cwd=ROOT, stdin=subprocess.DEVNULL,
                              stdout=stdout, check=False)
    finally:
        if stdout:
            stdout.close()
    if done.returncode != 0:
        raise Failed(f"{words[0]} failed with status {done.returncode}")


def build(preset: str, *targets: str) -> None:
    WORK.mkdir(parents=True, exist_ok=True)
    run("lab/target/build", WORK, preset, *targets)


def experiments(folder: pathlib.Path, pages: typing.Sequence[str],
                recordings: typing.Sequence[str] = ()) -> None:
    build("host", "experiments")
    given = [word for recording in recordings for word in ("--recording", recording)]
    given += [word for page in pages for word in ("--only", page)]
    run("build/host/lab/experiments/experiments", "--out", folder, *given)


def target(folder: pathlib.Path, parts: typing.Sequence[str], _recordings=()) -> None:
    run("lab/target/measure_a9", "--out", folder, *parts)


def build_images() -> None:
    vehicles = sorted(path.stem for path in (ROOT / "vehicles").glob("*.toml"))
    build("imx6", *(f"iogrid-{vehicle}" for vehicle in vehicles))


def images(folder: pathlib.Path, _parts=(), _recordings=()) -> None:
    """The firmware runs for two seconds, too, and says how deep its stack was."""
    build_images()
    report = WORK / "qemu/summary.txt"
    run("qemu/run", "--seconds", 2, "--out", report.parent, out=WORK / "qemu.txt")
    run("lab/target/images", "build/imx6/board/imx6", report, out=folder / "images.csv")


def boards(folder: pathlib.Path, _parts=(), _recordings=()) -> None:
    run("lab/target/boards", WORK / "boards", out=folder / "boards.csv")


def a9_model(folder: pathlib.Path, _parts=(), _recordings=()) -> None:
    build("host", "a9_model", "a9_constants")
    build("imx6", "a9_micro")
    model = ROOT / "build/host/lab/a9_model"
    run(model / "a9_constants", "--csv", out=folder / "a9_constants.csv")
    run("lab/a9_model/check", model / "liba9_model.so", "build/imx6/lab/a9_model/a9_micro", "--csv",
        out=folder / "a9_answers.csv")


def peers(folder: pathlib.Path, _parts=(), _recordings=()) -> None:
    run("lab/peers/run", "--out", folder)


def recorded(folder: pathlib.Path, _parts, drives: typing.Sequence[str]) -> None:
    """drives: folders, each followed by the file of its car."""
    build("host", "iog", "class_frames", "point_fates")
    run("lab/recorded/measure.py", "--out", folder, *drives)
    for found in folder.iterdir():
        keep_other_drives(found)


@dataclasses.dataclass(frozen=True)
class Kind:
    """A program that measures, all of its parts at once."""

    words: str
    measure: typing.Callable


# In this order: times on a PC first, before the machine is warm and busy.
KINDS = {
    "peers": Kind("Timing other grid libraries on this PC", peers),
    "experiments": Kind("Repeating what the papers claim", experiments),
    "target": Kind("Counting and modelling on the Cortex-A9", target),
    "images": Kind("Weighing the firmware", images),
    "boards": Kind("Counting a frame on each board", boards),
    "a9_model": Kind("Asking the cost model what others know", a9_model),
    "recorded": Kind("Fusing recorded drives", recorded),
}
EXPERIMENTS = tuple(f"experiments/{path.name}" for path in sorted((ROOT / "lab/experiments").iterdir())
                    if path.is_dir())
# Questions of our own choice that are answered. Their pages and tables stay; the programs that measured them stand
# at the commit in lab/data/made_from, and are not in the tree any more.
DECIDED = tuple(f"experiments/{name}" for name in ("detection_quality", "order_of_fusion", "price_of_hits_win"))
TARGET = tuple(f"target/{part}" for part in a9_runs.PARTS)
# KIND or KIND/PART.
STEPS = ("peers", *EXPERIMENTS, *DECIDED, *TARGET, "images", "boards", "a9_model", "recorded")
# Which page shows what was measured by which steps.
PAGES = {
    "results": (*EXPERIMENTS, *DECIDED, *TARGET, "peers"),
    **{f"results/{step.partition('/')[2]}": (step,) for step in (*EXPERIMENTS, *DECIDED)
       if step != "experiments/evidential"},
    "results/traversal": ("experiments/traversal", "target/frames"),
    "results/output_rates": ("experiments/output_rates", "experiments/worst_frames", "target/frames"),
    "results/goals": ("experiments/worst_frames", "target/frames", "target/scaling", "target/sensitivity", "target/turning",
                      "target/perception", "a9_model", "peers"),
    "results/worst_frames": ("experiments/worst_frames", "target/frames"),
    "results/turning": ("target/turning",),
    "results/perception_time": ("target/perception",),
    "results/map_time": ("target/map",),
    "results/objects": ("experiments/objects", "experiments/perception"),
    "results/scaling": ("experiments/worst_frames", "target/scaling"),
    "results/quadtree": ("experiments/quadtree", "target/frames"),
    "results/stream": ("experiments/stream", "target/frames"),
    "results/many_core": ("experiments/many_core", "target/frames"),
    "results/four_cores": ("target/perception", "a9_model"),
    "results/recorded": ("recorded",),
    "evidential": ("experiments/evidential", "target/perception"),
    "figures": ("target/frames", "images", "boards"),
    "a9_model": ("a9_model",),
    "peers": ("peers",),
}


def has_peers() -> bool:
    packages = ("libbenchmark-dev", "libmrpt-maps-dev", "liboctomap-dev")
    return subprocess.run(["dpkg-query", "--show", *packages], check=False,
                          capture_output=True).returncode == 0


def parts_of(kind: str, steps: typing.Iterable[str]) -> list[str]:
    return [part for step in steps for begin, _, part in [step.partition("/")] if begin == kind]


def measure(kind: str, parts: typing.Sequence[str], recordings: typing.Sequence[str] = ()) -> None:
    """Into lab/data, once all of it is there."""
    measured_at = commit()  # before the tables change
    folder = WORK / "measured" / kind
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    KINDS[kind].measure(folder, parts, recordings)
    DATA.mkdir(exist_ok=True)
    if (folder / COUNTED).is_file():
        keep_other_parts(folder / COUNTED, parts)
    for path in sorted(folder.iterdir()):
        shutil.move(path, DATA / path.name)
    write_stamps((f"{kind}/{part}" if part else kind for part in parts), measured_at)


def keep_other_parts(found: pathlib.Path, parts: typing.Sequence[str]) -> None:
    """Adds what lab/data has of other parts of the target, each part in its place."""
    tables = {part: found if part in parts else DATA / COUNTED for part in a9_runs.PARTS}
    rows = {path: list(csv.reader(path.read_text().splitlines()))
            for path in set(tables.values()) if path.is_file()}
    with open(found, "w", newline="") as out:
        csv.writer(out, lineterminator="\n").writerows(
            [list(a9_runs.Row._fields),
             *(row for part, path in tables.items() for row in rows.get(path, [])[1:]
               if a9_runs.part_of(row[0]) == part)])


def keep_other_drives(found: pathlib.Path) -> None:
    """Adds what lab/data has of drives that were not measured now, in the order of their names."""
    rows = list(csv.reader(found.read_text().splitlines()))
    measured = {row[0] for row in rows[1:]}
    stored = DATA / found.name
    if stored.is_file():
        head, *others = csv.reader(stored.read_text().splitlines())
        if head == rows[0]:
            rows += [row for row in others if row[0] not in measured]
    with open(found, "w", newline="") as out:
        csv.writer(out, lineterminator="\n").writerows([rows[0], *sorted(rows[1:], key=lambda row: row[0])])


def commit() -> str:
    """The one that is checked out; with a + if anything outside lab/data and docs was changed since."""
    def git(*words: str):
        return subprocess.run(["git", "-C", ROOT, *words], check=False, text=True, capture_output=True)
    done = git("describe", "--always", "--exclude=*", "--abbrev=8")
    if done.returncode != 0:
        return "an unknown commit"
    is_same = git("diff", "--quiet", "HEAD", "--", ".", ":!lab/data", ":!docs").returncode == 0
    return done.stdout.strip() + ("" if is_same else "+")


def stamps() -> dict[str, str]:
    """By step the commit at which it was measured."""
    return dict(line.split(" ", 1) for line in MADE_FROM.read_text().splitlines()) if MADE_FROM.is_file() else {}


def write_stamps(steps: typing.Iterable[str], measured_at: str) -> None:
    now = {**stamps(), **dict.fromkeys(steps, measured_at)}
    MADE_FROM.write_text("".join(f"{name} {now[name]}\n" for name in sorted(now) if name in STEPS))


def program_of(step: str) -> str:
    """What measures it: a path in the project."""
    if step in ("images", "boards"):
        return f"lab/target/{step}"
    return f"lab/{step}" if step in (*EXPERIMENTS, *DECIDED) else f"lab/{step.partition('/')[0]}"


def complain(program: str, text: str, status: int) -> typing.NoReturn:
    print(f"{program}: {text}", file=sys.stderr)
    sys.exit(status)
