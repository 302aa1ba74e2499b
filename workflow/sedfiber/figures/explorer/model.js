/**
 * The reduced model as functions of ℬ: encoder, networks and terminal curve. N beads, d latent variables, r modes;
 * shapes are (N, 2) bead by bead, relative to the centre bead, lengths in a.
 */

/** The model with its arrays unpacked; `packed` is what was put into the page. */
function readModel(packed) {
  const { model, curve } = packed;
  return {
    ...model,
    encoder: readEncoder(model.encoder),
    rates: readNetwork(model.rates),
    decoder: readNetwork(model.decoder),
    damping: unpack(model.damping),
    pick: unpack(model.pick),
    modes: unpack(model.modes),
    curve: { range: curve.range, coefficients: unpack(curve.coefficients) },
    method: packed.method,
    settling: packed.settling,
  };
}

function readNetwork(network) {
  const [first, ...inner] = network.layers.map(readLayer);
  return { ...network, first, inner, last: unpack(network.last), context: unpack(network.context) };
}

function readLayer(layer) {
  return { weights: unpack(layer.weights), bias: unpack(layer.bias) };
}

function readEncoder(encoder) {
  return { matrix: unpack(encoder.matrix), allowed: unpack(encoder.allowed), change: encoder.change.map(readLayer) };
}

/** b = 2 ln(ℬ/ℬ_min)/ln(ℬ_max/ℬ_min) − 1, in [−1, 1] whatever the rounding. */
function scaledLog(B, range) {
  if (range.B_min === range.B_max) {
    return 0;
  }
  const b = (2 * Math.log(B / range.B_min)) / Math.log(range.B_max / range.B_min) - 1;
  return Math.min(1, Math.max(-1, b));
}

/** Terminal shape (N, 2) and velocity (2) in U_s: Σ_k c_k cos(k arccos b). */
function terminalAt(curve, B, nBeads) {
  const width = 2 * nBeads + 2;
  const angle = Math.acos(scaledLog(B, curve.range));
  const row = new Float64Array(width);
  for (let k = 0, at = 0; at < curve.coefficients.length; k++) {
    const term = Math.cos(k * angle);
    for (let i = 0; i < width; i++) {
      row[i] += term * curve.coefficients[at++];
    }
  }
  return { shape: row.subarray(0, width - 2), velocity: row.subarray(width - 2) };
}

/** Matrix (rows, n) times vector (n). */
function product(matrix, vector) {
  const out = new Float64Array(matrix.length / vector.length);
  for (let i = 0, at = 0; i < out.length; i++) {
    for (let j = 0; j < vector.length; j++) {
      out[i] += matrix[at++] * vector[j];
    }
  }
  return out;
}

/** The encoder at one b: h = (P + Q(b)) Φ X̌ of a shape X̌ (N, 2) in a. `modes` (r, 2N) is (L/2) Φ. */
function encoderAt(model, b) {
  const matrix = encoderMatrix(model.encoder, b);
  return (shape) => product(matrix, product(model.modes, shape).map((z) => z / model.half_length ** 2));
}

/** P + Q(b), (d, r); Q is a perceptron with one hidden layer, for an encoder that sees ℬ. */
function encoderMatrix({ matrix, allowed, change }, b) {
  if (change.length === 0) {
    return matrix.map((p, i) => p * allowed[i]);
  }
  const [enter, leave] = change;
  const hidden = enter.weights.map((w, i) => Math.tanh(w * b + enter.bias[i]));
  const q = product(leave.weights, hidden);
  return matrix.map((p, i) => (p + q[i] + leave.bias[i]) * allowed[i]);
}

/**
 * A mirror-symmetric network at one ℬ, (x (n_in), out (n_out)) → void, which writes g(x):
 *   raw(x) = ½ [f(a + x; b) + S_out f(a + S_in x; b)],   g(x) = raw(x) − raw(0).
 * Scales and the ½ are folded into the weights; `context` [b, h_term] (1 + d) into the first bias.
 */
function networkAt(network, context) {
  const bias = product(network.context, context).map((c, i) => c + network.first.bias[i]);
  const layers = [{ weights: network.first.weights, bias }, ...network.inner];
  const widest = Math.max(network.signs_in.length, ...layers.map((layer) => layer.bias.length));
  const memory = [new Float64Array(2 * widest), new Float64Array(2 * widest)];
  const rest = new Float64Array(network.signs_out.length);
  raw(network, layers, new Float64Array(network.signs_in.length), memory, rest);
  return (x, out) => {
    raw(network, layers, x, memory, out);
    for (let i = 0; i < rest.length; i++) {
      out[i] -= rest[i];
    }
  };
}

/** raw(x) above; both arguments of f go through the layers side by side. */
function raw(network, layers, x, memory, out) {
  let [here, there] = memory;
  let n = network.signs_in.length;
  for (let i = 0; i < n; i++) {
    here[i] = x[i];
    here[n + i] = network.signs_in[i] * x[i];
  }
  for (const { weights, bias } of layers) {
    hiddenLayer(weights, bias, here, n, there);
    [here, there, n] = [there, here, bias.length];
  }
  leave(network, here, n, out);
}

/**
 * tanh(W u + bias) of u = `from` (n) and of its mirror image, which lies behind it. The m units, an even number, are
 * taken two at a time, which takes half the time: an input is read once for both.
 */
function hiddenLayer(weights, bias, from, n, to) {
  const m = bias.length;
  for (let j = 0, at = 0; j < m; j += 2, at += n) {
    let [direct, image] = [bias[j], bias[j]];
    let [direct2, image2] = [bias[j + 1], bias[j + 1]];
    for (let i = 0; i < n; i++, at++) {
      direct += weights[at] * from[i];
      image += weights[at] * from[n + i];
      direct2 += weights[at + n] * from[i];
      image2 += weights[at + n] * from[n + i];
    }
    to[j] = Math.tanh(direct);
    to[m + j] = Math.tanh(image);
    to[j + 1] = Math.tanh(direct2);
    to[m + j + 1] = Math.tanh(image2);
  }
}

/** W (direct + S_out image). */
function leave({ last, signs_out }, hidden, n, out) {
  for (let i = 0, at = 0; i < signs_out.length; i++) {
    let total = 0;
    for (let j = 0; j < n; j++, at++) {
      total += last[at] * (hidden[j] + signs_out[i] * hidden[n + j]);
    }
    out[i] = total;
  }
}
