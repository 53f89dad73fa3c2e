"""What `iog` says of a recording and a car: its texts as rows and numbers."""

import pathlib
import re
import subprocess
import typing


class Failed(Exception):
    """No report: the one sentence says why."""


class Unit(typing.NamedTuple):
    """A line of `iog info`: what came to a port."""

    port: str
    format: str
    packets: int
    bytes: int
    points: int
    scans: int
    rate: str
    source: str


class Budget(typing.NamedTuple):
    """A line of `iog budget`."""

    name: str
    points: int
    ms: float
    share_of_period: int  # per cent
    is_too_slow: bool


class Iog:
    def __init__(self, program: pathlib.Path):
        self.program = program
        self.remarks: list[str] = []  # of what went well

    def _run(self, *words) -> subprocess.CompletedProcess:
        return subprocess.run([str(self.program), *map(str, words)], check=False, text=True, errors="replace",
                              capture_output=True, stdin=subprocess.DEVNULL)

    def told(self, *words) -> str:
        """Whatever its status is."""
        return self._run(*words).stdout

    def said(self, *words) -> str:
        done = self._run(*words)
        if done.returncode != 0:
            sentences = done.stderr.strip() or f"`iog {words[0]}` ended with status {done.returncode}"
            raise Failed(sentences.removeprefix("iog: "))
        self.remarks += [line.removeprefix("iog: ") for line in done.stderr.splitlines()]
        return done.stdout


class Rows:
    """The lines "key  value" of a text; a key may occur more than once."""

    def __init__(self, text: str):
        self._rows = [match.groups() for line in text.splitlines()
                      if (match := re.fullmatch(r"(\S(?: ?\S)*) {2,}(\S.*)", line))]

    def all(self, key: str) -> list[str]:
        return [value for name, value in self._rows if name == key]

    def __getitem__(self, key: str) -> str:
        """Of the first row; "" without one."""
        return next(iter(self.all(key)), "")

    def counts(self, key: str) -> dict[str, int]:
        """Of "3 used, 5 too far": {"used": 3, "too far": 5}."""
        return {words: int(number) for number, words in re.findall(r"(\d+) ([^,;]+)", self[key])}

    @property
    def loud(self) -> list[str]:
        """What `iog` itself writes in capitals: something is wrong."""
        return [f"{key.capitalize().rstrip('?')}: {value}" for key, value in self._rows if key.isupper()]


def units_of(text: str) -> list[Unit]:
    rows = re.findall(r"^(\d+) +(\S.*?) +(\d+) +(\d+) +(\d+) +(\d+) +(-|[\d.]+ Hz) +(\S.*)$", text, re.M)
    return [Unit(port, kind, *map(int, numbers), rate, source) for port, kind, *numbers, rate, source in rows]


def budgets_of(text: str) -> list[Budget]:
    found = re.findall(r"^ +(typical|worst) +(\d+) points.* ([\d.]+) ms, +(\d+) % of the period(: TOO SLOW)?$", text,
                       re.M)
    return [Budget(name, int(points), float(ms), int(share), bool(slow)) for name, points, ms, share, slow in found]


def cores_of(text: str, car: str) -> dict[str, str]:
    """How many cores keep the period in a "typical" and a "worst" frame, by `iog budget --all`, which lists all cars."""
    line = next((line for line in text.splitlines() if line.startswith(car + " ")), "")
    found = re.findall(r"(typical|worst) [\d.]+ ms, (not on|on) (\d+) cores?", line)
    return {"typical": "not known", "worst": "not known"} | {
        name: number if on == "on" else f"more than {number}" for name, on, number in found}


def with_sensor_alone(text: str, number: int) -> str | None:
    """A car's file whose other sensors listen where nothing comes; nothing else changes. None if its sensors are not
    written as [[sensors]]."""
    head, *blocks = re.split(r"^(?=\[\[sensors\]\])", text, flags=re.M)
    if number >= len(blocks):
        return None
    for other in (i for i in range(len(blocks)) if i != number):
        block = re.sub(r"^udp_port *=.*\n", "", blocks[other], flags=re.M)
        blocks[other] = re.sub(r"\n", f"\nudp_port = {65500 + other}\n", block, count=1)
    return head + "".join(blocks)


def fates_by_sensor(iog: Iog, fuse_words: list[str], text: str, car: dict, work: pathlib.Path) -> dict[str, dict]:
    """Points by outcome, of each of several sensors: the recording is fused once more for each. Empty of one sensor,
    and if the file does not write them as [[sensors]]."""
    sensors = car["sensors"] if len(car["sensors"]) > 1 else []
    fates = {}
    for i, sensor in enumerate(sensors):
        if (alone := with_sensor_alone(text, i)) is None:
            return {}
        (file := work / f"{car['name']}.toml").write_text(alone, encoding="utf-8")
        said = iog.told("fuse", *fuse_words, "--vehicle-file", file)
        fates[sensor.get("name", f"sensor {i}")] = Rows(said).counts("scan points")
    return fates
