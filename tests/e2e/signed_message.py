"""Messages that carry a MAC, signed as docs/spec.md section 9 says, by the program `openssl`."""

import struct
import subprocess

TRAILER_BYTES = 12
MAC_BYTES = 8


def cmac(key: bytes, data: bytes) -> bytes:
    """CMAC with AES-128 (NIST SP 800-38B)."""
    command = ["openssl", "mac", "-cipher", "AES-128-CBC", "-macopt", f"hexkey:{key.hex()}", "-binary", "-in", "-",
               "CMAC"]
    return subprocess.run(command, input=data, capture_output=True, check=True).stdout


def sign(message: bytes, key: bytes, run: int, counter: int) -> bytes:
    """The data id is the message's event."""
    longer = message[:4] + struct.pack(">I", len(message) + TRAILER_BYTES - 8) + message[8:]
    mac = cmac(key, message[2:4] + longer[8:] + struct.pack(">II", run, counter))
    return longer + struct.pack(">I", counter) + mac[:MAC_BYTES]


# RFC 4493, section 4, example 1.
assert cmac(bytes.fromhex("2b7e151628aed2a6abf7158809cf4f3c"), b"").hex() == "bb1d6929e95937287fa37d129b756746"
