// A client of `iog view --foxglove`, by Foxglove's own package of the protocol: reads commands from
// standard input, a JSON object a line, and says on standard output, likewise, what comes. A message
// that is not as it should be ends it.
//
//   node listen.mjs <ws://...>
//
//   {"subscribe": ["/tf", ...]}     {"unsubscribe": ["/tf", ...]}     by topic
//   {"halt": true}                  stops to read from the connection; false goes on
//   {"text": "..."}                 sent as it is
//   {"close": true}

import assert from "node:assert/strict";
import { createRequire } from "node:module";
import readline from "node:readline";

import WebSocket from "ws";

import { Contents } from "./messages.mjs";

const require = createRequire(import.meta.url);
const { FoxgloveClient } = require("@foxglove/ws-protocol");

const say = (event) => console.log(JSON.stringify(event));
const contents = new Contents();
const channels = new Map(); // by topic
const subscriptions = new Map(); // their channels, by id

const socket = new WebSocket(process.argv[2], [FoxgloveClient.SUPPORTED_SUBPROTOCOL]);
const client = new FoxgloveClient({ ws: socket });

client.on("open", () => say({ open: socket.protocol }));
client.on("error", (error) => say({ error: error.message }));
client.on("close", ({ code }) => {
  say({ close: code });
  process.exit(0);
});
client.on("serverInfo", (info) => say({ serverInfo: info }));
client.on("status", (status) => say({ status }));
client.on("advertise", (added) => {
  for (const { id, topic, encoding, schemaName, schema, schemaEncoding } of added) {
    assert.ok(!channels.has(topic), topic);
    channels.set(topic, id);
    contents.addChannel(
      { id, topic, messageEncoding: encoding },
      { name: schemaName, encoding: schemaEncoding, data: new TextEncoder().encode(schema) }
    );
  }
  say({ advertise: added.map(({ id, topic, schemaName }) => ({ id, topic, schemaName })) });
});
client.on("unadvertise", (gone) => {
  for (const [topic, id] of channels) if (gone.includes(id)) channels.delete(topic);
  for (const [id, channel] of subscriptions) if (gone.includes(channel)) subscriptions.delete(id);
  say({ unadvertise: gone });
});
client.on("message", ({ subscriptionId, timestamp, data }) => {
  assert.ok(subscriptions.has(subscriptionId), `a message of subscription ${subscriptionId}`);
  const record = {
    channelId: subscriptions.get(subscriptionId),
    data,
    logTime: timestamp,
    publishTime: timestamp,
  };
  const found = contents.addMessage(record);
  say({ topic: contents.topicOf(record), time_ns: String(timestamp), found });
});

function obey({ subscribe = [], unsubscribe = [], text, halt, close }) {
  for (const topic of subscribe) {
    const channel = channels.get(topic);
    assert.notEqual(channel, undefined, topic);
    subscriptions.set(client.subscribe(channel), channel);
  }
  for (const topic of unsubscribe) {
    const [id] = [...subscriptions].find(([, channel]) => channel === channels.get(topic));
    client.unsubscribe(id);
  }
  if (halt === true) socket.pause();
  if (halt === false) socket.resume();
  if (text) socket.send(text);
  if (close) client.close();
}

readline.createInterface({ input: process.stdin }).on("line", (line) => obey(JSON.parse(line)));
