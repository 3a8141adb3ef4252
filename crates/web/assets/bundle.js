// The bundle's code, compiled once: for the page, and for the worker that it may start. Where it is split, the rest is
// fetched when what is needed at first is there.

const compile = (name) => WebAssembly.compileStreaming(fetch(new URL(name, import.meta.url)))
const isSplit = (module) => WebAssembly.Module.exports(module).some(({ name }) => name === "there")

export const compiled = compile("web_bg.wasm")
export const rest = compiled.then((module) => isSplit(module) ? compile("web_rest.wasm") : undefined)
// whoever waits for them says what went wrong
compiled.catch(() => {})
rest.catch(() => {})
