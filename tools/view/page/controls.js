// Keys, buttons, mouse and touch: what each does is a method of the actions that are handed in.

import { OVERLAYS } from "./overlays.js";

// [keys, action, words]
const KEYS = [
  [[" "], "pause", "pause, go on"],
  [["ArrowLeft", ","], "back", "one frame back"],
  [["ArrowRight", "."], "step", "one frame forward"],
  [["Home"], "oldest", "the oldest frame of the last minute"],
  [["End", "l"], "live", "back to the newest frame"],
  [["r"], "record", "record the stream, stop recording"],
  [["+", "="], "nearer", "nearer"],
  [["-"], "farther", "farther"],
  [["f"], "follow", "follow the car"],
  [["0"], "showAll", "the whole grid"],
  [["i"], "scale", "occupancy index or probability"],
  [["d"], "theme", "dark or light"],
  [["c"], "charts", "charts on or off"],
  [["?", "h"], "help", "these keys"],
];

const NAMES = { " ": "space", ArrowLeft: "←", ArrowRight: "→" };

export function listenToKeys(actions) {
  const byKey = new Map(KEYS.flatMap(([keys, action]) => keys.map((key) => [key, action])));
  const overlays = new Map(OVERLAYS.map(({ id, key }) => [key, id]));
  window.addEventListener("keydown", (event) => {
    if (event.ctrlKey || event.metaKey || event.altKey) {
      return;
    }
    const key = event.key.length === 1 ? event.key.toLowerCase() : event.key;
    if (byKey.has(key)) {
      actions[byKey.get(key)]();
    } else if (overlays.has(key)) {
      actions.overlay(overlays.get(key));
    } else {
      return;
    }
    event.preventDefault();
  });
}

export function listKeys(list) {
  const rows = [
    ...KEYS.map(([keys, , words]) => [keys.map((key) => NAMES[key] ?? key.toUpperCase()), words]),
    ...OVERLAYS.map(({ key, name }) => [[key.toUpperCase()], `overlay: ${name}`]),
    [["drag", "wheel"], "move, and nearer or farther"],
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
    button.addEventListener("click", () => {
      actions.overlay(id);
      button.blur();
    });
    parent.append(button);
    buttons.set(id, button);
  }
  return buttons;
}

// The mouse moves the grid, and tells where it is.
export function listenToPointer(canvas, view, { changed, hovered }) {
  let held = null;
  const place = (event) => {
    const box = canvas.getBoundingClientRect();
    return [event.clientX - box.left, event.clientY - box.top];
  };
  canvas.addEventListener("pointerdown", (event) => {
    held = place(event);
    canvas.setPointerCapture(event.pointerId);
  });
  canvas.addEventListener("pointermove", (event) => {
    const at = place(event);
    if (held) {
      view.pan(at[0] - held[0], at[1] - held[1]);
      held = at;
      changed();
    }
    hovered(at);
  });
  canvas.addEventListener("pointerup", () => {
    held = null;
  });
  canvas.addEventListener("pointerleave", () => hovered(null));
  canvas.addEventListener("wheel", (event) => {
    event.preventDefault();
    view.zoom(Math.exp(-event.deltaY * 0.0015), ...place(event));
    hovered(place(event));
    changed();
  }, { passive: false });
  canvas.addEventListener("dblclick", () => {
    view.showStreet();
    changed();
  });
}
