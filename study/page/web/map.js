// Two values at once: every evaluation where it lies, coloured by a number of it. Shapes say what
// colours do not: what keeps every tolerance, what does not, what failed.

const kMapClasses = 8;  // at most, of colours

function columnOfRatios() {
  const isThere = data.ratios.some((ratio) => ratio !== null);
  return isThere ? {name: "largest error / tolerance", unit: "1", values: data.ratios} : null;
}

// Rows at the usual values of all parameters but two, and which of these are spaced by ratios.
function usualOf(x, y) {
  return data.map.pairs.find(({log}) => x.name in log && y.name in log);
}

// Classes (low, high] of even width, in decades where the values spread. 1 parts two of these.
function classesOf(values) {
  const isLog = isSpread(values);
  const f = isLog ? Math.log10 : (value) => value;
  const [low, high] = [f(Math.min(...values)), f(Math.max(...values))];
  const widths = isLog ? [0.5, 1, 2, 5, 10, 20, 50, 100] : [(high - low) / 6 || 1];
  const width = widths.find((one) => (high - low) / one <= kMapClasses - 1) ?? widths.at(-1);
  const from = isLog ? Math.ceil(low / width) - 1 : 0;
  const start = isLog ? 0 : low;
  const of = (value) => Math.max(Math.ceil((f(value) - start) / width - 1e-12) - 1, from);
  const edge = (number) => (isLog ? 10 ** (number * width) : start + number * width);
  return {of, from, count: of(Math.max(...values)) - from + 1,
          name: (number) => `${shown(Number(edge(number).toPrecision(3)))} to ` +
                            shown(Number(edge(number + 1).toPrecision(3)))};
}

const kFeasible = {yes: {marker: "circle", words: ", within tolerance", radius: 8},
                   no: {marker: "triangle", words: ", beyond tolerance", radius: 7},
                   unknown: {marker: "rect", words: "", radius: 7}};

function feasibleOf(row) {
  const ratio = data.ratios[row] ?? null;
  return ratio === null ? "unknown" : ratio <= 1 ? "yes" : "no";
}

function colouredSeries(x, y, value, rows, noteOf) {
  const known = rows.filter((row) => value.values[row] !== null);
  if (!known.length) return [];
  const classes = classesOf(picked(value, known));
  const series = [];
  for (let i = classes.from; i < classes.from + classes.count; ++i) {
    for (const [feasible, {marker, words, radius}] of Object.entries(kFeasible)) {
      const own = known.filter((row) => classes.of(value.values[row]) === i &&
                                        feasibleOf(row) === feasible);
      if (!own.length) continue;
      series.push({name: classes.name(i) + words, x: picked(x, own), y: picked(y, own), marker,
                   radius, shade: classes.count > 1 ? (i - classes.from) / (classes.count - 1) : 0.5,
                   notes: own.map(noteOf)});
    }
  }
  return series;
}

// With some room beside the outermost marks.
function mapAxis(column, rows, log) {
  const values = picked(column, rows);
  const [f, back] = log ? [Math.log10, (value) => 10 ** value] : [(v) => v, (v) => v];
  const [low, high] = [f(Math.min(...values)), f(Math.max(...values))];
  const room = 0.05 * (high - low);
  return {label: withUnit(column.name, column.unit), log,
          ...(room > 0 ? {min: back(low - room), max: back(high + room)} : {})};
}

// What has no colour: failures by cause, and where the number is missing.
function failedSeries(x, y, value, rows, noteOf) {
  const status = findColumn(findTable("evaluations"), "status").values;
  const left = rows.filter((row) => value.values[row] === null);
  const words = {values: left.map((row) => (status[row] === "ok" ? "no such number" : status[row]))};
  return [...groupRows(words)].map(([name, places]) => {
    const own = places.map((place) => left[place]);
    return {name, x: picked(x, own), y: picked(y, own), notes: own.map(noteOf), style: 1, radius: 6,
            marker: name === "no such number" ? "dash" : "crossRot"};
  });
}

// The answers of a tune: values by path, with the step and the tolerance where it has several.
function answersOf() {
  const table = findTable("tuning");
  const [names, values] = ["parameter", "value"].map((name) => findColumn(table, name));
  if (!names || !values) return [];
  const [steps, tolerances] = ["target_step", "target_tolerance"].map(
    (name) => findColumn(table, name));
  const keys = names.values.map((_, row) => `${steps?.values[row]} ${tolerances?.values[row]}`);
  return [...groupRows({values: keys}).values()].map((rows) => ({
    tolerance: tolerances?.values[rows[0]] ?? null,
    at: {...Object.fromEntries(rows.map((row) => [names.values[row], values.values[row]])),
         ...(steps ? {"simulation.step": steps.values[rows[0]]} : {})}}));
}

function answerSeries(x, y) {
  const lies = ({at}) => [x, y].every((axis) => typeof at[axis.name] === "number");
  const notesOf = (all) => all.map(({tolerance}) =>
    (tolerance === null ? "" : `tolerance ${shown(tolerance)}`));
  const of = (all, extra) => ({x: all.map(({at}) => at[x.name]), y: all.map(({at}) => at[y.name]),
                               notes: notesOf(all), ...extra});
  const series = [];
  const answers = answersOf().filter(lies);
  if (answers.length) {
    series.push(of(answers, {name: "answer", marker: "star", radius: 11, style: 1}));
  }
  const cheapest = cheapestPairs(x, y).filter(lies);
  if (cheapest.length) {
    series.push(of(cheapest, {name: "largest step that matches, and its least value",
                              marker: "rectRot", radius: 14, style: 1, isHollow: true}));
  }
  return series;
}

// Of a tune over several steps what it says; else of the evaluations shown.
function cheapestPairs(x, y) {
  if (Array.isArray(data.answer?.cheapest)) {
    return data.answer.cheapest.map(({tolerance, step, parameters}) =>
      ({tolerance, at: {...parameters, "simulation.step": step}}));
  }
  const [step, other] = x.name === "simulation.step" ? [x, y] : [y, x];
  const rows = usualOf(x, y).rows.filter((row) => feasibleOf(row) === "yes");
  if (step.name !== "simulation.step" || data.kind !== "study" || !rows.length) return [];
  const best = rows.reduce((a, b) => {
    const rise = step.values[b] - step.values[a];
    return rise > 0 || (rise === 0 && other.values[b] < other.values[a]) ? b : a;
  });
  return [{tolerance: null, at: {[step.name]: step.values[best], [other.name]: other.values[best]}}];
}

// The border of what matches, of two tuned values.
function stairSeries(x, y) {
  const stairs = findTable("staircase");
  const [a, b] = [x, y].map((axis) => findColumn(stairs, axis.name));
  if (!a || !b || stairs.columns[2].name !== "objective" || !rowCount(stairs)) return [];
  const order = a.values.map((_, row) => row).sort((i, j) => a.values[i] - a.values[j]);
  return [{name: "minimal matches", x: picked(a, order), y: picked(b, order), line: true,
           isStepped: true, isHollow: true, marker: "rect", radius: 5, style: 1, dash: [6, 4]}];
}

function mapNumbers(x, y, value, rows) {
  const table = findTable("evaluations");
  const columns = distinct([findColumn(table, "evaluation"), x, y, value, columnOfRatios(),
                            findColumn(table, "status")]).filter(Boolean);
  return columns.map((column) => ({...column, values: picked(column, rows)}));
}

function mapSummary(value, rows, all) {
  const count = (word) => rows.filter((row) => feasibleOf(row) === word).length;
  const status = findColumn(findTable("evaluations"), "status").values;
  const failed = rows.filter((row) => status[row] !== "ok").length;
  const known = picked(value, rows).filter((number) => number !== null);
  return `${rows.length} of ${all} evaluations` +
    (rows.length < all ? ", all other parameters at their usual values" : "") +
    `: ${columnOfRatios() ? `${count("yes")} within every tolerance (circles), ${count("no")} ` +
                            "beyond (triangles), " : ""}${failed} failed (crosses). ` +
    (known.length ? `${value.name} from ${shown(Math.min(...known))} to ` +
                    `${shown(Math.max(...known))} ${value.unit === "1" ? "" : value.unit}`.trim() +
                    ", stronger colours for more." : "");
}

function mapOf(x, y, value, isWhole) {
  const all = x.values.map((_, row) => row);
  const usual = usualOf(x, y);
  const isLog = (axis) => (isWhole ? data.map.axes.find(({name}) => name === axis.name).log
                                   : usual.log[axis.name]);
  // Of several on one place the least comes last, on top.
  const rows = isWhole
    ? all.sort((a, b) => (value.values[b] ?? Infinity) - (value.values[a] ?? Infinity))
    : usual.rows;
  const ids = findColumn(findTable("evaluations"), "evaluation").values;
  const noteOf = (row) => `${value.name} ${shown(value.values[row])} ${value.unit}`.trim() +
                          `, evaluation ${ids[row]}`;
  return {title: `Map of ${value.name}`,
          summary: mapSummary(value, rows, x.values.length),
          x: mapAxis(x, rows, isLog(x)), y: mapAxis(y, rows, isLog(y)),
          numbers: mapNumbers(x, y, value, rows),
          series: [...colouredSeries(x, y, value, rows, noteOf),
                   ...failedSeries(x, y, value, rows, noteOf), ...answerSeries(x, y),
                   ...stairSeries(x, y)]};
}

function addMap(main) {
  const axes = data.map.axes.map(({name}) => findColumn(findTable("evaluations"), name));
  const errors = data.matches.flatMap((match) => match.columns);
  const numbers = [columnOfRatios(), ...numericColumns().filter((column) =>
    column.role === "response")].filter(Boolean);
  if (axes.length < 2 || !numbers.length) return;
  const isTold = (column) => errors.includes(column.name);
  const chosen = columnOfRatios() ? numbers[0] : numbers.find(isTold) ?? numbers[0];
  const of = (columns, list) => columns.find((column) => column.name === list.value);
  const redraw = () => {
    if (x.list.value === y.list.value) return;
    draw(figure, mapOf(of(axes, x.list), of(axes, y.list), of(numbers, colour.list),
                       which.list.value === "all"));
  };
  const namesOf = (columns) => columns.map((column) => column.name);
  const isWhole = usualOf(axes[0], axes[1]).rows.length < Math.min(9, axes[0].values.length);
  const x = choice("across", namesOf(axes), axes[0].name, redraw);
  const y = choice("up", namesOf(axes), axes[1].name, redraw);
  const colour = choice("colour", namesOf(numbers), chosen.name, redraw);
  const which = choice("evaluations", ["others as usual", "all"],
                       isWhole ? "all" : "others as usual", redraw);
  const section = addSection(main, "Map of two values");
  const figure = addFigure(addFigures(section, true), mapOf(axes[0], axes[1], chosen, isWhole),
    make("div", {class: "controls"}, x.element, y.element, colour.element, which.element));
}
