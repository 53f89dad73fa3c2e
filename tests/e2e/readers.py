"""Foxglove's own packages in node (readers/), by which other tests read what `iog` writes."""

import fcntl
import json
import os
import pathlib
import queue
import shutil
import subprocess
import threading
import typing

SOURCES = pathlib.Path(__file__).resolve().parent / "readers"
PATIENCE_S = 60


def install(folder: pathlib.Path) -> pathlib.Path:
    """A folder beside that of a test, with the packages of the lock file, fetched once for all tests, and
    the programs that use them."""
    place = folder.parent / "readers"
    place.mkdir(parents=True, exist_ok=True)
    lock = (SOURCES / "package-lock.json").read_bytes()
    installed = place / "installed.json"
    with open(place / "lock", "w") as one_at_a_time:
        fcntl.flock(one_at_a_time, fcntl.LOCK_EX)
        if not installed.exists() or installed.read_bytes() != lock:
            for name in ("package.json", "package-lock.json"):
                shutil.copy(SOURCES / name, place / name)
            run = subprocess.run(["npm", "ci", "--ignore-scripts", "--no-audit", "--no-fund"], cwd=place,
                                 capture_output=True, text=True, check=False)
            assert run.returncode == 0, f"npm ci in {place}:\n{run.stderr}"
            installed.write_bytes(lock)
        for program in SOURCES.glob("*.mjs"):
            # A test that has begun keeps the file that it reads.
            shutil.copy(program, place / "next")
            os.replace(place / "next", place / program.name)
    return place


def read_mcap(place: pathlib.Path, path: pathlib.Path, *options: str) -> dict:
    run = subprocess.run(["node", "read_recording.mjs", *options, path], cwd=place, capture_output=True,
                         text=True, check=False, timeout=PATIENCE_S)
    assert run.returncode == 0, f"{path}:\n{run.stderr[:4000]}"
    return json.loads(run.stdout)


class Listener:
    """A client of `iog view --foxglove` (readers/listen.mjs). Use it in a `with` statement."""

    def __init__(self, place: pathlib.Path, address: str):
        self._process = subprocess.Popen(["node", "listen.mjs", address], cwd=place, text=True,
                                         stdin=subprocess.PIPE, stdout=subprocess.PIPE)
        self._events: queue.Queue[dict | None] = queue.Queue()
        self._thread = threading.Thread(target=self._collect)
        self._thread.start()
        self.topics: dict[str, dict] = {}  # that are advertised
        self.statuses: list[dict] = []
        self.open = self.next("open")["open"]
        self.server_info = self.next("serverInfo")["serverInfo"]
        self.next("advertise")

    def __enter__(self) -> "Listener":
        return self

    def __exit__(self, *_) -> None:
        self._process.kill()
        self._process.wait()
        self._thread.join()

    def _collect(self) -> None:
        for line in self._process.stdout:
            self._events.put(json.loads(line))
        self._events.put(None)

    def tell(self, **command: typing.Any) -> None:
        self._process.stdin.write(json.dumps(command) + "\n")
        self._process.stdin.flush()

    def next(self, *kinds: str) -> dict:
        """The next event of one of these kinds; the others only leave their trace."""
        while True:
            event = self._events.get(timeout=PATIENCE_S)
            assert event is not None, "the client has ended"
            assert "error" not in event, event
            for channel in event.get("advertise", []):
                self.topics[channel["topic"]] = channel
            for gone in event.get("unadvertise", []):
                self.topics = {topic: each for topic, each in self.topics.items() if each["id"] != gone}
            if "status" in event:
                self.statuses.append(event["status"])
            if any(kind in event for kind in kinds):
                return event

    def subscribe(self, *topics: str) -> None:
        self.tell(subscribe=topics)
        self.settle()

    def settle(self) -> None:
        """Until the server has done all that it was asked for: it answers one request after the other."""
        self.tell(text=json.dumps({"op": "settle"}))
        while '"settle"' not in self.next("status")["status"]["message"]:
            pass

    def frame(self, expected: dict[str, int]) -> dict[str, list[dict]]:
        """The next messages, so many of each topic and no other."""
        found: dict[str, list[dict]] = {topic: [] for topic in expected}
        while sum(map(len, found.values())) < sum(expected.values()):
            event = self.next("topic")
            assert event["topic"] in expected, event
            found[event["topic"]].append(event)
        assert {topic: len(events) for topic, events in found.items()} == expected
        return found
