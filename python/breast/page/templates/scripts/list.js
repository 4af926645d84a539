// The kept points as a list of buttons: choose one, or remove it.
// Half the width of the 90 % band, which at most a tenth of the line exceeds (page/lines.py).
function widthOf(match) {
  const pieces = match.curve.slice(1).map((p, i) => ({length: Math.hypot(p[0] - match.curve[i][0], p[1] - match.curve[i][1]),
                                                      deviation: (match.deviation[i] + match.deviation[i + 1]) / 2}));
  let left = 0.1 * pieces.reduce((sum, piece) => sum + piece.length, 0);
  for (const piece of pieces.sort((a, b) => b.deviation - a.deviation)) if ((left -= piece.length) < 0) return sides90 * piece.deviation;
  return 0;
}
const viewName = k => views[k].image.view;
function brief(point) {
  const match = point.match, distance = nippleDistance(point.k, point.u, point.v);
  return viewName(point.k) + (distance > 0 ? ', ' + distance.toFixed(0) + ' mm from the nipple' : '') + ': in ' + viewName(1 - point.k) +
      ' on a line of ' + match.length.toFixed(0) + ' mm' +
      (widthOf(match) > 0 ? ', about ' + widthOf(match).toFixed(0) + ' mm to either side (90 %)' : '') +
      (match.kind > 1 ? '; ' + statusText[match.kind] : '');
}
function describe(point) {
  const match = point.match, distance = nippleDistance(point.k, point.u, point.v);
  return 'in ' + viewName(1 - point.k) + ' somewhere on a line of ' + match.length.toFixed(0) + ' mm' +
      (widthOf(match) > 0
           ? ', about ' + widthOf(match).toFixed(0) + ' mm to either side (90 %' + (data.band_without ? ', not counting ' + data.band_without : '') + ')'
           : '; how far to either side is not known for this run') +
      (match.kind > 1 ? '; ' + statusText[match.kind] : '') + '. In ' + viewName(point.k) + ': ' +
      (distance > 0 ? distance.toFixed(0) + ' mm from the nipple, ' : '') + match.depth.toFixed(0) + ' mm of tissue along the beam.';
}
function listPins() {
  const list = document.getElementById('pins');
  list.replaceChildren(...pins.map(pin => {
    const row = document.createElement('li'), pick = document.createElement('button'), drop = document.createElement('button');
    pick.type = drop.type = 'button';
    pick.className = 'pin';
    pick.style.borderLeft = '6px solid ' + colourOf(pin);
    pick.textContent = pin.number + '  ' + brief(pin);
    pick.setAttribute('aria-pressed', String(pin === chosen));
    pick.addEventListener('click', () => choose(pin));
    drop.textContent = '\u00d7';
    drop.setAttribute('aria-label', 'Remove point ' + pin.number);
    drop.addEventListener('click', () => removePin(pin));
    row.append(pick, drop);
    return row;
  }));
}
