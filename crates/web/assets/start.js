// Loads the bundle. What goes wrong here is said on the page, where there is no Rust yet to say it.

import init from "./web.js"

try {
  await init({ module_or_path: new URL("web_bg.wasm", import.meta.url) })
} catch (error) {
  const notice = document.createElement("p")
  notice.className = "notice"
  notice.setAttribute("role", "alert")
  notice.textContent = `The lab could not start: ${error}`
  document.body.append(notice)
  throw error
}
