// Loads the bundle. What goes wrong here is said on the page, where there is no Rust yet to say it.

import { compiled, restCompiled } from "./bundle.js"
import { haveRest } from "./rest.js"
import init from "./web.js"

try {
  haveRest(await restCompiled)
  await init({ module_or_path: await compiled })
} catch (error) {
  const notice = document.createElement("p")
  notice.className = "notice"
  notice.setAttribute("role", "alert")
  notice.textContent = `The lab could not start: ${error}`
  document.body.append(notice)
  throw error
}
