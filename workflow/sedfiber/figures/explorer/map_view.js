/**
 * The map of simulated falls, ℬ against |θ₀|: a dot for each, a ring where the sliders are; a click goes there.
 */
const MAP_MARGIN = { left: 38, right: 22, top: 10, bottom: 36 };
const NEAR = 10; // pixels: a click so near to a simulated fall chooses it

/** Draw it; `sets` says the colour of each split. */
function drawMap(context, width, height, { model, sets, falls }, { B, degrees }) {
  const place = mapPlace(width, height, model.range);
  drawMapAxes(context, width, height, model.range, place);
  for (const { split, color } of sets) {
    const places = falls.filter((fall) => fall.split === split).map((fall) => place(fall.B, degreesOf(fall)));
    drawBeads(context, places, 3, color);
  }
  Object.assign(context, { strokeStyle: COLORS.simulated, lineWidth: 2.5 });
  context.beginPath();
  context.arc(...place(B, Math.abs(degrees)), 7, 0, 2 * Math.PI);
  context.stroke();
}

/** What a click at (x, y) in pixels chooses: a simulated fall nearby, or the place itself; {B, degrees ≥ 0}. */
function chosenOnMap(x, y, width, height, { model: { range }, falls }) {
  const place = mapPlace(width, height, range);
  const away = (fall) => Math.hypot(...place(fall.B, degreesOf(fall)).map((at, i) => at - [x, y][i]));
  const [nearest] = [...falls].sort((one, other) => away(one) - away(other));
  if (nearest && away(nearest) < NEAR) {
    return { B: nearest.B, degrees: degreesOf(nearest) };
  }
  const [left, bottom] = place(range.B_min, 0);
  const [right, top] = place(range.B_max, steepest(range));
  const share = (at, from, to) => Math.min(1, Math.max(0, (at - from) / (to - from)));
  return {
    B: Number((range.B_min * (range.B_max / range.B_min) ** share(x, left, right)).toPrecision(4)),
    degrees: Number((steepest(range) * share(y, bottom, top)).toFixed(2)),
  };
}

/** θ₀ of a simulated fall as the study's grid has it, in degrees. */
function degreesOf(fall) {
  return fall.k * DEGREES_PER_INDEX;
}

/** The largest |θ₀| of the training in degrees. */
function steepest(range) {
  return Number(((range.theta0_max * 180) / Math.PI).toFixed(9));
}

function mapPlace(width, height, range) {
  const across = width - MAP_MARGIN.left - MAP_MARGIN.right;
  const down = height - MAP_MARGIN.top - MAP_MARGIN.bottom;
  const span = Math.log(range.B_max / range.B_min) || 1;
  return (B, degrees) => [
    MAP_MARGIN.left + (across * Math.log(B / range.B_min)) / span,
    MAP_MARGIN.top + down * (1 - degrees / steepest(range)),
  ];
}

function drawMapAxes(context, width, height, range, place) {
  for (const degrees of multiples(0, steepest(range), 15)) {
    const [x, y] = place(range.B_min, degrees);
    drawLine(context, [[x, y], [width - MAP_MARGIN.right, y]], COLORS.grid, 1);
    drawText(context, `${degrees}°`, x - 6, y, "right");
  }
  for (const B of roundNumbers(range.B_min, range.B_max)) {
    const [x, y] = place(B, 0);
    drawLine(context, [[x, MAP_MARGIN.top], [x, y]], COLORS.grid, 1);
    drawText(context, `${B}`, x, y + 13, "center");
  }
  drawText(context, "ℬ", (MAP_MARGIN.left + width - MAP_MARGIN.right) / 2, height - 9, "center");
}

/** 1, 2 and 5 times the powers of ten from `low` to `high`. */
function roundNumbers(low, high) {
  const powers = multiples(Math.floor(Math.log10(low)), Math.log10(high), 1);
  return powers.flatMap((power) => [1, 2, 5].map((m) => m * 10 ** power)).filter((B) => B >= low && B <= high);
}
