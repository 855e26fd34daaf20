// Pictures of scenes, each a button that opens its scene.

/// `scenes`: of scenes/index.json; those with a picture are shown, with the keys that make them what they are.
export function shownGallery(root, scenes, open) {
  root.replaceChildren(...scenes.filter(scene => scene.picture && !scene.error).map(({path, picture, sentence, keys}) => {
    const button = document.createElement("button"), image = new Image(480, 270), words = document.createElement("span");
    Object.assign(image, {src: picture, alt: "", loading: "lazy"});
    words.className = "words";
    const name = document.createElement("b"), [effect, scene] = path.replace(/\.toml$/, "").split("/");
    name.append(`${effect}/`, document.createElement("wbr"), scene);
    words.append(name, sentence);
    if (keys.length > 0) words.append(Object.assign(document.createElement("span"), {className: "keys-set dim", textContent: keys.join(", ")}));
    button.type = "button";
    button.dataset.scene = path;
    button.append(image, words);
    button.onclick = () => open(path);
    return button;
  }));
}
