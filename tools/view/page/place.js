// Where the car is, how well that is known, and why it is not, in words (docs/spec.md, 5.5).

// Causes after which the window begins anew: lost, jump, restart, contradicted, drifting.
const BREAKS = 0x02 | 0x08 | 0x10 | 0x40 | 0x80;
export const TRACK_S = 30;
const NEAREST_M = 0.15; // places of a track that are closer are one
const LATELY_S = 2;
const LONGEST_S = 86400; // longer ago: the clock of the poses has begun anew since

// In the order in which the target counts them, with the bit by which a frame names each.
const [LATE, IMPRECISE, LOST, JUMP, RESTART, CONTRADICTED, DRIFTING] = [0, 1, 2, 3, 4, 5, 6];
const BITS = [0x01, 0x04, 0x02, 0x08, 0x10, 0x40, 0x80];
const NAMES = ["no pose in time", "pose too imprecise", "poses lost", "pose jumped",
               "pose source restarted", "poses contradicted by the sensors", "poses later and later"];

const span = (s) =>
  (s < 10 ? `${s.toFixed(1)} s` : s < 120 ? `${Math.round(s)} s` : `${Math.round(s / 60)} min`);

// How long ago a cause began last; null if that is not known.
function agoOf({ stamp_us: stamp, end }, cause) {
  const ago = end && end.causes[cause].times > 0 ? (stamp - end.causes[cause].since_us) / 1e6 : -1;
  return ago >= 0 && ago < LONGEST_S ? ago : null;
}

// Packets without a time of their own have no slices that would be counted by it.
const BREAKING = [LOST, JUMP, RESTART, CONTRADICTED, DRIFTING];
const latestBreak = (end) => BREAKING
    .filter((cause) => end.causes[cause].times > 0)
    .sort((a, b) => end.causes[b].since_us - end.causes[a].since_us)[0];

// Why nothing of the frame was placed; null if something was, or nothing was to be.
function causeOf({ slices, causes, end }) {
  if (slices > 0 || !end || end.packets_not_placed === 0) {
    return null;
  }
  const order = [LOST, IMPRECISE, LATE, JUMP, RESTART, CONTRADICTED, DRIFTING];
  return order.find((cause) => end.causes[cause].slices > 0) ??
         order.find((cause) => (causes & BITS[cause]) !== 0) ?? latestBreak(end) ?? LOST;
}

const ago = (s) => (s === null ? "" : ` ${span(s)} ago`);
const forSo = (s) => (s === null ? "" : ` for ${span(s)}`);

function describeCause(classes, cause) {
  const s = agoOf(classes, cause);
  const stays = "What was known stays where it is, and fades.";
  switch (cause) {
    case LATE:
      return { word: "no pose", title: `No pose${forSo(s)}`, text: `Nothing is placed. ${stays}` };
    case IMPRECISE:
      return { word: "imprecise pose", title: `The pose is too imprecise${forSo(s)}`,
               text: `Nothing is placed. ${stays}` };
    case LOST:
      return classes.end.causes[LOST].times === 0
          ? { word: "no pose", title: "No pose has come yet",
              text: "Without poses nothing can be placed. V switches between the grid of each single frame and the classes." }
          : { word: "no pose", title: `No pose${forSo(s)}`,
              text: "Nothing is placed, and where things were is not known any more." };
    default:
      return describeBreak(cause, s);
  }
}

function describeBreak(cause, s) {
  const what = cause === JUMP ? `The pose jumped${ago(s)}`
      : cause === RESTART ? `The source of the poses started anew${ago(s)}`
      : cause === CONTRADICTED ? `The sensors contradicted the poses${ago(s)}`
      : cause === DRIFTING ? `Poses came later and later${ago(s)}`
      : `Poses were lost${ago(s)}, and are back`;
  return { word: "", title: what, text: "What was known has lost its place: the window began anew." };
}

// What the banner says of the place: {word, title, text}, or null if all is well.
export function describePlace(classes) {
  if (!classes) {
    return null;
  }
  const cause = causeOf(classes);
  if (cause !== null) {
    return describeCause(classes, cause);
  }
  const breaks = [JUMP, RESTART, LOST, CONTRADICTED, DRIFTING].map((one) => [one, agoOf(classes, one)])
      .filter(([, s]) => s !== null && s < LATELY_S).sort(([, a], [, b]) => a - b);
  return breaks.length > 0 ? describeBreak(...breaks[0]) : null;
}

// How well the pose is known, as numbers.
export const deviationOf = ({ has_place: isKnown, sigma_m: m, sigma_deg: deg }) =>
  (!isKnown ? "no place"
            : `±${m < 0.1 ? `${(m * 100).toFixed(1)} cm` : `${m.toFixed(2)} m`}, ±${deg.toFixed(2)}°`);

// Of the frame: slices that were placed, and those that were not by any cause.
export const slicesOf = ({ slices, end }) =>
  [slices, end ? end.causes.reduce((sum, cause) => sum + cause.slices, 0) : 0];

// A name of the ground: what had its place under another name has lost it. null: this frame does not say.
export function groundOf({ counts, frame }) {
  const end = frame?.classes?.end;
  return end ? [counts.restarts, ...BREAKING.map((one) => end.causes[one].times)].join() : null;
}

// Everything that ever kept something from being placed, the latest first.
export function causesOf(classes) {
  return NAMES.map((name, cause) => ({ name, cause, s: agoOf(classes, cause) }))
      .filter(({ cause }) => classes.end && classes.end.causes[cause].times > 0)
      .sort((a, b) => (a.s ?? LONGEST_S) - (b.s ?? LONGEST_S))
      .map(({ name, cause, s }) => {
        const { times } = classes.end.causes[cause];
        return `${name}${ago(s)}${times > 1 ? `, ${times} times` : ""}`;
      });
}

// The pose of the newest frame that has one, up to the one that is shown; null if none has.
export function lastPlaceOf(frames, shown) {
  for (let i = frames.length - 1; i >= 0; --i) {
    const { number, status: { frame } } = frames[i];
    if (number <= shown.number && frame && frame.classes && frame.classes.has_place) {
      const { x_m: x, y_m: y, heading_deg: heading } = frame.classes;
      return { x, y, heading: heading * Math.PI / 180 };
    }
  }
  return null;
}

// Where the car was in the frames up to the one that is shown, the oldest first: x, y and how many
// seconds ago; null where what was before has lost its place.
export function trackOf(frames, shown) {
  const nowUs = shown.status.frame.closed_us;
  const track = [];
  for (const { number, status: { frame } } of frames) {
    const agoS = frame && frame.classes ? (nowUs - frame.closed_us) / 1e6 : -1;
    if (number > shown.number || agoS < 0 || agoS > TRACK_S) {
      continue;
    }
    const { causes, has_place: isKnown, x_m: x, y_m: y } = frame.classes;
    if ((causes & BREAKS) !== 0) {
      track.push(null);
    }
    const last = track.length > 0 ? track[track.length - 1] : null;
    const isNear = last !== null && Math.hypot(x - last.x, y - last.y) < NEAREST_M;
    if (isKnown && (!isNear || number === shown.number)) {
      track.push({ x, y, agoS });
    }
  }
  return track;
}
