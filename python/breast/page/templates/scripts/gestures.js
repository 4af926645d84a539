// Mouse, pen and fingers on a mammogram. A press that does not move keeps the point; one that moves pans, or changes window and
// level with the right button or in that mode; two fingers zoom.
const still = 5;  // px a finger may tremble
function listen(view) {
  const canvas = view.canvas, down = new Map();
  let moved = false, span = 0, middle = null;
  const pair = () => [...down.values()];
  const gauge = () => {
    const [a, b] = pair();
    span = Math.hypot(a[0] - b[0], a[1] - b[1]);
    middle = [(a[0] + b[0]) / 2, (a[1] + b[1]) / 2];
  };
  canvas.addEventListener('pointerdown', event => {
    canvas.setPointerCapture(event.pointerId);
    if (!down.size) moved = false;
    down.set(event.pointerId, view.place(event).concat(view.place(event)));
    if (down.size === 2) { moved = true; gauge(); }
  });
  canvas.addEventListener('pointermove', event => {
    const [x, y] = view.place(event), last = down.get(event.pointerId);
    if (!last) {
      if (event.pointerType !== 'touch') hoverAt(view, x, y);
      return;
    }
    const [dx, dy] = [x - last[0], y - last[1]];
    if (Math.hypot(x - last[2], y - last[3]) > still) moved = true;
    down.set(event.pointerId, [x, y, last[2], last[3]]);
    if (down.size === 2) {
      const before = span, [mx, my] = middle;
      gauge();
      view.pan(middle[0] - mx, middle[1] - my);
      if (before > 0) view.zoomAt(span / before, ...middle);
    } else if (moved && (windowing || event.buttons & 2)) view.changeWindow(dx / 200, -dy / 400);
    else if (moved) view.pan(dx, dy);
    redraw();
  });
  const up = keep => event => {
    const last = down.get(event.pointerId);
    down.delete(event.pointerId);
    if (!last || !keep || moved || down.size || event.button === 2) return;
    const [u, v] = view.toImage(last[0], last[1]);
    hover = null;
    if (!addPin(view.k, u, v)) hover = found(view.k, u, v);
    view.cursor = [u, v];
    redraw();
  };
  canvas.addEventListener('pointerup', up(true));
  canvas.addEventListener('pointercancel', up(false));
  canvas.addEventListener('pointerleave', event => {
    if (down.size || event.pointerType === 'touch') return;
    hover = null;
    redraw();
  });
  canvas.addEventListener('contextmenu', event => event.preventDefault());
  canvas.addEventListener('wheel', event => {
    event.preventDefault();
    view.zoomAt(Math.exp(-event.deltaY / 400), ...view.place(event));
    redraw();
  }, {passive: false});
  canvas.addEventListener('blur', () => { if (hover && hover.keys) { hover = null; redraw(); } });
}
function hoverAt(view, x, y) {
  const [u, v] = view.toImage(x, y);
  hover = found(view.k, u, v);
  view.cursor = [u, v];
  slice.follow(active());
  redraw();
}
