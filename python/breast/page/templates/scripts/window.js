// Window and level, as fractions of the range of grey values.
const fullWindow = {width: 1, level: 0.5};
function rewindow(shades, wider, higher) {
  shades.width = Math.min(2, Math.max(0.02, shades.width * Math.exp(wider)));
  shades.level = Math.min(1, Math.max(0, shades.level + higher));
}
// The pixel, opaque grey, of each of `count` values.
function developed(shades, count) {
  const low = shades.level - shades.width / 2, table = new Uint8ClampedArray(count);
  for (let i = 0; i < count; ++i) table[i] = 255 * (i / (count - 1) - low) / shades.width;
  return Uint32Array.from(table, value => 0xff000000 | value * 0x010101);
}
