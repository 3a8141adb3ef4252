// The bundle's code, compiled once: for the page, and for the worker that it may start.

import { isRestKept } from "./kept.js"

const compile = (name) => WebAssembly.compileStreaming(fetch(new URL(name, import.meta.url)))

export const compiled = compile("web_bg.wasm")
// whoever waits for it says what went wrong
compiled.catch(() => {})

// The rest of it, where a visit before has fetched it; else, and where it cannot be had, undefined.
export const restCompiled = isRestKept() ? compile("web_rest.wasm").catch(() => undefined) : undefined
