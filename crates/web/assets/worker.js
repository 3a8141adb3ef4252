// The worker that answers long jobs: the same bundle, without the page. Its first message is the compiled code.

import { handRest } from "./rest.js"
import init from "./web.js"

onmessage = async ({ data: [compiled, rest] }) => {
  try {
    handRest(rest)
    await init({ module_or_path: compiled })
    postMessage(["ready"])
  } catch (error) {
    postMessage(["failed", String(error)])
  }
}
