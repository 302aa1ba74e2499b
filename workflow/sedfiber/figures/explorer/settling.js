/**
 * A forecast followed until it has settled: when that is, and how far the beads have moved by then.
 */
const LATEST = 4000; // a/U_s: six times the longest fall of the study

/**
 * Follow a forecast to rest, and at least to the time `earliest`. Returns, for every time of its path's mesh (K),
 * `distances` to the terminal shape over L and `travelled`, the root-mean-square path of the beads in a.
 */
function followToRest(forecast, earliest) {
  const { settling, n_beads } = forecast.model;
  let before = new Float64Array(2 * n_beads);
  let now = new Float64Array(2 * n_beads);
  const distances = [];
  const travelled = [];
  const record = (state, t) => {
    decodeShape(forecast, state, t, now);
    distances.push(distanceToTerminal(now, forecast.shape));
    travelled.push(travelled.length ? travelled.at(-1) + rootMeanSquare(now, before) : 0);
    [before, now] = [now, before];
    return distances.at(-1);
  };
  record(forecast.start, 0);
  forecast.follow((t, state) => (record(state, t) < settling.confirmed && t >= earliest) || t > LATEST);
  return { distances, travelled };
}

/** Positions of a state relative to its centre bead, written to `out` (N, 2). */
function decodeShape(forecast, state, t, out) {
  forecast.decode(state, t, out);
  const [x, y] = forecast.centre(state, t);
  for (let j = 0; j < out.length; j += 2) {
    out[j] -= x;
    out[j + 1] -= y;
  }
}

/** First time after which the distance to the terminal shape stays below `settled`; null when it does not. */
function settlingTime(forecast, distances) {
  const { mesh } = forecast.path;
  const { settled } = forecast.model.settling;
  const last = distances.findLastIndex((distance) => distance >= settled);
  if (last === -1 || last === distances.length - 1) {
    return last === -1 ? 0 : null;
  }
  return crossing((t) => distanceAt(forecast, t) - settled, mesh[last], mesh[last + 1]);
}

function distanceAt(forecast, t) {
  const shape = new Float64Array(forecast.shape.length);
  stateAt(forecast.path, t, forecast.state);
  decodeShape(forecast, forecast.state, t, shape);
  return distanceToTerminal(shape, forecast.shape);
}

/** Where a function that is positive at `low` and negative at `high` is zero, by halving. */
function crossing(value, low, high) {
  for (let i = 0; i < 30; i++) {
    const middle = 0.5 * (low + high);
    [low, high] = value(middle) > 0 ? [middle, high] : [low, middle];
  }
  return high;
}

/**
 * Root-mean-square bead distance over L = 2N of a shape (N, 2) from the terminal one, in the plane: a half turn
 * about the vertical maps a steady shape onto a steady shape, and the nearer one counts.
 */
function distanceToTerminal(shape, terminal) {
  let square = 0;
  let overlap = 0;
  for (let j = 0; j < shape.length; j += 2) {
    square += shape[j] ** 2 + terminal[j] ** 2 + (shape[j + 1] - terminal[j + 1]) ** 2;
    overlap += shape[j] * terminal[j];
  }
  const n = shape.length / 2;
  return Math.sqrt(Math.max(0, square - 2 * Math.abs(overlap)) / n) / (2 * n);
}

/** Root-mean-square bead distance of two shapes (N, 2). */
function rootMeanSquare(one, other) {
  const square = one.reduce((sum, x, j) => sum + (x - other[j]) ** 2, 0);
  return Math.sqrt((2 * square) / one.length);
}

/**
 * Time as a function of a pace p in [0, 1], half by time and half by how far the beads move:
 * p = ½ t/T + ½ s(t)/s(T), so that a quick turn is not over in a blink. T is `end`, s is `travelled` on `mesh`.
 */
function paceOf(mesh, travelled, end) {
  const whole = interpolate(mesh, travelled, end);
  const pace = mesh.map((t, k) => 0.5 * (t / end) + 0.5 * (travelled[k] / whole));
  return { timeAt: (p) => Math.min(end, interpolate(pace, mesh, p)), paceAt: (t) => interpolate(mesh, pace, t) };
}

/** The value at `x` of the line through (xs, ys), xs ascending. */
function interpolate(xs, ys, x) {
  const k = lastAtMost(xs, x, xs.length - 2);
  return ys[k] + ((x - xs[k]) / (xs[k + 1] - xs[k])) * (ys[k + 1] - ys[k]);
}
