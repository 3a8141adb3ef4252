// The text view: CodeMirror 6 behind the few calls that the page needs.
// In: the document's text, spans and diagnostics, all in UTF-8 byte offsets as the Rust side counts
// them. Out: the text after an edit, the cursor, the hovered offset, what the keys ask for.
// Bundled with CodeMirror into ../codemirror.js by the command in README.md.

import { autocompletion, closeBrackets, closeBracketsKeymap, completionKeymap, startCompletion } from "@codemirror/autocomplete"
import { defaultKeymap } from "@codemirror/commands"
import { bracketMatching, indentUnit } from "@codemirror/language"
import { forEachDiagnostic, lintGutter, lintKeymap, setDiagnostics } from "@codemirror/lint"
import { highlightSelectionMatches, search, searchKeymap } from "@codemirror/search"
import { Annotation, EditorState, StateEffect, StateField, Transaction } from "@codemirror/state"
import { Decoration, drawSelection, EditorView, highlightActiveLine, highlightActiveLineGutter, hoverTooltip, keymap, lineNumbers } from "@codemirror/view"

// A change that came from the page, not from the keyboard: it is not reported back.
const fromPage = Annotation.define()

// ---- Offsets: UTF-8 bytes outside, UTF-16 units inside. Most texts are ASCII, where both agree.

function utf8Length(text) {
  let bytes = text.length
  for (let i = 0; i < text.length; i++) {
    const unit = text.charCodeAt(i)
    if (unit > 0x7f) bytes += unit > 0x7ff && (unit < 0xd800 || unit > 0xdfff) ? 2 : 1
  }
  return bytes
}

// The UTF-16 offset of a byte offset, and back; computed once for each text.
class Offsets {
  constructor(doc) {
    this.doc = doc
    const text = doc.toString()
    this.units = text.length
    this.bytes = utf8Length(text)
    if (this.bytes === this.units) return
    this.starts = new Uint32Array(this.units + 1)
    let at = 0
    for (let i = 0; i < this.units; i++) {
      this.starts[i] = at
      const unit = text.charCodeAt(i)
      // Half of a surrogate pair counts two bytes, so that a pair counts four.
      at += unit < 0x80 ? 1 : unit < 0x800 || (unit >= 0xd800 && unit <= 0xdfff) ? 2 : 3
    }
    this.starts[this.units] = at
  }
  inside(byte) {
    if (!this.starts) return Math.max(0, Math.min(byte, this.units))
    let low = 0
    let high = this.units
    while (low < high) {
      const middle = (low + high) >> 1
      if (this.starts[middle] < byte) low = middle + 1
      else high = middle
    }
    return low
  }
  outside(unit) {
    return this.starts ? this.starts[unit] : unit
  }
}

// ---- Spans: token colours and marks are two layers of decorations that move with the text.

function layer() {
  const replace = StateEffect.define()
  const field = StateField.define({
    create: () => Decoration.none,
    update(spans, transaction) {
      spans = spans.map(transaction.changes)
      for (const effect of transaction.effects) if (effect.is(replace)) spans = effect.value
      return spans
    },
    provide: (own) => EditorView.decorations.from(own),
  })
  return { field, replace }
}
const tokens = layer()
const marks = layer()

// `spans` is flat: from, to, index into `classes`, and again.
function decorations(offsets, spans, classes) {
  const styles = classes.map((name) => Decoration.mark({ class: name }))
  const ranges = []
  for (let i = 0; i + 2 < spans.length; i += 3) {
    const from = offsets.inside(spans[i])
    const to = offsets.inside(spans[i + 1])
    if (from < to) ranges.push(styles[spans[i + 2]].range(from, to))
  }
  return Decoration.set(ranges, true)
}

// ---- Looks: every colour is a variable of the page, so light and dark need nothing here.

const theme = EditorView.theme({
  "&": { height: "100%", color: "var(--ink)", backgroundColor: "var(--paper)" },
  "&.cm-focused": { outline: "2px solid var(--focus)", outlineOffset: "-2px" },
  ".cm-scroller": { fontFamily: "var(--mono)", fontSize: "0.8125rem", lineHeight: "1.5" },
  ".cm-content": { caretColor: "var(--ink)" },
  ".cm-cursor": { borderLeftColor: "var(--ink)" },
  ".cm-gutters": { color: "var(--faint)", backgroundColor: "var(--paper)", borderRight: "1px solid var(--line)" },
  ".cm-activeLine, .cm-activeLineGutter": { backgroundColor: "var(--hover)" },
  "&.cm-focused > .cm-scroller > .cm-selectionLayer .cm-selectionBackground, .cm-selectionBackground": { backgroundColor: "var(--selection)" },
  "&.cm-focused .cm-matchingBracket": { backgroundColor: "var(--selection)", outline: "1px solid var(--line)" },
  ".cm-panels, .cm-tooltip": { color: "var(--ink)", backgroundColor: "var(--raised)", borderColor: "var(--line)" },
  ".cm-tooltip-autocomplete > ul > li[aria-selected]": { color: "var(--on-accent)", backgroundColor: "var(--accent)" },
  ".cm-about": { padding: "0.375rem 0.625rem", maxWidth: "28rem", whiteSpace: "pre-wrap" },
  ".cm-about code": { fontFamily: "var(--mono)", fontSize: "0.8125rem" },
  ".cm-about p": { margin: "0.25rem 0 0" },
  "&.cm-goes .cm-content": { cursor: "pointer" },
  ".cm-diagnosticAction": { font: "inherit", color: "var(--on-accent)", backgroundColor: "var(--accent)", border: "0", borderRadius: "4px", padding: "2px 8px" },
  ".cm-diagnostic": { whiteSpace: "pre-wrap" },
  ".cm-diagnostic-error": { borderLeftColor: "var(--conflict)" },
  ".cm-diagnostic-warning": { borderLeftColor: "var(--redundant)" },
  ".cm-textfield, .cm-button": { color: "var(--ink)", backgroundColor: "var(--paper)", backgroundImage: "none", border: "1px solid var(--line)" },
})

// The one range in which two texts differ, cut so that no surrogate pair is split.
function difference(old, next) {
  let from = 0
  const shortest = Math.min(old.length, next.length)
  while (from < shortest && old.charCodeAt(from) === next.charCodeAt(from)) from++
  let tail = 0
  while (tail < shortest - from && old.charCodeAt(old.length - 1 - tail) === next.charCodeAt(next.length - 1 - tail)) tail++
  const low = (text, at) => at < text.length && (text.charCodeAt(at) & 0xfc00) === 0xdc00
  if (from > 0 && (low(old, from) || low(next, from))) from--
  if (tail > 0 && (low(old, old.length - tail) || low(next, next.length - tail))) tail--
  return { from, to: old.length - tail, insert: next.slice(from, next.length - tail) }
}

// Makes an editor in `parent`. `options`, all but `text` optional:
//   text                          what to show first
//   label                         the name that a screen reader says
//   onChange(text)                after an edit by the user
//   onCursor(offset)              when the user has moved the cursor
//   onHover(offset)               when the pointer is over another offset; -1 when it has left
//   onUndo(), onRedo()            the keys; the editor keeps no history of its own
//   onLeave()                     when the editor loses the focus
//   complete(offset)              [{label, kind, detail}] for the word that ends there
//   about(offset)                 {from, to, says, doc, value} of the word there, or null
//   onDefinition(offset)          F12, or a click with Ctrl: go to where the word there is declared
//   onRename(offset)              F2: give what the word there names another name
//   onFormat()                    Shift+Alt+F: lay the text out
//   onFix(problem, fix)           a fix of a diagnostic was chosen, both by number
export function createEditor(parent, options) {
  let offsets
  const inDoc = (state) => (offsets && offsets.doc === state.doc ? offsets : (offsets = new Offsets(state.doc)))
  const call = (name, ...values) => options[name]?.(...values)
  const asks = (name) => () => (call(name), true)

  // What the cursor's line can be mended by, each once, as completions: a list for the keyboard.
  let mends = false
  const fixesAt = (state, position) => {
    const line = state.doc.lineAt(position)
    const found = new Map()
    forEachDiagnostic(state, (diagnostic, from, to) => {
      if (to < line.from || from > line.to) return
      for (const action of diagnostic.actions ?? []) found.set(action.name, action)
    })
    return [...found.values()]
  }
  const fixes = (context) => {
    mends = false
    const found = fixesAt(context.state, context.pos)
    const option = ({ name, apply }) => ({ label: name, type: "text", apply: (own) => apply(own) })
    return found.length ? { from: context.pos, options: found.map(option), filter: false } : null
  }
  const offerFixes = (own) => {
    if (!fixesAt(own.state, own.state.selection.main.head).length) return true
    mends = true
    return startCompletion(own)
  }

  const completions = (context) => {
    if (mends) return fixes(context)
    const word = context.matchBefore(/[\p{L}\p{N}_.]+/u)
    if (!word && !context.explicit) return null
    const found = options.complete(inDoc(context.state).outside(context.pos))
    const start = word ? Math.max(word.from, word.from + word.text.lastIndexOf(".") + 1) : context.pos
    return { from: start, options: found.map(({ label, kind, detail }, at) => ({ label, type: kind, detail, boost: Math.max(-99, 99 - at) })) }
  }

  const atCursor = (name) => (own) => (call(name, inDoc(own.state).outside(own.state.selection.main.head)), true)
  const about = hoverTooltip((own, position) => {
    const offsets = inDoc(own.state)
    const found = options.about?.(offsets.outside(position))
    if (!found) return null
    const create = () => {
      const dom = document.createElement("div")
      dom.className = "cm-about"
      dom.append(Object.assign(document.createElement("code"), { textContent: found.says }))
      const line = (text) => dom.append(Object.assign(document.createElement("p"), { textContent: text }))
      if (found.value) line(`= ${found.value}`)
      if (found.doc) line(found.doc)
      return { dom }
    }
    return { pos: offsets.inside(found.from), end: offsets.inside(found.to), above: true, create }
  })
  // While Ctrl is held a word is a link to where it is declared.
  const goes = (event, own) => own.dom.classList.toggle("cm-goes", event.ctrlKey || event.metaKey) && false

  let hovered = -1
  const hover = (offset) => {
    if (offset !== hovered) call("onHover", (hovered = offset))
  }

  const view = new EditorView({
    parent,
    state: EditorState.create({
      doc: options.text,
      extensions: [
        lineNumbers(),
        highlightActiveLineGutter(),
        highlightActiveLine(),
        drawSelection(),
        bracketMatching(),
        closeBrackets(),
        highlightSelectionMatches(),
        search({ top: true }),
        lintGutter(),
        indentUnit.of("    "),
        EditorState.tabSize.of(4),
        EditorState.languageData.of(() => [{ commentTokens: { line: "//", block: { open: "/*", close: "*/" } } }]),
        options.complete ? autocompletion({ override: [completions] }) : [],
        about,
        keymap.of([
          { key: "F12", run: atCursor("onDefinition"), preventDefault: true, stopPropagation: true },
          { key: "F2", run: atCursor("onRename"), preventDefault: true, stopPropagation: true },
          { key: "Mod-.", run: offerFixes, preventDefault: true, stopPropagation: true },
          { key: "Shift-Alt-f", run: asks("onFormat"), preventDefault: true, stopPropagation: true },
          { key: "Mod-z", run: asks("onUndo"), preventDefault: true },
          { key: "Mod-y", run: asks("onRedo"), preventDefault: true },
          { key: "Mod-Shift-z", run: asks("onRedo"), preventDefault: true },
          ...closeBracketsKeymap,
          ...completionKeymap,
          ...searchKeymap,
          ...lintKeymap,
          ...defaultKeymap,
        ]),
        EditorView.domEventHandlers({
          // The browser's own undo, from its menu or a gesture, goes the same way as the keys.
          beforeinput(event) {
            if (event.inputType !== "historyUndo" && event.inputType !== "historyRedo") return false
            event.preventDefault()
            call(event.inputType === "historyUndo" ? "onUndo" : "onRedo")
            return true
          },
          mousedown(event, own) {
            if (event.button !== 0 || !(event.ctrlKey || event.metaKey)) return false
            const at = own.posAtCoords({ x: event.clientX, y: event.clientY })
            if (at === null) return false
            event.preventDefault()
            call("onDefinition", inDoc(own.state).outside(at))
            return true
          },
          keydown: goes,
          keyup: goes,
          mousemove(event, own) {
            goes(event, own)
            const at = own.posAtCoords({ x: event.clientX, y: event.clientY })
            hover(at === null ? -1 : inDoc(own.state).outside(at))
          },
          mouseleave: () => hover(-1),
          blur: () => call("onLeave"),
        }),
        EditorView.contentAttributes.of({ "aria-label": options.label ?? "Text", spellcheck: "false", tabindex: "0" }),
        EditorView.updateListener.of((update) => {
          const ours = update.transactions.some((one) => one.annotation(fromPage))
          if (update.docChanged && !ours) call("onChange", update.state.doc.toString())
          if ((update.selectionSet || update.docChanged) && !ours) {
            call("onCursor", inDoc(update.state).outside(update.state.selection.main.head))
          }
        }),
        tokens.field,
        marks.field,
        theme,
      ],
    }),
  })

  const page = (specification) =>
    view.dispatch({ ...specification, annotations: [fromPage.of(true), Transaction.addToHistory.of(false)] })

  return {
    text: () => view.state.doc.toString(),
    // Changes only the range that differs: cursor, selection and scroll stay where they are.
    setText(text) {
      const old = view.state.doc.toString()
      if (old !== text) page({ changes: difference(old, text) })
    },
    // diagnostics: [{from, to, severity: "error" | "warning" | "info" | "hint", message, number, fixes}], the fixes by
    // what their buttons say, `number` what `onFix` is told
    setDiagnostics(diagnostics) {
      const at = inDoc(view.state)
      const list = diagnostics.map(({ from, to, severity, message, number, fixes }) => {
        const actions = fixes.map((name, fix) => ({ name, apply: () => call("onFix", number, fix) }))
        return { from: at.inside(from), to: at.inside(to), severity, message, actions }
      })
      view.dispatch(setDiagnostics(view.state, list))
    },
    setTokens(spans, classes) {
      page({ effects: tokens.replace.of(decorations(inDoc(view.state), spans, classes)) })
    },
    setMarks(spans, classes) {
      page({ effects: marks.replace.of(decorations(inDoc(view.state), spans, classes)) })
    },
    // Moves the cursor there and brings it into sight.
    setCursor(offset) {
      const at = inDoc(view.state).inside(offset)
      // Where the panels lie one below the other, the editor would take the whole page along.
      const stacked = matchMedia("(max-width: 900px)").matches
      const sight = stacked ? [] : EditorView.scrollIntoView(at, { y: "nearest", yMargin: 40 })
      page({ selection: { anchor: at }, effects: sight })
    },
    focus: () => view.focus(),
    destroy: () => view.destroy(),
  }
}
