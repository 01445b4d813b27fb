// Many evaluations at once: any number over any other, all parameters side by side, failures.

function numericColumns() {
  const table = findTable("evaluations");
  return table ? table.columns.filter((column) => column.name !== "evaluation" &&
    isNumeric(column) && distinct(column.values.filter((v) => v !== null)).length > 1) : [];
}

function choice(label, names, chosen, onchange) {
  const list = make("select", {onchange},
    ...names.map((name) => make("option", {value: name, selected: name === chosen}, name)));
  return {list, element: make("label", {}, label, list)};
}

// One series for each way in which evaluations ended.
function byStatus(x, y) {
  const table = findTable("evaluations");
  const ids = findColumn(table, "evaluation").values;
  return [...groupRows(findColumn(table, "status"))].map(([status, rows]) => ({
    name: status, x: picked(x, rows), y: picked(y, rows),
    notes: rows.map((row) => `evaluation ${ids[row]}`)}));
}

function scatterOf(x, y) {
  const both = x.values.filter((_, i) => x.values[i] !== null && y.values[i] !== null).length;
  return {title: `${y.name} over ${x.name}`,
          summary: `${both} of ${x.values.length} evaluations have both numbers.`,
          x: {label: withUnit(x.name, x.unit), log: isSpread(x.values.filter((v) => v !== null))},
          y: {label: withUnit(y.name, y.unit), log: isSpread(y.values.filter((v) => v !== null))},
          series: byStatus(x, y)};
}

function addScatter(grid) {
  const columns = numericColumns();
  const names = columns.map((column) => column.name);
  const parameters = columns.filter((column) => column.role === "parameter" &&
    (data.kind !== "tune" || column.name !== "simulation.step"));
  const first = parameters[0] ?? columns[0];
  const others = columns.filter((column) => column !== first);
  const isResult = (column) => column.role === "response" && !column.name.startsWith("error_");
  const second = parameters[1] ?? others.find(isResult) ?? others[0];
  const of = (name) => columns.find((column) => column.name === name);
  const redraw = () => draw(figure, scatterOf(of(x.list.value), of(y.list.value)));
  const x = choice("across", names, first.name, redraw);
  const y = choice("up", names, second.name, redraw);
  const figure = addFigure(grid, scatterOf(first, second),
                           make("div", {class: "controls"}, x.element, y.element));
}

// Every axis from its least (0) to its greatest (1) value, logarithmic where values spread.
function scaled(column) {
  const known = column.values.filter((value) => value !== null);
  const f = isSpread(known) ? Math.log10 : (value) => value;
  const [low, high] = [f(Math.min(...known)), f(Math.max(...known))];
  return column.values.map((value) => (value === null ? null : (f(value) - low) / (high - low)));
}

const kMostLines = 300;

function addParallel(grid) {
  const varied = variedColumns();
  const errors = data.matches.flatMap((match) => match.columns);
  const results = numericColumns().filter((column) => errors.includes(column.name));
  const columns = [...varied, ...results.slice(0, Math.max(0, 8 - varied.length))];
  if (varied.length < 2 || columns.length < 3) return;
  const axes = columns.map(scaled);
  const table = findTable("evaluations");
  const status = findColumn(table, "status").values;
  const ids = findColumn(table, "evaluation").values;
  const rows = status.map((_, row) => row).slice(0, kMostLines);
  const causes = distinct(status);
  addFigure(grid, {title: "Parameters and errors side by side",
    summary: `A line an evaluation, ${rows.length} of ${status.length}; every axis from its least ` +
             "to its greatest value. Dashes and colours tell how they ended: " +
             causes.join(", ") + ".",
    x: {label: "", words: columns.map((column) => withUnit(column.name, column.unit))},
    y: {label: "least to greatest"},
    series: rows.map((row) => ({name: `evaluation ${ids[row]}: ${status[row]}`,
      x: columns.map((_, i) => i), y: axes.map((axis) => axis[row]), line: true, plain: true,
      thin: true, style: causes.indexOf(status[row]),
      dash: kDashes[causes.indexOf(status[row]) % kDashes.length]}))});
}

function addSpace(main) {
  if (data.counts.evaluations < 2 || numericColumns().length < 2) return;
  const section = addSection(main, "Evaluations");
  addScatter(addFigures(section));
  addParallel(addFigures(section, true));
}

function addFailures(main) {
  const failed = Object.entries(data.counts.failed);
  if (!failed.length) return;
  const section = addSection(main, "Failures");
  const table = findTable("evaluations");
  const rows = findColumn(table, "status").values
    .map((status, row) => [status, row]).filter(([status]) => status !== "ok").map((p) => p[1]);
  const columns = table.columns.filter((column) => ["evaluation", "status", "message"].includes(
    column.name) || variedColumns().includes(column));
  section.append(make("p", {}, `${failed.map(([cause, n]) => `${n} ${cause}`).join(", ")}.`));
  for (const column of variedColumns()) section.append(make("p", {}, regionOf(column, rows)));
  section.append(tableElement(columns.map((column) => ({...column, values: picked(column, rows)})),
                              "failures"));
}

function regionOf(column, rows) {
  const values = picked(column, rows).filter((value) => value !== null);
  const isThere = (value) => value >= Math.min(...values) && value <= Math.max(...values);
  const inside = column.values.filter((value) => value !== null && isThere(value)).length;
  return `${column.name}: failures lie between ${shown(Math.min(...values))} and ` +
    `${shown(Math.max(...values))} ${column.unit}, where ${inside} evaluations were tried.`;
}

function addTables(main) {
  const section = addSection(main, "Tables");
  for (const table of data.tables) {
    section.append(foldedTable(`${table.name}: ${table.holds} (${rowCount(table)} rows)`,
                               () => table.columns, table.name));
  }
}

function addOrigin(main) {
  const section = addSection(main, "Where this comes from");
  section.append(make("p", {}, "input ", make("code", {}, data.input),
                      data.is_in_words ? null : `, seed ${data.seed}`));
  for (const text of data.texts) {
    section.append(make("details", {}, make("summary", {}, text.name.replaceAll("_", " ")),
                        make("pre", {tabindex: "0"}, text.text)));
  }
  if (data.answer) {
    section.append(make("details", {}, make("summary", {}, "answer, as --json prints it"),
                        make("pre", {tabindex: "0"}, JSON.stringify(data.answer, null, 2))));
  }
}
