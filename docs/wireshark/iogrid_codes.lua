-- The codes inside iogrid's messages, on strings: the CRC, and how much a tile's payload holds.
--
-- A payload that is not what docs/spec.md 3.4 says is an error that is a table with a text.
local codes = {}

local CRC_OF_BYTE = {}
for byte = 0, 255 do
  local crc = byte
  for _ = 1, 8 do
    local is_odd = bit.band(crc, 1) == 1
    crc = bit.rshift(crc, 1)
    if is_odd then crc = bit.bxor(crc, 0xC8DF352F) end  -- 0xF4ACFB13, its bits reversed
  end
  CRC_OF_BYTE[byte] = crc
end

-- CRC-32/P4 of strings, one behind the other.
function codes.crc32_p4(...)
  local crc = bit.bnot(0)
  for _, text in ipairs({ ... }) do
    for i = 1, #text do
      local byte = bit.band(bit.bxor(crc, text:byte(i)), 0xFF)
      crc = bit.bxor(bit.rshift(crc, 8), CRC_OF_BYTE[byte])
    end
  end
  return bit.bnot(crc) % 0x100000000
end

-- Ends what is being read.
local function malformed(...)
  error({ text = string.format(...) }, 0)
end

local BITS_OF_BYTE = {}
for byte = 0, 255 do
  local digits = ""
  for place = 7, 0, -1 do
    digits = digits .. (bit.band(bit.rshift(byte, place), 1) == 1 and "1" or "0")
  end
  BITS_OF_BYTE[string.char(byte)] = digits
end

-- Reads the bits of a string, from the highest of a byte. As a string of digits they are searched
-- and converted by the library, not one by one.
local function bits_of(text)
  local digits = text:gsub(".", BITS_OF_BYTE)
  local at = 1
  local bits = {}
  function bits.take(count)
    if count == 0 then return 0 end
    local taken = digits:sub(at, at + count - 1)
    if #taken < count then malformed("the payload ends in the middle of its code") end
    at = at + count
    return tonumber(taken, 2)
  end
  function bits.must_end()
    local rest = digits:sub(at)
    if #rest >= 8 or rest:find("1", 1, true) then malformed("more follows its code") end
  end
  return bits
end

-- The logarithm to base 2, rounded up.
local function symbol_bits(symbols)
  local bits = 0
  while 2 ^ bits < symbols do bits = bits + 1 end
  return bits
end

-- By the number of alternatives of a symbol: how many fours of symbols are the digits of a number, its
-- bits, and the bits of the last number of a tile, by its fours.
local function packing_of(alternatives)
  local fours = 1
  while alternatives ^ (4 * fours + 4) <= 2 ^ 31 do fours = fours + 1 end
  local whole = symbol_bits(alternatives ^ (4 * fours))
  return fours, whole, function(rest) return math.min(whole, rest * symbol_bits(alternatives ^ 4)) end
end

-- The blocks of 4 by 2 cells in which runs start, 16 bytes of bits and a byte for each bit that is
-- set; how many runs there are, and what is behind them.
local function take_starts(text)
  if #text < 16 then malformed("the payload ends before its starts") end
  local runs, at = 0, 17
  for i = 1, 16 do
    for _ in BITS_OF_BYTE[text:sub(i, i)]:gmatch("1") do
      local block = text:sub(at, at)
      if block == "" then malformed("the payload ends in its starts") end
      local _, starts = BITS_OF_BYTE[block]:gsub("1", "")
      if starts == 0 then malformed("a block of cells has no start") end
      runs, at = runs + starts, at + 1
    end
  end
  return runs, text:sub(at)
end

-- Values and runs of a code of run starts, but a run as in the reference with which the tile begins.
function codes.count_starts(text)
  local values = text:byte(1)
  if not values or #text < 1 + values then malformed("the payload ends in its list of values") end
  if values > 215 then malformed("%d values", values) end
  if values == 0 then
    if #text > 1 then malformed("more follows a tile without values") end
    return values, 0
  end
  local runs, rest = take_starts(text:sub(2 + values))
  local bits = bits_of(rest)
  if values > 1 then
    local fours, whole, rest_bits = packing_of(values)
    local left = math.ceil(runs / 4)
    while left > 0 do
      local places = 4 * math.min(fours, left)
      local number = bits.take(left >= fours and whole or rest_bits(left))
      if number >= values ^ places then malformed("a number is too large for its symbols") end
      left = left - fours
    end
  end
  bits.must_end()
  return values, runs
end

codes.malformed = malformed
return codes
