/**
 * Drawing on canvases: sharp at any pixel density, lengths in CSS pixels, colours told apart with any colour vision.
 */
const COLORS = {
  simulated: "#000000",
  forecast: "#d55e00",
  shape: "#0072b2",
  position: "#e69f00",
  text: "#444444",
  axis: "#767676",
  grid: "#e4e4e4",
};
const FONT = "12px system-ui, sans-serif";

/** A canvas that calls `draw(context, width, height)` whenever it is asked to or changes its size. */
class Panel {
  constructor(canvas, draw) {
    this.canvas = canvas;
    this.draw = draw;
    new ResizeObserver(() => this.redraw()).observe(canvas);
  }

  redraw() {
    const { clientWidth: width, clientHeight: height } = this.canvas;
    const density = window.devicePixelRatio;
    const [across, down] = [Math.round(width * density), Math.round(height * density)];
    if (this.canvas.width !== across || this.canvas.height !== down) {
      Object.assign(this.canvas, { width: across, height: down });
    }
    const context = this.canvas.getContext("2d");
    context.setTransform(density, 0, 0, density, 0, 0);
    context.clearRect(0, 0, width, height);
    Object.assign(context, { font: FONT, lineJoin: "round", lineCap: "round" });
    this.draw(context, width, height);
  }
}

/** A line through points [x, y] in pixels. */
function drawLine(context, points, color, width, alpha = 1) {
  context.beginPath();
  points.forEach(([x, y]) => context.lineTo(x, y));
  Object.assign(context, { strokeStyle: color, lineWidth: width, globalAlpha: alpha });
  context.stroke();
  context.globalAlpha = 1;
}

/** Words at a place; `align` and `baseline` say which point of them. */
function drawText(context, words, x, y, align = "left", baseline = "middle") {
  Object.assign(context, { fillStyle: COLORS.text, textAlign: align, textBaseline: baseline });
  context.fillText(words, x, y);
}

/** Places [x, y] in pixels of the beads of positions (N, 2); `place(x, y)` maps a to pixels. */
function placed(positions, place) {
  return Array.from({ length: positions.length / 2 }, (_, i) => place(positions[2 * i], positions[2 * i + 1]));
}

/** Beads as discs of this radius in pixels. */
function drawBeads(context, places, radius, color) {
  context.fillStyle = color;
  for (const [x, y] of places) {
    context.beginPath();
    context.arc(x, y, radius, 0, 2 * Math.PI);
    context.fill();
  }
}

/** The smallest of 1, 2, 5, 10, 20, … by which `span` has no more than `most` steps. */
function niceStep(span, most) {
  const power = 10 ** Math.floor(Math.log10(span / most));
  return power * [1, 2, 5, 10].find((factor) => span / (power * factor) <= most);
}

/** Multiples of `step` from `low` to `high`. */
function multiples(low, high, step) {
  const first = Math.ceil(low / step - 1e-9);
  const last = Math.floor(high / step + 1e-9);
  return Array.from({ length: Math.max(0, last - first + 1) }, (_, i) => (first + i) * step);
}
