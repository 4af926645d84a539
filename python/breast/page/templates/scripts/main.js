// Everything is drawn at most once a frame.
let asked = false;
function drawAll() {
  asked = false;
  for (const view of views) {
    view.draw();
    drawPoints(view);
    drawMarks(view);
  }
  slice.draw();
  body.draw();
  tell();
}
function redraw() {
  if (asked) return;
  asked = true;
  requestAnimationFrame(drawAll);
}
changed = () => {
  listPins();
  document.getElementById('undo').disabled = !past.length;
  document.getElementById('clear').disabled = !pins.length;
  slice.follow(active());
  redraw();
};
for (const id of ['tumour-legend', 'marks-tumour']) document.getElementById(id).hidden = !data.body.landmarks.some(mark => mark.name !== 'nipple');
if (artificial) {
  document.getElementById('tumour-name').textContent = 'artificial tumour: put there by the program, not a finding';
  document.querySelector('#legend .tumour').style.borderStyle = 'dashed';
}
const banded = lookups.some(lookup => lookup.deviation.some(value => value > 0));
for (const about of [document.getElementById('band-legend'), document.getElementById('show-band').closest('label')]) about.hidden = !banded;
new ResizeObserver(redraw).observe(document.getElementById('views'));
// page.html#30,50;MLO:20,40 keeps points as a link or a test asks for; the first view is meant where none is named.
for (const word of decodeURIComponent(location.hash.slice(1)).split(';').filter(Boolean)) {
  const [place, name] = word.split(':').reverse(), k = Math.max(0, data.images.findIndex(image => image.view === name));
  const [u, v] = place.split(',').map(Number);
  if (Number.isFinite(u) && Number.isFinite(v) && !addPin(k, u, v)) hover = found(k, u, v);
}
drawAll();
performance.mark('first picture');
