// The keyboard on a mammogram, on the slice and on the body.
const arrows = {ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1]};
function moveCursor(view, direction, mm) {
  const nipple = nippleOf(view.k), start = view.cursor || (nipple ? [nipple[0] / 2, nipple[1]] : [view.image.u_mm / 2, view.image.v_mm / 2]);
  const sign = left ? 1 : -1;  // the right breast is hung mirrored in both axes
  const bound = (x, high) => Math.max(0, Math.min(high, x));
  view.cursor = [bound(start[0] + sign * mm * direction[0], view.image.u_mm), bound(start[1] + sign * mm * direction[1], view.image.v_mm)];
  hover = {...found(view.k, ...view.cursor), keys: true};
  const [x, y] = view.toScreen(...view.cursor), edge = 30;
  view.pan(x < edge ? edge - x : x > view.w - edge ? view.w - edge - x : 0, y < edge ? edge - y : y > view.h - edge ? view.h - edge - y : 0);
  slice.follow(active());
}
function moveAlong(by) {
  along = Math.max(0, Math.min(1, along + by));
  document.getElementById('depth').value = 100 * along;
  slice.follow(active());
}
const viewKeys = {
  '+': view => view.zoomAt(1.25), '=': view => view.zoomAt(1.25), '-': view => view.zoomAt(0.8), '0': view => view.reset(),
  '[': view => view.changeWindow(-0.1, 0), ']': view => view.changeWindow(0.1, 0),
  ',': view => view.changeWindow(0, -0.02), '.': view => view.changeWindow(0, 0.02),
  PageUp: () => moveAlong(-0.04), PageDown: () => moveAlong(0.04),
  Escape: () => { hover = null; },
  Enter(view) {
    if (!view.cursor) moveCursor(view, [0, 0], 0);
    if (addPin(view.k, ...view.cursor)) hover = null;
  }
};
viewKeys[' '] = viewKeys.Enter;
const pageKeys = {
  u: undo, c: clearPins, w: () => document.getElementById('mode').click(), h: () => { hidden = !hidden; }
};
function listenKeys(view) {
  view.canvas.addEventListener('keydown', event => {
    if (event.altKey || event.metaKey) return;
    const arrow = arrows[event.key], key = viewKeys[event.key];
    if (arrow && event.ctrlKey) view.pan(-40 * arrow[0], -40 * arrow[1]);
    else if (arrow) moveCursor(view, arrow, event.shiftKey ? 5 : 1);
    else if (key && !event.ctrlKey) key(view);
    else return;
    event.preventDefault();
    redraw();
  });
}
slice.canvas.addEventListener('keydown', event => {
  const arrow = arrows[event.key], window = {'[': [-0.1, 0], ']': [0.1, 0], ',': [0, -0.02], '.': [0, 0.02]}[event.key];
  if (window) slice.changeWindow(...window);
  else if (arrow && arrow[1]) slice.step(-arrow[1]);
  else return;
  event.preventDefault();
  redraw();
});
body.canvas.addEventListener('keydown', event => {
  const arrow = arrows[event.key], factor = {'+': 1.25, '=': 1.25, '-': 0.8}[event.key];
  if (!arrow && !factor) return;
  event.preventDefault();
  arrow ? body.by(0.1 * arrow[0], 0.1 * arrow[1]) : body.zoomBy(factor);
  redraw();
});
document.addEventListener('keydown', event => {
  if (event.altKey || event.metaKey) return;
  const key = event.key.toLowerCase();
  if (event.ctrlKey ? key === 'z' : pageKeys[key]) {
    event.preventDefault();
    (event.ctrlKey ? undo : pageKeys[key])();
    redraw();
  }
});
