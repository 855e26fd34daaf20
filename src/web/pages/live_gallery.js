// Pictures of scenes, each a button that opens its scene.

/// `scenes`: of scenes/index.json; those with a picture are shown.
export function shownGallery(root, scenes, open) {
  root.replaceChildren(...scenes.filter(scene => scene.picture && !scene.error).map(({path, picture, sentence, keys}) => {
    const button = document.createElement("button"), image = new Image(480, 270), words = document.createElement("span");
    Object.assign(image, {src: picture, alt: "", loading: "lazy"});
    words.className = "words";
    words.append(Object.assign(document.createElement("b"), {textContent: path.replace(/\.toml$/, "")}), sentence);
    if (keys) words.append(Object.assign(document.createElement("span"), {className: "dim", textContent: ` ${keys}`}));
    button.type = "button";
    button.dataset.scene = path;
    button.append(image, words);
    button.onclick = () => open(path);
    return button;
  }));
}
