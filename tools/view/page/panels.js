// What lies on the grid or beside it can be folded away. A small screen begins with the grid.

import { onPress } from "./controls.js";

const PANELS = ["overlays", "legend", "charts"];
const SMALL = "(max-width: 820px), (max-height: 560px)";
const PHONE = "(max-width: 700px), (max-height: 420px)";

export function toggle(panel) {
  const isFolded = document.getElementById(panel).classList.toggle("folded");
  document.getElementById(`${panel}-fold`).ariaExpanded = String(!isFolded);
}

export function listenToFolds() {
  for (const panel of PANELS) {
    const button = document.getElementById(`${panel}-fold`);
    button.ariaExpanded = "true";
    onPress(button, () => toggle(panel));
  }
}

export function foldSome() {
  if (matchMedia(SMALL).matches) {
    toggle("overlays");
  }
  if (matchMedia(PHONE).matches) {
    toggle("charts");
  }
}
