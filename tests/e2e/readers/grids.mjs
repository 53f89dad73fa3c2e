// Grids of a frame, held against each other, and the names that docs/spec.md gives them.

import assert from "node:assert/strict";
import zlib from "node:zlib";

const SIDE = 1024;
const TILE = 32;
const NEVER_ARRIVED = 255;
const TILE_M = 3.2;
const PERCENT_OF_CLASS = [-1, 0, 10, 5, 90, 85, 80, 100, 70]; // docs/recordings.md
// By the byte of an index: the recursive set of epsilon = 0.05.
const PERCENT_OF_INDEX = Array.from({ length: 256 }, (_, byte) =>
  Math.floor(100 / (1 + (0.45 / 0.55) ** ((byte << 24) >> 24)) + 0.5)
);
const PIXEL_OF_PERCENT = Array.from({ length: 101 }, (_, percent) =>
  Math.floor(2.55 * (100 - percent) + 0.5 + 1e-9)
);
const tableOf = (polynomial) =>
  Uint32Array.from({ length: 256 }, (_, byte) => {
    let crc = byte;
    for (let bit = 0; bit < 8; ++bit) crc = crc & 1 ? (crc >>> 1) ^ polynomial : crc >>> 1;
    return crc >>> 0;
  });
function crcOf(table, bytes, crc) {
  let state = ~crc >>> 0;
  for (const byte of bytes) state = table[(state ^ byte) & 0xff] ^ (state >>> 8);
  return ~state >>> 0;
}
// CRC-32 as in zlib, which node offers from version 20.15 only.
const ZLIB = tableOf(0xedb88320);
export function crc32(bytes, crc = 0) {
  return zlib.crc32 ? zlib.crc32(bytes, crc) : crcOf(ZLIB, bytes, crc);
}
// CRC-32/P4, of E2E and of grids.
const P4 = tableOf(0xc8df352f);
const crcP4 = (bytes, crc = 0) => crcOf(P4, bytes, crc);

// docs/spec.md 3.6, "The name of a grid", over cells that are `stride` bytes apart.
function nameOfGrid(data, stride) {
  let crc = 0;
  const tile = new Uint8Array(4 + TILE * TILE);
  for (let y = 0; y < SIDE / TILE; ++y) {
    for (let x = 0; x < SIDE / TILE; ++x) {
      let known = 0;
      tile.set([x >> 8, x & 0xff, y >> 8, y & 0xff]);
      for (let i = 0; i < TILE * TILE; ++i) {
        const cell = (y * TILE + Math.floor(i / TILE)) * SIDE + x * TILE + (i % TILE);
        known |= tile[4 + i] = data[cell * stride];
      }
      if (known) crc = crcP4(tile, crc);
    }
  }
  return crc.toString(16).padStart(8, "0");
}

// docs/spec.md 3.10, the name of a class grid, over cells of which `byteOf` says the byte.
function nameOfClasses(a, b, byteOf) {
  const corner = new Uint8Array(8);
  new DataView(corner.buffer).setInt32(0, a);
  new DataView(corner.buffer).setInt32(4, b);
  let crc = crcP4(corner);
  let isEmpty = true;
  const tile = new Uint8Array(2 + TILE * TILE);
  for (let slot = 0; slot < (SIDE / TILE) ** 2; ++slot) {
    const x = modulo((slot % TILE) - a, SIDE / TILE);
    const y = modulo(Math.floor(slot / TILE) - b, SIDE / TILE);
    let known = 0;
    tile.set([slot >> 8, slot & 0xff]);
    for (let i = 0; i < TILE * TILE; ++i) {
      const cell = (y * TILE + Math.floor(i / TILE)) * SIDE + x * TILE + (i % TILE);
      known |= tile[2 + i] = byteOf(cell);
    }
    if (known) {
      crc = crcP4(tile, crc);
      isEmpty = false;
    }
  }
  return (isEmpty ? 0 : crc).toString(16).padStart(8, "0");
}

// Of a million cells: asserting costs more than comparing.
function demandEqual(found, expected, cell) {
  if (found !== expected) assert.fail(`${found} and not ${expected} in cell ${cell}`);
}
function modulo(n, m) {
  return ((n % m) + m) % m;
}

// The frame as JSON; /grid is held against the indexes of the same frame.
export function checkFrame(occupancy, cells) {
  assert.deepEqual(cells.fields, [
    { name: "index", offset: 0, type: 2 },
    { name: "probability_percent", offset: 1, type: 1 },
    { name: "age_frames", offset: 2, type: 1 },
  ]);
  assert.deepEqual([cells.column_count, cells.cell_stride, cells.row_stride], [SIDE, 3, 3 * SIDE]);
  assert.deepEqual(cells.cell_size, { x: 0.1, y: 0.1 });
  assert.equal(cells.data.length, 3 * SIDE * SIDE);
  const { info, header } = occupancy;
  assert.deepEqual([info.width, info.height], [SIDE, SIDE]);
  assert.equal(info.resolution, Math.fround(0.1));
  for (const pose of [info.origin, cells.pose]) {
    assert.deepEqual(pose.position, { x: -51.2, y: -51.2, z: 0 });
    assert.deepEqual(pose.orientation, { x: 0, y: 0, z: 0, w: 1 });
  }
  assert.equal(header.frame_id, cells.frame_id);
  assert.deepEqual(header.stamp, cells.timestamp);
  const hasAge = new Uint8Array(256);
  for (let cell = 0; cell < SIDE * SIDE; ++cell) {
    const index = cells.data[3 * cell];
    const age = cells.data[3 * cell + 2];
    const percent = PERCENT_OF_INDEX[index];
    demandEqual(cells.data[3 * cell + 1], percent, cell);
    demandEqual(occupancy.data[cell], index === 0 || age > 0 ? -1 : percent, cell);
    hasAge[age] = 1;
  }
  return {
    stamp: header.stamp,
    crc: nameOfGrid(cells.data, 3),
    oldest: Math.max(0, hasAge.lastIndexOf(1, NEVER_ARRIVED - 1)),
    has_gaps: hasAge[NEVER_ARRIVED] === 1,
  };
}

// The picture shows the probabilities of /grid, x upwards and y to the left.
export function checkImage(occupancy, image) {
  assert.deepEqual([image.width, image.height, image.step], [SIDE, SIDE, SIDE]);
  assert.equal(image.encoding, "mono8");
  for (let cell = 0; cell < SIDE * SIDE; ++cell) {
    const [x, y] = [cell % SIDE, Math.floor(cell / SIDE)];
    const percent = occupancy.data[cell] === -1 ? 50 : occupancy.data[cell];
    const pixel = image.data[(SIDE - 1 - x) * SIDE + (SIDE - 1 - y)];
    demandEqual(pixel, PIXEL_OF_PERCENT[percent], cell);
  }
}

// The classes of a frame as JSON; /classes is held against them, and its place is in whole tiles.
export function checkClasses(occupancy, cells) {
  assert.deepEqual(cells.fields, [
    { name: "class", offset: 0, type: 1 },
    { name: "sureness", offset: 1, type: 1 },
    { name: "age_frames", offset: 2, type: 1 },
  ]);
  assert.equal(cells.data.length, 3 * SIDE * SIDE);
  const { info, header } = occupancy;
  assert.equal(cells.frame_id, "odom");
  assert.equal(header.frame_id, "odom");
  assert.deepEqual(header.stamp, cells.timestamp);
  assert.deepEqual(info.origin, cells.pose);
  assert.deepEqual(cells.pose.orientation, { x: 0, y: 0, z: 0, w: 1 });
  const [a, b] = [cells.pose.position.x / TILE_M, cells.pose.position.y / TILE_M].map(Math.round);
  assert.ok(Math.abs(cells.pose.position.x - a * TILE_M) < 1e-9);
  assert.ok(Math.abs(cells.pose.position.y - b * TILE_M) < 1e-9);
  const hasNumber = new Uint8Array(256);
  for (let cell = 0; cell < SIDE * SIDE; ++cell) {
    const number = cells.data[3 * cell];
    demandEqual(occupancy.data[cell], PERCENT_OF_CLASS[number], cell);
    hasNumber[number] = 1;
  }
  const name = nameOfClasses(a, b, (cell) => 8 * cells.data[3 * cell] + cells.data[3 * cell + 1]);
  return { name, numbers: [...hasNumber.keys()].filter((number) => hasNumber[number]) };
}
