/**
 * Simulated falls: a few samples of each are in the page, shapes in whole multiples of a `quantum` (a).
 */
const ANGLES_PER_HALF_TURN = 48; // θ₀ = k π/48
const DEGREES_PER_INDEX = 180 / ANGLES_PER_HALF_TURN;

/** One simulated fall: times `t` (S), positions (N, 2) at them; `mirrored` for its mirror image, θ₀ → −θ₀. */
class SimulatedFall {
  constructor(entry, quantum, mirrored) {
    const sign = mirrored ? -1 : 1;
    Object.assign(this, { entry, theta0: sign * entry.theta0, settlingTime: entry.settling_time });
    this.t = unpack(entry.t);
    const centre = unpack(entry.centre);
    const shapes = unpack(entry.shapes);
    this.width = shapes.length / this.t.length;
    this.samples = Array.from(this.t, (_, s) => {
      const shape = Float64Array.from(shapes.subarray(s * this.width, (s + 1) * this.width), (x) => x * quantum);
      const turned = mirrored ? mirrorImage(shape) : shape;
      return turned.map((x, j) => x + (j % 2 === 0 ? sign * centre[2 * s] : centre[2 * s + 1]));
    });
  }

  /** Positions (N, 2) at any time, written to `out`: cubic between samples, with the slopes of parabolas. */
  positions(t, out) {
    const k = lastAtMost(this.t, t, this.t.length - 2);
    const step = this.t[k + 1] - this.t[k];
    const theta = Math.min(1, (t - this.t[k]) / step); // at rest, in effect, beyond the last sample
    const [from, to] = [this.samples[k], this.samples[k + 1]];
    for (let j = 0; j < this.width; j++) {
      const [left, right] = [this.slope(k, j) * step, this.slope(k + 1, j) * step];
      const rise = to[j] - from[j];
      out[j] = from[j] + theta * (left + theta * (3 * rise - 2 * left - right + theta * (left + right - 2 * rise)));
    }
  }

  /** Slope at sample k of the parabola through it and its neighbours. */
  slope(k, j) {
    const middle = Math.min(Math.max(k, 1), this.t.length - 2);
    const [before, here, after] = [-1, 0, 1].map((i) => middle + i);
    const [one, two] = [this.t[here] - this.t[before], this.t[after] - this.t[here]];
    const left = (this.samples[here][j] - this.samples[before][j]) / one;
    const right = (this.samples[after][j] - this.samples[here][j]) / two;
    const bend = (right - left) / (one + two);
    return left + bend * (2 * this.t[k] - this.t[before] - this.t[here]);
  }
}

/** The mirror image x → −x of a shape (N, 2), its beads counted from the other end. */
function mirrorImage(shape) {
  return shape.map((_, j) => (j % 2 === 0 ? -shape[shape.length - 2 - j] : shape[shape.length - j]));
}

/** The entry of the fall that was simulated at ℬ and |θ₀|, if there is one. */
function entryAt(falls, B, degrees) {
  const k = Math.abs(degrees) / DEGREES_PER_INDEX;
  return falls.find((entry) => Math.abs(entry.k - k) < 1e-9 && Math.abs(entry.B / B - 1) < 1e-12);
}

/**
 * E = E_shape + E_pos of a forecast at the samples of the simulated fall after t = 0, (S − 1) each:
 *   E_shape = Σ_beads |ΔX̄|²/(N L²),   E_pos = |Δc|²/|c(t) − c(0)|²
 */
function errorsOf(simulated, forecast) {
  const guess = new Float64Array(simulated.width);
  const errors = { t: [], total: [], shape: [], position: [] };
  for (let s = 1; s < simulated.t.length; s++) {
    forecast.positions(simulated.t[s], guess);
    const { shape, position } = errorAt(simulated.samples[s], guess, simulated.samples[0]);
    errors.t.push(simulated.t[s]);
    errors.shape.push(shape);
    errors.position.push(position);
    errors.total.push(shape + position);
  }
  return errors;
}

/** E_shape and E_pos of positions `guess` (N, 2) for `truth`, which started at `origin`. */
function errorAt(truth, guess, origin) {
  const n = truth.length / 2;
  const middle = 2 * Math.floor(n / 2);
  const off = [0, 1].map((i) => truth[middle + i] - guess[middle + i]);
  const travelled = [0, 1].map((i) => truth[middle + i] - origin[middle + i]);
  const shape = truth.reduce((sum, x, j) => sum + (x - guess[j] - off[j % 2]) ** 2, 0) / (n * (2 * n) ** 2);
  return { shape, position: (off[0] ** 2 + off[1] ** 2) / (travelled[0] ** 2 + travelled[1] ** 2) };
}
