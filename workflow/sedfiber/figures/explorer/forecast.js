/**
 * The forecast of one straight fiber from its centre bead at the origin:
 *   h(0) = E(X̌(0); ℬ),   dh/dt = F_h(h; ℬ) − A h,   dc/dt = F_c(h; ℬ) + U_term
 *   X(t) = c(t) + X_term(ℬ) + (L/2) D(h(t); ℬ)
 * The state is [h (d), (c − U_term t)/(L/2) (2)].
 */
class Forecast {
  /** ℬ and θ₀ within the training range, θ₀ in radians; θ₀ = 0 is tilted as in the study. */
  constructor(model, B, theta0) {
    const b = scaledLog(B, model.range);
    const encode = encoderAt(model, b);
    Object.assign(this, { model, B, ...terminalAt(model.curve, B, model.n_beads) });
    const residual = straight(model.n_beads, theta0 === 0 ? model.tilt : theta0).map((x, i) => x - this.shape[i]);
    const context = Float64Array.of(b, ...encode(this.shape));
    this.start = Float64Array.of(...encode(residual), 0, 0);
    this.network = networkAt(model.rates, context);
    this.decoder = networkAt(model.decoder, context);
    this.modal = new Float64Array(model.decoder.signs_out.length);
    this.state = new Float64Array(this.start.length);
  }

  /** Follow the path until `isDone(t, state)`; positions can be asked for up to there. */
  follow(isDone) {
    this.path = integrate((y, out) => this.rates(y, out), this.start, this.model.method, isDone);
  }

  /** dy/dt (d + 2) of the state y. */
  rates(y, out) {
    this.network(y, out);
    this.model.damping.forEach((a, v) => {
      out[v] -= a * y[v];
    });
  }

  /** Positions (N, 2) at time `t` of the path, written to `out`. */
  positions(t, out) {
    stateAt(this.path, t, this.state);
    this.decode(this.state, t, out);
  }

  /** Positions (N, 2) of a state. */
  decode(state, t, out) {
    this.decoder(state, this.modal);
    addProduct(state, this.model.pick, this.modal);
    const [dx, dy] = this.centre(state, t);
    for (let j = 0; j < out.length; j += 2) {
      out[j] = this.shape[j] + dx;
      out[j + 1] = this.shape[j + 1] + dy;
    }
    addProduct(this.modal, this.model.modes, out);
  }

  /** The centre bead that a state stands for. */
  centre(state, t) {
    const d = state.length - 2;
    return [0, 1].map((i) => this.model.half_length * state[d + i] + this.velocity[i] * t);
  }
}

/** Add xᵀ M to `out` (n); M (m, n) has a row for each of the first m entries of x. */
function addProduct(x, matrix, out) {
  const n = out.length;
  for (let i = 0, at = 0; at < matrix.length; i++) {
    for (let j = 0; j < n; j++) {
      out[j] += x[i] * matrix[at++];
    }
  }
  return out;
}

/** A straight fiber (N, 2), inclined by θ₀, its first bead on the left. */
function straight(nBeads, theta0) {
  const middle = Math.floor(nBeads / 2);
  const direction = [Math.cos(theta0), Math.sin(theta0)];
  return Float64Array.from({ length: 2 * nBeads }, (_, j) => 2 * ((j >> 1) - middle) * direction[j & 1]);
}

/** Positions (T, N, 2) at ascending times from 0 or later, one after the other, and the forecast they are of. */
function positionsAtTimes(model, B, theta0, when) {
  requireAllowed(model, B, theta0, when);
  const forecast = new Forecast(model, B, theta0);
  const end = when[when.length - 1];
  forecast.follow((t) => t >= end);
  const width = 2 * model.n_beads;
  const out = new Float64Array(when.length * width);
  when.forEach((t, s) => forecast.positions(t, out.subarray(s * width, (s + 1) * width)));
  return { forecast, positions: out };
}

/** Throw a RangeError for what the model was not trained for. */
function requireAllowed({ range }, B, theta0, when) {
  const slack = 1e-9;
  if (!(B >= range.B_min * (1 - slack) && B <= range.B_max * (1 + slack))) {
    throw new RangeError(`B must be from ${range.B_min} to ${range.B_max}, not ${B}`);
  }
  if (!(Math.abs(theta0) <= range.theta0_max + slack)) {
    throw new RangeError(`theta0 must be from -${range.theta0_max} to ${range.theta0_max} radians, not ${theta0}`);
  }
  if (when.length === 0 || !when.every((t, s) => t >= 0 && t < Infinity && (s === 0 || t > when[s - 1]))) {
    throw new RangeError("times must ascend from zero or later");
  }
}
