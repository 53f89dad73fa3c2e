-- The ends of iogrid's frames, of both grids: counters, sensors, slices, and the map in use.
local codes = require("iogrid_codes")
local layout = require("iogrid_layout")
local parts = require("iogrid_parts")
local tiles = require("iogrid_tiles")

local fields, experts = parts.fields, parts.experts
local ends = {}

local function show_sensors(tree, cursor, count)
  local size_part, part = layout.PARTS.sensor_size, layout.PARTS.sensor
  local size = parts.add_part(tree, cursor.take(layout.bytes_of(size_part), "a size"), size_part)
  size = size["sensor_bytes"]
  if size < layout.bytes_of(part) then codes.malformed("a sensor record of %d bytes", size) end
  for i = 0, count - 1 do
    local range = cursor.take(size, "a sensor record")
    local item = tree:add(range, string.format("Sensor %d", i))
    local sensor, items = parts.add_part(item, range, part)
    if sensor["sensor.age"] == 0xFFFF then
      items["sensor.age"]:append_text(" (never seen, or longer ago)")
    end
    local state = sensor["sensor.state"]
    item:append_text(string.format(": %s, packets %d, points %d",
                                   layout.SENSOR_STATES[state] or "unknown state",
                                   sensor["sensor.packets"], sensor["sensor.points"]))
  end
end

function ends.show_frame_end(tree, cursor, info, sensor_count)
  local item, frame_end, items = parts.add_section(tree, cursor, layout.PARTS.frame_end,
                                                   "Frame end")
  info(string.format(" end, %d tiles, grid %08x", frame_end.tiles_sent, frame_end.grid_crc))
  if frame_end.tiles_lost > 0 then
    info(string.format(", %d not sent", frame_end.tiles_lost))
    items.tiles_lost:add_proto_expert_info(experts.lost, "the network took no message for them")
  end
  local ticks, tick_items = parts.show_counters(item, cursor, frame_end.stages,
                                                 layout.COUNTERS.stages)
  for i, tick_item in ipairs(tick_items) do
    local hz = frame_end.stopwatch_hz
    if hz > 0 then tick_item:append_text(string.format(" (%.0f us)", ticks[i] * 1e6 / hz)) end
  end
  for _, name in ipairs({ "fates", "drop_causes", "link_counters" }) do
    parts.show_counters(item, cursor, frame_end[name], layout.COUNTERS[name])
  end
  show_sensors(item, cursor, sensor_count)
  local tail = layout.PARTS.tail
  parts.add_part(item, cursor.take(layout.bytes_of(tail), "sectors and temperature"), tail)
end

-- What the target says of its map, and skips what it does not know of it.
local function show_map(tree, cursor)
  local part = layout.PARTS.map
  local before = cursor.left()
  local range = cursor.take(layout.bytes_of(part), "the map's part")
  local item = tree:add(range, "Map")
  local map, items = parts.add_part(item, range, part)
  if map["map.bytes"] > before then codes.malformed("a map's part of %d bytes", map["map.bytes"]) end
  item:set_len(map["map.bytes"])
  for _, flag in ipairs({ "in_use", "transform" }) do
    items["map.flags"]:add(fields["map.flags." .. flag], range:range(10, 1))
  end
  local turns = map["map.heading"] / 2 ^ 32
  items["map.heading"]:append_text(string.format(" (%.3f degrees)", 360 * turns))
  parts.show_counters(item, cursor, map["map.causes"], layout.COUNTERS.map_causes)
  parts.show_counters(item, cursor, map["map.fates"], layout.COUNTERS.map_fates)
  if map["map.attribution_bytes"] > 0 then
    local text = cursor.take(map["map.attribution_bytes"], "the attribution")
    item:add(fields["map.attribution"], text, text:string(ENC_UTF_8))
  end
  local more = map["map.bytes"] - (before - cursor.left())
  if more < 0 then codes.malformed("a map's part of %d bytes", map["map.bytes"]) end
  if more > 0 then item:add(fields.unknown, cursor.take(more, "the rest of the map's part")) end
end

function ends.show_class_end(tree, cursor, info)
  local window = tiles.show_window(tree, cursor)
  local item, class_end, items = parts.add_section(tree, cursor, layout.PARTS.class_end,
                                                   "End of the classes")
  info(string.format(" classes' end, %d tiles, grid %08x", class_end.class_tiles_sent,
                     class_end.class_crc))
  if class_end.class_tiles_lost > 0 then
    info(string.format(", %d not sent", class_end.class_tiles_lost))
    items.class_tiles_lost:add_proto_expert_info(experts.lost, "the network took no message for them")
  end
  if class_end.slices ~= window["window.slices"] then
    items.slices:add_proto_expert_info(experts.contradiction, "not as many as the window says")
  end
  parts.show_counters(item, cursor, class_end.pose_fates, layout.COUNTERS.pose_fates)
  parts.show_records(item, cursor, class_end.causes, class_end.cause_bytes, layout.PARTS.cause,
                     function(i) return "Cause: " .. (layout.SLICE_CAUSES[i] or "without a name") end)
  parts.show_records(item, cursor, class_end.slices, class_end.slice_bytes, layout.PARTS.slice,
                     function(i) return string.format("Slice %d", i - 1) end)
  show_map(item, cursor)
end

return ends
