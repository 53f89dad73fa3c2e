// The bar of a recording: how far it has been played, and from where it is to go on.

const STEP_MS = 10000;

const clock = (ms) => {
  const s = Math.floor(ms / 1000);
  return `${Math.floor(s / 60)}:${String(s % 60).padStart(2, "0")}`;
};

export class Playback {
  // ask: sends words to the server.
  constructor(byId, ask) {
    this.bar = byId("playback");
    this.place = byId("place");
    this.words = byId("place-words");
    this.ask = ask;
    this.isDragged = false;
    this.placeMs = 0;
    this.place.addEventListener("input", () => {
      this.isDragged = true;
      this.say(Number(this.place.value));
    });
    this.place.addEventListener("change", () => {
      this.isDragged = false;
      this.jump(Number(this.place.value));
      this.place.blur(); // arrows are the frames' again
    });
  }

  // playback: of the newest status; null of anything but a recording.
  show(playback) {
    this.bar.hidden = playback === null;
    if (playback === null || this.isDragged) {
      return;
    }
    this.placeMs = playback.place_ms;
    this.place.max = String(playback.span_ms);
    this.place.value = String(playback.place_ms);
    this.say(playback.place_ms);
  }

  say(placeMs) {
    const words = `${clock(placeMs)} of ${clock(Number(this.place.max))}`;
    if (this.words.textContent !== words) {
      this.words.textContent = words;
    }
  }

  jump(placeMs) {
    if (!this.bar.hidden) {
      const most = Number(this.place.max);
      this.ask(`jump ${Math.round(Math.min(most, Math.max(0, placeMs)))}`);
    }
  }

  rewind() { this.jump(this.placeMs - STEP_MS); }
  forward() { this.jump(this.placeMs + STEP_MS); }
}
