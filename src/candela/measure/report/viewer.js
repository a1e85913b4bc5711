// What the person does: which pictures, which view, exposure, zoom and pan. One view for all panes.

async function openReport() {
  const get = id => document.getElementById(id);
  const report = JSON.parse(get("report").textContent);
  const packed = JSON.parse(get("pixels").textContent);
  report.colorMapBytes = bytesFromBase64(report.colorMap);
  if (typeof DecompressionStream === "undefined")
    throw new Error("This browser lacks DecompressionStream: Chromium 86 and Firefox 113 have it.");
  const pictures = await Promise.all(report.pictures.map(async (p, i) => ({
    name: p.name,
    halves: await unpackHalves(packed[i].pixels, report.width, report.height),
    flip: packed[i].flip && await unpack(packed[i].flip, report.width),
    hdrFlip: packed[i].hdrFlip && await unpack(packed[i].hdrFlip, report.width),
  })));
  get("pixels").remove();

  const stage = get("stage"), canvas = get("canvas"), divider = get("divider"), labels = get("labels");
  const useGl = !location.hash.includes("2d");
  const renderer = (useGl && makeGlRenderer(canvas, report, pictures, get("shader").textContent)) ||
                   make2dRenderer(canvas, report, pictures);
  if (renderer.name !== "WebGL2")
    for (const curve of ["1", "2"]) get("tone").querySelector(`[value="${curve}"]`).remove();

  // Real time against the reference, where there is a picture of it.
  const isRealtime = i => report.pictures[i].settings.some(s => s[0] === "mode" && s[1] === "realtime");
  const realtime = pictures.findIndex((p, i) => p.flip && isRealtime(i));
  const tested = realtime >= 0 ? realtime : pictures.findIndex(p => p.flip);
  const state = {left: tested, right: report.reference, view: "swipe", split: 0.5, stops: 0, held: false,
                 tone: report.luminance ? report.toneCurve : 0, zoom: 1, x: 0, y: 0, fitted: true};
  const baseExposure = report.exposure / report.scale;
  const exposure = () => baseExposure * 2 ** state.stops;
  const ratio = () => window.devicePixelRatio || 1;

  const panes = () => {
    const a = pictures[state.held ? state.right : state.left], b = pictures[state.right];
    const whole = {x: 0, y: 0, width: canvas.width, height: canvas.height, a, b};
    const columns = (list, count) => {
      const rows = Math.ceil(list.length / count), gap = 2;
      const width = Math.floor((canvas.width - gap * (count - 1)) / count);
      const height = Math.floor((canvas.height - gap * (rows - 1)) / rows);
      return list.map((p, i) => ({kind: 0, a: p, b: p, width, height, x: (i % count) * (width + gap),
                                  y: Math.floor(i / count) * (height + gap), label: p.name}));
    };
    switch (state.view) {
      case "side": return columns([a, b], 2);
      case "all": return columns(pictures, Math.ceil(Math.sqrt(pictures.length)));
      case "difference": return [{...whole, kind: 2, label: `|${a.name} \u2212 ${b.name}|`}];
      case "flip":
      case "hdrFlip": {
        const shown = a[state.view] ? a : b;
        const name = state.view === "flip" ? "FLIP" : "HDR-FLIP";
        return [{...whole, kind: 3, error: shown[state.view], errorName: state.view + shown.name,
                 label: `${name}: ${shown.name} against ${pictures[report.reference].name}`}];
      }
      default: return [{...whole, kind: 1, split: state.split * canvas.width, label: a.name, rightLabel: b.name}];
    }
  };

  const fit = () => {
    const pane = panes()[0];
    let zoom = Math.min(pane.width / report.width, pane.height / report.height);
    if (zoom > 1) zoom = Math.floor(zoom);
    Object.assign(state, {zoom, fitted: true, x: Math.round((pane.width - report.width * zoom) / 2),
                          y: Math.round((pane.height - report.height * zoom) / 2)});
  };

  const colorOf = rgb => {
    const linear = report.luminance ? rgb : rgb.map(linearFromSrgb);
    const color = linear.map(v => v * exposure() * report.scale);
    if (!color.every(Number.isFinite)) return [255, 0, 255];
    displayColor(color, state.tone);
    return color;
  };
  const showReadout = makeReadout(report, pictures, colorOf);

  let drawn = [];
  const draw = () => {
    canvas.width = Math.max(1, Math.round(stage.clientWidth * ratio()));
    canvas.height = Math.max(1, Math.round(stage.clientHeight * ratio()));
    if (state.fitted) fit();
    drawn = panes();
    renderer.draw(drawn, {x: state.x, y: state.y, zoom: state.zoom, exposure: exposure(), tone: state.tone});
    labels.replaceChildren(...drawn.flatMap(pane => {
      const top = pane.y / ratio() + 10, left = pane.x / ratio() + 10;
      const tag = element("span", pane.label, {style: `left:${left}px;top:${top}px`});
      if (!pane.rightLabel) return [tag];
      return [tag, element("span", pane.rightLabel,
                           {class: "right", style: `left:${stage.clientWidth - 10}px;top:${top}px`})];
    }));
    divider.style.display = state.view === "swipe" ? "block" : "none";
    divider.style.left = `${state.split * 100}%`;
    divider.setAttribute("aria-valuenow", Math.round(state.split * 100));
    get("legend").style.display = drawn[0].kind === 3 ? "flex" : "none";
    get("exposure").value = state.stops;
    get("exposure-text").textContent = `${state.stops > 0 ? "+" : ""}${state.stops.toFixed(1)} EV`;
    get("zoom-text").textContent = `${(100 * state.zoom).toFixed(0)} %`;
    get("tone").value = state.tone;
    get("left").value = state.left;
    get("right").value = state.right;
    for (const button of get("views").children) button.classList.toggle("on", button.dataset.view === state.view);
  };
  let asked = false;
  const change = changes => {
    Object.assign(state, changes);
    if (asked) return;
    asked = true;
    requestAnimationFrame(() => { asked = false; draw(); });
  };

  // Screen pixels of the stage, and the pane under them.
  const pointOf = event => {
    const box = stage.getBoundingClientRect();
    return {x: (event.clientX - box.left) * ratio(), y: (event.clientY - box.top) * ratio()};
  };
  const paneAt = p => drawn.find(pane => p.x >= pane.x && p.x < pane.x + pane.width &&
                                         p.y >= pane.y && p.y < pane.y + pane.height) || drawn[0];
  const zoomAt = (p, zoom) => {
    const pane = paneAt(p), x = p.x - pane.x, y = p.y - pane.y;
    const next = Math.min(Math.max(zoom, 0.02), 128), factor = next / state.zoom;
    change({zoom: next, x: x - (x - state.x) * factor, y: y - (y - state.y) * factor, fitted: false});
  };
  const setStops = stops => change({stops: Math.round(10 * Math.min(Math.max(stops, -10), 10)) / 10});
  const setView = view => {
    const shows = view === "flip" || view === "hdrFlip" ? pictures.some(p => p[view]) : true;
    if (shows) change({view});
  };

  stage.addEventListener("wheel", event => {
    event.preventDefault();
    zoomAt(pointOf(event), state.zoom * 2 ** (-event.deltaY / 240));
  }, {passive: false});
  canvas.addEventListener("pointerdown", event => {
    stage.focus();
    const start = pointOf(event), from = {x: state.x, y: state.y};
    const move = e => {
      const p = pointOf(e);
      change({x: Math.round(from.x + p.x - start.x), y: Math.round(from.y + p.y - start.y), fitted: false});
    };
    const stop = () => {
      stage.classList.remove("panning");
      window.removeEventListener("pointermove", move);
    };
    stage.classList.add("panning");
    window.addEventListener("pointermove", move);
    window.addEventListener("pointerup", stop, {once: true});
  });
  stage.addEventListener("pointermove", event => {
    const p = pointOf(event), pane = paneAt(p);
    const x = Math.floor((p.x - pane.x - state.x) / state.zoom), y = Math.floor((p.y - pane.y - state.y) / state.zoom);
    if (x >= 0 && y >= 0 && x < report.width && y < report.height) showReadout(x, y);
  });
  canvas.addEventListener("dblclick", fitNow);
  function fitNow() { fit(); change({}); }

  divider.addEventListener("pointerdown", event => {
    event.stopPropagation();
    const move = e => change({split: Math.min(Math.max(pointOf(e).x / canvas.width, 0), 1)});
    window.addEventListener("pointermove", move);
    window.addEventListener("pointerup", () => window.removeEventListener("pointermove", move), {once: true});
  });

  for (const id of ["left", "right"]) {
    pictures.forEach((p, i) => get(id).append(
      element("option", p.name + (i === report.reference ? " (reference)" : ""), {value: i})));
    get(id).addEventListener("change", () => change({[id]: Number(get(id).value)}));
  }
  for (const button of get("views").children) {
    const map = button.dataset.view;
    if (map === "flip" || map === "hdrFlip") button.disabled = !pictures.some(p => p[map]);
    button.addEventListener("click", () => setView(map));
  }
  const swap = () => change({left: state.right, right: state.left});
  const one = () => zoomAt({x: canvas.width / 2, y: canvas.height / 2}, 1);
  get("swap").addEventListener("click", swap);
  get("exposure").addEventListener("input", () => setStops(Number(get("exposure").value)));
  get("exposure-reset").addEventListener("click", () => setStops(0));
  get("tone").addEventListener("change", () => change({tone: Number(get("tone").value)}));
  get("fit").addEventListener("click", fitNow);
  get("one").addEventListener("click", one);
  const nextTone = () => {
    const options = Array.from(get("tone").options, o => Number(o.value));
    change({tone: options[(options.indexOf(state.tone) + 1) % options.length]});
  };
  const slide = step => change({split: Math.min(Math.max(state.split + step, 0), 1)});
  const views = Array.from(get("views").children, b => b.dataset.view);
  const keys = {
    s: swap, f: fitNow, z: one, t: nextTone, "0": () => setStops(0), "-": () => setStops(state.stops - 0.5),
    "+": () => setStops(state.stops + 0.5), "=": () => setStops(state.stops + 0.5),
    ArrowLeft: () => slide(-0.01), ArrowRight: () => slide(0.01), " ": () => change({held: true}),
  };
  views.forEach((view, i) => { keys[String(i + 1)] = () => setView(view); });
  window.addEventListener("keydown", event => {
    const typing = ["SELECT", "INPUT"].includes(event.target.tagName);
    const key = event.key.length === 1 ? event.key.toLowerCase() : event.key;
    if (event.ctrlKey || event.metaKey || event.altKey || typing || !keys[key]) return;
    event.preventDefault();
    keys[key]();
  });
  window.addEventListener("keyup", event => { if (event.key === " ") change({held: false}); });
  new ResizeObserver(draw).observe(stage);  // at once, or the old frame is stretched

  get("title").textContent = report.title;
  const exposed = report.luminance ? `, EV100 ${report.ev100.toFixed(2)}` : ", display values";
  get("subtitle").textContent = `${report.width} \u00d7 ${report.height}${exposed}, ` +
    `${report.pixelsPerDegree.toFixed(0)} pixels a degree, candela ${report.version}, ${renderer.name}`;
  const bar = get("legend").querySelector("canvas"), strip = bar.getContext("2d").createImageData(254, 1);
  for (let i = 0; i < 254; ++i) strip.data.set([...report.colorMapBytes.subarray(3 * i, 3 * i + 3), 255], 4 * i);
  bar.getContext("2d").putImageData(strip, 0, 0);
  fillVerdicts(report);
  fillMetrics(report);
  fillPaths(report);
  fillSettings(report);
  if (!report.luminance) {
    get("tone").disabled = true;
    get("exposure").title = "Display pictures: the exposure multiplies linear display light";
  }
  showReadout(Math.floor(report.width / 2), Math.floor(report.height / 2));
  draw();
  get("notice").remove();
  // For scripts that drive the page.
  window.candelaReport = {draw, state, renderer, panes: () => drawn};
  document.documentElement.dataset.ready = renderer.name;
}

openReport().catch(error => {
  const notice = document.getElementById("notice");
  notice.className = "error";
  notice.textContent = `The report cannot be shown: ${error.message}`;
  document.documentElement.dataset.ready = "failed";
});
