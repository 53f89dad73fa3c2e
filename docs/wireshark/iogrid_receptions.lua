-- What a target has received, and when, in iogrid's messages: docs/spec.md 3.13.
local codes = require("iogrid_codes")
local layout = require("iogrid_layout")
local parts = require("iogrid_parts")

local fields, experts = parts.fields, parts.experts
local receptions = {}

function receptions.show(tree, cursor, info)
  local part = layout.PARTS.receptions
  local item, header, items = parts.add_section(tree, cursor, part, "Receptions")
  local more = header["receptions.header_bytes"] - layout.bytes_of(part)
  local size = header["receptions.record_bytes"]
  if more < 0 then codes.malformed("a receptions' header of %d bytes", header["receptions.header_bytes"]) end
  if size < layout.bytes_of(layout.PARTS.reception) then codes.malformed("a reception of %d bytes", size) end
  if more > 0 then item:add(fields.unknown, cursor.take(more, "the rest of the receptions' header")) end
  if header["receptions.part"] >= header["receptions.parts"] then
    items["receptions.part"]:add_proto_expert_info(experts.contradiction, "a part beyond the last")
  end
  local count = 0
  while cursor.left() > 0 do
    local range = cursor.take(size, "a reception")
    local each = tree:add(range, "Reception")
    local reception = parts.add_part(each, range, layout.PARTS.reception)
    each:add(fields["reception.left"], range:range(2, 1))
    each:append_text(string.format(", port %d, %d us before the end", reception["reception.port"],
                                   reception["reception.before_close_us"]))
    count = count + 1
  end
  info(string.format(" receptions, part %d of %d, %d of them", header["receptions.part"] + 1,
                     header["receptions.parts"], count))
end

return receptions
