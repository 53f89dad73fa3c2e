// What is said of the cell under the mouse.

import { LAYERS, TILES_PER_SIDE, TILE_SIDE } from "./messages.js";
import { classOf, nameOfClass, probabilityOf, surenessOf } from "./palette.js";

const NEVER = 255;
const SURENESS = ["barely", "hardly sure", "not very sure", "fairly sure", "quite sure", "sure",
                  "very sure", "as sure as can be"];

// No cell is certain. Without the car's ε no probability is known.
function probabilityWords(index, epsilon) {
  if (epsilon === null) {
    return "p not known: this car's ε is not known here";
  }
  const p = probabilityOf(index, epsilon);
  if (p < 0.0001 || p > 0.9999) {
    return p < 0.5 ? "p < 0.0001" : "p > 0.9999";
  }
  return `p ${p.toFixed(4)}`;
}

// A tile of classes may have come with the newest frame, and yet say what was decided before it.
function wordsOfAge({ grid, ages, showsClasses }, tile) {
  const missed = ages[tile];
  if (missed === NEVER) {
    return "never received";
  }
  const words = missed === 0 ? [] : [`${missed} frames old`];
  const decided = grid.decidedAgo[tile];
  if (showsClasses && decided > missed) {
    words.push(`decided ${decided} frame${decided > 1 ? "s" : ""} ago`);
  }
  return words.join(", ");
}

export class HoverText {
  constructor(box) {
    this.box = box;
    this.lines = Object.fromEntries(["verdict", "sureness", "place", "cell", "value", "age"].map(
        (name) => [name, box.querySelector(`#hover-${name}`)]));
  }

  // cell: of GridCanvas.cellAt(), null where there is none.
  show(cell, view) {
    this.box.hidden = cell === null;
    if (cell === null) {
      return;
    }
    const value = view.grid.layers[view.showsClasses ? LAYERS.CLASSES : LAYERS.INDEXES][cell.number];
    const words = view.showsClasses ? wordsOfClass(cell, value, view) : wordsOfIndex(cell, value, view);
    const tile = (cell.number >> 15) * TILES_PER_SIDE + ((cell.number >> 5) & (TILES_PER_SIDE - 1));
    for (const [name, line] of Object.entries(this.lines)) {
      const text = name === "age" ? wordsOfAge(view, tile) : words[name];
      if (line.textContent !== text) {
        line.textContent = text;
      }
    }
    this.box.dataset.index = String(value);
    this.box.dataset.cell = `${cell.x},${cell.y}`;
  }
}

const metresOf = (x, y) => `x ${x.toFixed(2)} m, y ${y.toFixed(2)} m`;

// In place of the mouse's the middle of the cell.
function wordsOfIndex({ x, y }, index, { cellM, epsilon }) {
  const middle = (cell) => (cell - TILES_PER_SIDE * TILE_SIDE / 2 + 0.5) * cellM;
  return {
    verdict: index === 0 ? "unknown" : index < 0 ? "free" : "occupied",
    sureness: "",
    place: metresOf(middle(x), middle(y)),
    cell: `cell ${x}, ${y}`,
    value: `index ${index}, ${probabilityWords(index, epsilon)}`,
  };
}

function wordsOfClass({ x, y, vehicle }, byte, { cellM, grid: { classes } }) {
  const ground = (corner, cell) => ((corner * TILE_SIDE + cell + 0.5) * cellM).toFixed(2);
  const [forward, left] = vehicle;
  return {
    verdict: nameOfClass(classOf(byte)),
    sureness: byte === 0 ? "" : SURENESS[surenessOf(byte)],
    place: `${Math.abs(forward).toFixed(1)} m ${forward < 0 ? "behind" : "ahead"}, ` +
           `${Math.abs(left).toFixed(1)} m ${left < 0 ? "right" : "left"}`,
    cell: `local frame ${ground(classes.corner_a, x)}, ${ground(classes.corner_b, y)} m`,
    value: "",
  };
}
