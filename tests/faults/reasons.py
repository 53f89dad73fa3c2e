"""Of each kind of place why a flip there can make a frame wrong that passes all checks, and what would answer it."""

_ONCE = "computed once, by one core"
OF_SILENT = {
    "registers": f"what a core works on is {_ONCE}: only cores in lockstep, or a second fusion, would tell",
    "vector registers": "as registers",
    "stack": "as registers",
    "index grids": f"cells of the frame at hand, {_ONCE}; the frame's CRC is made of them as they are. It lasts one "
                   "frame in the grid, longer in the classes. ECC of the DDR would answer it, which the chip has not",
    "class planes": "masses that are kept from frame to frame; each tile changes up to 25 times a second, and a CRC of "
                    "its own would have to change with it, which is not built. It lasts until the cell is measured again, or fades",
    "objects": "tracks and hits that change with each frame, as class planes",
    "intake": "packets are kept until the frame ends, behind the checks of their datagrams: a point is another point. A "
              "checksum of what is kept would answer it, and is not built",
    "poses": "poses that were believed; what contradicts the sensors is found later (docs/spec.md), one bit may be small",
    "stream": "tiles as they were sent, to which later ones refer, and messages before they have their CRC",
    "network and team": "queues and counters in front of the CRC of a message",
    "drivers": "as network and team",
    "frame and its place": "the window's time, the pose at the frame's end, counters: computed once and sent as they are; what of it never "
                           "changes (which vehicle) is found by the check of memory",
    "map": "the block's CRC is compared when it comes, not afterwards",
    "all else": "as network and team",
    "device registers": "the next start of the device sets them anew; the Ethernet controller is started anew when it is silent",
    "code": "found by the check of memory in at most its round; what is sent until then is wrong",
    "constants": "as code",
    "made of the car": "as code",
    "translation tables": "as code",
    "receive descriptors": "a frame of the ring twice, or another one's: its content is right, so its checks pass",
    "transmit descriptors": "the controller sends other bytes than those that were meant: messages that are old",
    "receive buffers": "the datagram's checksum has been compared before the flip",
    "transmit buffers": "no message: its CRC is compared by the receiver",
}
