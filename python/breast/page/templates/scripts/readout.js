// One line about the spot pointed at or the point chosen, in words and, for programs, as data.
const statusText = ['beside the breast', '', 'the line ends where its tissue meets the chest wall', 'part of the line lies behind the back edge of the image'];
function tell() {
  const readout = document.getElementById('readout'), point = hover || chosen, slider = document.getElementById('depth');
  delete readout.dataset.curve;
  if (!point) readout.textContent = 'Point at a spot in either view; click, tap or press Enter to keep it.';
  else if (!isMatched(point)) readout.textContent = views[point.k].image.view + ': ' + (point.match ? statusText[0] : 'outside the image');
  else {
    readout.textContent = (point.number ? 'Point ' + point.number + ': ' : 'This point: ') + describe(point);
    readout.dataset.curve = point.match.curve.map(p => p.map(a => a.toFixed(3)).join(' ')).join(';');
  }
  const shown = active();
  slider.disabled = !isMatched(shown);
  const deep = isMatched(shown) ? (along * shown.match.depth).toFixed(1) + ' of ' + shown.match.depth.toFixed(1) + ' mm of tissue' : '';
  document.getElementById('depth-text').textContent = deep;
  if (deep) slider.setAttribute('aria-valuetext', deep);
}
