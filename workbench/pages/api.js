// What is asked of the workbench, and the files that this tab looks at.

import { currentLanguage } from "./words.js";

export const app = { machine: "", data: "", revision: "", state: null };

// Refused by the workbench; `status` 409 when another tab or program changed the files meanwhile.
export class Refused extends Error {
  constructor(status, message) {
    super(message);
    this.status = status;
  }
}

async function ask(method, what, words, body) {
  const chosen = { machine: app.machine, data: app.data, revision: app.revision, language: currentLanguage(), ...words };
  const query = new URLSearchParams(chosen);
  const answer = await fetch(`api/${what}?${query}`, { method, body });
  if (answer.ok) return answer;
  const told = await answer.json().catch(() => ({ error: `${answer.status}` }));
  throw new Refused(answer.status, told.error);
}

export async function get(what, words = {}) {
  return (await ask("GET", what, words)).json();
}

export async function post(what, words = {}, body = {}) {
  const bytes = body instanceof Blob || body instanceof ArrayBuffer;
  return (await ask("POST", what, words, bytes ? body : JSON.stringify(body))).json();
}

// A result with errors under the same keys whether they are lengths or angles; the parameters of an
// effect keep their own.
export function sameKeys(value) {
  if (Array.isArray(value)) return value.map(sameKeys);
  if (value === null || typeof value !== "object") return value;
  const pairs = Object.entries(value);
  return Object.fromEntries(pairs.map(([key, inner]) => [key.replace(/_arcsec$/, "_um"), key === "parameters" ? inner : sameKeys(inner)]));
}

// A head and its arrays; see `frame.rs`.
async function framed(answer) {
  const bytes = await answer.arrayBuffer();
  const length = new DataView(bytes).getUint32(0, true);
  const head = JSON.parse(new TextDecoder().decode(new Uint8Array(bytes, 4, length)));
  const arrays = {};
  let at = 4 + length;
  for (const { name, bits, count } of head.arrays) {
    const Kind = bits === 64 ? Float64Array : Float32Array;
    arrays[name] = new Kind(bytes, at, count);
    at += Math.ceil((count * bits) / 64) * 8;
  }
  return { ...head, ...arrays };
}

export async function getFrame(what, words = {}) {
  return framed(await ask("GET", what, words));
}

export async function postFrame(what, words = {}, body = {}) {
  return framed(await ask("POST", what, words, JSON.stringify(body)));
}
