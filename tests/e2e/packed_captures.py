"""Captures that gzip has packed: whole, and with all that can be wrong with one."""

import gzip
import pathlib


def uses(folder: pathlib.Path, good: str) -> list[tuple[int, list[str], str]]:
    """Status, arguments of iog, and words that it then says."""
    content = pathlib.Path(good).read_bytes()
    packed = gzip.compress(content)
    files = {"good": packed, "cut": packed[:len(packed) // 2],
             "broken": packed[:5000] + bytes(100) + packed[5100:],
             "bomb": gzip.compress(content[:24] + bytes(80 << 20)),
             "other": gzip.compress(b"\x89MCAP0\r\n" + bytes(100))}
    paths = {name: str(folder / f"{name}.gz") for name in files}
    for name, data in files.items():
        pathlib.Path(paths[name]).write_bytes(data)
    return [(0, ["info", paths["good"]], "ibeo LUX"),
            (0, ["fuse", "--pcap", paths["cut"]], "breaks off: the end of what gzip has packed is missing"),
            (0, ["info", paths["broken"]], "the file cannot be "),
            (0, ["info", paths["bomb"]], "unpacks to more than 500 times its size"),
            (2, ["info", paths["other"]],
             "packed by gzip, which is unpacked for captures only: an MCAP file")]
