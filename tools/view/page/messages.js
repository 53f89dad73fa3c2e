// The server's messages (docs/view.md): numbers are little endian, words are JSON, and tiles are
// raw or run length encoded as src/tile_coding/runs.hpp says.
//
// Whatever the bytes, reading ends and nothing outside of the result is written; what makes no
// sense throws an Error.

export const TILE_SIDE = 32;
export const TILES_PER_SIDE = 32;
export const TILE_COUNT = TILES_PER_SIDE * TILES_PER_SIDE;
export const SIDE = TILE_SIDE * TILES_PER_SIDE;
const TILE_CELLS = TILE_SIDE * TILE_SIDE;

// Layers of tiles. Those of the last two are numbered by slot: b mod 32 * 32 + a mod 32 for tile
// (a, b) of the local frame, wherever the window is.
export const LAYERS = { INDEXES: 0, OCCUPIED: 1, CLASSES: 2, TRUE_CLASSES: 3 };
export const LAYER_COUNT = 4;
const HAS_FRAME = 1;
const IS_KEY = 2;
const HAS_TRUTH = 4;
const HAS_CLASSES = 8;
const HAS_TRUE_CLASSES = 16;
const POINT_BYTES = 5;

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
    const count = view.getUint32(at, true);
    at += 4;
    result.points = new DataView(buffer, at, count * POINT_BYTES);
    result.tilesAt = at + count * POINT_BYTES;
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

class BitReader {
  constructor(bytes, at) {
    this.bytes = bytes;
    this.at = at * 8;
    this.end = bytes.length * 8;
  }

  bit() {
    if (this.at >= this.end) {
      throw new Error("a tile ends too early");
    }
    const bit = (this.bytes[this.at >> 3] >> (7 - (this.at & 7))) & 1;
    this.at += 1;
    return bit;
  }

  bits(count) {
    let value = 0;
    for (let i = 0; i < count; ++i) {
      value = (value << 1) | this.bit();
    }
    return value;
  }

  // Elias' gamma code.
  gamma() {
    let zeros = 0;
    while (this.bit() === 0) {
      zeros += 1;
      if (zeros > 10) {
        throw new Error("a run longer than a tile");
      }
    }
    return (1 << zeros) | this.bits(zeros);
  }
}

const symbolBits = (count) => (count < 2 ? 0 : 32 - Math.clz32(count - 1));

function decodeRuns(payload, put) {
  const count = payload[0];
  const symbols = new BitReader(payload, 1 + count);
  let bits = symbolBits(count);
  let before = count;
  for (let begin = 0; begin < TILE_CELLS;) {
    const code = symbols.bits(bits);
    const symbol = code + (code >= before ? 1 : 0);
    const length = symbols.gamma();
    if (symbol >= count || length > TILE_CELLS - begin) {
      throw new Error("a run that cannot be");
    }
    put(begin, begin + length, (payload[1 + symbol] << 24) >> 24);
    before = symbol;
    bits = symbolBits(count - 1);
    begin += length;
  }
}

// Writes a tile into cells, SIDE to a row from the lowest y. An empty payload is 0 everywhere.
export function decodeTile(tile, encoding, payload, cells) {
  const origin = Math.floor(tile / TILES_PER_SIDE) * TILE_SIDE * SIDE +
                 (tile % TILES_PER_SIDE) * TILE_SIDE;
  const put = (begin, end, value) => {
    for (let i = begin; i < end;) {
      const stop = Math.min(end, (i | (TILE_SIDE - 1)) + 1);
      const row = origin + (i >> 5) * SIDE;
      cells.fill(value, row + (i & 31), row + ((stop - 1) & 31) + 1);
      i = stop;
    }
  };
  if (payload.length === 0) {
    put(0, TILE_CELLS, 0);
  } else if (encoding === 1) {
    decodeRuns(payload, put);
  } else if (encoding === 0 && payload.length === TILE_CELLS) {
    for (let i = 0; i < TILE_CELLS; ++i) {
      cells[origin + (i >> 5) * SIDE + (i & 31)] = (payload[i] << 24) >> 24;
    }
  } else {
    throw new Error(`encoding ${encoding}`);
  }
}
