// What the colours mean: the scale of the cells, and what only some overlays need.

import { quadtreeLeaves } from "./overlays.js";
import { FATES, colourOfIndex, css, probabilityOf } from "./palette.js";
import { isOfTarget } from "./status.js";

const [LOW, HIGH] = [-56, 14]; // colours do not change beyond
const NO_RETURN = 1; // fates that have no place
const MALFORMED = 7;
const NEVER = 255;

const TITLES = { index: "Occupancy index", probability: "Probability of occupancy" };

export function showScale(view, { title, bar, ticks }) {
  const { theme, scale, epsilon } = view;
  const context = bar.getContext("2d");
  for (let column = 0; column < bar.width; ++column) {
    // Half of the bar for each sign.
    const t = column / (bar.width - 1) * 2 - 1;
    const index = Math.abs(t) < 0.06 ? 0 : Math.round(t < 0 ? -t * LOW : t * HIGH) || Math.sign(t);
    context.fillStyle = css(colourOfIndex(theme, scale, epsilon, index));
    context.fillRect(column, 0, 1, bar.height);
  }
  title.textContent = TITLES[scale];
  const p = (index) => probabilityOf(index, epsilon).toPrecision(2);
  const words = scale === "index" ? ["≤ −56", "−28", "0", "+7", "≥ +14"]
                                  : [`≤ ${p(LOW)}`, "", p(0), p(HIGH / 2), `≥ ${p(HIGH)}`];
  ticks.replaceChildren(...words.map(
      (text) => Object.assign(document.createElement("span"), { textContent: text })));
}

function linesOfPoints(view, kind) {
  const { points } = view.grid;
  if (isOfTarget(kind) || !points || points.byteLength === 0) {
    return [[null, "scan points: the stream has none; --pcap has"]];
  }
  return FATES.filter((_, fate) => fate !== NO_RETURN && fate !== MALFORMED)
      .map(({ name, colour }) => [colour[view.theme], name]);
}

function linesOfTruth({ grid, overlays, palette }) {
  if (!grid.hasTruth) {
    return [[null, "truth: only a simulated drive has it"]];
  }
  if (!overlays.has("difference")) {
    return [[css(palette.missed), "occupied in truth"]];
  }
  return [[css(palette.agreed), "hit, and occupied in truth"],
          [css(palette.invented), "hit, free in truth"],
          [css(palette.missed), "free here, occupied in truth"],
          [css(palette.missed, 0.4), "occupied in truth, not seen"]];
}

function linesOfAges({ grid, palette }) {
  const isOld = grid.ages.some((age) => age !== 0 && age !== NEVER);
  const isNew = grid.number < 0 || !grid.ages.includes(NEVER);
  return [...(isOld ? [[palette.stale, "hatched: not of the newest frame"]] : []),
          ...(isNew ? [] : [[palette.stale, "crossed: never received"]])];
}

// [colour or null, words] for each overlay that is on. kind: of the source.
export function linesOf(view, kind) {
  const { overlays } = view;
  const lines = [];
  if (overlays.has("ages")) {
    lines.push(...linesOfAges(view));
  }
  if (overlays.has("points")) {
    lines.push(...linesOfPoints(view, kind));
  }
  if (overlays.has("truth") || overlays.has("difference")) {
    lines.push(...linesOfTruth(view));
  }
  if (overlays.has("leaves")) {
    lines.push([null, `${(quadtreeLeaves(view.grid).length / 3).toLocaleString("en")} leaves`]);
  }
  return lines;
}

export function elementsOf(lines) {
  return lines.map(([colour, name]) => {
    const line = Object.assign(document.createElement("span"), { className: "key" });
    if (colour) {
      const spot = document.createElement("i");
      spot.style.background = colour;
      line.append(spot);
    }
    line.append(name);
    return line;
  });
}
