// The radiologist's arc: points of the other image as far from its nipple as (u,v) is from the nipple
// here, posterior of the nipple and in tissue, as stretches.
function nippleOf(k) {
  const mark = data.images[k].landmarks.find(landmark => landmark.name === 'nipple');
  return mark ? mark.at : null;
}
function nippleDistance(k, u, v) {
  const nipple = nippleOf(k);
  return nipple ? Math.hypot(u - nipple[0], v - nipple[1]) : 0;
}
function nippleArc(k, u, v) {
  const centre = nippleOf(1 - k), radius = nippleDistance(k, u, v), stretches = [];
  if (!centre || !(radius > 0)) return stretches;
  const steps = Math.max(90, Math.ceil(Math.PI * radius / 0.5));
  let inside = false;
  for (let i = 0; i <= steps; ++i) {
    const angle = Math.PI * (0.5 + i / steps);
    const at = [centre[0] + radius * Math.cos(angle), centre[1] + radius * Math.sin(angle)];
    const tissue = at[0] >= 0 && lookups[1 - k].tissueAt(...at);
    if (tissue && !inside) stretches.push([]);
    if (tissue) stretches[stretches.length - 1].push(at);
    inside = tissue;
  }
  return stretches;
}
