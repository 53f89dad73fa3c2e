-- The tiles of iogrid's messages, of both grids, and the window of classes that they lie in.
local codes = require("iogrid_codes")
local layout = require("iogrid_layout")
local parts = require("iogrid_parts")

local fields, experts = parts.fields, parts.experts
local tiles = {}

local RAW, RUN_STARTS, RUN_STARTS_SINCE = 0, 4, 5
local CLASSES = 2  -- a storage
local TILE_SIDE_LOG2, TILE_CELLS = 5, 1024

local function add_counts(tree, range, values, runs)
  parts.add_generated(tree, "tile.values", range, values)
  parts.add_generated(tree, "tile.runs", range, runs)
  tree:append_text(string.format(", values %d, runs %d", values, runs))
end

-- Each shows what one encoding's payload holds.
local show_payload = {
  [RAW] = function(_, range)
    if range:len() ~= TILE_CELLS then codes.malformed("%d bytes of a raw tile", range:len()) end
  end,
  [RUN_STARTS] = function(tree, range)
    add_counts(tree, range, codes.count_starts(range:raw()))
  end,
  [RUN_STARTS_SINCE] = function(tree, range)
    if range:len() < 1 then codes.malformed("the payload is empty") end
    tree:add(fields["tile.reference_age"], range:range(0, 1))
    tree:append_text(string.format(", %d frames ago", range:range(0, 1):uint()))
    add_counts(tree, range, codes.count_starts(range:raw():sub(2)))
  end,
}

-- The one of these places that is `remainder` modulo their number, all counted from `corner`.
local function place_of(corner, remainder, places)
  return corner + (remainder - corner) % places
end

-- Where a tile of the window lies in the local frame, in tiles.
local function show_place(item, range, window, x, y, across, up)
  local a = place_of(window["window.a"], x, across)
  local b = place_of(window["window.b"], y, up)
  parts.add_generated(item, "tile.a", range, a)
  parts.add_generated(item, "tile.b", range, b)
  item:append_text(string.format(", a %d, b %d", a, b))
end

-- One tile of a message that speaks of those in `header`; window: that of classes, or nil. Returns
-- its number.
local function show_tile(tree, cursor, header, window, before)
  local part = window and layout.PARTS.class_tile or layout.PARTS.tile
  local range = cursor.take(layout.bytes_of(part), "a tile")
  local item = tree:add(range, "Tile")
  local tile = parts.add_part(item, range, part)
  local number, encoding, bytes = tile.tile, tile["tile.encoding"], tile["tile.bytes"]
  local across = bit.rshift(header.width, header.side_log2 % 32)
  local up = bit.rshift(header.height, header.side_log2 % 32)
  if across > 0 and up > 0 then
    local x, y = number % across, math.floor(number / across)
    parts.add_generated(item, "tile.x", range, x)
    parts.add_generated(item, "tile.y", range, y)
    item:set_text(string.format("Tile %d (x %d, y %d)", number, x, y))
    if window then show_place(item, range, window, x, y, across, up) end
  end
  item:append_text(string.format(", %d bytes, %s", bytes,
                                 layout.ENCODINGS[encoding] or "unknown encoding"))
  local payload = bytes > 0 and cursor.take(bytes, "a tile's payload")
  item:set_len(range:len() + bytes)
  if payload then item:add(fields["tile.payload"], payload) end
  parts.guarded(item, function()
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

-- What the message says of the window of classes, and skips what it does not know of it.
function tiles.show_window(tree, cursor)
  local part = layout.PARTS.window
  local range = cursor.take(layout.bytes_of(part), "the window's header")
  local item = tree:add(range, "Window")
  local window, items = parts.add_part(item, range, part)
  for _, cause in pairs(layout.CAUSES) do
    local name = "window.cause." .. cause:gsub(" ", "_")
    items["window.causes"]:add(fields[name], range:range(2, 2))
  end
  local turns = window["window.heading"] / 2 ^ 32
  items["window.heading"]:append_text(string.format(" (%.3f degrees)", 360 * turns))
  local more = window["window.bytes"] - range:len()
  if more < 0 then codes.malformed("a window's header of %d bytes", window["window.bytes"]) end
  if more > 0 then item:add(fields.unknown, cursor.take(more, "the rest of the window's header")) end
  return window
end

function tiles.show_tiles(tree, cursor, info)
  local item, header, items = parts.add_section(tree, cursor, layout.PARTS.tiles, "Tiles")
  local first, last, count = header["tiles.first"], header["tiles.end"] - 1, header["tiles.count"]
  info(string.format(", tiles %d-%d, %d of them", first, last, count))
  if not layout.STORAGES[header.storage] then
    items.storage:add_proto_expert_info(experts.unknown, "a storage that is not known")
  elseif header.storage == CLASSES then
    info(", classes")
  elseif header.storage ~= 0 then
    info(string.format(", cells of %d mm", header.cell_mm))
  end
  item:append_text(string.format(" %d to %d: %d follow, nothing is known of the others", first,
                                 last, count))
  local window = header.storage == CLASSES and tiles.show_window(item, cursor) or nil
  local before = -1
  for _ = 1, count do before = show_tile(item, cursor, header, window, before) end
end

return tiles
