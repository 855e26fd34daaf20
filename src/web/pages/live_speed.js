// The picture's size for "automatic": what this machine computes in time, by the speed of earlier frames, which the browser keeps.

/// Sizes, and the longest time for a frame [ms].
const sizes = [[960, 540], [640, 360], [320, 180]], longest = 125;
const place = "rainref.milliseconds_per_megapixel";

export class Speeds {
  #all = stored();  // effect to the shortest time [ms] of a million pixels

  /// A frame of the effect, without antialiasing, was computed.
  measured(effect, {milliseconds, width, height}) {
    const time = milliseconds * 1e6 / (width * height), known = this.#all[effect];
    if (known <= time) return;
    this.#all[effect] = time;
    try {
      localStorage.setItem(place, JSON.stringify(this.#all));
    } catch {
      // A browser that keeps nothing: the page knows it until it is closed.
    }
  }
  /// The largest size that is fast enough. A part of a frame's work does not depend on the size; assuming that all of it does selects a
  /// smaller size. Of an effect that was not measured: the smallest, whose first picture comes soonest, or `isFast`: the middle one.
  sizeFor(effect, isFast) {
    const time = this.#all[effect];
    if (time === undefined) return sizes[isFast ? 1 : 2];
    return sizes.find(([width, height]) => time * width * height / 1e6 <= longest) ?? sizes[2];
  }
}

function stored() {
  try {
    const all = JSON.parse(localStorage.getItem(place));
    return Object.fromEntries(Object.entries(all ?? {}).filter(([, time]) => time > 0));
  } catch {
    return {};
  }
}
