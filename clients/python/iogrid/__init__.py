"""Reads the stream of an iogrid target: occupancy indexes, classes, where the window is, and objects.

    import iogrid
    for frame in iogrid.listen():                      # or iogrid.replay("stream.pcap")
        print("silence" if frame is None else frame.is_free((2.0, 12.0), (-1.0, 1.0)))

Python 3.11 and numpy. Numbers like 3.9 are sections of docs/spec.md; interface version 5 is read. Places are
metres in the car's frame, x forward and y to the left; grids are [y, x], lowest first. What is damaged, foreign, late
or of a run that is over is dropped and counted by cause in Receiver.dropped: no bytes raise an exception. A frame of
which a message was lost says so (is_whole); what was lost of it is unknown, and no cell is older than its frame.
"""

from iogrid.frame import FREE_CLASSES, Cause, Class, Frame, Pose, Window, probability
from iogrid.grid import Geometry
from iogrid.objects import Object, State
from iogrid.receiver import Receiver
from iogrid.sources import SILENCE_S, listen, replay

__all__ = ["FREE_CLASSES", "Geometry", "SILENCE_S", "Cause", "Class", "Frame", "Object", "Pose", "Receiver",
           "State", "Window", "listen", "probability", "replay"]
