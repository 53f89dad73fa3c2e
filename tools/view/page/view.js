// Joins it all: takes messages, keeps them, shows one of them, and says whether it is of now.
//
// What comes from the server is data: words are set as text, never as markup.

import { Charts } from "./charts.js";
import { addOverlaySwitches, listKeys, listenToKeys, onPress } from "./controls.js";
import { GridCanvas } from "./grid_canvas.js";
import { History, ShownGrid } from "./history.js";
import { Pointing } from "./hover.js";
import { Legend } from "./legend.js";
import { fetchOutlines } from "./map_outlines.js";
import { readMessage } from "./messages.js";
import { ObjectList } from "./objects.js";
import { OVERLAYS } from "./overlays.js";
import { foldSome, listenToFolds, toggle } from "./panels.js";
import { lastPlaceOf, trackOf } from "./place.js";
import { Playback } from "./playback.js";
import { listenToPointers } from "./pointers.js";
import { describe, frameOfNumbers, rateOf, titleOf } from "./status.js";

const WORDS_EVERY_MS = 200;
const HIDDEN_EVERY_MS = 1000;
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
    this.grid = new ShownGrid();
    this.view = new GridCanvas(byId("grid"), this.grid);
    this.strip = new Charts(byId("charts"));
    this.list = new ObjectList(byId("charts"));
    this.legend = new Legend(byId);
    this.pointing = new Pointing(this.view, byId, () => this.redraw());
    this.playback = new Playback(byId, (words) => this.ask(words));
    this.status = null;
    this.socket = null;
    this.lastMessageMs = 0;
    this.isHeld = false; // paused: a frame of the past may be shown
    this.wanted = -1; // the frame that is to be shown
    this.isDirty = true; // the picture
    this.areWordsOld = true; // and what is beside it
    this.wordsMs = 0;
    this.vehicleWords = "";
    this.pictures = 0; // drawn so far
    this.drawMs = 0; // that it took
    this.errors = 0; // messages that made no sense
    this.hasMap = false;
    this.overlayButtons = addOverlaySwitches(byId("switches"), this);
    this.setTheme(matchMedia("(prefers-color-scheme: light)").matches ? "light" : "dark");
    this.listen();
    this.connect();
    requestAnimationFrame(() => this.tick());
  }

  listen() {
    listenToKeys(this);
    listenToFolds();
    foldSome();
    listKeys(byId("keys"));
    for (const id of ["pause", "back", "step", "record", "layer", "scale", "theme", "live", "follow", "measure"]) {
      onPress(byId(id), () => this[id]());
    }
    onPress(byId("help-open"), () => this.help());
    onPress(byId("help-close"), () => this.help());
    byId("scrub").addEventListener("input", (event) => this.hold(Number(event.target.value)));
    listenToPointers(byId("grid"), this.view, {
      changed: () => this.redraw(),
      hovered: (...where) => this.pointing.hover(...where),
      clicked: (place) => this.pointing.click(place),
    });
    new ResizeObserver(() => this.redraw()).observe(byId("grid"));
    matchMedia("(prefers-color-scheme: light)").addEventListener(
        "change", (event) => this.setTheme(event.matches ? "light" : "dark"));
    setInterval(() => this.showStateIfHidden(), HIDDEN_EVERY_MS);
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
      this.takeVehicle(message.vehicle);
      this.fetchMap();
      if (message.hasFrame) {
        this.history.add(message, message.status.now_ms);
        if (!this.isHeld) {
          this.live();
        }
      }
    } catch {
      this.errors += 1;
    }
    this.areWordsOld = true;
    this.showStateIfHidden();
    this.socket.send("ready");
  }

  // Each key has it.
  takeVehicle(vehicle) {
    const words = vehicle ? JSON.stringify(vehicle) : this.vehicleWords;
    if (words !== this.vehicleWords) {
      this.vehicleWords = words;
      this.view.vehicle = vehicle;
      this.restyle();
    }
  }

  // Once, if the server has one.
  fetchMap() {
    if (this.status.block !== "" && !this.hasMap) {
      this.hasMap = true;
      fetchOutlines().then((outlines) => (this.view.outlines = outlines, this.restyle()),
                           () => (this.errors += 1));
    }
  }

  // Nothing is drawn then, but the tab's title is still seen.
  showStateIfHidden() {
    if (document.hidden) {
      this.showState(performance.now());
    }
  }

  // Once for each picture of the screen.
  tick() {
    const now = performance.now();
    this.showState(now);
    if (this.isDirty) {
      this.isDirty = false;
      this.showFrame();
      this.view.draw();
      this.pointing.show();
      this.pictures += 1;
      this.drawMs += performance.now() - now;
    }
    if (this.areWordsOld && now - this.wordsMs > WORDS_EVERY_MS) {
      this.areWordsOld = false;
      this.wordsMs = now;
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
    const named = () => `${this.view.showsClasses} ${grid.hasObjects}`;
    const before = named();
    try {
      grid.show(history, number);
      this.view.track = grid.classes ? trackOf(history.frames, grid.frame) : [];
      this.view.map = (grid.classes && grid.classes.end && grid.classes.end.map) ?? this.view.map;
      this.view.place = grid.classes ? lastPlaceOf(history.frames, grid.frame) : null;
      this.view.measured.check(this.view);
      if (named() !== before) {
        this.restyle();
      }
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
      this.restyle();
    }
    const state = this.isHeld && said.state === "live" ? "held" : said.state;
    byId("state").dataset.state = state;
    setText(byId("state-word"), this.isHeld ? `paused, ${said.word}` : said.word);
    const title = titleOf(said, this.isHeld);
    if (document.title !== title) {
      document.title = title;
    }
    byId("banner").hidden = said.title === "";
    byId("banner").dataset.state = said.state;
    setText(byId("banner-title"), said.title);
    setText(byId("banner-text"), said.text);
    byId("follow").hidden = this.view.isFollowing;
  }

  // What need not change with each picture.
  showWords() {
    const { status, history, grid, view } = this;
    const said = this.isHeld ? grid.frame : frameOfNumbers(history.frames, grid.frame);
    this.list.show(view);
    this.strip.draw({ frames: history.frames, at: grid.frame, said, status }, view);
    this.showScrub();
    if (status) {
      setText(byId("origin"), status.problem || `${status.source}`);
      byId("origin").classList.toggle("problem", status.problem !== "");
      this.showRecording(status.recording);
      this.playback.show(status.playback);
    }
    setText(byId("vehicle"), view.vehicle ? view.vehicle.name : "");
    setText(byId("rate"), rateOf(history.frames, status));
    const frame = grid.frame && grid.frame.status.frame;
    setText(byId("frame-words"), frame
        ? `frame ${frame.number}, ${(frame.closed_us / 1e6).toFixed(2)} s` : "");
    this.legend.showMore(view, status ? status.kind : "stream");
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

  redraw() {
    this.isDirty = true;
    this.areWordsOld = true;
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

  record() { this.ask(this.status && this.status.recording.open ? "stop" : "record"); }
  measure() { this.pointing.measure(); }
  quit() { this.pointing.quit(); }
  rewind() { this.playback.rewind(); }
  forward() { this.playback.forward(); }

  ask(words) {
    if (this.status && this.socket.readyState === WebSocket.OPEN) {
      this.socket.send(words);
    }
  }

  layer() {
    this.view.wantsClasses = !this.view.showsClasses;
    this.restyle();
  }

  scale() {
    this.view.scale = this.view.scale === "index" ? "probability" : "index";
    setText(byId("scale"), this.view.scale === "index" ? "Probability" : "Index");
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
    this.legend.show(this.view);
    this.wordsMs = 0;
    this.showButtons();
    this.redraw();
  }

  // Those that say something of what is shown.
  showButtons() {
    const { showsClasses, overlays, outlines, grid } = this.view;
    for (const { id, name, nameOfClasses, isOfClasses, isOfMap, isOfObjects } of OVERLAYS) {
      const button = this.overlayButtons.get(id);
      button.hidden = (Boolean(isOfClasses) && !showsClasses) ||
                      (Boolean(isOfMap) && outlines === null) ||
                      (Boolean(isOfObjects) && !grid.hasObjects);
      button.setAttribute("aria-pressed", String(overlays.has(id)));
      setText(button.querySelector("span"), showsClasses ? nameOfClasses ?? name : name);
    }
    const { classes, frame } = this.grid;
    byId("layer").hidden = !classes || !frame.status.frame.sends_indexes;
    setText(byId("layer"), showsClasses ? "Index grid" : "Classes");
    byId("scale").hidden = showsClasses;
  }

  overlay(id) {
    const { overlays } = this.view;
    if (!overlays.delete(id)) {
      overlays.add(id);
    }
    this.restyle();
  }

  charts() { toggle("charts"); }

  help() {
    const dialog = byId("help");
    if (dialog.open) {
      dialog.close();
    } else {
      dialog.showModal();
      dialog.scrollTop = 0; // the focus is on its last button
    }
  }
}

window.iogPage = new Page();
