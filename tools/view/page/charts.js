// The strip of charts: the last minute of what the target and the network say of themselves.

import { FATES, SERIES } from "./palette.js";
import { causesOf, deviationOf, slicesOf } from "./place.js";
import { factsOf, isOfTarget } from "./status.js";

const SPAN_MS = 60000;
const ROW = 19; // pixels for a sensor
const STAGES = ["fuse", "mark", "perceive", "publish"];

const compact = (value) =>
  Number.isInteger(value) || value >= 100 ? Math.round(value).toLocaleString("en")
                                          : value.toPrecision(2);

// So that the digits of what changes with each frame stay where they are.
const exact = (value, unit) => (unit === "ms" ? value.toFixed(value < 9.995 ? 2 : 1) : compact(value));

// A chart is a name, a unit, and for each frame a list of values that are stacked.
const CHARTS = [
  {
    id: "places",
    isOfClasses: true,
    title: () => "Place of the scans",
    unit: "",
    series: [{ name: "slices placed", colour: SERIES.placed },
             { name: "not placed", colour: SERIES.loss }],
    values: ({ status }) => (classesOf(status) ? slicesOf(classesOf(status)) : []),
    head: ({ status }) => (classesOf(status) ? deviationOf(classesOf(status)) : "–"),
    notes: ({ status }) => (classesOf(status) ? causesOf(classesOf(status)) : []),
  },
  {
    id: "times",
    title: (kind) => (isOfTarget(kind) ? "Time on the target" : "Time on this PC"),
    unit: "ms",
    share: 0.98, // of the columns fits; what a pause of the PC has made of the others sticks out
    series: STAGES.map((name) => ({ name, colour: SERIES[name] })),
    values: ({ status }) => {
      const end = status.frame && status.frame.end;
      return end ? STAGES.map((stage) => end[`${stage}_us`] / 1000) : [];
    },
  },
  {
    id: "fates",
    title: () => "Scan points by fate",
    unit: "",
    series: FATES,
    values: ({ status }) => (status.frame && status.frame.end ? status.frame.end.fates : []),
  },
  {
    id: "bytes",
    title: () => "Bytes per frame",
    unit: "KiB",
    series: [{ name: "received", colour: SERIES.bytes }],
    values: ({ status }) => (status.frame ? [status.frame.bytes / 1024] : []),
  },
  {
    id: "losses",
    title: () => "Losses",
    unit: "",
    series: [{ name: "messages lost", colour: SERIES.loss },
             { name: "corrupt", colour: SERIES.mark },
             { name: "tiles missing", colour: SERIES.bytes }],
    values: ({ status }, before) => {
      const { counts } = status;
      const old = before ? before.status.counts : counts;
      return [Math.max(0, counts.lost + counts.overflow - old.lost - old.overflow),
              Math.max(0, counts.corrupt + counts.malformed - old.corrupt - old.malformed),
              status.frame ? status.frame.missing_tiles : 0];
    },
  },
];

const classesOf = (status) => status.frame && status.frame.classes;

const make = (tag, className, text = "") =>
  Object.assign(document.createElement(tag), { className, textContent: text });

export class Charts {
  constructor(parent) {
    this.charts = CHARTS.map((chart) => this.addChart(parent, chart));
    this.sensors = this.addChart(parent, { id: "sensors", title: () => "Sensors", series: [] });
    const span = make("div", "span number");
    span.append(make("span", "", "−60 s"), make("span", "", "newest"));
    parent.append(span);
    this.facts = make("dl", "facts number");
    parent.append(this.facts);
    this.parent = parent;
    this.picture = ""; // a name of what is drawn: what has the same name looks alike
  }

  addChart(parent, chart) {
    const box = make("section", "chart");
    box.id = `chart-${chart.id}`;
    const head = make("div", "chart-head");
    const title = make("h2", "", chart.title(""));
    const value = make("span", "number quiet");
    const canvas = make("canvas", "");
    const keys = make("div", "chart-keys");
    const notes = make("div", "chart-notes");
    head.append(title, value);
    box.append(head, canvas, keys, notes);
    parent.append(box);
    return { ...chart, box, titleBox: title, value, canvas, keys, notesBox: notes, words: "" };
  }

  // frames: of the history; at: the frame that is shown; said: the one of which numbers are; status:
  // the newest.
  draw({ frames, at, said, status }, { vehicle, theme }) {
    if (status) {
      this.showFacts(said ? { ...status, frame: said.status.frame } : status);
    }
    const picture = [...[frames[frames.length - 1], at, said].map((frame) => frame?.number), theme,
                     status?.kind, vehicle?.name, window.devicePixelRatio, this.parent.clientWidth].join();
    if (picture === this.picture) {
      return;
    }
    this.picture = picture;
    const end = frames.length > 0 ? frames[frames.length - 1].timeMs : 0;
    for (const chart of this.charts) {
      chart.box.hidden = Boolean(chart.isOfClasses) && !(said && classesOf(said.status));
      if (chart.box.hidden) {
        continue;
      }
      chart.titleBox.textContent = chart.title(status ? status.kind : "");
      this.drawSeries(chart, { frames, at, said }, end, theme);
    }
    this.drawSensors({ frames, at, said }, end, vehicle, theme);
  }

  prepare(chart) {
    const { canvas } = chart;
    const ratio = window.devicePixelRatio || 1;
    const width = canvas.clientWidth;
    const height = canvas.clientHeight;
    if (canvas.width !== Math.round(width * ratio) || canvas.height !== Math.round(height * ratio)) {
      canvas.width = Math.round(width * ratio);
      canvas.height = Math.round(height * ratio);
    }
    const context = canvas.getContext("2d");
    context.setTransform(ratio, 0, 0, ratio, 0, 0);
    context.clearRect(0, 0, width, height);
    return { context, width, height };
  }

  drawSeries(chart, { frames, at, said }, end, theme) {
    const { context, width, height } = this.prepare(chart);
    const columns = new Array(Math.max(1, Math.ceil(width)));
    frames.forEach((frame, i) => {
      const values = chart.values(frame, frames[i - 1]);
      const sum = values.reduce((a, b) => a + b, 0);
      const column = Math.floor(width - 1 - (end - frame.timeMs) / SPAN_MS * width);
      if (column >= 0 && column < columns.length && !(columns[column]?.sum > sum)) {
        columns[column] = { sum, values };
      }
    });
    const sums = columns.filter((column) => column).map(({ sum }) => sum).sort((a, b) => a - b);
    const top = niceAbove(sums[Math.ceil((sums.length - 1) * (chart.share ?? 1))] ?? 0);
    drawBase(context, width, height, theme, `${compact(top)} ${chart.unit}`);
    columns.forEach((column, x) => {
      let base = height;
      (column ? column.values : []).forEach((value, series) => {
        const size = value / top * (height - 2);
        context.fillStyle = chart.series[series] ? chart.series[series].colour[theme] : "gray";
        context.fillRect(x, base - size, 1.05, size);
        base -= size;
      });
    });
    drawCursor(context, width, 0, height, at, end, theme);
    this.showKeys(chart, said ? chart.values(said, null) : [], theme);
    if (chart.head && said) {
      chart.value.textContent = chart.head(said);
      this.showNotes(chart, chart.notes(said));
    }
  }

  showNotes({ notesBox }, notes) {
    if (notesBox.textContent !== notes.join("")) {
      notesBox.replaceChildren(...notes.map((words) => make("span", "", words)));
    }
  }

  showKeys(chart, values, theme) {
    const sum = values.reduce((a, b) => a + b, 0);
    chart.value.textContent = values.length > 0 ? `${exact(sum, chart.unit)} ${chart.unit}` : "–";
    const shown = chart.series.map((series, i) => ({ ...series, value: values[i] ?? 0 }))
        .filter(({ value }, i) => chart.series.length <= 4 || i === 0 || value > 0);
    const words = theme + shown.map(({ name, value }) => `${name} ${exact(value, chart.unit)}`).join();
    if (words === chart.words || chart.series.length < 2) {
      return;
    }
    chart.words = words;
    chart.keys.replaceChildren(...shown.map(({ name, value, colour }) => {
      const key = make("span", "key", `${name} ${exact(value, chart.unit)}`);
      const spot = make("i", "");
      spot.style.background = colour[theme];
      key.prepend(spot);
      return key;
    }));
  }

  drawSensors({ frames, at, said }, end, vehicle, theme) {
    const chart = this.sensors;
    const last = [...frames].reverse().find(({ status }) => status.frame && status.frame.end);
    const count = last ? last.status.frame.end.sensors.length : 0;
    chart.canvas.style.height = `${Math.max(1, count) * ROW}px`;
    const { context, width, height } = this.prepare(chart);
    const shown = said && said.status.frame && said.status.frame.end ? said : last;
    let complete = 0;
    for (let i = 0; i < count; ++i) {
      const names = vehicle ? vehicle.sensors.map(({ name }) => name) : [];
      const y = i * ROW;
      for (const { status, timeMs } of frames) {
        const sensor = status.frame && status.frame.end && status.frame.end.sensors[i];
        const x = width - 1 - (end - timeMs) / SPAN_MS * width;
        if (sensor && x >= 0) {
          context.fillStyle = SERIES.state[theme][sensor.state] ?? "gray";
          context.fillRect(x, y + 14, 1.6, 3);
        }
      }
      drawCursor(context, width, y + 13, 5, at, end, theme); // below the words
      const state = shown.status.frame.end.sensors[i];
      complete += state && state.state === 3 ? 1 : 0;
      context.fillStyle = theme === "dark" ? "#c6ced6" : "#2a333b";
      context.font = "11px system-ui, sans-serif";
      context.textBaseline = "top";
      context.fillText(names[i] ?? `sensor ${i}`, 0, y);
      context.textAlign = "right";
      context.fillText(state ? describeSensor(state) : "", width, y);
      context.textAlign = "left";
    }
    chart.value.textContent = count > 0 ? `${complete} of ${count} complete` : "–";
  }

  showFacts(status) {
    const rows = factsOf(status);
    const words = rows.join();
    if (words !== this.words) {
      this.words = words;
      this.facts.replaceChildren(...rows.flatMap(
          ([name, value]) => [make("dt", "", name), make("dd", "", value)]));
    }
  }
}

const BLOCKED = ["", ", partly blocked", ", BLOCKED"];

function describeSensor({ state, age, points, blocked }) {
  switch (state) {
    case 3:
      return `${points} points${BLOCKED[blocked] ?? ""}`;
    case 2:
      return `partial, ${points} points${BLOCKED[blocked] ?? ""}`;
    case 1:
      return age === 0xffff ? "silent" : `silent for ${age} frames`;
    default:
      return "never seen";
  }
}

function niceAbove(value) {
  if (value === 0) {
    return 1;
  }
  const unit = 10 ** Math.floor(Math.log10(Math.max(value, 1e-3)));
  return ([1, 1.5, 2, 3, 5, 7.5, 10].find((step) => step * unit >= value) ?? 10) * unit;
}

function drawBase(context, width, height, theme, words) {
  context.fillStyle = theme === "dark" ? "rgba(150, 170, 190, 0.10)" : "rgba(40, 60, 80, 0.08)";
  context.fillRect(0, 0, width, height);
  context.fillStyle = theme === "dark" ? "#8b98a5" : "#5a6670";
  context.font = "10px system-ui, sans-serif";
  context.textBaseline = "top";
  context.fillText(words, 3, 2);
}

function drawCursor(context, width, top, height, at, end, theme) {
  if (!at || at.timeMs === end) {
    return;
  }
  context.fillStyle = theme === "dark" ? "#ffffff" : "#000000";
  context.fillRect(width - 1 - (end - at.timeMs) / SPAN_MS * width, top, 1, height);
}
