// Links to what the live page shows: scene, picture size, keys and frame, in the address.

const mostFrames = 1000000;

/// What a link asks for: {scene, size, sets, frame, error?}; `error`: what of it cannot be.
export function wantedBy(search) {
  const wanted = new URLSearchParams(search), frame = wanted.get("frame") ?? "0";
  const sets = new Map(wanted.getAll("set").map(text => [text.slice(0, text.indexOf("=")), text.slice(text.indexOf("=") + 1)]));
  const asked = {scene: wanted.get("scene") ?? "puddle/default.toml", size: wanted.get("size") ?? "automatic", sets, frame: 0};
  if (!/^\d+$/.test(frame) || Number(frame) >= mostFrames)
    return {...asked, error: new Error(`frame: expected a whole number from 0 to ${mostFrames - 1}, found '${frame}'. This is frame 0.`)};
  return {...asked, frame: Number(frame)};
}

/// The page's address for a listed scene, with the keys set; frame 0 is left out. Of another scene: the page's own.
export function addressOf({scene, size, sets, frame = 0}) {
  const address = new URL(location);
  address.search = scene === null ? "" : new URLSearchParams([["scene", scene], ...(size === "automatic" ? [] : [["size", size]]),
    ...[...sets].map(([key, toml]) => ["set", `${key}=${toml}`]), ...(frame > 0 ? [["frame", String(frame)]] : [])]);
  return address;
}
