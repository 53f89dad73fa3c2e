// Messages as `iog record` and `iog view --foxglove` write them, read by Foxglove's own packages; fails
// where one is not what the definitions and docs/recordings.md say.

import assert from "node:assert/strict";
import { createRequire } from "node:module";
import zlib from "node:zlib";

import { parse } from "@foxglove/rosmsg";
import { MessageReader } from "@foxglove/rosmsg2-serialization";

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
// Table of CRC-32 as in zlib, which node offers from version 20.15 only.
const TABLE = Uint32Array.from({ length: 256 }, (_, byte) => {
  let crc = byte;
  for (let bit = 0; bit < 8; ++bit) crc = crc & 1 ? (crc >>> 1) ^ 0xedb88320 : crc >>> 1;
  return crc >>> 0;
});
export function crc32(bytes, crc = 0) {
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

// Of a cloud: how many points have which fate, and within which box they lie.
function checkPoints(cloud) {
  const { header, fields, data } = cloud;
  assert.equal(header.frame_id, "base_link");
  assert.deepEqual(fields, [
    { name: "x", offset: 0, datatype: 7, count: 1 },
    { name: "y", offset: 4, datatype: 7, count: 1 },
    { name: "z", offset: 8, datatype: 7, count: 1 },
    { name: "fate", offset: 12, datatype: 2, count: 1 },
  ]);
  assert.deepEqual([cloud.height, cloud.point_step, cloud.is_bigendian], [1, 16, false]);
  assert.deepEqual([cloud.is_dense, cloud.row_step], [true, 16 * cloud.width]);
  assert.equal(data.length, cloud.row_step);
  const view = new DataView(data.buffer, data.byteOffset, data.length);
  const fates = {};
  const low = [Infinity, Infinity, Infinity];
  const high = low.map((value) => -value);
  for (let at = 0; at < data.length; at += 16) {
    const fate = view.getUint8(at + 12);
    fates[fate] = (fates[fate] ?? 0) + 1;
    for (let axis = 0; axis < 3; ++axis) {
      const value = view.getFloat32(at + 4 * axis, true);
      low[axis] = Math.min(low[axis], value);
      high[axis] = Math.max(high[axis], value);
    }
  }
  return { fates, low, high };
}

// Messages of topics, one after the other. Those of a frame are held against each other.
export class Contents {
  #readers = new Map();
  #topics = new Map();
  #occupancy;
  #classOccupancy;
  frames = [];
  classes = [];
  poses = [];
  scenes = [];
  points = [];
  messages = { count: 0, crc: 0 };

  addChannel(channel, schema) {
    assert.equal(channel.messageEncoding, "cdr");
    assert.equal(schema.encoding, "ros2msg");
    checkDefinition(schema);
    const definition = parse(new TextDecoder().decode(schema.data), { ros2: true });
    this.#readers.set(channel.id, new MessageReader(definition));
    this.#topics.set(channel.id, channel.topic);
  }

  topicOf(record) {
    return this.#topics.get(record.channelId);
  }

  // What there is to say of the message, if that is more than of the one that comes with it.
  addMessage(record) {
    const message = this.#readers.get(record.channelId).readMessage(record.data);
    const keep = (list, value) => {
      list.push(value);
      return value;
    };
    switch (this.topicOf(record)) {
      case "/grid":
        this.#occupancy = message;
        return {};
      case "/iogrid/image":
        checkImage(this.#occupancy, message);
        return {};
      case "/iogrid/grid": {
        const { logTime, publishTime } = record;
        const times = { log_ns: String(logTime), publish_ns: String(publishTime) };
        return keep(this.frames, { ...checkFrame(this.#occupancy, message), ...times });
      }
      case "/classes":
        this.#classOccupancy = message;
        return {};
      case "/iogrid/classes":
        return keep(this.classes, checkClasses(this.#classOccupancy, message));
      case "/tf":
        return keep(this.poses, checkTransform(message));
      case "/objects":
        return keep(this.scenes, checkScene(message, record.publishTime));
      case "/points":
        return keep(this.points, checkPoints(message));
      case "/iogrid/messages":
        this.messages.count += 1;
        this.messages.crc = crc32(message.data, this.messages.crc);
        return { crc: crc32(message.data) };
    }
    assert.fail(`a topic that docs/recordings.md does not have: ${this.topicOf(record)}`);
  }
}
