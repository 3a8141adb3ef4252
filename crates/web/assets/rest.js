// The rest of the bundle's code: what no first drag needs comes while the page is in use already. What is called of it
// sooner waits until it is there.

import { showCrash } from "./page.js"

// The exports of what is there from the start; none where the bundle is not split.
let first
// The rest, compiled, where it was handed over.
let handed

// In the worker: the page hands over what it has.
export function handRest(module) {
  handed = module
}

// Has the rest come.
export async function beginRest(exports) {
  if (!exports.there) return
  first = exports
  if (typeof document === "undefined") return
  try {
    const { rest } = await import("./bundle.js")
    put(await rest)
  } catch {
    // it is asked for again where it is needed
  }
}

// Returns once it is there.
export function needRest() {
  if (!first || first.there.value) return
  try {
    put(handed ?? new WebAssembly.Module(fetchedAtOnce()))
  } catch (error) {
    if (typeof document !== "undefined") {
      const advice = "A part of the lab did not come from the server. What was not saved is kept; load the page again."
      showCrash("The lab has stopped", advice, "Load again", String(error))
    }
    throw error
  }
}

function put(module) {
  if (first.there.value) return
  new WebAssembly.Instance(module, { first })
  first.there.value = 1
}

// The file while everything waits: the caller is in the midst of Rust, which cannot be left and come back to.
function fetchedAtOnce() {
  const request = new XMLHttpRequest()
  request.open("GET", new URL("web_rest.wasm", import.meta.url), false)
  // bytes as letters: a page may not ask for others in this way
  request.overrideMimeType("text/plain; charset=x-user-defined")
  request.send()
  if (request.status !== 200) throw new Error(`the rest of the code: ${request.status}`)
  return Uint8Array.from(request.responseText, (letter) => letter.charCodeAt(0) & 255)
}
