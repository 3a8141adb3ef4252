// What the page needs first is asked for while its code is on the way: this runs before the other modules are there.

import "./bundle.js"
import { askAhead } from "./host.js"

askAhead("/api/library")
const path = location.hash.startsWith("#/")
  ? decoded(location.hash.slice(2))
  : new URLSearchParams(location.search).get("document")
if (path) askAhead(`/api/document?path=${encodeURIComponent(path)}`)

// As the address was written; a wrong one names nothing.
function decoded(text) {
  try {
    return decodeURIComponent(text)
  } catch {
    return ""
  }
}
