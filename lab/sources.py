"""What the numbers of a step depend on: the files that its programs are made of.

They are found by what includes what: a source includes headers, and what a header declares is in those
.cpp of its folder that include it, whatever their names. So a file that no program of a step needs
may count, too, if it lies beside one that it does need; the other way round none is missed.
"""

import collections
import functools
import hashlib
import pathlib
import re
import typing

ROOT = pathlib.Path(__file__).resolve().parents[1]
# Where an #include may begin.
INCLUDED_FROM = ("", "src", "board/imx6", "board/imx6/machine", "tests/host")
# What CMake chooses has an @ in its name, and lies beside what it is included by.
INCLUDE = re.compile(r'^\s*#\s*include\s*"([^"]+)"', re.M)
CODE = (".cpp", ".hpp", ".in", ".S")
NO_SOURCES = (".md", ".pyc")
# What every program is built with.
EVERYWHERE = ("toolchain",)


class Unknown(Exception):
    """Something is included that is nowhere: what depends on it cannot be told."""


def _files_in(folder: pathlib.Path) -> list[pathlib.Path]:
    return sorted(path for path in folder.iterdir()
                  if path.is_file() and path.suffix not in NO_SOURCES)


def _meant(name: str, by: pathlib.Path) -> list[pathlib.Path]:
    """By an #include: the file, or the .in that it is made from."""
    if "@" in name:
        return list((by.parent).glob(re.sub("@.*@", "*", pathlib.Path(name).name)))
    for base in (by.parent, *(ROOT / place for place in INCLUDED_FROM)):
        for path in (base / name, base / f"{name}.in"):
            if path.is_file():
                return [path]
    if name.startswith("vehicles/"):  # made of all of them
        return _files_in(ROOT / "vehicles")
    if name.startswith("gtest/"):
        return []
    raise Unknown(f"{by.relative_to(ROOT)} includes {name}, which is nowhere")


@functools.cache
def _included(path: pathlib.Path) -> list[pathlib.Path]:
    if path.suffix not in CODE:
        return []
    return [meant for name in INCLUDE.findall(path.read_text()) for meant in _meant(name, path)]


@functools.cache
def _includers(folder: pathlib.Path) -> dict[pathlib.Path, list[pathlib.Path]]:
    """Of each file the .cpp of this folder that include it. A program has nothing that another needs."""
    found = collections.defaultdict(list)
    for source in folder.glob("*.cpp"):
        for header in [] if "\nint main(" in source.read_text() else _included(source):
            found[header].append(source)
    return found


def files_of(starts: typing.Iterable[str]) -> list[pathlib.Path]:
    """Of folders, without those in them, and of files; with what CMake is told of them."""
    waiting = set()
    for start in (ROOT / start for start in (*starts, *EVERYWHERE)):
        waiting |= set(_files_in(start)) if start.is_dir() else {start}
    found = set()
    while waiting:
        path = waiting.pop()
        found.add(path)
        waiting |= {*_included(path), *_includers(path.parent)[path]} - found
    folders = {above for path in found for above in path.parents if above.is_relative_to(ROOT)}
    return sorted(found | {folder / name for folder in folders
                           for name in ("CMakeLists.txt", "CMakePresets.json")
                           if (folder / name).is_file()})


def digest_of(paths: typing.Iterable[pathlib.Path]) -> str:
    total = hashlib.sha256()
    for path in paths:
        content = hashlib.sha256(path.read_bytes()).hexdigest()
        total.update(f"{path.relative_to(ROOT).as_posix()} {content}\n".encode())
    return total.hexdigest()
