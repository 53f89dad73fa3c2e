#!/usr/bin/python3
"""Makes a report of a drive: one HTML file that needs no other.

  lab/run --recording FILE [--recording FILE]... --vehicle-file CAR.toml [--poses LOG] [--out report.html]

The recordings are captures (pcap, pcapng, .gz, .zst), merged by time. --poses, --poses-mount, --clock-offset and --map
are those of `iog fuse`. The numbers are `iog`'s and those of its stream, which clients/python reads. The same input
gives the same bytes. While it works, it needs room for the stream beside the report: 110 MB a minute with four sensors.
"""

import argparse
import hashlib
import os
import pathlib
import sys
import tempfile
import tomllib

sys.dont_write_bytecode = True
HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parents[1]
sys.path[:0] = [str(HERE), str(ROOT / "lab"), str(ROOT / "lab/pages"), str(ROOT / "clients/python")]

import drawings  # noqa: E402 ; these are found by the paths above
import jinja2  # noqa: E402
import iogrid  # noqa: E402
import measurements  # noqa: E402
import said  # noqa: E402
import sections  # noqa: E402
from drive import Drive, directions_of  # noqa: E402
from said import Failed, Iog, Rows  # noqa: E402

PASSED_ON = ("poses", "poses_mount", "clock_offset", "map")  # to `iog fuse`


def arguments() -> argparse.Namespace:
    parser = argparse.ArgumentParser(prog="lab/run", description=__doc__, allow_abbrev=False,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--recording", action="append", required=True, metavar="FILE", type=pathlib.Path)
    parser.add_argument("--vehicle-file", required=True, metavar="CAR.toml", type=pathlib.Path)
    parser.add_argument("--poses", metavar="LOG")
    parser.add_argument("--poses-mount", nargs="+", metavar=("X Y", "YAW"))
    parser.add_argument("--clock-offset", metavar="SECONDS")
    parser.add_argument("--map", metavar="FILE")
    parser.add_argument("--out", default="report.html", metavar="FILE.html", type=pathlib.Path)
    parser.add_argument("--iog", metavar="PROGRAM", type=pathlib.Path, help="default: build/host's, which is built")
    options = parser.parse_args()
    if options.out.suffix != ".html":
        raise Failed(f"--out {options.out}: the report is an HTML file, so its name has to end in .html")
    if options.out.is_dir():
        raise Failed(f"--out {options.out}: this is a folder")
    if not options.out.absolute().parent.is_dir():
        raise Failed(f"--out {options.out}: there is no folder {options.out.absolute().parent}")
    for path in (*options.recording, options.vehicle_file):
        if not path.is_file():
            raise Failed(f"{path}: there is no such file")
    if options.out.exists() and any(options.out.samefile(path) for path in files_of(options)):
        raise Failed(f"--out {options.out}: this file is read: give another output")
    return options


def files_of(options: argparse.Namespace) -> list[pathlib.Path]:
    """The files that are read; --poses is one, one with a topic behind it (FILE:/topic), or a folder."""
    files = [*options.recording, options.vehicle_file]
    for given in filter(None, (options.poses, options.map)):
        path = pathlib.Path(given)
        path = path if path.exists() else pathlib.Path(given.rpartition(":/")[0] or given)
        files += sorted(each for each in path.rglob("*") if each.is_file()) if path.is_dir() else [path]
    return [path for path in files if path.is_file()]


def built_iog() -> pathlib.Path:
    try:
        measurements.run("toolchain/install", "results")
        measurements.build("host", "iog")
    except measurements.Failed as failure:
        raise Failed(str(failure)) from None
    return measurements.ROOT / "build/host/tools/iog"


def fuse_words(options: argparse.Namespace) -> list[str]:
    words = [word for path in options.recording for word in ("--pcap", str(path))]
    for name in PASSED_ON:
        value = getattr(options, name)
        if value is not None:
            words += ["--" + name.replace("_", "-"), *([value] if isinstance(value, str) else value)]
    return words


def drive_of(stream: pathlib.Path, fused: Rows) -> Drive:
    """Three frames are kept for pictures, of a quarter, the half and three quarters of the drive."""
    frames = int(fused["frames"].split(",")[0])
    drive, receiver = Drive({frames * quarter // 4 for quarter in (1, 2, 3)}), iogrid.Receiver()
    begin_us = None
    for frame in iogrid.replay(str(stream), receiver=receiver):
        begin_us = frame.closed_us if begin_us is None else begin_us
        drive.add(frame, (frame.closed_us - begin_us) / 1e6)
    if receiver.dropped or receiver.lost or len(drive.frames) != frames or not drive.frames.is_whole.all():
        raise Failed(f"an error of iogrid: of {frames} frames that `iog fuse` wrote, {len(drive.frames)} could be read")
    return drive


def digest_of(path: pathlib.Path) -> str:
    with open(path, "rb") as file:
        return hashlib.file_digest(file, "sha256").hexdigest()


def page_of(options: argparse.Namespace, work: pathlib.Path) -> str:
    iog, words = Iog(options.iog or built_iog()), fuse_words(options)
    print("Fusing the recording", flush=True)
    stream = work / "stream.pcap"
    fused = Rows(iog.said("fuse", *words, "--vehicle-file", options.vehicle_file, "--stream", stream))
    text = options.vehicle_file.read_text(encoding="utf-8")
    car = tomllib.loads(text)
    print("Reading the frames", flush=True)
    drive = drive_of(stream, fused)
    print("Drawing", flush=True)
    environment = jinja2.Environment(loader=jinja2.FileSystemLoader(HERE), undefined=jinja2.StrictUndefined,
                                     trim_blocks=True, lstrip_blocks=True, autoescape=True)
    environment.globals.update(sections=sections, drawings=drawings, said=said, directions_of=directions_of)
    return environment.get_template("page.html.j2").render(
        car=car, fused=fused, remarks=list(iog.remarks), drive=drive,
        recordings=[(path.name, iog.said("info", path, "--vehicle-file", options.vehicle_file)) for path in options.recording],
        fates=said.fates_by_sensor(iog, words, text, car, work),
        budget=iog.said("budget", "--vehicle-file", options.vehicle_file),
        cores=said.cores_of(iog.told("budget", "--all", "--vehicle-file", options.vehicle_file), car["name"]),
        version=iog.said("--version").strip(), commit=measurements.commit(),
        inputs=[(path.name, path.stat().st_size, digest_of(path)) for path in files_of(options)],
        settings={name: getattr(options, name) for name in PASSED_ON if getattr(options, name) is not None})


def main() -> None:
    try:
        options = arguments()
        with tempfile.TemporaryDirectory(prefix=".report_", dir=options.out.absolute().parent) as work:
            made = pathlib.Path(work) / "report.html"
            made.write_text(page_of(options, pathlib.Path(work)), encoding="utf-8", errors="replace")
            os.replace(made, options.out)
    except (Failed, OSError, tomllib.TOMLDecodeError) as failure:
        measurements.complain("lab/run", str(failure), 2)
    except KeyboardInterrupt:
        sys.exit(130)
    print(os.fsencode(options.out).decode(errors="replace"))


if __name__ == "__main__":
    main()
