"""What the evaluation knows of a car's file: its turning unit and where that puts a return."""

import re
import tomllib

import numpy as np

BLOCK_S = 48e-6          # HDL-64E S2: from one azimuth to the next
BLOCKS_OF_PACKET = 6     # of one azimuth each
GROUP_S, IN_GROUP_S = 6e-6, (0, 1.26e-6, 2.46e-6, 3.66e-6)
FIRES_AFTER_S = np.tile([GROUP_S * (channel // 4) + IN_GROUP_S[channel % 4] for channel in range(32)], 2)


class Car:
    """Its height band, its body, and the mount of its first sensor."""

    def __init__(self, text: str):
        car = tomllib.loads(text)
        self.unit = car["sensors"][0]
        mount = {"yaw_deg": 0, "pitch_deg": 0, "roll_deg": 0, **self.unit["mount"]}
        self.low_m, self.high_m = car["z_min_m"], car["z_max_m"]
        self.pitch_deg = mount["pitch_deg"]
        self.footprint = car["footprint"]
        self.place = np.array([mount["x_m"], mount["y_m"], mount["z_m"]])
        yaw, pitch, roll = (np.radians(mount[name]) for name in ("yaw_deg", "pitch_deg", "roll_deg"))
        self.turn = (rotation(2, yaw) @ rotation(1, pitch) @ rotation(0, roll))

    def in_vehicle(self, points: np.ndarray) -> np.ndarray:
        return points @ self.turn.T + self.place

    def is_own(self, vehicle: np.ndarray, margin_m: float) -> np.ndarray:
        body = self.footprint
        return ((vehicle[:, 0] > body["x_min_m"] - margin_m) & (vehicle[:, 0] < body["x_max_m"] + margin_m)
                & (vehicle[:, 1] > body["y_min_m"] - margin_m) & (vehicle[:, 1] < body["y_max_m"] + margin_m))


class Hdl64e(Car):
    """With the unit of KITTI's car, and its lasers."""

    def __init__(self, text: str):
        super().__init__(text)
        if self.unit["type"] != "velodyne_hdl64e_s2" or len(self.unit.get("lasers", [])) != 64:
            raise ValueError("the car's first sensor has to be a velodyne_hdl64e_s2 with its lasers")
        elevations = np.radians([laser["elevation_deg"] for laser in self.unit["lasers"]])
        self.rises = np.tan(elevations)
        self.heights = np.array([laser["height_m"] for laser in self.unit["lasers"]]) / np.cos(elevations)

    def lasers_of(self, points: np.ndarray) -> np.ndarray:
        """The laser whose cone comes nearest."""
        r = np.hypot(points[:, 0], points[:, 1])
        nearest, found = np.full(len(r), np.inf), np.zeros(len(r), int)
        for laser, (rise, height) in enumerate(zip(self.rises, self.heights)):
            off = np.abs(points[:, 2] - height - r * rise)
            found[off < nearest] = laser
            nearest = np.minimum(nearest, off)
        return found


def rotation(axis: int, angle: float) -> np.ndarray:
    turn = np.eye(3)
    a, b = [i for i in range(3) if i != axis]
    turn[a, a] = turn[b, b] = np.cos(angle)
    turn[a, b], turn[b, a] = -np.sin(angle), np.sin(angle)
    return turn.T if axis == 1 else turn


def with_keys(text: str, name: str, car_keys: dict[str, str], sensor_keys: dict[str, str]) -> str:
    """A car's file under that name with these keys, in place of what it says of them; the sensor's go to
    its first sensor."""
    head, mark, rest = text.partition("[[sensors]]\n")
    if not mark:
        raise ValueError("the car's file has no [[sensors]]")
    own, others = rest, ""
    if (end := rest.find("[[sensors]]")) >= 0:
        own, others = rest[:end], rest[end:]
    head = _with(head, {"name": f'"{name}"', **car_keys})
    return head + mark + _with(own, sensor_keys) + others


def pitched(text: str, by_deg: float) -> str:
    """A car's file whose first sensor is pitched by so much more; its mount is one line."""
    if by_deg == 0:
        return text
    mount = tomllib.loads(text)["sensors"][0]["mount"]
    mount["pitch_deg"] = round(mount.get("pitch_deg", 0) + by_deg, 6)
    inside = ", ".join(f"{key} = {value}" for key, value in mount.items())
    head, mark, rest = text.partition("[[sensors]]\n")
    return head + mark + _with(rest, {"mount": f"{{ {inside} }}"})


def _with(text: str, keys: dict[str, str]) -> str:
    for key, value in keys.items():
        text, found = re.subn(rf"^{key} *=.*$", f"{key} = {value}", text, count=1, flags=re.M)
        if not found:
            text = f"{key} = {value}\n{text}"
    return text

