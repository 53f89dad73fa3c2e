"""Many recordings on many machines: `iog batch`, run by the workers of a Dask cluster (docs/batch.md).

    python3 -m iogrid.fleet LIST.txt --vehicle-file CAR.toml --out RESULTS --scheduler tcp://10.0.0.5:8786

The table has the format of `iog batch`. Each of the two programs can continue a table of the other.
"""

import argparse
import collections
import contextlib
import csv
import dataclasses
import fcntl
import io
import json
import logging
import os
import pathlib
import signal
import sys
import tempfile
import time

try:
    import cloudpickle
    import distributed
except ModuleNotFoundError as error:
    missing = (f"iogrid.fleet needs Dask distributed (there is no Python module {error.name}): "
               "apt install python3-distributed, or pip install 'iogrid[fleet]'")
    if __name__ == "__main__":
        sys.exit(missing)
    raise ImportError(missing) from None

from iogrid import fleet_worker
from iogrid.fleet_worker import TEXT, URLS

cloudpickle.register_pickle_by_value(fleet_worker)
ENDINGS = tuple(kind + packer for kind in (".pcap", ".pcapng") for packer in ("", ".gz", ".zst"))
PASSED_ON = {"--vehicle": 1, "--rule": 1, "--map": 1, "--poses-mount": 3, "--clock-offset": 1}  # options, words of each
MOST_AT_ONCE = 2000  # recordings at the scheduler, each with the car file
POLL_S, LOOK_S, CONNECT_S = 0.05, 2, 10


class FleetError(Exception):
    """The reason why the table cannot be made or completed."""


class Unfinished(FleetError):
    """The run stopped early, and the same command continues it."""


@dataclasses.dataclass(frozen=True)
class Recording:
    name: str  # in the table
    place: str  # a path or URL


def recordings_of(folder_or_list: str) -> list[Recording]:
    """Finds recordings like `iog batch` and sorts them by size, largest first. A line of a list may also be a URL."""
    is_folder = os.path.isdir(folder_or_list)
    names = in_folder(folder_or_list) if is_folder else in_list(folder_or_list)
    if not names:
        raise FleetError(f"{folder_or_list}: " + ("no capture (.pcap, .pcapng; also .gz or .zst)" if is_folder else
                                                  "this list names no recording"))
    top = os.path.abspath(folder_or_list if is_folder else os.path.dirname(folder_or_list))
    found: dict[str, str] = {}
    for name in names:
        found.setdefault(name if name.startswith(URLS) else os.path.normpath(os.path.join(top, name)), name)
    by_size = sorted((-size_of(place), name, place) for place, name in found.items())
    return [Recording(name, place) for _, name, place in by_size]


def in_folder(folder: str) -> list[str]:
    def stop(error: OSError):
        raise FleetError(f"{error.filename}: cannot be listed: {error.strerror}")

    return [os.path.relpath(os.path.join(above, name), folder) for above, _, names in os.walk(folder, onerror=stop)
            for name in names if name.endswith(ENDINGS)]


def in_list(path: str) -> list[str]:
    text = bytes_of(path).decode(**TEXT)
    if "\0" in text:
        raise FleetError(f"{path}: a list of recordings is a text file with one path or URL on each line")
    return [name for line in text.split("\n") if (name := line.rstrip("\r"))]


def bytes_of(path: str) -> bytes:
    try:
        return pathlib.Path(path).read_bytes()
    except OSError as error:
        raise FleetError(f"{path}: cannot be read: {error.strerror}") from None


def size_of(place: str) -> int:
    with contextlib.suppress(OSError):
        return os.stat(place).st_size
    return 0


class Table:
    """RESULTS/summary.csv. A lock lets one program at a time write it. Incomplete rows are removed."""

    def __init__(self, folder: str, settings: str, columns: list[str]):
        self.path, self.columns = pathlib.Path(folder, "summary.csv"), columns
        of_rows = pathlib.Path(folder, "batch.txt")
        self.path.parent.mkdir(parents=True, exist_ok=True)
        self.file = open(self.path, "a+b", buffering=0)  # noqa: SIM115
        try:
            fcntl.flock(self.file, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except BlockingIOError:
            raise FleetError(f"{self.path}: another program is writing this table") from None
        self.file.seek(0)
        known = self.file.read()
        if not known:
            of_rows.write_text(settings, **TEXT)
            known = self._append(columns)
        elif not of_rows.exists() or of_rows.read_text(**TEXT) != settings:
            raise FleetError(f"{self.path}: its rows come from another car, other options or another iog, see {of_rows}; "
                             "give another --out")
        end = at = quotes = 0
        for line in io.BytesIO(known):
            at, quotes = at + len(line), quotes + line.count(b'"')
            if line.endswith(b"\n") and quotes % 2 == 0:
                end = at
        head, *rows = csv.reader(io.StringIO(known[:end].decode(**TEXT), newline="")) if end else [[]]
        if head != columns:
            raise FleetError(f"{self.path}: this iog batch did not write this table; give another --out")
        self.file.truncate(end)
        self.status = {row[0]: row[1] for row in rows}

    def add(self, row: dict[str, str]) -> None:
        self._append([row.get(column, "") for column in self.columns])
        self.status[row["name"]] = row["status"]

    def _append(self, fields: list[str]) -> bytes:
        csv.writer(text := io.StringIO(newline="")).writerow(fields)  # \r\n at its end: so both are quoted in a field
        row = text.getvalue()[:-2].encode(**TEXT) + b"\n"
        if self.file.write(row) != len(row):
            raise FleetError(f"{self.path}: cannot be written any more")
        return row

    def close(self) -> None:
        self.file.close()


def checked(client: distributed.Client, job: dict, patience_s: float) -> tuple[dict, str, list[str]]:
    """Returns the job with the version of `iog` on all workers, and the settings and columns of the table. To get
    these, each worker runs `iog batch` on a recording that does not exist."""
    futures: dict[str, distributed.Future] = {}
    with contextlib.suppress(TimeoutError):
        client.wait_for_workers(1, timeout=patience_s)
        futures = {worker: client.submit(fleet_worker.answer_of, job, "missing.pcap", workers=[worker], pure=False,
                                         priority=1) for worker in client.scheduler_info()["workers"]}
        distributed.wait(list(futures.values()), timeout=patience_s)
    if not futures:
        raise FleetError(f"no worker has come to {client.scheduler.address} in {patience_s:g} s")
    answers = [answer_in(worker, future, patience_s) for worker, future in futures.items()]
    versions = collections.defaultdict(list)
    for answer in answers:
        versions[answer["version"]].append(answer["worker"])
    if len(versions) > 1:
        raise FleetError("the workers have different versions of iog: " +
                         "; ".join(f"{version} on {few(workers)}" for version, workers in sorted(versions.items())))
    for answer in answers:
        if not (reason := answer["reason"] or answer["row"]["reason"]).startswith("cannot be read"):
            raise FleetError(f"worker {answer['worker']}: {reason}")
    return job | {"version": answer["version"]}, answer["settings"], list(answer["row"])


def answer_in(worker: str, future: distributed.Future, patience_s: float) -> dict:
    """Raises FleetError if the worker cannot run `iog`."""
    if future.status == "error":
        raise FleetError(f"worker {worker}: {future.exception(timeout=LOOK_S)}")
    if future.status != "finished":
        raise FleetError(f"worker {worker} has not answered in {patience_s:g} s")
    answer = future.result(timeout=LOOK_S)
    if not answer["version"]:
        raise FleetError(f"worker {worker}: {answer['reason']}")
    return answer


def few(workers: list[str]) -> str:
    return ", ".join(workers[:3]) + (f" and {len(workers) - 3} more" if len(workers) > 3 else "")


class Run:
    """Processes the recordings that have no row yet, and tracks those that the workers have received."""

    def __init__(self, client: distributed.Client, job: dict, table: Table, retries: int):
        self.client, self.job, self.table, self.retries = client, job, table, retries
        self.tries: collections.Counter[Recording] = collections.Counter()
        self.given: dict[str, Recording] = {}  # by the key of the future
        self.answers = distributed.as_completed(with_results=True, raise_errors=False)

    def all_of(self, recordings: list[Recording], settings: str, patience_s: float) -> None:
        """Raises FleetError if the run cannot continue. The rows written so far remain."""
        left, begin = collections.deque(recordings), time.monotonic()
        seen = look = begin
        while left or self.given:
            while left and len(self.given) < MOST_AT_ONCE:
                self.give(left.popleft())
            for future, answer in (batch := self.answers.next_batch(block=False)):
                recording = self.given.pop(future.key)
                if future.status not in ("finished", "error"):
                    raise FleetError("the scheduler is gone")
                if again := self.take(recording, self.outcome(future, answer), settings):
                    left.append(again)
            progress(len(recordings) - len(left) - len(self.given), len(recordings), time.monotonic() - begin)
            if not batch:
                time.sleep(POLL_S)
            if (now := time.monotonic()) > look:
                look = now + LOOK_S
                seen = now if self.client.scheduler_info()["workers"] else seen
                if now - seen > patience_s:
                    raise FleetError(f"no worker is left, and none has come in {patience_s:g} s")

    def give(self, recording: Recording) -> None:
        self.tries[recording] += 1
        future = self.client.submit(fleet_worker.answer_of, self.job, recording.place, pure=False)
        self.given[future.key] = recording
        self.answers.add(future)

    def outcome(self, future: distributed.Future, answer) -> dict:
        """The worker's answer, or a failure. If a worker dies, Dask retries elsewhere a limited number of times."""
        if future.status == "finished":
            return answer
        error = answer[1]
        is_killed = isinstance(error, distributed.KilledWorker)
        reason = "each worker that had it died" if is_killed else f"{type(error).__name__}: {error}"
        return {"reason": reason, "may_differ": not is_killed, "version": self.job["version"], "row": {}, "seconds": 0}

    def take(self, recording: Recording, answer: dict, settings: str) -> Recording | None:
        """Writes the row, or returns the recording if it is to be tried again."""
        row = answer["row"]
        if answer["version"] not in ("", self.job["version"]) or (row and answer["settings"] != settings):
            raise FleetError(f"worker {answer['worker']} has {answer['version']}, and the others {self.job['version']}")
        if answer["may_differ"] and self.tries[recording] <= self.retries:
            return recording
        row = row or {"status": "failed", "reason": answer["reason"], "seconds": f"{answer['seconds']:.2f}"}
        self.table.add(row | {"name": recording.name})
        if row["status"] != "done":
            said = f"{recording.name}: {row['reason']}"
            print("iogrid.fleet:", "".join(c if c.isprintable() else "?" for c in said), file=sys.stderr)
        return None


def progress(done: int, total: int, seconds: float) -> None:
    if sys.stderr.isatty():
        left = f", {seconds * (total - done) / done / 60:.1f} min left" if done and done < total else ""
        print(f"\r\033[K{done} of {total} recordings{left}", end="" if done < total else "\n", file=sys.stderr)


def run(client: distributed.Client, recordings: list[Recording], out: str, car_file: str | None = None,
        options: list[str] = (), *, iog: str = "iog", retries: int = 2, timeout_s: float = 6 * 3600,
        patience_s: float = 300) -> dict[str, str]:
    """Returns the status ("done" or "failed") of each recording in out/summary.csv. `options` are those of `iog batch`.
    If the table is incomplete, FleetError gives the reason, and the same call continues the table."""
    car = bytes_of(car_file) if car_file else None
    job = {"iog": iog, "version": "", "options": list(options), "timeout_s": timeout_s, "car": car,
           "car_name": os.path.basename(car_file or "")}
    with client.as_current(), contextlib.ExitStack() as stack:
        job, settings, columns = checked(client, job, patience_s)
        table = stack.enter_context(contextlib.closing(Table(out, settings, columns)))
        if car is not None:
            pathlib.Path(out, job["car_name"]).write_bytes(car)
        left = [each for each in recordings if each.name not in table.status]
        try:
            Run(client, job, table, retries).all_of(left, settings, patience_s)
        except (FleetError, OSError, KeyboardInterrupt) as error:
            count = sum(each.name not in table.status for each in recordings)
            raise Unfinished(f"{str(error) or 'interrupted'}: the same command continues with the remaining {count} "
                             "recordings") from None
        return table.status


def number(kind: type, most: float):
    def of(text: str):
        if not 0 < (value := kind(text)) <= most:
            raise argparse.ArgumentTypeError(f"{text} is not above 0 and at most {most:g}")
        return value

    return of


def options_of(arguments: list[str] | None) -> argparse.Namespace:
    parser = argparse.ArgumentParser(
        prog="python3 -m iogrid.fleet", description=__doc__.split("\n", maxsplit=1)[0],
        epilog="The other options are those of `iog batch`. A Dask cluster runs what anybody sends to it: use it only in "
               "a network that you trust.")
    parser.add_argument("recordings", metavar="FOLDER | LIST_FILE", help="as of iog batch; a list may have http URLs")
    parser.add_argument("--out", required=True, metavar="FOLDER", help="for summary.csv, one row per recording")
    parser.add_argument("--vehicle-file", metavar="CAR.toml")
    for name, words in PASSED_ON.items():
        parser.add_argument(name, nargs=words, metavar="X")
    where = parser.add_mutually_exclusive_group()
    where.add_argument("--scheduler", metavar="ADDRESS | FILE.json", help="of Dask; default: workers of this PC")
    where.add_argument("--host", default="127.0.0.1", help="address on which the scheduler and the workers of this PC "
                       "listen (default 127.0.0.1)")
    parser.add_argument("--workers", type=number(int, 1024), default=len(os.sched_getaffinity(0)), metavar="N",
                        help="of this PC (default one per processor)")
    parser.add_argument("--iog", default="iog", metavar="PROGRAM", help="on the workers (default iog)")
    parser.add_argument("--retries", type=int, default=2, metavar="N", help="of a recording that cannot be read or "
                        "fetched, or whose process crashes (default 2)")
    parser.add_argument("--timeout", type=number(float, 1e7), default=6 * 3600, metavar="S", help="for one recording "
                        "(default 6 hours)")
    parser.add_argument("--patience", type=number(float, 1e7), default=300, metavar="S", help="without any worker "
                        "(default 300)")
    return parser.parse_args(arguments)


def passed_on(options: argparse.Namespace) -> list[str]:
    """The options for `iog batch`."""
    words = []
    for name in PASSED_ON:
        if values := getattr(options, name[2:].replace("-", "_")):
            words += [name, *(map(os.path.abspath, values) if name == "--map" else values)]
    return words


@contextlib.contextmanager
def connected(options: argparse.Namespace):
    with contextlib.ExitStack() as stack:
        address = options.scheduler
        try:
            if address is None:
                address = stack.enter_context(local_cluster(options.host, options.workers)).scheduler_address
            elif address.endswith(".json"):
                address = json.loads(bytes_of(address))["address"]
            distributed.comm.get_address_host(address)  # a Client without a valid address would wait for a minute
            client = distributed.Client(address, timeout=CONNECT_S, set_as_default=False)
        except (OSError, RuntimeError, ValueError, TypeError, KeyError) as error:
            raise FleetError(f"no Dask scheduler at {address or options.host}: {error}") from None
        yield stack.enter_context(client)


@contextlib.contextmanager
def local_cluster(host: str, workers: int):
    """Sets both dashboard addresses, because Dask's default is 0.0.0.0. Workers inherit that SIGINT is ignored."""
    handler = signal.signal(signal.SIGINT, signal.SIG_IGN)
    with tempfile.TemporaryDirectory(prefix="iogrid-fleet-") as folder, distributed.LocalCluster(
            host=host, n_workers=workers, threads_per_worker=1, local_directory=folder, silence_logs=logging.CRITICAL,
            dashboard_address=f"{host}:0", worker_dashboard_address=f"{host}:0") as cluster:
        signal.signal(signal.SIGINT, handler)
        yield cluster


def main(arguments: list[str] | None = None) -> int:
    options = options_of(arguments)
    logging.getLogger("distributed").setLevel(logging.CRITICAL)  # FleetError reports the error in one line
    signal.signal(signal.SIGTERM, signal.default_int_handler)
    try:
        recordings = recordings_of(options.recordings)
        with connected(options) as client:
            status = run(client, recordings, options.out, options.vehicle_file, passed_on(options), iog=options.iog,
                         retries=options.retries, timeout_s=options.timeout, patience_s=options.patience)
    except (FleetError, OSError, KeyboardInterrupt) as error:
        print(f"iogrid.fleet: {str(error) or 'interrupted'}", file=sys.stderr)
        return 1 if isinstance(error, (Unfinished, KeyboardInterrupt)) else 2
    failed = sum(each == "failed" for each in status.values())
    print(f"{len(status)} recordings, {failed} failed: {options.out}/summary.csv")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
