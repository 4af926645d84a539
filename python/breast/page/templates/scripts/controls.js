// Buttons, slider, wheel on the slice and turning of the body. Zoom buttons act on the view used last.
let lastView = null;
function press(id, act) {
  document.getElementById(id).addEventListener('click', () => { act(); redraw(); });
}
const used = () => lastView || views[0];
for (const view of views) {
  view.canvas.addEventListener('focus', () => { lastView = view; });
  listen(view);
  listenKeys(view);
}
press('mode', () => {
  windowing = !windowing;
  document.getElementById('mode').setAttribute('aria-pressed', String(windowing));
});
press('larger', () => used().zoomAt(1.25));
press('smaller', () => used().zoomAt(0.8));
press('fit', () => [...views, slice].forEach(picture => picture.reset()));
press('undo', undo);
press('clear', clearPins);
press('front', () => body.to(0, 0));
press('side', () => body.to(left ? Math.PI / 2 : -Math.PI / 2, 0));
press('above', () => body.to(0, -Math.PI / 2));
for (const id of ['show-band', 'show-arc', 'show-marks']) document.getElementById(id).addEventListener('change', () => redraw());
document.getElementById('depth').addEventListener('input', event => {
  along = event.target.value / 100;
  slice.follow(active());
  redraw();
});
slice.canvas.addEventListener('wheel', event => {
  event.preventDefault();
  slice.step(event.deltaY > 0 ? -1 : 1);
  redraw();
}, {passive: false});
slice.canvas.addEventListener('pointerdown', event => slice.canvas.setPointerCapture(event.pointerId));
slice.canvas.addEventListener('contextmenu', event => event.preventDefault());
slice.canvas.addEventListener('pointermove', event => {
  if (!event.buttons) return;
  slice.changeWindow(event.movementX / 200, -event.movementY / 400);
  redraw();
});
body.canvas.addEventListener('pointerdown', event => body.canvas.setPointerCapture(event.pointerId));
body.canvas.addEventListener('pointermove', event => {
  if (!event.buttons) return;
  body.by(event.movementX / 120, event.movementY / 120);
  redraw();
});
body.canvas.addEventListener('wheel', event => {
  event.preventDefault();
  body.zoomBy(Math.exp(-event.deltaY / 400));
  redraw();
}, {passive: false});
