// The same panes where there is no WebGL2: each picture is toned on the CPU when what decides its colours changes, and
// scaled by the browser. Only the neutral curve and no curve are here; tests/measure holds this copy of
// shading/tone_curves.glsl and shading/transfer.glsl against the shader.

function srgbFromLinear(v) {
  return v <= 0.0031308 ? 12.92 * v : 1.055 * v ** (1 / 2.4) - 0.055;
}
function linearFromSrgb(v) {
  return v <= 0.04045 ? v / 12.92 : ((v + 0.055) / 1.055) ** 2.4;
}

// Khronos PBR Neutral of one colour, in place, with the gain that keeps 18 % grey.
function toneNeutral(c) {
  for (let i = 0; i < 3; ++i) c[i] = Math.max(c[i] * 0.22 / 0.18, 0);
  const x = Math.min(c[0], c[1], c[2]);
  const offset = x <= 0.08 ? x - x * x / 0.16 : 0.04;
  for (let i = 0; i < 3; ++i) c[i] -= offset;
  const peak = Math.max(c[0], c[1], c[2]), start = 0.76, headroom = 1 - start;
  if (peak <= start) return;
  const top = 1 - headroom * headroom / (peak + headroom - start);
  const g = 1 / (0.15 * (peak - top) + 1);
  for (let i = 0; i < 3; ++i) c[i] = top + (c[i] * top / peak - top) * g;
}

function displayColor(c, tone) {
  if (tone !== 0) toneNeutral(c);
  for (let i = 0; i < 3; ++i) c[i] = 255 * srgbFromLinear(Math.min(Math.max(c[i], 0), 1));
}

function make2dRenderer(canvas, report, pictures) {
  const context = canvas.getContext("2d", {willReadFrequently: true});
  const {width, height} = report;
  const cache = new Map();

  const paint = (pane, view, right) => {
    const image = new ImageData(width, height), out = image.data, map = report.colorMapBytes;
    const a = right ? pane.b.halves : pane.a.halves, b = pane.b.halves, color = [0, 0, 0];
    const linear = report.luminance ? v => v : linearFromSrgb;
    for (let i = 0; i < width * height; ++i) {
      if (pane.kind === 3) {
        for (let c = 0; c < 3; ++c) out[4 * i + c] = map[3 * pane.error[i] + c];
      } else {
        for (let c = 0; c < 3; ++c) {
          color[c] = linear(numberOfHalf[a[3 * i + c]]) * view.exposure;
          if (pane.kind === 2)
            color[c] = Math.abs(color[c] - linear(numberOfHalf[b[3 * i + c]]) * view.exposure);
        }
        if (color.every(Number.isFinite)) displayColor(color, pane.kind === 2 ? 0 : view.tone);
        else color[0] = color[2] = 255, color[1] = 0;
        for (let c = 0; c < 3; ++c) out[4 * i + c] = color[c] + 0.5;
      }
      out[4 * i + 3] = 255;
    }
    const layer = document.createElement("canvas");
    layer.width = width;
    layer.height = height;
    layer.getContext("2d").putImageData(image, 0, 0);
    return layer;
  };
  const layerOf = (pane, view, right) => {
    const shown = right ? pane.b : pane.a;
    const key = [pane.kind === 1 ? 0 : pane.kind, pictures.indexOf(shown), pictures.indexOf(pane.b), view.exposure,
                 view.tone, pane.errorName].join();
    if (cache.size > 12) cache.clear();
    if (!cache.has(key)) cache.set(key, paint(pane, view, right));
    return cache.get(key);
  };
  const place = (layer, pane, view, from, to) => {
    context.save();
    context.beginPath();
    context.rect(pane.x + from, pane.y, to - from, pane.height);
    context.clip();
    context.imageSmoothingEnabled = view.zoom < 1;
    context.imageSmoothingQuality = "high";
    context.drawImage(layer, pane.x + view.x, pane.y + view.y, width * view.zoom, height * view.zoom);
    context.restore();
  };

  return {
    name: "2D canvas",
    draw(panes, view) {
      context.fillStyle = "#1b1b1b";
      context.fillRect(0, 0, canvas.width, canvas.height);
      for (const pane of panes) {
        const split = pane.kind === 1 ? Math.ceil(pane.split - 0.5) : pane.width;
        place(layerOf(pane, view, false), pane, view, 0, split);
        if (pane.kind === 1) place(layerOf(pane, view, true), pane, view, split, pane.width);
      }
    },
    read(x, y) { return Array.from(context.getImageData(x, y, 1, 1).data.subarray(0, 3)); },
  };
}
