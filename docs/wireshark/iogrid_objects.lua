-- Things with a speed in iogrid's messages: docs/spec.md 3.12.
local codes = require("iogrid_codes")
local layout = require("iogrid_layout")
local parts = require("iogrid_parts")

local fields, experts = parts.fields, parts.experts
local objects = {}

local MOVES = 3
local NOT_BELIEVED = 0xFFFF

-- What contradicts itself is remarked, because no receiver uses such a message.
local function words_of(object, items)
  local state = object["object.state"]
  local x, y = object["object.vx_cm_s"], object["object.vy_cm_s"]
  if not layout.OBJECT_STATES[state] then
    items["object.state"]:add_proto_expert_info(experts.unknown, "a state that is not known")
    return "unknown state"
  end
  local has_velocity = object["object.sigma_v_along"] ~= NOT_BELIEVED
  if (x ~= 0 or y ~= 0) and state ~= MOVES or has_velocity ~= (state >= MOVES) then
    items["object.state"]:add_proto_expert_info(experts.contradiction, "a speed of what is not believed to move, or none")
  end
  if state ~= MOVES then return layout.OBJECT_STATES[state] end
  return string.format("moves, %.1f m/s", math.sqrt(x * x + y * y) / 100)
end

local function show_object(tree, range)
  local item = tree:add(range, "Object")
  local object, items = parts.add_part(item, range, layout.PARTS.object)
  for _, flag in ipairs({ "heading", "not_hit", "end_hidden" }) do
    items["object.flags"]:add(fields["object.flags." .. flag], range:range(22, 2))
  end
  items["object.heading"]:append_text(string.format(" (%.2f degrees)", 360 * object["object.heading"] / 65536))
  item:append_text(string.format(" %d: %s", object.object, words_of(object, items)))
  return object["object.state"] == MOVES and 1 or 0
end

function objects.show(tree, cursor, info)
  local part = layout.PARTS.objects
  local item, header, items = parts.add_section(tree, cursor, part, "Objects")
  local more = header["objects.header_bytes"] - layout.bytes_of(part)
  local size = header["objects.object_bytes"]
  if more < 0 then codes.malformed("an objects' header of %d bytes", header["objects.header_bytes"]) end
  if size < layout.bytes_of(layout.PARTS.object) then codes.malformed("an object of %d bytes", size) end
  if more > 0 then item:add(fields.unknown, cursor.take(more, "the rest of the objects' header")) end
  if header["objects.part"] >= header["objects.parts"] then
    items["objects.part"]:add_proto_expert_info(experts.contradiction, "a part beyond the last")
  end
  local count, moving = 0, 0
  while cursor.left() > 0 do
    moving = moving + show_object(item, cursor.take(size, "an object"))
    count = count + 1
  end
  info(string.format(" objects, part %d of %d, %d of them, %d moving", header["objects.part"] + 1,
                     header["objects.parts"], count, moving))
end

return objects
