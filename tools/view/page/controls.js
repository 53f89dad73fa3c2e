// Keys and buttons: what each does is a method of the actions that are handed in.

import { OVERLAYS } from "./overlays.js";

// [keys, action, words]
const KEYS = [
  [[" "], "pause", "pause, go on"],
  [["ArrowLeft", ","], "back", "one frame back"],
  [["ArrowRight", "."], "step", "one frame forward"],
  [["Home"], "oldest", "the oldest frame of the last minute"],
  [["End", "l"], "live", "back to the newest frame"],
  [["["], "rewind", "of a recording: 10 s back"],
  [["]"], "forward", "of a recording: 10 s forward"],
  [["r"], "record", "record the stream, stop recording"],
  [["+", "="], "nearer", "nearer"],
  [["-"], "farther", "farther"],
  [["f"], "follow", "follow the car"],
  [["0"], "showAll", "the whole grid"],
  [["v"], "layer", "classes, or the index grid of each single frame"],
  [["i"], "scale", "occupancy index or probability"],
  [["m"], "measure", "measure a distance: a click on each of two places"],
  [["Escape"], "quit", "end measuring, hide the words of a tap"],
  [["d"], "theme", "dark or light"],
  [["c"], "charts", "charts on or off"],
  [["?", "h"], "help", "these keys"],
];

const NAMES = { " ": "space", ArrowLeft: "←", ArrowRight: "→", Home: "Home", End: "End", Escape: "Esc" };
const REPEATED = ["back", "step", "nearer", "farther"]; // while the key is held down

export function listenToKeys(actions) {
  const byKey = new Map(KEYS.flatMap(([keys, action]) => keys.map((key) => [key, action])));
  const overlays = new Map(OVERLAYS.map(({ id, key }) => [key, id]));
  window.addEventListener("keydown", (event) => {
    const key = event.key.length === 1 ? event.key.toLowerCase() : event.key;
    const action = overlays.has(key) ? "overlay" : byKey.get(key);
    if (!action || isOfBrowser(event, action)) {
      return;
    }
    event.preventDefault();
    if (!event.repeat || REPEATED.includes(action)) {
      actions[action](overlays.get(key));
    }
  });
}

// The browser's own shortcuts, the button that has the focus, and what belongs to an open dialog.
function isOfBrowser(event, action) {
  const isPress = event.key === " " && event.target instanceof HTMLButtonElement;
  const isBehind = document.querySelector("dialog[open]") !== null && action !== "help";
  return event.ctrlKey || event.metaKey || event.altKey || isPress || isBehind;
}

// A button that was clicked gives up the focus, so that space pauses again; one that was chosen by
// Tab keeps it.
export function onPress(button, action) {
  button.addEventListener("click", (event) => {
    action();
    if (event.detail > 0) {
      button.blur();
    }
  });
}

export function listKeys(list) {
  const rows = [
    ...KEYS.map(([keys, , words]) => [keys.map((key) => NAMES[key] ?? key.toUpperCase()), words]),
    ...OVERLAYS.map(({ key, name, nameOfClasses }) =>
      [[key.toUpperCase()], `overlay: ${name}${nameOfClasses ? `; of classes ${nameOfClasses}` : ""}`]),
    [["drag", "wheel"], "move, and nearer or farther"],
    [["one finger", "two"], "the same by touch"],
    [["hover", "tap"], "what a cell is, and what is there"],
    [["double click"], "the car and its street again"],
  ];
  for (const [keys, words] of rows) {
    const term = document.createElement("dt");
    for (const key of keys) {
      term.append(Object.assign(document.createElement("kbd"), { textContent: key }));
    }
    list.append(term, Object.assign(document.createElement("dd"), { textContent: words }));
  }
}

export function addOverlaySwitches(parent, actions) {
  const buttons = new Map();
  for (const { id, key, name } of OVERLAYS) {
    const button = document.createElement("button");
    button.className = "switch";
    button.dataset.overlay = id;
    const words = Object.assign(document.createElement("span"), { textContent: name });
    const kbd = Object.assign(document.createElement("kbd"), { textContent: key.toUpperCase() });
    button.append(document.createElement("i"), words, kbd);
    onPress(button, () => actions.overlay(id));
    parent.append(button);
    buttons.set(id, button);
  }
  return buttons;
}
