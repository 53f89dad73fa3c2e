"""Which lines of the firmware has QEMU executed? Of its log of translated blocks (`-d in_asm`) and an image's line table.

A block is translated when it is about to be executed for the first time, so an instruction counts that may not have
been reached if an exception has left its block before.
"""

import collections
import os
import pathlib
import re
import shutil
import subprocess

LOGGED = re.compile(rb"^0x([0-9a-f]{8}):", re.M)
ROW = re.compile(r"^\S+\s+(\d+)\s+0x([0-9a-f]+)")

# Takes the place of the emulator for whoever starts it, and says which image it was.
WRAPPER = """#!/bin/sh
folder="{folder}"
name=$(mktemp "$folder/run.XXXXXX")
printf '%s\\n' "$@" >"$name.arguments"
exec "{emulator}" -d in_asm -D "$name.log" "$@"
"""


def install(folder: pathlib.Path) -> dict[str, str]:
    """The environment in which runs of the emulator are logged."""
    emulator = shutil.which("qemu-system-arm")
    (folder / "bin").mkdir(parents=True, exist_ok=True)
    wrapper = folder / "bin/qemu-system-arm"
    wrapper.write_text(WRAPPER.format(folder=folder, emulator=emulator))
    wrapper.chmod(0o755)
    return {**os.environ, "PATH": f"{wrapper.parent}:{os.environ['PATH']}"}


def executed(folder: pathlib.Path) -> dict[pathlib.Path, set[int]]:
    """By image, addresses of instructions."""
    found: dict[pathlib.Path, set[int]] = collections.defaultdict(set)
    for arguments in folder.glob("run.*.arguments"):
        words = arguments.read_text().splitlines()
        log = arguments.with_suffix(".log")
        if "-kernel" in words and log.exists():
            image = pathlib.Path(words[words.index("-kernel") + 1])
            found[image] |= {int(address, 16) for address in LOGGED.findall(log.read_bytes())}
    return found


def lines_of(image: pathlib.Path, names: set[str]) -> dict[tuple[str, int], set[int]]:
    """By file and line, the addresses of its instructions."""
    table = subprocess.run(["arm-none-eabi-objdump", "--dwarf=decodedline", "-WL", str(image)], check=True, text=True,
                           errors="replace", stdout=subprocess.PIPE).stdout
    found: dict[tuple[str, int], set[int]] = collections.defaultdict(set)
    file, before = None, None
    for row in table.splitlines():
        if row.endswith(":") and " " not in row:
            path = os.path.normpath(row[:-1])
            file = next((name for name in names if path == name or path.endswith("/" + name)), None)
        elif entry := ROW.match(row):
            address = int(entry.group(2), 16)
            if before is not None and before[0][0] is not None and before[1] < address <= before[1] + 4096:
                found[before[0]] |= set(range(before[1], address, 4))
            before = ((file, int(entry.group(1))), address)
    return {key: addresses for key, addresses in found.items() if min(addresses) >= 0x8000}
