// The panel: numbers under the cursor, metrics, settings. Names come from files, so they are only ever text.

function element(tag, text, attributes = {}) {
  const e = document.createElement(tag);
  if (text !== undefined) e.textContent = text;
  for (const [name, value] of Object.entries(attributes)) e.setAttribute(name, value);
  return e;
}

function row(tag, cells, attributes) {
  const r = element("tr", undefined, attributes);
  cells.forEach((cell, i) => r.append(cell instanceof Node ? cell : element(i === 0 ? "th" : tag, cell)));
  return r;
}

// Four digits, whatever the magnitude.
function digits(value) {
  if (value === null || value === undefined) return "\u2013";
  if (!Number.isFinite(value)) return Number.isNaN(value) ? "NaN" : value > 0 ? "\u221e" : "-\u221e";
  const size = Math.abs(value);
  if (size === 0) return "0";
  if (size < 1e-3 || size >= 1e6) return value.toExponential(2);
  return size >= 1000 ? value.toFixed(0) : value.toPrecision(4);
}

function fillMetrics(report) {
  const unit = report.luminance ? " cd/m\u00b2" : " of 1";
  const lines = [
    ["flip", "FLIP", "Mean LDR-FLIP of the display picture: 0 equal, 1 as different as can be"],
    ["hdr-flip", "HDR-FLIP", "Mean of the largest LDR-FLIP over all useful exposures"],
    ["ssim", "SSIM", "Structural similarity of the display luma; 1 is equal"],
    ["psnr", "PSNR dB", "20 log10(1 / RMSE) of display values"],
    ["relmse", "relMSE", "Mean of (x-r)\u00b2 / (r\u00b2 + 0.01) of exposed values"],
    ["rmse", "RMSE" + unit, "Square root of the mean square difference"],
    ["mae", "MAE" + unit, "Mean absolute difference"],
    ["max", "Largest" + unit, "Largest absolute difference"],
    ["bias", "Bias" + unit, "Largest mean difference of a channel"],
    ["relative-bias", "Bias, relative", "The same over the reference's mean"],
    ["nonfinite", "Pixels left out", "NaN or infinite in either picture"],
  ];
  const tested = report.pictures.filter(p => p.metrics);
  const reference = report.pictures[report.reference].name;
  document.getElementById("against").textContent = "against " + reference;
  const table = document.getElementById("metrics"), head = element("thead"), body = element("tbody");
  // The reference's own noise stands beside the errors, so that it is not read as one.
  const columns = report.noise ? [...tested, {name: reference + "\u2019s own noise", metrics: report.noise}] : tested;
  head.append(row("th", ["", ...columns.map(p => p.name)]));
  for (const [key, label, help] of lines) {
    if (!tested.some(p => key in p.metrics)) continue;
    const text = value => key === "nonfinite" ? String(value) : digits(value);
    const cells = columns.map(p => p.metrics[key] === null && key === "psnr" ? "\u221e" : text(p.metrics[key]));
    body.append(row("td", [label, ...cells], {title: help, "data-metric": key}));
  }
  table.append(head, body);
}

function fillVerdicts(report) {
  const place = document.getElementById("verdicts");
  for (const p of report.pictures) if (p.verdict) place.append(element("p", p.verdict));
  document.getElementById("command").textContent = report.command;
  document.getElementById("command-part").hidden = !report.command;
}

// A block a picture: what its light and the reference's are along each path, and how the difference is shared out.
function fillPaths(report) {
  const tested = report.pictures.filter(p => p.paths && p.paths.length);
  document.getElementById("paths-part").hidden = !tested.length;
  const table = document.getElementById("paths"), reference = report.pictures[report.reference].name;
  for (const p of tested) {
    const head = element("thead"), body = element("tbody");
    head.append(row("th", [p.name, "here", reference, "error", "share"]));
    for (const r of p.paths) {
      const share = r.path.includes(" (in ") ? "" : `${(100 * r.share).toFixed(0)} %`;
      body.append(row("td", [r.path, digits(r.picture), digits(r.reference), digits(r.error), share],
                      {title: "Mean luminance here and in the reference, mean absolute difference, its share", "data-path": r.path}));
    }
    table.append(head, body);
  }
}

function fillSettings(report) {
  const keys = [];
  for (const p of report.pictures)
    for (const [key] of p.settings) if (!keys.includes(key)) keys.push(key);
  const table = document.getElementById("settings"), head = element("thead"), body = element("tbody");
  head.append(row("th", ["", ...report.pictures.map(p => p.name)]));
  for (const key of keys) {
    const values = report.pictures.map(p => (p.settings.find(s => s[0] === key) || [key, "\u2013"])[1]);
    const differs = values.some(v => v !== values[0]);
    const cells = differs ? values : [element("td", values[0], {colspan: values.length})];
    body.append(row("td", [key, ...cells], differs ? {class: "differs"} : {}));
  }
  table.append(head, body);
}

// One line a picture; show(x, y) fills it.
function makeReadout(report, pictures, colorOf) {
  const table = document.getElementById("readout"), position = document.getElementById("position");
  const unit = report.luminance ? "cd/m\u00b2" : "0\u20131";
  const head = element("thead"), body = element("tbody");
  head.append(row("th", [unit, "R", "G", "B", report.luminance ? "luminance" : "luma", "FLIP"]));
  const lines = pictures.map(p => {
    const name = element("th", undefined, {title: p.name}), swatch = element("span", "", {class: "swatch"});
    name.append(swatch, p.name);
    const cells = Array.from({length: 5}, () => element("td", "\u2013"));
    const line = element("tr");
    line.append(name, ...cells);
    body.append(line);
    return {swatch, cells};
  });
  table.append(head, body);
  return (x, y) => {
    position.textContent = `x ${x}, y ${y}`;
    pictures.forEach((p, n) => {
      const i = y * report.width + x;
      const rgb = [0, 1, 2].map(c => numberOfHalf[p.halves[3 * i + c]] / report.scale);
      const luminance = 0.2126 * rgb[0] + 0.7152 * rgb[1] + 0.0722 * rgb[2];
      [...rgb, luminance].forEach((v, c) => { lines[n].cells[c].textContent = digits(v); });
      const error = p.flip ? p.flip[i] : 255;
      lines[n].cells[4].textContent = error === 255 ? "\u2013" : (error / 254).toFixed(3);
      lines[n].swatch.style.background = `rgb(${colorOf(rgb).map(Math.round).join()})`;
    });
  };
}
