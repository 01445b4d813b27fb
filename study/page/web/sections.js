// What results of every kind show, from their tables.

function addSection(main, title, text = null) {
  const section = make("section", {}, make("h2", {}, title), text ? make("p", {}, text) : null);
  main.append(section);
  return section;
}

function addFigures(section, isWide = false) {
  const grid = make("div", {class: isWide ? "figures wide" : "figures"});
  section.append(grid);
  return grid;
}

function valueTexts() {
  const table = findTable("calibration") || findTable("tuning");
  const [names, values] = ["parameter", "value"].map((name) => findColumn(table, name));
  if (!names || !values) return [];
  const units = findColumn(table, "unit");
  const [low, high] = [findColumn(table, "low"), findColumn(table, "high")];
  return names.values.map((name, i) => {
    const unit = units ? units.values[i] : values.unit;
    const between = low && low.values[i] !== null
      ? ` (95 %: ${shown(low.values[i])} to ${shown(high.values[i])})` : "";
    return `${name} = ${shown(values.values[i])}${between} ${unit && unit !== "1" ? unit : ""}`;
  });
}

function runsText() {
  const {counts} = data;
  const failed = Object.values(counts.failed).reduce((sum, count) => sum + count, 0);
  return `${counts.ok} of ${counts.evaluations} evaluations ended well` +
         (failed ? `, ${failed} failed` : "");
}

function addVerdict(main) {
  main.append(make("h1", {}, data.name || "unnamed"),
    make("p", {class: `verdict ${data.tone}`},
      `${data.kind}: ${data.status}${data.reason ? `: ${data.reason}` : ""}`),
    ...valueTexts().map((text) => make("p", {}, text)),
    data.is_in_words ? tableElement(findTable("summary").columns, "findings")
      : make("p", {}, `${runsText()}.`),
    make("p", {class: "faint"}, `linkstudy ${data.program} ${data.revision}; results digest `,
      make("code", {}, data.digest || "none yet")));
  for (const note of [data.dropped, ...data.notes]) {
    if (note) main.append(make("p", {class: "verdict doubt"}, note));
  }
}

function evaluationColumns(role) {
  const table = findTable("evaluations");
  return table ? table.columns.filter((column) => column.role === role && isNumeric(column)) : [];
}

// Parameters with more than one value; of a tune also the step where it was halved.
function variedColumns() {
  return evaluationColumns("parameter").filter((column) =>
    distinct(column.values.filter((value) => value !== null)).length > 1);
}

function isSpread(values) {
  const positive = values.filter((value) => value > 0);
  return positive.length === values.length && positive.length > 0 &&
         Math.max(...positive) / Math.min(...positive) > 20;
}

function along(column, y, rows, extra = {}) {
  const ids = findColumn(findTable("evaluations"), "evaluation");
  return {x: picked(column, rows), y: picked(y, rows), line: true,
          notes: picked(ids, rows).map((id) => `evaluation ${id}`), ...extra};
}

function toleranceMarks() {
  const components = findTable("components");
  const values = components ? distinct(findColumn(components, "tolerance").values) : [];
  return values.map((value) => ({name: `tolerance ${shown(value)}`, y: value}));
}

function windowMarks(column) {
  const answer = data.answer;
  const value = answer?.parameters?.[column.name];
  if (typeof value !== "number") return [];
  const marks = [{name: "answer", x: value}];
  if (answer.window) {
    marks.push({name: `end of the window (${answer.window.high_limited_by})`,
                x: answer.window.high});
  }
  return marks;
}

// 1/c through the answer, or through the middle of the curve.
function slopeGuide(column, series) {
  const at = data.answer?.parameters?.[column.name];
  const ok = series.x.map((x, i) => [x, series.y[i]]).filter(([x, y]) => x > 0 && y > 0);
  if (ok.length < 3 || !column.name.includes("stiffness")) return null;
  const pivot = typeof at === "number"
    ? ok.reduce((a, b) => Math.abs(Math.log(b[0] / at)) < Math.abs(Math.log(a[0] / at)) ? b : a)
    : ok[Math.floor(ok.length / 3)];
  const ends = [ok[0][0], ok.at(-1)[0]].map((x) =>
    Math.min(Math.max(x, pivot[0] / 100), pivot[0] * 100));
  return {name: "error ∝ 1 / stiffness", x: ends, y: ends.map((x) => pivot[1] * pivot[0] / x),
          line: true, plain: true, thin: true, isGuide: true, style: 7, dash: [1, 3]};
}

// Tables that are read as they stand.
function addFound(main) {
  for (const [name, title] of [["equilibrium", "At the equilibrium"],
                               ["singular", "Singular positions"], ["loops", "Closed loops"]]) {
    const table = findTable(name);
    if (table) addSection(main, title).append(tableElement(table.columns, name));
  }
}

function addErrors(main) {
  const table = findTable("evaluations");
  const varied = variedColumns().filter((column) => data.kind !== "tune" ||
    column.name !== "simulation.step");
  if (!table || !data.matches.length || !varied.length) return;
  const section = addSection(main, "Errors against the reference");
  const grid = addFigures(section);
  for (const column of varied.slice(0, 6)) {
    const rows = data.along[column.name];
    if (distinct(rows.map((row) => column.values[row])).length < 2) continue;
    for (const match of data.matches) {
      const series = match.columns.map((name, i) =>
        along(column, findColumn(table, name), rows, {name: match.channels[i]}));
      const guide = slopeGuide(column, series[0]);
      const where = match.load_case ? `, load case ${match.load_case}` : "";
      addFigure(grid, {
        title: `Largest error over ${column.name}${where}`,
        summary: summariseErrors(column, series),
        x: {label: withUnit(column.name, column.unit),
            log: isSpread(picked(column, rows))},
        y: {label: "error, of the reference's largest", log: true},
        series: guide ? [...series, guide] : series,
        marks: [...toleranceMarks(), ...windowMarks(column)]});
    }
  }
}

function summariseErrors(column, series) {
  const parts = series.map((one) => {
    const ok = one.y.map((y, i) => [y, one.x[i]]).filter(([y]) => y !== null);
    if (!ok.length) return `${one.name}: no run ended`;
    const least = ok.reduce((a, b) => (b[0] < a[0] ? b : a));
    return `${one.name} is least, ${shown(least[0])}, at ${shown(least[1])} ${column.unit}`;
  });
  return `${parts.join("; ")}.`;
}

function addTuning(main) {
  const stairs = findTable("staircase");
  // Of two values the map shows it.
  if (rowCount(stairs) > 1 && stairs.columns[2].name !== "objective") {
    const section = addSection(main, "Minimal points that match");
    const [a, b, c] = stairs.columns;
    addFigure(addFigures(section), {
      title: `Staircase: ${a.name} and ${b.name}`,
      summary: `${rowCount(stairs)} points below none of which a match was found; ${c.name} ` +
               "stands in the notes of the points.",
      x: {label: withUnit(a.name, a.unit), log: true},
      y: {label: withUnit(b.name, b.unit), log: true},
      series: [{name: "minimal match", x: a.values, y: b.values,
                notes: c.values.map((v) => `${c.name} ${shown(v)} ${c.unit}`)}]});
  }
  const certificate = findTable("certificate");
  if (rowCount(certificate)) {
    addSection(main, "Certificate").append(tableElement(certificate.columns, "certificate"));
  }
}

function groupRows(column) {
  const groups = new Map();
  column.values.forEach((value, row) => {
    if (!groups.has(value)) groups.set(value, []);
    groups.get(value).push(row);
  });
  return groups;
}

function picked(column, rows) {
  return rows.map((row) => column.values[row]);
}

function addCalibration(main) {
  const residuals = findTable("residuals");
  if (!rowCount(residuals)) return;
  const section = addSection(main, "Fit");
  section.append(tableElement(findTable("calibration").columns, "calibration"));
  const grid = addFigures(section);
  const column = (name) => findColumn(residuals, name);
  const names = {values: column("experiment").values.map((name, i) =>
    `${name}: ${column("channel").values[i]}`)};
  for (const [name, rows] of groupRows(names)) {
    const time = picked(column("time"), rows);
    const unit = column("unit").values[rows[0]];
    addFigure(grid, {title: `${name}, measured and fitted`,
      summary: `${rows.length} samples.`,
      x: {label: "time [s]"}, y: {label: withUnit(name.split(": ").at(-1), unit)},
      series: [{name: "measured", x: time, y: picked(column("measured"), rows)},
               {name: "fitted", x: time, y: picked(column("simulated"), rows), line: true,
                plain: true, dash: []}]});
    const left = picked(column("residual"), rows);
    const beyond = left.filter((value) => Math.abs(value) > 2).length;
    addFigure(grid, {title: `${name}, residuals`,
      summary: `${beyond} of ${rows.length} residuals are beyond two standard deviations; ` +
               `${shown(0.0455 * rows.length)} are expected of a normal distribution.`,
      x: {label: "time [s]"}, y: {label: "residual / standard deviation"},
      series: [{name: "residual", x: time, y: left}],
      marks: [{name: "+2", y: 2}, {name: "-2", y: -2}]});
  }
  addProfiles(grid);
  addStarts(grid);
}

function addProfiles(grid) {
  const profiles = findTable("profiles");
  if (!rowCount(profiles)) return;
  for (const [name, rows] of groupRows(findColumn(profiles, "profile"))) {
    const column = findColumn(profiles, name);
    if (!column) continue;
    const order = [...rows].sort((a, b) => column.values[a] - column.values[b]);
    const best = findTable("calibration");
    const at = findColumn(best, "parameter").values.indexOf(name);
    const x = picked(column, order);
    const y = picked(findColumn(profiles, "rise"), order);
    const value = findColumn(best, "value").values[at];
    const place = x.findIndex((one) => one > value);
    x.splice(place < 0 ? x.length : place, 0, value);
    y.splice(place < 0 ? y.length : place, 0, 0);
    addFigure(grid, {title: `Profile of ${name}`,
      summary: "How the least sum of squares rises with this value held; 1 ends the interval.",
      x: {label: withUnit(name, column.unit)}, y: {label: "rise, of what ends the interval"},
      series: [{name: "least sum with the value held", x, y, line: true}],
      marks: [{name: "ends the 95 % interval", y: 1}]});
  }
}

function addStarts(grid) {
  const starts = findTable("starts");
  if (!rowCount(starts)) return;
  const sums = findColumn(starts, "sum").values;
  addFigure(grid, {title: "Sums of squares where the starts ended, best first",
    summary: `${sums.filter((sum) => sum !== null && sum <= sums[0] * 1.001).length} of ` +
             `${sums.length} starts end at the best sum, ${shown(sums[0])}.`,
    x: {label: "start, by its end"}, y: {label: "sum of squared residuals", log: true},
    series: [{name: "end", x: sums.map((_, i) => i + 1), y: sums},
             {name: "begin", x: sums.map((_, i) => i + 1),
              y: findColumn(starts, "sum_before").values}]});
}

function addConvergence(main) {
  const levels = findTable("convergence");
  if (!rowCount(levels)) return;
  const section = addSection(main, "Convergence");
  const orders = findTable("orders");
  section.append(tableElement(orders.columns, "orders"));
  const grid = addFigures(section);
  const column = (name) => findColumn(levels, name).values;
  const keys = column("quantity").map((name, i) =>
    [name, column("over")[i], column("at")[i]].filter(Boolean).join(" over "));
  for (const [key, rows] of groupRows({values: keys})) {
    const size = rows.map((row) => column("size")[row]);
    const series = [];
    for (const [name, label] of [["difference", "difference from the next"],
                                 ["error", "error against the reference"]]) {
      const y = rows.map((row) => column(name)[row]).map((v) => (v === null ? null : Math.abs(v)));
      if (y.some((value) => value > 0)) series.push({name: label, x: size, y, line: true});
    }
    if (!series.length) continue;
    const at = findColumn(orders, "quantity").values.indexOf(column("quantity")[rows[0]]);
    const order = (name) => shown(findColumn(orders, name)?.values[at]);
    addFigure(grid, {title: key,
      summary: `Class ${column("class")[rows.at(-1)]} at the finest level; fitted order ` +
               `${order("fitted")}, formal ${order("formal")}, noise ${order("noise")}.`,
      x: {label: column("over")[rows[0]], log: true},
      y: {label: withUnit("difference, error", column("unit")[rows[0]]), log: true}, series,
      marks: findColumn(orders, "noise")?.values[at] > 0
        ? [{name: "rounding and noise", y: findColumn(orders, "noise").values[at]}] : []});
  }
}
