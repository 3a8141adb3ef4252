// Small things that the browser gives better than Rust does.

// Shows that the lab has stopped, where there is no Rust left to say it. What was unsaved stands in
// the browser's storage, outside the bundle's memory.
export function showCrash(title, advice, reload, details) {
  if (document.querySelector(".crash")) return
  const box = document.createElement("div")
  box.className = "crash"
  box.setAttribute("role", "alertdialog")
  box.setAttribute("aria-label", title)
  const heading = document.createElement("h1")
  heading.textContent = title
  const paragraph = document.createElement("p")
  paragraph.textContent = advice
  const button = document.createElement("button")
  button.className = "primary"
  button.textContent = reload
  button.addEventListener("click", () => location.reload())
  const code = document.createElement("pre")
  code.textContent = details
  box.append(heading, paragraph, button, code)
  document.body.append(box)
  button.focus()
}

// Ends the task, so that the page has its turn, and goes on.
export const pause = () => globalThis.scheduler?.yield?.() ?? new Promise((resolve) => setTimeout(resolve))

// After the next frame is painted; a tab that is not seen paints none, and does not wait.
export const painted = () => new Promise((resolve) => {
  requestAnimationFrame(() => setTimeout(resolve))
  setTimeout(resolve, 100)
})

// Hands the user a file: a text, or bytes.
export function download(name, content) {
  const link = document.createElement("a")
  const type = typeof content === "string" ? "text/plain;charset=utf-8" : "application/octet-stream"
  link.href = URL.createObjectURL(new Blob([content], { type }))
  link.download = name
  link.click()
  setTimeout(() => URL.revokeObjectURL(link.href), 1000)
}

// Hands the user an SVG as a PNG of twice its size, on white.
export function downloadPng(name, svg) {
  const picture = new Image()
  picture.onload = () => {
    const canvas = document.createElement("canvas")
    canvas.width = 2 * (picture.naturalWidth || 800)
    canvas.height = 2 * (picture.naturalHeight || 600)
    const pen = canvas.getContext("2d")
    pen.fillStyle = "white"
    pen.fillRect(0, 0, canvas.width, canvas.height)
    pen.drawImage(picture, 0, 0, canvas.width, canvas.height)
    canvas.toBlob((blob) => {
      const link = document.createElement("a")
      link.href = URL.createObjectURL(blob)
      link.download = name
      link.click()
      setTimeout(() => URL.revokeObjectURL(link.href), 1000)
    }, "image/png")
    URL.revokeObjectURL(picture.src)
  }
  picture.src = URL.createObjectURL(new Blob([svg], { type: "image/svg+xml" }))
}

export const printPage = () => window.print()

// Copies a text; false where the browser does not let it.
export async function copy(text) {
  try {
    await navigator.clipboard.writeText(text)
    return true
  } catch {
    return false
  }
}

// The text that the clipboard holds; undefined where the browser does not let it be read.
export async function pasted() {
  try {
    return await navigator.clipboard.readText()
  } catch {
    return undefined
  }
}

// Copy, cut and paste by the system's keys and menus, where they are not of a field or of marked words: `take` is told
// which and gives a text, or undefined; `put` is given one.
export function onClipboard(take, put) {
  // what a field or the editor has done itself is prevented already
  const isWritten = ({ target, defaultPrevented }) =>
    defaultPrevented || target.closest?.("input, textarea, select, [contenteditable='true']")
  for (const kind of ["copy", "cut"]) {
    addEventListener(kind, (event) => {
      const text = isWritten(event) || marked() ? undefined : take(kind)
      if (text === undefined) return
      event.clipboardData.setData("text/plain", text)
      event.preventDefault()
    })
  }
  addEventListener("paste", (event) => {
    const text = isWritten(event) ? "" : event.clipboardData.getData("text/plain")
    if (text === "") return
    put(text)
    event.preventDefault()
  })
}

// Compresses a text into letters that an address may have, and brings it back.
export async function pack(text) {
  const stream = new Blob([text]).stream().pipeThrough(new CompressionStream("deflate-raw"))
  const bytes = new Uint8Array(await new Response(stream).arrayBuffer())
  let letters = ""
  for (const byte of bytes) letters += String.fromCharCode(byte)
  return btoa(letters).replaceAll("+", "-").replaceAll("/", "_").replaceAll("=", "")
}

// A link may unpack to so much and no more.
const MOST_UNPACKED = 1 << 20

export async function unpack(packed) {
  try {
    const letters = atob(packed.replaceAll("-", "+").replaceAll("_", "/"))
    const bytes = Uint8Array.from(letters, (letter) => letter.charCodeAt(0))
    const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("deflate-raw"))
    const reader = stream.getReader()
    const parts = []
    let size = 0
    for (;;) {
      const { done, value } = await reader.read()
      if (done) break
      size += value.length
      if (size > MOST_UNPACKED) return undefined
      parts.push(value)
    }
    return await new Blob(parts).text()
  } catch {
    return undefined
  }
}

// Lets a person choose a file, and calls back with its name and its text.
export function chooseFile(endings, chosen) {
  const input = document.createElement("input")
  input.type = "file"
  input.accept = endings
  input.addEventListener("change", async () => {
    const [file] = input.files
    if (file) chosen(file.name, await file.text())
  })
  input.click()
}

// Lets tests and people at the console look at the lab: window.__thinglab.state().
export function publish(state) {
  window.__thinglab = { state: () => JSON.parse(state()) }
}

// Puts a measurement where a test finds it.
export function publishBench(json) {
  window.__bench = JSON.parse(json)
}

// Calls back when the system goes from light to dark or back, or chooses the colours itself.
export function onColorScheme(callback) {
  for (const feature of ["prefers-color-scheme: dark", "forced-colors: active"]) {
    matchMedia(`(${feature})`).addEventListener("change", callback)
  }
}

// Whether the system asks for little motion, and whether the finger is the pointer.
export const calm = () => matchMedia("(prefers-reduced-motion: reduce)").matches
export const coarse = () => matchMedia("(pointer: coarse)").matches

// Whether words of the page are marked.
const marked = () => getSelection()?.isCollapsed === false

// Follows a pointer outside the element; a pointer that no device has cannot be followed.
export function capture(element, pointer) {
  try {
    element.setPointerCapture(pointer)
  } catch {
    // A synthetic event: its moves are sent to the element anyway.
  }
}

// Whether this is the worker.
export const isWorker = () => typeof document === "undefined"

// The name of this tab among those of the address. A lock says as long as the tab lives that it does: it is let go
// whatever ends the tab.
const TAB = "thinglab/tab/"
const tab = isWorker() ? "" : crypto.randomUUID()
if (tab) navigator.locks?.request(TAB + tab, () => new Promise(() => {}))

export const tabName = () => tab

// The names of the tabs that live, this one among them.
export async function liveTabs() {
  const { held = [] } = (await navigator.locks?.query()) ?? {}
  return held.filter(({ name }) => name.startsWith(TAB)).map(({ name }) => name.slice(TAB.length))
}

// In the worker: every job is handed on, with what tells the page an answer; no bytes are the end.
export function serve(answer) {
  onmessage = ({ data }) => {
    answer(data, (bytes) => postMessage(bytes ? ["part", bytes] : ["over"]))
  }
}

// In the page: starts a worker, which calls back with a word and what belongs to it: `ready`; `part` and bytes; `over`;
// `failed` and why. Undefined where the browser refuses.
export function startWorker(said) {
  let worker
  try {
    worker = new Worker(new URL("worker.js", import.meta.url), { type: "module" })
  } catch {
    return undefined
  }
  worker.onmessage = ({ data }) => said(data[0], data[1])
  worker.onerror = (event) => {
    event.preventDefault()
    said("failed", event.message ?? "")
  }
  const begin = async () => {
    const { compiled } = await import("./bundle.js")
    const { restIfThere } = await import("./rest.js")
    worker.postMessage([await compiled, restIfThere()])
  }
  begin().catch((error) => said("failed", String(error)))
  return { ask: (job) => worker.postMessage(job), end: () => worker.terminate() }
}
