// Appended to a report by report_test.cpp: does what a person does and writes what the page then shows.
(async () => {
  while (!document.documentElement.dataset.ready) await new Promise(done => setTimeout(done, 5));
  const result = {ready: document.documentElement.dataset.ready};
  const clipped = () => Array.from(document.querySelectorAll("header *, aside *")).filter(e => {
    const box = e.getBoundingClientRect();
    const cut = getComputedStyle(e).overflowX !== "visible" && e.scrollWidth > e.clientWidth + 1;
    return e.tagName !== "OPTION" && box.width > 0 && (box.right > window.innerWidth + 0.5 || cut);
  }).map(e => `${e.tagName}#${e.id}: ${e.textContent}`);
  result.clipped = clipped();
  result.opened = document.getElementById("left").selectedOptions[0].textContent;
  result.verdicts = document.getElementById("verdicts").textContent;
  result.noise = Array.from(document.querySelectorAll("#metrics [data-metric=flip] td"), e => e.textContent);
  result.paths = Array.from(document.querySelectorAll("#paths tbody tr"), e => e.textContent);
  result.command = document.getElementById("command").textContent;
  const {draw, state, renderer, panes} = window.candelaReport;
  const get = id => document.getElementById(id), stage = get("stage"), canvas = get("canvas");
  const ratio = window.devicePixelRatio || 1;
  const client = (x, y) => {  // of screen pixels of the stage
    const box = stage.getBoundingClientRect();
    return {clientX: box.left + x / ratio, clientY: box.top + y / ratio, bubbles: true, pointerId: 1};
  };
  const pixel = (x, y) => ({x: state.x + (x + 0.5) * state.zoom, y: state.y + (y + 0.5) * state.zoom});
  const color = (x, y) => {
    const p = pixel(x, y);
    return renderer.read(Math.floor(p.x), Math.floor(p.y));
  };
  const key = name => { window.dispatchEvent(new KeyboardEvent("keydown", {key: name})); draw(); };
  draw();
  result.zoom = state.zoom;
  result.fits = canvas.width === Math.round(stage.clientWidth * ratio);

  // The row of pixels that the test chose, at the picture's own exposure: A is left of the slider.
  const row = () => Array.from({length: 16}, (_, i) => color(i, 4));
  const slide = fraction => {
    const from = get("divider").getBoundingClientRect(), y = from.top + 20;
    get("divider").dispatchEvent(new PointerEvent("pointerdown", {clientX: from.left + 8, clientY: y, bubbles: true}));
    window.dispatchEvent(new PointerEvent("pointermove", client(fraction * canvas.width, 20)));
    window.dispatchEvent(new PointerEvent("pointerup", {}));
    draw();
  };
  slide(0.999);
  result.rowOfA = row();
  slide(0.001);
  result.split = state.split;
  result.rowOfB = row();

  const exposure = get("exposure");
  exposure.value = "-2";
  exposure.dispatchEvent(new Event("input"));
  draw();
  result.exposureText = get("exposure-text").textContent;
  result.rowOfBTwoStopsDown = row();
  key("0");
  result.stopsAfterReset = state.stops;

  const at = pixel(3, 4);
  stage.dispatchEvent(new PointerEvent("pointermove", client(at.x, at.y)));
  result.position = get("position").textContent;
  result.readout = Array.from(get("readout").querySelectorAll("tbody tr"),
    line => Array.from(line.children, cell => cell.textContent));

  key("4");
  result.difference = color(3, 4);
  key("5");
  result.flip = color(3, 4);
  result.legend = getComputedStyle(get("legend")).display;
  key("3");
  result.panes = panes().length;
  key("1");
  result.noValue = (slide(0.999), color(0, 0));

  const before = state.zoom;
  stage.dispatchEvent(new WheelEvent("wheel", {...client(at.x, at.y), deltaY: -480, cancelable: true}));
  draw();
  result.zoomed = state.zoom / before;
  result.stays = color(3, 4);
  stage.dispatchEvent(new PointerEvent("pointermove", client(at.x, at.y)));
  result.positionZoomed = get("position").textContent;
  result.metrics = Object.fromEntries(Array.from(get("metrics").querySelectorAll("tbody tr"),
    line => [line.dataset.metric, line.children[1].textContent]));
  const out = document.createElement("pre");
  out.id = "drive";
  out.textContent = "BEGIN" + JSON.stringify(result) + "END";
  document.body.append(out);
})();
