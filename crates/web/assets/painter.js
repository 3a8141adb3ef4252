// Paints a display list on a canvas. The list is one flat array of numbers, made by `src/paint.rs`,
// which says what each operation means; one call paints one frame. Words and colours that a document
// names come separately, because they seldom change.

import { MANY, createStamps } from "./stamps.js"

// The colours by their part in the picture, in the order of `Hue` in `src/paint.rs`.
const ROLES = ["ink", "faint", "accent", "paper", "free", "fixed", "conflict", "redundant", "halo", "halo-soft", "grid", "grid-strong"]
const DASHES = [[], [7, 5], [0.5, 4], [], [14, 3, 3, 3]]
const NO_LINE = 3
const PAPER = ROLES.indexOf("paper")

// The values that style variables have here and now: only a real element tells, since a variable's
// own text may still be a choice between light and dark.
function roleColors(canvas) {
  const probe = document.createElement("span")
  probe.hidden = true
  // where the system chooses colours, the variables say which of them; all would be that of text
  probe.style.forcedColorAdjust = "none"
  canvas.parentElement.append(probe)
  const colors = ROLES.map((role) => {
    probe.style.color = `var(--${role})`
    return getComputedStyle(probe).color
  })
  probe.remove()
  return colors
}

// Makes a painter that keeps the canvas as sharp as the screen; `onSize(width, height)` hears of
// every new size, in CSS pixels.
export function createPainter(canvas, onSize) {
  const context = canvas.getContext("2d")
  let ratio = 1
  let width = 0
  let height = 0
  let roles = []
  let named = []
  let colors = []
  let words = []
  let font = "sans-serif"
  const under = document.createElement("canvas")
  let kept = false
  const stamps = createStamps()

  const observer = new ResizeObserver(([entry]) => {
    const box = entry.contentRect
    if (box.width === 0 || box.height === 0) return
    width = box.width
    height = box.height
    // an emulated screen tells the pixels of the real one
    const told = entry.devicePixelContentBoxSize?.[0]
    const exact = told && Math.abs(told.inlineSize - width * devicePixelRatio) < 2 ? told : undefined
    canvas.width = exact ? exact.inlineSize : Math.round(width * devicePixelRatio)
    canvas.height = exact ? exact.blockSize : Math.round(height * devicePixelRatio)
    ratio = canvas.width / width
    stamps.forget()
    if (roles.length === 0) own.look()
    onSize(width, height)
  })
  try {
    observer.observe(canvas, { box: "device-pixel-content-box" })
  } catch {
    observer.observe(canvas)
  }

  function mark(c, kind, x, y, r) {
    if (kind === 0) {
      c.moveTo(x + r, y)
      c.arc(x, y, r, 0, 2 * Math.PI)
    } else if (kind === 1) {
      c.rect(x - r, y - r, 2 * r, 2 * r)
    } else if (kind === 2) {
      c.moveTo(x - r, y - r)
      c.lineTo(x + r, y + r)
      c.moveTo(x - r, y + r)
      c.lineTo(x + r, y - r)
    } else {
      c.moveTo(x, y - r)
      c.lineTo(x + r, y)
      c.lineTo(x, y + r)
      c.lineTo(x - r, y)
      c.closePath()
    }
  }

  // How many points from an operation on are of its kind and size.
  function alike(list, from) {
    const [kind, r] = [list[from + 1], list[from + 4]]
    let end = from
    while (list[end] === 5 && list[end + 1] === kind && list[end + 4] === r) end += 5
    return (end - from) / 5
  }

  function arrow(x, y, dx, dy) {
    const c = context
    const length = Math.hypot(dx, dy)
    if (length < 1) return
    const [ux, uy] = [dx / length, dy / length]
    const [tx, ty] = [x + dx, y + dy]
    const head = Math.min(8, length)
    c.moveTo(x, y)
    c.lineTo(tx, ty)
    c.moveTo(tx - head * (ux + 0.5 * uy), ty - head * (uy - 0.5 * ux))
    c.lineTo(tx, ty)
    c.lineTo(tx - head * (ux - 0.5 * uy), ty - head * (uy + 0.5 * ux))
  }

  const own = {
    // Reads the page's colours again, after light has become dark.
    look() {
      roles = roleColors(canvas)
      colors = [...roles, ...named]
      stamps.forget()
      font = getComputedStyle(canvas).fontFamily
    },
    setColors(list) {
      named = list
      colors = [...roles, ...named]
      stamps.forget()
    },
    setWords(list) {
      words = list
    },
    // A point of the sheet lies at (x + kx * its x, y + ky * its y) on the canvas.
    paint(list, x, y, kx, ky) {
      const c = context
      const onScreen = () => c.setTransform(ratio, 0, 0, ratio, 0, 0)
      const onSheet = () => c.setTransform(ratio * kx, 0, 0, ratio * ky, ratio * x, ratio * y)
      c.setTransform(1, 0, 0, 1, 0, 0)
      c.globalAlpha = 1
      c.clearRect(0, 0, canvas.width, canvas.height)
      if (kept) c.drawImage(under, 0, 0)
      onScreen()
      c.lineJoin = "round"
      let fill = -1
      let stroke = -1
      let line = NO_LINE
      let thickness = 1
      let rule = "nonzero"
      const inStyle = (c) => {
        if (fill >= 0) {
          c.fillStyle = colors[fill]
          c.fill(rule)
        }
        if (line !== NO_LINE && stroke >= 0) {
          c.strokeStyle = colors[stroke]
          c.lineWidth = thickness
          c.lineCap = line === 1 || line === 4 ? "butt" : "round"
          c.setLineDash(DASHES[line])
          c.stroke()
        }
      }
      // A path is built where its numbers live and drawn on the screen, where widths are pixels.
      const draw = () => {
        onScreen()
        inStyle(c)
      }
      // What stands in the path is drawn before, so that later points still hide earlier ones.
      const stamp = (from, count) => {
        draw()
        c.beginPath()
        const [kind, r] = [list[from + 1], list[from + 4]]
        const places = new Float64Array(2 * count)
        for (let n = 0; n < count; n++) {
          places[2 * n] = ratio * (x + kx * list[from + 5 * n + 2])
          places[2 * n + 1] = ratio * (y + ky * list[from + 5 * n + 3])
        }
        stamps.put(c, places, {
          key: `${stroke} ${fill} ${line} ${thickness} ${kind} ${r}`,
          half: Math.ceil((r * Math.SQRT2 + thickness) * ratio) + 1,
          paintOne(c, x, y) {
            c.setTransform(ratio, 0, 0, ratio, x, y)
            c.lineJoin = "round"
            c.beginPath()
            mark(c, kind, 0, 0, r)
            inStyle(c)
          },
        })
        onScreen()
      }
      for (let i = 0; i < list.length; ) {
        switch (list[i++]) {
          case 1: {
            draw()
            stroke = list[i++]
            fill = list[i++]
            line = list[i++]
            thickness = list[i++]
            c.beginPath()
            if (list[i++]) onScreen()
            else onSheet()
            break
          }
          case 2:
            c.moveTo(list[i], list[i + 1])
            c.lineTo(list[i + 2], list[i + 3])
            i += 4
            break
          case 3: {
            const closed = list[i++]
            const end = i + 1 + 2 * list[i]
            i++
            for (let first = true; i < end; i += 2, first = false) {
              if (first) c.moveTo(list[i], list[i + 1])
              else c.lineTo(list[i], list[i + 1])
            }
            if (closed) c.closePath()
            break
          }
          case 4: {
            const [cx, cy, r, start, sweep] = list.subarray(i, i + 5)
            c.moveTo(cx + r * Math.cos(start), cy + r * Math.sin(start))
            c.arc(cx, cy, r, start, start + sweep, sweep < 0)
            i += 5
            break
          }
          case 5: {
            const count = alike(list, i - 1)
            if (count >= MANY) {
              stamp(i - 1, count)
              i += 5 * count - 1
              break
            }
            for (const end = i - 1 + 5 * count; i < end; i += 5) {
              mark(c, list[i], x + kx * list[i + 1], y + ky * list[i + 2], list[i + 3])
            }
            i -= 1
            break
          }
          case 6: {
            const size = list[i + 5] ? list[i + 4] * Math.abs(ky) : list[i + 4]
            c.font = `${size}px ${font}`
            c.textAlign = ["left", "center", "right"][list[i + 3]]
            c.fillStyle = colors[stroke]
            onScreen()
            // A label of constant size stands beside its point unless it is centred there, on a rim of
            // paper.
            const label = !list[i + 5]
            const widest = label ? undefined : list[i + 5] * Math.abs(ky)
            const left = x + kx * list[i + 1] + (label ? [7, 0, -7][list[i + 3]] : 0)
            const top = y + ky * list[i + 2] - (label && list[i + 3] !== 1 ? 7 : 0)
            const turn = list[i + 6]
            if (turn) {
              c.translate(left, top)
              c.rotate(ky < 0 ? -turn : turn)
              c.translate(-left, -top)
            }
            const lines = (words[list[i]] ?? "").split("\n")
            const begin = left + list[i + 7] * size
            const first = top + list[i + 8] * size
            lines.forEach((text, n) => {
              if (label) {
                c.strokeStyle = colors[PAPER]
                c.lineWidth = 3
                c.setLineDash([])
                c.strokeText(text, begin, first + 1.2 * size * n)
              }
              c.fillText(text, begin, first + 1.2 * size * n, widest)
            })
            onSheet()
            i += 9
            break
          }
          case 7: {
            const [px, py, dx, dy, pixels] = list.subarray(i, i + 5)
            arrow(x + kx * px, y + ky * py, Math.sign(kx) * pixels * dx, Math.sign(ky) * pixels * dy)
            i += 5
            break
          }
          case 8: {
            const [cx, cy, a, b, turned, start, sweep] = list.subarray(i, i + 7)
            const [px, py] = [a * Math.cos(start), b * Math.sin(start)]
            const [ex, ey] = [Math.cos(turned), Math.sin(turned)]
            c.moveTo(cx + px * ex - py * ey, cy + px * ey + py * ex)
            c.ellipse(cx, cy, a, b, turned, start, start + sweep, sweep < 0)
            i += 7
            break
          }
          case 9:
            c.moveTo(list[i], list[i + 1])
            i += 2
            break
          case 10:
            c.lineTo(list[i], list[i + 1])
            i += 2
            break
          case 11:
            c.closePath()
            break
          case 12: {
            const [cx, cy, r, start, sweep] = list.subarray(i, i + 5)
            c.arc(cx, cy, r, start, start + sweep, sweep < 0)
            i += 5
            break
          }
          case 15:
            draw()
            c.beginPath()
            c.globalAlpha = list[i++]
            break
          case 14:
            c.bezierCurveTo(...list.subarray(i, i + 6))
            i += 6
            break
          case 13:
            // a hole of a region is one by its number alone, whichever way it runs
            draw()
            c.beginPath()
            onSheet()
            rule = list[i++] ? "evenodd" : "nonzero"
            break
        }
      }
      draw()
    },
    // What is on the canvas now lies under what is painted next, until it is forgotten.
    keep() {
      under.width = canvas.width
      under.height = canvas.height
      under.getContext("2d").drawImage(canvas, 0, 0)
      kept = true
    },
    forget() {
      kept = false
    },
    stop: () => observer.disconnect(),
  }
  return own
}
