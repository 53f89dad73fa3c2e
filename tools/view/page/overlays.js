// What is drawn on the grid, from the ground up. Each overlay can be switched off by itself.

import { drawOutlines } from "./map_outlines.js";
import { drawEnd, drawWords } from "./measure.js";
import { LAYERS, TILE_CELLS, TILE_SIDE, forEachPoint } from "./messages.js";
import { drawObjects } from "./objects.js";
import { FATES, MOVING, classOf, css } from "./palette.js";
import { drawCar, drawDeviation, drawTrack, drawUnwatched, drawViews } from "./vehicle_overlays.js";

// isOfClasses: it says nothing of the index grid. isOfMap: it needs a map block of this PC.
// isOfObjects: it needs a target that tells them.
export const OVERLAYS = [
  { id: "mounts", key: "s", name: "car, fields of view" },
  { id: "rings", key: "g", name: "distances" },
  { id: "track", key: "k", name: "track, pose", isOfClasses: true },
  { id: "up", key: "u", name: "car drives upwards", isOfClasses: true },
  { id: "objects", key: "b", name: "objects", isOfClasses: true, isOfObjects: true },
  { id: "outlines", key: "o", name: "map outlines", isOfClasses: true, isOfMap: true },
  { id: "ages", key: "a", name: "tile ages, stale tiles" },
  { id: "points", key: "p", name: "scan points" },
  { id: "leaves", key: "q", name: "quadtree leaves" },
  { id: "truth", key: "t", name: "true occupancy", nameOfClasses: "true movers" },
  { id: "difference", key: "x", name: "difference to truth" },
];

const FONT = "12px system-ui, sans-serif";
const NEVER = 255;
const USUAL_AGE = 8; // frames in which each tile is decided anew

export function draw(view) {
  const on = (id) => view.overlays.has(id);
  const isOfClasses = view.showsClasses;
  view.names = []; // where they are, of objects
  if (on("truth") || on("difference")) {
    drawTruth(view, on("difference"));
  }
  if (on("leaves")) {
    drawLeaves(view);
  }
  if (isOfClasses && on("outlines")) {
    drawOutlines(view);
  }
  if (on("rings")) {
    drawRings(view);
  }
  if (on("mounts")) {
    drawViews(view);
  }
  if (isOfClasses && on("track")) {
    drawTrack(view);
  }
  if (!on("difference")) {
    view.drawMarks();
  }
  if (isOfClasses) {
    fadeOldTiles(view);
  }
  if (on("points") && view.grid.points) {
    drawPoints(view);
  }
  if (isOfClasses && on("objects")) {
    drawObjects(view);
  }
  if (on("ages") && view.grid.number >= 0) {
    drawAges(view);
  }
  if (on("rings")) {
    drawDistances(view);
  }
  if (isOfClasses && on("track")) {
    drawDeviation(view);
  }
  if (on("mounts")) {
    drawUnwatched(view);
  }
  drawCar(view, on("mounts"));
  drawScaleBar(view);
  view.measured.draw(view);
  if (view.mark) {
    drawEnd(view, view.mark);
  }
}

// Against the truth a cell is: hit, and occupied; hit, and nothing is there; free, and yet occupied.
export function judgement(index, isTrue) {
  if (index > 0) {
    return isTrue ? "agreed" : "invented";
  }
  return index < 0 && isTrue ? "missed" : "";
}

// It is called moving, and moves; it is called moving, and does not; it is something, and moves
// without being called so.
export const TRUE_MOVING = 1; // of tools/simulate/truth/cell_truth.hpp: 2 may move, 3 never does

export function judgementOfClass(byte, truth) {
  if (classOf(byte) === MOVING) {
    return truth === TRUE_MOVING ? "agreed" : "invented";
  }
  return classOf(byte) > MOVING && truth === TRUE_MOVING ? "missed" : "";
}

export const hasTruth = ({ grid, showsClasses }) =>
  showsClasses ? grid.hasTrueClasses : grid.hasTruth;

function drawTruth(view, isDifference) {
  if (!hasTruth(view)) {
    return;
  }
  const [red, green, blue] = view.palette.missed;
  const colour = (((isDifference ? 0x55 : 0xb0) << 24) | (blue << 16) | (green << 8) | red) >>> 0;
  const table = new Uint32Array(256);
  table[TRUE_MOVING] = colour; // which is the layer's "occupied", too
  view.drawImage(view.paint(view.images.truth,
                            view.showsClasses ? LAYERS.TRUE_CLASSES : LAYERS.OCCUPIED, table,
                            () => false));
  if (isDifference) {
    drawJudged(view);
  }
}

function drawJudged(view) {
  const { context, grid, palette, showsClasses } = view;
  const cells = grid.layers[showsClasses ? LAYERS.CLASSES : LAYERS.INDEXES];
  const truth = grid.layers[showsClasses ? LAYERS.TRUE_CLASSES : LAYERS.OCCUPIED];
  const judge = showsClasses ? judgementOfClass : (index, isTrue) => judgement(index, isTrue !== 0);
  const size = Math.max(2.4, view.pixelsPerMetre * view.cellM);
  const { columns, rows } = view.shape;
  for (let y = 0, number = 0; y < rows; ++y) {
    for (let x = 0; x < columns; ++x) {
      number = x % TILE_SIDE === 0 ? view.numberOf(x, y) : number + 1;
      const verdict = cells[number] === 0 ? "" : judge(cells[number], truth[number]);
      if (verdict !== "") {
        const [column, row] = view.cellToScreen(x + 0.5, y + 0.5);
        context.fillStyle = css(palette[verdict]);
        context.fillRect(column - size / 2, row - size / 2, size, size);
      }
    }
  }
}

// Blocks of one value, as a quadtree over a tile would have them. `cells` are the tile's.
function leavesOf(cells, x, y, side, found) {
  const value = cells[y * TILE_SIDE + x];
  for (let row = y; row < y + side; ++row) {
    for (let cell = row * TILE_SIDE + x; cell < row * TILE_SIDE + x + side; ++cell) {
      if (cells[cell] !== value) {
        const half = side / 2;
        leavesOf(cells, x, y, half, found);
        leavesOf(cells, x + half, y, half, found);
        leavesOf(cells, x, y + half, half, found);
        leavesOf(cells, x + half, y + half, half, found);
        return;
      }
    }
  }
  found.push(x, y, side);
}

let leaves = [];
let shownLeaves = "";

// x, y and side of each, in cells of the picture.
export function quadtreeLeaves(view) {
  const { grid, shape, showsClasses, pictureName } = view;
  const name = `${pictureName} ${showsClasses}`;
  if (shownLeaves !== name) {
    const cells = grid.layers[showsClasses ? LAYERS.CLASSES : LAYERS.INDEXES];
    shownLeaves = name;
    leaves = [];
    for (let y = 0; y < shape.rows; y += TILE_SIDE) {
      for (let x = 0; x < shape.columns; x += TILE_SIDE) {
        const [first, found] = [view.numberOf(x, y), []];
        leavesOf(cells.subarray(first, first + TILE_CELLS), 0, 0, TILE_SIDE, found);
        found.forEach((number, i) => leaves.push(number + [x, y, 0][i % 3]));
      }
    }
  }
  return leaves;
}

function drawLeaves(view) {
  const { context } = view;
  const { columns, rows } = view.shape;
  const pixelsPerCell = view.pixelsPerMetre * view.cellM;
  const found = quadtreeLeaves(view);
  view.inPicture(() => {
    context.beginPath();
    for (let i = 0; i < found.length; i += 3) {
      const [x, y, side] = found.slice(i, i + 3);
      if (side * pixelsPerCell >= 4 && isSeen(view, x + side / 2, y + side / 2, side)) {
        context.rect((rows - y - side) * pixelsPerCell, (columns - x - side) * pixelsPerCell,
                     side * pixelsPerCell, side * pixelsPerCell);
      }
    }
    context.strokeStyle = view.palette.leaf;
    context.lineWidth = 1;
    context.stroke();
  });
}

// Whether some of a square around that cell may be on the screen.
function isSeen(view, x, y, side) {
  const [column, row] = view.cellToScreen(x, y);
  const reach = side * view.pixelsPerMetre * view.cellM;
  return column > -reach && row > -reach && column < view.width + reach &&
         row < view.height + reach;
}

const ringStep = ({ pixelsPerMetre: scale }) =>
  (scale > 60 ? 1 : scale > 24 ? 5 : scale > 2.4 ? 10 : 50);

// The distance to the farthest edge of the grid.
const ringReach = ({ shape: { origin: [x, y], columns, rows, cell_m: cellM } }) =>
  Math.max(x, columns - x, y, rows - y) * cellM;

function drawRings(view) {
  const { context, palette } = view;
  const step = ringStep(view);
  const [column, row] = view.toScreen(0, 0);
  context.strokeStyle = palette.ring;
  context.lineWidth = 1;
  const farthest = ringReach(view);
  for (let radius = step; radius <= farthest; radius += step) {
    context.beginPath();
    context.arc(column, row, radius * view.pixelsPerMetre, 0, 2 * Math.PI);
    context.stroke();
  }
}

// Where distances may stand: ahead, else to a side, else behind.
const SIDES = [[0, -1], [1, 0], [-1, 0], [0, 1]];

// Above everything that may be there, but no object's name.
function drawDistances(view) {
  const { context, palette } = view;
  const step = ringStep(view);
  const [column, row] = view.toScreen(0, 0);
  context.font = FONT;
  const farthest = ringReach(view);
  for (let radius = step; radius <= farthest; radius += step) {
    const words = `${radius} m`;
    const width = context.measureText(words).width + 8;
    const reach = radius * view.pixelsPerMetre;
    const place = SIDES.map(([right, down]) => [column + right * reach, row + down * reach]).find(
        ([x, y]) => !view.names.some(({ left, right, top, bottom }) =>
          left < x + width / 2 && right > x - width / 2 && top < y + 8 && bottom > y - 8));
    if (place) {
      drawWords(view, words, place, palette.ringText);
    }
  }
}

function drawPoints(view) {
  const { context, pictureTheme } = view;
  const size = Math.max(2.5, Math.min(6, view.pixelsPerMetre * 0.08));
  let last = -1;
  forEachPoint(view.grid.points, (x, y, fate) => {
    if (fate !== last && FATES[fate]) {
      context.fillStyle = FATES[fate].colour[pictureTheme];
      last = fate;
    }
    const [column, row] = view.toScreen(x, y);
    context.fillRect(column - size / 2, row - size / 2, size, size);
  });
}

// Calls paint(column, row, side, tile) for each tile of the picture, in its own coordinates.
function forEachTileOf(view, paint) {
  const [across, up] = [view.shape.columns / TILE_SIDE, view.shape.rows / TILE_SIDE];
  view.inPicture((width) => {
    const side = width / up;
    for (let tile = 0; tile < view.ages.length; ++tile) {
      const [x, y] = view.placeOf(tile);
      if (x < across && y < up) {
        paint((up - 1 - y) * side, (across - 1 - x) * side, side, tile);
      }
    }
  });
}

// The older what a tile of classes says, the fainter. What did not come with the newest frame is
// faint at once.
function fadeOldTiles(view) {
  const { context, grid, palette } = view;
  context.fillStyle = palette.outside;
  forEachTileOf(view, (left, top, side, tile) => {
    const missed = grid.classAges[tile];
    const overdue = Math.max(0, grid.decidedAgo[tile] - USUAL_AGE);
    const fade = (missed > 0 ? 0.25 : 0) + Math.max(missed, overdue) * 0.03;
    if (fade > 0 && missed !== NEVER) {
      context.globalAlpha = Math.min(0.85, fade);
      context.fillRect(left, top, side, side);
    }
  });
}

// Tiles that are not of the newest frame are hatched, the denser the older; tiles that never came
// carry a cross.
function drawAges(view) {
  const { context, palette } = view;
  context.strokeStyle = palette.stale;
  context.lineWidth = 1;
  forEachTileOf(view, (left, top, side, tile) => {
    const age = view.ages[tile];
    if (age === 0) {
      return;
    }
    context.beginPath();
    if (age === NEVER) {
      cross(context, left, top, side);
    } else {
      hatch(context, left, top, side, age < 5 ? 3 : 5);
    }
    context.stroke();
  });
}

function cross(context, left, top, side) {
  context.moveTo(left, top);
  context.lineTo(left + side, top + side);
  context.moveTo(left, top + side);
  context.lineTo(left + side, top);
}

function hatch(context, left, top, side, lines) {
  for (let i = 1; i <= lines; ++i) {
    const at = side * i / lines;
    context.moveTo(left, top + at);
    context.lineTo(left + at, top);
    if (i < lines) {
      context.moveTo(left + at, top + side);
      context.lineTo(left + side, top + at);
    }
  }
}

function drawScaleBar(view) {
  const { context, palette } = view;
  const metres = [0.5, 1, 2, 5, 10, 20, 50].find((m) => m * view.pixelsPerMetre >= 70) ?? 50;
  const length = metres * view.pixelsPerMetre;
  const right = view.width - 18;
  const bottom = view.height - 20;
  context.fillStyle = palette.shade;
  context.beginPath();
  view.scaleBar = [right - length - 12, bottom - 26, right + 12, bottom + 8];
  context.roundRect(right - length - 12, bottom - 26, length + 24, 34, 8);
  context.fill();
  context.strokeStyle = palette.ink;
  context.lineWidth = 2;
  context.beginPath();
  context.moveTo(right - length, bottom - 5);
  context.lineTo(right - length, bottom);
  context.lineTo(right, bottom);
  context.lineTo(right, bottom - 5);
  context.stroke();
  context.fillStyle = palette.ink;
  context.font = FONT;
  context.textAlign = "center";
  context.textBaseline = "bottom";
  context.fillText(`${metres} m`, right - length / 2, bottom - 4);
}
