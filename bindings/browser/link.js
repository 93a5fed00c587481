"use strict";
/* The scene in the address of the page: JSON, deflated where the browser can, in base64 for addresses. */

const toAddress = (bytes) => btoa(Array.from(bytes, (byte) => String.fromCharCode(byte)).join(""))
  .replace(/\+/g, "-").replace(/\//g, "_").replace(/=+$/, "");
const fromAddress = (text) => Uint8Array.from(atob(text.replace(/-/g, "+").replace(/_/g, "/")), (c) => c.charCodeAt(0));

async function through(bytes, stream) {
  return new Uint8Array(await new Response(new Blob([bytes]).stream().pipeThrough(stream)).arrayBuffer());
}

async function writeLink(content) {
  const bytes = new TextEncoder().encode(JSON.stringify(content));
  if (typeof CompressionStream === "undefined") return `plain=${toAddress(bytes)}`;
  return `scene=${toAddress(await through(bytes, new CompressionStream("deflate")))}`;
}

/* null where the address holds no scene, or one that cannot be read. */
async function readLink(fragment) {
  const [, kind, text] = fragment.match(/^#(scene|plain)=([\w-]+)$/) || [];
  if (!kind) return null;
  try {
    const bytes = fromAddress(text);
    const plain = kind === "plain" ? bytes : await through(bytes, new DecompressionStream("deflate"));
    return JSON.parse(new TextDecoder().decode(plain));
  } catch (trouble) {
    return null;
  }
}
