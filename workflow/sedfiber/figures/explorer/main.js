/**
 * The page: what is chosen becomes a scene, the scene is shown, time passes; and the forecast for scripts.
 */
const WARM_UP = 2; // the browser compiles a script while it runs: the first times are not those of a forecast
const page = embedded();
const model = readModel(page);
let scene;
let evaluations = 0;

const panels = [
  [drawCloseUp, "close-up"],
  [drawWholeFall, "whole-fall"],
].map(([draw, id]) => new Panel(byId(id), (...sheet) => draw(...sheet, scene, player.time)));
const errorPanel = new Panel(byId("errors"), (...sheet) => scene.errors && drawErrors(...sheet, scene, player.time));
const mapPanel = new Panel(byId("map"), (...sheet) => drawMap(...sheet, page, scene));

const player = new Player(byId("play"), byId("time-slider"), (t) => {
  panels.forEach((panel) => panel.redraw());
  errorPanel.redraw();
  showTime(scene, t);
});
const controls = new Controls(page, choose);

/** Show the fall at ℬ and θ₀ in degrees. */
function choose(B, degrees) {
  scene = sceneAt(model, page, B, degrees);
  controls.show(scene);
  showNumbers(scene);
  mapPanel.redraw();
  player.change(scene);
}

byId("map").addEventListener("click", ({ offsetX, offsetY, target }) => {
  const { B, degrees } = chosenOnMap(offsetX, offsetY, target.clientWidth, target.clientHeight, page);
  choose(B, scene.degrees < 0 ? -degrees : degrees);
});

/**
 * For scripts: positions (T, N, 2), flat, at ascending `times` of the fiber that starts straight at ℬ and θ₀ in
 * radians; `evaluations` are those of the rates in the last call.
 */
window.sedfiber = {
  forecast(B, theta0, times) {
    const { forecast, positions } = positionsAtTimes(model, B, theta0, Array.from(times));
    evaluations = forecast.path.evaluations;
    return positions;
  },
  get evaluations() {
    return evaluations;
  },
};

/** A fall in the middle of the range to begin with, simulated where possible. */
function chooseFirst() {
  const middle = Math.sqrt(model.range.B_min * model.range.B_max);
  const off = (fall) => Math.abs(Math.log(fall.B / middle)) + Math.abs(degreesOf(fall) - 45) / 45;
  const [first] = [...page.falls].sort((one, other) => off(one) - off(other));
  for (let run = 0; run <= WARM_UP; run++) {
    choose(first.B, degreesOf(first));
  }
}

chooseFirst();
if (!calm.matches) {
  player.play();
}
