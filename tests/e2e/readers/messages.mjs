// Messages as `iog record` and `iog view --foxglove` write them, read by Foxglove's own packages; fails
// where one is not what the definitions and docs/recordings.md say.

import assert from "node:assert/strict";
import { createRequire } from "node:module";

import { parse } from "@foxglove/rosmsg";
import { MessageReader } from "@foxglove/rosmsg2-serialization";

import { checkClasses, checkFrame, checkImage, crc32 } from "./grids.mjs";

const require = createRequire(import.meta.url);
const { ros2jazzy } = require("@foxglove/rosmsg-msgs-common");
const foxglove = require("@foxglove/schemas/internal");

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

// The definition in the file is the published one, and so are those of the types that it is made of.
function checkDefinition(schema) {
  const types = parse(new TextDecoder().decode(schema.data), { ros2: true });
  for (const type of types) {
    const published = ros2jazzy[type.name ?? schema.name.replace("/msg/", "/")];
    if (published) assert.deepEqual(fields(type), fields(published), `${schema.name}: ${type.name}`);
  }
  if (schema.name.replace("/msg/", "/") in ros2jazzy) return;
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

// The mounts of a car: where each sensor is, and its axes, column by column, in the vehicle frame.
function checkMounts({ transforms }) {
  return transforms.map(({ header, child_frame_id, transform }) => {
    assert.equal(header.frame_id, "base_link");
    const { x, y, z, w } = transform.rotation;
    assert.ok(Math.abs(x ** 2 + y ** 2 + z ** 2 + w ** 2 - 1) < 1e-12);
    const axes = [
      [1 - 2 * (y * y + z * z), 2 * (x * y + z * w), 2 * (x * z - y * w)],
      [2 * (x * y - z * w), 1 - 2 * (x * x + z * z), 2 * (y * z + x * w)],
      [2 * (x * z + y * w), 2 * (y * z - x * w), 1 - 2 * (x * x + y * y)],
    ];
    const { translation } = transform;
    return { name: child_frame_id, at: [translation.x, translation.y, translation.z], axes };
  });
}

// Markers say what a scene says of the same objects; those of earlier ones are taken away first.
function checkMarkers({ markers }, { objects }, stamp) {
  const [first, ...rest] = markers;
  assert.equal(first.action, 3); // DELETEALL
  const boxes = rest.filter(({ ns }) => ns === "box");
  assert.deepEqual(boxes.map(({ id }) => String(id >>> 0)), objects.map(({ id }) => id));
  for (const marker of rest) {
    const object = objects.find(({ id }) => id === String(marker.id >>> 0));
    assert.equal(marker.header.frame_id, "odom");
    assert.deepEqual(marker.header.stamp, stamp);
    assert.deepEqual([marker.action, marker.frame_locked], [0, false]);
    assert.equal(marker.lifetime.sec + marker.lifetime.nsec / 1e9, object.lifetime_s);
    const { position, orientation } = marker.pose;
    assert.deepEqual([position.x, position.y], [object.x, object.y]);
    const { scale, color } = marker;
    if (marker.ns === "box") {
      assert.deepEqual([marker.type, scale], [1, { x: object.length, y: object.width, z: 1.5 }]);
      assert.equal(position.z, 0.75);
      assert.equal(angleOf(orientation), object.heading);
      assert.deepEqual([RGB(color), color.a], [object.colour, Math.fround(object.alpha)]);
    } else if (marker.ns === "way") {
      assert.equal(marker.type, 0);
      assert.ok(Math.abs(scale.x - object.arrow.length) < 1e-9);
      assert.equal(angleOf(orientation), object.arrow.angle);
      assert.deepEqual(RGB(color), object.colour);
    } else {
      assert.deepEqual([marker.ns, marker.type, marker.text], ["words", 9, object.text]);
      assert.ok(scale.z > 0 && position.z > 1.5);
    }
  }
  const ways = objects.filter(({ arrow }) => arrow).length;
  assert.equal(rest.length, 2 * objects.length + ways);
}

// What a frame says of its target: one name each, at a known level, of one device.
function checkDiagnostics({ header, status }, publishTime) {
  const { sec, nsec } = header.stamp;
  assert.equal(BigInt(sec) * 1000000000n + BigInt(nsec), publishTime);
  assert.equal(header.frame_id, "");
  assert.equal(new Set(status.map(({ name }) => name)).size, status.length);
  assert.ok(new Set(status.map(({ hardware_id }) => hardware_id)).size <= 1);
  return Object.fromEntries(status.map(({ level, name, message, hardware_id, values }) => {
    assert.ok(level <= 2 && message.length > 0, name);
    return [name, { level, message, hardware_id,
      values: Object.fromEntries(values.map(({ key, value }) => [key, value])) }];
  }));
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
  #scene;
  #markers;
  frames = [];
  classes = [];
  poses = [];
  scenes = [];
  points = [];
  mounts = []; // of the last message
  diagnostics = [];
  messages = { count: 0, crc: 0 };

  addChannel(channel, schema) {
    assert.equal(channel.messageEncoding, "cdr");
    assert.equal(schema.encoding, "ros2msg");
    checkDefinition(schema);
    const definition = parse(new TextDecoder().decode(schema.data), { ros2: true });
    this.#readers.set(channel.id, new MessageReader(definition));
    this.#topics.set(channel.id, channel.topic);
  }

  // If those of both topics have come for a frame.
  #compareMarkers() {
    const time = this.#scene?.time;
    if (time === undefined || this.#markers?.time !== time) return;
    const stamp = { sec: Number(time / 1000000000n), nsec: Number(time % 1000000000n) };
    checkMarkers(this.#markers.message, this.#scene, stamp);
    this.compared += 1;
  }
  compared = 0; // lists of markers

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
        this.#scene = { time: record.publishTime, ...checkScene(message, record.publishTime) };
        this.#compareMarkers();
        return keep(this.scenes, { gone: this.#scene.gone, objects: this.#scene.objects });
      case "/objects/markers":
        this.#markers = { time: record.publishTime, message };
        this.#compareMarkers();
        return {};
      case "/tf_static":
        this.mounts = checkMounts(message);
        return { mounts: this.mounts };
      case "/diagnostics":
        return keep(this.diagnostics, checkDiagnostics(message, record.publishTime));
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
