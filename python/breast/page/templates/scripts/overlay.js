// A point in its own view; its curve, band and arc in the other.
function trace(view, points) {
  view.pen.beginPath();
  points.forEach((p, i) => {
    const [x, y] = view.toScreen(p[0], p[1]);
    i ? view.pen.lineTo(x, y) : view.pen.moveTo(x, y);
  });
}
// Unit vector across the piece of a line between its samples i and i + 1.
function acrossPiece(match, i) {
  const [x, y] = [0, 1].map(c => match.curve[i + 1][c] - match.curve[i][c]), length = Math.hypot(x, y);
  return length > 1e-6 ? [-y / length, x / length] : [1, 0];
}
// As MatchedLine.band of page/lines.py: beside each piece of the line, and round the outside of its corners.
function drawBand(view, match, factor, alpha) {
  const edge = (k, normal) => view.toScreen(...[0, 1].map(c => match.curve[k][c] + factor * match.deviation[k] * normal[c]));
  view.pen.beginPath();
  // Pieces that all turn the same way add up, also where the line bends sharply.
  const add = piece => {
    const [x, y] = [0, 1].map(c => piece.reduce((sum, p) => sum + p[c] / piece.length, 0));
    const direction = p => Math.atan2(p[1] - y, p[0] - x);
    piece.sort((p, q) => direction(p) - direction(q)).forEach((p, i) => i ? view.pen.lineTo(...p) : view.pen.moveTo(...p));
    view.pen.closePath();
  };
  for (let k = 0; k + 1 < match.curve.length; ++k) {
    const normal = acrossPiece(match, k), other = normal.map(c => -c);
    add([edge(k, normal), edge(k + 1, normal), edge(k + 1, other), edge(k, other)]);
    if (!k) continue;
    const before = acrossPiece(match, k - 1);
    const turn = Math.atan2(before[0] * normal[1] - before[1] * normal[0], before[0] * normal[0] + before[1] * normal[1]);
    const steps = 1 + Math.floor(Math.abs(turn) * 18 / Math.PI), start = Math.atan2(before[1], before[0]) + (turn > 0 ? Math.PI : 0);
    const about = Array.from({length: steps + 1}, (_, i) => start + turn * i / steps).map(a => edge(k, [Math.cos(a), Math.sin(a)]));
    for (let i = 1; i < about.length; ++i) add([view.toScreen(...match.curve[k]), about[i - 1], about[i]]);
  }
  view.pen.globalAlpha = alpha;
  view.pen.fill();
  view.pen.globalAlpha = 1;
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
