// Things with a speed: boxes and arrows on the picture, and the list beside it.

import { MOVES, STANDS, STOPPED, YOUNG, colourOfObject, css, nameOfObject } from "./palette.js";

const FONT = "11px system-ui, sans-serif";
const NARROWEST = 4; // pixels
const HEAD = 9; // pixels of an arrow's head
const NEAR = 24; // pixels a metre, from which on all boxes have room for a name
const LISTED = 6;
const KMH = 3.6;
const USUAL_PERIOD_US = 40000;
const OLDEST = 65535; // frames: or more

const isMoving = ({ state }) => state === MOVES;
const hasMoved = ({ state }) => state === MOVES || state === STOPPED;
const speedOf = ({ vx, vy }) => Math.hypot(vx, vy);
// A speed within two deviations of none is not believed, and nobody gets it.
const hasSpeed = (object) => isMoving(object) && speedOf(object) > 2 * object.sigmaAlong;

// Two deviations, rounded up.
function speedWords(object) {
  return hasSpeed(object) ? `${Math.round(speedOf(object) * KMH)} ± ${Math.ceil(2 * object.sigmaAlong * KMH)}`
                          : "–";
}

// The corners of its box in pixels of the page, in turn.
function cornersOf(view, { x, y, length, width, heading }) {
  const smallest = Math.max(view.cellM, NARROWEST / view.pixelsPerMetre);
  const [along, across] = [Math.max(smallest, length) / 2, Math.max(smallest, width) / 2];
  const [cos, sin] = [Math.cos(heading), Math.sin(heading)];
  return [[1, 1], [1, -1], [-1, -1], [-1, 1]].map(([forward, left]) => view.groundToScreen(
      x + forward * along * cos - left * across * sin, y + forward * along * sin + left * across * cos));
}

function addArrow(context, [fromX, fromY], [toX, toY]) {
  const angle = Math.atan2(toY - fromY, toX - fromX);
  const head = Math.min(HEAD, Math.hypot(toX - fromX, toY - fromY));
  context.moveTo(fromX, fromY);
  context.lineTo(toX, toY);
  for (const side of [-1, 1]) {
    context.moveTo(toX, toY);
    context.lineTo(toX - head * Math.cos(angle + side * 0.5), toY - head * Math.sin(angle + side * 0.5));
  }
}

// Light on dark, or it would be lost on free ground.
function stroke({ context, palette }, colour) {
  context.strokeStyle = palette.trackEdge;
  context.lineWidth = 4.5;
  context.stroke();
  context.strokeStyle = colour;
  context.lineWidth = 2;
  context.stroke();
}

function drawObject(view, object) {
  const { context } = view;
  const colour = css(colourOfObject(object));
  context.beginPath();
  cornersOf(view, object).forEach(([column, row]) => context.lineTo(column, row));
  context.closePath();
  context.setLineDash(object.isHit ? [] : [6, 6]);
  stroke(view, colour);
  context.setLineDash([]);
  if (hasSpeed(object)) {
    const { x, y, vx, vy } = object;
    context.beginPath();
    addArrow(context, view.groundToScreen(x, y), view.groundToScreen(x + vx, y + vy));
    stroke(view, colour);
  }
}

// Beside its box, where its arrow is not: by that it is found in the list. The words have the page's
// ink and only their frame the colour, which is too dark to be read with every kind of colour vision.
function nameObject(view, object) {
  const { context, palette } = view;
  const columns = cornersOf(view, object).map(([column]) => column);
  const [middle, row] = view.groundToScreen(object.x, object.y);
  const [tip] = view.groundToScreen(object.x + object.vx, object.y + object.vy);
  const words = hasSpeed(object) ? `${object.id}: ${Math.round(speedOf(object) * KMH)} km/h` : `${object.id}`;
  const width = context.measureText(words).width + 8;
  const left = tip > middle + 1 ? Math.min(...columns) - 5 - width : Math.max(...columns) + 5;
  context.fillStyle = palette.shade;
  context.beginPath();
  context.roundRect(left, row - 7, width, 14, 4);
  context.fill();
  context.lineWidth = 1.5;
  context.strokeStyle = css(colourOfObject(object));
  context.stroke();
  context.fillStyle = palette.ink;
  context.fillText(words, left + 4, row + 0.5);
  view.names.push({ left, right: left + width, top: row - 7, bottom: row + 7 });
}

// What moves lies on top.
export function drawObjects(view) {
  const { context, grid: { objects } } = view;
  if (objects === null) {
    return;
  }
  const inOrder = [...objects].sort((a, b) => isMoving(a) - isMoving(b));
  context.lineJoin = "round";
  inOrder.forEach((object) => drawObject(view, object));
  context.font = FONT;
  context.textAlign = "left";
  context.textBaseline = "middle";
  inOrder.filter((object) => hasMoved(object) || view.pixelsPerMetre >= NEAR)
      .forEach((object) => nameObject(view, object));
}

export const linesOfObjects = () =>
  [[css(colourOfObject({ state: MOVES })), "moves", ", arrow: distance in 1 s"],
   [css(colourOfObject({ state: STOPPED })), "stopped"],
   [css(colourOfObject({ state: STANDS })), "stands"],
   [css(colourOfObject({ state: YOUNG })), "something", ", speed unknown"],
   [null, "dashed: not hit", " in this frame"]];

const cell = (tag, textContent) => Object.assign(document.createElement(tag), { textContent });

// The object in whose box that place of the ground is, what moves first; undefined where there is none.
export function objectAt(objects, [x, y]) {
  return (objects ?? []).filter(({ x: middleX, y: middleY, length, width, heading }) => {
    const [cos, sin] = [Math.cos(heading), Math.sin(heading)];
    const [right, up] = [x - middleX, y - middleY];
    return Math.abs(right * cos + up * sin) <= length / 2 && Math.abs(up * cos - right * sin) <= width / 2;
  }).sort((a, b) => isMoving(b) - isMoving(a))[0];
}

export const wordsOfObject = (object) =>
  `object ${object.id}: ${nameOfObject(object)}${hasSpeed(object) ? `, ${speedWords(object)} km/h` : ""}`;

function rowOf(object, distance, periodS) {
  const row = document.createElement("tr");
  const id = cell("td", "");
  const spot = document.createElement("i");
  spot.style.background = css(colourOfObject(object));
  id.append(spot, String(object.id));
  const { ageFrames: frames } = object;
  const age = `${frames === OLDEST ? "> " : ""}${(frames * periodS).toFixed(frames * periodS < 9.95 ? 1 : 0)}`;
  row.append(id, ...[nameOfObject(object), speedWords(object), distance.toFixed(0), age].map(
      (words) => cell("td", words)));
  return row;
}

// The list of those that are nearest to the car, what moves first.
export class ObjectList {
  constructor(parent) {
    this.box = Object.assign(document.createElement("section"), { id: "objects", className: "chart" });
    const head = Object.assign(document.createElement("div"), { className: "chart-head" });
    this.count = Object.assign(document.createElement("span"), { className: "number quiet" });
    head.append(cell("h2", "Objects"), this.count);
    const table = Object.assign(document.createElement("table"), { className: "number" });
    const titles = document.createElement("tr");
    titles.append(...["", "what", "km/h ± 2σ", "m away", "s seen"].map((words) => cell("th", words)));
    table.append(document.createElement("thead"), document.createElement("tbody"));
    table.tHead.append(titles);
    this.rows = table.tBodies[0];
    this.box.append(head, table);
    parent.prepend(this.box);
    this.shown = null;
    this.first = null; // number and end of the first frame of this run of the target
  }

  // Seconds from frame to frame: a turn of a unit ends its frame before the car's longest one.
  secondsPerFrame({ number, closed_us: closedUs }, vehicle) {
    const frames = this.first ? number - this.first.number : 0;
    if (frames <= 0 || closedUs <= this.first.closedUs) {
      this.first = { number, closedUs };
      return (vehicle?.period_us ?? USUAL_PERIOD_US) / 1e6;
    }
    return (closedUs - this.first.closedUs) / 1e6 / frames;
  }

  show({ grid: { objects, hasObjects, frame }, pose, vehicle }) {
    this.box.hidden = !hasObjects;
    if (this.box.hidden || this.shown === frame) {
      return;
    }
    this.shown = frame;
    const listed = (objects ?? [])
        .map((object) => ({ object, distance: Math.hypot(object.x - pose.x, object.y - pose.y) }))
        .sort((a, b) => isMoving(b.object) - isMoving(a.object) || a.distance - b.distance);
    const periodS = this.secondsPerFrame(frame.status.frame, vehicle);
    this.count.textContent = objects === null ? "not known"
        : `${objects.filter(isMoving).length} of ${objects.length} move`;
    this.rows.replaceChildren(...listed.slice(0, LISTED).map(
        ({ object, distance }) => rowOf(object, distance, periodS)));
  }
}
