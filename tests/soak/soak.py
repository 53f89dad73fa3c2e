"""A board for a soak: started late in its clock's life, with what is to be known of its firmware."""

import contextlib
import pathlib
from collections.abc import Iterator

import debugger
from minute import Minutes
from places import Places
from watched_machine import WatchedMachine

KNOWN = ("wraps of the clock", "frame number", "rounds of the check", "time beside the poses'")  # places of tests/faults/layout.cpp


@contextlib.contextmanager
def started(iog: str, image: str, layout: str, folder: pathlib.Path) -> Iterator[Minutes]:
    places = Places(image, layout, folder)
    with WatchedMachine(image, folder) as board:
        try:
            yield Minutes(iog, board, folder, {kind: places.address_of(kind) for kind in KNOWN}, debugger.symbols_of(image))
        except AssertionError:
            print(board.console())
            raise
