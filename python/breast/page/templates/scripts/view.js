// A mammogram on a canvas: pose on the screen, window and level. u grows from the chest wall; a right breast is hung mirrored
// with its chest wall at the right edge.
const sharp = () => Math.min(window.devicePixelRatio || 1, 2);
class View {
  constructor(k) {
    this.k = k;
    this.image = data.images[k];
    this.canvas = document.getElementById('view-' + k);
    this.grey = this.image.grey;
    this.width = this.image.width * this.image.pixel;
    this.height = this.image.height * this.image.pixel;
    this.picture = document.createElement('canvas');
    this.picture.width = this.image.width;
    this.picture.height = this.image.height;
    this.cursor = null;  // u, v of pointer or keys
    const name = this.image.view + ', ' + data.side + ' breast';
    document.getElementById('name-' + k).textContent = name;
    this.canvas.setAttribute('aria-label', name + ': arrow keys move the cross, Enter keeps the point');
    this.reset();
  }
  reset() {
    Object.assign(this, {zoom: 1, x: 0, y: 0, window: {...fullWindow}, stale: true});
  }
  // Called before drawing: the backing store follows the box, the whole image fits at zoom 1.
  fit() {
    this.w = this.canvas.clientWidth;
    this.h = this.canvas.clientHeight;
    const ratio = sharp(), w = Math.round(this.w * ratio), h = Math.round(this.h * ratio);
    if (this.canvas.width !== w || this.canvas.height !== h) Object.assign(this.canvas, {width: w, height: h});
    // Both views have one scale, that at which the larger image fits.
    this.base = Math.min(...views.map(({canvas, width, height}) => Math.min(canvas.clientWidth / width, canvas.clientHeight / height)));
    this.hold();
    this.canvas.style.touchAction = this.zoom > 1 || windowing ? 'none' : 'pan-y';
  }
  get scale() { return this.base * this.zoom; }
  // The image may not leave its box; where it is smaller the chest wall stands at the edge.
  hold() {
    const w = this.width * this.scale, h = this.height * this.scale;
    this.x = w <= this.w ? (left ? 0 : this.w - w) : Math.min(0, Math.max(this.w - w, this.x));
    this.y = h <= this.h ? (this.h - h) / 2 : Math.min(0, Math.max(this.h - h, this.y));
  }
  pan(dx, dy) {
    this.x += dx;
    this.y += dy;
    this.hold();
  }
  // The other view follows, about its middle.
  zoomAt(factor, x = this.w / 2, y = this.h / 2) {
    const zoom = Math.min(12, Math.max(1, this.zoom * factor));
    for (const view of views) view === this ? view.zoomTo(zoom, x, y) : view.zoomTo(zoom, view.w / 2, view.h / 2);
  }
  zoomTo(zoom, x, y) {
    const ratio = zoom / this.zoom;
    this.zoom = zoom;
    this.x = x - (x - this.x) * ratio;
    this.y = y - (y - this.y) * ratio;
    this.hold();
  }
  changeWindow(wider, higher) {
    rewindow(this.window, wider, higher);
    this.stale = true;
  }
  toScreen(u, v) {
    if (!left) { u = this.image.u_mm - u; v = this.image.v_mm - v; }
    return [this.x + (u + this.image.pixel / 2) * this.scale, this.y + (v + this.image.pixel / 2) * this.scale];
  }
  toImage(x, y) {
    let u = (x - this.x) / this.scale - this.image.pixel / 2, v = (y - this.y) / this.scale - this.image.pixel / 2;
    if (!left) { u = this.image.u_mm - u; v = this.image.v_mm - v; }
    return [u, v];
  }
  place(event) {
    const box = this.canvas.getBoundingClientRect();
    return [event.clientX - box.left - this.canvas.clientLeft, event.clientY - box.top - this.canvas.clientTop];
  }
  // Grey values through window and level, only when these have changed.
  develop() {
    if (!this.stale) return;
    const table = developed(this.window, 4096);
    const pixels = new ImageData(this.image.width, this.image.height), out = new Uint32Array(pixels.data.buffer);
    for (let i = 0; i < this.grey.length; ++i) out[i] = table[this.grey[i] >> 4];
    this.picture.getContext('2d').putImageData(pixels, 0, 0);
    this.stale = false;
  }
  draw() {
    this.fit();
    this.develop();
    const pen = this.pen = this.canvas.getContext('2d'), ratio = sharp();
    pen.setTransform(ratio, 0, 0, ratio, 0, 0);
    pen.fillStyle = '#000';
    pen.fillRect(0, 0, this.w, this.h);
    pen.imageSmoothingEnabled = this.scale * this.image.pixel < 3;
    pen.drawImage(this.picture, this.x, this.y, this.width * this.scale, this.height * this.scale);
  }
}
let windowing = false;
const views = [0, 1].map(k => new View(k));
