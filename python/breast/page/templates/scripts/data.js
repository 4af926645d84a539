'use strict';
// What the program wrote: images, curves of both directions, outline, and perhaps the scan. Unpacking it takes browsers a moment, after
// which the other scripts run.
let data = null, left = false, artificial = false;
const kinds = {u1: Uint8Array, u2: Uint16Array, i2: Int16Array, f4: Float32Array};
function bytes(text) {
  if (Uint8Array.fromBase64) return Uint8Array.fromBase64(text);  // browsers since 2025
  const characters = atob(text), out = new Uint8Array(characters.length);
  for (let i = 0; i < out.length; ++i) out[i] = characters.charCodeAt(i);
  return out;
}
async function numbers({packed, kind, step}) {
  const unpacked = new Blob([bytes(packed)]).stream().pipeThrough(new DecompressionStream('deflate'));
  const out = new kinds[kind](await new Response(unpacked).arrayBuffer());
  if (step) for (let i = step; i < out.length; ++i) out[i] += out[i - step];
  return out;
}
async function unpacked(part) {
  if (!part || typeof part !== 'object') return part;
  if (part.packed) return numbers(part);
  for (const name of Object.keys(part)) part[name] = await unpacked(part[name]);
  return part;
}
unpacked(JSON.parse(document.getElementById('data').textContent)).then(found => {
  data = found;
  left = data.side === 'left';
  artificial = data.body.landmarks.some(mark => mark.name.startsWith('artificial'));
  const program = document.createElement('script');
  program.textContent = document.getElementById('program').textContent;
  document.body.append(program);
}).catch(error => {
  console.error(error);
  document.getElementById('live').textContent = typeof DecompressionStream === 'undefined' ?
      'This part needs a browser of 2023 or later. Everything above does not.' :
      'This part could not be unpacked: make the page again. Everything above is complete.';
});
