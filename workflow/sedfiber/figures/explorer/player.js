/**
 * Time: played, paused, or set on the slider. Played, it passes half by time and half by how far the beads move.
 */
const PLAYING_TIME = 12000; // ms for a whole fall
const calm = window.matchMedia("(prefers-reduced-motion: reduce)");

class Player {
  /** `show(t)` is called whenever the time changes. */
  constructor(button, slider, show) {
    Object.assign(this, { button, slider, show, playing: false, progress: 0, last: 0 });
    button.addEventListener("click", () => (this.playing ? this.pause() : this.play()));
    slider.addEventListener("input", () => this.seek(Number(slider.value) / Number(slider.max)));
  }

  /** Go to another scene: on at the same progress, or from the start where the fall was over. */
  change(scene) {
    this.scene = scene;
    const over = this.progress >= 1;
    if (over && !calm.matches) {
      this.play();
    }
    this.update();
  }

  play() {
    this.progress = this.progress >= 1 ? 0 : this.progress;
    this.setPlaying(true);
    this.last = performance.now();
    cancelAnimationFrame(this.frame);
    this.frame = requestAnimationFrame((now) => this.tick(now));
  }

  pause() {
    this.setPlaying(false);
    cancelAnimationFrame(this.frame);
  }

  /** Go to a share of the fall's time and stay there. */
  seek(share) {
    this.pause();
    this.progress = share >= 1 ? 1 : this.scene.pace.paceAt(share * this.scene.end);
    this.update();
  }

  tick(now) {
    this.progress = Math.min(1, this.progress + Math.max(0, now - this.last) / PLAYING_TIME);
    this.last = now;
    this.update();
    if (this.progress < 1) {
      this.frame = requestAnimationFrame((next) => this.tick(next));
    } else {
      this.setPlaying(false);
    }
  }

  setPlaying(playing) {
    this.playing = playing;
    this.button.textContent = playing ? "Pause" : "Play";
  }

  /** The time that the progress stands for, in a/U_s. */
  get time() {
    return this.progress >= 1 ? this.scene.end : this.scene.pace.timeAt(this.progress);
  }

  update() {
    this.slider.value = String((Number(this.slider.max) * this.time) / this.scene.end);
    this.slider.setAttribute("aria-valuetext", `t = ${this.time.toFixed(1)} a/U_s`);
    this.show(this.time);
  }
}
