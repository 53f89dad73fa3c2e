"""Scans of any lidar as the datagrams that a target takes them in (docs/spec.md, 1.2.6)."""
import dataclasses
import itertools
import math
import struct

import numpy

TURN = 1_152_000  # steps of 1/3,200 degree
MOST_POINTS = 85
MOST_MM = 1_048_575
POINT = numpy.dtype([("azimuth", "<u4"), ("elevation", "<i4"), ("range", "<u4"), ("after", "<u2"), ("flags", "u1"),
                     ("class", "u1")])
NOTHING = 4  # a flag: nothing came back
TIME_FIELDS = ("t", "time", "timestamp", "time_stamp", "offset_time")


@dataclasses.dataclass
class Scan:
    """Directions and ranges in the units of the wire, and the time of each point behind the first, or None."""

    time_us: int
    azimuth: numpy.ndarray
    elevation: numpy.ndarray
    range_mm: numpy.ndarray
    after_us: numpy.ndarray | None = None
    flags: int | numpy.ndarray = 0


def _nearest(values: numpy.ndarray) -> numpy.ndarray:
    return (numpy.sign(values) * numpy.floor(numpy.abs(values) + 0.5)).astype(numpy.int64)


def of_places(x, y, z, time_us: int, after_us: numpy.ndarray | None = None) -> Scan:
    """Of coordinates in metres. What is not finite, and what is at the sensor itself, is left out."""
    x, y, z = (numpy.asarray(each, numpy.float64) for each in (x, y, z))
    flat = numpy.hypot(x, y)
    range_mm = numpy.minimum(numpy.floor(numpy.hypot(flat, z) * 1000 + 0.5), MOST_MM)
    kept = numpy.isfinite(x) & numpy.isfinite(y) & numpy.isfinite(z) & (range_mm > 0)
    azimuth = _nearest(numpy.degrees(numpy.arctan2(y[kept], x[kept])) * 3200) % TURN
    return Scan(time_us, azimuth, _nearest(numpy.degrees(numpy.arctan2(z[kept], flat[kept])) * 3200), range_mm[kept],
                None if after_us is None else after_us[kept])


def check_laser(count: int, first_rad: float, last_rad: float, step_rad: float, least_m: float, most_m: float) -> None:
    """ValueError if the head of a LaserScan with so many ranges contradicts itself or describes no scan."""
    if not 0 < most_m < numpy.inf:
        raise ValueError(f"range_max is {most_m:g} m")
    if not least_m <= most_m:
        raise ValueError(f"range_min is {least_m:g} m, and range_max {most_m:g}")
    if not (numpy.isfinite(first_rad) and numpy.isfinite(last_rad)):
        raise ValueError(f"angle_min is {first_rad:g}, and angle_max {last_rad:g}")
    if count < 2:
        return
    if not 0 < abs(step_rad) <= 0.2:
        raise ValueError(f"angle_increment is {step_rad:g} rad from beam to beam; at most 0.2 is read")
    end = first_rad + step_rad * (count - 1)
    if abs(end - last_rad) > 1.01 * abs(step_rad):
        raise ValueError(f"by angle_min and angle_increment its last beam is at {end:g} rad, "
                         f"and angle_max is {last_rad:g}")


def of_ranges(ranges_m, first_rad: float, step_rad: float, time_us: int, apart_s: float = 0, least_m: float = 0,
              most_m: float = numpy.inf) -> Scan:
    """Of a 2D scanner. A range beyond the longest is a beam from which nothing came back (REP 117)."""
    ranges = numpy.asarray(ranges_m, numpy.float64)
    with numpy.errstate(invalid="ignore"):
        kept = numpy.flatnonzero((ranges >= least_m) & (ranges > 0))
    angle = numpy.degrees(first_rad + kept * step_rad)
    ranges = ranges[kept]
    is_seen = (ranges <= most_m) & (ranges * 1000 < MOST_MM)
    has_times = 0 < apart_s * len(ranges_m) <= 1
    return Scan(time_us, _nearest((angle - 360 * numpy.round(angle / 360)) * 3200) % TURN, numpy.zeros(len(kept), int),
                numpy.where(is_seen, _nearest(numpy.where(is_seen, ranges, 0) * 1000), 0),
                _nearest(kept * apart_s * 1e6) if has_times else None, numpy.where(is_seen, 0, NOTHING))


def unit_us_of(times: numpy.ndarray) -> float | None:
    """Microseconds of the unit of a driver's times: a scan takes 5 to 500 ms in it. None if there is no such unit, or if
    there are fewer than 100 points and the type does not agree (seconds in floats, nanoseconds in integers): a part of a
    scan is a whole scan in a wrong unit. Decide once for all clouds."""
    span = float(numpy.ptp(times.astype(numpy.float64))) if len(times) else 0
    us = next((us for us in (1e6, 1e3, 1, 1e-3) if 5_000 <= span * us <= 500_000), None)
    return us if len(times) >= 100 or us == (1e6 if times.dtype.kind == "f" else 1e-3) else None


def after_us_of(times: numpy.ndarray, unit_us: float) -> tuple[float, numpy.ndarray]:
    """Of a driver's times: the first one in microseconds and, behind it, each. ValueError if they are of no scan."""
    times = times.astype(numpy.float64)
    if not numpy.ptp(times) * unit_us <= 1e6:
        raise ValueError("the points of a cloud are more than a second apart, or a time is no number")
    return times.min() * unit_us, _nearest((times - times.min()) * unit_us)


def _wrapped(parts: int) -> int:
    """The shorter way, more than -1/2 and at most 1/2 of a turn."""
    return parts % TURN - TURN if parts % TURN > TURN // 2 else parts % TURN


def _mean(angles: list[float]) -> int | None:
    """Of radians. None if they lie all around. The sum's order is that of tools/formats/points/turn_sectors.cpp."""
    x, y = sum(map(math.cos, angles)), sum(map(math.sin, angles))
    mean = math.atan2(y, x) / (math.tau / TURN)
    return int(math.copysign(math.floor(abs(mean) + 0.5), mean)) if math.hypot(x, y) >= 0.5 * len(angles) else None


def sectors_of_scan(azimuths: numpy.ndarray, begin: int, width: int) -> list[tuple[int, int]]:
    """Where the sector of each datagram begins, and its width, for points in the order of their azimuths in the field that
    was scanned. Empty if they are in another order. The rule is that of tools/formats/points/turn_sectors.hpp."""
    angles = (azimuths * (math.tau / TURN)).tolist()
    starts = range(0, len(azimuths), MOST_POINTS)
    means = []
    for start in starts:
        means.append(_mean(angles[start:start + MOST_POINTS]))
        if means[-1] is None:
            return []
    if not means:
        return []
    steps = [_wrapped(b - a) for a, b in zip(means, means[1:])]
    means = list(itertools.accumulate(steps, initial=means[0]))
    if not width // 64 < abs(means[-1] - means[0]) < TURN // 4 * 5 or (
            max(steps) > width // 64 and min(steps) < -(width // 64)):
        return []
    low = (middle := means[len(means) // 2]) + _wrapped(begin + width // 2 - middle) - width // 2
    high, is_turn = low + width, width >= TURN
    borders = [means[0] - (means[1] - means[0] >> 1), *(a + b >> 1 for a, b in zip(means, means[1:])),
               means[-1] + (means[-1] - means[-2] >> 1)]
    if is_turn:
        missing, sign = max(TURN - abs(borders[-1] - borders[0]), 0), -1 if borders[-1] < borders[0] else 1
        borders[0] -= sign * (missing >> 1)
        borders[-1] += sign * (missing - (missing >> 1))
    else:
        borders[0], borders[-1] = (low, high) if means[-1] > means[0] else (high, low)
    its_mean = numpy.repeat(means, MOST_POINTS)[:len(azimuths)]
    turned = (azimuths - its_mean) % TURN
    at = its_mean + numpy.where(turned > TURN // 2, turned - TURN, turned)
    is_in_field = is_turn | ((low <= at) & (at <= high))
    pairs = numpy.array([borders[:-1], borders[1:]])
    lows = numpy.minimum(pairs.min(0), numpy.minimum.reduceat(numpy.where(is_in_field, at, 2**62), starts)).tolist()
    highs = numpy.maximum(pairs.max(0), numpy.maximum.reduceat(numpy.where(is_in_field, at, -2**62), starts)).tolist()
    widths = [last - first for first, last in zip(lows, highs)]
    if max(widths) > TURN // 2 or (not is_turn and 2 * sum(widths) > 3 * width):
        return []
    return [(first % TURN, its_width) for first, its_width in zip(lows, widths)]


def _field(field_of_view_deg: float, turns: bool) -> tuple[int, int]:
    """Where it begins, and its width: as far to the left as to the right."""
    width = TURN if turns else min(round(field_of_view_deg * 3200), TURN)
    return (TURN - width // 2) % TURN, width


def is_outside(scan: Scan, field_of_view_deg: float = 360, turns: bool = False) -> numpy.ndarray:
    """Of each point, whether it is outside the field of view: datagrams() does not send it."""
    begin, width = _field(field_of_view_deg, turns)
    return (scan.azimuth.astype(numpy.int64) - begin) % TURN > width


def datagrams(scan: Scan, number: int, field_of_view_deg: float = 360, turns: bool = False) -> list[bytes]:
    """In the order of the points' times or, if they have none, of their azimuths. Without points outside the field of
    view: a target drops the whole datagram of such a point."""
    points = numpy.zeros(len(scan.azimuth), POINT)
    points["azimuth"], points["elevation"], points["range"] = scan.azimuth, scan.elevation, scan.range_mm
    points["flags"] = scan.flags
    after_us = numpy.zeros(len(points), int) if scan.after_us is None else scan.after_us
    is_sent = ~is_outside(scan, field_of_view_deg, turns)
    points, after_us = points[is_sent], after_us[is_sent]
    begin, width = _field(field_of_view_deg, turns)
    key = (points["azimuth"].astype(int) - begin) % TURN if scan.after_us is None else after_us
    order = numpy.argsort(key, kind="stable")
    points, after_us = points[order], after_us[order]
    sectors = sectors_of_scan(points["azimuth"].astype(numpy.int64), begin, width)
    count = max(-(-len(points) // MOST_POINTS), 1)
    apart = 1 if sectors else next(each for each in itertools.count((3 * count + 7) // 8) if math.gcd(each, count) == 1)
    starts = range(0, len(points), MOST_POINTS)
    first_us = numpy.minimum.reduceat(after_us, starts) if len(points) else numpy.zeros(1, int)
    points["after"] = numpy.minimum((after_us - numpy.repeat(first_us, MOST_POINTS)[:len(points)]) // 10, 0xFFFF)
    made = []
    for i, first in enumerate(first_us.tolist()):
        its = points[i * MOST_POINTS:(i + 1) * MOST_POINTS]
        sector = sectors[i] if sectors else (begin, width)
        made.append(struct.pack("<4sBBHIHHQII", b"IGPT", 1, 0 if sectors else 2, len(its), number, i * apart % count, count,
                                scan.time_us + int(first), *sector) + its.tobytes())
    return made
