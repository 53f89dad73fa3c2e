"""Objects as tests describe them: in metres, metres a second and turns of the local frame."""

import dataclasses

from object_parts import HAS_HEADING, MOVES, NOT_BELIEVED, NOT_HIT, STOPPED, Object


@dataclasses.dataclass(frozen=True)
class Thing:
    id: int
    state: int
    x_m: float
    y_m: float
    length_m: float = 4.5
    width_m: float = 1.8
    turns: float = 0.0  # counter-clockwise from x
    velocity: tuple[float, float] = (0.0, 0.0)
    sigma: tuple[float, float] = (0.5, 0.3)  # of it, along and across
    is_hit: bool = True
    age_frames: int = 100

    @property
    def object(self) -> Object:
        is_believed = self.state in (MOVES, STOPPED)
        along, across = (round(100 * value) if is_believed else NOT_BELIEVED for value in self.sigma)
        vx, vy = (round(100 * value) for value in self.velocity)
        return Object(id=self.id, state=self.state, existence=255, age=self.age_frames, x_mm=round(1000 * self.x_m),
                      y_mm=round(1000 * self.y_m), length_cm=round(100 * self.length_m),
                      width_cm=round(100 * self.width_m), heading=round(65536 * self.turns) % 65536,
                      flags=HAS_HEADING | (0 if self.is_hit else NOT_HIT), vx_cm_s=vx, vy_cm_s=vy,
                      sigma_v_along=along, sigma_v_across=across, sigma_along=100, sigma_across=100,
                      since_hit_ms=0 if self.is_hit else 80, since_stopped=20 if self.state == STOPPED else 65535)


def objects_of(things: list[Thing]) -> list[Object]:
    """In the order in which they are sent."""
    return sorted((thing.object for thing in things), key=lambda each: each.id)
