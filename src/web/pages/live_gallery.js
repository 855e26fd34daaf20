// Pictures of scenes, each a button that opens its scene.
import {element} from "./report_words.js";

/// `scenes`: of scenes/index.json; those with a picture are shown, with their distinguishing keys.
export function shownGallery(root, scenes, open) {
  root.replaceChildren(...scenes.filter(scene => scene.picture && !scene.error).map(({path, picture, sentence, keys}) => {
    const [effect, scene] = path.replace(/\.toml$/, "").split("/"), image = element("img", {width: 480, height: 270, alt: "", loading: "lazy", src: picture});
    const button = element("button", {type: "button", "data-scene": path}, image, element("span", {class: "words"}, element("b", {}, `${effect}/`, element("wbr"), scene), sentence,
      keys.length > 0 && element("span", {class: "keys-set dim"}, keys.join(", "))));
    button.onclick = () => open(path);
    return button;
  }));
}
