// The text editor is fetched when a text is first shown: whoever only looks and drags does without it.

export async function createEditor(parent, options) {
  const { createEditor } = await import("./codemirror.js")
  return createEditor(parent, options)
}
