// The page's only way to the server: one request function, with the token.
// `thinglab serve` prints an address that ends in #token=…; a fragment is never sent over the wire.
// The token is kept for this tab alone and taken out of the address at once.

const KEY = "thinglab-token"
const given = new URLSearchParams(location.hash.slice(1)).get("token")
if (given) {
  sessionStorage.setItem(KEY, given)
  history.replaceState(null, "", location.pathname + location.search)
}

// Sends `body` (text, or undefined for none); gives [status, text]. Status 0: no server there.
export async function request(method, path, body) {
  const headers = { "x-thinglab-token": sessionStorage.getItem(KEY) ?? "" }
  if (body !== undefined) headers["content-type"] = "application/json"
  try {
    const answer = await fetch(path, { method, headers, body, cache: "no-store" })
    return [answer.status, await answer.text()]
  } catch (error) {
    return [0, String(error)]
  }
}
