// What is said of the cell under the mouse or the finger, or of what is measured.

import { Measure, placeWords } from "./measure.js";
import { LAYERS, TILE_CELLS } from "./messages.js";
import { objectAt, wordsOfObject } from "./objects.js";
import { classOf, meaningOfClass, nameOfClass, probabilityOf, surenessOf } from "./palette.js";

const NEVER = 255;
const BESIDE = 16; // pixels from the mouse
const SURENESS = ["barely", "hardly sure", "not very sure", "fairly sure", "quite sure", "sure",
                  "very sure", "as sure as can be"];

// No cell is certain. Without ε, the probability is unknown.
function probabilityWords(index, epsilon) {
  if (epsilon === null) {
    return "p not known: ε is not known here";
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

// Where the mouse is or a finger has tapped, what is said there, and whether clicks measure.
export class Pointing {
  constructor(view, byId, redraw) {
    this.view = view;
    this.words = new HoverText(byId("hover"));
    this.button = byId("measure");
    this.redraw = redraw;
    this.place = null; // on the page; null: nowhere
    this.measured = view.measured = new Measure();
    byId("hover").addEventListener("click", () => this.hover(null));
  }

  show() {
    const cell = this.place && this.view.width ? this.view.cellAt(...this.place) : null;
    this.words.show(cell, this.view, this.place);
  }

  // The place of a finger gets a mark.
  hover(place, isFinger = false) {
    const mark = isFinger && !this.measured.isOn ? place : null;
    if (mark !== this.view.mark) {
      this.view.mark = mark;
      this.redraw();
    }
    this.place = place;
    this.show();
  }

  click(place) {
    if (this.measured.isOn && this.view.grid.frame) {
      this.measured.take(this.view.cellAt(...place), this.view);
      this.redraw();
    }
  }

  measure() {
    this.measured.isOn = !this.measured.isOn;
    this.measured.clear();
    this.button.ariaPressed = String(this.measured.isOn);
    this.hover(null);
    this.redraw();
  }

  quit() {
    if (this.measured.isOn) {
      this.measure();
    }
    this.hover(null);
  }
}

class HoverText {
  constructor(box) {
    this.box = box;
    this.lines = Object.fromEntries(
        ["verdict", "sureness", "meaning", "object", "place", "cell", "value", "age"].map(
            (name) => [name, box.querySelector(`#hover-${name}`)]));
  }

  // cell: of GridCanvas.cellAt(), null where there is none; at: its place on the page.
  show(cell, view, at) {
    const isMeasuring = view.measured.isOn;
    this.box.hidden = cell === null && !isMeasuring;
    if (this.box.hidden) {
      return;
    }
    const words = isMeasuring ? view.measured.words(view) : this.wordsOf(cell, view);
    for (const [name, line] of Object.entries(this.lines)) {
      if (line.textContent !== words[name]) {
        line.textContent = words[name];
      }
    }
    this.box.classList.toggle("measures", isMeasuring);
    this.box.classList.toggle("tapped", view.mark !== null);
    if (!isMeasuring) {
      this.put(at, view);
    }
  }

  wordsOf(cell, view) {
    const value = view.grid.layers[view.showsClasses ? LAYERS.CLASSES : LAYERS.INDEXES][cell.number];
    const tile = Math.floor(cell.number / TILE_CELLS);
    this.box.dataset.index = String(value);
    this.box.dataset.cell = `${cell.x},${cell.y}`;
    return { ...(view.showsClasses ? wordsOfClass(cell, value, view) : wordsOfIndex(cell, value, view)),
             age: wordsOfAge(view, tile) };
  }

  // Beside the mouse, on that side of it where there is room; a small picture has a place of its own for it.
  put([column, row], { width, height }) {
    const { offsetWidth, offsetHeight, style } = this.box;
    const left = column + BESIDE + offsetWidth < width ? column + BESIDE : column - BESIDE - offsetWidth;
    const top = row + BESIDE + offsetHeight < height ? row + BESIDE : row - BESIDE - offsetHeight;
    style.setProperty("--left", `${Math.max(0, left)}px`);
    style.setProperty("--top", `${Math.max(0, top)}px`);
  }
}

const metresOf = ([x, y]) => `x ${x.toFixed(2)} m, y ${y.toFixed(2)} m`;

// In place of the mouse's the middle of the cell.
function wordsOfIndex(cell, index, view) {
  const [verdict, meaning] = index === 0 ? ["unknown", "This frame has no evidence here."]
      : index < 0 ? ["free", "Nothing is here: beams of this frame have passed through."]
                  : ["occupied", "A beam of this frame has hit something here."];
  return {
    verdict,
    meaning,
    sureness: "",
    object: "",
    place: metresOf(view.middleOf(cell)),
    cell: `cell ${cell.x}, ${cell.y}`,
    value: `index ${index}, ${probabilityWords(index, view.epsilon)}`,
  };
}

function wordsOfClass({ vehicle, x, y }, byte, view) {
  const [groundX, groundY] = view.toGround(view.middleOf({ x, y }));
  const object = objectAt(view.grid.objects, view.toGround(vehicle));
  return {
    verdict: nameOfClass(classOf(byte)),
    sureness: byte === 0 ? "" : `${SURENESS[surenessOf(byte)]} (${surenessOf(byte)} of 7)`,
    meaning: meaningOfClass(classOf(byte)),
    object: object ? wordsOfObject(object) : "",
    place: placeWords(vehicle, 1),
    cell: `local frame ${groundX.toFixed(2)}, ${groundY.toFixed(2)} m`,
    value: "",
  };
}
