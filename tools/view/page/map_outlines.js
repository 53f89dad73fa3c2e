// The outlines of a map, read from its block as it is (docs/spec.md, section 6). The server has
// checked the block whole before it serves it.

const HEADER_BYTES = 64;
const BUCKET_CM = 2560;
const FEATURE_HEADER_BYTES = 24;
const ROAD = 2;
const REACH_CM = 7500; // from the middle of the window to its corners, and a little more

const rotated = ([x, y], angle) =>
  [Math.cos(angle) * x - Math.sin(angle) * y, Math.sin(angle) * x + Math.cos(angle) * y];

class MapOutlines {
  constructor(buffer) {
    const view = new DataView(buffer);
    const numbers = (at) => [0, 4, 8, 12].map((i) => view.getInt32(at + i));
    const [lowX, lowY, highX, highY] = numbers(32);
    const buckets = (Math.floor((highX - lowX) / BUCKET_CM) + 1) *
                    (Math.floor((highY - lowY) / BUCKET_CM) + 1);
    const startsAt = HEADER_BYTES + Math.ceil(view.getUint16(60) / 4) * 4;
    const entriesAt = startsAt + 4 * (buckets + 1);
    const offsetsAt = entriesAt + 4 * view.getUint32(entriesAt - 4);
    this.crc = view.getUint32(12).toString(16).padStart(8, "0");
    this.features = Array.from({ length: view.getUint32(56) }, (_, i) => {
      const at = view.getUint32(offsetsAt + 4 * i);
      return { isRoad: view.getUint8(at) === ROAD, box: numbers(at + 8), rings: ringsOf(view, at) };
    });
  }

  // Calls visit(feature) for each whose box comes near that place, in centimetres of the plane.
  forEachNear(x, y, visit) {
    for (const feature of this.features) {
      const [lowX, lowY, highX, highY] = feature.box;
      if (lowX <= x + REACH_CM && highX >= x - REACH_CM && lowY <= y + REACH_CM &&
          highY >= y - REACH_CM) {
        visit(feature);
      }
    }
  }
}

export const fetchOutlines = async () =>
  new MapOutlines(await (await fetch("/map.iogmap")).arrayBuffer());

// Each a list of x, y, x, y ... in centimetres.
function ringsOf(view, at) {
  const rings = [];
  let next = at + FEATURE_HEADER_BYTES;
  for (let ring = view.getUint16(at + 2); ring > 0; --ring) {
    const points = new Float64Array(2 * view.getUint32(next));
    points[0] = view.getInt32(next + 4);
    points[1] = view.getInt32(next + 8);
    next += 12;
    for (let i = 2; i < points.length; i += 2, next += 4) {
      points[i] = points[i - 2] + view.getInt16(next);
      points[i + 1] = points[i - 1] + view.getInt16(next + 2);
    }
    rings.push(points);
  }
  return rings;
}

// Whether they are those by which the target names what is seen: it uses this very block, and knows
// where it is in its plane.
export const areInUse = (outlines, map) =>
  outlines !== null && map !== null && map.in_use && map.cause === "" && map.transform !== null &&
  map.crc === outlines.crc;

// Roads below houses. What is far away in the plane is exact: numbers are doubles until they are
// pixels.
export function drawOutlines(view) {
  const { context, palette, outlines, map } = view;
  if (!areInUse(outlines, map)) {
    return;
  }
  const { x_m: x0, y_m: y0, heading_rad: heading } = map.transform;
  const toScreen = (x, y) =>
    view.groundToScreen(...rotated([x / 100 - x0, y / 100 - y0], -heading));
  const middle = view.middleOfWindow();
  const [right, up] = rotated([middle.x, middle.y], heading);
  const near = [[], []];
  outlines.forEachNear((x0 + right) * 100, (y0 + up) * 100, (feature) =>
    near[feature.isRoad ? 0 : 1].push(feature));
  [palette.mapRoad, palette.mapHouse].forEach((colour, kind) => {
    context.beginPath();
    for (const { rings } of near[kind]) {
      rings.forEach((points) => addRing(context, points, toScreen));
    }
    // Ground is light where it is free and dark where it is unknown.
    context.strokeStyle = palette.trackEdge;
    context.lineWidth = 3;
    context.stroke();
    context.strokeStyle = colour;
    context.lineWidth = 1.4;
    context.stroke();
  });
}

function addRing(context, points, toScreen) {
  for (let i = 0; i < points.length; i += 2) {
    const place = toScreen(points[i], points[i + 1]);
    if (i === 0) {
      context.moveTo(...place);
    } else {
      context.lineTo(...place);
    }
  }
  context.closePath();
}
