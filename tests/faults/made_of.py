"""The results of a campaign as it has written them, and of which sources its firmware was."""

import json
import pathlib
import subprocess

ROOT = pathlib.Path(__file__).resolve().parents[2]
FOLDERS = ("src", "hal", "board", "linker", "vehicles")  # that the firmware is made of


def sources(folders: tuple[str, ...] = FOLDERS, commit: str = "HEAD") -> dict[str, str]:
    """Of each folder the name that git gives its content, as committed."""
    done = subprocess.run(["git", "ls-tree", commit, *folders], cwd=ROOT, check=True, text=True, stdout=subprocess.PIPE)
    return {line.split("\t")[1]: line.split()[2] for line in done.stdout.splitlines()}


def lines(path: pathlib.Path) -> list[dict]:
    return [json.loads(line) for line in path.read_text(encoding="utf-8").splitlines()]


def results(path: pathlib.Path) -> list[dict]:
    """Without the first line, which has the sources."""
    return [line for line in lines(path) if "number" in line]
