'use strict';
// What the program wrote: images, curves of both directions, outline, and perhaps the scan.
const data = JSON.parse(document.getElementById('data').textContent);
function bytes(text) {
  if (Uint8Array.fromBase64) return Uint8Array.fromBase64(text);  // browsers since 2025
  const characters = atob(text), out = new Uint8Array(characters.length);
  for (let i = 0; i < out.length; ++i) out[i] = characters.charCodeAt(i);
  return out;
}
const array = (Kind, text) => new Kind(bytes(text).buffer);
const left = data.side === 'left';
const artificial = data.body.landmarks.some(mark => mark.name.startsWith('artificial'));
