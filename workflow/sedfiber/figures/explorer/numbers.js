/**
 * The numbers and words about a scene.
 */

/** Fill the element of each id with its words. */
function write(words) {
  for (const [id, text] of Object.entries(words)) {
    byId(id).textContent = text;
  }
}

/** What does not change with time. */
function showNumbers(scene) {
  const { forecast, simulated, settled, errors } = scene;
  write({
    settling: timeOf(settled),
    "settling-simulated": simulated ? `simulated: ${timeOf(simulated.settlingTime)}` : "not simulated",
    speed: `${Math.hypot(...forecast.velocity).toFixed(3)} Uₛ`,
    "end-to-end": `${endToEnd(forecast.shape).toFixed(3)} L`,
    "largest-error": errors ? scientific(Math.max(...errors.total)) : "–",
    "error-unit": errors ? "10⁻⁴ is 1 % of the length, or of the way" : "nothing to compare with",
    milliseconds: `${scene.milliseconds.toFixed(1)} ms`,
    evaluations: `${forecast.path.evaluations} evaluations of dh/dt`,
    "shown-pair": `ℬ = ${digits(scene.B)}, θ₀ = ${digits(scene.degrees)}°`,
  });
  document.body.classList.toggle("simulated", simulated !== null);
}

function timeOf(settled) {
  return settled === null ? "not settled" : `${settled.toFixed(1)} a/Uₛ`;
}

/** What does. */
function showTime(scene, t) {
  const centre = centreOf(fibersAt(scene, t).forecast);
  write({ time: `t = ${t.toFixed(1)} a/Uₛ`, fallen: `fallen ${Math.max(0, -centre[1]).toFixed(0)} a` });
}

/** Distance between the ends of a shape (N, 2) over L. */
function endToEnd(shape) {
  const [x, y] = [0, 1].map((i) => shape[i] - shape[shape.length - 2 + i]);
  return Math.hypot(x, y) / shape.length;
}

/** A number as a reader would write it: at most four decimals, no trailing zeros, a minus and no hyphen. */
function digits(value) {
  return String(Number(value.toFixed(4))).replace("-", "−");
}

/** 2.13e-4 as 2.1×10⁻⁴. */
function scientific(value) {
  const [mantissa, exponent] = value.toExponential(1).split("e");
  return `${mantissa}×10${superscript(Number(exponent))}`;
}
