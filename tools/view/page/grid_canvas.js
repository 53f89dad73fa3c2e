// The picture: a grid as an image that is moved, turned and scaled, and what is drawn on it.
//
// It shows the index grid, which is the vehicle's, or the classes of the window, which stand in the
// local frame. There are three kinds of coordinates in metres: of the vehicle, whose x points
// forward; of the ground, which is the local frame; and of the view, whose x points up on the
// screen, y to the left, with the car at its origin. `turn` is how far the car is turned in the
// view, counter-clockwise: not at all, unless the ground stands still.

import { LAYERS, TILES_PER_SIDE, TILE_CELLS, TILE_COUNT, TILE_SIDE } from "./messages.js";
import { CLASS_COUNT, MOVING, classOf, classTable, colourOfClass, css, isSomething, paletteOf,
         pixelTable } from "./palette.js";
import * as overlays from "./overlays.js";
import { TileImage } from "./tile_image.js";

const MIN_SCALE = 0.3; // pixels a cell, or what shows the whole grid
const MAX_SCALE = 40;
const START_HEIGHT = 620; // cells
const USUAL_SHAPE = { cell_m: 0.1, columns: 1024, rows: 1024, origin: [512, 512] };
const shapeOfWindow = ({ cell_m, columns, rows }) =>
  ({ cell_m, columns, rows, origin: [columns / 2, rows / 2] });

const coloursOfMarks = () =>
  Array.from({ length: 8 * CLASS_COUNT }, (_, byte) => css(colourOfClass(byte)));

const modulo = (number, count) => ((number % count) + count) % count;

const rotated = (x, y, angle) => {
  const cos = Math.cos(angle);
  const sin = Math.sin(angle);
  return [cos * x - sin * y, sin * x + cos * y];
};

export class GridCanvas {
  constructor(canvas, grid) {
    this.canvas = canvas;
    this.grid = grid;
    this.context = canvas.getContext("2d", { alpha: false });
    this.vehicle = null;
    this.theme = "dark";
    this.scale = "index";
    this.wantsClasses = null; // where there are any; null: from the first pose on
    this.isStale = false;
    this.overlays = new Set(["mounts", "rings", "ages", "track", "up", "objects", "outlines"]);
    this.track = []; // where the car was: x, y and how many seconds ago, or null where it breaks off
    this.map = null; // what the target says of it, if it ever did
    this.outlines = null; // of the map of this PC, if it has one
    this.place = null; // the vehicle's last pose on the ground, if it ever had one
    this.pose = { x: 0, y: 0, heading: 0 }; // the same, or the middle of the window
    this.centre = { x: 0, y: 0 }; // metres of the view
    this.turn = 0;
    this.pixelsPerMetre = 0;
    this.startedWith = -1; // metres of a cell, 0 before the first frame
    this.isFollowing = true;
    this.names = []; // left, top, right and bottom of each name of an object
    this.mark = null; // the place of the page that a finger has tapped
    this.measured = null; // of measure.js
    this.scaleBar = null; // left, top, right and bottom of where it is drawn
    this.images = { indexes: new TileImage(), classes: new TileImage(), truth: new TileImage() };
    this.restyle();
  }

  // The shape of the grid that is shown, from the stream. In a grid of indexes, `origin` is the
  // cell whose lowest corner is the vehicle's position. The window of classes is placed by its own
  // corner, and the vehicle is near its middle.
  get shape() {
    return this.showsClasses ? shapeOfWindow(this.grid.classes)
                             : this.grid.frame?.status.frame?.grid ?? USUAL_SHAPE;
  }

  get cellM() {
    return this.showsClasses ? this.grid.classes.cell_m
                             : (this.grid.frame?.status.frame?.grid ?? USUAL_SHAPE).cell_m;
  }

  // Epsilon from the stream, or null if no indexes have arrived.
  get epsilon() {
    return this.vehicle ? this.vehicle.epsilon : null;
  }

  // Without it no index has a probability.
  get shownScale() {
    return this.epsilon === null ? "index" : this.scale;
  }

  get showsClasses() {
    const { classes, frame } = this.grid;
    return classes !== null && (!frame.status.frame.sends_indexes ||
                                (this.wantsClasses ?? this.place !== null));
  }

  // What is unknown is dark in a picture of classes, whatever the theme of the page.
  get palette() {
    return paletteOf(this.pictureTheme);
  }

  get pictureTheme() {
    return this.showsClasses ? "dark" : this.theme;
  }

  // Whether it is known where the car is; the index grid needs no place.
  get hasPlace() {
    return !this.showsClasses || this.grid.classes.has_place;
  }

  // By tile of what is shown, frames since it came.
  get ages() {
    return this.showsClasses ? this.grid.classAges : this.grid.ages;
  }

  // After a change of theme, scale, vehicle, overlays or state.
  restyle() {
    this.table = pixelTable(this.theme, this.shownScale, this.epsilon, this.isStale);
    this.classTable = classTable(this.isStale);
    this.markColours = this.isStale ? null : coloursOfMarks();
    this.grid.redrawAll();
    Object.values(this.images).forEach((image) => (image.painted = ""));
  }

  resize() {
    const ratio = window.devicePixelRatio || 1;
    const { clientWidth, clientHeight } = this.canvas;
    const width = Math.max(1, Math.round(clientWidth * ratio));
    const height = Math.max(1, Math.round(clientHeight * ratio));
    if (width !== this.canvas.width || height !== this.canvas.height) {
      this.canvas.width = width;
      this.canvas.height = height;
    }
    this.ratio = ratio;
    this.width = clientWidth;
    this.height = clientHeight;
    const start = this.grid.frame ? this.cellM : 0;
    if (this.startedWith !== start && clientHeight > 0) {
      this.startedWith = start;
      this.zoomToStreet();
    }
  }

  // With the car in the middle; a smaller grid is seen as a whole, and of a short one as much to the
  // sides as else ahead and behind.
  zoomToStreet() {
    const { origin: [behind, right], columns, rows } = this.shape;
    const around = (before, cells) =>
      Math.min(START_HEIGHT, 2 * Math.max(before, cells - before) + 1);
    const high = around(behind, columns);
    const scale = this.height / high;
    this.pixelsPerMetre = (high < START_HEIGHT ? Math.min(scale, this.width / around(right, rows))
                                               : scale) / this.cellM;
  }

  // Where the car is now, and how it is turned. What is in the middle of the view stays there, as
  // long as the ground stands still and the car is not followed.
  takePose() {
    const before = this.pose;
    const isFixed = this.showsClasses && !this.overlays.has("up");
    this.pose = this.place ?? this.middleOfWindow();
    this.turn = isFixed ? this.pose.heading : 0;
    if (isFixed && !this.isFollowing) {
      this.centre.x -= this.pose.x - before.x;
      this.centre.y -= this.pose.y - before.y;
      this.keepInSight();
    }
  }

  middleOfWindow() {
    const { corner_a: a = 0, corner_b: b = 0 } = this.grid.classes ?? {};
    const { columns, rows } = this.shape;
    const metres = (corner, cells) => (corner * TILE_SIDE + cells / 2) * this.cellM;
    return { x: metres(a, columns), y: metres(b, rows), heading: 0 };
  }

  // How far the picture's x is turned in the view.
  get pictureTurn() {
    return this.showsClasses ? this.turn - this.pose.heading : 0;
  }

  // From metres of the view to pixels of the page and back.
  project([x, y]) {
    return [this.width / 2 - (y - this.centre.y) * this.pixelsPerMetre,
            this.height / 2 - (x - this.centre.x) * this.pixelsPerMetre];
  }

  toMetres(column, row) {
    return { x: this.centre.x + (this.height / 2 - row) / this.pixelsPerMetre,
             y: this.centre.y + (this.width / 2 - column) / this.pixelsPerMetre };
  }

  // From metres of the vehicle and of the ground to pixels of the page.
  toScreen(x, y) {
    return this.project(rotated(x, y, this.turn));
  }

  groundToScreen(x, y) {
    return this.project(rotated(x - this.pose.x, y - this.pose.y, this.pictureTurn));
  }

  // From cells of the picture, whose x and y begin at its lowest corner, to pixels of the page.
  cellToScreen(x, y) {
    const { classes } = this.grid;
    return this.showsClasses
        ? this.groundToScreen((classes.corner_a * TILE_SIDE + x) * this.cellM,
                              (classes.corner_b * TILE_SIDE + y) * this.cellM)
        : this.toScreen((x - this.shape.origin[0]) * this.cellM,
                        (y - this.shape.origin[1]) * this.cellM);
  }

  // What is at a place of the page: its place in metres of the vehicle, x and y of its cell in the
  // picture, and the number of that cell in its layer. null outside of the grid.
  cellAt(column, row) {
    const { x, y } = this.toMetres(column, row);
    const vehicle = rotated(x, y, -this.turn);
    const place = this.showsClasses ? this.windowPlaceOf(vehicle) : vehicle.map(
        (metres, axis) => metres / this.cellM + this.shape.origin[axis]);
    const [cellX, cellY] = place.map(Math.floor);
    const { columns, rows } = this.shape;
    const isInside = cellX >= 0 && cellX < columns && cellY >= 0 && cellY < rows;
    return isInside ? { x: cellX, y: cellY, vehicle, number: this.numberOf(cellX, cellY) } : null;
  }

  windowPlaceOf(vehicle) {
    const { corner_a: a, corner_b: b } = this.grid.classes;
    const [x, y] = this.toGround(vehicle);
    return [x / this.cellM - a * TILE_SIDE, y / this.cellM - b * TILE_SIDE];
  }

  // From metres of the vehicle to those of the ground and back.
  toGround([x, y]) {
    const [right, up] = rotated(x, y, this.pose.heading);
    return [this.pose.x + right, this.pose.y + up];
  }

  fromGround([x, y]) {
    return rotated(x - this.pose.x, y - this.pose.y, -this.pose.heading);
  }

  // The middle of a cell of the picture in metres of the vehicle.
  middleOf({ x, y }) {
    const { corner_a: a, corner_b: b } = this.grid.classes ?? {};
    const metres = (first, cell) => (first + cell + 0.5) * this.cellM;
    return this.showsClasses ? this.fromGround([metres(a * TILE_SIDE, x), metres(b * TILE_SIDE, y)])
                             : [metres(-this.shape.origin[0], x), metres(-this.shape.origin[1], y)];
  }

  // The layer's tiles of a row, its most rows, and the place in the layer of the picture's first
  // tile. Tiles of the window lie by slot.
  get tiles() {
    const { corner_a: a, corner_b: b } = this.grid.classes ?? {};
    return this.showsClasses ? { across: TILES_PER_SIDE, up: TILES_PER_SIDE, a, b }
                             : { across: this.shape.columns / TILE_SIDE, up: TILE_COUNT, a: 0, b: 0 };
  }

  // Of a cell of the picture its number in the layer.
  numberOf(x, y) {
    const { across, up, a, b } = this.tiles;
    const tile = modulo(b + (y >> 5), up) * across + modulo(a + (x >> 5), across);
    return tile * TILE_CELLS + (y & 31) * TILE_SIDE + (x & 31);
  }

  // Of a tile of the layer its column and row of tiles in the picture.
  placeOf(tile) {
    const { across, up, a, b } = this.tiles;
    return [modulo(tile % across - a, across), modulo(Math.floor(tile / across) - b, up)];
  }

  pan(columns, rows) {
    this.isFollowing = false;
    this.centre.x += rows / this.pixelsPerMetre;
    this.centre.y += columns / this.pixelsPerMetre;
    this.keepInSight();
  }

  // Around a place of the page, which stays where it is; around the car while it is followed.
  zoom(factor, column = this.width / 2, row = this.height / 2) {
    const before = this.toMetres(column, row);
    const least = Math.min(MIN_SCALE / this.cellM, this.scaleOfAll);
    this.pixelsPerMetre =
        Math.min(MAX_SCALE / this.cellM, Math.max(least, this.pixelsPerMetre * factor));
    if (!this.isFollowing) {
      const after = this.toMetres(column, row);
      this.centre.x += before.x - after.x;
      this.centre.y += before.y - after.y;
      this.keepInSight();
    }
  }

  keepInSight() {
    const { origin, columns, rows } = this.shape;
    const clamped = (metres, first, cells) =>
      Math.min((cells - first) * this.cellM, Math.max(-first * this.cellM, metres));
    this.centre.x = clamped(this.centre.x, origin[0], columns);
    this.centre.y = clamped(this.centre.y, origin[1], rows);
  }

  follow() {
    this.isFollowing = true;
    this.centre = { x: 0, y: 0 };
  }

  // Pixels of a metre when the whole grid is seen.
  get scaleOfAll() {
    const { columns, rows } = this.shape;
    return Math.min(this.width / (rows * this.cellM + 1),
                    this.height / (columns * this.cellM + 1));
  }

  showAll() {
    const { origin, columns, rows } = this.shape;
    this.follow();
    this.centre = { x: (columns / 2 - origin[0]) * this.cellM,
                    y: (rows / 2 - origin[1]) * this.cellM };
    this.pixelsPerMetre = this.scaleOfAll;
  }

  showStreet() {
    this.follow();
    this.zoomToStreet();
  }

  // A name of the frame that is shown and of where its tiles lie: what has the same name looks alike.
  get pictureName() {
    const { a, b, across } = this.tiles;
    return `${this.grid.version} ${a} ${b} ${across} ${this.shape.columns} ${this.shape.rows}`;
  }

  // Brings an image up to a layer of the frame that is shown.
  paint(image, layer, table, isMarked) {
    const corner = this.pictureName.replace(/^\d+/, "");
    if (image.corner !== corner) {
      image.corner = corner; // all tiles have moved
      this.grid.changed[layer].fill(1);
    }
    image.paint(this.pictureName, this.grid.layers[layer], this.grid.changed[layer],
                { table, isMarked, shape: this.shape, placeOf: (tile) => this.placeOf(tile) });
    return image;
  }

  paintPicture() {
    return this.showsClasses
        ? this.paint(this.images.classes, LAYERS.CLASSES, this.classTable, isSomething)
        : this.paint(this.images.indexes, LAYERS.INDEXES, this.table, (index) => index > 0);
  }

  draw() {
    this.resize();
    if (this.width === 0 || this.height === 0) {
      return;
    }
    this.takePose();
    this.shown = this.paintPicture();
    const { context, palette } = this;
    context.setTransform(this.ratio, 0, 0, this.ratio, 0, 0);
    context.fillStyle = palette.outside;
    context.fillRect(0, 0, this.width, this.height);
    this.drawImage(this.shown);
    this.inPicture((width, height) => {
      context.strokeStyle = palette.gridEdge;
      context.lineWidth = 1;
      context.strokeRect(0, 0, width, height);
    });
    overlays.draw(this);
  }

  // Calls paint(width, height) with the picture's upper left corner as the origin and its edges
  // along the axes.
  inPicture(paint) {
    const { context } = this;
    const { columns, rows, cell_m: cellM } = this.shape;
    context.save();
    context.translate(...this.cellToScreen(columns, rows));
    context.rotate(-this.pictureTurn);
    paint(rows * cellM * this.pixelsPerMetre, columns * cellM * this.pixelsPerMetre);
    context.restore();
  }

  // Calls paint with the car as the origin and up as forward.
  inVehicle(paint) {
    const { context } = this;
    context.save();
    context.translate(...this.toScreen(0, 0));
    context.rotate(-this.turn);
    paint(this.pixelsPerMetre);
    context.restore();
  }

  // An image of the whole grid. A cell that is turned has ragged edges, unless it is large.
  drawImage({ canvas }) {
    const { context } = this;
    const { rows } = this.shape;
    this.inPicture((width, height) => {
      context.imageSmoothingEnabled = width / rows < (this.pictureTurn === 0 ? 1 : 2.5);
      context.imageSmoothingQuality = "medium";
      context.drawImage(canvas, 0, 0, width, height);
    });
  }

  // So that a hit is seen from afar, too: occupied cells are at least so many pixels wide, and what
  // moves is wider, and on top.
  drawMarks() {
    const grey = css(this.palette.occupiedStale);
    if (!this.showsClasses) {
      const colour = this.isStale ? grey : this.palette.mark;
      this.drawMarksOf(2.4, () => true, () => colour);
      return;
    }
    const colour = this.isStale ? () => grey : (byte) => this.markColours[byte];
    this.drawMarksOf(2.4, (byte) => classOf(byte) !== MOVING, colour);
    this.drawMarksOf(3.2, (byte) => classOf(byte) === MOVING, colour);
  }

  drawMarksOf(smallest, isWanted, colourOf) {
    const { context } = this;
    if (this.pixelsPerMetre * this.cellM >= smallest) {
      return;
    }
    const [column, row] = this.cellToScreen(0.5, 0.5);
    const [columnX, rowX] = this.cellToScreen(1.5, 0.5).map((to, i) => to - [column, row][i]);
    const [columnY, rowY] = this.cellToScreen(0.5, 1.5).map((to, i) => to - [column, row][i]);
    let last = null;
    for (const marks of this.shown.marks) {
      for (let i = 0; i < (marks ? marks.length : 0); i += 3) {
        const value = marks[i + 2];
        if (!isWanted(value)) {
          continue;
        }
        if (value !== last) {
          context.fillStyle = colourOf(value);
          last = value;
        }
        const [x, y] = [marks[i], marks[i + 1]];
        context.fillRect(column + x * columnX + y * columnY - smallest / 2,
                         row + x * rowX + y * rowY - smallest / 2, smallest, smallest);
      }
    }
  }
}
