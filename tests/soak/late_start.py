"""A machine whose clock comes to 2^32 ms, and so to a multiple of 2^32 us, and whose frames to number 2^32, soon.

Its clock is 32 bits of a timer, and a count of their wraps. The count is set. The timer cannot be, so it is given its fastest
source, and core 0 sleeps until it is nearly over, before the loop begins. Nobody has remembered a time by then but what polls
the Ethernet controller, for which it is long ago.
"""

from machine import PC
from watched_machine import WatchedMachine

WRAPS = 999  # 2^32 ms are 1000 * 2^32 us
CROSSING_US = (WRAPS + 1) << 32
FRAMES = 1 << 32
BEFORE_US, BEFORE_FRAMES = 3_000_000, 100
WIDTH = 1 << 32
GPT, GPT_PR, GPT_CNT = 0x0209_8000, 0x0209_8004, 0x0209_8024
SOURCE, OF_THE_BUS = 7 << 6, 1 << 6  # 66 MHz
EPIT1_LOAD, TICK = 0x020D_0008, 65_999  # 1 ms of 66 MHz
NAP = 66_000_000  # a second of it: the watchdog has to be served, since QEMU's ends when its time is set anew
CLOSE = 200_000
WATCHDOG_SERVICE, SERVICE = 0x020B_C002, (0x5555, 0xAAAA)
LR, ARGUMENTS = 14, range(4)
PATIENCE_S = 300


def begin(board: WatchedMachine, places: dict[str, int], symbols: dict[str, int]) -> None:
    """From the reset to the first nap of the loop, a little before they are over."""
    loop, = (address for name, address in symbols.items() if name.startswith("void iog::app::run<"))
    board.stub.forget_break(board.idle)
    board.stub.break_at(loop)
    board.go_on(PATIENCE_S)
    sleep(board, loop, BEFORE_US)
    board.stub.forget_break(loop)
    write(board, places["wraps of the clock"], WRAPS)
    write(board, places["frame number"], FRAMES - BEFORE_FRAMES)
    board.stub.break_at(board.idle)
    board.to_idle(PATIENCE_S)
    board.watch_idle(PATIENCE_S)


def sleep(board: WatchedMachine, loop: int, before_us: int) -> None:
    """Core 0 naps, as the loop does, and comes back to where it is."""
    board.stub.choose(0)
    arguments = {number: board.stub.register(number) for number in ARGUMENTS}  # the first is the board
    clock, prescaler = board.stub.read_device(GPT), board.stub.read_device(GPT_PR)
    board.stub.write_device(GPT_PR, 0)
    board.stub.write_device(GPT, clock & ~SOURCE | OF_THE_BUS)
    # A nap counts twice, since QEMU goes on to the next tick while the machine stands still.
    while (left := WIDTH - before_us - board.stub.read_device(GPT_CNT)) > CLOSE:
        board.stub.write_device(EPIT1_LOAD, min(left // 3, NAP))
        board.stub.choose(0)
        for number, value in (arguments | {LR: loop, PC: board.idle}).items():
            board.stub.set_register(number, value)
        board.go_on(PATIENCE_S)
        assert board.pc(0) == loop
        for word in SERVICE:
            board.stub.write_device(WATCHDOG_SERVICE, word, 2)
    board.stub.write_device(GPT, clock)
    board.stub.write_device(GPT_PR, prescaler)
    board.stub.write_device(EPIT1_LOAD, TICK)
    board.stub.choose(0)
    for number, value in arguments.items():
        board.stub.set_register(number, value)


def write(board: WatchedMachine, address: int, value: int) -> None:
    board.stub.write(address, value.to_bytes(4, "little"))


def closed_us(message: bytes) -> int:
    return int.from_bytes(message[40:48], "big")
