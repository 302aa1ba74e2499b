/**
 * Everything that the page shows of one (ℬ, θ₀): the forecast, the simulated fall where there is one, their errors.
 */
const GHOSTS = 14; // shapes drawn along the whole fall
const PATH_POINTS = 240;

/** The scene at ℬ and θ₀ in degrees, with the milliseconds that it took to compute. */
function sceneAt(model, page, B, degrees) {
  const before = performance.now();
  const entry = entryAt(page.falls, B, degrees);
  const simulated = entry ? new SimulatedFall(entry, page.quantum, degrees < 0) : null;
  const forecast = new Forecast(model, B, simulated ? simulated.theta0 : (degrees * Math.PI) / 180);
  const { distances, travelled } = followToRest(forecast, simulated ? simulated.t.at(-1) : 0);
  const settled = settlingTime(forecast, distances);
  const end = Math.max(settled ?? LATEST, simulated ? simulated.t.at(-1) : 0);
  const pace = paceOf(forecast.path.mesh, travelled, end);
  const scene = { B, degrees, forecast, simulated, settled, end, pace };
  scene.ghosts = shapesAlong(scene);
  scene.path = centrePath(scene);
  scene.errors = simulated ? errorsOf(simulated, forecast) : null;
  scene.milliseconds = performance.now() - before;
  return scene;
}

/** The forecast's shapes (N, 2) from the first to the last, evenly paced. */
function shapesAlong({ forecast, pace }) {
  return Array.from({ length: GHOSTS }, (_, i) => {
    const shape = new Float64Array(2 * forecast.model.n_beads);
    forecast.positions(pace.timeAt(i / (GHOSTS - 1)), shape);
    return shape;
  });
}

/** The forecast's centre bead at times evenly spaced: {t, x, y}. */
function centrePath({ forecast, end }) {
  return Array.from({ length: PATH_POINTS }, (_, i) => {
    const t = (end * i) / (PATH_POINTS - 1);
    stateAt(forecast.path, t, forecast.state);
    const [x, y] = forecast.centre(forecast.state, t);
    return { t, x, y };
  });
}
