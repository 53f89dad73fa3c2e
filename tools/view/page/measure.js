// The distance between two cells: a click on each. With a pose the ends stay on the ground while the
// car drives, and lose their place when the ground does; without one they go with the car.

import { groundOf } from "./place.js";

const FONT = "600 13px system-ui, sans-serif";
const ASK = ["Click or tap the first place.", "Click or tap the second place.",
             "Another click begins anew. Esc or the button ends it."];

export const placeWords = ([forward, left], digits) =>
  `${Math.abs(forward).toFixed(digits)} m ${forward < 0 ? "behind" : "ahead"}, ` +
  `${Math.abs(left).toFixed(digits)} m ${left < 0 ? "right" : "left"}`;

// The path, so that it is seen on any ground.
function stroke({ context, palette }) {
  for (const [colour, width] of [[palette.shade, 5], [palette.ink, 2]]) {
    context.strokeStyle = colour;
    context.lineWidth = width;
    context.stroke();
  }
}

// A ring around a place of the page.
export function drawEnd(view, [column, row]) {
  view.context.beginPath();
  view.context.arc(column, row, 7, 0, 2 * Math.PI);
  stroke(view);
}

export class Measure {
  constructor() {
    this.isOn = false;
    this.clear();
  }

  clear() {
    this.ends = []; // metres of the ground, or of the vehicle
    this.isOnGround = false;
    this.ground = null; // its name
    this.notice = "";
  }

  // Where the ends are now, in metres of the vehicle.
  placesIn(view) {
    return this.ends.map((end) => (this.isOnGround ? view.fromGround(end) : end));
  }

  // cell: where the click was, null outside of the grid.
  take(cell, view) {
    this.notice = cell === null ? "This is outside of the grid." : "";
    if (cell === null) {
      return;
    }
    if (this.ends.length !== 1) {
      this.clear();
      this.isOnGround = view.place !== null;
      this.ground = groundOf(view.grid.frame.status);
    }
    const middle = view.middleOf(cell);
    this.ends.push(this.isOnGround ? view.toGround(middle) : middle);
  }

  // Whether the ground of the ends is still that of the frame that is shown.
  check({ grid, place }) {
    if (!this.isOnGround || this.ends.length === 0) {
      return;
    }
    const ground = place === null ? "" : groundOf(grid.frame.status);
    this.ground ??= ground;
    if (ground !== null && ground !== this.ground) {
      this.clear();
      this.notice = "The ground that was measured has lost its place.";
    }
  }

  // What is said in place of a cell's words.
  words(view) {
    const places = this.placesIn(view);
    const isDone = places.length === 2;
    const [from, to = ""] = places.map((place) => placeWords(place, 2));
    return {
      verdict: isDone ? distanceWords(places) : "Distance",
      sureness: "",
      meaning: [this.notice, ASK[places.length]].join(" ").trim(),
      object: from ? `from ${from}` : "",
      place: to && `to ${to}`,
      cell: "",
      value: "",
      age: from ? `The ends ${this.isOnGround ? "stay on the ground" : "go with the car: there is no pose"}.` : "",
    };
  }

  draw(view) {
    const places = this.placesIn(view);
    const ends = places.map(([x, y]) => view.toScreen(x, y));
    view.context.beginPath();
    ends.forEach(([column, row]) => view.context.lineTo(column, row));
    stroke(view);
    ends.forEach((end) => drawEnd(view, end));
    if (ends.length === 2) {
      view.context.font = FONT;
      drawWords(view, distanceWords(places), ends[0].map((at, i) => (at + ends[1][i]) / 2), view.palette.ink);
    }
  }
}

const distanceWords = ([[x, y], [toX, toY]]) => `${Math.hypot(toX - x, toY - y).toFixed(2)} m`;

// In the font that is set, with their middle there.
export function drawWords({ context, palette }, words, [column, row], ink) {
  context.textAlign = "center";
  context.textBaseline = "middle";
  const width = context.measureText(words).width + 8;
  context.fillStyle = palette.shade;
  context.beginPath();
  context.roundRect(column - width / 2, row - 8, width, 16, 4);
  context.fill();
  context.fillStyle = ink;
  context.fillText(words, column, row + 0.5);
}
