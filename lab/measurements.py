"""What lab/run measures and lab/check measures again: which steps there are, what they write into
lab/data, and from which sources."""

import dataclasses
import hashlib
import pathlib
import shutil
import subprocess
import sys
import typing

ROOT = pathlib.Path(__file__).resolve().parents[1]
DATA = ROOT / "lab/data"
WORK = ROOT / "build/lab"
MADE_FROM = DATA / "made_from"

# What figures and the laboratory's tests depend on. Words (lab/pages, *.md) do not change them, and
# those rooms of tools/ that no experiment links have no part in them. What lab/pages makes of
# lab/data is no source of it.
SOURCES = ("CMakeLists.txt", "CMakePresets.json", "board", "hal", "lab", "linker", "qemu", "src",
           "tests/CMakeLists.txt", "tests/e2e/wrong_use", "tests/host/fakes", "tests/host/lab",
           "tests/host/tools/drive_sample.cpp", "tests/host/tools/drive_sample.hpp",
           "tests/list_suites.cmake", "tests/programmer_error.cpp", "tests/target/start.S",
           "tests/test_headers.cpp", "toolchain", "tools", "vehicles")
NOT_SOURCES = ("lab/check", "lab/data", "lab/pages", "lab/run", "tests/host/lab/pages",
               "tools/budget/unit_costs.hpp", "tools/info", "tools/record", "tools/replay", "tools/view")
# What lab/peers times, what that is made of, and what makes the beams.
PEERS_SOURCES = ("CMakeLists.txt", "CMakePresets.json", "lab/baseline", "lab/evidence", "lab/peers",
                 "lab/reference", "src", "tools/simulate", "tools/vehicles", "vehicles")


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


def experiments(folder: pathlib.Path, recordings: typing.Sequence[str] = ()) -> None:
    build("host", "experiments")
    given = [word for recording in recordings for word in ("--recording", recording)]
    run("build/host/lab/experiments/experiments", "--out", folder, *given)


def target(folder: pathlib.Path, _recordings=()) -> None:
    run("lab/target/measure_a9", "--out", folder)


def build_images() -> None:
    vehicles = sorted(path.stem for path in (ROOT / "vehicles").glob("*.toml"))
    build("imx6", *(f"iogrid-{vehicle}" for vehicle in vehicles))


def images(folder: pathlib.Path, _recordings=()) -> None:
    """The firmware runs for two seconds, too, and says how deep its stack was."""
    build_images()
    report = WORK / "qemu/summary.txt"
    run("qemu/run", "--seconds", 2, "--out", report.parent, out=WORK / "qemu.txt")
    run("lab/target/images", "build/imx6/board/imx6", report, out=folder / "images.csv")


def a9_model(folder: pathlib.Path, _recordings=()) -> None:
    build("host", "a9_model", "a9_constants")
    build("imx6", "a9_micro")
    model = ROOT / "build/host/lab/a9_model"
    run(model / "a9_constants", "--csv", out=folder / "a9_constants.csv")
    run("lab/a9_model/check", model / "liba9_model.so", "build/imx6/lab/a9_model/a9_micro", "--csv",
        out=folder / "a9_answers.csv")


def peers(folder: pathlib.Path, _recordings=()) -> None:
    run("lab/peers/run", "--out", folder)


@dataclasses.dataclass(frozen=True)
class Step:
    words: str
    measure: typing.Callable


# In this order: times on a PC first, before the machine is warm and busy.
STEPS = {
    "peers": Step("Timing other grid libraries on this PC", peers),
    "experiments": Step("Repeating what the papers claim", experiments),
    "target": Step("Counting and modelling on the Cortex-A9", target),
    "images": Step("Weighing the firmware", images),
    "a9_model": Step("Asking the cost model what others know", a9_model),
}
# Which page shows what was measured by which steps.
PAGES = {"results": ("experiments", "target"), "evidential": ("experiments", "target"),
         "figures": ("target", "images"), "a9_model": ("a9_model",), "peers": ("peers",)}


def has_peers() -> bool:
    packages = ("libbenchmark-dev", "libmrpt-maps-dev", "liboctomap-dev")
    return subprocess.run(["dpkg-query", "--show", *packages], check=False,
                          capture_output=True).returncode == 0


def measure(name: str, recordings: typing.Sequence[str] = ()) -> None:
    """Into lab/data, once all of it is there."""
    folder = WORK / "measured" / name
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    STEPS[name].measure(folder, recordings)
    DATA.mkdir(exist_ok=True)
    for path in sorted(folder.iterdir()):
        shutil.move(path, DATA / path.name)
    write_stamp(name)


def files_of(room: str) -> list[pathlib.Path]:
    place = ROOT / room
    found = [place] if place.is_file() else sorted(place.rglob("*"))
    return [path for path in found if path.is_file() and is_source(path)]


def is_source(path: pathlib.Path) -> bool:
    name = path.relative_to(ROOT).as_posix()
    return not (path.suffix in (".md", ".pyc") or
                any(name == other or name.startswith(f"{other}/") for other in NOT_SOURCES))


def digest(paths: list[pathlib.Path]) -> str:
    total = hashlib.sha256()
    for path in paths:
        content = hashlib.sha256(path.read_bytes()).hexdigest()
        total.update(f"{path.relative_to(ROOT).as_posix()} {content}\n".encode())
    return total.hexdigest()


def sources(step: str = "") -> str:
    """One number for the content of all that the figures of a step depend on."""
    rooms = PEERS_SOURCES if step == "peers" else SOURCES
    return digest([path for room in rooms for path in files_of(room)])


def tables() -> str:
    """The same for lab/data itself: a table that was edited is one that has to be checked."""
    return digest(sorted(path for path in DATA.iterdir() if path != MADE_FROM))


def stamps() -> dict[str, str]:
    if not MADE_FROM.is_file():
        return {}
    return dict(line.split(" ", 1) for line in MADE_FROM.read_text().splitlines() if " " in line)


def write_stamp(step: str) -> None:
    """lab/data/made_from: per step the sources that its tables were measured from."""
    now = {**stamps(), step: sources(step), "tables": tables()}
    MADE_FROM.write_text("".join(f"{name} {now[name]}\n" for name in sorted(now)))


def what_changed() -> str:
    """In words, what lab/data is not of; empty if it is of these sources. Times of other libraries
    are not among it: nobody can measure them again and compare."""
    kept, now = stamps(), sources()
    stale = [name for name in STEPS if name != "peers" and kept.get(name) != now]
    if stale:
        return f"other sources than lab/data was made from ({', '.join(stale)})"
    return "" if kept.get("tables") == tables() else "a table of lab/data was changed by hand"


def are_peers_current() -> bool:
    return stamps().get("peers") == sources("peers")


def complain(program: str, text: str, status: int) -> typing.NoReturn:
    print(f"{program}: {text}", file=sys.stderr)
    sys.exit(status)
