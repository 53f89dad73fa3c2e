"""A copy of the tree in which mutants wait for a test to ask for one of them."""

import io
import pathlib
import re
import subprocess
import tarfile
import typing

from candidates import Mutant

COPIED = ("CMakeLists.txt", "CMakePresets.json", "board", "clients", "hal", "lab", "linker", "src", "tests", "toolchain", "tools",
          "vehicles")
HEADER = """#pragma once

namespace iog_mutation {

extern int active;
extern unsigned char* reached;

constexpr bool on(int number) {
  if (__builtin_is_constant_evaluated()) {
    return false;
  }
  reached[number] = 1;
  return active == number;
}

}  // namespace iog_mutation
"""
# A test that ends by a signal has told what it has reached, too: it stands in a file that is mapped.
SUPPORT = """#include <fcntl.h>
#include <sys/mman.h>
#include <cstdlib>

namespace iog_mutation {
int active = -1;
unsigned char unheard[%(most)d];
unsigned char* reached = unheard;

__attribute__((constructor(101))) void start() {
  if (const char* number = std::getenv("IOG_MUTANT")) {
    active = std::atoi(number);
  }
  if (const char* path = std::getenv("IOG_REACHED")) {
    const int file = open(path, O_RDWR);
    reached = static_cast<unsigned char*>(mmap(nullptr, %(most)d, PROT_READ | PROT_WRITE, MAP_SHARED, file, 0));
  }
}
}  // namespace iog_mutation
"""
MOST = 65536


def write(path: pathlib.Path, content: bytes) -> None:
    """Only what is another, so that only that is compiled again."""
    if not path.exists() or path.read_bytes() != content:
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_bytes(content)


def with_mutants(content: bytes, mutants: list[tuple[int, Mutant]]) -> bytes:
    for number, mutant in sorted(mutants, key=lambda each: -each[1].begin):
        code = mutant.code.replace("MUTANT", f"::iog_mutation::on({number})").encode()
        content = content[:mutant.begin] + code + content[mutant.end:]
    # All lines keep their numbers.
    return b'#include "iog_mutation.hpp"\n#line 1\n' + content


def contents(root: pathlib.Path, commit: str) -> dict[str, tuple[bytes, int]]:
    """Of all that is built, as committed: results are of a commit, and in a tree tests may be newer than what they test."""
    archive = subprocess.run(["git", "archive", commit, *COPIED], cwd=root, check=True, stdout=subprocess.PIPE).stdout
    with tarfile.open(fileobj=io.BytesIO(archive)) as files:
        return {each.name: (files.extractfile(each).read(), each.mode) for each in files if each.isfile()}


def place(files: dict[str, tuple[bytes, int]], tree: pathlib.Path, mutants: dict[int, Mutant]) -> None:
    """Makes the copy, or makes it anew, without what is no part of it any more: CMake compiles what it finds."""
    for path in [path for folder in COPIED for path in (tree / folder).rglob("*") if path.is_file()]:
        if str(path.relative_to(tree)) not in files:
            path.unlink()
    for name, (content, mode) in files.items():
        inside = [(number, mutant) for number, mutant in mutants.items() if mutant.file == name]
        write(tree / name, with_mutants(content, inside) if inside else content)
        (tree / name).chmod(mode)
    write(tree / "iog_mutation.hpp", HEADER.encode())
    write(tree / "iog_mutation.cpp", (SUPPORT % {"most": MOST}).encode())


def refused(tree: pathlib.Path, errors: str, mutants: dict[int, Mutant]) -> set[int]:
    """The mutants that the compiler does not take, of what it printed."""
    found = set()
    for path, line in set(re.findall(r"^(\S+?):(\d+):\d+: (?:fatal )?error:", errors, re.M)) | \
            set(re.findall(r"^(\S+?):(\d+):\d+:   (?:required from|in )", errors, re.M)):
        name = pathlib.Path(path).resolve()
        for number, mutant in mutants.items():
            if name == (tree / mutant.file).resolve() and mutant.line <= int(line) <= mutant.last_line:
                found.add(number)
    return found


def drawn(candidates: list[Mutant], counts: dict[str, int], shuffled: typing.Callable) -> list[tuple[int, Mutant]]:
    """Of each room so many, which do not lie in one another; numbered in the order in which the room has them."""
    chosen = []
    for room, count in sorted(counts.items()):
        taken: list[tuple[int, Mutant]] = []
        for number, mutant in enumerate(shuffled(room, [each for each in candidates if each.room == room])):
            if len(taken) == count:
                break
            if all(other.file != mutant.file or other.end <= mutant.begin or mutant.end <= other.begin
                   for _, other in taken):
                taken.append((number, mutant))
        chosen += taken
    return chosen
