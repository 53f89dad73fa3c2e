// What is drawn of the car itself: its body and sensors, where it was, and how well that is known.

import { TRACK_S } from "./place.js";

export function drawViews(view) {
  const { context, palette, vehicle } = view;
  for (const sensor of vehicle ? vehicle.sensors : []) {
    const [column, row] = view.toScreen(sensor.x, sensor.y);
    const middle = -Math.PI / 2 - sensor.yaw_deg * Math.PI / 180 - view.turn;
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

// Adds the car's outline, grown by so many metres, to the path: forward is up.
function addOutline(context, body, scale, grown = 0) {
  const width = (body.y_max - body.y_min + 2 * grown) * scale;
  context.roundRect((-body.y_max - grown) * scale, (-body.x_max - grown) * scale, width,
                    (body.x_max - body.x_min + 2 * grown) * scale,
                    (body.y_max - body.y_min) * scale * 0.22 + grown * scale);
}

export function drawCar(view, hasMounts) {
  const { vehicle } = view;
  if (vehicle && vehicle.footprint) {
    view.inVehicle((scale) => drawBody(view, vehicle.footprint, scale));
  }
  if (hasMounts && vehicle) {
    drawSensors(view, vehicle.sensors);
  }
}

// Where a car without a place was last is only its outline.
function drawBody({ context, palette, hasPlace }, body, scale) {
  const width = (body.y_max - body.y_min) * scale;
  const height = (body.x_max - body.x_min) * scale;
  const [left, top] = [-body.y_max * scale, -body.x_max * scale];
  context.beginPath();
  addOutline(context, body, scale);
  if (!hasPlace) {
    context.setLineDash([4, 4]);
    context.lineWidth = 2;
    context.strokeStyle = palette.carBody;
    context.stroke();
    return;
  }
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
}

function drawSensors(view, sensors) {
  const { context, palette } = view;
  for (const sensor of sensors) {
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

const SECTORS = 64;

// A hatched ring where no sensor watches now, and a whole one around it where a sensor is blocked
// (docs/spec.md, 3.5): a bit a sector, counter-clockwise from straight ahead.
export function drawUnwatched(view) {
  const end = view.grid.frame?.status.frame?.end;
  if (!view.showsClasses || view.hasPlace) {
    drawSectors(view, end?.unwatched, 0, [2, 4]);
    drawSectors(view, end?.blocked, 9, []);
  }
}

function drawSectors(view, bits, further, dashes) {
  const { context, palette } = view;
  const sectors = BigInt(`0x${bits || "0"}`);
  view.inVehicle((scale) => {
    context.strokeStyle = palette.unwatched;
    context.lineWidth = further === 0 ? 10 : 4;
    context.lineCap = "butt";
    context.setLineDash(dashes);
    for (let i = 0; i < SECTORS; i += 1) {
      if ((sectors >> BigInt(i)) & 1n) {
        const [end, begin] = [i, i + 1].map((at) => -Math.PI / 2 - (2 * Math.PI * at) / SECTORS);
        context.beginPath();
        context.arc(0, 0, Math.max(40, 4 * scale) + further, begin, end);
        context.stroke();
      }
    }
    context.setLineDash([]);
  });
}

// The car may be anywhere in its outline grown by the deviation of its pose: worth a look only where
// that is more than a cell.
export function drawDeviation(view) {
  const { context, palette, vehicle } = view;
  const sigma = view.grid.classes.sigma_m;
  if (!vehicle || !vehicle.footprint || !view.hasPlace || sigma <= view.cellM) {
    return;
  }
  view.inVehicle((scale) => {
    context.beginPath();
    addOutline(context, vehicle.footprint, scale, sigma);
    context.fillStyle = palette.doubt;
    context.fill();
    context.setLineDash([3, 3]);
    context.strokeStyle = palette.doubtEdge;
    context.lineWidth = 1.5;
    context.stroke();
  });
}

const TRACK_STEPS = 15;

// The older, the fainter: stretches of two seconds, the oldest first.
export function drawTrack(view) {
  const { context, palette, track } = view;
  context.lineCap = "round";
  context.lineJoin = "round";
  for (let step = TRACK_STEPS - 1; step >= 0; --step) {
    context.beginPath();
    addStretch(view, track, step * TRACK_S / TRACK_STEPS, (step + 1) * TRACK_S / TRACK_STEPS);
    context.globalAlpha = 1 - step / TRACK_STEPS;
    context.strokeStyle = palette.trackEdge;
    context.lineWidth = 5;
    context.stroke();
    context.strokeStyle = palette.track;
    context.lineWidth = 2.2;
    context.stroke();
  }
  context.globalAlpha = 1;
}

function addStretch(view, track, fromS, toS) {
  const { context } = view;
  for (let i = 1; i < track.length; ++i) {
    const [before, place] = [track[i - 1], track[i]];
    if (before !== null && place !== null && place.agoS >= fromS && place.agoS < toS) {
      context.moveTo(...view.groundToScreen(before.x, before.y));
      context.lineTo(...view.groundToScreen(place.x, place.y));
    }
  }
}
