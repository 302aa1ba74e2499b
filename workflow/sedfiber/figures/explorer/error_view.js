/**
 * E(t) and its two parts on a logarithmic axis: the past bold, the whole pale.
 */
const ERROR_MARGIN = { left: 46, right: 12, top: 8, bottom: 34 };
const LEAST_ERROR = 1e-10; // what is left of the rounding of the simulated shapes
const CURVES = [
  ["position", COLORS.position],
  ["shape", COLORS.shape],
  ["total", COLORS.simulated],
];

/** The errors of a scene that has a simulated fall, up to time t. */
function drawErrors(context, width, height, { errors, end }, t) {
  const box = { left: ERROR_MARGIN.left, right: width - ERROR_MARGIN.right };
  Object.assign(box, { top: ERROR_MARGIN.top, bottom: height - ERROR_MARGIN.bottom });
  const decades = decadesOf(errors);
  const x = (time) => box.left + ((box.right - box.left) * time) / end;
  const y = (error) => {
    const up = (Math.log10(Math.max(error, 1e-300)) - decades.low) / (decades.high - decades.low);
    return box.bottom - (box.bottom - box.top) * up;
  };
  drawErrorAxes(context, box, decades, end, x, y);
  drawCurves(context, box, errors, x, y, box.right, 1.2, 0.35);
  drawCurves(context, box, errors, x, y, x(t), 2, 1);
  drawLine(context, [[x(t), box.top], [x(t), box.bottom]], COLORS.axis, 1);
}

/** The curves within the box and left of `right`, in pixels. */
function drawCurves(context, box, errors, x, y, right, width, alpha) {
  context.save();
  context.beginPath();
  context.rect(box.left, box.top, right - box.left, box.bottom - box.top);
  context.clip();
  for (const [name, color] of CURVES) {
    drawLine(context, errors[name].map((error, i) => [x(errors.t[i]), y(error)]), color, width, alpha);
  }
  context.restore();
}

/** The decades that hold E and its parts, two at least and five at most: {low, high}, whole powers of ten. */
function decadesOf({ total, shape, position }) {
  const high = Math.ceil(Math.log10(Math.max(...total, 100 * LEAST_ERROR)) + 0.1);
  const low = Math.floor(Math.log10(Math.max(Math.min(...shape, ...position), LEAST_ERROR)));
  return { low: Math.min(high - 2, Math.max(high - 5, low)), high };
}

function drawErrorAxes(context, box, { low, high }, end, x, y) {
  for (const power of multiples(low, high, Math.ceil((high - low) / 5))) {
    const level = y(10 ** power);
    drawLine(context, [[box.left, level], [box.right, level]], COLORS.grid, 1);
    drawText(context, power === 0 ? "1" : `10${superscript(power)}`, box.left - 6, level, "right");
  }
  for (const time of multiples(0, end, niceStep(end, Math.max(2, (box.right - box.left) / 90)))) {
    drawLine(context, [[x(time), box.bottom], [x(time), box.bottom + 4]], COLORS.axis, 1);
    drawText(context, `${time}`, x(time), box.bottom + 13, "center");
  }
  drawLine(context, [[box.left, box.bottom], [box.right, box.bottom]], COLORS.axis, 1);
  drawText(context, "t / (a/Uₛ)", box.right, box.bottom + 27, "right");
}

/** A whole number as superscript: −4 as ⁻⁴. */
function superscript(number) {
  return String(number).replace("-", "⁻").replace(/\d/g, (digit) => "⁰¹²³⁴⁵⁶⁷⁸⁹"[digit]);
}
