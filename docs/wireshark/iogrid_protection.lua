-- The protection of iogrid's messages, E2E Profile 4: the CRC and the order of the counters.
local codes = require("iogrid_codes")
local layout = require("iogrid_layout")
local parts = require("iogrid_parts")

local experts = parts.experts
local protection = {}

-- The Data ID of each event, by its message ID.
protection.DATA_ID_OF_MESSAGE = { [0x4F478001] = 0x494F4701, [0x4F478002] = 0x494F4702 }
local SOME_IP_PART_BYTES = 8  -- of the SOME/IP header, that both lengths count

-- What Wireshark's dissector has read of the SOME/IP header. Fields have values only where a tree
-- is built; what needs them is not checked elsewhere.
local some_ip = {
  { 2, Field.new("someip.clientid") }, { 2, Field.new("someip.sessionid") },
  { 1, Field.new("someip.protoversion") }, { 1, Field.new("someip.interfaceversion") },
  { 1, Field.new("someip.messagetype") }, { 1, Field.new("someip.returncode") },
}
protection.interface_version = some_ip[4][2]
local message_id = Field.new("someip.messageid")

-- A datagram may hold several messages; the last value is that of the one in hand.
function protection.last_value(field)
  local all = { field() }
  return all[#all] and all[#all].value
end

-- The eight bytes before the payload, or nil.
local function some_ip_bytes()
  local text = ""
  for _, part in ipairs(some_ip) do
    local bytes, value = part[1], protection.last_value(part[2])
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

-- The last counter of each run of each sender; how far each message is ahead of the one before. They
-- are found while the file is read for the first time, from its beginning.
local last_counters, deltas

-- Another file is read.
function protection.forget()
  last_counters, deltas = {}, {}
end

-- The number of the run, or nil of a message that is too short for it.
local function run_of(tvb)
  local at = layout.bytes_of(layout.PARTS.e2e) + layout.bytes_of(layout.PARTS.header) - 4
  return tvb:len() >= at + 4 and tvb:range(at, 4):uint() or nil
end

local function delta_of(tvb, pinfo, e2e)
  local message = string.format("%d:%d", pinfo.number, tvb:offset())
  if not pinfo.visited then
    local sender = string.format("%s:%d:%x:%s", pinfo.src, pinfo.src_port, e2e["e2e.data_id"],
                                 run_of(tvb))
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
  if delta >= 0x8000 then remark = "late" end
  item:add_proto_expert_info(experts.lost, remark)
end

-- Returns the counter.
function protection.show(tree, cursor, tvb, pinfo, info)
  local range = cursor.take(layout.bytes_of(layout.PARTS.e2e), "the E2E header")
  local item = tree:add(range, "E2E Profile 4")
  local e2e, items = parts.add_part(item, range, layout.PARTS.e2e)
  if e2e["e2e.length"] ~= tvb:reported_len() + SOME_IP_PART_BYTES then
    items["e2e.length"]:add_proto_expert_info(experts.contradiction, "not the SOME/IP length")
  end
  local id = protection.last_value(message_id)
  if id and e2e["e2e.data_id"] ~= protection.DATA_ID_OF_MESSAGE[id] then
    items["e2e.data_id"]:add_proto_expert_info(experts.contradiction, "not that of this event")
  end
  local status = crc_status(tvb, e2e.crc)
  local status_item = parts.add_generated(items.crc, "crc.status", range:range(8, 4), status)
  if status == 0 then
    info("wrong CRC: ")
    status_item:add_proto_expert_info(experts.bad_crc)
  else
    show_order(items["e2e.counter"], delta_of(tvb, pinfo, e2e))
  end
  items.crc:append_text(", " .. parts.CRC_STATUS[status])
  item:append_text(string.format(", counter %d, CRC %s", e2e["e2e.counter"],
                                 parts.CRC_STATUS[status]))
  return e2e["e2e.counter"]
end

return protection
