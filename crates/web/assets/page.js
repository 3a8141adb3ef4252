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

// Hands the user a file.
export function download(name, text) {
  const link = document.createElement("a")
  link.href = URL.createObjectURL(new Blob([text], { type: "text/plain;charset=utf-8" }))
  link.download = name
  link.click()
  setTimeout(() => URL.revokeObjectURL(link.href), 1000)
}

// Lets a person choose a file, and calls back with its name and its text.
export function chooseFile(chosen) {
  const input = document.createElement("input")
  input.type = "file"
  input.accept = ".thing,text/plain"
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

// Calls back when the system goes from light to dark or back.
export function onColorScheme(callback) {
  matchMedia("(prefers-color-scheme: dark)").addEventListener("change", callback)
}

// Whether the system asks for little motion, and whether the finger is the pointer.
export const calm = () => matchMedia("(prefers-reduced-motion: reduce)").matches
export const coarse = () => matchMedia("(pointer: coarse)").matches

// Follows a pointer outside the element; a pointer that no device has cannot be followed.
export function capture(element, pointer) {
  try {
    element.setPointerCapture(pointer)
  } catch {
    // A synthetic event: its moves are sent to the element anyway.
  }
}
