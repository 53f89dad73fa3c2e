// Joins it all: takes messages, keeps them, shows one of them, and says whether it is of now.
//
// What comes from the server is data: words are set as text, never as markup.

import { Charts } from "./charts.js";
import { addOverlaySwitches, listKeys, listenToKeys, listenToPointer } from "./controls.js";
import { GridCanvas } from "./grid_canvas.js";
import { History, ShownGrid } from "./history.js";
import { SIDE, TILES_PER_SIDE, TILE_SIDE, readMessage } from "./messages.js";
import { OVERLAYS, quadtreeLeaves } from "./overlays.js";
import { FATES, colourOfIndex, css, probabilityOf } from "./palette.js";
import { describe } from "./status.js";

const CHARTS_EVERY_MS = 200;
const RETRY_MS = 1000;

const byId = (id) => document.getElementById(id);
const setText = (element, words) => {
  if (element.textContent !== words) {
    element.textContent = words;
  }
};

class Page {
  constructor() {
    this.history = new History();
    this.grid = new ShownGrid(SIDE);
    this.view = new GridCanvas(byId("grid"), this.grid);
    this.strip = new Charts(byId("charts"));
    this.status = null;
    this.socket = null;
    this.lastMessageMs = 0;
    this.isHeld = false; // paused: a frame of the past may be shown
    this.wanted = -1; // the frame that is to be shown
    this.pointer = null;
    this.isDirty = true;
    this.chartsMs = 0;
    this.pictures = 0; // drawn so far
    this.drawMs = 0; // that it took
    this.errors = 0; // messages that made no sense
    this.overlayButtons = addOverlaySwitches(byId("overlays"), this);
    this.setTheme(matchMedia("(prefers-color-scheme: light)").matches ? "light" : "dark");
    this.listen();
    this.connect();
    requestAnimationFrame(() => this.tick());
  }

  listen() {
    listenToKeys(this);
    listKeys(byId("keys"));
    for (const id of ["pause", "back", "step", "record", "scale", "theme", "live"]) {
      byId(id).addEventListener("click", (event) => {
        this[id]();
        event.currentTarget.blur();
      });
    }
    byId("help-open").addEventListener("click", () => this.help());
    byId("help-close").addEventListener("click", () => this.help());
    byId("scrub").addEventListener("input", (event) => this.hold(Number(event.target.value)));
    listenToPointer(byId("grid"), this.view, {
      changed: () => this.redraw(),
      hovered: (place) => {
        this.pointer = place;
        this.showHover();
      },
    });
    new ResizeObserver(() => this.redraw()).observe(byId("stage"));
    matchMedia("(prefers-color-scheme: light)").addEventListener(
        "change", (event) => this.setTheme(event.matches ? "light" : "dark"));
  }

  connect() {
    this.socket = new WebSocket(`ws://${location.host}/live`);
    this.socket.binaryType = "arraybuffer";
    // Another server, or another run of it: what is known here is not of it.
    this.socket.onopen = () => (this.lastMessageMs > 0 ? location.reload() : null);
    this.socket.onmessage = ({ data }) => this.take(data);
    this.socket.onclose = () => setTimeout(() => this.connect(), RETRY_MS);
  }

  take(data) {
    this.lastMessageMs = performance.now();
    try {
      const message = readMessage(data);
      this.status = message.status;
      if (message.vehicle) {
        this.view.vehicle = message.vehicle;
        this.view.restyle();
        this.showLegend();
      }
      if (message.hasFrame) {
        this.history.add(message, message.status.now_ms);
        if (!this.isHeld) {
          this.wanted = this.history.last;
        }
      }
    } catch {
      this.errors += 1;
    }
    this.isDirty = true;
    this.socket.send("ready");
  }

  // Once for each picture of the screen.
  tick() {
    const now = performance.now();
    this.showState(now);
    if (this.isDirty) {
      this.isDirty = false;
      this.showFrame();
      this.view.draw();
      this.showHover();
      this.pictures += 1;
      this.drawMs += performance.now() - now;
    }
    if (now - this.chartsMs > CHARTS_EVERY_MS) {
      this.chartsMs = now;
      this.showWords();
    }
    requestAnimationFrame(() => this.tick());
  }

  showFrame() {
    const { history, grid } = this;
    const stays = this.isHeld && grid.number === this.wanted; // however old it is by now
    if (history.frames.length === 0 || stays) {
      return;
    }
    const number = Math.min(history.last, Math.max(history.first, this.wanted));
    try {
      grid.show(history, number);
    } catch {
      this.errors += 1;
      grid.number = -1;
    }
  }

  showState(now) {
    const isConnected = this.socket && this.socket.readyState === WebSocket.OPEN;
    const said = describe(this.status, now - this.lastMessageMs, isConnected);
    const isOld = ["stale", "gone", "incompatible"].includes(said.state);
    if (isOld !== this.view.isStale) {
      this.view.isStale = isOld;
      byId("stage").classList.toggle("stale", isOld && this.grid.number >= 0);
      this.redraw();
    }
    const state = this.isHeld && said.state === "live" ? "held" : said.state;
    byId("state").dataset.state = state;
    setText(byId("state-word"), this.isHeld ? `paused, ${said.word}` : said.word);
    byId("banner").hidden = said.title === "";
    byId("banner").dataset.state = said.state;
    setText(byId("banner-title"), said.title);
    setText(byId("banner-text"), said.text);
    byId("follow-note").hidden = this.view.isFollowing;
  }

  // What need not change with each picture.
  showWords() {
    const { status, history, grid } = this;
    this.strip.draw(history.frames, grid.frame, status, this.view.vehicle, this.view.theme);
    this.showScrub();
    if (status) {
      setText(byId("origin"), status.problem || `${status.source}`);
      byId("origin").classList.toggle("problem", status.problem !== "");
      this.showRecording(status.recording);
    }
    setText(byId("vehicle"), this.view.vehicle ? this.view.vehicle.name : "");
    setText(byId("rate"), this.rate());
    const frame = grid.frame && grid.frame.status.frame;
    setText(byId("frame-words"), frame
        ? `frame ${frame.number}, ${(frame.closed_us / 1e6).toFixed(2)} s` : "");
    this.showLegendMore();
  }

  rate() {
    const frames = this.history.frames.slice(-26);
    const spanMs = frames.length > 1 ? frames[frames.length - 1].timeMs - frames[0].timeMs : 0;
    const isLive = this.status && this.status.state === "live";
    return isLive && spanMs > 0 ? `${((frames.length - 1) / spanMs * 1000).toFixed(1)} Hz` : "";
  }

  showScrub() {
    const { history, grid } = this;
    const scrub = byId("scrub");
    const has = history.frames.length > 0;
    scrub.disabled = !has;
    scrub.min = String(history.first);
    scrub.max = String(has ? history.last : 0);
    scrub.value = String(this.isHeld ? grid.number : history.last);
    const newest = has ? history.at(history.last).timeMs : 0;
    const behindMs = grid.frame ? newest - grid.frame.timeMs : 0;
    setText(byId("scrub-time"), this.isHeld ? `−${(behindMs / 1000).toFixed(2)} s` : "newest");
    byId("live").disabled = !this.isHeld;
    setText(byId("pause"), this.isHeld ? "Go on" : "Pause");
  }

  showRecording(recording) {
    byId("record").classList.toggle("on", recording.open);
    const words = recording.open
        ? `Stop, ${(recording.bytes / 1048576).toFixed(1)} MiB` : "Record";
    setText(byId("record").lastElementChild, words);
    byId("record").title = recording.file === "" ? "Record the stream as .pcap (R)"
        : `${recording.open ? "Recording to" : "Recorded to"} ${recording.file}`;
  }

  showHover() {
    const cell = this.pointer && this.view.width ? this.view.cellAt(...this.pointer) : null;
    byId("hover").hidden = cell === null;
    if (cell === null) {
      return;
    }
    const { cellM, epsilon } = this.view;
    const index = this.grid.cells[cell.y * SIDE + cell.x];
    const age = this.grid.ages[Math.floor(cell.y / TILE_SIDE) * TILES_PER_SIDE +
                               Math.floor(cell.x / TILE_SIDE)];
    const x = (cell.x - SIDE / 2 + 0.5) * cellM;
    const y = (cell.y - SIDE / 2 + 0.5) * cellM;
    setText(byId("hover-verdict"), index === 0 ? "unknown" : index < 0 ? "free" : "occupied");
    setText(byId("hover-place"), `x ${x.toFixed(2)} m, y ${y.toFixed(2)} m`);
    setText(byId("hover-cell"), `cell ${cell.x}, ${cell.y}`);
    setText(byId("hover-value"),
            `index ${index}, p ${probabilityOf(index, epsilon).toFixed(4)}`);
    setText(byId("hover-age"), age === 0 ? "" : age === 255 ? "never received" : `${age} frames old`);
    byId("hover").dataset.index = String(index);
    byId("hover").dataset.cell = `${cell.x},${cell.y}`;
  }

  showLegend() {
    const { theme, scale, epsilon } = this.view;
    const canvas = byId("legend-scale");
    const context = canvas.getContext("2d");
    const [low, high] = [-56, 14];
    for (let column = 0; column < canvas.width; ++column) {
      // Half of the bar for each sign.
      const t = column / (canvas.width - 1) * 2 - 1;
      const index = Math.abs(t) < 0.06 ? 0 : Math.round(t < 0 ? -t * low : t * high) || Math.sign(t);
      context.fillStyle = css(colourOfIndex(theme, scale, epsilon, index));
      context.fillRect(column, 0, 1, canvas.height);
    }
    const ticks = scale === "index" ? ["−56", "−28", "0", "+7", "+14"]
        : [-56, -28, 0, 7, 14].map((index) => probabilityOf(index, epsilon).toPrecision(2));
    byId("legend-ticks").replaceChildren(...ticks.map(
        (words) => Object.assign(document.createElement("span"), { textContent: words })));
  }

  // What only some overlays need.
  showLegendMore() {
    const { overlays, theme, palette } = this.view;
    const lines = [];
    if (overlays.has("points")) {
      const kind = this.status ? this.status.kind : "stream";
      if (kind === "stream" || !this.grid.points || this.grid.points.byteLength === 0) {
        lines.push([null, "scan points: the stream has none; --pcap has"]);
      } else {
        lines.push(...FATES.filter((_, i) => i !== 1 && i !== 7)
            .map(({ name, colour }) => [colour[theme], name]));
      }
    }
    if (overlays.has("truth") || overlays.has("difference")) {
      if (!this.grid.hasTruth) {
        lines.push([null, "truth: only a simulated drive has it"]);
      } else if (overlays.has("difference")) {
        lines.push([css(palette.agreed), "hit, and occupied in truth"],
                   [css(palette.invented), "hit, free in truth"],
                   [css(palette.missed), "free here, occupied in truth"],
                   [css(palette.missed, 0.4), "occupied in truth, not seen"]);
      } else {
        lines.push([css(palette.missed), "occupied in truth"]);
      }
    }
    if (overlays.has("leaves")) {
      lines.push([null, `${(quadtreeLeaves(this.grid).length / 3).toLocaleString("en")} leaves`]);
    }
    const words = theme + lines.join();
    if (words === this.legendWords) {
      return;
    }
    this.legendWords = words;
    byId("legend-more").replaceChildren(...lines.map(([colour, name]) => {
      const line = Object.assign(document.createElement("span"), { className: "key" });
      if (colour) {
        const spot = document.createElement("i");
        spot.style.background = colour;
        line.append(spot);
      }
      line.append(name);
      return line;
    }));
  }

  redraw() {
    this.isDirty = true;
  }

  // Shows that frame of the past until told otherwise.
  hold(number) {
    this.isHeld = true;
    this.wanted = Math.min(this.history.last, Math.max(this.history.first, number));
    this.redraw();
  }

  // Actions of keys and buttons.
  pause() {
    if (this.isHeld) {
      this.live();
    } else {
      this.hold(this.grid.number);
    }
    this.showScrub();
  }

  live() {
    this.isHeld = false;
    this.wanted = this.history.last;
    this.redraw();
  }

  back() { this.hold(this.grid.number - 1); }
  step() { this.hold(this.grid.number + 1); }
  oldest() { this.hold(this.history.first); }
  nearer() { this.zoomBy(1.3); }
  farther() { this.zoomBy(1 / 1.3); }

  zoomBy(factor) {
    this.view.zoom(factor);
    this.redraw();
  }

  follow() {
    this.view.follow();
    this.redraw();
  }

  showAll() {
    this.view.showAll();
    this.redraw();
  }

  record() {
    if (this.status && this.socket.readyState === WebSocket.OPEN) {
      this.socket.send(this.status.recording.open ? "stop" : "record");
    }
  }

  scale() {
    this.view.scale = this.view.scale === "index" ? "probability" : "index";
    setText(byId("scale"), this.view.scale === "index" ? "Index" : "Probability");
    this.restyle();
  }

  theme() { this.setTheme(this.view.theme === "dark" ? "light" : "dark"); }

  setTheme(theme) {
    this.view.theme = theme;
    document.documentElement.dataset.theme = theme;
    setText(byId("theme"), theme === "dark" ? "Light" : "Dark");
    this.restyle();
  }

  restyle() {
    this.view.restyle();
    this.showLegend();
    this.chartsMs = 0;
    for (const { id } of OVERLAYS) {
      this.overlayButtons.get(id).setAttribute("aria-pressed", String(this.view.overlays.has(id)));
    }
    this.redraw();
  }

  overlay(id) {
    const { overlays } = this.view;
    if (!overlays.delete(id)) {
      overlays.add(id);
    }
    this.restyle();
  }

  charts() {
    document.body.classList.toggle("wide");
    this.redraw();
  }

  help() {
    const dialog = byId("help");
    if (dialog.open) {
      dialog.close();
    } else {
      dialog.showModal();
    }
  }
}

window.iogPage = new Page();
