// The worker that answers long jobs: the same bundle, without the page. Its first message is the compiled code, which
// it shares with the page: what one of them calls is compiled for both.

import { takeRest } from "./rest.js"
import init from "./web.js"

onmessage = async ({ data: [first, rest] }) => {
  try {
    await init({ module_or_path: first })
    if (rest) takeRest(rest)
    postMessage(["ready"])
  } catch (error) {
    postMessage(["failed", String(error)])
  }
}
