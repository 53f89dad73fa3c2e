"""Objects as readers/messages.mjs finds them in a scene, held against those that were sent."""

import functools
import math

from made_objects import Thing
from object_parts import MOVES, STANDS, STOPPED, YOUNG

# Name and colour of things by their state: those of the classes.
LOOKS = {YOUNG: ("something", (240, 230, 120)), STANDS: ("stands", (214, 120, 40)),
         MOVES: ("moves", (255, 40, 160)), STOPPED: ("stopped", (250, 190, 40))}


def is_entity_of(entity: dict, thing: Thing, words: str) -> bool:
    """Places, sizes and ways in metres; an arrow is as long as the way of a second."""
    def is_turn(radians: float, turns: float) -> bool:
        off = (radians / math.tau - turns) % 1
        return min(off, 1 - off) < 1 / 65536

    state, colour = LOOKS[thing.state]
    near = functools.partial(math.isclose, abs_tol=1e-9)
    arrow = entity["arrow"]
    has_way = near(arrow["length"], math.hypot(*thing.velocity)) and is_turn(
        arrow["angle"], math.atan2(*thing.velocity[::-1]) / math.tau) if arrow else thing.state != MOVES
    return (entity["id"] == str(thing.id) and near(entity["x"], thing.x_m) and near(entity["y"], thing.y_m)
            and near(entity["length"], max(thing.length_m, 0.1)) and near(entity["width"], max(thing.width_m, 0.1))
            and is_turn(entity["heading"], thing.turns) and entity["colour"] == list(colour)
            and entity["alpha"] == (0.6 if thing.is_hit else 0.25) and has_way and entity["text"] == words
            and near(entity["lifetime_s"], 0.08) and entity["metadata"]["class"] == state
            and entity["metadata"]["age_frames"] == str(thing.age_frames))
