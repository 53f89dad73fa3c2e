// The state of things in words: what the banner says, and what the pill says. A picture that is not
// of now never looks as if it were.

import { TILE_COUNT } from "./messages.js";
import { describePlace } from "./place.js";

const SERVER_SILENT_MS = 2500;

const seconds = (ms) => (ms < 10000 ? (ms / 1000).toFixed(1) : Math.round(ms / 1000)) + " s";

// A target has made the grid, now or when it was recorded; otherwise this PC makes it of scans.
export const isOfTarget = (kind) => kind === "stream" || kind === "recording";

// status: the newest from the server, or null. serverSilentMs: since its last message.
export function describe(status, serverSilentMs, isConnected) {
  if (!isConnected || serverSilentMs > SERVER_SILENT_MS) {
    return { state: "gone", word: "no server", title: "iog view does not answer",
             text: status ? "This is the last picture. The page tries to connect again."
                          : "The page tries to connect. No more than 16 pages are served." };
  }
  if (!status) {
    return { state: "waiting", word: "connecting", title: "", text: "" };
  }
  if (status.car_refused) {
    return { state: "incompatible", word: "car refused",
             title: "The target has refused the car of its image and sends no grid",
             text: status.car_refused };
  }
  switch (status.state) {
    case "live":
      return describeLive(status);
    case "stale":
      return { state: "stale", word: `stale for ${seconds(status.silent_ms)}`,
               title: `Nothing has come for ${seconds(status.silent_ms)}`,
               text: "This is the last picture, not the present one." };
    case "incompatible":
      return { state: "incompatible", word: "incompatible",
               title: status.other_version ? "Another version of the stream"
                                           : "A grid or encoding that is new to this program",
               text: status.other_version
                   ? `The target sends interface version ${status.version_sent}; ` +
                     `this iog reads ${status.version_read}.`
                   : "What comes cannot be shown." };
    case "ended":
      return { state: "ended", word: `end of recording${status.breaks_off ? ", in mid-frame" : ""}`,
               title: "", text: "" };
    default:
      return { state: "waiting", word: "waiting", title: "Waiting for a grid",
               text: `on ${status.source}` };
  }
}

const FATE_NOT_TAKEN = 9; // docs/spec.md 1.3

// Frames without a packet of any sensor before that is called silence.
const SILENT_FRAMES = 5;

const hasEvidence = ({ status: { frame } }) =>
  Boolean(frame) && (frame.complete !== 0 || frame.partial !== 0);

// The frame of which numbers beside the picture are, so that they do not flicker where every other
// frame is empty: the newest of the last few with a packet in it, else the one that is shown.
export function frameOfNumbers(frames, shown) {
  const end = frames.findIndex(({ number }) => shown && number > shown.number);
  const lately = frames.slice(0, end < 0 ? frames.length : end).slice(-SILENT_FRAMES);
  return lately.reverse().find(hasEvidence) ?? shown;
}

const RATE_MS = 3000;
const ALIKE = 0.1;

// Frames a second that arrive here, by the clock of this PC, those that this page has skipped among
// them; and how many the target makes by its own clock, if that is another number.
export function rateOf(frames, status) {
  const lately = status && status.state === "live"
      ? frames.filter(({ timeMs, status: { frame } }) => frame && status.now_ms - timeMs < RATE_MS) : [];
  const [first, last] = [lately[0], lately[lately.length - 1]];
  if (lately.length < 2 || last.timeMs - first.timeMs < RATE_MS / 3) {
    return "";
  }
  const grown = (count) => count(last.status) - count(first.status);
  const made = grown(({ frame }) => frame.number);
  const came = made - grown(({ counts }) => counts.frames_lost);
  const makes = made / grown(({ frame }) => frame.closed_us) * 1e6;
  const comes = came / (last.timeMs - first.timeMs) * 1e3;
  if (!(comes > 0 && makes > 0 && makes < 1000)) {
    return ""; // it has started anew
  }
  return Math.abs(comes - makes) > ALIKE * makes ? `${comes.toFixed(1)} of ${makes.toFixed(1)} Hz`
                                                 : `${makes.toFixed(1)} Hz`;
}

// Of the tab, where the beginning is what can be read.
export function titleOf(said, isHeld) {
  const word = said.state === "stale" ? "stale" : said.word;
  return `${isHeld ? "paused, " : ""}${word} – iogrid`;
}

function describeLive(status) {
  const { frame } = status;
  const live = { state: "live", word: "live", title: "", text: "" };
  if (status.restarted) {
    return { ...live, title: "The target has started anew", text: "" };
  }
  if (status.corrupt) {
    return { ...live, state: "corrupt", word: "live, corrupt messages",
             title: "Corrupt messages",
             text: `${status.counts.corrupt + status.counts.malformed} so far; ` +
                   "what they carried is missing here." };
  }
  if (status.other_version) {
    return { ...live, state: "corrupt", word: "live, two senders?",
             title: "Messages of another version come, too", text: "They are left out." };
  }
  if (frame && (frame.damaged || (frame.classes && frame.classes.damaged))) {
    return { ...live, state: "corrupt", word: "live, wrong grid",
             title: "This grid is not the one that the target has hashed", text: "" };
  }
  if (status.too_slow) {
    const left = frame && frame.end ? frame.end.fates[FATE_NOT_TAKEN] : 0;
    return { ...live, state: "corrupt", word: "live, target too slow",
             title: "The target is too slow for its sensors",
             text: left > 0 ? `It has left ${left.toLocaleString("en")} scan points of this frame.`
                            : "It leaves scan points that it has no time for." };
  }
  const temperature = frame && frame.end && frame.end.temperature;
  if (temperature && temperature.warm) {
    return { ...live, state: "corrupt", word: `live, chip ${temperature.too_hot ? "too hot" : "warm"}`,
             title: `The target's chip is ${temperature.too_hot ? "too hot" : "warm"}: ${temperature.words}`,
             text: "From 95 degrees on it may be damaged, compute wrongly, or stop." };
  }
  // A target that waits for its packets closes an empty frame now and then.
  if (frame && frame.complete === 0 && frame.partial === 0 &&
      !(frame.end ? frame.end.sensors : []).some(({ age }) => age < SILENT_FRAMES)) {
    return { ...live, state: "silent", word: "live, sensors silent",
             title: "No sensor delivers", text: "The target runs and has nothing to fuse." };
  }
  const place = describePlace(frame && frame.classes);
  if (place) {
    return { ...live, ...place, state: place.word === "" ? "live" : "silent",
             word: place.word === "" ? "live" : `live, ${place.word}` };
  }
  if (frame && (frame.missing_tiles > 0 || (frame.classes && frame.classes.missing_tiles > 0))) {
    return { ...live, word: "live, tiles missing" };
  }
  return live;
}

// of: a frame, or its classes.
const crcWords = (of) =>
  (of && of.end ? of.end.crc + (of.whole ? (of.damaged ? " WRONG" : " ok") : "") : "–");

function factsOfClasses(classes) {
  const [used, , ...dropped] = classes.end ? classes.end.poses : [0, 0];
  return [
    ["class grid CRC", crcWords(classes)],
    ["class tiles known", `${classes.known_tiles} of ${TILE_COUNT}`],
    ["class tiles missing, stale", `${classes.missing_tiles}, ${classes.stale_tiles}`],
    ["poses used, dropped", `${used.toLocaleString("en")}, ${dropped.reduce((a, b) => a + b, 0)}`],
  ];
}

const factsOfObjects = ({ refused, hits_left: left }) =>
  [["objects without room, hits left", `${refused}, ${left}`]];

export function factsOf(status) {
  const { counts, frame } = status;
  const end = frame && frame.end;
  const rows = [
    ["grid CRC", crcWords(frame)],
    ["tiles known", frame ? `${frame.known_tiles} of ${frame.grid.tiles}` : "–"],
    ["tiles missing, stale", frame ? `${frame.missing_tiles}, ${frame.stale_tiles}` : "–"],
    ...(frame && frame.classes ? factsOfClasses(frame.classes) : []),
    ...(frame && frame.objects ? factsOfObjects(frame.objects) : []),
    ["messages", counts.messages.toLocaleString("en")],
    ["lost, late", `${counts.lost}, ${counts.late}`],
    ["corrupt, malformed", `${counts.corrupt}, ${counts.malformed}`],
    ["other version, not ours", `${counts.other_version}, ${counts.not_ours}`],
    ["restarts of the target", String(counts.restarts)],
    ["of another run", String(counts.other_run)],
    ["E2E channel", status.channel],
  ];
  if (end && end.cores) {
    rows.push(["cores at work", end.cores]);
  }
  if (end && end.temperature) {
    rows.push(["chip", end.temperature.words]);
  }
  if (end && end.starts) {
    rows.push(["target's starts", end.starts]);
  }
  if (end && end.stack_bytes > 0) {
    rows.push(["deepest stack", `${end.stack_bytes.toLocaleString("en")} bytes`]);
  }
  return rows;
}
