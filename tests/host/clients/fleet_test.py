"""Does a Dask cluster on 127.0.0.1 make the table of `iog batch`, whatever happens to a worker or a recording?"""

import contextlib
import csv
import functools
import http.server
import os
import pathlib
import shutil
import subprocess
import sys
import threading
import time
import unittest

import streams

from processes import descendants, is_running, until  # noqa: E402  streams has made tests/e2e known

os.environ["DASK_DISTRIBUTED__COMM__TIMEOUTS__CONNECT"] = "60s"  # a PC that is busy with other work

import distributed  # noqa: E402
from iogrid import fleet  # noqa: E402

PATIENCE_S = 240
CAR = str(streams.ROOT / "vehicles/reference_car.toml")
FOLDER = streams.FOLDER
LISTENING = "0A"  # in /proc/net/tcp


def fresh(name: str) -> pathlib.Path:
    shutil.rmtree(FOLDER / name, ignore_errors=True)
    (FOLDER / name).mkdir(parents=True)
    return FOLDER / name


def rows_of(results: pathlib.Path) -> list[list[str]]:
    """Head and rows without their times, by name."""
    head, *rows = csv.reader(open(results / "summary.csv", newline="", encoding="utf-8"))
    seconds = head.index("seconds")
    return [head, *sorted(row[:seconds] + row[seconds + 1:] for row in rows)]


def by_name(results: pathlib.Path) -> dict[str, dict[str, str]]:
    return {row["name"]: row for row in csv.DictReader(open(results / "summary.csv", newline="", encoding="utf-8"))}


def batch(recordings: pathlib.Path, results: pathlib.Path) -> subprocess.CompletedProcess:
    return subprocess.run([streams.IOG, "batch", recordings, "--vehicle-file", CAR, "--out", results],
                          capture_output=True, text=True, timeout=PATIENCE_S, check=False)


@functools.cache
def tiny() -> bytes:
    """A capture of a few frames, which takes no time."""
    FOLDER.mkdir(parents=True, exist_ok=True)
    streams.capture.write(FOLDER / "tiny.pcap", streams.capture.read(streams.drive())[:60])
    return (FOLDER / "tiny.pcap").read_bytes()


class Cluster:
    """A scheduler and workers, each a process of its own on 127.0.0.1."""

    def __init__(self, folder: pathlib.Path):
        self.folder, self.file, self.started = folder, folder / "scheduler.json", []
        self.start("scheduler", "--port", "0", "--scheduler-file", self.file)

    def start(self, what: str, *options, path: str = "") -> subprocess.Popen:
        log = open(self.folder / f"{what}{len(self.started)}.log", "w")
        process = subprocess.Popen(
            [sys.executable, "-m", f"distributed.cli.dask_{what}", "--host", "127.0.0.1", "--no-dashboard",
             *map(str, options)], stdin=subprocess.DEVNULL, stdout=log, stderr=log, cwd=self.folder,
            env=os.environ | {"PATH": f"{path}:{os.environ['PATH']}"})
        log.close()
        self.started.append(process)
        return process

    def start_worker(self, program: str = str(streams.IOG)) -> subprocess.Popen:
        """Its iog is this program."""
        place = self.folder / f"worker{len(self.started)}"
        (place / "bin").mkdir(parents=True)
        (place / "bin/iog").symlink_to(program)
        return self.start("worker", "--scheduler-file", self.file, "--nthreads", "1", "--no-nanny", "--death-timeout",
                          "60", "--local-directory", place / "space", path=str(place / "bin"))

    def client(self) -> distributed.Client:
        until(self.file.exists, "no scheduler")
        return distributed.Client(scheduler_file=str(self.file), timeout=60, set_as_default=False)

    def end(self) -> None:
        for process in reversed(self.started):
            process.kill()
            process.wait(timeout=60)


class Server(http.server.BaseHTTPRequestHandler):
    """Captures and mistakes; counts requests by path."""

    asked: list[str] = []
    seen: list[pathlib.Path] = []

    def do_GET(self):
        path = self.path
        is_first = path not in self.asked
        self.asked.append(path)
        if path == "/missing.pcap" or (path == "/later.pcap" and is_first):
            return self.send_error(404 if path == "/missing.pcap" else 503)
        body = b"<html>" if path == "/page.pcap" else tiny()
        self.send_response(200)
        self.send_header("Content-Length", str(len(body) + (path == "/short.pcap")))
        self.end_headers()
        self.wfile.write(body[:40_000])
        if path == "/drive.pcap":
            time.sleep(0.5)
            Server.seen = [file for file in (FOLDER / "cluster").glob("*/space/**/*")
                           if file.is_file() and file.stat().st_size >= 40_000]
        self.wfile.write(body[40_000:])

    def log_message(self, *_):
        pass


class Fleet(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.stack = contextlib.ExitStack()
        cls.addClassCleanup(cls.stack.close)
        cls.cluster = Cluster(fresh("cluster"))
        cls.stack.callback(cls.cluster.end)
        cls.client = cls.stack.enter_context(cls.cluster.client())

    def with_workers(self, count: int) -> list[subprocess.Popen]:
        workers = [self.cluster.start_worker() for _ in range(count)]
        self.addCleanup(lambda: [(worker.kill(), worker.wait(timeout=60)) for worker in workers])
        self.client.wait_for_workers(count, timeout=PATIENCE_S)
        return workers

    def setUp(self):
        until(lambda: not self.client.scheduler_info()["workers"], "workers of the test before")

    def run_fleet(self, recordings: pathlib.Path, results: pathlib.Path, **more) -> dict[str, str]:
        return fleet.run(self.client, fleet.recordings_of(str(recordings)), str(results), CAR, timeout_s=PATIENCE_S,
                         patience_s=PATIENCE_S, **more)

    def test_a_worker_that_dies_loses_no_recording(self):
        """It is killed while it has a recording that nobody has written yet. Then the other one has it."""
        folder = fresh("drives")
        for number in range(6):
            (folder / f"{number}, wet").mkdir()
            (folder / f"{number}, wet/drive.pcap").write_bytes(tiny())
        (folder / "damaged.pcap").write_text("no capture\n" * 1000)
        (folder / "waits.pcap").write_bytes(tiny())
        self.assertEqual(batch(folder, fresh("expected")).returncode, 1)
        (folder / "waits.pcap").unlink()
        os.mkfifo(folder / "waits.pcap")
        workers, results = self.with_workers(2), fresh("died")

        def holder():
            for worker in workers:
                for (pid, start), _ in descendants(worker.pid).items():
                    with contextlib.suppress(OSError):
                        if b"waits.pcap" in pathlib.Path(f"/proc/{pid}/cmdline").read_bytes():
                            return worker, (pid, start)
            return None

        def kill_and_write():
            worker, program = until(holder, "nobody has it")
            worker.kill()
            until(lambda: not is_running(*program), "its iog goes on")
            until(lambda: (found := holder()) and found[0] is not worker, "nobody else has it")
            (folder / "waits.pcap").write_bytes(tiny())

        killer = threading.Thread(target=kill_and_write, daemon=True)
        killer.start()
        status = self.run_fleet(folder, results)
        killer.join(timeout=PATIENCE_S)
        self.assertEqual(rows_of(results), rows_of(FOLDER / "expected"))
        self.assertEqual([name for name, word in status.items() if word != "done"], ["damaged.pcap"])
        self.assertEqual((results / "batch.txt").read_bytes(), (FOLDER / "expected/batch.txt").read_bytes())
        (folder / "waits.pcap").unlink()
        (folder / "waits.pcap").write_bytes(tiny())
        self.assertRegex(batch(folder, results).stdout, r"(?m)^recordings +0 now, 8 before, 0 left$")

    def test_rows_that_are_done_are_skipped(self):
        """A torn row is removed, and only its recording is computed again."""
        folder, results = fresh("resumed"), fresh("resumed_results")
        for name in ("one", "two"):
            (folder / f"{name}.pcap").write_bytes(tiny())
        batch(folder, results)
        whole = (results / "summary.csv").read_bytes()
        kept = whole.splitlines(keepends=True)[1].replace(b",done,", b",kept,")
        (results / "summary.csv").write_bytes(whole.splitlines(keepends=True)[0] + kept + b'"a ""torn\n",done')
        self.with_workers(1)
        self.run_fleet(folder, results)
        self.assertEqual((results / "summary.csv").read_bytes().splitlines(keepends=True)[1], kept)
        self.assertEqual(sorted(row["status"] for row in by_name(results).values()), ["done", "kept"])
        with self.assertRaisesRegex(fleet.FleetError, "another car, other options or another iog"):
            self.run_fleet(folder, results, options=["--rule", "bayes"])
        with self.assertRaisesRegex(fleet.FleetError, "worker tcp://127.*--rule"):
            self.run_fleet(folder, results, options=["--rule", "none"])

    def test_urls(self):
        """They are fetched into files without a name. What may go away is tried again, and not for ever."""
        server = http.server.ThreadingHTTPServer(("127.0.0.1", 0), Server)
        threading.Thread(target=server.serve_forever, daemon=True).start()
        self.addCleanup(server.server_close)
        self.addCleanup(server.shutdown)
        at = f"http://127.0.0.1:{server.server_port}"
        folder, results = fresh("urls"), fresh("url_results")
        (folder / "here.pcap").write_bytes(tiny())
        expected = {f"{at}/drive.pcap": "", f"{at}/later.pcap": "", "here.pcap": "", f"{at}/page.pcap": "no capture",
                    f"{at}/missing.pcap": "cannot be fetched: HTTP Error 404",
                    f"{at}/short.pcap": f"cannot be fetched: {len(tiny())} of {len(tiny()) + 1} bytes",
                    "http://127.0.0.1:1/x.pcap": "cannot be fetched: <urlopen error [Errno 111]",
                    "http://[garbage": "cannot be fetched: Invalid IPv6 URL", "gone.pcap": "cannot be read"}
        (folder / "list.txt").write_text("\r\n".join([*expected, "", "./here.pcap"]))
        (worker,) = self.with_workers(1)
        self.run_fleet(folder / "list.txt", results, retries=1)
        rows = by_name(results)
        self.assertEqual(set(rows), set(expected))
        for name, reason in expected.items():
            self.assertEqual(rows[name]["reason"][:len(reason) or None], reason, rows[name])
        self.assertEqual(*([rows[name][key] for key in ("status", "points", "run_hash", "object_run_hash", "remarks")]
                           for name in (f"{at}/drive.pcap", "here.pcap")))
        self.assertEqual({path: Server.asked.count(path) for path in sorted(set(Server.asked))}, {
            "/drive.pcap": 1, "/later.pcap": 2, "/missing.pcap": 1, "/page.pcap": 1, "/short.pcap": 2})
        self.assertEqual(Server.seen, [])
        self.assertEqual([link for link in links_of(worker.pid) if "deleted" in link], [])

    def test_versions(self):
        """Work is given to workers of one version only; one without a program is told by its name."""
        folder, results = fresh("versions"), FOLDER / "versions_results"
        (folder / "drive.pcap").write_bytes(tiny())
        (other := folder / "other").write_text("#!/bin/sh\necho iog 0.0.9\n")
        other.chmod(0o755)
        with self.assertRaisesRegex(fleet.FleetError, "no worker has come to tcp://127.0.0.1:"):
            fleet.run(self.client, fleet.recordings_of(str(folder)), str(results), CAR, patience_s=0.5)
        self.with_workers(1)
        for program, words in ((other, r"different versions of iog: iog 0\.0\.9 on {0}; iog 0\.1\.0 .* on tcp://127"),
                               (folder / "nothing", "worker {0}: iog --version: .*No such file")):
            known = set(self.client.scheduler_info()["workers"])
            worker = self.cluster.start_worker(str(program))
            (address,) = until(lambda: set(self.client.scheduler_info()["workers"]) - known, "it does not come")
            with self.assertRaisesRegex(fleet.FleetError, words.format(address)):
                self.run_fleet(folder, results)
            worker.kill()
            worker.wait(timeout=60)
            until(lambda: set(self.client.scheduler_info()["workers"]) == known, "it does not go")
        self.assertFalse(results.exists())

    def test_this_pc_alone(self):
        """Without a cluster its workers listen on 127.0.0.1 only, and a recording that takes too long is ended."""
        folder, results = fresh("alone"), FOLDER / "alone_results"
        shutil.rmtree(results, ignore_errors=True)
        os.mkfifo(folder / "waits.pcap")
        (folder / "drive.pcap").write_bytes(tiny())
        run = subprocess.Popen([sys.executable, "-m", "iogrid.fleet", folder, "--vehicle-file", CAR, "--out", results,
                                "--workers", "1", "--iog", streams.IOG, "--timeout", "5"], cwd=folder, text=True,
                               stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                               env=os.environ | {"PYTHONPATH": str(streams.ROOT / "clients/python")})
        self.addCleanup(lambda: (run.kill(), run.wait(timeout=60)))
        until(lambda: (results / "summary.csv").exists() and len(by_name(results)) == 1, "no row")
        self.assertEqual({address for pid in (run.pid, *(pid for pid, _ in descendants(run.pid)))
                          for address in listening_on(pid)}, {"127.0.0.1"})
        said, _ = run.communicate(timeout=PATIENCE_S)
        self.assertEqual((run.returncode, by_name(results)["waits.pcap"]["reason"]), (1, "not done in 5 s"), said)
        self.assertEqual(sorted(path.name for path in folder.iterdir()), ["drive.pcap", "waits.pcap"])

    def test_without_dask(self):
        """The reader needs none, and the fleet says which package is missing."""
        program = "import sys; sys.modules['distributed'] = None; import iogrid; print('read'); import iogrid.fleet"
        run = subprocess.run([sys.executable, "-B", "-c", program], capture_output=True, text=True, check=False,
                             timeout=PATIENCE_S, env={"PYTHONPATH": str(streams.ROOT / "clients/python")})
        self.assertEqual(run.stdout, "read\n")
        self.assertIn("apt install python3-distributed", run.stderr.splitlines()[-1])


def links_of(pid: int) -> set[str]:
    """Of the open files of a process that may have ended."""
    found = set()
    with contextlib.suppress(FileNotFoundError):
        for link in os.listdir(f"/proc/{pid}/fd"):
            with contextlib.suppress(FileNotFoundError):
                found.add(os.readlink(f"/proc/{pid}/fd/{link}"))
    return found


def listening_on(pid: int) -> set[str]:
    """IPv4 addresses, and "IPv6" for those."""
    sockets, found = links_of(pid), set()
    for table in ("tcp", "tcp6"):
        for line in pathlib.Path(f"/proc/self/net/{table}").read_text().splitlines()[1:]:
            fields = line.split()
            if fields[3] == LISTENING and f"socket:[{fields[9]}]" in sockets:
                number = bytes.fromhex(fields[1].split(":")[0])[::-1]
                found.add(".".join(map(str, number)) if table == "tcp" else "IPv6")
    return found


if __name__ == "__main__":
    unittest.main()
