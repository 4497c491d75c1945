/* Draws the interrupts and threads of one control cycle. Each priority has one lane of the drawing. watch.js plays a
   scenario, and passes each control cycle to this script. */
(function (scope) {
  "use strict";
  const FIRST_INTERRUPT = 16; // number of the exception that interrupt line 0 raises
  const WIDTH = 1000; // width of a lane [units of the drawing]
  const LEAST = 1.5; // width of the thinnest bar [units of the drawing]
  const STEPS = 1000; // number of steps of the slider
  const MS = 1e6; // ns
  const WINDOWS = [
    [100, "100 ms"],
    [10, "10 ms"],
    [1, "1 ms"],
  ];
  const SVG = "http://www.w3.org/2000/svg";

  /* Returns the activations of a cycle: exception number, begin and end [ns]. If an activation began before the
     cycle, its begin is 0. If an activation continues after the cycle, its end is the end of the cycle. */
  function activationsOf(switches, lasted) {
    const open = new Map();
    const found = [];
    for (const { exception, entered, at } of switches) {
      if (entered) open.set(exception, at);
      else {
        found.push({ exception, begin: open.has(exception) ? open.get(exception) : 0, end: at });
        open.delete(exception);
      }
    }
    open.forEach((begin, exception) => found.push({ exception, begin, end: lasted }));
    return found.sort((a, b) => a.begin - b.begin);
  }

  /* Returns one lane for each priority, the highest priority first. A lane contains the activations of the contexts
   * (interrupts and threads) that have this priority. */
  function lanesOf(contexts, activations) {
    const priorities = [...new Set(contexts.map((context) => context.priority))].sort((a, b) => a - b);
    return priorities.map((priority) => {
      const own = contexts.filter((context) => context.priority === priority);
      const contextOf = ({ exception }) => own.find((context) => context.lines.includes(exception - FIRST_INTERRUPT));
      const bars = activations.map((each) => ({ ...each, context: contextOf(each) })).filter((each) => each.context);
      const counts = own
        .map((context) => ({ context, count: bars.filter((each) => each.context === context).length }))
        .filter(({ count }) => count);
      return { priority, bars, counts };
    });
  }

  /* Returns the contexts that have begun and not yet ended at a given instant [ns]. The first context is
   * running, and preempts the other contexts. */
  const activeAt = (lanes, at) =>
    lanes.flatMap((lane) => lane.bars.filter(({ begin, end }) => begin <= at && at < end).map((each) => each.context));

  function pathOf(bars, span) {
    return bars
      .filter(({ begin }) => begin < span)
      .map(({ begin, end }) => {
        const left = (begin / span) * WIDTH;
        const right = Math.min(WIDTH, Math.max(left + LEAST, (end / span) * WIDTH));
        return `M${left.toFixed(1)} 2H${right.toFixed(1)}V18H${left.toFixed(1)}Z`;
      })
      .join("");
  }

  scope.LiveLanes = { activationsOf, lanesOf, activeAt, pathOf };
  if (typeof module !== "undefined") module.exports = scope.LiveLanes;
  const place = typeof document === "undefined" ? null : document.querySelector("[data-lanes]");
  if (!place) return;

  const contexts = JSON.parse(place.querySelector("[type='application/json']").textContent);
  const element = (name, attributes, ...parts) => {
    const made = document.createElement(name);
    Object.entries(attributes).forEach(([key, value]) => made.setAttribute(key, value));
    made.append(...parts);
    return made;
  };
  const drawn = (name, attributes) => {
    const made = document.createElementNS(SVG, name);
    Object.entries(attributes).forEach(([key, value]) => made.setAttribute(key, value));
    return made;
  };
  const span = element("select", { class: "lv-pick", id: "lanes-window" });
  WINDOWS.forEach(([value, text]) => span.append(element("option", { value }, text)));
  span.value = "10";
  const instant = element("input", { type: "range", min: 0, max: STEPS, value: 0, id: "lanes-instant" });
  const text = element("output", { for: "lanes-instant", class: "lv-instant" });
  const rows = lanesOf(contexts, []).map(({ priority }, number) => {
    const names = element("span", { class: "lv-names" });
    const svg = drawn("svg", { viewBox: `0 0 ${WIDTH} 20`, preserveAspectRatio: "none", role: "img" });
    const [bars, cursor] = [drawn("path", { class: "tl-bar" }), drawn("path", { class: "lv-cross" })];
    svg.append(drawn("path", { class: "tl-base", d: `M0 19H${WIDTH}` }), bars, cursor);
    const head = element("span", {}, element("b", {}, `priority ${priority}`), " ", names);
    return { row: element("div", { class: `lv-lane lane${number}` }, head, svg), names, svg, bars, cursor };
  });
  place.querySelector("[data-rows]").append(
    ...rows.map(({ row }) => row),
    element(
      "p",
      { class: "lv-row" },
      element("label", { for: "lanes-window" }, "Shown time after the clock pulse: "),
      span,
      element("label", { for: "lanes-instant" }, "Instant: "),
      instant,
      text,
    ),
  );
  let lanes = [];

  function draw() {
    const length = Number(span.value) * MS;
    const at = (length * Number(instant.value)) / STEPS;
    lanes.forEach(({ priority, bars, counts }, i) => {
      const names = counts.map(({ context, count }) => (count > 1 ? `${context.name} ×${count}` : context.name)).join(", ");
      rows[i].names.textContent = names;
      rows[i].svg.setAttribute("aria-label", `priority ${priority}: ${names || "no activation"}`);
      rows[i].bars.setAttribute("d", pathOf(bars, length));
      rows[i].cursor.setAttribute("d", `M${Number(instant.value)} 0V20`);
    });
    const [runs, ...waiting] = activeAt(lanes, at).map((context) => context.name);
    text.textContent =
      `${(at / MS).toFixed(3)} ms: ${runs || "idle program"}` + (waiting.length ? `, preempts ${waiting.join(", ")}` : "");
  }

  scope.LiveLanes.show = ({ switches, lasted }) => {
    place.hidden = false;
    lanes = lanesOf(contexts, activationsOf(switches, lasted));
    const ran = new Set(lanes.flatMap((lane) => lane.counts.map(({ context }) => context.id)));
    contexts.forEach(({ id }) => document.getElementById(id).classList.toggle("lv-active", ran.has(id)));
    draw();
  };
  span.addEventListener("change", draw);
  instant.addEventListener("input", draw);
})(typeof self !== "undefined" ? self : globalThis);
