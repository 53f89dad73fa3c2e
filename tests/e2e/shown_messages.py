"""What tshark has to show of a message with docs/wireshark/iogrid.lua, field by field, as grid_stream.py
reads it."""

import re

import grid_stream
import map_state
import object_parts
import protected_message
import reception_parts
import target_state
import tile_coding
import vehicle_id


def field_of(group: str, name: str) -> str:
    return f"iogrid.{group}." + re.sub("[^a-z0-9]+", "_", name.lower()).rstrip("_")


def shown_of(number: int, message: bytes) -> dict[str, list]:
    """What tshark has to show of a message, by field."""
    content = protected_message.content(message, number)
    header, body = grid_stream.read_header(content), content[grid_stream.HEADER_BYTES:]
    shown = {"someip.sessionid": [f"0x{number % 0xFFFF + 1:04x}"],
             "iogrid.e2e.length": [len(message) - 8], "iogrid.e2e.counter": [number & 0xFFFF],
             "iogrid.e2e.data_id": ["0x494f4701"], "iogrid.crc.status": [1],
             "iogrid.type": [header.kind], "iogrid.flags": [f"0x{header.flags:02x}"],
             "iogrid.sequence": [header.sequence], "iogrid.frame": [header.frame],
             "iogrid.closed_us": [header.closed_us], "iogrid.vehicle": [f"0x{vehicle_id.REFERENCE_CAR:08x}"],
             "iogrid.complete": [f"0x{header.complete:02x}"],
             "iogrid.partial": [f"0x{header.partial:02x}"],
             "iogrid.points_used": [header.points_used],
             "iogrid.points_other": [header.points_other],
             "iogrid.packets": [header.packets_fused], "iogrid.dropped": [header.packets_dropped],
             "iogrid.run": [f"0x{header.run:08x}"]}
    if header.kind == grid_stream.TILES and grid_stream.is_of_classes(body):
        shown |= shown_of_class_tiles(header.frame, *grid_stream.read_class_tiles(body))
    elif header.kind == grid_stream.TILES:
        shown |= shown_of_tiles(header.frame, grid_stream.read_tiles(body))
    elif header.kind == grid_stream.CLASS_END:
        shown |= shown_of_class_end(header.frame, grid_stream.read_class_end(body))
    elif header.kind == grid_stream.OBJECTS:
        shown |= shown_of_objects(header.frame, object_parts.read(body))
    elif header.kind == reception_parts.KIND:
        shown |= shown_of_receptions(header.frame, reception_parts.read(body))
    else:
        shown |= shown_of_frame_end(header.frame, grid_stream.read_frame_end(body))
    return {field: [str(value) for value in values] for field, values in shown.items()}


def shown_of_tiles(frame: int, message: grid_stream.Tiles) -> dict[str, list]:
    tiles = message.tiles
    coded = [tile for tile in tiles if tile.encoding > 0]
    return {"_ws.col.Info": [f"frame {frame}, tiles {message.first}-{message.end - 1}, "
                             f"{len(tiles)} of them"],
            "iogrid.tiles.first": [message.first], "iogrid.tiles.end": [message.end],
            "iogrid.tiles.count": [len(tiles)], "iogrid.tile": [tile.number for tile in tiles],
            "iogrid.tile.x": [tile.number % 32 for tile in tiles],
            "iogrid.tile.y": [tile.number // 32 for tile in tiles],
            "iogrid.tile.encoding": [tile.encoding for tile in tiles],
            "iogrid.tile.bytes": [len(tile.payload) for tile in tiles],
            "iogrid.tile.payload": [tile.payload.hex() for tile in tiles],
            "iogrid.tile.values": [tile.payload[tile.encoding == tile_coding.RUN_STARTS_SINCE] for tile in coded],
            "iogrid.tile.reference_age": [tile.payload[0] for tile in coded
                                          if tile.encoding == tile_coding.RUN_STARTS_SINCE]}


def shown_of_window(window: grid_stream.Window) -> dict[str, list]:
    return {"iogrid.window.causes": [f"0x{window.causes:04x}"],
            **{f"iogrid.window.{name}": [getattr(window, name)]
               for name in ("a", "b", "x_mm", "y_mm", "heading", "sigma_mm", "sigma_10_urad", "slices",
                            "slice_ms", "begin_us", "end_us")}}


def shown_of_class_tiles(frame: int, window: grid_stream.Window,
                         message: grid_stream.Tiles) -> dict[str, list]:
    def place(number: int, corner: int) -> int:
        return next(at for at in range(corner, corner + 32) if at % 32 == number)

    tiles = message.tiles
    shown = shown_of_tiles(frame, message) | shown_of_window(window)
    shown["_ws.col.Info"][0] += ", classes"
    return shown | {"iogrid.tile.age": [tile.age for tile in tiles],
                    "iogrid.tile.a": [place(tile.number % 32, window.a) for tile in tiles],
                    "iogrid.tile.b": [place(tile.number // 32, window.b) for tile in tiles]}


def shown_of_class_end(frame: int, end: grid_stream.ClassEnd) -> dict[str, list]:
    lost = f", {end.tiles_lost} not sent" if end.tiles_lost else ""
    shown = {"_ws.col.Info": [f"frame {frame} classes' end, {end.tiles_sent} tiles, "
                              f"grid {end.crc:08x}{lost}"],
             "iogrid.class_tiles_sent": [end.tiles_sent],
             "iogrid.class_tiles_lost": [end.tiles_lost], "iogrid.class_crc": [f"0x{end.crc:08x}"],
             "iogrid.packets_placed": [end.packets_placed],
             "iogrid.packets_not_placed": [end.packets_not_placed],
             "iogrid.slices_over_budget": [end.slices_over_budget]}
    shown |= {f"iogrid.groups.{name}": [count]
              for name, count in zip(("fused", "left", "refreshed"), end.groups)}
    shown |= {field_of("pose", name): [count] for name, count in zip(target_state.POSE_FATES, end.pose_fates)}
    for at, name in enumerate(("slices", "times", "since_us")):
        shown[f"iogrid.cause.{name}"] = [cause[at] for cause in end.causes]
    for at, name in enumerate(("middle_us", "x_mm", "y_mm", "heading", "sigma_mm",
                               "sigma_10_urad")):
        shown[f"iogrid.slice.{name}"] = [each[at] for each in end.slices]
    return shown | shown_of_window(end.window) | shown_of_map(end.map)


def shown_of_objects(frame: int, part: object_parts.Part) -> dict[str, list]:
    moving = sum(each.state == object_parts.MOVES for each in part.objects)
    shown = {"_ws.col.Info": [f"frame {frame} objects, part {part.number + 1} of {part.parts}, "
                              f"{len(part.objects)} of them, {moving} moving"],
             "iogrid.objects.count": [part.count], "iogrid.objects.part": [part.number],
             "iogrid.objects.parts": [part.parts], "iogrid.objects.time_us": [part.time_us],
             "iogrid.objects.refused": [part.refused], "iogrid.objects.hits_left": [part.left],
             "iogrid.object": [each.id for each in part.objects],
             "iogrid.object.flags": [f"0x{each.flags:04x}" for each in part.objects]}
    for name in ("state", "existence", "age", "x_mm", "y_mm", "length_cm", "width_cm", "heading", "vx_cm_s", "vy_cm_s",
                 "sigma_v_along", "sigma_v_across", "sigma_along", "sigma_across", "since_hit_ms", "since_stopped"):
        shown[f"iogrid.object.{name}"] = [getattr(each, name) for each in part.objects]
    return shown


def shown_of_receptions(frame: int, part: reception_parts.Part) -> dict[str, list]:
    all_of_it = part.receptions
    return {"_ws.col.Info": [f"frame {frame} receptions, part {part.number + 1} of {part.parts}, "
                             f"{len(all_of_it)} of them"],
            "iogrid.receptions.count": [part.count], "iogrid.receptions.part": [part.number],
            "iogrid.receptions.parts": [part.parts], "iogrid.receptions.not_listed": [part.not_listed],
            "iogrid.reception.port": [each.port for each in all_of_it],
            "iogrid.reception.left": [each.left for each in all_of_it],
            "iogrid.reception.key": [f"0x{each.key:08x}" for each in all_of_it],
            "iogrid.reception.before_close_us": [each.before_close_us for each in all_of_it]}


def shown_of_map(state: map_state.MapState) -> dict[str, list]:
    plain = ("cause", "blur_cells", "tiles_drawn", "tiles_outside", "tiles_waiting", "source", "x_mm", "y_mm",
             "heading", "sigma_mm", "sigma_10_urad", "delivery", "refusal", "refused", "incoming_bytes",
             "chunks_there")
    shown = {f"iogrid.map.{name}": [getattr(state, name)] for name in plain}
    shown |= {f"iogrid.map.{name}": [f"0x{getattr(state, name):0{digits}x}"]
              for name, digits in (("flags", 2), ("crc", 8), ("incoming_crc", 8), ("origin", 16),
                                   ("pose_origin", 16))}
    shown |= {field_of("map.times", name): [count] for name, count in zip(target_state.MAP_CAUSES, state.times)}
    shown |= {field_of("map.chunk", name): [count] for name, count in zip(target_state.CHUNK_FATES, state.chunks)}
    return shown | ({"iogrid.map.attribution": [state.attribution]} if state.attribution else {})


def shown_of_frame_end(frame: int, end: grid_stream.FrameEnd) -> dict[str, list]:
    lost = f", {end.tiles_lost} not sent" if end.tiles_lost else ""
    shown = {"_ws.col.Info": [f"frame {frame} end, {end.tiles_sent} tiles, grid {end.crc:08x}{lost}"],
             "iogrid.tiles_sent": [end.tiles_sent], "iogrid.tiles_lost": [end.tiles_lost],
             "iogrid.grid_crc": [f"0x{end.crc:08x}"], "iogrid.opened_us": [end.opened_us]}
    shown |= {field_of("fate", name): [count] for name, count in zip(target_state.FATES, end.fates)}
    shown |= {field_of("drop" if name in target_state.PACKET_DROPS else "link", name): [count]
              for name, count in end.counters.items()}
    for name, field in (("state", "state"), ("blocked", "blocked"), ("age", "age"), ("packets", "packets"),
                        ("points", "points"), ("scan_number", "scan")):
        shown[f"iogrid.sensor.{field}"] = [getattr(sensor, name) for sensor in end.sensors]
    return shown | {"iogrid.unwatched": [f"0x{end.unwatched:016x}"], "iogrid.blocked": [f"0x{end.blocked:016x}"],
                    "iogrid.temperature": [end.temperature_dc]}
