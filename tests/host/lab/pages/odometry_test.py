"""How far a log is from the true poses, on trajectories whose errors are made here."""

import pathlib
import struct
import tempfile
import unittest

import numpy as np

import laboratory  # noqa: F401 ; it makes the others known
import odometry

SECONDS = np.arange(0, 20.01, 0.1)


def circle(times: np.ndarray, metres_per_second: float = 10) -> np.ndarray:
    """50 m to the left, from the origin along x."""
    angle = 0.2 * times
    radius = metres_per_second / 0.2
    return np.stack([times, radius * np.sin(angle), radius * (1 - np.cos(angle)), angle], axis=1)


def log_of(poses: np.ndarray) -> np.ndarray:
    """With speed and yaw rate, and sigmas of 0.1 m and 0.5 degrees."""
    return np.hstack([poses, np.tile([10, 11.5, 0.1, 0.5], (len(poses), 1))])


class Errors(unittest.TestCase):
    def test_where_the_local_frames_lie_is_no_error(self):
        truth = circle(SECONDS)
        turned = truth.copy()
        turned[:, 1], turned[:, 2] = 7 - truth[:, 2], truth[:, 1] - 3
        turned[:, 3] += np.pi / 2
        metres, off_m, off_deg, place, turn = odometry.errors(log_of(truth), turned)
        self.assertAlmostEqual(metres, 200, delta=0.1)
        np.testing.assert_allclose([off_m, off_deg, place, turn], 0, atol=1e-9)

    def test_a_log_that_is_a_hundredth_too_long_is_off_by_that(self):
        metres, off_m, off_deg, place, _ = odometry.errors(log_of(circle(SECONDS, 10.1)), circle(SECONDS))
        chord = 2 * 50 * np.sin(0.2 * 20 / 2)
        self.assertAlmostEqual(off_m, 0.01 * chord, places=6)
        self.assertAlmostEqual(off_deg, 0)
        # 10 cm in a second along x, in the root mean square of both axes, of a sigma of 10 cm.
        self.assertAlmostEqual(place, np.sqrt(0.5), delta=0.01)
        self.assertAlmostEqual(metres, 200, delta=0.1)

    def test_a_heading_that_drifts_is_off_by_its_drift(self):
        log = log_of(circle(SECONDS))
        log[:, 3] += np.radians(0.25) * SECONDS
        _, off_m, off_deg, _, turn = odometry.errors(log, circle(SECONDS))
        self.assertAlmostEqual(off_deg, 5)
        self.assertAlmostEqual(off_m, 0)
        self.assertAlmostEqual(turn, 0.5, delta=0.01)


class Poses(unittest.TestCase):
    def test_are_those_of_the_messages_to_their_port(self):
        def frame(port: int) -> bytes:
            pose = bytes(40) + struct.pack(">QiiI", 1_500_000, 2_000, -3_000, 1 << 30) + bytes(40)
            udp = struct.pack(">HHHH", 50_000, port, 8 + len(pose), 0) + pose
            head = struct.pack(">BBHHHBBHII", 0x45, 0, 20 + len(udp), 0, 0, 64, 17, 0, 0x0A000202, 0x0A00020F)
            data = bytes(12) + b"\x08\x00" + head + udp
            return struct.pack("<IIII", 1, 0, len(data), len(data)) + data

        head = struct.pack("<IHHiIII", 0xA1B2C3D4, 2, 4, 0, 0, 65_535, 1)
        with tempfile.TemporaryDirectory() as folder:
            capture = pathlib.Path(folder) / "it.pcap"
            capture.write_bytes(head + frame(2368) + frame(15010))
            np.testing.assert_allclose(odometry.poses_in(capture), [[1.5, 2, -3, np.pi / 2]])
            capture.write_bytes(head + frame(2368))
            with self.assertRaises(ValueError):
                odometry.poses_in(capture)


if __name__ == "__main__":
    unittest.main()
