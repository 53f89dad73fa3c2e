"""Of each kind of place why a flip there can make a frame wrong that passes all checks, and what would answer it."""

_ONCE = "computed once, by one core"
OF_SILENT = {
    "registers": f"working values are {_ONCE}; only lockstep cores or a second fusion would detect it",
    "vector registers": "as registers",
    "stack": "as registers",
    "index grids": f"cells of the current frame, {_ONCE}; the CRC is made of the wrong cells. Lasts one frame in the grid, "
                   "longer in the classes. Needs ECC of the DDR, which the chip does not have",
    "class planes": "masses kept from frame to frame. A CRC for each tile, which would change up to 25 times a second, is missing. "
                    "Lasts until the cell is measured again, or fades",
    "objects": "tracks and hits that change with each frame, as class planes",
    "intake": "packets kept until the frame ends, after the checks of their datagrams. A checksum of the kept packets is missing",
    "poses": "accepted poses; contradictions with the sensors are found later (docs/spec.md), one bit may be small",
    "stream": "sent tiles, to which later ones refer, and messages that have no CRC yet",
    "network and team": "queues and counters in front of the CRC of a message",
    "drivers": "as network and team",
    "frame and its place": "the window's time, the pose at the frame's end, counters: computed once and sent as they are; the memory "
                           "check finds what never changes (which vehicle)",
    "map": "the block's CRC is compared when it arrives, not afterwards",
    "all else": "as network and team",
    "device registers": "the next start of the device sets them again; the Ethernet controller is restarted when it is silent",
    "code": "the memory check finds it within one round; frames until then are wrong",
    "constants": "as code",
    "made of the car": "as code",
    "translation tables": "as code",
    "receive descriptors": "a frame of the ring twice, or another one's: its content is right, so its checks pass",
    "transmit descriptors": "the controller sends other bytes than intended: old messages",
    "receive buffers": "the datagram's checksum was compared before the flip",
    "transmit buffers": "no message: the receiver compares its CRC",
}
