/** The player: play, scrub, step to marks, loop, speed, and the time as a number. */

import { button, make, rename, setAll } from "./elements.js";
import { timeText } from "./formats.js";
import { icon, setIcon } from "./icons.js";
import { Slider } from "./sliders.js";
import { Strip } from "./strips.js";
import { fit, niceBelow } from "./stepping.js";
import { nextMark } from "./ticks.js";
import { TypedNumber } from "./typing.js";

/** @typedef {import("./readers.js").Reader} Reader */

export const SPEEDS = [0.25, 0.5, 1, 1.5, 2, 4];

export class Player {
  #reader;
  #limits;
  #gesture = "";
  #strip = new Strip();

  /**
   * @param {Reader} reader
   * @param {Node} more the button of the menu
   */
  constructor(reader, more) {
    this.#reader = reader;
    const { start, stop } = reader.manifest.times;
    this.#limits = { lo: start, hi: stop, step: niceBelow((stop - start) / 100), stops: null };
    this.fine = niceBelow((stop - start) / 400);
    this.main = reader.manifest.options.playing || "time";
    // Where nothing changes with time there is no time to be seen; a parameter may play all the same.
    this.timeless = reader.manifest.times.still;
    this.idle = this.timeless && this.main === "time";

    this.play = button("Play", icon("play"), () => this.turn(), { class: "icon-button play" });
    const previous = button("Previous mark", icon("previous"), () => this.step(-1), { class: "icon-button" });
    const next = button("Next mark", icon("next"), () => this.step(1), { class: "icon-button" });
    previous.hidden = next.hidden = this.timeless || reader.manifest.times.marks.length === 0;
    this.slider = new Slider({
      label: "Time",
      say: (t) => timeText(t, this.fine),
      fit: (wish) => fit(wish, { ...this.#limits, step: this.fine }, { coarse: true }),
      moved: (t, act) => this.#moved(t, act),
      drag: (act) => { this.#gesture = act === "begin" ? reader.gestures.begin("time") : ""; },
      key: (key, _shift, t) => (key === "," ? this.#mark(t, -1) : key === "." ? this.#mark(t, 1) : null),
    });
    this.typed = new TypedNumber("Time in seconds", (t, act) => this.#moved(fit(t, this.#limits), act));
    this.loop = button("Repeat", icon("loop"), () => this.#toggleLoop(), { class: "icon-button" });
    this.speed = make("select", { class: "speed", "aria-label": "Speed", title: "Speed" },
      SPEEDS.map((speed) => make("option", { value: speed, selected: speed === 1 }, [`${speed}×`])), {
        change: () => { reader.clock.speed = Number(this.speed.value); },
      });
    this.element = make("div", { class: "player", role: "group", "aria-label": "Player" }, [
      make("div", { class: "transport" }, [previous, this.play, next]),
      make("div", { class: "scrub" }, [this.slider.element, this.#strip.element]),
      make("span", { class: "amount" }, [this.typed.element, make("span", { class: "unit" }, ["s"])]),
      make("div", { class: "extras" }, [this.speed, this.loop, more]),
    ]);
    this.element.toggleAttribute("data-timeless", this.timeless);
    this.element.toggleAttribute("data-idle", this.idle);
    this.show();
    this.plays();
  }

  /** Play or pause; where there is nothing to play, nothing happens. */
  turn() {
    if (!this.idle || this.#reader.isPlaying()) this.#reader.turn(this.main);
  }

  /** The reader is somewhere else. */
  show() {
    const { time } = this.#reader.session.point;
    this.slider.show(time, this.#limits, this.#reader.manifest.times.marks);
    this.typed.show(time, { ...this.#limits, step: this.fine });
  }

  /** Something plays, or nothing. */
  plays() {
    const on = this.#reader.isPlaying();
    setIcon(this.play, on ? "pause" : "play");
    rename(this.play, on ? "Pause" : "Play");
    setAll(this.loop, { "aria-pressed": String(this.#reader.clock.loop) });
    this.speed.value = String(this.#reader.clock.speed);
  }

  /** @param {readonly import("../core/types.js").Span[]} spans */
  strip(spans) {
    const { start, stop } = this.#reader.manifest.times;
    this.#strip.show(spans, start, stop, this.fine);
  }

  /** To the next or previous key or interval boundary. @param {1 | -1} direction */
  step(direction) {
    if (this.timeless) return;
    const t = this.#mark(this.#reader.session.point.time, direction);
    if (t === null) return;
    this.#reader.pause();
    this.#moved(t, "key");
  }

  /** @param {number} t @param {1 | -1} direction */
  #mark(t, direction) {
    return nextMark(this.#reader.manifest.times.marks, t, direction);
  }

  /** @param {number} time @param {string} act */
  #moved(time, act) {
    this.#reader.change({ time }, { gesture: act === "drag" ? this.#gesture : this.#reader.gestures.again("time") });
  }

  #toggleLoop() {
    this.#reader.clock.loop = !this.#reader.clock.loop;
    this.plays();
  }
}
