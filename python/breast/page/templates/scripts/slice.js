// The axial slice of the scan that holds the chosen place of the column, anterior at the top and the patient's left at the right, as
// slices are read. The column's part in the slice is drawn thick, the rest thin.
const slice = (() => {
  const scan = data.scan, canvas = document.getElementById('slice'), name = document.getElementById('slice-name');
  if (!scan) {
    document.getElementById('slice-figure').hidden = true;
    document.getElementById('slice-figure').style.display = 'none';
    document.getElementById('aside').className = 'alone';
    return {draw() {}, follow() {}, step() {}, changeWindow() {}, reset() {}, canvas, at: null};
  }
  const grey = scan.grey, [nx, ny, nz] = scan.size, [dx, dy, dz] = scan.spacing, [x0, y0, z0] = scan.origin;
  const picture = document.createElement('canvas');
  Object.assign(picture, {width: nx, height: ny});
  const centre = data.body.landmarks.find(mark => mark.name !== 'nipple') || data.body.landmarks[0];
  const shades = {width: 1, level: 0.5};
  let k = -1, stale = true, wanted = Math.round(((centre ? centre.at[2] : data.body.middle[2]) - z0) / dz);
  const bounded = index => Math.max(0, Math.min(nz - 1, index));
  function develop() {
    if (k === wanted && !stale) return;
    k = wanted;
    stale = false;
    const pixels = new ImageData(nx, ny), out = new Uint32Array(pixels.data.buffer), first = k * nx * ny;
    const table = developed(shades, 256);
    for (let i = 0; i < nx * ny; ++i) out[i] = table[grey[first + i]];
    picture.getContext('2d').putImageData(pixels, 0, 0);
  }
  function draw() {
    wanted = bounded(wanted);
    develop();
    const w = canvas.clientWidth, h = canvas.clientHeight, ratio = sharp();
    Object.assign(canvas, {width: Math.round(w * ratio), height: Math.round(h * ratio)});
    const pen = canvas.getContext('2d'), scale = Math.min(w / (nx * dx), h / (ny * dy));
    pen.setTransform(ratio, 0, 0, ratio, 0, 0);
    const ox = (w - nx * dx * scale) / 2, oy = (h - ny * dy * scale) / 2, z = z0 + k * dz;
    const put = p => [ox + (p[0] - x0 + dx / 2) * scale, oy + (p[1] - y0 + dy / 2) * scale];
    pen.drawImage(picture, ox, oy, nx * dx * scale, ny * dy * scale);
    for (const pin of hover ? [...pins, hover] : pins) if (isMatched(pin)) drawColumn(pen, pin, put, z);
    if (shows('marks')) {
      for (const mark of data.body.landmarks) if (Math.abs(mark.at[2] - z) <= 4) drawLandmark(pen, mark.name, ...put(mark.at));
    }
    pen.font = 'bold 13px sans-serif';
    pen.textAlign = 'center';
    write(pen, 'A', w / 2, 14); write(pen, 'P', w / 2, h - 5);
    pen.textAlign = 'left';
    write(pen, 'R', 4, h / 2); write(pen, 'L', w - 14, h / 2);
    drawScale(pen, scale, w - 10, h - 8, w / 4);
    name.textContent = title(z);
  }
  // The number is that of the scan's own slices.
  function title(z) {
    const {plane, count, row} = scan.slices, level = (z < 0 ? 'I ' : 'S ') + Math.abs(z).toFixed(0) + ' mm', point = active();
    const place = plane === 'axial' ? [x0 + nx * dx / 2, y0 + ny * dy / 2, z] : isMatched(point) ? at(point.match.column) : null;
    if (!place) return 'MR, axial plane at ' + level;
    const number = Math.max(1, Math.min(count, 1 + Math.round(row[3] + row[0] * place[0] + row[1] * place[1] + row[2] * place[2])));
    const words = 'slice ' + number + ' of ' + count;
    return plane === 'axial' ? 'MR, axial ' + words + ', ' + level : 'MR, axial plane at ' + level + '; the place is in ' + plane + ' ' + words;
  }
  function drawColumn(pen, pin, put, z) {
    const near = pin.match.column.map(p => Math.abs(p[2] - z) <= dz);
    pen.strokeStyle = colourOf(pin);
    const run = inside => {
      pen.beginPath();
      pin.match.column.forEach((p, i) => {
        if (i === 0 || (inside && !(near[i] && near[i - 1]))) return;
        pen.moveTo(...put(pin.match.column[i - 1]));
        pen.lineTo(...put(p));
      });
    };
    pen.globalAlpha = 0.6;
    run(false);
    pen.lineWidth = 1;
    pen.stroke();
    pen.globalAlpha = 1;
    run(true);
    stroke(pen, 2.5);
    if (pin !== active()) return;
    const place = at(pin.match.column);
    if (Math.abs(place[2] - z) > dz) return;
    pen.beginPath();
    pen.arc(...put(place), 7, 0, 7);
    stroke(pen, 1.8);
  }
  return {
    canvas, draw,
    follow(point) { if (isMatched(point)) wanted = bounded(Math.round((at(point.match.column)[2] - z0) / dz)); },
    step(by) { wanted = bounded(wanted + by); },
    changeWindow(wider, higher) { stale = true; rewindow(shades, wider, higher); },
    reset() { stale = true; Object.assign(shades, fullWindow); },
    get at() { return wanted; }
  };
})();
