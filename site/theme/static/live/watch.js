/* Runs the robot on pages other than "Run the robot". On the page of a requirement, the script plays scenarios until
   all calls of the invocation tree of this requirement are recorded. On a page with drawn modules, the script plays
   one scenario and marks the modules that each control cycle calls. */
(function () {
  "use strict";
  const place = document.querySelector("[data-watch], [data-play]");
  if (!place || !LiveCheck.shows(place)) return;
  const id = place.dataset.watch;
  const button = place.querySelector("[data-go]");
  const result = place.querySelector("[data-result]");
  const still = window.matchMedia("(prefers-reduced-motion: reduce)");
  const STEP = 350; // ms between two highlighted calls
  let worker = null;

  const element = (name, attributes, ...parts) => {
    const made = document.createElement(name);
    Object.entries(attributes || {}).forEach(([key, value]) => made.setAttribute(key, value));
    made.append(...parts);
    return made;
  };
  const say = (...parts) => result.replaceChildren(element("p", {}, ...parts));

  button.addEventListener("click", () => {
    if (run && !ended) return timer ? stop() : go();
    button.disabled = true;
    say("Loading the virtual board.");
    if (worker) return look();
    const folder = new URL(place.dataset.folder, location.href).href;
    worker = new Worker(place.dataset.scripts + "worker.js");
    worker.onerror = () => failed("the virtual board could not be loaded");
    worker.onmessage = ({ data }) => {
      if (data.kind === "loaded") look();
      else if (data.kind === "error") failed(data.text);
      else if (data.kind === "plays") (id ? say(`Playing the scenario “${data.title}”.`) : begin(data));
      else if (data.kind === "found") show(data);
      else if (data.kind === "playCycle") showCycle(data);
    };
    worker.postMessage({ do: "load", folder });
    return undefined;
  });

  function look() {
    const folder = new URL(place.dataset.folder, location.href).href;
    if (id) worker.postMessage({ do: "find", folder, id });
    else worker.postMessage({ do: "play", folder, modules, scenario: scenario && scenario.value, image: place.dataset.image });
  }

  function failed(text) {
    stop();
    say(`The robot cannot run here: ${text}.`);
    worker.terminate();
    worker = null;
    button.disabled = false;
  }

  const runLink = (query) =>
    element(
      "a",
      { href: `${place.dataset.root}run.html?${new URLSearchParams(query)}` },
      "Open in “Run the robot”",
    );

  /* ---- a scenario with marked modules -------------------------------------------------------------------------- */

  const modules = (place.dataset.play || "").split(" ");
  const PACES = [
    ["10", "in real time"],
    ["50", "5 times faster"],
    ["2", "5 times slower"],
  ];
  let run = null; // the scenario that is playing
  let timer = 0;
  let ended = false;
  let scenario = null,
    pace = null,
    now = null,
    counts = null;

  const control = (word, act) => {
    const made = element("button", { class: "btn", type: "button" }, word);
    made.addEventListener("click", act);
    return made;
  };
  const choice = (label, options) => {
    const made = element("select", { "aria-label": label, class: "lv-pick" });
    options.forEach(([value, word]) => made.append(element("option", { value }, word)));
    return made;
  };
  const playCycle = () => worker.postMessage({ do: "playCycle" });

  function stop() {
    clearInterval(timer);
    timer = 0;
    button.textContent = "Continue";
  }

  function go() {
    stop();
    timer = setInterval(playCycle, 1000 / (still.matches ? 2 : Number(pace.value)));
    button.textContent = "Pause";
  }

  function begin(data) {
    run = data;
    ended = false;
    button.disabled = false;
    if (!scenario) makeControls(data);
    scenario.value = data.scenario;
    result.replaceChildren(now, ...(place.hasAttribute("data-counts") ? [counts] : []));
    go();
  }

  function makeControls({ scenarios }) {
    scenario = choice("Scenario", scenarios.map(({ name, title }) => [name, title]));
    pace = choice("Playback speed", PACES);
    now = element("p", { class: "lv-at" });
    counts = element("ul", { class: "lv-counts" });
    scenario.addEventListener("change", look);
    pace.addEventListener("change", () => timer && go());
    const step = control("Step", () => {
      stop();
      playCycle();
    });
    button.after(step, pace, scenario);
    place.querySelector("[data-says]").hidden = true;
    result.removeAttribute("role"); // the text changes ten times per second; a screen reader would read each change
    document.addEventListener("visibilitychange", () => document.hidden && timer && stop());
  }

  const drawings = [...document.querySelectorAll(".main svg")].filter((svg) => svg.querySelector("a[data-m]"));
  const inDrawings = (selector) => drawings.flatMap((svg) => [...svg.querySelectorAll(selector)]);

  /* Returns the connecting lines of a call in a class diagram: the line from the caller to the module that declares
     the operation, and the inheritance lines from this module to the module that implements the operation. PlantUML
     gives a line of a call the id "Caller-Declarer", and an inheritance line the id "Base_-Derived". */
  function linesOf(from, to) {
    const line = (name) => inDrawings(`path[id^="pattern-"][id$="-${name}"]`)[0];
    for (const way of waysUp(to, 4)) {
      const first = line(`${from}-${way[way.length - 1]}`);
      if (first) return [first, ...way.slice(1).map((base, i) => line(`${base}_-${way[i]}`))];
    }
    return [];
  }

  /* Returns each chain that begins with a module and continues with its drawn base classes. */
  function waysUp(name, most) {
    const bases = inDrawings(`path[id^="pattern-"][id$="_-${name}"]`)
      .map((path) => path.id.slice(0, -name.length - 2).split("-").pop())
      .filter((base) => base && most > 0);
    return [[name], ...bases.flatMap((base) => waysUp(base, most - 1).map((way) => [name, ...way]))];
  }

  function showCycle(data) {
    const active = new Set(data.active);
    const present = new Set(data.states.map((one) => one.module));
    const own = data.states.filter((one) => modules.includes(one.module)).map((one) => one.state);
    inDrawings("a[data-m]").forEach((link) => {
      link.classList.toggle("lv-active", active.has(link.dataset.m));
      link.classList.toggle("lv-present", present.has(link.dataset.m));
    });
    inDrawings("[data-with]").forEach((line) =>
      line.classList.toggle("lv-call", line.dataset.with.split(" ").some((name) => active.has(name))),
    );
    inDrawings("path.lv-call[id]").forEach((path) => path.classList.remove("lv-call"));
    data.calls.forEach((call) => linesOf(...call).forEach((path) => path.classList.add("lv-call")));
    data.moves.forEach((move) => {
      inDrawings(`g.edge path[id^="machine-${move.machine}-"]`).forEach((path) =>
        path.parentNode.classList.toggle("lv-last", path.id === `machine-${move.machine}-${move.from}-_${move.to}`),
      );
    });
    now.replaceChildren(
      element("b", {}, `${(data.at / 1000).toFixed(1)} s`),
      `, cycle ${data.cycle}, ${(data.speed / 1000).toFixed(2)} m/s`,
      ...(own.length ? [", ", element("b", {}, own.join(", "))] : []),
      ". ",
      runLink({ p: run.product, s: run.scenario, t: String(Math.round(data.at)) }),
    );
    counts.replaceChildren(
      ...Object.entries(data.counts).map(([name, number]) =>
        element("li", active.has(name) ? { class: "lv-active" } : {}, element("b", {}, name), `: ${callsOf(number)}`),
      ),
    );
    if (window.LiveLanes) window.LiveLanes.show(data);
    if (!data.goesOn) {
      stop();
      button.textContent = "Again";
      ended = true;
    }
  }

  const callsOf = (number) =>
    number === 1 ? "1 call" : number ? `${number.toLocaleString("en")} calls` : "no call of a method that this module implements";

  /* Fills the column "live" in each table of the invocation tree. A cell shows the time and the arguments of the last
     call of its node. */
  function showLive(nodes) {
    document.querySelectorAll(".embed").forEach((table) => {
      const cells = [...table.querySelectorAll("td[data-live]")];
      if (!cells.length) return;
      table.querySelectorAll(".live").forEach((cell) => (cell.hidden = false));
      nodes.forEach(({ name, at, values }, i) => {
        if (!cells[i] || cells[i].dataset.live !== name) return;
        const time = at === undefined ? "no call" : `${at.toFixed(3)} ms`;
        cells[i].replaceChildren(element("b", {}, time), ...(values || []).map((value) => element("div", {}, value)));
      });
    });
  }

  function show(data) {
    button.disabled = false;
    button.textContent = "Again";
    if (!data.scenario) {
      say("None of the scenarios makes all these calls. See the tests below.");
      return;
    }
    const time = String(Math.round(data.at));
    const link = runLink({ p: data.product, s: data.scenario, t: time, stop: id });
    const list = element("ol", { class: "lv-happened" });
    say(
      `◉ All calls were seen at ${(data.at / 1000).toFixed(3)} s, in cycle ${data.cycle} of the scenario “${data.title}”, `,
      `with the firmware image of ${data.product}. `,
      link,
    );
    result.append(list);
    data.calls.forEach((call, number) => {
      const item = element("li", { style: `--depth: ${call.depth}` }, call.name);
      if (still.matches) list.append(item);
      else setTimeout(() => list.append(item), number * STEP);
    });
    showLive(data.nodes);
    const edges = data.moves.map((move) => `machine-${move.machine}-${move.from}-_${move.to}`);
    document.querySelectorAll("g.edge path[id]").forEach((path) => {
      path.parentNode.classList.toggle("lv-last", edges.includes(path.id));
    });
  }
})();
