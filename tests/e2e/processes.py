"""Programs that start others: called so that none is left; and what processes there are, by Linux's /proc."""

import os
import pathlib
import signal
import subprocess
import time

PATIENCE_S = 900  # on a PC that is busy with other work
TIME_TO_END_S = 10


def called(*command) -> subprocess.CompletedProcess:
    """Its status and what it says, as one text. Too slow, it is ended with all that it has started."""
    run = subprocess.Popen(command, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                           text=True, start_new_session=True)
    try:
        said, _ = run.communicate(timeout=PATIENCE_S)
    except subprocess.TimeoutExpired:
        os.killpg(run.pid, signal.SIGTERM)
        try:
            said, _ = run.communicate(timeout=TIME_TO_END_S)
        except subprocess.TimeoutExpired:
            os.killpg(run.pid, signal.SIGKILL)
            said, _ = run.communicate()
        raise AssertionError(f"{command[0]}: not done in {PATIENCE_S} s\n{said}") from None
    return subprocess.CompletedProcess(command, run.returncode, said)


def until(is_true, what: str):
    """Waits for it, and returns it."""
    end = time.monotonic() + PATIENCE_S
    while not (found := is_true()):
        assert time.monotonic() < end, what
        time.sleep(0.01)
    return found


def stat_of(pid: int) -> tuple[str, str, int, str] | None:
    """Name, state, parent and start time of a process; None if there is no such process."""
    try:
        text = pathlib.Path(f"/proc/{pid}/stat").read_text()
    except (FileNotFoundError, ProcessLookupError):
        return None
    name, rest = text.split("(", 1)[1].rsplit(")", 1)
    fields = rest.split()
    return name, fields[0], int(fields[1]), fields[19]


def descendants(ancestor: int) -> dict[tuple[int, str], str]:
    """The names of all processes below this one, by number and start time."""
    pids = [int(entry) for entry in os.listdir("/proc") if entry.isdigit()]
    stats = {pid: stat for pid in pids if (stat := stat_of(pid))}
    family = {ancestor}
    while True:
        more = {pid for pid, stat in stats.items() if stat[2] in family} - family
        if not more:
            break
        family |= more
    return {(pid, stats[pid][3]): stats[pid][0] for pid in family - {ancestor} if pid in stats}


def is_running(pid: int, start: str) -> bool:
    """A process that has ended and that nobody has waited for does not run."""
    stat = stat_of(pid)
    return stat is not None and stat[3] == start and stat[1] != "Z"
