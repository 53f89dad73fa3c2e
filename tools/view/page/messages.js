// The server's messages: numbers are little endian, words are JSON, and tiles are encoded raw or by
// run starts (docs/spec.md 3.4). A key message is complete by itself, and any other message
// contains only the tiles that have changed. Ages are in frames: 254 means 254 or more, and 255
// means that the tile never arrived.
//
// Whatever the bytes, reading ends and nothing outside of the result is written; what makes no
// sense throws an Error.

export const TILE_SIDE = 32;
export const TILES_PER_SIDE = 32;
export const TILE_COUNT = TILES_PER_SIDE * TILES_PER_SIDE;
export const TILE_CELLS = TILE_SIDE * TILE_SIDE;

// Layers of tiles. Those of the first two are numbered row by row of the grid, those of the last two
// by slot: b mod 32 * 32 + a mod 32 for tile (a, b) of the local frame, wherever the window is.
export const LAYERS = { INDEXES: 0, OCCUPIED: 1, CLASSES: 2, TRUE_CLASSES: 3 };
export const LAYER_COUNT = 4;
const HAS_FRAME = 1;
const IS_KEY = 2;
const HAS_TRUTH = 4;
const HAS_CLASSES = 8;
const HAS_TRUE_CLASSES = 16;
const HAS_OBJECTS = 32;
const POINT_BYTES = 5;
const OBJECT_BYTES = 36;
const OBJECT_NOT_HIT = 2; // of its flags (docs/spec.md 3.12)

const words = new TextDecoder();

// Everything but the tiles, which stay encoded until they are drawn.
export function readMessage(buffer) {
  const view = new DataView(buffer);
  const flags = view.getUint32(0, true);
  const wordBytes = view.getUint32(4, true);
  const message = JSON.parse(words.decode(new Uint8Array(buffer, 8, wordBytes)));
  const result = {
    buffer,
    status: message.status,
    vehicle: message.vehicle,
    hasFrame: (flags & HAS_FRAME) !== 0,
    isKey: (flags & IS_KEY) !== 0,
    hasTruth: (flags & HAS_TRUTH) !== 0,
    hasClasses: (flags & HAS_CLASSES) !== 0,
    hasTrueClasses: (flags & HAS_TRUE_CLASSES) !== 0,
    ages: null,
    classAges: null, // since the tiles came
    decidedAgo: null, // and since they were decided
    points: null,
    objects: null, // where it is not known which there are
    tilesAt: buffer.byteLength,
  };
  let at = 8 + wordBytes;
  if (result.hasFrame) {
    result.ages = new Uint8Array(buffer, at, TILE_COUNT);
    at += TILE_COUNT;
    if (result.hasClasses) {
      result.classAges = new Uint8Array(buffer, at, TILE_COUNT);
      result.decidedAgo = new Uint8Array(buffer, at + TILE_COUNT, TILE_COUNT);
      at += 2 * TILE_COUNT;
    }
    const records = (bytes) => {
      const size = view.getUint32(at, true) * bytes;
      at += 4 + size;
      return new DataView(buffer, at - size, size);
    };
    result.points = records(POINT_BYTES);
    result.objects = (flags & HAS_OBJECTS) !== 0 ? records(OBJECT_BYTES) : null;
    result.tilesAt = at;
  }
  return result;
}

// Calls visit(layer, tile, encoding, payload) for each tile of a message.
export function forEachTile(message, visit) {
  const { buffer } = message;
  const view = new DataView(buffer);
  for (let at = message.tilesAt; at < buffer.byteLength;) {
    const tile = view.getUint16(at + 2, true);
    const bytes = view.getUint16(at + 4, true);
    if (tile >= TILE_COUNT) {
      throw new Error(`tile ${tile}`);
    }
    visit(view.getUint8(at), tile, view.getUint8(at + 1), new Uint8Array(buffer, at + 6, bytes));
    at += 6 + bytes;
  }
}

// Calls visit(x in metres, y in metres, fate) for each scan point.
export function forEachPoint(points, visit) {
  for (let at = 0; at < points.byteLength; at += POINT_BYTES) {
    visit(points.getInt16(at, true) / 100, points.getInt16(at + 2, true) / 100,
          points.getUint8(at + 4));
  }
}

// Objects in metres, seconds and radians of the local frame.
export function readObjects(records) {
  const objects = [];
  for (let at = 0; at < records.byteLength; at += OBJECT_BYTES) {
    const u16 = (field) => records.getUint16(at + field, true);
    objects.push({
      id: records.getUint32(at, true),
      state: records.getUint8(at + 4),
      x: records.getInt32(at + 6, true) / 1000,
      y: records.getInt32(at + 10, true) / 1000,
      vx: records.getInt16(at + 14, true) / 100,
      vy: records.getInt16(at + 16, true) / 100,
      sigmaAlong: u16(18) / 100,
      length: u16(22) / 100,
      width: u16(24) / 100,
      heading: u16(26) * Math.PI / 32768,
      isHit: (u16(28) & OBJECT_NOT_HIT) === 0,
      ageFrames: u16(30),
    });
  }
  return objects;
}

class BitReader {
  constructor(bytes, at) {
    this.bytes = bytes;
    this.at = at * 8;
    this.end = bytes.length * 8;
  }

  // At most 31.
  bits(count) {
    if (this.at + count > this.end) {
      throw new Error("a tile ends too early");
    }
    let value = 0;
    for (const end = this.at + count; this.at < end; ++this.at) {
      value = value * 2 + ((this.bytes[this.at >> 3] >> (7 - (this.at & 7))) & 1);
    }
    return value;
  }
}

const MOST_VALUES = 215;
const SET_BYTES = 16;
const BLOCKS_PER_ROW = TILE_SIDE / 4;

// The cells at which runs start, in order, and where in the payload they end.
function readStarts(payload, at) {
  const rows = new Uint32Array(TILE_SIDE);
  let next = at + SET_BYTES;
  if (next > payload.length) {
    throw new Error("a tile ends too early");
  }
  for (let block = 0; block < 8 * SET_BYTES; ++block) {
    if ((payload[at + (block >> 3)] >> (block & 7)) & 1) {
      const y = Math.floor(block / BLOCKS_PER_ROW) * 2;
      const x = (block % BLOCKS_PER_ROW) * 4;
      rows[y] |= (payload[next] & 15) << x;
      rows[y + 1] |= (payload[next] >> 4) << x;
      next += 1;
    }
  }
  const cells = [];
  for (let i = 0; i < TILE_CELLS; ++i) {
    if ((rows[i >> 5] >>> (i & 31)) & 1) {
      cells.push(i);
    }
  }
  return { cells, next };
}

// Of a number below so many.
function bitsOf(numbers) {
  let bits = 0;
  while (2 ** bits < numbers) {
    bits += 1;
  }
  return bits;
}

// So many symbols of n alternatives: the digits of numbers to base n, in fours.
function readDigits(reader, n, count) {
  let fours = 1;
  while (n ** (4 * fours + 4) <= 2 ** 31) {
    fours += 1;
  }
  const whole = bitsOf(n ** (4 * fours));
  const digits = [];
  for (let left = Math.ceil(count / 4); left > 0; left -= fours) {
    const places = 4 * Math.min(fours, left);
    let number = reader.bits(left >= fours ? whole : Math.min(whole, left * bitsOf(n ** 4)));
    const end = digits.length + places;
    for (let i = end - 1; i >= end - places; --i) {
      digits[i] = number % n;
      number = Math.floor(number / n);
    }
  }
  return digits;
}

// Symbol 0 is 0, as all cells of a tile that is not known; the values count from 1. The tile begins
// with symbol 0, and no run has the symbol of the run before it.
function decodeRunStarts(payload, cells) {
  const count = payload[0];
  if (count > MOST_VALUES) {
    throw new Error(`${count} values`);
  }
  cells.fill(0);
  if (count === 0) {
    return;
  }
  const starts = readStarts(payload, 1 + count);
  const runs = starts.cells.length;
  const digits = count === 1 ? new Array(runs).fill(0)
                             : readDigits(new BitReader(payload, starts.next), count, runs);
  let symbol = 0;
  starts.cells.forEach((begin, run) => {
    symbol = digits[run] + (digits[run] >= symbol ? 1 : 0);
    const end = run + 1 < runs ? starts.cells[run + 1] : TILE_CELLS;
    cells.fill(symbol === 0 ? 0 : payload[symbol], begin, end);
  });
}

// Writes a tile into the cells of its layer, an Int8Array that holds one tile after the other. An
// empty payload is 0 everywhere.
export function decodeTile(tile, encoding, payload, layer) {
  const cells = layer.subarray(tile * TILE_CELLS, (tile + 1) * TILE_CELLS);
  if (payload.length === 0) {
    cells.fill(0);
  } else if (encoding === 4) {
    decodeRunStarts(payload, cells);
  } else if (encoding === 0 && payload.length === TILE_CELLS) {
    cells.set(payload);
  } else {
    throw new Error(`encoding ${encoding}`);
  }
}
