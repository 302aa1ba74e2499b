/**
 * The fiber close up, in the frame that follows its centre bead, and the whole fall beside it.
 */
const REACH = 1.12; // of L/2, on each side of the centre bead
const FORECAST_RADIUS = 0.55; // a, over simulated beads, whose radius is 1 a
const MARGIN = { left: 50, right: 8, top: 8, bottom: 24 }; // of the whole fall, in pixels

/** Fiber and simulated fiber at time t, relative to the centre bead (the simulated one's where there is one). */
function drawCloseUp(context, width, height, scene, t) {
  const { forecast, simulated } = scene;
  const fibers = fibersAt(scene, t);
  const followed = centreOf(fibers.simulated ?? fibers.forecast);
  const scale = Math.min(width, height) / (REACH * 2 * forecast.model.n_beads);
  const place = (x, y) => [width / 2 + scale * (x - followed[0]), height / 2 - scale * (y - followed[1])];
  drawFluid(context, width, height, place, scale, forecast.model.n_beads);
  const past = scene.path.filter((point) => point.t < t).map(({ x, y }) => place(x, y));
  drawLine(context, [...past, place(...centreOf(fibers.forecast))], COLORS.forecast, 1.5, 0.4);
  if (simulated) {
    drawBeads(context, placed(fibers.simulated, place), scale, COLORS.simulated);
  }
  drawBeads(context, placed(fibers.forecast, place), scale * (simulated ? FORECAST_RADIUS : 1), COLORS.forecast);
}

/** A grid that is at rest in the fluid, every L/4, so that the fall is seen; its depth is written at the side. */
function drawFluid(context, width, height, place, scale, nBeads) {
  const step = nBeads / 2;
  const [x0, y0] = place(0, 0);
  for (const x of multiples(-x0 / scale, (width - x0) / scale, step)) {
    drawLine(context, [[place(x, 0)[0], 0], [place(x, 0)[0], height]], COLORS.grid, 1);
  }
  for (const y of multiples((y0 - height) / scale, y0 / scale, step)) {
    drawLine(context, [[0, place(0, y)[1]], [width, place(0, y)[1]]], COLORS.grid, 1);
  }
  const half = scale * nBeads;
  drawLine(context, [[12, height - 14], [12 + half, height - 14]], COLORS.axis, 3);
  drawText(context, `L/2 = ${nBeads} a`, 12, height - 26);
}

/** The centre bead's path, shapes along it, and both fibers where they are at time t. */
function drawWholeFall(context, width, height, scene, t) {
  const place = fallPlace(width, height, scene);
  drawDepths(context, width, height, scene, place);
  drawLine(context, scene.path.map(({ x, y }) => place(x, y)), COLORS.axis, 1);
  scene.ghosts.forEach((shape) => drawLine(context, placed(shape, place), COLORS.forecast, 1.8, 0.55));
  const fibers = fibersAt(scene, t);
  if (fibers.simulated) {
    drawLine(context, placed(fibers.simulated, place), COLORS.simulated, 4.5);
  }
  drawLine(context, placed(fibers.forecast, place), COLORS.forecast, 2);
}

/** Place of (x, y) in pixels, at one scale, such that the whole fall is seen. */
function fallPlace(width, height, { path, forecast }) {
  const reach = forecast.model.n_beads;
  const [xs, ys] = [path.map(({ x }) => x), path.map(({ y }) => y)];
  const [left, right] = [Math.min(...xs) - reach, Math.max(...xs) + reach];
  const [low, high] = [Math.min(...ys) - reach, Math.max(...ys) + reach];
  const [across, down] = [width - MARGIN.left - MARGIN.right, height - MARGIN.top - MARGIN.bottom];
  const scale = Math.min(across / (right - left), down / (high - low));
  const middle = (left + right) / 2;
  return (x, y) => [MARGIN.left + across / 2 + scale * (x - middle), MARGIN.top + scale * (high - y)];
}

/** Lines of equal depth with their y in a. */
function drawDepths(context, width, height, { path }, place) {
  const lowest = path.at(-1).y;
  for (const y of multiples(lowest, 0, niceStep(-lowest, 6))) {
    const level = place(0, y)[1];
    drawLine(context, [[MARGIN.left, level], [width - MARGIN.right, level]], COLORS.grid, 1);
    drawText(context, y === 0 ? "0" : `−${Math.abs(y)}`, MARGIN.left - 6, level, "right");
  }
  drawText(context, "y / a", MARGIN.left - 6, height - 10, "right");
}

/** Positions (N, 2) of the forecast and, where there is one, of the simulated fiber, at time t. */
function fibersAt({ forecast, simulated }, t) {
  const width = 2 * forecast.model.n_beads;
  const fibers = { forecast: new Float64Array(width), simulated: simulated && new Float64Array(width) };
  forecast.positions(t, fibers.forecast);
  simulated?.positions(t, fibers.simulated);
  return fibers;
}

/** The centre bead of positions (N, 2). */
function centreOf(positions) {
  const middle = 2 * Math.floor(positions.length / 4);
  return [positions[middle], positions[middle + 1]];
}
