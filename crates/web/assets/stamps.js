// Many points that look alike. A browser fills a path of thousands of circles slowly, so each look is drawn
// once, at all the places between pixels that one can tell apart; its pixels are then put where the points lie.

// From so many points on, stamps are faster than one path.
export const MANY = 64
const PHASES = 4
const OPAQUE = 255

// One look at one place between pixels: the pixels that are not empty, from the middle.
function pixelsOf(paintOne, half, x, y) {
  const size = 2 * half + 1
  const canvas = new OffscreenCanvas(size, size)
  const c = canvas.getContext("2d", { willReadFrequently: true })
  paintOne(c, half + x, half + y)
  const all = new Uint32Array(c.getImageData(0, 0, size, size).data.buffer)
  const seen = [...all.keys()].filter((at) => all[at] >>> 24)
  return {
    right: Int16Array.from(seen, (at) => (at % size) - half),
    down: Int16Array.from(seen, (at) => Math.floor(at / size) - half),
    colors: Uint32Array.from(seen, (at) => all[at]),
  }
}

// A colour over another: red, green, blue and opacity from the lowest byte to the highest.
function over(above, below) {
  const [a, b] = [above >>> 24, below >>> 24]
  const left = (b * (OPAQUE - a)) / OPAQUE
  const opacity = a + left
  let mixed = Math.round(opacity) << 24
  for (let shift = 0; shift < 24; shift += 8) {
    const color = (((above >>> shift) & OPAQUE) * a + ((below >>> shift) & OPAQUE) * left) / opacity
    mixed |= Math.round(color) << shift
  }
  return mixed >>> 0
}

export function createStamps() {
  const looks = new Map()
  const canvas = document.createElement("canvas")
  let buffer = new Uint32Array(0)

  function look(key, half, paintOne) {
    let found = looks.get(key)
    if (!found) {
      const phases = Array.from({ length: PHASES * PHASES }, (_, n) =>
        pixelsOf(paintOne, half, (n % PHASES) / PHASES, Math.floor(n / PHASES) / PHASES),
      )
      looks.set(key, (found = phases))
    }
    return found
  }

  return {
    // Colours or the screen have changed.
    forget: () => looks.clear(),

    // Puts a look at places, x and y in pixels after each other. `paintOne(context, x, y)` paints it in pixels,
    // nothing of it further than `half` from there; `key` tells it from others.
    put(context, places, { key, half, paintOne }) {
      const { width, height } = context.canvas
      const isSeen = (x, y) => x > -half && y > -half && x < width + half && y < height + half
      let [left, top, right, bottom] = [Infinity, Infinity, -Infinity, -Infinity]
      for (let i = 0; i < places.length; i += 2) {
        const [x, y] = [places[i], places[i + 1]]
        if (!isSeen(x, y)) continue
        left = Math.min(left, x)
        right = Math.max(right, x)
        top = Math.min(top, y)
        bottom = Math.max(bottom, y)
      }
      if (left > right) return
      const [x0, y0] = [Math.floor(left) - half - 1, Math.floor(top) - half - 1]
      const [w, h] = [Math.ceil(right) + half + 2 - x0, Math.ceil(bottom) + half + 2 - y0]
      if (buffer.length < w * h) buffer = new Uint32Array(w * h)
      else buffer.fill(0, 0, w * h)
      const phases = look(key, half, paintOne)
      for (let i = 0; i < places.length; i += 2) {
        const [x, y] = [places[i], places[i + 1]]
        if (!isSeen(x, y)) continue
        const [qx, qy] = [Math.round((x - x0) * PHASES), Math.round((y - y0) * PHASES)]
        const stamp = phases[(qy % PHASES) * PHASES + (qx % PHASES)]
        const middle = Math.floor(qy / PHASES) * w + Math.floor(qx / PHASES)
        for (let n = 0; n < stamp.colors.length; n++) {
          const at = middle + stamp.down[n] * w + stamp.right[n]
          const color = stamp.colors[n]
          const isAlone = color >>> 24 === OPAQUE || buffer[at] === 0
          buffer[at] = isAlone ? color : over(color, buffer[at])
        }
      }
      if (canvas.width < w || canvas.height < h) {
        canvas.width = Math.max(canvas.width, w)
        canvas.height = Math.max(canvas.height, h)
      }
      const pixels = new Uint8ClampedArray(buffer.buffer, 0, 4 * w * h)
      canvas.getContext("2d").putImageData(new ImageData(pixels, w, h), 0, 0)
      context.setTransform(1, 0, 0, 1, 0, 0)
      context.drawImage(canvas, 0, 0, w, h, x0, y0, w, h)
    },
  }
}
