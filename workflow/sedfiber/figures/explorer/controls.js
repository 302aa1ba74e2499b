/**
 * Sliders, number fields and the list of simulated falls; all of them choose a (ℬ, θ₀).
 */
const STOPS = 200; // of the slider for ℬ
const STOPS_PER_INDEX = 4; // of the slider for θ₀, between two studied angles

class Controls {
  /** `choose(B, degrees)` is called when the user has chosen. */
  constructor(page, choose) {
    this.page = page;
    this.choose = choose;
    this.B = { slider: byId("B-slider"), field: byId("B") };
    this.theta = { slider: byId("theta-slider"), field: byId("theta") };
    this.list = byId("falls");
    this.setUpRanges(page.model.range);
    this.fillList();
    this.listen();
  }

  setUpRanges(range) {
    const most = steepest(range);
    Object.assign(this.B.slider, { min: 0, max: STOPS, step: 1 });
    Object.assign(this.B.field, { min: range.B_min, max: range.B_max });
    Object.assign(this.theta.slider, { min: -most, max: most, step: DEGREES_PER_INDEX / STOPS_PER_INDEX });
    Object.assign(this.theta.field, { min: -most, max: most });
  }

  /** A group for each data set, an entry for each fall. */
  fillList() {
    for (const { split, name } of this.page.sets) {
      const group = document.createElement("optgroup");
      this.page.falls.forEach((fall, i) => {
        if (fall.split === split) {
          group.append(new Option(`ℬ = ${digits(fall.B)}, θ₀ = ${digits(degreesOf(fall))}° (k = ${fall.k})`, i));
        }
      });
      group.label = `${name}: ${group.children.length} falls`;
      this.list.append(group);
    }
  }

  listen() {
    const { B, theta, list, page } = this;
    B.slider.addEventListener("input", () => this.choose(this.sliderB(), this.degrees));
    theta.slider.addEventListener("input", () => this.choose(this.chosenB, this.sliderDegrees()));
    B.field.addEventListener("change", () => this.choose(this.fieldValue(B.field, this.chosenB), this.degrees));
    theta.field.addEventListener("change", () => this.choose(this.chosenB, this.fieldValue(theta.field, this.degrees)));
    list.addEventListener("change", () => {
      const fall = page.falls[Number(list.value)];
      this.choose(fall.B, degreesOf(fall));
    });
  }

  /** ℬ at the slider's stop: the studied one that lies nearest to it, or four digits. */
  sliderB() {
    const { B_min, B_max } = this.page.model.range;
    const at = (stop) => B_min * (B_max / B_min) ** (stop / STOPS);
    const stop = Number(this.B.slider.value);
    const studied = this.page.falls.map((fall) => fall.B);
    return studied.find((B) => Math.abs(this.stopOf(B) - stop) < 0.5) ?? Number(at(stop).toPrecision(4));
  }

  /** The place of ℬ on its slider, not rounded. */
  stopOf(B) {
    const { B_min, B_max } = this.page.model.range;
    return (STOPS * Math.log(B / B_min)) / (Math.log(B_max / B_min) || 1);
  }

  /** θ₀ at the slider's stop, a studied one where it lies within half a stop. */
  sliderDegrees() {
    const degrees = Number(this.theta.slider.value);
    const nearest = Math.round(degrees / DEGREES_PER_INDEX) * DEGREES_PER_INDEX;
    const most = steepest(this.page.model.range);
    const near = Math.abs(degrees - nearest) < (0.5 * DEGREES_PER_INDEX) / STOPS_PER_INDEX;
    return near && Math.abs(nearest) <= most ? nearest : degrees;
  }

  /** What a number field says, brought into its range; `before` where it says nothing. */
  fieldValue(field, before) {
    const value = field.value === "" ? before : Number(field.value);
    return Math.min(Number(field.max), Math.max(Number(field.min), value));
  }

  /** Show what is chosen. */
  show({ B, degrees, simulated }) {
    Object.assign(this, { chosenB: B, degrees });
    this.B.slider.value = String(Math.round(this.stopOf(B)));
    this.theta.slider.value = String(degrees);
    this.B.field.value = String(B);
    this.theta.field.value = String(degrees);
    this.B.slider.setAttribute("aria-valuetext", digits(B));
    this.theta.slider.setAttribute("aria-valuetext", `${digits(degrees)} degrees`);
    this.list.value = simulated ? String(this.page.falls.indexOf(simulated.entry)) : "";
    write({ k: `k = ${digits(degrees / DEGREES_PER_INDEX)}`, radians: `${digits((degrees * Math.PI) / 180)} rad` });
  }
}
