// Whether this browser has fetched the rest of the code in a visit before (`rest.js`): then it is at hand, compiled as
// far as it was called, and a visit begins with it.

const KEY = "thinglab/rest"

// a worker keeps nothing; a browser may forbid it
const kept = (use) => {
  try {
    return globalThis.localStorage && use(localStorage)
  } catch {
    return undefined
  }
}

export const isRestKept = () => Boolean(kept((store) => store.getItem(KEY)))

export const keepRest = () => kept((store) => store.setItem(KEY, "kept"))
