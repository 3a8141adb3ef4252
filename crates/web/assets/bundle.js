// The bundle's code, compiled once: for the page, and for the worker that it may start.

const fetched = fetch(new URL("web_bg.wasm", import.meta.url))
export const compiled = WebAssembly.compileStreaming(fetched)
// whoever waits for it says what went wrong
compiled.catch(() => {})
