// Links to a view, in location.hash: names unchanged, a shader's text deflated, in base64url.
const toBase64Url = bytes => btoa(Array.from(bytes, byte => String.fromCharCode(byte)).join("")).replace(/\+/g, "-").replace(/\//g, "_").replace(/=+$/, "");
const fromBase64Url = text => Uint8Array.from(atob(text.replace(/-/g, "+").replace(/_/g, "/")), c => c.charCodeAt(0));
const through = (bytes, stream) => new Response(new Blob([bytes]).stream().pipeThrough(stream));

/// The hash of {key: text}; `shader` is compressed, null and "" are left out.
export async function hashOf({shader, ...names}) {
  const parts = new URLSearchParams(Object.entries(names).filter(([, value]) => value));
  if (shader) parts.set("shader", toBase64Url(new Uint8Array(await through(new TextEncoder().encode(shader), new CompressionStream("deflate-raw")).arrayBuffer())));
  return `#${parts}`;
}

/// The argument of hashOf, from a hash; throws if a shader's text cannot be read.
export async function viewOf(hash) {
  const view = Object.fromEntries(new URLSearchParams(hash.replace(/^#/, "")));
  if (view.shader) {
    try {
      view.shader = await through(fromBase64Url(view.shader), new DecompressionStream("deflate-raw")).text();
    } catch {
      throw new Error("The link's shader text cannot be read: the link may have been cut.");
    }
  }
  return view;
}
