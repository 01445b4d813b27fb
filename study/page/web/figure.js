// A chart that is also a text: its summary is its label, arrow keys read its points, its numbers
// stand below it and leave it as a file. Series differ by dashes and markers, not by colour alone.

const kColours = ["#0072b2", "#d55e00", "#009e73", "#cc79a7", "#b8860b", "#56b4e9", "#8c510a",
                  "#7f7f7f"];
const kDashes = [[], [8, 4], [2, 3], [10, 3, 2, 3], [14, 5], [4, 4, 1, 4]];
const kMarkers = ["circle", "triangle", "rect", "rectRot", "cross", "star", "crossRot", "dash"];
const figures = [];

function themeColour(name) {
  return getComputedStyle(document.documentElement).getPropertyValue(name).trim();
}

function axisOf(axis, positions) {
  const usesLog = axis.log && positions.some((value) => value > 0);
  const scale = {
    type: usesLog ? "logarithmic" : "linear",
    title: {display: true, text: axis.label},
    ticks: {callback: (value) => axis.words ? axis.words[value] ?? "" : shown(value),
            maxRotation: 30},
  };
  if (axis.max !== undefined) Object.assign(scale, {min: axis.min, max: axis.max});
  if (axis.words) {
    Object.assign(scale, {min: -0.5, max: axis.words.length - 0.5, afterBuildTicks: (built) => {
      built.ticks = axis.words.map((_, value) => ({value}));
    }});
  }
  if (usesLog) {
    const there = positions.filter((value) => value > 0);
    const isShort = Math.max(...there) < 100 * Math.min(...there);
    const named = isShort ? [1, 2, 5] : [1];
    scale.ticks.callback = (value) => {
      const digits = value / 10 ** Math.floor(Math.log10(value) + 1e-9);
      return named.some((one) => Math.abs(digits - one) < 1e-6) ? value.toExponential(0).replace("e+", "e") : "";
    };
    scale.ticks.autoSkip = false;
  }
  return scale;
}

function pointsOf(series, x, y) {
  const points = [];
  for (let i = 0; i < series.x.length; ++i) {
    const [px, py] = [series.x[i], series.y[i]];
    const isThere = Number.isFinite(px) && Number.isFinite(py);
    if (isThere && !(x.log && px <= 0) && !(y.log && py <= 0)) {
      points.push({x: px, y: py, row: i});
    } else if (series.line && points.length && !Number.isNaN(points.at(-1).y)) {
      points.push({x: px, y: NaN, row: i});
    }
  }
  return points;
}

// One hue by lightness: what is more stands out more from the paper, light or dark. 0 to 1.
function shadeColour(part) {
  const isDark = matchMedia("(prefers-color-scheme: dark)").matches;
  return `hsl(210, 85%, ${isDark ? 25 + 65 * part : 88 - 70 * part}%)`;
}

function datasetOf(series, i, points) {
  const isShaded = series.shade !== undefined;
  const colour = isShaded ? themeColour("--ink") : kColours[(series.style ?? i) % kColours.length];
  const isDense = points.length > 150;
  return {
    label: series.name,
    data: points,
    showLine: Boolean(series.line),
    spanGaps: false,
    borderColor: colour,
    backgroundColor: isShaded ? shadeColour(series.shade)
      : series.isHollow ? "transparent" : colour + "66",
    borderWidth: series.thin || isShaded ? 1 : 2,
    borderDash: series.dash ?? (series.line ? kDashes[i % kDashes.length] : []),
    pointStyle: series.plain ? "line" : series.marker ?? kMarkers[i % kMarkers.length],
    stepped: Boolean(series.isStepped),
    pointRadius: series.radius ?? (series.line && (isDense || series.plain) ? 0 : isDense ? 2.5 : 4),
    pointHoverRadius: (series.radius ?? 4) + 2,
    order: series.isGuide ? 2 : series.line || series.radius > 8 ? 0 : 1,  // over points
  };
}

// Vertical and horizontal guides over the extent of the points.
function guidesOf(marks, all) {
  const span = (key) => {
    const values = all.flatMap((points) => points.map((p) => p[key])).filter(Number.isFinite);
    return [Math.min(...values), Math.max(...values)];
  };
  if (!all.some((points) => points.length)) return [];
  const [xs, ys] = [span("x"), span("y")];
  return marks.filter((mark) => Number.isFinite(mark.x ?? mark.y)).map((mark, i) => ({
    name: mark.name, line: true, plain: true, isGuide: true, dash: [6, 3 + 2 * i], style: 7 - i % 4,
    x: mark.x !== undefined ? [mark.x, mark.x] : xs, y: mark.x !== undefined ? ys : [mark.y, mark.y],
  }));
}

function describePoint(figure, s, p) {
  const dataset = figure.chart.data.datasets[s];
  const point = dataset.data[p];
  const [x, y] = [figure.wanted.x, figure.wanted.y];
  const value = (axis, number) => axis.words ? axis.words[number] : shown(number);
  const note = figure.wanted.series[s]?.notes?.[point.row];
  return `${dataset.label}: ${x.label} ${value(x, point.x)}, ${y.label} ${value(y, point.y)}` +
         (note ? `, ${note}` : "");
}

function moveCursor(figure, event) {
  drawIfWaiting(figure);
  const sets = figure.chart.data.datasets;
  let {s, p} = figure.cursor;
  const step = event.shiftKey ? Math.max(1, Math.floor(sets[s].data.length / 20)) : 1;
  const moves = {ArrowRight: () => { p += step; }, ArrowLeft: () => { p -= step; },
                 Home: () => { p = 0; }, End: () => { p = sets[s].data.length - 1; },
                 ArrowDown: () => { s = (s + 1) % sets.length; },
                 ArrowUp: () => { s = (s + sets.length - 1) % sets.length; }};
  if (!moves[event.key]) return;
  event.preventDefault();
  moves[event.key]();
  p = Math.min(Math.max(p, 0), sets[s].data.length - 1);
  figure.cursor = {s, p};
  if (p < 0) return;
  const element = [{datasetIndex: s, index: p}];
  figure.chart.setActiveElements(element);
  figure.chart.tooltip.setActiveElements(element, {x: 0, y: 0});
  figure.chart.update("none");
  figure.spoken.textContent = describePoint(figure, s, p);
}

function numbersOf(figure) {
  drawIfWaiting(figure);
  if (figure.wanted.numbers) return figure.wanted.numbers;
  return figure.wanted.series.filter((series) => !series.isGuide).flatMap((series) => [
    {name: `${series.name}: ${figure.wanted.x.label}`, unit: "", values: [...series.x]},
    {name: `${series.name}: ${figure.wanted.y.label}`, unit: "", values: [...series.y]}]);
}

function saveNumbers(figure) {
  const text = csvOf(numbersOf(figure));
  download(`${figure.wanted.title}.csv`, text, "text/csv");
}

function saveImage(figure) {
  drawIfWaiting(figure);
  const from = figure.chart.canvas;
  const copy = make("canvas", {width: from.width, height: from.height});
  const context = copy.getContext("2d");
  context.fillStyle = themeColour("--paper");
  context.fillRect(0, 0, copy.width, copy.height);
  context.drawImage(from, 0, 0);
  copy.toBlob((blob) => download(`${figure.wanted.title}.png`, blob), "image/png");
}

function optionsOf(figure) {
  const {wanted} = figure;
  const xs = wanted.series.flatMap((series) => Array.from(series.x.slice(0, 1e4)));
  const ys = wanted.series.flatMap((series) => Array.from(series.y.slice(0, 1e4)));
  const ink = themeColour("--ink");
  const grid = {color: themeColour("--line")};
  const dress = (scale) => {
    Object.assign(scale, {grid});
    scale.ticks.color = scale.title.color = ink;
    return scale;
  };
  return {
    animation: false, responsive: true, maintainAspectRatio: false, parsing: false,
    interaction: {mode: "nearest", intersect: false},
    scales: {x: dress(axisOf(wanted.x, xs)), y: dress(axisOf(wanted.y, ys))},
    plugins: {
      legend: {position: "bottom", display: wanted.series.length <= 16,
               labels: {usePointStyle: true, color: ink, boxWidth: 30}},
      tooltip: {callbacks: {title: () => "", label: (item) =>
        describePoint(figure, item.datasetIndex, item.dataIndex)}},
    },
  };
}

function describe(figure, wanted) {
  figure.canvas.setAttribute("aria-label", `${wanted.title}. ${wanted.summary ?? ""} ` +
    "Arrow keys read the points.");
  figure.heading.textContent = wanted.title;
  figure.caption.textContent = wanted.summary ?? "";
}

// A page opens at once however many charts it has: those behind the first are drawn after the
// first frame, one at a time.
const kDrawnFirst = 1;
const waiting = new Map();  // figure -> what is wanted

function drawIfWaiting(figure) {
  if (waiting.has(figure)) draw(figure, waiting.get(figure));
}

function drawWaiting() {
  for (const figure of waiting.keys()) {
    drawIfWaiting(figure);
    setTimeout(drawWaiting);
    return;
  }
}

// wanted: {title, summary, x: {label, log, words}, y: likewise, marks: [{name, x | y}],
//          series: [{name, x, y, line, marker, dash, notes, shade: 0 to 1 for more}],
//          numbers: columns that stand below, instead of those of the series}
function draw(figure, wanted) {
  waiting.delete(figure);
  const guides = guidesOf(wanted.marks ?? [],
                          wanted.series.map((one) => pointsOf(one, wanted.x, wanted.y)));
  figure.asked = wanted;
  figure.wanted = {...wanted, series: [...wanted.series, ...guides]};
  const sets = figure.wanted.series.map((one, i) =>
    datasetOf(one, i, pointsOf(one, wanted.x, wanted.y)));
  figure.chart?.destroy();
  describe(figure, wanted);
  figure.cursor = {s: 0, p: -1};
  figure.chart = new Chart(figure.canvas, {type: "scatter", data: {datasets: sets},
                                           options: optionsOf(figure)});
}

function addFigure(parent, wanted, controls = null) {
  const figure = {canvas: make("canvas", {role: "img", tabindex: "0"}), heading: make("h3"),
                  caption: make("figcaption"), spoken: make("output", {"aria-live": "polite"})};
  figure.canvas.addEventListener("keydown", (event) => moveCursor(figure, event));
  const buttons = make("div", {class: "controls"},
    make("button", {type: "button", onclick: () => saveImage(figure)}, "PNG"),
    make("button", {type: "button", onclick: () => saveNumbers(figure)}, "CSV"));
  const fold = make("details", {}, make("summary", {}, "Numbers"));
  fold.addEventListener("toggle", () => {
    while (fold.childElementCount > 1) fold.lastChild.remove();
    if (fold.open) fold.append(tableElement(numbersOf(figure), figure.wanted.title));
  });
  const plot = make("div", {class: wanted.isSquare ? "plot square" : "plot"}, figure.canvas);
  parent.append(make("figure", {}, figure.heading, ...(controls ? [controls] : []),
                     plot, figure.spoken, figure.caption, buttons, fold));
  describe(figure, wanted);
  waiting.set(figure, wanted);
  if (figures.length < kDrawnFirst) drawIfWaiting(figure);
  figures.push(figure);
  return figure;
}

matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => {
  for (const figure of figures.filter((one) => one.chart)) {
    draw(figure, figure.asked);
  }
});
