// The page's only way to the server: one request function, with the token.
// `thinglab serve` prints an address that ends in #token=…; a fragment is never sent over the wire.
// The token is kept in the tabs of this address alone and taken out of the address at once. A tab that was
// opened from another one (a card clicked with Ctrl) asks those that are open for it.

const KEY = "thinglab-token"
// a worker has the module as well, and no server
const isPage = typeof document !== "undefined"
const given = isPage && new URLSearchParams(location.hash.slice(1)).get("token")
if (given) {
  sessionStorage.setItem(KEY, given)
  history.replaceState(null, "", location.pathname + location.search)
}

if (isPage) {
  const tabs = new BroadcastChannel(KEY)
  tabs.onmessage = ({ data }) => {
    const own = sessionStorage.getItem(KEY)
    if (data === "ask" && own) tabs.postMessage({ token: own })
    // a server that was started again has another token: tabs of the one before go on with it
    if (data?.renewed) sessionStorage.setItem(KEY, data.renewed)
  }
  if (given) tabs.postMessage({ renewed: given })
}

// Another tab answers as soon as it has its turn: one that opens a large document may take its time.
const ANSWER_MS = 3000
let asked

// The token: this tab's, or that of another tab.
function token() {
  return sessionStorage.getItem(KEY) || (asked ??= askTabs().finally(() => (asked = undefined)))
}

function askTabs() {
  return new Promise((resolve) => {
    const asking = new BroadcastChannel(KEY)
    const done = (answer) => {
      asking.close()
      if (answer) sessionStorage.setItem(KEY, answer)
      resolve(answer)
    }
    asking.onmessage = ({ data }) => {
      if (data?.token) done(data.token)
    }
    asking.postMessage("ask")
    setTimeout(() => done(""), ANSWER_MS)
  })
}

// What was asked for before there was anybody to take it, by its path. What nobody took for so long is asked for anew.
const ahead = new Map()
const KEPT_MS = 10_000

// Asks for a path now; who requests it next is given the answer.
export function askAhead(path) {
  ahead.set(path, { at: performance.now(), answer: send("GET", path) })
}

// Sends `body` (text, or undefined for none); gives [status, text]. Status 0: no server there.
export async function request(method, path, body) {
  const asked = method === "GET" && ahead.get(path)
  if (asked) {
    ahead.delete(path)
    const answer = await asked.answer
    if (answer[0] === 200 && performance.now() - asked.at < KEPT_MS) return answer
  }
  return send(method, path, body)
}

async function send(method, path, body) {
  const headers = { "x-thinglab-token": await token() }
  if (body !== undefined) headers["content-type"] = "application/json"
  try {
    const answer = await fetch(path, { method, headers, body, cache: "no-store" })
    return [answer.status, await answer.text()]
  } catch (error) {
    return [0, String(error)]
  }
}
