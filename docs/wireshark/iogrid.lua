-- Shows iogrid's grid stream (docs/spec.md section 3) in Wireshark and tshark 4.0 or newer.
--
--   wireshark -X lua_script:docs/wireshark/iogrid.lua build/host/tools/sample_stream.pcap
--   tshark -X lua_script:docs/wireshark/iogrid.lua -r build/host/tools/sample_stream.pcap
--
-- With this folder copied into Wireshark's personal Lua plugins it is always there. SOME/IP is
-- Wireshark's own dissector; this one is called for the payload of the stream's two events,
-- whatever carries them, and has the stream's UDP port taken as SOME/IP. Every field is a filter:
-- iogrid.frame == 17 && iogrid.tile == 480, iogrid.crc.status == 0, iogrid.drop.duplicate > 0.
local codes = require("iogrid_codes")
local layout = require("iogrid_layout")

local PORT = 15000
local DATA_ID_OF_MESSAGE = { [0x4F478001] = 0x494F4701, [0x4F478002] = 0x494F4702 }
local INTERFACE_VERSION = 2
local SOME_IP_PART_BYTES = 8  -- of the SOME/IP header, that both lengths count
local TILES, FRAME_END = 1, 2
local RAW, RUN_LENGTH, QUADTREE, CHANGED_SINCE = 0, 1, 2, 3
local TILE_SIDE_LOG2, TILE_CELLS = 5, 1024
local CRC_STATUS = { [0] = "bad", [1] = "good", [2] = "not checked" }

local iogrid = Proto("iogrid", "iogrid grid stream")
local fields = {}

local function declare(kind, name, label, ...)
  fields[name] = ProtoField[kind]("iogrid." .. name, label, ...)
end

for _, part in pairs(layout.PARTS) do
  for _, field in ipairs(part) do
    if #field > 1 then declare(table.unpack(field)) end
  end
end
for _, group in pairs(layout.COUNTERS) do
  for _, name in ipairs(group[3]) do
    declare("uint32", layout.filter_name(group[1], name), name, base.DEC)
  end
end
declare("uint32", "counter", "counter without a name", base.DEC)
declare("uint8", "crc.status", "CRC status", base.DEC, CRC_STATUS)
declare("bool", "flags.by_time", "Closed by time", 8, nil, 0x01)
declare("bool", "flags.bayes", "Fused by the rule bayes", 8, nil, 0x02)
declare("uint16", "tile.x", "Tile x", base.DEC)
declare("uint16", "tile.y", "Tile y", base.DEC)
declare("bytes", "tile.payload", "Payload")
declare("uint16", "tile.values", "Values", base.DEC)
declare("uint16", "tile.runs", "Runs", base.DEC)
declare("uint16", "tile.leaves", "Leaves", base.DEC)
declare("uint32", "tile.reference", "Changed since frame", base.DEC)
declare("bytes", "unknown", "Not understood")
iogrid.fields = fields

local function expert_of(name, label, group, severity)
  return ProtoExpert.new("iogrid.expert." .. name, label, group, severity)
end
local experts = {
  bad_crc = expert_of("bad_crc", "The CRC is wrong", expert.group.CHECKSUM, expert.severity.ERROR),
  malformed = expert_of("malformed", "Malformed", expert.group.MALFORMED, expert.severity.ERROR),
  contradiction = expert_of("contradiction", "The headers contradict each other",
                            expert.group.PROTOCOL, expert.severity.WARN),
  unknown = expert_of("unknown", "Not understood", expert.group.UNDECODED, expert.severity.WARN),
  lost = expert_of("lost", "Lost", expert.group.SEQUENCE, expert.severity.NOTE),
}
iogrid.experts = experts

-- Calls read(...). What is malformed is an error that is a table, and is said at the item; any other
-- error is one of this script.
local function guarded(item, read, ...)
  local is_sound, problem = pcall(read, ...)
  if is_sound then return end
  if type(problem) ~= "table" then error(problem, 0) end
  item:add_proto_expert_info(experts.malformed, problem.text)
end

-- Takes byte ranges off a message, one after the other.
local function cursor_of(tvb)
  local at = 0
  local cursor = {}
  function cursor.left() return tvb:len() - at end
  function cursor.take(bytes, what)
    if bytes > cursor.left() then
      codes.malformed("%d bytes are left where %s needs %d", cursor.left(), what, bytes)
    end
    at = at + bytes
    return tvb:range(at - bytes, bytes)
  end
  return cursor
end

local function value_of(kind, range)
  if kind == "int32" then return range:int() end
  if kind == "uint64" then return range:uint64() end
  return range:uint()
end

-- Adds a part to the tree. Its values and its items, by name.
local function add_part(tree, range, part)
  local values, items = {}, {}
  local at = 0
  for _, field in ipairs(part) do
    local kind, name = field[1], field[2]
    local bytes = range:range(at, layout.BYTES[kind])
    if name then
      values[name], items[name] = value_of(kind, bytes), tree:add(fields[name], bytes)
    end
    at = at + bytes:len()
  end
  return values, items
end

-- Takes the part off the message and adds it below a heading that covers all that is left.
local function add_section(tree, cursor, part, heading)
  local range = cursor.take(layout.bytes_of(part), heading)
  local item = tree:add(range, heading):set_len(range:len() + cursor.left())
  local values, items = add_part(item, range, part)
  return item, values, items
end

local function add_generated(tree, name, range, value)
  return tree:add(fields[name], range, value):set_generated(true)
end

local function add_counts(tree, range, name, values, count)
  add_generated(tree, "tile.values", range, values)
  add_generated(tree, "tile." .. name, range, count)
  tree:append_text(string.format(", values %d, %s %d", values, name, count))
end

-- Each shows what one encoding's payload holds.
local show_payload = {
  [RAW] = function(_, range)
    if range:len() ~= TILE_CELLS then codes.malformed("%d bytes of a raw tile", range:len()) end
  end,
  [RUN_LENGTH] = function(tree, range)
    add_counts(tree, range, "runs", codes.count_runs(range:raw(), 0))
  end,
  [QUADTREE] = function(tree, range)
    add_counts(tree, range, "leaves", codes.count_leaves(range:raw()))
  end,
  [CHANGED_SINCE] = function(tree, range)
    if range:len() < 4 then codes.malformed("the payload ends in its frame number") end
    tree:add(fields["tile.reference"], range:range(0, 4))
    tree:append_text(string.format(" frame %d", range:range(0, 4):uint()))
    add_counts(tree, range, "runs", codes.count_runs(range:raw():sub(5), 1))
  end,
}

-- One tile of a message that speaks of those in `header`. Returns its number.
local function show_tile(tree, cursor, header, before)
  local range = cursor.take(layout.bytes_of(layout.PARTS.tile), "a tile")
  local item = tree:add(range, "Tile")
  local tile = add_part(item, range, layout.PARTS.tile)
  local number, encoding, bytes = tile.tile, tile["tile.encoding"], tile["tile.bytes"]
  local across = bit.rshift(header.width, header.side_log2 % 32)
  if across > 0 then
    local x, y = number % across, math.floor(number / across)
    add_generated(item, "tile.x", range, x)
    add_generated(item, "tile.y", range, y)
    item:set_text(string.format("Tile %d (x %d, y %d)", number, x, y))
  end
  item:append_text(string.format(", %d bytes, %s", bytes,
                                 layout.ENCODINGS[encoding] or "unknown encoding"))
  local payload = bytes > 0 and cursor.take(bytes, "a tile's payload")
  item:set_len(range:len() + bytes)
  if payload then item:add(fields["tile.payload"], payload) end
  guarded(item, function()
    if number <= before or number < header["tiles.first"] or number >= header["tiles.end"] then
      codes.malformed("tile %d is out of order", number)
    end
    if not payload or bytes > TILE_CELLS then codes.malformed("%d bytes of payload", bytes) end
    if show_payload[encoding] and header.side_log2 == TILE_SIDE_LOG2 then
      show_payload[encoding](item, payload)
    else
      item:add_proto_expert_info(experts.unknown, "an encoding or a tile's side that is not known")
    end
  end)
  return number
end

local function show_tiles(tree, cursor, info)
  local item, header, items = add_section(tree, cursor, layout.PARTS.tiles, "Tiles")
  local first, last, count = header["tiles.first"], header["tiles.end"] - 1, header["tiles.count"]
  info(string.format(", tiles %d-%d, %d of them", first, last, count))
  if not layout.STORAGES[header.storage] then
    items.storage:add_proto_expert_info(experts.unknown, "a storage that is not known")
  elseif header.storage ~= 0 then
    info(string.format(", cells of %d mm", header.cell_mm))
  end
  item:append_text(string.format(" %d to %d: %d follow, nothing is known of the others", first,
                                 last, count))
  local before = -1
  for _ = 1, count do before = show_tile(item, cursor, header, before) end
end

-- As many counters as the message has, with names as far as they are known. Values and items.
local function show_counters(tree, cursor, count, group)
  local prefix, heading, names = table.unpack(group)
  local values, items = {}, {}
  if count == 0 then return values, items end
  local range = cursor.take(4 * count, heading)
  local item = tree:add(range, heading)
  for i = 1, count do
    local name = names[i] and layout.filter_name(prefix, names[i]) or "counter"
    local bytes = range:range(4 * i - 4, 4)
    values[i], items[i] = bytes:uint(), item:add(fields[name], bytes)
  end
  return values, items
end

local function show_sensors(tree, cursor, count)
  local size_part, part = layout.PARTS.sensor_size, layout.PARTS.sensor
  local size = add_part(tree, cursor.take(layout.bytes_of(size_part), "a size"), size_part)
  size = size["sensor_bytes"]
  if size < layout.bytes_of(part) then codes.malformed("a sensor record of %d bytes", size) end
  for i = 0, count - 1 do
    local range = cursor.take(size, "a sensor record")
    local item = tree:add(range, string.format("Sensor %d", i))
    local sensor, items = add_part(item, range, part)
    if sensor["sensor.age"] == 0xFFFF then
      items["sensor.age"]:append_text(" (never seen, or longer ago)")
    end
    local state = sensor["sensor.state"]
    item:append_text(string.format(": %s, packets %d, points %d",
                                   layout.SENSOR_STATES[state] or "unknown state",
                                   sensor["sensor.packets"], sensor["sensor.points"]))
  end
end

local function show_frame_end(tree, cursor, info, sensor_count)
  local item, frame_end, items = add_section(tree, cursor, layout.PARTS.frame_end, "Frame end")
  info(string.format(" end, %d tiles, grid %08x", frame_end.tiles_sent, frame_end.grid_crc))
  if frame_end.tiles_lost > 0 then
    info(string.format(", %d not sent", frame_end.tiles_lost))
    items.tiles_lost:add_proto_expert_info(experts.lost, "the network took no message for them")
  end
  local ticks, tick_items = show_counters(item, cursor, frame_end.stages, layout.COUNTERS.stages)
  for i, tick_item in ipairs(tick_items) do
    local hz = frame_end.stopwatch_hz
    if hz > 0 then tick_item:append_text(string.format(" (%.0f us)", ticks[i] * 1e6 / hz)) end
  end
  for _, name in ipairs({ "fates", "drop_causes", "link_counters" }) do
    show_counters(item, cursor, frame_end[name], layout.COUNTERS[name])
  end
  show_sensors(item, cursor, sensor_count)
end

-- " (sensors 0, 2)" of the bits of a byte.
local function sensors_of(bits)
  local numbers = {}
  for i = 0, 7 do
    if bit.band(bit.rshift(bits, i), 1) == 1 then numbers[#numbers + 1] = i end
  end
  return #numbers == 0 and " (none)" or " (sensors " .. table.concat(numbers, ", ") .. ")"
end

local function show_header(tree, cursor)
  local range = cursor.take(layout.bytes_of(layout.PARTS.header), "the header")
  local item = tree:add(range, "Header")
  local header, items = add_part(item, range, layout.PARTS.header)
  items.flags:add(fields["flags.by_time"], range:range(1, 1))
  items.flags:add(fields["flags.bayes"], range:range(1, 1))
  items.complete:append_text(sensors_of(header.complete))
  items.partial:append_text(sensors_of(header.partial))
  local more = header.header_bytes - range:len()
  if more < 0 then codes.malformed("a header of %d bytes", header.header_bytes) end
  if more > 0 then item:add(fields.unknown, cursor.take(more, "the rest of the header")) end
  return header, items
end

local function show_content(tree, cursor, info, counter)
  local header, items = show_header(tree, cursor)
  if header.sequence % 0x10000 ~= counter then
    items.sequence:add_proto_expert_info(experts.contradiction, "the E2E counter is another")
  end
  info(string.format("frame %d", header.frame))
  if header.type == TILES then
    show_tiles(tree, cursor, info)
  elseif header.type == FRAME_END then
    show_frame_end(tree, cursor, info, header.sensors)
  else
    info(string.format(", message type %d", header.type))
    items.type:add_proto_expert_info(experts.unknown, "a message type that is not known")
    return
  end
  if cursor.left() > 0 then codes.malformed("%d bytes follow the message", cursor.left()) end
end

-- What Wireshark's dissector has read of the SOME/IP header. Fields have values only where a tree
-- is built; what needs them is not checked elsewhere.
local some_ip = {
  { 2, Field.new("someip.clientid") }, { 2, Field.new("someip.sessionid") },
  { 1, Field.new("someip.protoversion") }, { 1, Field.new("someip.interfaceversion") },
  { 1, Field.new("someip.messagetype") }, { 1, Field.new("someip.returncode") },
}
local interface_version = some_ip[4][2]
local message_id = Field.new("someip.messageid")

-- A datagram may hold several messages; the last value is that of the one in hand.
local function last_value(field)
  local all = { field() }
  return all[#all] and all[#all].value
end

-- The eight bytes before the payload, or nil.
local function some_ip_bytes()
  local text = ""
  for _, part in ipairs(some_ip) do
    local bytes, value = part[1], last_value(part[2])
    if not value then return nil end
    if bytes == 2 then text = text .. string.char(math.floor(value / 256)) end
    text = text .. string.char(value % 256)
  end
  return text
end

local function crc_status(tvb, crc)
  local before = some_ip_bytes()
  if not before or tvb:len() ~= tvb:reported_len() then return 2 end
  local behind = tvb:len() > 12 and tvb:raw(12) or ""
  return codes.crc32_p4(before, tvb:raw(0, 8), behind) == crc and 1 or 0
end

-- The last counter of each sender; how far each message is ahead of the one before. They are found
-- while the file is read for the first time, from its beginning.
local last_counters, deltas

function iogrid.init()
  last_counters, deltas = {}, {}
end

local function delta_of(tvb, pinfo, e2e)
  local message = string.format("%d:%d", pinfo.number, tvb:offset())
  if not pinfo.visited then
    local sender = string.format("%s:%d:%x", pinfo.src, pinfo.src_port, e2e["e2e.data_id"])
    local counter, before = e2e["e2e.counter"], last_counters[sender]
    deltas[message] = before and (counter - before) % 0x10000
    last_counters[sender] = counter
  end
  return deltas[message] or 1
end

local function show_order(item, delta)
  if delta == 1 then return end
  local remark = string.format("messages missing before this one: %d", delta - 1)
  if delta == 0 then remark = "the same counter once more" end
  if delta >= 0x8000 then remark = "late, or its sender has started over" end
  item:add_proto_expert_info(experts.lost, remark)
end

-- Returns the counter.
local function show_e2e(tree, cursor, tvb, pinfo, info)
  local range = cursor.take(layout.bytes_of(layout.PARTS.e2e), "the E2E header")
  local item = tree:add(range, "E2E Profile 4")
  local e2e, items = add_part(item, range, layout.PARTS.e2e)
  if e2e["e2e.length"] ~= tvb:reported_len() + SOME_IP_PART_BYTES then
    items["e2e.length"]:add_proto_expert_info(experts.contradiction, "not the SOME/IP length")
  end
  local id = last_value(message_id)
  if id and e2e["e2e.data_id"] ~= DATA_ID_OF_MESSAGE[id] then
    items["e2e.data_id"]:add_proto_expert_info(experts.contradiction, "not that of this event")
  end
  local status = crc_status(tvb, e2e.crc)
  local status_item = add_generated(items.crc, "crc.status", range:range(8, 4), status)
  if status == 0 then
    info("wrong CRC: ")
    status_item:add_proto_expert_info(experts.bad_crc)
  else
    show_order(items["e2e.counter"], delta_of(tvb, pinfo, e2e))
  end
  items.crc:append_text(", " .. CRC_STATUS[status])
  item:append_text(string.format(", counter %d, CRC %s", e2e["e2e.counter"], CRC_STATUS[status]))
  return e2e["e2e.counter"]
end

function iogrid.dissector(tvb, pinfo, tree)
  pinfo.cols.protocol = "iogrid"
  local item = tree:add(iogrid, tvb())
  local version = last_value(interface_version)
  if version and version ~= INTERFACE_VERSION then
    pinfo.cols.info = string.format("grid stream of interface version %d", version)
    item:add_proto_expert_info(experts.unknown, "another interface version is another format")
    return tvb:len()
  end
  local words = ""
  local function info(more)
    words = words .. more
    pinfo.cols.info = words
  end
  guarded(item, function()
    local cursor = cursor_of(tvb)
    show_content(item, cursor, info, show_e2e(item, cursor, tvb, pinfo, info))
  end)
  item:append_text(words == "" and ", damaged" or ", " .. words)
  return tvb:len()
end

for id in pairs(DATA_ID_OF_MESSAGE) do
  DissectorTable.get("someip.messageid"):add(id, iogrid)
end
DissectorTable.get("udp.port"):add(PORT, Dissector.get("someip_udp"))
