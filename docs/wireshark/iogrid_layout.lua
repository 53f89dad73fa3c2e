-- What stands where in iogrid's messages, and what it is called: docs/spec.md section 3 as tables.
--
-- A part is a list of fields in the order of their bytes: type, name of the filter below "iogrid.",
-- label, base and value names as ProtoField takes them. A field with a type alone is not shown.
local state = require("iogrid_state")

local layout = {}

layout.TYPES = { [1] = "tiles", [2] = "frame end", [3] = "end of the classes",
                 [4] = "refused car", [5] = "objects", [6] = "receptions" }
layout.STORAGES = { [0] = "occupancy index", [1] = "highest index of the cells below",
                    [2] = "class" }
layout.CAUSES = { [0x01] = "late", [0x02] = "lost", [0x04] = "imprecise", [0x08] = "jump",
                  [0x10] = "restart", [0x20] = "over budget", [0x40] = "contradicted",
                  [0x80] = "drifting" }
layout.ENCODINGS = { [0] = "raw", [4] = "run starts", [5] = "run starts since" }
layout.OBJECT_STATES = { "young", "stands", "moves", "stopped" }
layout.SENSOR_STATES = { [0] = "never seen", "silent", "partial", "complete" }
layout.BLOCKED = { [0] = "no", "in some sectors", "in all" }
layout.DATA_IDS = { [0x494F4701] = "stream over UDP", [0x494F4702] = "stream over the UART" }

layout.MAP_CAUSES = { [0] = "none: some may", "no map", "no transform", "other origin", "imprecise",
                      "blurred", "no place", "outside", "contradicted" }
layout.MAP_SOURCES = { [0] = "none", "OpenStreetMap", "surveyed" }
layout.MAP_DELIVERIES = { [0] = "nothing on its way", "chunks are missing", "checked" }

layout.PARTS = {}
layout.PARTS.e2e = {
  { "uint16", "e2e.length", "Length", base.DEC },
  { "uint16", "e2e.counter", "Counter", base.DEC },
  { "uint32", "e2e.data_id", "Data id", base.HEX, layout.DATA_IDS },
  { "uint32", "crc", "CRC-32/P4", base.HEX },
}
layout.PARTS.header = {
  { "uint8", "type", "Message type", base.DEC, layout.TYPES },
  { "uint8", "flags", "Flags", base.HEX },
  { "uint16", "header_bytes", "Header bytes", base.DEC },
  { "uint32", "sequence", "Sequence number", base.DEC },
  { "uint32", "frame", "Frame", base.DEC },
  { "uint64", "closed_us", "Closed at, us", base.DEC },
  { "uint32", "vehicle", "Vehicle", base.HEX },
  { "uint8", "sensors", "Sensors", base.DEC },
  { "uint8", "complete", "Sensors that delivered their whole scan", base.HEX },
  { "uint8", "partial", "Sensors that delivered a part of it", base.HEX },
  { "uint8" },
  { "uint32", "points_used", "Scan points that carved and marked", base.DEC },
  { "uint32", "points_other", "Scan points with another fate", base.DEC },
  { "uint32", "packets", "Packets fused", base.DEC },
  { "uint32", "dropped", "Datagrams dropped since start", base.DEC },
  { "uint32", "run", "Number of the target's run", base.HEX },
}
layout.PARTS.tiles = {
  { "uint16", "tiles.first", "First tile spoken of", base.DEC },
  { "uint16", "tiles.end", "The one behind the last", base.DEC },
  { "uint16", "tiles.count", "Tiles that follow", base.DEC },
  { "uint8", "side_log2", "Side of a tile, cells, log2", base.DEC },
  { "uint8", "storage", "Storage", base.DEC, layout.STORAGES },
  { "uint16", "width", "Width of the grid, cells", base.DEC },
  { "uint16", "height", "Height of the grid, cells", base.DEC },
  { "uint16", "cell_mm", "Side of a cell, mm", base.DEC },
  { "uint16", "epsilon_e5", "Epsilon of the indexes, 1e-5", base.DEC },
  { "int32", "x_mm", "Lowest x, mm", base.DEC },
  { "int32", "y_mm", "Lowest y, mm", base.DEC },
}
layout.PARTS.window = {
  { "uint16", "window.bytes", "Bytes of the window's header", base.DEC },
  { "uint16", "window.causes", "Causes", base.HEX },
  { "int32", "window.a", "Lowest tile a of the local frame", base.DEC },
  { "int32", "window.b", "Lowest tile b of the local frame", base.DEC },
  { "int32", "window.x_mm", "Pose: x, mm", base.DEC },
  { "int32", "window.y_mm", "Pose: y, mm", base.DEC },
  { "uint32", "window.heading", "Pose: heading, turns / 2^32", base.DEC },
  { "uint16", "window.sigma_mm", "Deviation of the motion, mm", base.DEC },
  { "uint16", "window.sigma_10_urad", "Deviation of the heading, 10 urad", base.DEC },
  { "uint8", "window.slices", "Slices", base.DEC },
  { "uint8", "window.slice_ms", "Length of a slice, ms", base.DEC },
  { "uint16" },
  { "uint64", "window.begin_us", "The first slice began at, us", base.DEC },
  { "uint64", "window.end_us", "The last slice ended at, us", base.DEC },
}
layout.PARTS.tile = {
  { "uint16", "tile", "Tile number", base.DEC },
  { "uint8", "tile.encoding", "Encoding", base.DEC, layout.ENCODINGS },
  { "uint16", "tile.bytes", "Payload bytes", base.DEC },
}
layout.PARTS.class_tile = {
  { "uint16", "tile", "Tile number", base.DEC },
  { "uint8", "tile.encoding", "Encoding", base.DEC, layout.ENCODINGS },
  { "uint8", "tile.age", "Decided so many frames ago", base.DEC },
  { "uint16", "tile.bytes", "Payload bytes", base.DEC },
}
layout.PARTS.frame_end = {
  { "uint32", "tiles_sent", "Tiles sent", base.DEC },
  { "uint32", "tiles_lost", "Tiles known but not sent", base.DEC },
  { "uint32", "grid_crc", "Grid CRC", base.HEX },
  { "uint32", "stack_bytes", "Deepest stack since start, bytes", base.DEC },
  { "uint64", "opened_us", "Opened at, us", base.DEC },
  { "uint32", "stopwatch_hz", "Stopwatch rate, Hz", base.DEC },
  { "uint8", "stages", "Stages", base.DEC },
  { "uint8", "fates", "Fates", base.DEC },
  { "uint8", "drop_causes", "Drop causes", base.DEC },
  { "uint8", "link_counters", "Link counters", base.DEC },
}
layout.PARTS.class_end = {
  { "uint32", "class_tiles_sent", "Tiles of classes sent", base.DEC },
  { "uint32", "class_tiles_lost", "Tiles of classes known but not sent", base.DEC },
  { "uint32", "class_crc", "Name of the class grid", base.HEX },
  { "uint32", "packets_placed", "Packets that were placed", base.DEC },
  { "uint32", "packets_not_placed", "Packets that were not placed", base.DEC },
  { "uint32", "slices_over_budget", "Slices with a pose, and no room", base.DEC },
  { "uint32", "groups.fused", "Groups of cells fused", base.DEC },
  { "uint32", "groups.left", "Groups left: over budget", base.DEC },
  { "uint32", "groups.refreshed", "Groups refreshed", base.DEC },
  { "uint8", "pose_fates", "Fates of pose messages", base.DEC },
  { "uint8", "causes", "Causes", base.DEC },
  { "uint8", "cause_bytes", "Bytes of a cause", base.DEC },
  { "uint8", "slices", "Slices", base.DEC },
  { "uint8", "slice_bytes", "Bytes of a slice", base.DEC },
  { "uint8" }, { "uint8" }, { "uint8" },
}
layout.PARTS.cause = {
  { "uint32", "cause.slices", "Slices since start", base.DEC },
  { "uint32", "cause.times", "How often it began", base.DEC },
  { "uint64", "cause.since_us", "When it did last, us", base.DEC },
}
layout.PARTS.slice = {
  { "uint64", "slice.middle_us", "Its middle, us", base.DEC },
  { "int32", "slice.x_mm", "Pose: x, mm", base.DEC },
  { "int32", "slice.y_mm", "Pose: y, mm", base.DEC },
  { "uint32", "slice.heading", "Pose: heading, turns / 2^32", base.DEC },
  { "uint16", "slice.sigma_mm", "Deviation, mm", base.DEC },
  { "uint16", "slice.sigma_10_urad", "Deviation of the heading, 10 urad", base.DEC },
}
layout.PARTS.map = {
  { "uint16", "map.bytes", "Bytes of this part", base.DEC },
  { "uint8", "map.cause", "Why no cell has a class of the map", base.DEC, layout.MAP_CAUSES },
  { "uint8", "map.blur_cells", "Blur, cells", base.DEC },
  { "uint16", "map.tiles_drawn", "Tiles that have their part of the map", base.DEC },
  { "uint16", "map.tiles_outside", "Tiles outside of the map", base.DEC },
  { "uint16", "map.tiles_waiting", "Tiles that wait for their part", base.DEC },
  { "uint8", "map.flags", "Flags", base.HEX },
  { "uint8", "map.source", "Source of the map", base.DEC, layout.MAP_SOURCES },
  { "uint32", "map.crc", "CRC of the map in use", base.HEX },
  { "uint64", "map.origin", "Name of its plane's origin", base.HEX },
  { "uint64", "map.pose_origin", "Origin that the poses name", base.HEX },
  { "int32", "map.x_mm", "Local frame in that plane: x, mm", base.DEC },
  { "int32", "map.y_mm", "Local frame in that plane: y, mm", base.DEC },
  { "uint32", "map.heading", "Local frame in that plane: heading, turns / 2^32", base.DEC },
  { "uint16", "map.sigma_mm", "Deviation of that, mm", base.DEC },
  { "uint16", "map.sigma_10_urad", "Deviation of that heading, 10 urad", base.DEC },
  { "uint8", "map.delivery", "Delivery", base.DEC, layout.MAP_DELIVERIES },
  { "uint8", "map.refusal", "Why the last block was refused", base.DEC },
  { "uint8", "map.causes", "Causes", base.DEC },
  { "uint8", "map.fates", "Fates of chunks", base.DEC },
  { "uint32", "map.refused", "Blocks refused since start", base.DEC },
  { "uint32", "map.incoming_crc", "CRC of the block on its way", base.HEX },
  { "uint32", "map.incoming_bytes", "Its bytes", base.DEC },
  { "uint32", "map.chunks_there", "Its chunks that are there", base.DEC },
  { "uint8", "map.attribution_bytes", "Bytes of the attribution", base.DEC },
  { "uint8" }, { "uint8" }, { "uint8" },
}
layout.PARTS.objects = {
  { "uint16", "objects.header_bytes", "Bytes of this header", base.DEC },
  { "uint16", "objects.object_bytes", "Bytes of an object", base.DEC },
  { "uint16", "objects.count", "Objects in the frame", base.DEC },
  { "uint8", "objects.part", "Part, from 0", base.DEC },
  { "uint8", "objects.parts", "Parts", base.DEC },
  { "uint64", "objects.time_us", "All places are of, us", base.DEC },
  { "uint16", "objects.refused", "Things without room", base.DEC },
  { "uint16", "objects.hits_left", "Hits that were not looked at", base.DEC },
  { "uint32" },
}
layout.PARTS.object = {
  { "uint32", "object", "Object", base.DEC },
  { "uint8", "object.state", "State", base.DEC, layout.OBJECT_STATES },
  { "uint8", "object.existence", "How sure it is that it moves, of 255", base.DEC },
  { "uint16", "object.age", "Frames in which it was measured", base.DEC },
  { "int32", "object.x_mm", "Middle: x, mm", base.DEC },
  { "int32", "object.y_mm", "Middle: y, mm", base.DEC },
  { "uint16", "object.length_cm", "Length, cm", base.DEC },
  { "uint16", "object.width_cm", "Width, cm", base.DEC },
  { "uint16", "object.heading", "Heading, turns / 2^16", base.DEC },
  { "uint16", "object.flags", "Flags", base.HEX },
  { "int16", "object.vx_cm_s", "Velocity: x, cm/s", base.DEC },
  { "int16", "object.vy_cm_s", "Velocity: y, cm/s", base.DEC },
  { "uint16", "object.sigma_v_along", "Deviation of the velocity along, cm/s", base.DEC },
  { "uint16", "object.sigma_v_across", "Deviation of the velocity across, cm/s", base.DEC },
  { "uint16", "object.sigma_along", "Deviation of the place along, mm", base.DEC },
  { "uint16", "object.sigma_across", "Deviation of the place across, mm", base.DEC },
  { "uint16", "object.since_hit_ms", "Since it was hit last, ms", base.DEC },
  { "uint16", "object.since_stopped", "Since it stopped, 10 ms", base.DEC },
}
layout.PARTS.receptions = {
  { "uint16", "receptions.header_bytes", "Bytes of this header", base.DEC },
  { "uint16", "receptions.record_bytes", "Bytes of a reception", base.DEC },
  { "uint16", "receptions.count", "Receptions in the frame", base.DEC },
  { "uint8", "receptions.part", "Part, from 0", base.DEC },
  { "uint8", "receptions.parts", "Parts", base.DEC },
  { "uint32", "receptions.not_listed", "Received without room here", base.DEC },
  { "uint32" },
}
layout.PARTS.reception = {
  { "uint16", "reception.port", "UDP port", base.DEC },
  { "uint8", "reception.flags", "Flags", base.HEX },
  { "uint8" },
  { "uint32", "reception.key", "CRC-32 of its ends", base.HEX },
  { "uint32", "reception.before_close_us", "Taken before the end of the frame, us", base.DEC },
}
layout.PARTS.sensor_size = {
  { "uint8", "sensor_bytes", "Bytes of a sensor record", base.DEC },
  { "uint8" }, { "uint8" }, { "uint8" },
}
layout.PARTS.tail = {
  { "uint64", "unwatched", "Sectors of 64 around the vehicle that no sensor watches", base.HEX },
  { "uint64", "blocked", "Sectors of 64 in which a sensor is blocked", base.HEX },
  { "int16", "temperature", "Temperature of the chip, 1/10 degree Celsius (-32768: not known)", base.DEC },
  { "uint16" }, { "uint32" },
}
layout.PARTS.sensor = {
  { "uint8", "sensor.state", "State", base.DEC, layout.SENSOR_STATES },
  { "uint8", "sensor.blocked", "Blocked", base.DEC, layout.BLOCKED },
  { "uint16", "sensor.age", "Age, frames", base.DEC },
  { "uint16", "sensor.packets", "Packets", base.DEC },
  { "uint16" },
  { "uint32", "sensor.points", "Points", base.DEC },
  { "uint32", "sensor.scan", "Scan number", base.DEC },
}

-- Why slices had no place; the first: they had one.
layout.SLICE_CAUSES = state.SliceCause

-- Lists of counters: name of the filter, heading, names in order.
layout.COUNTERS = {
  stages = { "ticks", "Ticks of the stopwatch; publish is that of the frame before", state.Stage },
  fates = { "fate", "Scan points of this frame by fate", state.Fate },
  drop_causes = { "drop", "Datagrams dropped since start", state.PacketDrop },
  link_counters = { "link", "Link counters since start", state.Link },
  pose_fates = { "pose", "Pose messages since start by fate", state.PoseFate },
  map_causes = { "map.times", "How often the map began to be used, or not, since start", state.MapCause },
  map_fates = { "map.chunk", "Chunks of maps since start by fate", state.ChunkFate },
}

-- "not for us (MAC)" is counted in link.not_for_us_mac.
function layout.filter_name(prefix, name)
  return prefix .. "." .. name:lower():gsub("[^%w]+", "_"):gsub("_$", "")
end

layout.BYTES = { uint8 = 1, uint16 = 2, int16 = 2, uint32 = 4, int32 = 4, uint64 = 8 }

function layout.bytes_of(part)
  local sum = 0
  for _, field in ipairs(part) do sum = sum + layout.BYTES[field[1]] end
  return sum
end

return layout
