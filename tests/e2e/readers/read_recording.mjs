// Reads an MCAP file by Foxglove's own packages and says what is in it, as JSON on standard output;
// fails where the file is not what the specification, ROS 2 and Foxglove want.
//
//   node read_recording.mjs <file>           by its index, then from beginning to end
//   node read_recording.mjs --cut <file>     one without its end: from the beginning as far as it goes

import assert from "node:assert/strict";
import fs from "node:fs";

import zstd from "@foxglove/wasm-zstd";
import { McapIndexedReader, McapStreamReader } from "@mcap/core";

import { crc32 } from "./grids.mjs";
import { Contents } from "./messages.mjs";

const decompressHandlers = { zstd: (bytes, size) => zstd.decompress(bytes, Number(size)) };

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
    assert.ok(channel.metadata.has("offered_qos_profiles"));
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
  const records = {}; // of each topic, as they are in the file
  const schemas = new Map();
  const known = new Set();
  for (let record; (record = reader.nextRecord()); ) {
    if (record.type === "Schema") schemas.set(record.id, record);
    if (record.type === "Channel" && !known.has(record.id)) {
      known.add(record.id);
      contents.addChannel(record, schemas.get(record.schemaId));
    }
    if (record.type === "Message") {
      contents.addMessage(record);
      (records[contents.topicOf(record)] ??= []).push(record);
    }
  }
  return { contents, records, isDone: reader.done() };
}

await zstd.isLoaded;
const isCut = process.argv[2] === "--cut";
const bytes = fs.readFileSync(process.argv[isCut ? 3 : 2]);
const { contents, records, isDone } = readFromBeginning(bytes);
assert.equal(isDone, !isCut);
const { frames, classes, poses, scenes, points, mounts, diagnostics, compared, messages } = contents;
const metadata = isCut ? [] : await checkIndex(bytes, records);
console.log(
  JSON.stringify({
    frames, classes, poses, scenes, points, mounts, diagnostics, compared, counts: countsOf(records), messages,
    metadata,
  })
);
