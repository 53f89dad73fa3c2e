"""The target's counters and states by name, as src/stream/target_table.hpp has them."""

import pathlib
import re
from typing import NamedTuple

TABLE = pathlib.Path(__file__).resolve().parents[2] / "src/stream/target_table.hpp"
BUCKETS = (*(f"below {256 << octave} us" for octave in range(9)), "longer")
# Of a kind of more words than one: what each of them is called behind the row's name.
SPARE = int(re.search(r"kSpareWords = (\d+)", TABLE.read_text()).group(1))
PARTS = {"Duration": ("worst us", "sum us high", "sum us low", *BUCKETS), "Mac": ("high", "low"),
         "Room": [f"{number + 1}" for number in range(SPARE)]}


class Row(NamedTuple):
    group: str
    name: str
    kind: str
    words: str

    def counters(self) -> list[str]:
        """The names of its words on the wire."""
        return [f"{self.name} {part}" for part in PARTS[self.kind]] if self.kind in PARTS else [self.words]


def rows_of(text: str) -> list[Row]:
    table = re.sub(r'"\s*\n\s*"', "", text[text.index(" kRows["):])
    rows = re.findall(r'\{k(\w+),\s*"([^"]*)"(?:,\s*k(\w+))?(?:, "([^"]*)")?\},', table)
    return [Row(group, name, kind or "Count", words or name)
            for group, names, kind, words in rows for name in names.split(", ")]


def groups_of(text: str) -> dict[str, str]:
    """What each group's counters are of."""
    enumerators = text[text.index("enum class Group"):text.index("enum class Kind")]
    return {name: " ".join(line.strip().removeprefix("// ") for line in words.splitlines())
            for words, name in re.findall(r"((?:^ +// .*\n)+)^  k(\w+),$", enumerators, re.M)}


def link_groups_of(text: str) -> list[str]:
    groups = list(groups_of(text))
    return groups[groups.index("Net"):groups.index("PoseFate")]


ROWS = rows_of(TABLE.read_text())


def counters(*groups: str) -> tuple[str, ...]:
    return tuple(name for row in ROWS if row.group in groups for name in row.counters())


# The last two are of some targets.
*ALWAYS, _, _ = link_groups_of(TABLE.read_text())
FATES = counters("Fate")
PACKET_DROPS = counters("PacketDrop")
NET_DROPS = counters("Drop")
LINK_COUNTERS = counters(*ALWAYS)
# Of a target that offers its service.
DISCOVERY_COUNTERS = counters("Discovery")
# Of a target that wants its commands signed; those of service discovery come before them.
COMMAND_COUNTERS = counters("Command")
POSE_FATES = counters("PoseFate")
MAP_CAUSES = counters("MapCause")
CHUNK_FATES = counters("ChunkFate")
# What the header of a message counts as dropped, besides PACKET_DROPS: damaged datagrams.
DAMAGED = tuple(row.name for row in ROWS if row.kind == "Loss")
