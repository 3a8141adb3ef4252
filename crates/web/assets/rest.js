// The rest of the code: what is not run until a first drag (`xtask/bindgen/src/split.rs`). It is fetched when the page
// stands, or at its first call; a later visit begins with it.

import { keepRest } from "./kept.js"
import { isWorker, showCrash } from "./page.js"
import { initSync } from "./web.js"

const address = new URL("web_rest.wasm", import.meta.url)
const AGAIN_MS = 5000
let there
// compiled, and not in its place yet
let code

const isMissing = () => !there && "is_divided" in initSync()

// Takes what was compiled before the first part ran, for the first call.
export const haveRest = (rest) => (code = rest)

// Fetches it while the page goes on; where the server does not answer, later again. Returns whether it has come.
export async function fetchRest() {
  try {
    if (isMissing()) takeRest(code ?? (await WebAssembly.compileStreaming(fetch(address))))
  } catch (error) {
    // what is of another build never fits; its first call says so
    if (error instanceof WebAssembly.LinkError) return false
    await new Promise((resolve) => setTimeout(resolve, AGAIN_MS))
    return fetchRest()
  }
  if (there) keepRest()
  return Boolean(there)
}

// Has it at once: the code that calls it waits.
export function loadRest() {
  if (!isMissing()) return
  try {
    if (code) return takeRest(code)
    const request = new XMLHttpRequest()
    request.open("GET", address, false)
    // the only way to bytes that does not give way to the page
    request.overrideMimeType("text/plain; charset=x-user-defined")
    request.send()
    const text = request.responseText
    const bytes = new Uint8Array(text.length)
    for (let i = 0; i < bytes.length; i++) bytes[i] = text.charCodeAt(i)
    takeRest(new WebAssembly.Module(bytes))
  } catch (error) {
    const advice = "A part of its code could not be fetched. What you made is kept in this browser."
    if (!isWorker()) showCrash("The lab has stopped", advice, "Reload", String(error))
    throw error
  }
}

// What has come, compiled; the worker is handed it.
export const restIfThere = () => there

// Puts it in its place.
export function takeRest(rest) {
  // it may have come both ways
  if (there) return
  new WebAssembly.Instance(rest, { first: initSync() })
  there = rest
}
