// A layer of tiles as an image, in which x points up and y to the left. Only tiles that have changed
// are painted anew.

import { TILE_CELLS, TILE_SIDE } from "./messages.js";

export class TileImage {
  constructor() {
    this.canvas = document.createElement("canvas");
    this.context = this.canvas.getContext("2d", { willReadFrequently: true });
    this.columns = this.rows = 0; // of the grid; the canvas is as wide as the grid has rows
    this.marks = []; // of each tile the cells that are marked: column, row and value, one after the other
    this.seen = new Uint8Array(256); // values that were ever in it, as unsigned bytes
    this.painted = ""; // what the image shows
  }

  // name: of what is to be shown; what has that name already is not painted again.
  // table: pixels by value. placeOf(tile): its column and row of tiles in the picture, which may lie
  // outside. isMarked(value). shape: of the picture; with another one, all tiles must have changed.
  paint(name, cells, changed, { table, placeOf, isMarked, shape }) {
    if (name === this.painted) {
      return;
    }
    this.painted = name;
    this.resize(shape);
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

  resize({ columns, rows }) {
    if (columns !== this.columns || rows !== this.rows) {
      [this.columns, this.rows] = [columns, rows];
      Object.assign(this.canvas, { width: rows, height: columns });
      this.pixels = this.context.createImageData(rows, columns);
      this.words = new Uint32Array(this.pixels.data.buffer);
    }
  }

  paintTile(tile, [tileX, tileY], cells, table, isMarked) {
    const { words, seen, columns, rows } = this;
    const [firstX, firstY] = [tileX * TILE_SIDE, tileY * TILE_SIDE];
    if (firstX >= columns || firstY >= rows) {
      return [];
    }
    let cell = tile * TILE_CELLS;
    const marks = [];
    for (let row = 0; row < TILE_SIDE; ++row) {
      let pixel = (columns - 1 - firstX) * rows + rows - 1 - firstY - row;
      for (let column = 0; column < TILE_SIDE; ++column) {
        const value = cells[cell];
        words[pixel] = table[value & 0xff];
        seen[value & 0xff] = 1;
        if (isMarked(value)) {
          marks.push(firstX + column, firstY + row, value);
        }
        pixel -= rows;
        cell += 1;
      }
    }
    return marks;
  }
}
