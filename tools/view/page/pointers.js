// Mouse and touch: one pointer moves the grid; the distance between several scales it, as the wheel does.

const WHEEL = 0.0015;
const TRACKPAD_PINCH = 0.01; // browsers report it as a wheel with Ctrl, in smaller steps
const LONGEST_STEP = 0.4;    // so that a wheel with Ctrl does not leap
const CLICK = 6;             // pixels; a pointer that moves less far moves nothing
const NEAREST_FINGERS = 8;   // pixels; nearer than that, what they tremble would be a scale

// The middle of all places, and how far they are from it.
function gripOf(places) {
  const mean = (values) => values.reduce((a, b) => a + b, 0) / values.length;
  const column = mean(places.map((at) => at[0]));
  const row = mean(places.map((at) => at[1]));
  return { column, row, spread: mean(places.map((at) => Math.hypot(at[0] - column, at[1] - row))) };
}

const isFinger = ({ pointerType }) => pointerType === "touch";

export function listenToPointers(canvas, view, { changed, hovered, clicked }) {
  const held = new Map(); // where the pressed mouse and the fingers are
  let pressed = null; // where a pointer went down, as long as that may be a click
  const place = (event) => {
    const box = canvas.getBoundingClientRect();
    return [event.clientX - box.left, event.clientY - box.top];
  };

  // What was in the middle of the pointers stays there.
  const drag = (pointer, at) => {
    const before = gripOf([...held.values()]);
    held.set(pointer, at);
    const now = gripOf([...held.values()]);
    view.pan(now.column - before.column, now.row - before.row);
    if (Math.min(before.spread, now.spread) >= NEAREST_FINGERS) {
      view.zoom(now.spread / before.spread, now.column, now.row);
    }
    changed();
  };

  canvas.addEventListener("pointerdown", (event) => {
    if (event.button === 0) {
      held.set(event.pointerId, place(event));
      canvas.setPointerCapture(event.pointerId);
      pressed = held.size === 1 ? place(event) : null;
      hovered(pressed, isFinger(event));
    }
  });
  canvas.addEventListener("pointermove", (event) => {
    const at = place(event);
    if (!held.has(event.pointerId)) {
      hovered(at);
    } else if (pressed === null || Math.hypot(at[0] - pressed[0], at[1] - pressed[1]) >= CLICK) {
      pressed = null;
      drag(event.pointerId, at);
      hovered(null);
    }
  });
  canvas.addEventListener("pointerup", () => pressed && clicked(pressed));
  for (const end of ["pointerup", "pointercancel", "lostpointercapture"]) {
    canvas.addEventListener(end, (event) => {
      held.delete(event.pointerId);
      pressed = null;
    });
  }
  // A finger that goes up leaves its words, and one that stays opens no menu.
  canvas.addEventListener("pointerleave", (event) => isFinger(event) || hovered(null));
  canvas.addEventListener("contextmenu", (event) => isFinger(event) && event.preventDefault());
  canvas.addEventListener("wheel", (event) => {
    event.preventDefault();
    const step = -event.deltaY * (event.ctrlKey ? TRACKPAD_PINCH : WHEEL);
    view.zoom(Math.exp(Math.max(-LONGEST_STEP, Math.min(LONGEST_STEP, step))), ...place(event));
    hovered(place(event));
    changed();
  }, { passive: false });
  canvas.addEventListener("dblclick", () => {
    if (!view.measured.isOn) {
      view.showStreet();
      changed();
    }
  });
}
