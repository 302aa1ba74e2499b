/**
 * Tsitouras' Runge–Kutta pair of orders 5 and 4 with a continuous extension of order 4:
 *   k_i = f(y + Δ Σ_j A_ij k_j),   y(t + Δ) = y + Δ Σ_i b_i k_i,   b = last row of A
 *   err = Δ Σ_i e_i k_i,           y(t + θΔ) = y + Δ Σ_i k_i Σ_m D_mi θ^(m+1)
 * `method` holds A (7, 7), e as `error` (7), D as `extension` (4, 7) and the tolerances. A state has n components.
 */
const STAGES = 7;
const ORDER = 5;

/**
 * Integrate y' = rates(y) from `start` at time 0 until `isDone(t, y)` is true after a step.
 * Returns {mesh (K + 1), pieces, evaluations}: piece k (5, n) has the coefficients of y in powers of θ between
 * mesh[k] and mesh[k + 1]. Throws an Error where the state leaves the numbers or the step vanishes.
 */
function integrate(rates, start, method, isDone) {
  const progress = depart(rates, start, method);
  const path = { mesh: [0], pieces: [], evaluations: 2 };
  do {
    takeStep(rates, progress, method, path);
  } while (!isDone(progress.t, progress.y));
  return path;
}

/** At time 0, with a first step from two evaluations; a trial step moves no component by more than 0.01. */
function depart(rates, start, method) {
  const k = Array.from({ length: STAGES }, () => new Float64Array(start.length));
  rates(start, k[0]);
  const trial = 0.01 / Math.max(1e-6, ...k[0].map(Math.abs));
  rates(start.map((y, v) => y + trial * k[0][v]), k[1]);
  const atol = absoluteTolerances(start, method);
  return { t: 0, y: start.slice(), k, atol, step: firstStep(start, k, trial, atol, method.rtol), ratio: 1 };
}

/**
 * Absolute tolerances (n), tighter for the odd latent variables of a nearly symmetric start: next to the
 * unstable W, left–right asymmetry grows a thousandfold, and what is wrong with it grows alike.
 */
function absoluteTolerances(start, { atol, least_asymmetry }) {
  const nOdd = Math.ceil((start.length - 2) / 2);
  const asymmetry = Math.max(least_asymmetry, ...start.subarray(0, nOdd).map(Math.abs));
  return start.map((_, v) => (v < nOdd ? atol * Math.min(1, asymmetry) : atol));
}

/** First step by the rates at the start and those a `trial` step later (Hairer, Nørsett & Wanner, II.4). */
function firstStep(y, k, trial, atol, rtol) {
  let speed = 0;
  let change = 0;
  for (let v = 0; v < y.length; v++) {
    const scale = atol[v] + rtol * Math.abs(y[v]);
    speed += (k[0][v] / scale) ** 2;
    change += ((k[1][v] - k[0][v]) / scale) ** 2;
  }
  const largest = Math.max(Math.sqrt(speed / y.length), Math.sqrt(change / y.length) / trial, 1e-15);
  return Math.min(100 * trial, (0.01 / largest) ** (1 / ORDER));
}

/** Try steps until one is accepted; it becomes the next piece of the path. */
function takeStep(rates, progress, method, path) {
  for (;;) {
    const { t, y, k, step, atol } = progress;
    const end = allStages(rates, progress, method);
    path.evaluations += STAGES - 1;
    const ratio = errorRatio(y, end, k, step, method, atol);
    if (!Number.isFinite(ratio)) {
      throw new Error("the forecast left the numbers");
    }
    progress.step = nextStep(step, ratio, progress.ratio);
    if (ratio <= 1) {
      path.pieces.push(continuation(y, k, step, method.extension));
      path.mesh.push(t + step);
      [k[0], k[STAGES - 1]] = [k[STAGES - 1], k[0]]; // the last stage is the first of the next step
      Object.assign(progress, { t: t + step, y: end, ratio });
      return;
    }
    if (t + 1e-3 * step === t) {
      throw new Error(`the forecast is stuck at t = ${t}`);
    }
  }
}

/** Fill the stages after the first; returns the state at the step's end. */
function allStages(rates, { y, k, step }, { A }) {
  const end = new Float64Array(y.length);
  for (let i = 1; i < STAGES; i++) {
    for (let v = 0; v < y.length; v++) {
      let total = 0;
      for (let j = 0; j < i; j++) {
        total += A[i][j] * k[j][v];
      }
      end[v] = y[v] + step * total;
    }
    rates(end, k[i]);
  }
  return end;
}

/** Root mean square over the components of the step's error over its tolerance; 1 is just allowed. */
function errorRatio(y, end, k, step, { error, rtol }, atol) {
  let total = 0;
  for (let v = 0; v < y.length; v++) {
    const wrong = step * error.reduce((sum, e, i) => sum + e * k[i][v], 0);
    total += (wrong / (atol[v] + rtol * Math.max(Math.abs(y[v]), Math.abs(end[v])))) ** 2;
  }
  return Math.sqrt(total / y.length);
}

/** Step after one with this error ratio, `before` being the last accepted one's (Hairer et al., II.4). */
function nextStep(step, ratio, before) {
  const here = Math.max(ratio, 1e-8);
  if (here > 1) {
    return step * Math.max(0.2, 0.9 * here ** (-1 / ORDER));
  }
  const factor = 0.9 * here ** (-0.7 / ORDER) * Math.max(before, 1e-4) ** (0.4 / ORDER);
  return step * Math.min(5, Math.max(0.2, factor));
}

/** Coefficients (5, n) of y(t + θΔ) in powers of θ. */
function continuation(y, k, step, extension) {
  const n = y.length;
  const piece = new Float64Array((1 + extension.length) * n);
  piece.set(y);
  extension.forEach((row, m) => {
    for (let v = 0; v < n; v++) {
      piece[(m + 1) * n + v] = step * row.reduce((sum, d, i) => sum + d * k[i][v], 0);
    }
  });
  return piece;
}

/** The state at time `t` of the path, written to `out` (n). */
function stateAt(path, t, out) {
  const step = lastAtMost(path.mesh, t, path.pieces.length - 1);
  const theta = (t - path.mesh[step]) / (path.mesh[step + 1] - path.mesh[step]);
  const piece = path.pieces[step];
  const n = out.length;
  for (let v = 0; v < n; v++) {
    let value = 0;
    for (let at = piece.length - n + v; at >= 0; at -= n) {
      value = value * theta + piece[at];
    }
    out[v] = value;
  }
}

/** The last index up to `most` whose entry of the ascending `values` is at most `value`, or 0. */
function lastAtMost(values, value, most) {
  let low = 0;
  let high = most;
  while (low < high) {
    const middle = (low + high + 1) >> 1;
    if (values[middle] <= value) {
      low = middle;
    } else {
      high = middle - 1;
    }
  }
  return low;
}
