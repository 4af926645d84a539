// The curve of any point of one image in the other, between the nodes of a grid. Lengths are packed in 0.01 mm.
class Lookup {
  constructor(packed) {
    Object.assign(this, packed);
    // Nodes in air have no place in the arrays: place[node] counts those in tissue before it.
    this.place = new Uint32Array(this.status.length);
    for (let node = 0, count = 0; node < this.status.length; ++node) {
      this.place[node] = count;
      if (this.status[node]) ++count;
    }
  }
  corners(u, v) {
    const x = u / this.pitch, y = v / this.pitch;
    if (x < 0 || y < 0 || x > this.nu - 1 || y > this.nv - 1) return null;
    const i = Math.max(0, Math.min(Math.floor(x), this.nu - 2)), j = Math.max(0, Math.min(Math.floor(y), this.nv - 2));
    const f = x - i, g = y - j;
    return [[i, j, (1 - f) * (1 - g)], [i + 1, j, f * (1 - g)], [i, j + 1, (1 - f) * g], [i + 1, j + 1, f * g]]
        .map(c => ({node: c[1] * this.nu + c[0], weight: c[2]}));
  }
  tissueAt(u, v) {
    const corners = this.corners(u, v);
    return !!corners && this.status[nearestOf(corners).node] > 0;
  }
  // Between four nodes in tissue by bilinear weights; else the nearest node alone.
  find(u, v) {
    const corners = this.corners(u, v);
    if (!corners) return null;
    const nearest = nearestOf(corners), kind = this.status[nearest.node];
    if (kind === 0) return {kind};
    const used = corners.every(c => this.status[c.node]) ? corners : [{node: nearest.node, weight: 1}];
    const mean = (values, width, k, c, unit) => unit * used.reduce(
        (sum, corner) => sum + corner.weight * values[(this.place[corner.node] * this.samples + k) * width + c], 0);
    const ofNode = values => used.reduce((sum, c) => sum + c.weight * values[this.place[c.node]] / 100, 0);
    const found = {kind, curve: [], deviation: [], column: [], depth: ofNode(this.depth), length: ofNode(this.length)};
    for (let k = 0; k < this.samples; ++k) {
      found.curve.push([0, 1].map(c => mean(this.curve, 2, k, c, 0.01)));
      found.deviation.push(mean(this.deviation, 1, k, 0, 0.01));
      found.column.push([0, 1, 2].map(c => mean(this.imaged, 3, k, c, 0.01) + data.body.middle[c]));
    }
    return found;
  }
}
const sides90 = 1.6449;  // standard deviations to either side that hold 90 %
const nearestOf = corners => corners.reduce((a, b) => b.weight > a.weight ? b : a);
const lookups = data.lookups.map(packed => new Lookup(packed));
