// The frames of the last minute, as they came: messages, most of which hold only the tiles that have
// changed. A key among them is whole in itself, so any frame is at most a second of tiles away.

import { LAYERS, LAYER_COUNT, TILE_CELLS, TILE_COUNT, decodeTile, forEachTile,
         readObjects } from "./messages.js";

const KEPT_MS = 60000;
const KEPT_BYTES = 192 * 1024 * 1024;
const NEVER = 255; // the age of what never came

export class History {
  constructor() {
    this.frames = []; // {message, timeMs, status, number}: number counts all frames that came
    this.bytes = 0;
    this.count = 0;
  }

  add(message, timeMs) {
    if (!message.isKey && this.frames.length === 0) {
      return;
    }
    this.frames.push({ message, timeMs, status: message.status, number: this.count });
    this.count += 1;
    this.bytes += message.buffer.byteLength;
    this.forget(timeMs);
  }

  // The oldest go, up to the next key, once that is old enough itself.
  forget(nowMs) {
    for (;;) {
      const next = this.frames.findIndex((frame, i) => i > 0 && frame.message.isKey);
      if (next < 0) {
        return;
      }
      const isOld = nowMs - this.frames[next].timeMs > KEPT_MS;
      if (!isOld && this.bytes < KEPT_BYTES) {
        return;
      }
      for (const frame of this.frames.splice(0, next)) {
        this.bytes -= frame.message.buffer.byteLength;
      }
    }
  }

  clear() {
    this.frames = [];
    this.bytes = 0;
  }

  get first() {
    return this.frames.length > 0 ? this.frames[0].number : 0;
  }

  get last() {
    return this.count - 1;
  }

  at(number) {
    return this.frames[number - this.first];
  }
}

// One frame: the cells of its layers, and what is drawn with them.
export class ShownGrid {
  constructor() {
    this.layers = Array.from({ length: LAYER_COUNT }, () => new Int8Array(TILE_COUNT * TILE_CELLS));
    this.changed = this.layers.map(() => new Uint8Array(TILE_COUNT)); // tiles to draw anew
    this.hasTruth = false;
    this.hasTrueClasses = false;
    this.ages = new Uint8Array(TILE_COUNT).fill(NEVER);
    this.classAges = this.ages;
    this.decidedAgo = this.ages;
    this.classes = null; // what the target says of them
    this.points = null;
    this.objects = null; // of the frame, if it is known which there are
    this.hasObjects = false; // whether it ever was
    this.number = -1;
    this.frame = null;
    this.version = 0; // another one: something has changed
  }

  get cells() {
    return this.layers[LAYERS.INDEXES];
  }

  // Shows frame `number` of the history: by the tiles that have come since the one that is shown, or
  // from the last key.
  show(history, number) {
    const frame = history.at(number);
    if (!frame || number === this.number) {
      return;
    }
    const { first } = history;
    const isAhead = this.number >= first && this.number < number;
    const stop = isAhead ? this.number - first : -1;
    let begin = number - first;
    while (begin > 0 && begin - 1 > stop && !history.frames[begin].message.isKey) {
      begin -= 1;
    }
    if (history.frames[begin].message.isKey) {
      this.layers.forEach((cells) => cells.fill(0));
      this.redrawAll();
    }
    this.apply(history.frames.slice(begin, number - first + 1));
    this.take(frame);
    this.number = number;
    this.version += 1;
  }

  take(frame) {
    const { message, status } = frame;
    this.hasTruth = message.hasTruth;
    this.hasTrueClasses = message.hasTrueClasses;
    this.ages = message.ages;
    this.classAges = message.classAges ?? this.classAges;
    this.decidedAgo = message.decidedAgo ?? this.decidedAgo;
    this.points = message.points;
    this.objects = message.objects && readObjects(message.objects);
    this.hasObjects ||= this.objects !== null;
    const { classes, sends_classes: isExpected } = status.frame ?? {};
    if (message.hasClasses) {
      this.classes = classes;
    } else if (isExpected && this.classes) {
      this.loseClasses();
    } else {
      this.classes = null;
    }
    this.frame = frame;
  }

  // Not even where the window is has come.
  loseClasses() {
    this.classes = { ...this.classes, slices: 0, causes: 0, end: null };
    this.layers[LAYERS.CLASSES].fill(0);
    this.changed[LAYERS.CLASSES].fill(1);
    this.classAges = new Uint8Array(TILE_COUNT).fill(NEVER);
  }

  redrawAll() {
    this.changed.forEach((tiles) => tiles.fill(1));
  }

  // Newest first, each tile once.
  apply(frames) {
    const seen = this.layers.map(() => new Uint8Array(TILE_COUNT));
    for (let i = frames.length - 1; i >= 0; --i) {
      forEachTile(frames[i].message, (layer, tile, encoding, payload) => {
        if (layer >= LAYER_COUNT || seen[layer][tile] !== 0) {
          return;
        }
        seen[layer][tile] = 1;
        this.changed[layer][tile] = 1;
        decodeTile(tile, encoding, payload, this.layers[layer]);
      });
    }
  }
}
