// Time histories of runs: any group of channels, over time or over a joint coordinate.

class History {
  constructor(stored) {
    this.name = stored.name;
    this.isAgain = stored.is_again;
    this.time = decode(stored.time, Float32Array);
    this.channels = new Map(stored.channels.map((channel) => [channel.name, channel]));
    this.decoded = new Map();
  }

  // {rows, values}: of which instants, and what.
  samples(name) {
    if (!this.decoded.has(name)) {
      const channel = this.channels.get(name);
      this.decoded.set(name, {
        values: decode(channel.values, Float32Array),
        rows: channel.rows ? decode(channel.rows, Uint32Array) : null});
    }
    return this.decoded.get(name);
  }

  // Of a channel over time or over a coordinate, which has all rows.
  curve(name, over) {
    const {values, rows} = this.samples(name);
    const axis = over === "time" ? this.time : this.samples(over).values;
    const x = rows ? Array.from(rows, (row) => axis[row]) : Array.from(axis);
    return {x, y: Array.from(values)};
  }

  // Value at an instant, by rows.
  at(name, row) {
    const {values, rows} = this.samples(name);
    return rows ? values[nearest(rows, row)] : values[row];
  }
}

const histories = data.histories.map((stored) => new History(stored));

// The run that was made again and its reference, else the first two.
function usualRuns() {
  const again = histories.filter((one) => one.isAgain);
  return (again.length ? again : histories.slice(0, 2)).map((one) => one.name);
}

function historyCurves(group, over, runs) {
  const series = [];
  const members = distinct(histories.flatMap((one) => [...one.channels.values()])
    .filter((channel) => channel.group === group).map((channel) => channel.name));
  runs.forEach((run, r) => {
    const history = histories.find((one) => one.name === run);
    members.forEach((name, i) => {
      const isThere = history.channels.has(name) &&
                      (over === "time" || history.channels.has(over));
      if (!isThere) return;
      series.push({name: `${name}, ${run}`, ...history.curve(name, over), line: true, plain: true,
                   style: i, dash: kDashes[r % kDashes.length], thin: true});
    });
  });
  return series;
}

function unitOf(channel) {
  const history = histories.find((one) => one.channels.has(channel));
  return history ? history.channels.get(channel).unit : "";
}

function extremesOf(series) {
  return series.map((one) => {
    const values = one.y.filter(Number.isFinite);
    const [low, high] = values.reduce(([a, b], v) => [Math.min(a, v), Math.max(b, v)],
                                      [Infinity, -Infinity]);
    return `${one.name}: ${shown(low)} to ${shown(high)}`;
  }).join("; ");
}

function historyFigure(group, over, runs) {
  const series = historyCurves(group, over, runs);
  const first = series.length ? series[0].name.split(", ")[0] : group;
  return {title: `${group} over ${over}`,
          summary: `${extremesOf(series.slice(0, 9))}.`,
          x: {label: withUnit(over, over === "time" ? "s" : unitOf(over))},
          y: {label: withUnit(group, unitOf(first))}, series, marks: marksOver(over)};
}

// Singular positions of a course.
function marksOver(over) {
  return data.marks.filter((mark) => mark.at[over] !== undefined)
    .map((mark) => ({name: `${mark.name} at ${shown(mark.at[over])}`, x: mark.at[over]}));
}

function addHistories(main) {
  if (!data.panels.length) return;
  const again = histories.filter((one) => one.isAgain).map((one) => one.name);
  const isCourse = data.is_in_words;
  const section = addSection(main, isCourse ? "Along the course" : "Time histories", isCourse
    ? "Positions of the course, found again from the stored model." : again.length
    ? `All channels of ${again.join(" and ")} come from the stored input, run again; others are ` +
      "as they were stored."
    : "As they were stored.");
  const grid = addFigures(section, true);
  for (const {group, over} of data.panels) historyPanel(grid, group, over);
}

function historyPanel(grid, group, over) {
  const chosen = new Set(usualRuns());
  const redraw = () => draw(figure, historyFigure(what.list.value, across.list.value,
    histories.map((one) => one.name).filter((name) => chosen.has(name))));
  const what = choice("show", data.groups, group, redraw);
  const across = choice("over", data.overs, over, redraw);
  const boxes = histories.length < 2 ? [] : histories.slice(0, 24).map((one) => make("label", {}, make("input", {
    type: "checkbox", checked: chosen.has(one.name), onchange: (event) => {
      if (event.target.checked) chosen.add(one.name); else chosen.delete(one.name);
      redraw();
    }}), one.isAgain ? `${one.name} (run again)` : one.name));
  const figure = addFigure(grid, historyFigure(group, over, [...chosen]),
    make("div", {class: "controls"}, what.element, across.element, ...boxes));
}

// Where the centre of a journal goes within its clearance; true to scale.
function addJournals(main) {
  const loose = data.mechanisms.flatMap((mechanism) => mechanism.closures
    .filter((closure) => closure.radial !== null).map((closure) => ({mechanism, closure})));
  if (!loose.length) return;
  const section = addSection(main, "Journals in their clearances");
  const grid = addFigures(section);
  for (const {mechanism, closure} of loose) {
    const history = histories.find((one) => one.isAgain && one.name === mechanism.history);
    const [x, y] = ["x", "y"].map((axis) => `closure.${closure.name}.eccentricity.${axis}`);
    if (!history?.channels.has(x) || !history.channels.has(y)) continue;
    const rows = history.samples(x).rows ?? history.time.keys();
    const places = Array.from(rows, (row) => [history.at(x, row), history.at(y, row)]);
    const turn = Array.from({length: 121}, (_, i) => i * Math.PI / 60);
    const far = Math.max(closure.radial, ...places.map(([a, b]) => Math.hypot(a, b)));
    const bounds = {min: -1.1 * far, max: 1.1 * far};
    addFigure(grid, {
      title: `Journal of ${closure.name}, ${mechanism.title}`,
      summary: `Radial clearance ${shown(closure.radial)} m, the circle; the journal goes as far ` +
               `as ${shown(far)} m from the middle, ${shown(Math.max(far - closure.radial, 0))} m ` +
               "into the bearing.",
      x: {label: "eccentricity.x [m]", ...bounds}, y: {label: "eccentricity.y [m]", ...bounds},
      isSquare: true,
      series: [{name: "journal", x: places.map((p) => p[0]), y: places.map((p) => p[1]),
                line: true, plain: true, thin: true},
               {name: "clearance", x: turn.map((a) => closure.radial * Math.cos(a)),
                y: turn.map((a) => closure.radial * Math.sin(a)), line: true, plain: true,
                isGuide: true, dash: [6, 4]}]});
  }
}
