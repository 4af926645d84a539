// The breast as imaged, orthographic: skin, chest wall, landmarks and the columns. Patient axes: x to the left, y to the back, z up.
const body = (() => {
  const canvas = document.getElementById('body'), picture = document.createElement('canvas');
  const parts = [['cut', 'rgba(120,130,140,0.20)'], ['wall', 'rgba(201,138,91,0.42)'], ['skin', 'rgba(150,190,225,0.20)']]
      .map(([name, colour]) => ({edges: data.body[name], colour}));
  const middle = data.body.middle;
  let radius = 1;  // of a ball about the middle that holds the breast however it is turned
  for (const {edges} of parts) for (let i = 0; i < edges.length; i += 3) {
    radius = Math.max(radius, Math.hypot(edges[i] - middle[0], edges[i + 1] - middle[1], edges[i + 2] - middle[2]));
  }
  const turn = {yaw: left ? 0.7 : -0.7, pitch: -0.25};
  let drawn = '', scale = 1, zoom = 1, w = 0, h = 0;
  // Right, down and away on the screen of a direction; from the front the patient's left is at the right.
  const turned = (a, b, c) => {
    const cy = Math.cos(turn.yaw), sy = Math.sin(turn.yaw), cp = Math.cos(turn.pitch), sp = Math.sin(turn.pitch);
    const across = cy * a + sy * b, away = -sy * a + cy * b;
    return [across, -(cp * c - sp * away), sp * c + cp * away];
  };
  const put = p => {
    const [x, y] = turned(p[0] - middle[0], p[1] - middle[1], p[2] - middle[2]);
    return [w / 2 + scale * x, h / 2 + scale * y];
  };
  function outline(pen) {
    for (const {edges, colour} of parts) {
      pen.strokeStyle = colour;
      pen.lineWidth = 1;
      pen.beginPath();
      for (let i = 0; i < edges.length; i += 6) {
        pen.moveTo(...put(edges.subarray(i, i + 3)));
        pen.lineTo(...put(edges.subarray(i + 3, i + 6)));
      }
      pen.stroke();
    }
  }
  function axes(pen) {
    const x0 = 34, y0 = h - 34, letters = [];
    pen.font = 'bold 12px sans-serif';
    pen.textAlign = 'center';
    for (const [name, axis] of [['L', [1, 0, 0]], ['A', [0, -1, 0]], ['S', [0, 0, 1]]]) {
      const [x, y] = turned(...axis);
      if (Math.hypot(x, y) < 0.4) continue;  // seen from its end, its letter would lie on another
      pen.strokeStyle = '#dfe8f0';
      pen.beginPath();
      pen.moveTo(x0, y0);
      pen.lineTo(x0 + 20 * x, y0 + 20 * y);
      pen.lineWidth = 1.5;
      pen.stroke();
      let reach = 27;  // as far along its axis as no other letter lies there
      while (reach < 60 && letters.some(other => Math.hypot(x0 + reach * x - other[0], y0 + reach * y - other[1]) < 13)) reach += 4;
      letters.push([x0 + reach * x, y0 + reach * y]);
      write(pen, name, x0 + reach * x, y0 + reach * y + 4, '#dfe8f0');
    }
    pen.textAlign = 'left';
  }
  // Thousands of edges: kept as a picture until the breast is turned.
  function background() {
    const ratio = sharp(), state = [turn.yaw, turn.pitch, zoom, w, h, ratio].join();
    if (state === drawn) return;
    drawn = state;
    Object.assign(picture, {width: Math.round(w * ratio), height: Math.round(h * ratio)});
    const pen = picture.getContext('2d');
    pen.setTransform(ratio, 0, 0, ratio, 0, 0);
    outline(pen);
    axes(pen);
  }
  function draw() {
    w = canvas.clientWidth;
    h = canvas.clientHeight;
    scale = 0.49 * zoom * Math.min(w, h) / radius;
    const ratio = sharp();
    Object.assign(canvas, {width: Math.round(w * ratio), height: Math.round(h * ratio)});
    background();
    const pen = canvas.getContext('2d');
    if (picture.width && picture.height) pen.drawImage(picture, 0, 0);
    pen.setTransform(ratio, 0, 0, ratio, 0, 0);
    for (const pin of hover ? [...pins, hover] : pins) if (isMatched(pin)) {
      pen.strokeStyle = colourOf(pin);
      pen.beginPath();
      pin.match.column.forEach((p, i) => i ? pen.lineTo(...put(p)) : pen.moveTo(...put(p)));
      stroke(pen, pin === active() ? 3.5 : 2);
    }
    if (isMatched(active())) {
      pen.fillStyle = colourOf(active());
      pen.beginPath();
      pen.arc(...put(at(active().match.column)), 5, 0, 7);
      pen.fill();
    }
    if (shows('marks')) for (const mark of data.body.landmarks) drawLandmark(pen, mark.name, ...put(mark.at));
    drawScale(pen, scale, w - 10, h - 10, w / 4);
  }
  function by(dx, dy) {
    turn.yaw += dx;
    turn.pitch = Math.max(-1.57, Math.min(1.57, turn.pitch + dy));
  }
  return {canvas, draw, by, zoomBy(factor) { zoom = Math.max(0.5, Math.min(6, zoom * factor)); }, to(yaw, pitch) { Object.assign(turn, {yaw, pitch}); }, turn, turned};
})();
