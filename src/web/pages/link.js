// Links to a view of the judge page, in location.hash: names unchanged, texts of shaders deflated, in base64url.
const toBase64Url = bytes => btoa(Array.from(bytes, byte => String.fromCharCode(byte)).join("")).replace(/\+/g, "-").replace(/\//g, "_").replace(/=+$/, "");
const fromBase64Url = text => Uint8Array.from(atob(text.replace(/-/g, "+").replace(/_/g, "/")), c => c.charCodeAt(0));

/// What a link may unpack to [bytes], so that a short one cannot fill the memory of the tab.
export const mostLinkBytes = 2 ** 20;
class TooLong extends Error {}

async function deflated(text) {
  const stream = new Blob([text]).stream().pipeThrough(new CompressionStream("deflate-raw"));
  return toBase64Url(new Uint8Array(await new Response(stream).arrayBuffer()));
}
async function inflated(text) {
  const reader = new Blob([fromBase64Url(text)]).stream().pipeThrough(new DecompressionStream("deflate-raw")).getReader(), chunks = [];
  for (let bytes = 0;;) {
    const {done, value} = await reader.read();
    if (done) return new Blob(chunks).text();
    bytes += value.length;
    if (bytes > mostLinkBytes) {
      reader.cancel();
      throw new TooLong();
    }
    chunks.push(value);
  }
}

/// The hash of {key: text}; null and "" are left out. `shader`: a text; `shaders`: a Map from a formula to its text.
export async function hashOf({shader, shaders, ...names}) {
  const parts = new URLSearchParams(Object.entries(names).filter(([, value]) => value));
  if (shader) parts.set("shader", await deflated(shader));
  if (shaders?.size > 0) parts.set("shaders", await deflated(JSON.stringify([...shaders])));
  return `#${parts}`;
}

/// The argument of hashOf, from a hash; `shaders` is always there. Throws if a shader's text cannot be read.
export async function viewOf(hash) {
  const view = Object.fromEntries(new URLSearchParams(hash.replace(/^#/, "")));
  try {
    if (view.shader) view.shader = await inflated(view.shader);
    const pairs = view.shaders ? JSON.parse(await inflated(view.shaders)) : [];
    if (!pairs.every(pair => pair.length === 2 && pair.every(text => typeof text === "string"))) throw new Error("no pairs of texts");
    view.shaders = new Map(pairs);
  } catch (error) {
    throw new Error(error instanceof TooLong ? "The link's shader text is longer than 1 MiB: it is not opened." :
      "The link's shader text cannot be read: the link may have been cut.");
  }
  return view;
}

/// Throws an Error that says what of a link's view is not here, or does not fit together. named: the pack that it means, if it is here.
export function checkView(wanted, named, packs, profiles) {
  const unknown = [["effect", packs.map(p => p.effect)], ["variant", packs.map(p => p.variant)], ["profile", profiles]]
    .filter(([key, known]) => wanted[key] && !known.includes(wanted[key])).map(([key]) => `${key} ${wanted[key]}`);
  if (wanted.pack && !named && !wanted.own) unknown.push(`pack ${wanted.pack}`);
  const about = named ?? packs.find(p => p.effect === wanted.effect && (!wanted.variant || p.variant === wanted.variant));
  if (wanted.pass && wanted.pass !== "*" && about && !about.passes.some(p => p.name === wanted.pass)) unknown.push(`pass ${wanted.pass}`);
  if (unknown.length > 0) throw new Error(`The link names what is not here: ${unknown.join(", ")}.`);
  if (wanted.own && !named) throw new Error(`The link means a pack of its sender's own, ${wanted.pack} (SHA-256 of its manifest ${wanted.own}…): drop it here, then open the link again.`);
  for (const key of ["effect", "variant"])
    if (named && wanted[key] && wanted[key] !== named[key]) throw new Error(`The link contradicts itself: the pack ${named.name} is of ${named.effect} ${named.variant}, not of ${wanted[key]}.`);
}
