-- What stands where in iogrid's messages, and what it is called: docs/spec.md section 3 as tables.
--
-- A part is a list of fields in the order of their bytes: type, name of the filter below "iogrid.",
-- label, base and value names as ProtoField takes them. A field with a type alone is not shown.
local layout = {}

layout.TYPES = { [1] = "tiles", [2] = "frame end" }
layout.STORAGES = { [0] = "occupancy index", [1] = "highest index of the cells below" }
layout.ENCODINGS = { [0] = "raw", [1] = "run length", [2] = "quadtree", [3] = "changed since" }
layout.SENSOR_STATES = { [0] = "never seen", "silent", "partial", "complete" }
layout.DATA_IDS = { [0x494F4701] = "stream over UDP", [0x494F4702] = "stream over the UART" }
layout.VEHICLES = {}  -- by the CRC-32 of their names
for _, name in ipairs({ "reference_car", "two_lux_parking", "roof_vlp16" }) do
  layout.VEHICLES[require("iogrid_codes").crc32_zlib(name)] = name
end

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
  { "uint32", "vehicle", "Vehicle", base.HEX, layout.VEHICLES },
  { "uint8", "sensors", "Sensors", base.DEC },
  { "uint8", "complete", "Sensors that delivered their whole scan", base.HEX },
  { "uint8", "partial", "Sensors that delivered a part of it", base.HEX },
  { "uint8" },
  { "uint32", "points_used", "Scan points that carved and marked", base.DEC },
  { "uint32", "points_other", "Scan points with another fate", base.DEC },
  { "uint32", "packets", "Packets fused", base.DEC },
  { "uint32", "dropped", "Datagrams dropped since start", base.DEC },
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
  { "uint16" },
  { "int32", "x_mm", "Lowest x, mm", base.DEC },
  { "int32", "y_mm", "Lowest y, mm", base.DEC },
}
layout.PARTS.tile = {
  { "uint16", "tile", "Tile number", base.DEC },
  { "uint8", "tile.encoding", "Encoding", base.DEC, layout.ENCODINGS },
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
layout.PARTS.sensor_size = {
  { "uint8", "sensor_bytes", "Bytes of a sensor record", base.DEC },
  { "uint8" }, { "uint8" }, { "uint8" },
}
layout.PARTS.sensor = {
  { "uint8", "sensor.state", "State", base.DEC, layout.SENSOR_STATES },
  { "uint8" },
  { "uint16", "sensor.age", "Age, frames", base.DEC },
  { "uint16", "sensor.packets", "Packets", base.DEC },
  { "uint16" },
  { "uint32", "sensor.points", "Points", base.DEC },
  { "uint32", "sensor.scan", "Scan number", base.DEC },
}

local STAGES = { "fuse", "mark", "publish" }
local FATES = { "used", "no return", "too near", "too far", "outside the height band", "flagged",
                "later echo", "malformed" }
local DROPS = { "stranger", "wrong length", "wrong type", "wrong angle", "wrong point", "duplicate",
                "late", "over budget" }
local LINK = {
  "frames received", "datagrams delivered", "ARP answered", "ARP learned", "pings answered",
  "messages sent", "ARP requested",
  "short", "not for us (MAC)", "VLAN tagged", "neither IPv4 nor ARP", "bad IP header",
  "bad IP checksum", "fragment", "not for us (IP)", "bad source", "neither UDP nor ICMP",
  "bad UDP length", "bad UDP checksum", "bad ICMP", "ping ignored", "other ICMP", "bad ARP",
  "ARP ignored", "address conflict", "reply without room",
  "peer unresolved", "ring full", "misuse",
  "port received", "receive errors", "oversized", "port sent", "port refused",
}

-- Lists of counters: name of the filter, heading, names in order.
layout.COUNTERS = {
  stages = { "ticks", "Ticks of the stopwatch; publish is that of the frame before", STAGES },
  fates = { "fate", "Scan points of this frame by fate", FATES },
  drop_causes = { "drop", "Datagrams dropped since start", DROPS },
  link_counters = { "link", "Link counters since start", LINK },
}

-- "not for us (MAC)" is counted in link.not_for_us_mac.
function layout.filter_name(prefix, name)
  return prefix .. "." .. name:lower():gsub("[^%w]+", "_"):gsub("_$", "")
end

layout.BYTES = { uint8 = 1, uint16 = 2, uint32 = 4, int32 = 4, uint64 = 8 }

function layout.bytes_of(part)
  local sum = 0
  for _, field in ipairs(part) do sum = sum + layout.BYTES[field[1]] end
  return sum
end

return layout
