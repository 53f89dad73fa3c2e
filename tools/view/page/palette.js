// Colours of the grid and of all that is drawn on it. Free is blue-grey and occupied orange to red
// (dark theme: on near black; light theme: on grey), told apart with every kind of colour vision,
// and in grey by their lightness.

const THEMES = {
  dark: {
    unknown: [27, 31, 37],
    freeWeak: [62, 84, 106],
    freeStrong: [188, 212, 228],
    occupiedWeak: [255, 140, 30],
    occupiedStrong: [214, 26, 8],
    freeStale: [112, 114, 116],
    occupiedStale: [255, 255, 255],
    outside: "#14171b",
    gridEdge: "#39424c",
    ring: "rgba(128, 150, 172, 0.38)",
    ringText: "#9fb0c0",
    mark: "#ff9a3c",
    track: "#ffffff",
    trackEdge: "rgba(16, 24, 34, 0.75)",
    doubt: "rgba(255, 214, 64, 0.28)",
    doubtEdge: "#ffd640",
    mapRoad: "rgba(120, 190, 255, 0.75)",
    mapHouse: "rgba(255, 176, 96, 0.85)",
    carBody: "#f6f7f8",
    carLine: "#20262d",
    sensor: "#12b5a0",
    unwatched: "#c9a6ff",
    view: "rgba(18, 181, 160, 0.10)",
    viewEdge: "rgba(18, 181, 160, 0.75)",
    truth: "#ffe14d",
    missed: [255, 225, 77],
    invented: [232, 83, 196],
    agreed: [255, 255, 255],
    leaf: "rgba(140, 160, 180, 0.32)",
    stale: "rgba(238, 214, 120, 0.55)",
    ink: "#e8ecef",
    shade: "rgba(20, 23, 27, 0.86)",
  },
  light: {
    unknown: [187, 191, 196],
    freeWeak: [206, 217, 226],
    freeStrong: [250, 252, 254],
    occupiedWeak: [226, 105, 0],
    occupiedStrong: [150, 8, 0],
    freeStale: [240, 240, 240],
    occupiedStale: [20, 20, 20],
    outside: "#d8dbde",
    gridEdge: "#8d959d",
    ring: "rgba(60, 80, 100, 0.34)",
    ringText: "#46535f",
    mark: "#c44e00",
    carBody: "#22303c",
    carLine: "#f4f6f7",
    sensor: "#00796b",
    unwatched: "#6a1bb3",
    view: "rgba(0, 121, 107, 0.10)",
    viewEdge: "rgba(0, 121, 107, 0.8)",
    truth: "#5b3cc4",
    missed: [91, 60, 196],
    invented: [214, 0, 140],
    agreed: [30, 30, 30],
    leaf: "rgba(50, 70, 90, 0.30)",
    stale: "rgba(112, 84, 0, 0.55)",
    ink: "#15191d",
    shade: "rgba(240, 242, 244, 0.88)",
  },
};

// Of the fates of scan points, in the order of docs/spec.md 1.3.
export const FATES = [
  { name: "used", colour: { dark: "#4fd1ff", light: "#0072b2" } },
  { name: "no return", colour: { dark: "#59636e", light: "#9aa3ab" } },
  { name: "too near", colour: { dark: "#f0e442", light: "#a89700" } },
  { name: "too far", colour: { dark: "#9d8cff", light: "#6a51c8" } },
  { name: "outside band", colour: { dark: "#8ea3b5", light: "#6c7f90" } },
  { name: "flagged", colour: { dark: "#cc79a7", light: "#b04a86" } },
  { name: "later echo", colour: { dark: "#35d6a4", light: "#009e73" } },
  { name: "malformed", colour: { dark: "#ff5a36", light: "#d55e00" } },
  { name: "stale", colour: { dark: "#b98a5a", light: "#8a5a2b" } },
  { name: "not taken", colour: { dark: "#ff8fb0", light: "#b3003c" } },
  { name: "ground", colour: { dark: "#a8753f", light: "#7a4f1d" } },
  { name: "overhang", colour: { dark: "#c5d86d", light: "#6b7d12" } },
  { name: "under the ground", colour: { dark: "#7f5fa8", light: "#5b3a86" } },
];

// Of classes by their number, at their surest; the surer, the stronger. Names and colours are those
// of tools/formats/picture/class_picture.cpp. What is unknown is dark in either theme.
const CLASSES = [
  { name: "unknown", colour: [30, 33, 38],
    meaning: "No sensor has measured this place lately, or not clearly enough." },
  { name: "drivable", colour: [150, 214, 170], meaning: "Nothing is here, and the map shows a road." },
  { name: "free, not drivable", colour: [120, 150, 130], meaning: "Nothing is here, but the map shows no road." },
  { name: "free", colour: [172, 200, 222], meaning: "Nothing is here: beams have passed through." },
  { name: "moving", colour: [255, 40, 160], meaning: "Something is here that has moved to this place." },
  { name: "stopped", colour: [250, 190, 40], meaning: "Something stands on the road and may drive off." },
  { name: "standing", colour: [214, 120, 40],
    meaning: "Something has stayed here, such as a wall or a parked car." },
  { name: "infrastructure", colour: [140, 80, 40],
    meaning: "Something has stayed here, where the map shows a building." },
  { name: "occupied, unclassified", colour: [240, 230, 120],
    meaning: "Something is here. It is not yet known whether it moves." },
];
const WEAKEST = 0.55;
const SUREST = 7;
export const CLASS_COUNT = CLASSES.length;
export const MOVING = 4;

// A class byte is class * 8 + sureness (docs/spec.md, 3.9).
export const classOf = (byte) => byte >> 3;
export const surenessOf = (byte) => byte & 7;
export const isFree = (byte) => byte > 0 && classOf(byte) < MOVING;
export const isSomething = (byte) => classOf(byte) >= MOVING;
export const nameOfClass = (number) => CLASSES[number].name;
export const meaningOfClass = (number) => CLASSES[number].meaning;

// Of objects by their state (docs/spec.md 3.12), each in the colour of a class.
export const [YOUNG, STANDS, MOVES, STOPPED] = [1, 2, 3, 4];
const OBJECTS = {
  [YOUNG]: { name: "something", colour: CLASSES[8].colour },
  [STANDS]: { name: "stands", colour: CLASSES[6].colour },
  [MOVES]: { name: "moves", colour: CLASSES[MOVING].colour },
  [STOPPED]: { name: "stopped", colour: CLASSES[5].colour },
};
export const nameOfObject = ({ state }) => OBJECTS[state].name;
export const colourOfObject = ({ state }) => OBJECTS[state].colour;

// Of the target's stages and of everything else that charts draw.
export const SERIES = {
  fuse: { dark: "#56b4e9", light: "#0072b2" },
  mark: { dark: "#f0a030", light: "#c46a00" },
  perceive: { dark: "#d884c8", light: "#a8457f" },
  publish: { dark: "#35d6a4", light: "#009e73" },
  bytes: { dark: "#8fb8d8", light: "#386f98" },
  placed: { dark: "#2fb59b", light: "#00866f" },
  loss: { dark: "#ff5a36", light: "#c8321a" },
  state: {
    dark: ["#3a424b", "#ff5a36", "#f0c040", "#2fb59b"],
    light: ["#aab1b8", "#c8321a", "#c99700", "#00866f"],
  },
};

export const paletteOf = (theme) => THEMES[theme];

const mixed = (a, b, t) => a.map((value, i) => Math.round(value + (b[i] - value) * t));

// p_n of the recursive set.
export const probabilityOf = (index, epsilon) =>
  1 / (1 + ((0.5 - epsilon) / (0.5 + epsilon)) ** index);

// A beam is worth -14 and a hit +2: in scale "index" colour grows with their number; in scale
// "probability" it is that of p.
export function colourOfIndex(theme, scale, epsilon, index) {
  const palette = THEMES[theme];
  if (index === 0) {
    return palette.unknown;
  }
  let strength = index < 0 ? Math.sqrt(Math.min(1, -index / 56)) : Math.min(1, index / 10);
  if (scale === "probability") {
    strength = Math.abs(probabilityOf(index, epsilon) - 0.5) * 2;
  }
  return index < 0 ? mixed(palette.freeWeak, palette.freeStrong, strength)
                   : mixed(palette.occupiedWeak, palette.occupiedStrong, strength);
}

// Of a picture that is not of now: three greys, in which a hit is still told from free ground.
function staleColour(theme, index) {
  const { unknown, freeStale, occupiedStale } = THEMES[theme];
  return index === 0 ? unknown : index < 0 ? freeStale : occupiedStale;
}

// A pixel as ImageData holds it.
const pixelOf = ([red, green, blue]) => (0xff000000 | (blue << 16) | (green << 8) | red) >>> 0;

// 256 pixels as ImageData holds them, by index as an unsigned byte.
export function pixelTable(theme, scale, epsilon, isStale) {
  const table = new Uint32Array(256);
  for (let byte = 0; byte < 256; ++byte) {
    const index = (byte << 24) >> 24;
    table[byte] = pixelOf(isStale ? staleColour(theme, index)
                                  : colourOfIndex(theme, scale, epsilon, index));
  }
  return table;
}

export function colourOfClass(byte) {
  const known = CLASSES[classOf(byte)] ?? CLASSES[0];
  const strength = WEAKEST + (1 - WEAKEST) * surenessOf(byte) / SUREST;
  return byte < 8 ? CLASSES[0].colour : mixed(CLASSES[0].colour, known.colour, strength);
}

// As pixelTable(), by class byte.
export function classTable(isStale) {
  const { freeStale, occupiedStale } = THEMES.dark;
  const table = new Uint32Array(256);
  for (let byte = 0; byte < 256; ++byte) {
    const isKnown = byte >= 8 && classOf(byte) < CLASS_COUNT;
    const stale = !isKnown ? CLASSES[0].colour : isFree(byte) ? freeStale : occupiedStale;
    table[byte] = pixelOf(isStale ? stale : colourOfClass(byte));
  }
  return table;
}

export const css = ([red, green, blue], alpha = 1) => `rgba(${red}, ${green}, ${blue}, ${alpha})`;
