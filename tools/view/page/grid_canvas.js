// The picture: the grid as an image that is moved and scaled, and what is drawn on it.
//
// Seen from above, the car drives upwards: x of the vehicle frame points up, y to the left.

import { SIDE, TILES_PER_SIDE, TILE_SIDE } from "./messages.js";
import { css, paletteOf, pixelTable } from "./palette.js";
import * as overlays from "./overlays.js";

const MIN_SCALE = 3; // pixels a metre
const MAX_SCALE = 400;
const START_HEIGHT_M = 62;

export class GridCanvas {
  constructor(canvas, grid) {
    this.canvas = canvas;
    this.grid = grid;
    this.context = canvas.getContext("2d", { alpha: false });
    this.vehicle = null;
    this.theme = "dark";
    this.scale = "index";
    this.isStale = false;
    this.overlays = new Set(["mounts", "rings", "ages"]);
    this.centre = { x: 0, y: 0 }; // metres
    this.pixelsPerMetre = 0;
    this.isFollowing = true;
    this.scaleBar = null; // left, top, right and bottom of where it is drawn
    this.drawn = -1; // version of the grid that the image holds
    this.image = document.createElement("canvas");
    this.image.width = SIDE;
    this.image.height = SIDE;
    this.imageContext = this.image.getContext("2d", { alpha: false, willReadFrequently: true });
    this.pixels = this.imageContext.createImageData(SIDE, SIDE);
    this.words = new Uint32Array(this.pixels.data.buffer);
    this.occupied = []; // of each tile, the numbers of its occupied cells
    this.restyle();
  }

  get cellM() {
    return this.vehicle ? this.vehicle.cell_m : 0.1;
  }

  get epsilon() {
    return this.vehicle ? this.vehicle.epsilon : 0.05;
  }

  get palette() {
    return paletteOf(this.theme);
  }

  // After a change of theme, scale, vehicle or state.
  restyle() {
    this.table = pixelTable(this.theme, this.scale, this.epsilon, this.isStale);
    this.grid.changed.fill(1);
    this.drawn = -1;
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
    if (this.pixelsPerMetre === 0 && clientHeight > 0) {
      this.pixelsPerMetre = clientHeight / START_HEIGHT_M;
    }
  }

  // From metres in the vehicle frame to pixels of the page and back.
  toScreen(x, y) {
    return [this.width / 2 - (y - this.centre.y) * this.pixelsPerMetre,
            this.height / 2 - (x - this.centre.x) * this.pixelsPerMetre];
  }

  toMetres(column, row) {
    return { x: this.centre.x + (this.height / 2 - row) / this.pixelsPerMetre,
             y: this.centre.y + (this.width / 2 - column) / this.pixelsPerMetre };
  }

  // The cell at a place of the page; null outside of the grid.
  cellAt(column, row) {
    const { x, y } = this.toMetres(column, row);
    const cellX = Math.floor(x / this.cellM) + SIDE / 2;
    const cellY = Math.floor(y / this.cellM) + SIDE / 2;
    const isInside = cellX >= 0 && cellX < SIDE && cellY >= 0 && cellY < SIDE;
    return isInside ? { x: cellX, y: cellY } : null;
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
    this.pixelsPerMetre =
        Math.min(MAX_SCALE, Math.max(MIN_SCALE, this.pixelsPerMetre * factor));
    if (!this.isFollowing) {
      const after = this.toMetres(column, row);
      this.centre.x += before.x - after.x;
      this.centre.y += before.y - after.y;
      this.keepInSight();
    }
  }

  keepInSight() {
    const reach = SIDE / 2 * this.cellM;
    this.centre.x = Math.min(reach, Math.max(-reach, this.centre.x));
    this.centre.y = Math.min(reach, Math.max(-reach, this.centre.y));
  }

  follow() {
    this.isFollowing = true;
    this.centre = { x: 0, y: 0 };
  }

  showAll() {
    this.follow();
    this.pixelsPerMetre = Math.min(this.width, this.height) / (SIDE * this.cellM + 1);
  }

  showStreet() {
    this.follow();
    this.pixelsPerMetre = this.height / START_HEIGHT_M;
  }

  // Brings the image up to the grid that is shown.
  paintTiles() {
    const { cells, changed } = this.grid;
    let any = false;
    for (let tile = 0; tile < changed.length; ++tile) {
      if (changed[tile] === 0) {
        continue;
      }
      changed[tile] = 0;
      any = true;
      this.paintTile(tile, cells);
    }
    if (any) {
      this.imageContext.putImageData(this.pixels, 0, 0);
    }
    this.drawn = this.grid.version;
  }

  paintTile(tile, cells) {
    const { words, table } = this;
    const firstX = (tile % TILES_PER_SIDE) * TILE_SIDE;
    const firstY = Math.floor(tile / TILES_PER_SIDE) * TILE_SIDE;
    const occupied = [];
    for (let y = firstY; y < firstY + TILE_SIDE; ++y) {
      let pixel = (SIDE - 1 - firstX) * SIDE + SIDE - 1 - y;
      let cell = y * SIDE + firstX;
      for (let i = 0; i < TILE_SIDE; ++i) {
        const index = cells[cell];
        words[pixel] = table[index & 0xff];
        if (index > 0) {
          occupied.push(cell);
        }
        pixel -= SIDE;
        cell += 1;
      }
    }
    this.occupied[tile] = occupied;
  }

  draw() {
    this.resize();
    if (this.width === 0 || this.height === 0) {
      return;
    }
    if (this.drawn !== this.grid.version) {
      this.paintTiles();
    }
    const { context, palette } = this;
    context.setTransform(this.ratio, 0, 0, this.ratio, 0, 0);
    context.fillStyle = palette.outside;
    context.fillRect(0, 0, this.width, this.height);
    this.drawImage(this.image);
    const half = SIDE / 2 * this.cellM;
    const [left, top] = this.toScreen(half, half);
    const side = 2 * half * this.pixelsPerMetre;
    context.strokeStyle = palette.gridEdge;
    context.lineWidth = 1;
    context.strokeRect(left, top, side, side);
    overlays.draw(this);
  }

  // An image of the whole grid.
  drawImage(image) {
    const { context } = this;
    const half = SIDE / 2 * this.cellM;
    const [left, top] = this.toScreen(half, half);
    const side = 2 * half * this.pixelsPerMetre;
    context.imageSmoothingEnabled = this.pixelsPerMetre * this.cellM < 1;
    context.imageSmoothingQuality = "medium";
    context.drawImage(image, left, top, side, side);
  }

  // So that a hit is seen from afar, too: occupied cells are at least so many pixels wide.
  drawMarks() {
    const smallest = 2.4;
    const size = this.pixelsPerMetre * this.cellM;
    if (size >= smallest) {
      return;
    }
    const { context } = this;
    context.fillStyle = this.isStale ? css(this.palette.occupiedStale) : this.palette.mark;
    for (const cells of this.occupied) {
      for (const cell of cells || []) {
        const [column, row] = this.toScreen(((cell % SIDE) - SIDE / 2 + 0.5) * this.cellM,
                                            (Math.floor(cell / SIDE) - SIDE / 2 + 0.5) *
                                                this.cellM);
        context.fillRect(column - smallest / 2, row - smallest / 2, smallest, smallest);
      }
    }
  }
}
