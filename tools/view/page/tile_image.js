// A layer of tiles as an image, in which x points up and y to the left. Only tiles that have changed
// are painted anew.

import { SIDE, TILES_PER_SIDE, TILE_SIDE } from "./messages.js";

export class TileImage {
  constructor() {
    this.canvas = Object.assign(document.createElement("canvas"), { width: SIDE, height: SIDE });
    this.context = this.canvas.getContext("2d", { willReadFrequently: true });
    this.pixels = this.context.createImageData(SIDE, SIDE);
    this.words = new Uint32Array(this.pixels.data.buffer);
    this.marks = []; // of each tile the cells that are marked: column, row and value, one after the other
    this.seen = new Uint8Array(256); // values that were ever in it, as unsigned bytes
    this.painted = ""; // what the image shows
  }

  // name: of what is to be shown; what has that name already is not painted again.
  // table: pixels by value. placeOf(tile): its number in the picture. isMarked(value).
  paint(name, cells, changed, { table, placeOf, isMarked }) {
    if (name === this.painted) {
      return;
    }
    this.painted = name;
    let any = false;
    for (let tile = 0; tile < changed.length; ++tile) {
      if (changed[tile] !== 0) {
        changed[tile] = 0;
        any = true;
        this.marks[tile] = this.paintTile(tile, placeOf(tile), cells, table, isMarked);
      }
    }
    if (any) {
      this.context.putImageData(this.pixels, 0, 0);
    }
  }

  paintTile(tile, place, cells, table, isMarked) {
    const { words, seen } = this;
    const from = Math.floor(tile / TILES_PER_SIDE) * TILE_SIDE * SIDE +
                 (tile % TILES_PER_SIDE) * TILE_SIDE;
    const firstX = (place % TILES_PER_SIDE) * TILE_SIDE;
    const firstY = Math.floor(place / TILES_PER_SIDE) * TILE_SIDE;
    const marks = [];
    for (let row = 0; row < TILE_SIDE; ++row) {
      let pixel = (SIDE - 1 - firstX) * SIDE + SIDE - 1 - firstY - row;
      let cell = from + row * SIDE;
      for (let column = 0; column < TILE_SIDE; ++column) {
        const value = cells[cell];
        words[pixel] = table[value & 0xff];
        seen[value & 0xff] = 1;
        if (isMarked(value)) {
          marks.push(firstX + column, firstY + row, value);
        }
        pixel -= SIDE;
        cell += 1;
      }
    }
    return marks;
  }
}
