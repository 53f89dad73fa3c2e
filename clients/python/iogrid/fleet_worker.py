"""The functions that a worker of iogrid.fleet runs for a recording. They are sent to the workers, which need `iog`,
util-linux and Dask distributed, but not iogrid."""

import csv
import http.client
import os
import pathlib
import subprocess
import tempfile
import time
import urllib.error
import urllib.request

import distributed

URLS = ("http://", "https://")
SILENCE_S = 60  # without an answer from a server or from `iog --version`
TEXT = {"encoding": "utf-8", "errors": "surrogateescape"}  # a path may be any bytes


class NoRow(Exception):
    """There is no row. Contains the reason, and whether another try may succeed."""


def answer_of(job: dict, place: str) -> dict:
    """Runs `iog batch` on a recording (a path or URL). Returns the version of `iog`, the row and the settings of the
    table or the reason why there is no row, and whether another try may succeed. If the job requires a version, any
    other version of `iog` does not run."""
    begin = time.monotonic()
    answer = {"worker": distributed.get_worker().address, "version": "", "settings": "", "row": {}, "reason": "",
              "may_differ": False}
    try:
        answer["version"] = version_of(job["iog"])
        if job["version"] in ("", answer["version"]):
            answer["row"], answer["settings"] = row_of(job, place, begin + job["timeout_s"])
            answer["may_differ"] = answer["row"]["reason"].startswith(("cannot be read", "ended by signal"))
    except NoRow as error:
        answer["reason"], answer["may_differ"] = error.args
    except OSError as error:  # such as a full disk
        answer["reason"], answer["may_differ"] = f"worker {answer['worker']}: {error}", True
    return answer | {"seconds": time.monotonic() - begin}


def version_of(iog: str) -> str:
    try:
        return subprocess.run([iog, "--version"], stdin=subprocess.DEVNULL, capture_output=True, check=True,
                              timeout=SILENCE_S, **TEXT).stdout.strip()
    except (OSError, subprocess.SubprocessError) as error:
        raise NoRow(f"{iog} --version: {error}", True) from None


def row_of(job: dict, place: str, end: float) -> tuple[dict[str, str], str]:
    """Downloads a URL to an unnamed file, which disappears with the process."""
    with tempfile.TemporaryDirectory(prefix="iogrid-", dir=distributed.get_worker().local_directory) as folder:
        if not place.startswith(URLS):
            return batch_of(job, place, folder, end)
        with tempfile.TemporaryFile(dir=folder) as file:
            fetch(place, file, end)
            path = f"/dev/fd/{file.fileno()}"
            row, settings = batch_of(job, path, folder, end, (file.fileno(),))
            return {key: text.replace(path, place) for key, text in row.items()}, settings


def fetch(url: str, file, end: float) -> None:
    def failed(why, may_differ: bool) -> NoRow:
        return NoRow(f"cannot be fetched: {why}", may_differ)

    try:
        with urllib.request.urlopen(url, timeout=SILENCE_S) as answer:
            size = int(answer.headers.get("Content-Length", -1))
            while part := answer.read1(1 << 20):
                file.write(part)
                if time.monotonic() > end:
                    raise failed("the server is too slow", False)
        file.flush()
    except urllib.error.HTTPError as error:
        raise failed(error, error.code >= 500 or error.code in (408, 429)) from None
    except (ValueError, http.client.InvalidURL) as error:
        raise failed(error, False) from None
    except (OSError, http.client.HTTPException) as error:
        raise failed(error, True) from None
    if size not in (-1, file.tell()):
        raise failed(f"{file.tell()} of {size} bytes", True)


def batch_of(job: dict, place: str, folder: str, end: float, files: tuple = ()) -> tuple[dict[str, str], str]:
    """Runs `iog`, which is killed when this process ends, because nobody would then read its table."""
    inputs, out = pathlib.Path(folder, "in"), pathlib.Path(folder, "out")
    inputs.mkdir()
    (inputs / "list.txt").write_bytes(os.fsencode(place) + b"\n")
    command = ["setpriv", "--pdeathsig", "KILL", job["iog"], "batch", inputs / "list.txt", "--out", out, "-j", "1"]
    if job["car"] is not None:
        car = inputs / job["car_name"]
        car.write_bytes(job["car"])
        command += ["--vehicle-file", car]
    try:
        run = subprocess.run([*command, *job["options"]], stdin=subprocess.DEVNULL, capture_output=True, check=False,
                             pass_fds=files, start_new_session=True, timeout=max(end - time.monotonic(), 0), **TEXT)
    except subprocess.TimeoutExpired:
        raise NoRow(f"not done in {job['timeout_s']:g} s", False) from None
    if (out / "summary.csv").exists():
        with open(out / "summary.csv", newline="", **TEXT) as table:
            if row := next(csv.DictReader(table), None):
                return row, (out / "batch.txt").read_text(**TEXT)
    said = f"ended with status {run.returncode}"
    for line in run.stderr.splitlines():
        said = said if line.startswith("Run with --help") else line
    raise NoRow(said.removeprefix("iog: ").replace(f"{inputs}/", ""), run.returncode < 0)
