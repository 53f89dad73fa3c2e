// Reads an MCAP file by Foxglove's own packages and says what is in it, as JSON on standard output;
// fails where the file is not what the specification, ROS 2 and Foxglove want.
//
//   node read_recording.mjs <file>           by its index, then from beginning to end
//   node read_recording.mjs --cut <file>     one without its end: from the beginning as far as it goes

import assert from "node:assert/strict";
import fs from "node:fs";
import { createRequire } from "node:module";
import zlib from "node:zlib";

import { parse } from "@foxglove/rosmsg";
import { MessageReader } from "@foxglove/rosmsg2-serialization";
import zstd from "@foxglove/wasm-zstd";
import { McapIndexedReader, McapStreamReader } from "@mcap/core";

const require = createRequire(import.meta.url);
const { ros2jazzy } = require("@foxglove/rosmsg-msgs-common");
const foxglove = require("@foxglove/schemas/internal");

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
const decompressHandlers = { zstd: (bytes, size) => zstd.decompress(bytes, Number(size)) };

// Table of CRC-32 as in zlib, which node offers from version 20.15 only.
const TABLE = Uint32Array.from({ length: 256 }, (_, byte) => {
  let crc = byte;
  for (let bit = 0; bit < 8; ++bit) crc = crc & 1 ? (crc >>> 1) ^ 0xedb88320 : crc >>> 1;
  return crc >>> 0;
});
function crc32(bytes, crc = 0) {
  if (zlib.crc32) return zlib.crc32(bytes, crc);
  let state = ~crc >>> 0;
  for (const byte of bytes) state = TABLE[(state ^ byte) & 0xff] ^ (state >>> 8);
  return ~state >>> 0;
}

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
      if (known) crc = crc32(tile, crc);
    }
  }
  return crc.toString(16).padStart(8, "0");
}

// docs/spec.md 3.10, the name of a class grid, over cells of which `byteOf` says the byte.
function nameOfClasses(a, b, byteOf) {
  const corner = new Uint8Array(8);
  new DataView(corner.buffer).setInt32(0, a);
  new DataView(corner.buffer).setInt32(4, b);
  let crc = crc32(corner);
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
      crc = crc32(tile, crc);
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

// Names and types of the fields, as parsed: what is only said in two ways is made one.
function fields(definition) {
  return definition.definitions
    .filter((field) => !field.isConstant)
    .map(({ name, type, isArray }) => ({
      name,
      type: type
        .replace("builtin_interfaces/Time", "time")
        .replace("builtin_interfaces/Duration", "duration")
        .replace("/msg/", "/"),
      isArray: Boolean(isArray),
    }));
}

// The definition in the file is the published one.
function checkDefinition(schema) {
  const [main] = parse(new TextDecoder().decode(schema.data), { ros2: true });
  const name = schema.name.replace("/msg/", "/");
  if (name in ros2jazzy) {
    assert.deepEqual(fields(main), fields(ros2jazzy[name]), schema.name);
    return;
  }
  const [, type] = /^foxglove_msgs\/msg\/(Grid|SceneUpdate)$/.exec(schema.name);
  const official = foxglove.generateRosMsgMergedSchema(foxglove.foxgloveMessageSchemas[type], {
    rosVersion: 2,
  });
  const ours = parse(new TextDecoder().decode(schema.data), { ros2: true });
  const theirs = parse(official, { ros2: true });
  const byName = (all) => {
    const types = Object.fromEntries(all.map((each) => [each.name ?? "", fields(each)]));
    delete types["builtin_interfaces/Time"]; // which ROS 2 writes out and Foxglove does not
    delete types["builtin_interfaces/Duration"];
    return types;
  };
  assert.deepEqual(byName(ours), byName(theirs), schema.name);
}

// The frame as JSON; /grid is held against the indexes of the same frame.
function checkFrame(occupancy, cells) {
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
function checkImage(occupancy, image) {
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
function checkClasses(occupancy, cells) {
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

// One transform, of a turn about z alone.
function checkTransform({ transforms }) {
  assert.equal(transforms.length, 1);
  const [{ header, child_frame_id, transform }] = transforms;
  assert.deepEqual([header.frame_id, child_frame_id], ["odom", "base_link"]);
  const { translation, rotation } = transform;
  assert.deepEqual([translation.z, rotation.x, rotation.y], [0, 0, 0]);
  assert.ok(Math.abs(rotation.z ** 2 + rotation.w ** 2 - 1) < 1e-12);
  const heading = 2 * Math.atan2(rotation.z, rotation.w);
  return { x: translation.x, y: translation.y, heading };
}

const RGB = ({ r, g, b }) => [r, g, b].map((part) => Math.round(255 * part));

// Of a turn about z alone.
function angleOf({ x, y, z, w }) {
  assert.deepEqual([x, y], [0, 0]);
  assert.ok(Math.abs(z ** 2 + w ** 2 - 1) < 1e-12);
  return 2 * Math.atan2(z, w);
}

// A box on the ground, words above it, and an arrow if it moves.
function checkEntity(entity, stamp) {
  const { id, lifetime, metadata, arrows, cubes, texts } = entity;
  assert.equal(entity.frame_id, "odom");
  assert.equal(entity.frame_locked, false);
  assert.deepEqual(entity.timestamp, stamp);
  for (const kind of ["spheres", "cylinders", "lines", "triangles", "models"]) {
    assert.equal(entity[kind].length, 0);
  }
  assert.deepEqual([cubes.length, texts.length, arrows.length <= 1], [1, 1, true]);
  const [{ pose, size, color }] = cubes;
  assert.deepEqual([pose.position.z - size.z / 2, size.z], [0, 1.5]);
  assert.ok(texts[0].billboard && texts[0].scale_invariant && texts[0].pose.position.z > size.z);
  const { x, y } = pose.position;
  for (const other of [...arrows, ...texts]) {
    assert.deepEqual([other.pose.position.x, other.pose.position.y], [x, y]);
  }
  const arrow = arrows.map((each) => {
    assert.deepEqual(RGB(each.color), RGB(color));
    assert.ok(each.shaft_length > 0 && each.head_length > 0);
    return { length: each.shaft_length + each.head_length, angle: angleOf(each.pose.orientation) };
  });
  return {
    id, x, y, length: size.x, width: size.y, heading: angleOf(pose.orientation),
    colour: RGB(color), alpha: color.a, arrow: arrow[0] ?? null, text: texts[0].text,
    lifetime_s: lifetime.sec + lifetime.nsec / 1e9,
    metadata: Object.fromEntries(metadata.map(({ key, value }) => [key, value])),
  };
}

function checkScene({ deletions, entities }, publishTime) {
  const stamp = { sec: Number(publishTime / 1000000000n), nsec: Number(publishTime % 1000000000n) };
  const gone = deletions.map(({ timestamp, type, id }) => {
    assert.deepEqual([timestamp, type], [stamp, 0]); // MATCHING_ID
    return id;
  });
  return { gone, objects: entities.map((entity) => checkEntity(entity, stamp)) };
}

class Contents {
  #readers = new Map();
  #topics = new Map();
  #occupancy;
  #classOccupancy;
  frames = [];
  classes = [];
  poses = [];
  scenes = [];
  records = {}; // of each topic, as they are in the file
  messages = { count: 0, crc: 0 };

  addChannel(channel, schema) {
    assert.equal(channel.messageEncoding, "cdr");
    assert.equal(schema.encoding, "ros2msg");
    assert.ok(channel.metadata.has("offered_qos_profiles"));
    checkDefinition(schema);
    const definition = parse(new TextDecoder().decode(schema.data), { ros2: true });
    this.#readers.set(channel.id, new MessageReader(definition));
    this.#topics.set(channel.id, channel.topic);
  }

  addMessage(record) {
    const topic = this.#topics.get(record.channelId);
    const message = this.#readers.get(record.channelId).readMessage(record.data);
    (this.records[topic] ??= []).push(record);
    if (topic === "/grid") this.#occupancy = message;
    if (topic === "/iogrid/image") checkImage(this.#occupancy, message);
    if (topic === "/iogrid/grid") {
      const frame = checkFrame(this.#occupancy, message);
      const { logTime, publishTime } = record;
      this.frames.push({ ...frame, log_ns: String(logTime), publish_ns: String(publishTime) });
    }
    if (topic === "/classes") this.#classOccupancy = message;
    if (topic === "/iogrid/classes") this.classes.push(checkClasses(this.#classOccupancy, message));
    if (topic === "/tf") this.poses.push(checkTransform(message));
    if (topic === "/objects") this.scenes.push(checkScene(message, record.publishTime));
    if (topic === "/iogrid/messages") {
      this.messages.count += 1;
      this.messages.crc = crc32(message.data, this.messages.crc);
    }
  }
}

function countsOf(records) {
  return Object.fromEntries(Object.entries(records).map(([topic, all]) => [topic, all.length]));
}

// What is found by the index is what was read and checked from the beginning.
async function checkIndex(bytes, records) {
  const readable = {
    size: async () => BigInt(bytes.length),
    read: async (offset, size) =>
      new Uint8Array(bytes.subarray(Number(offset), Number(offset + size))),
  };
  const reader = await McapIndexedReader.Initialize({ readable, decompressHandlers });
  assert.equal(reader.header.profile, "ros2");
  const contents = new Contents();
  for (const channel of reader.channelsById.values()) {
    contents.addChannel(channel, reader.schemasById.get(channel.schemaId));
  }
  const counts = {};
  let last = 0n;
  for await (const message of reader.readMessages()) {
    assert.ok(message.logTime >= last);
    last = message.logTime;
    const { topic } = reader.channelsById.get(message.channelId);
    const number = counts[topic] ?? 0;
    counts[topic] = number + 1;
    const { data, ...rest } = records[topic][number];
    assert.deepEqual({ ...message, data }, { ...rest, data });
    assert.equal(Buffer.compare(message.data, data), 0);
  }
  assert.deepEqual(counts, countsOf(records));
  checkStatistics(reader, counts, last);
  const metadata = [];
  for await (const each of reader.readMetadata()) metadata.push(Object.fromEntries(each.metadata));
  const dataSection = bytes.subarray(0, Number(reader.dataEndOffset));
  assert.equal(reader.dataSectionCrc, crc32(dataSection));
  return metadata;
}

function checkStatistics(reader, counts, last) {
  const { statistics } = reader;
  assert.equal(statistics.channelCount, reader.channelsById.size);
  assert.equal(statistics.schemaCount, reader.schemasById.size);
  assert.equal(statistics.chunkCount, reader.chunkIndexes.length);
  assert.equal(statistics.metadataCount, reader.metadataIndexes.length);
  assert.equal(statistics.messageEndTime, last);
  let sum = 0n;
  for (const [id, count] of statistics.channelMessageCounts) {
    assert.equal(Number(count), counts[reader.channelsById.get(id).topic] ?? 0);
    sum += count;
  }
  assert.equal(statistics.messageCount, sum);
  for (const chunk of reader.chunkIndexes) {
    assert.ok(chunk.messageIndexOffsets.size > 0);
    assert.ok(chunk.messageStartTime <= chunk.messageEndTime);
  }
}

function readFromBeginning(bytes) {
  const reader = new McapStreamReader({ decompressHandlers });
  reader.append(bytes);
  const contents = new Contents();
  const schemas = new Map();
  const known = new Set();
  for (let record; (record = reader.nextRecord()); ) {
    if (record.type === "Schema") schemas.set(record.id, record);
    if (record.type === "Channel" && !known.has(record.id)) {
      known.add(record.id);
      contents.addChannel(record, schemas.get(record.schemaId));
    }
    if (record.type === "Message") contents.addMessage(record);
  }
  return { contents, isDone: reader.done() };
}

await zstd.isLoaded;
const isCut = process.argv[2] === "--cut";
const bytes = fs.readFileSync(process.argv[isCut ? 3 : 2]);
const { contents, isDone } = readFromBeginning(bytes);
assert.equal(isDone, !isCut);
const { frames, classes, poses, scenes, records, messages } = contents;
const metadata = isCut ? [] : await checkIndex(bytes, records);
console.log(
  JSON.stringify({ frames, classes, poses, scenes, counts: countsOf(records), messages, metadata })
);
