#!/usr/bin/python3
"""How far `iog odometry` is from the poses of a drive: rows of the table in docs/recordings.md.

  lab/recorded/odometry.py CAPTURE CAR.toml [CAPTURE CAR.toml]...    captures, or .xz of them, with poses (UDP 15010)
  lab/recorded/odometry.py --simulated                               30 s of each scene with a VLP-16 and exact poses

Both trajectories begin at the first pose of the odometry. Below the table are the errors within a second, as root mean
squares in the sigmas that the log states. Times are those of the processor. Needs `iog` of build/host.
"""

import argparse
import collections
import lzma
import pathlib
import resource
import struct
import subprocess
import sys
import tempfile

import numpy as np

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.append(str(ROOT / "clients/python"))
from iogrid.captures import datagrams  # noqa: E402 ; it is found by the path above

IOG = ROOT / "build/host/tools/iog"
SCENES = ("city", "hills", "street", "ring_road")
POSE_PORT = 15010
TIME, X, Y, HEADING = range(4)
SIGMA, SIGMA_HEADING = 6, 7  # columns of the log


def poses_in(capture: pathlib.Path) -> np.ndarray:
    """Seconds, metres and radians of each pose message (docs/spec.md, 5.1)."""
    messages = [struct.unpack_from(">QiiI", payload, 40)
                for payload in datagrams(str(capture), POSE_PORT, collections.Counter())]
    if not messages:
        raise ValueError("no poses in it")
    table = np.array(messages) / [1e6, 1e3, 1e3, 2**32 / (2 * np.pi)]
    table[:, HEADING] = np.unwrap(table[:, HEADING])
    return table


def motion(log: np.ndarray, first: np.ndarray, last: np.ndarray) -> np.ndarray:
    """x, y and turn between two rows each, seen from the first."""
    step = log[last] - log[first]
    cosine, sine = np.cos(log[first, HEADING]), np.sin(log[first, HEADING])
    return np.stack([cosine * step[:, X] + sine * step[:, Y], cosine * step[:, Y] - sine * step[:, X],
                     step[:, HEADING]], axis=1)


def errors(found: np.ndarray, true: np.ndarray) -> tuple[float, float, float, float, float]:
    """Metres driven, error at the end in metres and degrees, and the errors in a second in their sigmas."""
    log = found[(found[:, TIME] >= true[0, TIME]) & (found[:, TIME] <= true[-1, TIME])]
    there = np.stack([log[:, TIME], *(np.interp(log[:, TIME], true[:, TIME], true[:, column])
                                      for column in (X, Y, HEADING))], axis=1)
    off = np.abs(motion(log, np.array([0]), np.array([-1])) - motion(there, np.array([0]), np.array([-1])))[0]
    metres = np.hypot(np.diff(there[:, X]), np.diff(there[:, Y])).sum()
    last = np.flatnonzero(log[:, TIME] >= log[0, TIME] + 1)
    first = np.searchsorted(log[:, TIME], log[last, TIME] - 1)
    within = motion(log, first, last) - motion(there, first, last)
    place = within[:, :2] / log[last, SIGMA, None]
    turn = np.degrees(within[:, 2]) / log[last, SIGMA_HEADING]
    return (metres, np.hypot(*off[:2]), np.degrees(off[2]), np.sqrt(np.mean(place**2)), np.sqrt(np.mean(turn**2)))


def processor_s() -> float:
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


def row_of(name: str, capture: bytes, car: pathlib.Path, work: pathlib.Path) -> tuple[str, str]:
    drive, log = work / "drive.pcap", work / "log.csv"
    drive.write_bytes(capture)
    begin_s = processor_s()
    subprocess.run([IOG, "odometry", "--pcap", drive, "--vehicle-file", car, "--out", log], check=True,
                   stdout=subprocess.DEVNULL)
    took_s = processor_s() - begin_s
    found = np.loadtxt(log, delimiter=",", skiprows=1)
    found[:, HEADING] = np.unwrap(np.radians(found[:, HEADING]))
    metres, off_m, off_deg, place, turn = errors(found, poses_in(drive))
    share = took_s / (found[-1, TIME] - found[0, TIME])
    return (f"| {name} | {metres:.0f} m | {100 * off_m / metres:.2f} % | {off_deg:.2f}° | {share:.1f} × |",
            f"{name}: within a second {place:.2f} sigma of the position, {turn:.2f} of the heading")


def drives_of(options: argparse.Namespace, work: pathlib.Path):
    """Name, bytes and car of each."""
    for path, car in zip(options.drives[::2], options.drives[1::2]):
        data = path.read_bytes()
        yield path.name.split(".")[0], lzma.decompress(data) if path.suffix == ".xz" else data, car
    for scene in SCENES if options.simulated else ():
        made = work / "made.pcap"
        subprocess.run([IOG, "simulate", "--vehicle", "roof_vlp16", "--moving", "--scene", scene, "--seconds", "30",
                        "--pose-sigma", "0", "--pose-heading-sigma", "0", "--out", made], check=True,
                       stdout=subprocess.DEVNULL)
        yield scene, made.read_bytes(), ROOT / "vehicles/roof_vlp16.toml"


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("drives", metavar="CAPTURE CAR.toml", type=pathlib.Path, nargs="*")
    parser.add_argument("--simulated", action="store_true")
    options = parser.parse_args()
    if len(options.drives) % 2 or not (options.drives or options.simulated):
        parser.error("each capture needs its car")
    words = []
    with tempfile.TemporaryDirectory() as folder:
        print("| drive | distance | error at the end | heading error | time |\n|---|--:|--:|--:|--:|")
        for name, capture, car in drives_of(options, pathlib.Path(folder)):
            try:
                row, errors_in_sigmas = row_of(name, capture, car, pathlib.Path(folder))
            except (OSError, ValueError, struct.error, subprocess.CalledProcessError) as error:
                sys.exit(f"odometry.py: {name} with {car}: {error}")
            print(row, flush=True)
            words.append(errors_in_sigmas)
    print("\n" + "\n".join(words))


if __name__ == "__main__":
    main()
