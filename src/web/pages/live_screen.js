// The picture with its buttons over the full screen, where the browser lets pages have it.

export class FullScreen {
  constructor(button, box) {
    button.hidden = !document.fullscreenEnabled;
    button.onclick = () => {
      if (document.fullscreenElement) document.exitFullscreen();
      else box.requestFullscreen().catch(() => { button.hidden = true; });
    };
    document.addEventListener("fullscreenchange", () => { button.textContent = document.fullscreenElement ? "Leave full screen" : "Full screen"; });
  }
}
