// What the page is doing while the visitor waits for a picture: in words, per cent, a way to leave it, and a picture of the scene meanwhile.

const place = "rainref.milliseconds";
const part = id => document.getElementById(id);
const earlier = () => {
  try {
    return JSON.parse(localStorage.getItem(place)) ?? {};
  } catch {
    return {};
  }
};

export class Busy {
  #cancel = null;
  #shown = 0;  // what is shown now, by a number

  constructor() {
    part("cancel").onclick = () => this.#cancel?.();
  }

  /// Shows the text while the work runs, after `delay` [ms], so that what is fast does not flicker. cancel(): makes the work end. `as`: a name of
  /// this work; the browser keeps how long it took, which the next time gives per cent.
  async during(text, work, {cancel = null, delay = 250, as = null} = {}) {
    const mine = ++this.#shown, begin = performance.now(), before = as === null ? undefined : earlier()[as];
    const show = () => {
      if (mine !== this.#shown) return;
      const time = performance.now() - begin;
      // A machine that is slower today stays at 99.
      if (before > 0) this.#show(`${text} ${Math.min(99, Math.floor(100 * time / before))} %`, Math.min(0.99, time / before));
      else this.#show(time < 1000 ? text : `${text} ${Math.floor(time / 1000)} s`, null);
      this.#cancel = cancel;
      part("cancel").hidden = cancel === null;
    };
    let repeated = null;
    const timer = setTimeout(() => {
      show();
      repeated = setInterval(show, 250);
    }, delay);
    try {
      const result = await work();
      if (as !== null) this.#keep(as, performance.now() - begin);
      return result;
    } finally {
      clearTimeout(timer);
      clearInterval(repeated);
      if (mine === this.#shown) this.hide();
    }
  }
  /// Shows that `done` of `of` frames are there; cancel() ends them. hide() ends it.
  counted(text, done, of, cancel) {
    ++this.#shown;
    this.#show(`${text} ${done} of ${of}, ${Math.floor(100 * done / of)} %`, done / of);
    this.#cancel = cancel;
    part("cancel").hidden = false;
  }
  hide() {
    ++this.#shown;
    part("busy").hidden = true;
  }

  /// A picture of the scene in place of its frames, until showFrames(); null: none.
  standIn(picture) {
    part("stand-in").hidden = picture === null;
    if (picture !== null) part("stand-in").src = picture;
  }
  showFrames() { part("stand-in").hidden = true; }

  #show(text, share) {
    part("busy-text").textContent = text;
    part("busy-progress").hidden = share === null;
    part("busy-progress").value = share ?? 0;
    part("busy").hidden = false;
  }
  #keep(as, time) {
    try {
      localStorage.setItem(place, JSON.stringify({...earlier(), [as]: Math.round(time)}));
    } catch {
      // No per cent the next time.
    }
  }
}
