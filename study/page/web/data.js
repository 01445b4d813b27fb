"use strict";
// The object that linkstudy wrote, and how its parts are read and shown.

const data = JSON.parse(document.getElementById("data").textContent);

// 32-bit numbers, little-endian, in base64.
function decode(text, Numbers) {
  const bytes = Uint8Array.from(atob(text), (c) => c.charCodeAt(0));
  return new Numbers(bytes.buffer);
}

function findTable(name) {
  return data.tables.find((table) => table.name === name) || null;
}

function findColumn(table, name) {
  return table ? table.columns.find((column) => column.name === name) || null : null;
}

// Position of the last of ascending numbers that is not beyond x; the first if all are.
function lastUpTo(numbers, x) {
  let [low, high] = [0, numbers.length];
  while (high - low > 1) {
    const middle = (low + high) >> 1;
    if (numbers[middle] <= x) low = middle; else high = middle;
  }
  return low;
}

function nearest(numbers, x) {
  const low = lastUpTo(numbers, x);
  const high = Math.min(low + 1, numbers.length - 1);
  return x - numbers[low] <= numbers[high] - x ? low : high;
}

function rowCount(table) {
  return table && table.columns.length ? table.columns[0].values.length : 0;
}

function isNumeric(column) {
  return column.values.some((value) => typeof value === "number") &&
         column.values.every((value) => value === null || typeof value === "number");
}

function distinct(values) {
  return [...new Set(values)];
}

// Six digits; what is missing is a dash.
function shown(value) {
  if (value === null || value === undefined) return "–";
  if (typeof value !== "number") return String(value);
  if (Number.isInteger(value) && Math.abs(value) < 1e6) return String(value);
  const rounded = Number(value.toPrecision(6));
  const isSmall = rounded !== 0 && Math.abs(rounded) < 1e-3;
  return (isSmall ? rounded.toExponential() : String(rounded)).replace("e+", "e");
}

function withUnit(label, unit) {
  return unit && unit !== "1" ? `${label} [${unit}]` : label;
}

// An element with attributes and children; texts are texts, never markup.
function make(name, attributes = {}, ...children) {
  const element = document.createElement(name);
  for (const [key, value] of Object.entries(attributes)) {
    if (key.startsWith("on")) element.addEventListener(key.slice(2), value);
    else if (value !== false && value !== null) element.setAttribute(key, value);
  }
  element.append(...children.filter((child) => child !== null));
  return element;
}

function download(name, content, type) {
  const blob = content instanceof Blob ? content : new Blob([content], {type});
  const link = make("a", {href: URL.createObjectURL(blob), download: name});
  document.body.append(link);
  link.click();
  link.remove();
  setTimeout(() => URL.revokeObjectURL(link.href), 1000);
}

function csvCell(value) {
  const text = value === null || value === undefined ? "" : String(value);
  return /[",\n\r]/.test(text) ? `"${text.replaceAll('"', '""')}"` : text;
}

function csvOf(columns) {
  const count = Math.max(0, ...columns.map((column) => column.values.length));
  const lines = [columns.map((column) => csvCell(withUnit(column.name, column.unit))).join(",")];
  for (let row = 0; row < count; ++row) {
    lines.push(columns.map((column) => csvCell(column.values[row])).join(","));
  }
  return lines.join("\n") + "\n";
}

const kShownRows = 500;

// A table as people read it; long ones in part, whole as a file.
function tableElement(columns, caption) {
  const count = Math.max(0, ...columns.map((column) => column.values.length));
  const numeric = columns.map(isNumeric);
  const head = make("tr", {}, ...columns.map((column, i) => make("th",
    {scope: "col", class: numeric[i] ? "number" : null, title: column.meaning || null},
    withUnit(column.name, column.unit))));
  const body = make("tbody");
  for (let row = 0; row < Math.min(count, kShownRows); ++row) {
    body.append(make("tr", {}, ...columns.map((column, i) => make("td",
      {class: numeric[i] ? "number" : null}, shown(column.values[row])))));
  }
  const all = make("div", {class: "scroll", tabindex: "0", role: "region", "aria-label": caption},
                   make("table", {}, make("thead", {}, head), body));
  const rest = count > kShownRows
    ? make("p", {class: "faint"}, `${kShownRows} of ${count} rows; the file has all.`) : null;
  const save = make("button", {type: "button",
    onclick: () => download(`${caption}.csv`, csvOf(columns), "text/csv")}, "CSV");
  return make("div", {}, all, make("p", {}, save), ...(rest ? [rest] : []));
}

// Made when it is opened: most tables of a report never are.
function foldedTable(title, makeColumns, caption) {
  const fold = make("details", {}, make("summary", {}, title));
  fold.addEventListener("toggle", () => {
    if (fold.open && fold.childElementCount === 1) fold.append(tableElement(makeColumns(), caption));
  });
  return fold;
}
