// What is drawn on the grid, from the ground up. Each overlay can be switched off by itself.

import { SIDE, TILES_PER_SIDE, TILE_SIDE, forEachPoint } from "./messages.js";
import { FATES, css } from "./palette.js";

export const OVERLAYS = [
  { id: "mounts", key: "m", name: "car, fields of view" },
  { id: "rings", key: "g", name: "distances" },
  { id: "ages", key: "a", name: "tile ages, stale tiles" },
  { id: "points", key: "p", name: "scan points" },
  { id: "leaves", key: "q", name: "quadtree leaves" },
  { id: "truth", key: "t", name: "true occupancy" },
  { id: "difference", key: "x", name: "difference to truth" },
];

const FONT = "12px system-ui, sans-serif";

export function draw(view) {
  const on = (id) => view.overlays.has(id);
  if (on("truth") || on("difference")) {
    drawTruth(view, on("difference"));
  }
  if (on("leaves")) {
    drawLeaves(view);
  }
  if (on("rings")) {
    drawRings(view);
  }
  if (on("mounts")) {
    drawViews(view);
  }
  if (!on("difference")) {
    view.drawMarks();
  }
  if (on("points") && view.grid.points) {
    drawPoints(view);
  }
  if (on("ages") && view.grid.number >= 0) {
    drawAges(view);
  }
  if (on("rings")) {
    drawDistances(view);
  }
  drawCar(view, on("mounts"));
  drawScaleBar(view);
}

// Against the truth a cell is: hit, and occupied; hit, and nothing is there; free, and yet occupied.
export function judgement(index, isTrue) {
  if (index > 0) {
    return isTrue ? "agreed" : "invented";
  }
  return index < 0 && isTrue ? "missed" : "";
}

let layer = null; // of the truth, as an image
let layerOf = "";

function drawTruth(view, isDifference) {
  if (!view.grid.hasTruth) {
    return;
  }
  const name = `${view.grid.version} ${isDifference} ${view.theme}`;
  if (layerOf !== name) {
    layerOf = name;
    paintTruth(view, isDifference);
  }
  view.drawImage(layer);
  if (isDifference) {
    drawJudged(view);
  }
}

function paintTruth(view, isDifference) {
  layer ??= Object.assign(document.createElement("canvas"), { width: SIDE, height: SIDE });
  const context = layer.getContext("2d", { willReadFrequently: true });
  const pixels = context.createImageData(SIDE, SIDE);
  const words = new Uint32Array(pixels.data.buffer);
  const { truth } = view.grid;
  const [red, green, blue] = view.palette.missed;
  const colour = (((isDifference ? 0x55 : 0xb0) << 24) | (blue << 16) | (green << 8) | red) >>> 0;
  for (let cell = 0; cell < truth.length; ++cell) {
    if (truth[cell] !== 0) {
      words[(SIDE - 1 - (cell & (SIDE - 1))) * SIDE + SIDE - 1 - (cell >> 10)] = colour;
    }
  }
  context.putImageData(pixels, 0, 0);
}

function drawJudged(view) {
  const { context, grid, palette } = view;
  const size = Math.max(2.4, view.pixelsPerMetre * view.cellM);
  for (let cell = 0; cell < grid.cells.length; ++cell) {
    const index = grid.cells[cell];
    if (index === 0 || (index < 0 && grid.truth[cell] === 0)) {
      continue;
    }
    const [column, row] = placeOfCell(view, cell);
    context.fillStyle = css(palette[judgement(index, grid.truth[cell] !== 0)]);
    context.fillRect(column - size / 2, row - size / 2, size, size);
  }
}

function placeOfCell(view, cell) {
  return view.toScreen(((cell & (SIDE - 1)) - SIDE / 2 + 0.5) * view.cellM,
                       ((cell >> 10) - SIDE / 2 + 0.5) * view.cellM);
}

// Blocks of one value, as a quadtree over a tile would have them.
function leavesOf(cells, x, y, side, found) {
  const value = cells[y * SIDE + x];
  for (let row = y; row < y + side; ++row) {
    for (let cell = row * SIDE + x; cell < row * SIDE + x + side; ++cell) {
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
let leavesVersion = -1;

export function quadtreeLeaves(grid) {
  if (leavesVersion !== grid.version) {
    leavesVersion = grid.version;
    leaves = [];
    for (let y = 0; y < SIDE; y += TILE_SIDE) {
      for (let x = 0; x < SIDE; x += TILE_SIDE) {
        leavesOf(grid.cells, x, y, TILE_SIDE, leaves);
      }
    }
  }
  return leaves;
}

function drawLeaves(view) {
  const { context } = view;
  const pixelsPerCell = view.pixelsPerMetre * view.cellM;
  const found = quadtreeLeaves(view.grid);
  context.beginPath();
  for (let i = 0; i < found.length; i += 3) {
    const side = found[i + 2] * pixelsPerCell;
    if (side < 4) {
      continue;
    }
    const [right, bottom] = view.toScreen((found[i] - SIDE / 2) * view.cellM,
                                          (found[i + 1] - SIDE / 2) * view.cellM);
    const isSeen = right > 0 && bottom > 0 && right - side < view.width &&
                   bottom - side < view.height;
    if (isSeen) {
      context.rect(right - side, bottom - side, side, side);
    }
  }
  context.strokeStyle = view.palette.leaf;
  context.lineWidth = 1;
  context.stroke();
}

const ringStep = (view) => (view.pixelsPerMetre > 60 ? 1 : view.pixelsPerMetre > 24 ? 5 : 10);

function drawRings(view) {
  const { context, palette } = view;
  const step = ringStep(view);
  const [column, row] = view.toScreen(0, 0);
  context.strokeStyle = palette.ring;
  context.lineWidth = 1;
  for (let radius = step; radius <= 50; radius += step) {
    context.beginPath();
    context.arc(column, row, radius * view.pixelsPerMetre, 0, 2 * Math.PI);
    context.stroke();
  }
}

// Above everything that may be there.
function drawDistances(view) {
  const { context, palette } = view;
  const step = ringStep(view);
  const [column, row] = view.toScreen(0, 0);
  context.font = FONT;
  context.textAlign = "center";
  context.textBaseline = "middle";
  for (let radius = step; radius <= 50; radius += step) {
    const at = row - radius * view.pixelsPerMetre;
    const words = `${radius} m`;
    const width = context.measureText(words).width + 8;
    context.fillStyle = palette.shade;
    context.beginPath();
    context.roundRect(column - width / 2, at - 8, width, 16, 4);
    context.fill();
    context.fillStyle = palette.ringText;
    context.fillText(words, column, at + 0.5);
  }
}

function drawViews(view) {
  const { context, palette, vehicle } = view;
  for (const sensor of vehicle ? vehicle.sensors : []) {
    const [column, row] = view.toScreen(sensor.x, sensor.y);
    const middle = -Math.PI / 2 - sensor.yaw_deg * Math.PI / 180;
    const half = sensor.width_deg * Math.PI / 360;
    const reach = Math.min(sensor.range, 80) * view.pixelsPerMetre;
    context.beginPath();
    context.moveTo(column, row);
    context.arc(column, row, reach, middle - half, middle + half);
    context.closePath();
    context.setLineDash([2, 5]);
    context.strokeStyle = palette.viewEdge;
    context.lineWidth = 1;
    context.stroke();
    context.setLineDash([]);
  }
}

function drawCar(view, hasMounts) {
  const { context, palette, vehicle } = view;
  const body = vehicle && vehicle.footprint;
  if (body) {
    const [left, top] = view.toScreen(body.x_max, body.y_max);
    const [right, bottom] = view.toScreen(body.x_min, body.y_min);
    const width = right - left;
    const height = bottom - top;
    context.beginPath();
    context.roundRect(left, top, width, height, width * 0.22);
    context.fillStyle = palette.carBody;
    context.strokeStyle = palette.carLine;
    context.lineWidth = 1.5;
    context.fill();
    context.stroke();
    context.fillStyle = palette.carLine;
    context.globalAlpha = 0.75;
    context.beginPath(); // the windscreen, which is in front
    context.roundRect(left + width * 0.14, top + height * 0.26, width * 0.72, height * 0.13,
                      width * 0.08);
    context.roundRect(left + width * 0.18, top + height * 0.8, width * 0.64, height * 0.08,
                      width * 0.06);
    context.fill();
    context.globalAlpha = 1;
  }
  for (const sensor of hasMounts && vehicle ? vehicle.sensors : []) {
    const [column, row] = view.toScreen(sensor.x, sensor.y);
    context.beginPath();
    context.arc(column, row, Math.max(3, view.pixelsPerMetre * 0.12), 0, 2 * Math.PI);
    context.fillStyle = palette.sensor;
    context.strokeStyle = palette.carLine;
    context.lineWidth = 1;
    context.fill();
    context.stroke();
  }
}

function drawPoints(view) {
  const { context, theme } = view;
  const size = Math.max(2.5, Math.min(6, view.pixelsPerMetre * 0.08));
  let last = -1;
  forEachPoint(view.grid.points, (x, y, fate) => {
    if (fate !== last && FATES[fate]) {
      context.fillStyle = FATES[fate].colour[theme];
      last = fate;
    }
    const [column, row] = view.toScreen(x, y);
    context.fillRect(column - size / 2, row - size / 2, size, size);
  });
}

// Tiles that are not of the newest frame are hatched, the denser the older; tiles that never came
// carry a cross.
function drawAges(view) {
  const { context, grid, palette } = view;
  const side = TILE_SIDE * view.cellM;
  context.strokeStyle = palette.stale;
  context.lineWidth = 1;
  for (let tile = 0; tile < grid.ages.length; ++tile) {
    const age = grid.ages[tile];
    if (age === 0) {
      continue;
    }
    const x = ((tile % TILES_PER_SIDE) - TILES_PER_SIDE / 2) * side;
    const y = (Math.floor(tile / TILES_PER_SIDE) - TILES_PER_SIDE / 2) * side;
    const [left, top] = view.toScreen(x + side, y + side);
    const length = side * view.pixelsPerMetre;
    context.beginPath();
    if (age === 255) {
      cross(context, left, top, length);
    } else {
      hatch(context, left, top, length, age < 5 ? 3 : 5);
    }
    context.stroke();
  }
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
