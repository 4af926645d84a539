// A point in its own view; its curve, band and arc in the other.
function trace(view, points) {
  view.pen.beginPath();
  points.forEach((p, i) => {
    const [x, y] = view.toScreen(p[0], p[1]);
    i ? view.pen.lineTo(x, y) : view.pen.moveTo(x, y);
  });
}
// As MatchedLine.inside_band of page/lines.py: all places near enough to the line, as far as they lie in the breast.
function drawBand(view, match, factor, alpha) {
  const pen = view.pen, places = match.curve.map(p => view.toScreen(...p)), radii = match.deviation.map(mm => factor * mm * view.scale);
  pen.save();
  pen.beginPath();
  for (const ring of view.image.outline) ring.forEach((p, i) => i ? pen.lineTo(...view.toScreen(...p)) : pen.moveTo(...view.toScreen(...p)));
  pen.clip('evenodd');
  // Circles, and the quadrilaterals between them, all turn the same way, so that they add up.
  pen.beginPath();
  places.forEach(([x, y], i) => {
    pen.moveTo(x + radii[i], y);
    pen.arc(x, y, radii[i], 0, 2 * Math.PI);
    if (!i) return;
    const [u, v] = places[i - 1], length = Math.hypot(x - u, y - v);
    if (!(length > 0)) return;
    const [a, b] = [(v - y) / length, (x - u) / length], before = radii[i - 1], r = radii[i];
    pen.moveTo(u - a * before, v - b * before); pen.lineTo(x - a * r, y - b * r);
    pen.lineTo(x + a * r, y + b * r); pen.lineTo(u + a * before, v + b * before);
    pen.closePath();
  });
  pen.globalAlpha = alpha;
  pen.fill();
  pen.restore();
}
// A line that shows on bright and on dark tissue.
function stroke(pen, width) {
  const colour = pen.strokeStyle;
  pen.lineWidth = width + 2;
  pen.strokeStyle = 'rgba(0,0,0,0.55)';
  pen.stroke();
  pen.lineWidth = width;
  pen.strokeStyle = colour;
  pen.stroke();
}
function write(pen, text, x, y, colour = '#fff') {
  pen.lineWidth = 3;
  pen.lineJoin = 'round';
  pen.strokeStyle = '#000';
  pen.strokeText(text, x, y);
  pen.fillStyle = colour;
  pen.fillText(text, x, y);
}
function drawMatch(view, point) {
  const pen = view.pen, match = point.match, colour = colourOf(point), main = point === active();
  pen.strokeStyle = pen.fillStyle = colour;
  if (shows('band')) {
    drawBand(view, match, sides90, main ? 0.2 : 0.12);
    drawBand(view, match, 0.674, main ? 0.24 : 0.12);
  }
  if (shows('arc')) {
    pen.setLineDash([5, 5]);
    for (const stretch of point.arc) { trace(view, stretch); stroke(pen, 1.2); }
    pen.setLineDash([]);
  }
  trace(view, match.curve);
  stroke(pen, main ? 2.4 : 1.6);
  if (point.number) {
    const [x, y] = view.toScreen(...match.curve[0]);
    pen.font = 'bold 13px sans-serif';
    write(pen, String(point.number), Math.min(Math.max(x - 4, 3), view.w - 12), Math.min(Math.max(y - 7, 14), view.h - 6), colour);
  }
  if (!main) return;
  const [x, y] = view.toScreen(...at(match.curve));
  pen.beginPath();
  pen.arc(x, y, 4, 0, 7);
  pen.fillStyle = colour;
  pen.fill();
  pen.lineWidth = 1;
  pen.strokeStyle = '#000';
  pen.stroke();
}
// A ring and four ticks: nothing of the tissue at the point is hidden.
function drawPoint(view, point) {
  const pen = view.pen, [x, y] = view.toScreen(point.u, point.v), main = point === active();
  pen.strokeStyle = colourOf(point);
  pen.beginPath();
  if (point.number) pen.arc(x, y, 8, 0, 7);
  for (const [a, b] of [[1, 0], [-1, 0], [0, 1], [0, -1]]) {
    pen.moveTo(x + 5 * a, y + 5 * b);
    pen.lineTo(x + 12 * a, y + 12 * b);
  }
  stroke(pen, main ? 2 : 1.4);
  if (!point.number) return;
  pen.font = 'bold 13px sans-serif';
  write(pen, String(point.number), x + 11, y - 9, colourOf(point));
}
function drawPoints(view) {
  const all = hover ? [...pins, hover] : pins;
  for (const point of all) if (point.k !== view.k && isMatched(point)) drawMatch(view, point);
  for (const point of all) if (point.k === view.k) drawPoint(view, point);
}
