// The worker that answers long jobs: the same bundle, without the page. Its first message is the compiled code.

import init from "./web.js"

onmessage = async ({ data }) => {
  try {
    await init({ module_or_path: data })
    postMessage(["ready"])
  } catch (error) {
    postMessage(["failed", String(error)])
  }
}
