// Every scene that came with rainref, with its picture where there is one.
const pictures = {
  "puddle/default.toml": "puddle.png", "puddle/as_published.toml": "puddle_as_published.png", "puddle/traced.toml": "puddle_traced.png",
  "windshield/drive.toml": "windshield.png", "windshield/traced.toml": "windshield_traced.png", "edge_splash/default.toml": "edge_splash.png",
  "edge_splash/as_published.toml": "edge_splash_as_published.png", "screen_drops/default.toml": "screen_drops.png",
  "rainy_glass/default.toml": "rainy_glass.png",
};

export function showGallery(place, scenes, choose) {
  const withPicture = scene => scene.file in pictures;
  const ordered = [...scenes].sort((a, b) => withPicture(b) - withPicture(a));
  place.replaceChildren(...ordered.map(scene => {
    const button = document.createElement("button"), name = document.createElement("span"), sentence = document.createElement("span");
    button.type = "button";
    button.onclick = () => choose(scene);
    if (withPicture(scene)) {
      const picture = document.createElement("img");
      Object.assign(picture, {src: `images/${pictures[scene.file]}`, alt: "", loading: "lazy"});
      button.append(picture);
    }
    Object.assign(name, {className: "name", textContent: scene.file.replace(".toml", "")});
    Object.assign(sentence, {className: "dim", textContent: scene.sentence});
    button.append(name, sentence);
    return button;
  }));
}
