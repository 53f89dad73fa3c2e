"""Where a fault hits: kinds of places, and of each kind a bit drawn from a seed."""

import dataclasses
import pathlib
import random
import struct
import subprocess

import debugger
from machine import CORES

SP, CPSR, D0 = 13, 25, 26
HELPER_STACK_STRIDE = 108 << 10  # linker/imx6.ld
# Of bytes that are not 0 there are few in memory that is made for the worst frame: so often one is looked for.
DRAWS = 64
LINE = struct.Struct("<24s40sII")  # tests/faults/layout.cpp

# Kinds, and how often each is drawn.
WEIGHTS = {
    "registers": 24, "vector registers": 4, "stack": 10, "code": 10, "constants": 8, "made of the car": 3,
    "translation tables": 2, "index grids": 9, "class planes": 9, "receive descriptors": 3, "transmit descriptors": 3,
    "receive buffers": 4, "transmit buffers": 3, "intake": 5, "objects": 5, "poses": 3, "stream": 3,
    "network and team": 3, "drivers": 2, "frame and its place": 4, "map": 1, "all else": 3, "device registers": 4,
}
OF_A_CORE = ("registers", "vector registers", "stack")
# What the check of memory reads again and again.
CHECKED = ("code", "constants", "made of the car", "translation tables")


@dataclasses.dataclass(frozen=True)
class Area:
    name: str
    begin: int
    end: int


class Places:
    def __init__(self, image: str, layout: str, folder: pathlib.Path):
        symbols = debugger.symbols_of(image)
        self._symbols = symbols
        self._areas: dict[str, list[Area]] = {
            "code": [Area("text", symbols["text_begin"], symbols["text_end"])],
            "constants": [Area("constants", symbols["constants_begin"], symbols["image_seal"])],
            "translation tables": [Area("page_tables", symbols["page_tables"], symbols["page_tables_end"])],
        }
        lines = folder / "layout.bin"
        subprocess.run(["arm-none-eabi-objcopy", "-O", "binary", "-j", "layout", layout, lines], check=True)
        for kind, name, offset, size in LINE.iter_unpack(lines.read_bytes()):
            kind, name = (text.rstrip(b"\0").decode() for text in (kind, name))
            begin = symbols[name] + offset
            self._areas.setdefault(kind, []).append(Area(f"{name}+{offset:#x}", begin, begin + size))
        drawn = [area for kind, areas in self._areas.items() if kind in WEIGHTS for area in areas]
        self._areas["all else"] = between(Area("data", symbols["data_begin"], symbols["bss_end"]), drawn)
        self._functions = sorted((address, name) for name, address in symbols.items()
                                 if symbols["code_begin"] <= address < symbols["text_end"])

    def address_of(self, kind: str) -> int:
        """Of a kind that is one place."""
        area, = self._areas[kind]
        return area.begin

    def function_at(self, pc: int) -> str:
        """The function and how far it is behind its begin."""
        inside = [(address, name) for address, name in self._functions if address <= pc]
        return f"{inside[-1][1]}+{pc - inside[-1][0]:#x}" if inside and pc < self._symbols["text_end"] else hex(pc)

    def hit(self, stub: debugger.Debugger, kind: str, core: int, rng: random.Random) -> dict:
        """Flips a bit of the standing machine, and says which."""
        stub.choose(core)
        if kind == "registers":
            number = rng.choice([*range(16), CPSR])
            bit = rng.randrange(32)
            stub.flip_register(number, bit)
            return {"place": "cpsr" if number == CPSR else f"r{number}", "bit": bit}
        if kind == "vector registers":
            number, bit = rng.randrange(32), rng.randrange(64)
            stub.flip_register(D0 + number, bit)
            return {"place": f"d{number}", "bit": bit}
        if kind == "device registers":
            return self._hit_device(stub, rng)
        areas = self._stack(stub, core) if kind == "stack" else self._areas[kind]
        found = 0
        for _ in range(DRAWS):
            area = rng.choices(areas, [area.end - area.begin for area in areas])[0]
            address = rng.randrange(area.begin, area.end)
            found = stub.read(address, 1)[0]
            if found:
                break
        bit = rng.randrange(8)
        stub.flip(address, bit)
        return {"place": area.name, "address": f"{address:08x}", "bit": bit, "was": found}

    def _hit_device(self, stub: debugger.Debugger, rng: random.Random) -> dict:
        """As who reads it sees it, and written: of a register that a write of ones clears this is no flip."""
        areas = self._areas["device registers"]
        for _ in range(DRAWS):
            area = rng.choice(areas)
            address = rng.randrange(area.begin, area.end, 4)
            found = stub.read_device(address)
            if found:
                break
        bit = rng.randrange(32)
        stub.write_device(address, found ^ 1 << bit)
        return {"place": area.name, "address": f"{address:08x}", "bit": bit, "was": found}

    def _stack(self, stub: debugger.Debugger, core: int) -> list[Area]:
        """What is in use of it."""
        if core == 0:
            bottom, top = (self._symbols[f"main_stack_{end}"] for end in ("bottom", "top"))
        else:
            bottom, top = (self._symbols[f"helper_main_stack_{end}"] + (core - 1) * HELPER_STACK_STRIDE
                           for end in ("bottom", "top"))
        pointer = stub.register(SP)
        return [Area(f"stack of core {core}", pointer if bottom <= pointer < top else bottom, top)]


def between(whole: Area, areas: list[Area]) -> list[Area]:
    """What of the whole is in none of the areas."""
    found, begin = [], whole.begin
    for area in sorted(areas, key=lambda area: area.begin):
        if area.end <= whole.begin or area.begin >= whole.end:
            continue
        if area.begin > begin:
            found.append(Area(f"{whole.name}+{begin - whole.begin:#x}", begin, area.begin))
        begin = max(begin, area.end)
    return found + ([Area(f"{whole.name}+{begin - whole.begin:#x}", begin, whole.end)] if begin < whole.end else [])


def draw(seed: int, number: int, moments: dict[int, list]) -> tuple[dict, random.Random]:
    """What run `number` of a campaign is, and what its place is drawn with."""
    rng = random.Random(f"{seed} {number}")
    kind = rng.choices(list(WEIGHTS), list(WEIGHTS.values()))[0]
    frame = rng.choice(list(moments))
    core, pc = rng.choice(moments[frame])
    return {"kind": kind, "core": rng.randrange(CORES) if kind in OF_A_CORE else None, "frame": frame,
            "moment_core": core, "moment_pc": f"{pc:08x}", "moment_hit": rng.randint(1, 4)}, rng
