// The page from top to bottom: the verdict, what is to be seen, everything there is.

function startReport() {
  const main = document.getElementById("report");
  main.textContent = "";  // a page that a browser saved holds what was drawn
  const contents = make("nav", {"aria-label": "Contents"});
  addVerdict(main);
  main.append(contents);
  addMechanism(main);
  addHistories(main);
  addFound(main);
  addJournals(main);
  addErrors(main);
  addMap(main);
  addTuning(main);
  addCalibration(main);
  addConvergence(main);
  addSpace(main);
  addFailures(main);
  addTables(main);
  addOrigin(main);
  for (const [i, heading] of [...main.querySelectorAll("h2")].entries()) {
    heading.id = `part-${i}`;
    contents.append(make("a", {href: `#part-${i}`}, heading.textContent));
  }
}

startReport();
requestAnimationFrame(() => requestAnimationFrame(drawWaiting));  // the second follows a frame
