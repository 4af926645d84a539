// The points that are kept, which of them is chosen, and what undo takes back.
let pins = [], chosen = null, hover = null, along = 0.5;
const past = [];
let changed = () => {};

function found(k, u, v) {
  return {k, u, v, match: lookups[k].find(u, v), arc: nippleArc(k, u, v)};
}
const isMatched = point => !!(point && point.match && point.match.curve);
function remember() {
  past.push({pins, chosen});
  if (past.length > 200) past.shift();
}
function addPin(k, u, v) {
  const pin = found(k, u, v);
  if (!isMatched(pin)) return false;
  remember();
  const taken = new Set(pins.map(p => p.number));
  for (pin.number = 1; taken.has(pin.number);) ++pin.number;
  pins = [...pins, pin];
  chosen = pin;
  changed();
  return true;
}
function removePin(pin) {
  remember();
  pins = pins.filter(p => p !== pin);
  if (chosen === pin) chosen = pins[pins.length - 1] || null;
  changed();
}
function clearPins() {
  if (!pins.length) return;
  remember();
  pins = [];
  chosen = null;
  changed();
}
function undo() {
  const before = past.pop();
  if (!before) return;
  ({pins, chosen} = before);
  changed();
}
function choose(pin) {
  chosen = pin;
  changed();
}
// What the slice, the slider and the text speak of.
const active = () => hover && isMatched(hover) ? hover : chosen;
// A value of a curve or column at the chosen place along it.
function at(list) {
  const x = along * (list.length - 1), k = Math.min(Math.floor(x), list.length - 2), f = x - k;
  return list[k].map((value, c) => (1 - f) * value + f * list[k + 1][c]);
}
