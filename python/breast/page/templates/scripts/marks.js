// What a mammogram carries in its margin: view and side, directions, scale, window; and the landmarks in it.
let hidden = false;
const shows = what => !hidden && document.getElementById('show-' + what).checked;
const roundLengths = [1, 2, 5, 10, 20, 50, 100];
function drawScale(pen, scale, x, y, room) {
  const mm = roundLengths.filter(length => length * scale <= room).pop() || 1, width = mm * scale;
  for (const [colour, line] of [['#000', 4], ['#fff', 1.6]]) {
    pen.strokeStyle = colour;
    pen.lineWidth = line;
    pen.beginPath();
    pen.moveTo(x - width, y - 4); pen.lineTo(x - width, y); pen.lineTo(x, y); pen.lineTo(x, y - 4);
    pen.stroke();
  }
  pen.font = '12px sans-serif';
  pen.textAlign = 'center';
  write(pen, mm + ' mm', x - width / 2, y - 7);
  pen.textAlign = 'left';
}
function drawNipple(pen, x, y) {
  pen.strokeStyle = '#8ff0a4';
  pen.beginPath();
  pen.moveTo(x, y - 7); pen.lineTo(x + 7, y); pen.lineTo(x, y + 7); pen.lineTo(x - 7, y);
  pen.closePath();
  stroke(pen, 1.8);
}
function drawTumour(pen, x, y, radius) {
  pen.strokeStyle = '#ff6b8b';
  pen.beginPath();
  pen.arc(x, y, radius, 0, 7);
  if (artificial) pen.setLineDash([4, 3]);
  stroke(pen, 1.8);
  pen.setLineDash([]);
}
function drawLandmark(pen, name, x, y) {
  name === 'nipple' ? drawNipple(pen, x, y) : drawTumour(pen, x, y, 12);
}
function drawMargin(view) {
  const pen = view.pen, w = view.w, h = view.h, image = view.image, cc = image.view === 'CC';
  const free = left ? w - 8 : 8;  // the margin beyond the nipple
  const place = (text, x, y, align) => { pen.textAlign = align; write(pen, text, x, y, '#e6eef5'); };
  pen.font = 'bold 15px sans-serif';
  place((left ? 'L ' : 'R ') + image.view, free, 20, left ? 'right' : 'left');
  pen.font = '12px sans-serif';
  // On a telephone the word gives way to the name of the view.
  place(cc ? 'lateral' : 'superior', w / 2 - (w < 260 ? (left ? 1 : -1) * 0.12 * w : 0), 14, 'center');
  place(cc ? 'medial' : 'inferior', w / 2, h - 6, 'center');
  if (w > 320) {
    place('W ' + Math.round(100 * view.window.width) + ' L ' + Math.round(100 * view.window.level) + '  \u00d7' + view.zoom.toFixed(1),
          free, 38, left ? 'right' : 'left');
  }
  pen.textAlign = 'left';
  const bar = 20 * view.scale <= w / 2 ? 20 : 5;  // mm
  drawScale(pen, view.scale, left ? w - 12 : 12 + bar * view.scale, h - 24, bar * view.scale);
}
function drawMarks(view) {
  if (shows('marks')) {
    for (const mark of view.image.landmarks) drawLandmark(view.pen, mark.name, ...view.toScreen(...mark.at));
  }
  drawMargin(view);
}
