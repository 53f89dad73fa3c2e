// What the colours mean: the scale of the cells, and what only some overlays need.

import { forEachPoint } from "./messages.js";
import { linesOfObjects } from "./objects.js";
import { hasTruth, quadtreeLeaves } from "./overlays.js";
import { FATES, MOVING, classOf, colourOfClass, colourOfIndex, css, meaningOfClass, nameOfClass,
         probabilityOf } from "./palette.js";
import { isOfTarget } from "./status.js";

const [LOW, HIGH] = [-56, 14]; // colours do not change beyond
const NEVER = 255;

const TITLES = { index: "Occupancy index", probability: "Probability of occupancy" };

// Where one may drive first, then what is there.
const ORDER = [1, 2, 3, MOVING, 5, 6, 7, 8, 0];
const ALWAYS = [3, MOVING, 0];

// Words of which those from some place on are left out where there is little room.
function withDetail(words, begin) {
  const [short, rest] = words.split(begin, 2);
  const whole = Object.assign(document.createElement("span"), { textContent: short });
  whole.append(Object.assign(document.createElement("span"),
                             { className: "detail", textContent: rest ? begin + rest : "" }));
  return whole;
}

// A class from unsure to sure. What it means is said while it has the mouse, the finger or the focus.
function keyOfClass(number, meaning) {
  const key = Object.assign(document.createElement("button"), { className: "key" });
  const swatch = document.createElement("i");
  const [weak, strong] = [0, 7].map((sureness) => css(colourOfClass(number * 8 + sureness)));
  swatch.style.background = `linear-gradient(90deg, ${weak}, ${strong})`;
  key.append(swatch, withDetail(nameOfClass(number), ", un"));
  const say = (words) => () => (meaning.textContent = words);
  for (const [begin, end] of [["mouseenter", "mouseleave"], ["focus", "blur"]]) {
    key.addEventListener(begin, say(meaningOfClass(number)));
    key.addEventListener(end, say(""));
  }
  return key;
}

// Of the classes those that the stream has named so far.
function showClasses({ images }, { title, classes, meaning }) {
  if (classes.childElementCount === 0) {
    classes.append(...ORDER.map((number) => keyOfClass(number, meaning)));
  }
  if (title.childElementCount === 0) {
    title.replaceChildren(withDetail("What is there – brighter is surer", " –"));
  }
  const seen = new Set(ALWAYS);
  images.classes.seen.forEach((isSeen, byte) => isSeen && seen.add(classOf(byte)));
  [...classes.children].forEach((key, i) => (key.hidden = !seen.has(ORDER[i])));
}

// What the map is and whose it is, or why there is none. Whose it is stays, however small the page.
function wordsOfMap({ in_use: isInUse, attribution, cause, delivery, tiles_waiting: waiting,
                      refused, crc }, outlines) {
  const way = delivery === "" ? "" : `Another is on its way: ${delivery}.`;
  if (!isInUse) {
    const words = delivery === "" ? "No map: no road or house classes." : `No map yet: ${delivery}.`;
    return [words, refused > 0 ? "A map that came was refused." : ""];
  }
  const state = cause === "" ? (waiting > 0 ? `${waiting} tiles wait for it.` : "")
                             : `Not used: ${cause}.`;
  const other = outlines !== null && outlines.crc !== crc
      ? `No outlines: the target uses map ${crc}, this PC has ${outlines.crc}.` : "";
  return [`Map: ${attribution}`, [state, way].join(" ").trim(), other];
}

// view.map: what the target has said last.
function showMap({ map, outlines }, element) {
  const words = map ? wordsOfMap(map, outlines).filter((line) => line !== "") : [];
  if (element.dataset.words !== words.join("\n")) {
    element.dataset.words = words.join("\n");
    const first = map && map.in_use ? "attribution" : "";
    element.replaceChildren(...words.map(
        (textContent, i) => Object.assign(document.createElement("span"),
                                          { textContent, className: i > 0 ? "quiet" : first })));
  }
}

function showScale(view, { title, bar, ticks }) {
  const { theme, shownScale: scale, epsilon } = view;
  const context = bar.getContext("2d");
  for (let column = 0; column < bar.width; ++column) {
    // Half of the bar for each sign.
    const t = column / (bar.width - 1) * 2 - 1;
    const index = Math.abs(t) < 0.06 ? 0 : Math.round(t < 0 ? -t * LOW : t * HIGH) || Math.sign(t);
    context.fillStyle = css(colourOfIndex(theme, scale, epsilon, index));
    context.fillRect(column, 0, 1, bar.height);
  }
  title.textContent = scale === view.scale ? TITLES[scale] : `${TITLES[scale]}: ε is not known here`;
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
  const present = new Set();
  forEachPoint(points, (x, y, fate) => present.add(fate));
  return FATES.filter((_, fate) => present.has(fate))
      .map(({ name, colour }) => [colour[view.pictureTheme], name]);
}

function linesOfTruth(view) {
  const { overlays, palette, showsClasses } = view;
  if (!hasTruth(view)) {
    return [[null, "truth: only a simulated drive has it"]];
  }
  if (showsClasses) {
    return overlays.has("difference")
        ? [[css(palette.agreed), "called moving, and moves"],
           [css(palette.invented), "called moving, does not move"],
           [css(palette.missed), "moves, not called so"]]
        : [[css(palette.missed), "moves in truth"]];
  }
  if (!overlays.has("difference")) {
    return [[css(palette.missed), "occupied in truth"]];
  }
  return [[css(palette.agreed), "hit, and occupied in truth"],
          [css(palette.invented), "hit, free in truth"],
          [css(palette.missed), "free here, occupied in truth"],
          [css(palette.missed, 0.4), "occupied in truth, not seen"]];
}

function linesOfAges({ ages, grid, palette }) {
  const isOld = ages.some((age) => age !== 0 && age !== NEVER);
  const isNew = grid.number < 0 || !ages.includes(NEVER);
  return [...(isOld ? [[palette.stale, "hatched: not of the newest frame"]] : []),
          ...(isNew ? [] : [[palette.stale, "crossed: never received"]])];
}

// Of the ring around the car (vehicle_overlays.js).
function linesOfSectors({ grid, palette }) {
  const { unwatched, blocked } = grid.frame?.status.frame?.end ?? {};
  const isSet = (bits) => /[1-9a-f]/.test(bits ?? "");
  return [...(isSet(unwatched) ? [[palette.unwatched, "hatched ring: no sensor looks there"]] : []),
          ...(isSet(blocked) ? [[palette.unwatched, "solid ring: a sensor is blocked"]] : [])];
}

// [colour or null, words, more of them where there is room] for each overlay that is on. kind: of the source.
function linesOf(view, kind) {
  const { overlays } = view;
  const lines = [];
  if (view.showsClasses && overlays.has("objects") && view.grid.hasObjects) {
    lines.push(...linesOfObjects());
  }
  if (overlays.has("mounts")) {
    lines.push(...linesOfSectors(view));
  }
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
    lines.push([null, `${(quadtreeLeaves(view).length / 3).toLocaleString("en")} leaves`]);
  }
  return lines;
}

function elementsOf(lines) {
  return lines.map(([colour, name, detail = ""]) => {
    const line = Object.assign(document.createElement("span"), { className: "key" });
    if (colour) {
      const spot = document.createElement("i");
      spot.style.background = colour;
      line.append(spot);
    }
    const words = document.createElement("span");
    words.append(name, Object.assign(document.createElement("span"), { className: "detail", textContent: detail }));
    line.append(words);
    return line;
  });
}

export class Legend {
  constructor(byId) {
    this.boxes = Object.fromEntries(["title", "scale", "ticks", "meaning", "classes", "map", "more"].map(
        (name) => [name, byId(`legend-${name}`)]));
    this.box = byId("legend");
    this.words = "";
  }

  show(view) {
    const { title, scale, ticks, map } = this.boxes;
    this.box.classList.toggle("of-classes", view.showsClasses);
    if (view.showsClasses) {
      showClasses(view, this.boxes);
      showMap(view, map);
    } else {
      showScale(view, { title, bar: scale, ticks });
    }
  }

  // What only some overlays need.
  showMore(view, kind) {
    if (view.showsClasses) {
      this.show(view); // another class may have come
    }
    const lines = linesOf(view, kind);
    const words = view.pictureTheme + lines.join();
    if (words !== this.words) {
      this.words = words;
      this.boxes.more.replaceChildren(...elementsOf(lines));
    }
  }
}
