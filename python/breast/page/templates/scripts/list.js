// The kept points as a list of buttons: choose one, or remove it.
const lengthOf = line => line.reduce((sum, p, i) => i ? sum + Math.hypot(p[0] - line[i - 1][0], p[1] - line[i - 1][1]) : 0, 0);
const widestOf = match => 1.96 * Math.max(...match.deviation);
const viewName = k => views[k].image.view;
function brief(point) {
  const match = point.match, distance = nippleDistance(point.k, point.u, point.v);
  return viewName(point.k) + ' ' + point.u.toFixed(0) + ', ' + point.v.toFixed(0) + ' mm: ' + viewName(1 - point.k) + ' curve ' +
      lengthOf(match.curve).toFixed(0) + ' mm' + (widestOf(match) > 0 ? ' \u00b1 ' + widestOf(match).toFixed(0) + ' mm (95 %)' : '') +
      (distance > 0 ? ', nipple at ' + distance.toFixed(0) + ' mm' : '') + (match.kind > 1 ? '; ' + statusText[match.kind] : '');
}
function describe(point) {
  const match = point.match, distance = nippleDistance(point.k, point.u, point.v);
  return viewName(point.k) + ' ' + point.u.toFixed(1) + ', ' + point.v.toFixed(1) + ' mm: ' + statusText[match.kind] + '; ' +
      match.depth.toFixed(1) + ' mm of tissue, ' + viewName(1 - point.k) + ' curve of ' + lengthOf(match.curve).toFixed(0) +
      ' mm, its middle at ' + match.curve[match.curve.length >> 1].map(a => a.toFixed(1)).join(', ') + ' mm' +
      (widestOf(match) > 0
           ? '; 95 % band up to ' + widestOf(match).toFixed(1) + ' mm either side' + (data.band_without ? ', not counting ' + data.band_without : '')
           : '; no band (the compressions hold no derivatives)') +
      (distance > 0 ? '; ' + distance.toFixed(1) + ' mm from the nipple' : '');
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
