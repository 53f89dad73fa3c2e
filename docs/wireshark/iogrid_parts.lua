-- How a part of iogrid's messages gets into Wireshark's tree: its fields, its items, its remarks.
local codes = require("iogrid_codes")
local layout = require("iogrid_layout")

-- Fields and experts: by the names that their filters have, once a protocol has them.
local parts = { fields = {}, experts = {} }
local fields, experts = parts.fields, parts.experts

parts.CRC_STATUS = { [0] = "bad", [1] = "good", [2] = "not checked" }

local function declare(kind, name, label, ...)
  fields[name] = ProtoField[kind]("iogrid." .. name, label, ...)
end

local function declare_all()
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
  declare("uint8", "crc.status", "CRC status", base.DEC, parts.CRC_STATUS)
  declare("bool", "flags.by_time", "Closed by time", 8, nil, 0x01)
  declare("bool", "flags.bayes", "Fused by the rule bayes", 8, nil, 0x02)
  declare("bool", "flags.classes", "With messages of classes", 8, nil, 0x04)
  declare("bool", "flags.no_indexes", "Without tiles of occupancy indexes", 8, nil, 0x08)
  declare("bool", "flags.objects", "With messages of objects", 8, nil, 0x10)
  declare("bool", "flags.receptions", "With messages of what was received", 8, nil, 0x20)
  declare("bool", "reception.left", "Left for want of time", 8, nil, 0x01)
  declare("bool", "object.flags.heading", "The heading is known", 16, nil, 0x01)
  declare("bool", "object.flags.not_hit", "Not hit in this frame", 16, nil, 0x02)
  declare("bool", "object.flags.end_hidden", "An end is hidden", 16, nil, 0x04)
  declare("uint16", "tile.x", "Tile x", base.DEC)
  declare("uint16", "tile.y", "Tile y", base.DEC)
  declare("int32", "tile.a", "Tile a of the local frame", base.DEC)
  declare("int32", "tile.b", "Tile b of the local frame", base.DEC)
  for mask, cause in pairs(layout.CAUSES) do
    declare("bool", "window.cause." .. cause:gsub(" ", "_"), cause, 16, nil, mask)
  end
  declare("bool", "map.flags.in_use", "A map is in use", 8, nil, 0x01)
  declare("bool", "map.flags.transform", "The poses say where the map is", 8, nil, 0x02)
  declare("string", "map.attribution", "Attribution")
  declare("bytes", "tile.payload", "Payload")
  declare("uint16", "tile.values", "Values", base.DEC)
  declare("uint16", "tile.runs", "Runs", base.DEC)
  declare("uint8", "tile.reference_age", "Against the tile of so many frames before", base.DEC)
  declare("bytes", "unknown", "Not understood")
end

local function expert_of(name, label, group, severity)
  return ProtoExpert.new("iogrid.expert." .. name, label, group, severity)
end

local function make_experts()
  experts.bad_crc = expert_of("bad_crc", "The CRC is wrong", expert.group.CHECKSUM,
                              expert.severity.ERROR)
  experts.malformed = expert_of("malformed", "Malformed", expert.group.MALFORMED,
                                expert.severity.ERROR)
  experts.contradiction = expert_of("contradiction", "The headers contradict each other",
                                    expert.group.PROTOCOL, expert.severity.WARN)
  experts.unknown = expert_of("unknown", "Not understood", expert.group.UNDECODED,
                              expert.severity.WARN)
  experts.lost = expert_of("lost", "Lost", expert.group.SEQUENCE, expert.severity.NOTE)
end

-- Gives a protocol its fields and experts.
function parts.give_to(protocol)
  declare_all()
  make_experts()
  protocol.fields, protocol.experts = fields, experts
end

-- Calls read(...). What is malformed is an error that is a table, and is said at the item; any other
-- error is one of this script.
function parts.guarded(item, read, ...)
  local is_sound, problem = pcall(read, ...)
  if is_sound then return end
  if type(problem) ~= "table" then error(problem, 0) end
  item:add_proto_expert_info(experts.malformed, problem.text)
end

-- Takes byte ranges off a message, one after the other.
function parts.cursor_of(tvb)
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
  if kind == "int32" or kind == "int16" then return range:int() end
  if kind == "uint64" then return range:uint64() end
  return range:uint()
end

-- Adds a part to the tree. Its values and its items, by name.
function parts.add_part(tree, range, part)
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
function parts.add_section(tree, cursor, part, heading)
  local range = cursor.take(layout.bytes_of(part), heading)
  local item = tree:add(range, heading):set_len(range:len() + cursor.left())
  local values, items = parts.add_part(item, range, part)
  return item, values, items
end

function parts.add_generated(tree, name, range, value)
  return tree:add(fields[name], range, value):set_generated(true)
end

-- As many counters as the message has, with names as far as they are known. Values and items.
function parts.show_counters(tree, cursor, count, group)
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

-- As many records of `bytes` each as the message has; `name` says what it is.
function parts.show_records(tree, cursor, count, bytes, part, name)
  if bytes < layout.bytes_of(part) then codes.malformed("a record of %d bytes", bytes) end
  for i = 1, count do
    local range = cursor.take(bytes, "a record")
    parts.add_part(tree:add(range, name(i)), range, part)
  end
end

return parts
