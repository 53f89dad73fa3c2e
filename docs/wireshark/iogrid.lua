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
local parts = require("iogrid_parts")
local tiles = require("iogrid_tiles")
local ends = require("iogrid_ends")
local objects = require("iogrid_objects")
local receptions = require("iogrid_receptions")
local protection = require("iogrid_protection")

local PORT = 15000
local INTERFACE_VERSION = 5
local TILES, FRAME_END, CLASS_END, OBJECTS, RECEPTIONS = 1, 2, 3, 5, 6

local iogrid = Proto("iogrid", "iogrid grid stream")
parts.give_to(iogrid)
local fields, experts = parts.fields, parts.experts

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
  local header, items = parts.add_part(item, range, layout.PARTS.header)
  for _, flag in ipairs({ "by_time", "bayes", "classes", "no_indexes", "objects", "receptions" }) do
    items.flags:add(fields["flags." .. flag], range:range(1, 1))
  end
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
    tiles.show_tiles(tree, cursor, info)
  elseif header.type == FRAME_END then
    ends.show_frame_end(tree, cursor, info, header.sensors)
  elseif header.type == CLASS_END then
    ends.show_class_end(tree, cursor, info)
  elseif header.type == OBJECTS then
    objects.show(tree, cursor, info)
  elseif header.type == RECEPTIONS then
    receptions.show(tree, cursor, info)
  else
    info(string.format(", message type %d", header.type))
    items.type:add_proto_expert_info(experts.unknown, "a message type that is not known")
    return
  end
  if cursor.left() > 0 then codes.malformed("%d bytes follow the message", cursor.left()) end
end

iogrid.init = protection.forget

function iogrid.dissector(tvb, pinfo, tree)
  pinfo.cols.protocol = "iogrid"
  local item = tree:add(iogrid, tvb())
  local version = protection.last_value(protection.interface_version)
  if version and version ~= INTERFACE_VERSION then
    pinfo.cols.info = string.format("grid stream of interface version %d", version)
    item:add_proto_expert_info(experts.unknown, string.format(
      "the target sends interface version %d, this dissector reads %d", version,
      INTERFACE_VERSION))
    return tvb:len()
  end
  local words = ""
  local function info(more)
    words = words .. more
    pinfo.cols.info = words
  end
  parts.guarded(item, function()
    local cursor = parts.cursor_of(tvb)
    show_content(item, cursor, info, protection.show(item, cursor, tvb, pinfo, info))
  end)
  item:append_text(words == "" and ", damaged" or ", " .. words)
  return tvb:len()
end

for id in pairs(protection.DATA_ID_OF_MESSAGE) do
  DissectorTable.get("someip.messageid"):add(id, iogrid)
end
DissectorTable.get("udp.port"):add(PORT, Dissector.get("someip_udp"))
