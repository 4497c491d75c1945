/* The script of the page that runs the robot. It handles the controls and the manual actions of the reader, and shows
 * each snapshot that the worker sends. */
(function () {
  "use strict";
  const live = document.getElementById("live");
  const one = (selector, root) => (root || live).querySelector(selector);
  const all = (selector, root) => [...(root || live).querySelectorAll(selector)];
  const SVG = "http://www.w3.org/2000/svg";
  const still = window.matchMedia("(prefers-reduced-motion: reduce)");
  const root = live.dataset.root;
  const asked = new URLSearchParams(location.search);
  const PERIOD = 100; // ms of a control cycle
  const SPAN = 20000; // ms of robot time that the plots show
  const MOST = 40000; // greatest number of cycles in the history of the page
  const QUANTITY = {
    velocity: { unit: "rpm", full: 300, scale: 10, field: "velocity", truth: "true_velocity", show: 0.1 },
    tension: { unit: "V", full: 24, scale: 1000, field: "tension", truth: null, show: 0.001 },
    current: { unit: "A", full: 10, scale: 1000, field: "current", truth: "true_current", show: 0.001 },
  };
  const FREE = "at 50 connect\nat 86400000 end\n";

  let worker = null,
    facts = null,
    scenario = null,
    running = false,
    latest = null,
    history = [],
    seen = {},
    possible = 0,
    actions = [],
    rowLines = [],
    callAt = -1,
    pose = { x: 0, y: 0, path: [] },
    lastSaid = 0,
    saidState = "";

  const send = (what, more) => worker.postMessage({ do: what, ...more });
  const seconds = (ms) => (ms / 1000).toFixed(3);
  const element = (name, attributes, text) => {
    const made = document.createElement(name);
    Object.entries(attributes || {}).forEach(([key, value]) => made.setAttribute(key, value));
    if (text !== undefined) made.textContent = text;
    return made;
  };
  const drawn = (name, attributes, parent) => {
    const made = document.createElementNS(SVG, name);
    Object.entries(attributes || {}).forEach(([key, value]) => made.setAttribute(key, value));
    if (parent) parent.append(made);
    return made;
  };

  /* ---- start ------------------------------------------------------------------------------------------------ */

  const productField = one("[data-product]"),
    scenarioField = one("[data-scenario]"),
    loadButton = one("[data-load]");

  scenarioField.addEventListener("change", () => {
    const wanted = scenarioField.selectedOptions[0].dataset.product;
    if (wanted) productField.value = imageOf(wanted);
    if (worker) begin(0);
  });
  productField.addEventListener("change", () => worker && begin(0));

  /* Returns the name of the firmware image of a product: the flashed image if a flashed image is chosen now,
     otherwise the image in which each call can be seen. */
  function imageOf(product) {
    return "flashed" in productField.selectedOptions[0].dataset ? product : `${product}_calls`;
  }
  loadButton.addEventListener("click", () => (worker ? begin(0) : load(0)));

  function unavailable(why) {
    one("[data-unavailable]").hidden = false;
    const place = one("[data-why]");
    if (place) place.textContent = why;
    loadButton.disabled = true;
  }

  if (LiveCheck.reason()) unavailable(LiveCheck.reason());

  function load(time) {
    loadButton.disabled = true;
    loadButton.textContent = "Loading";
    const pressed = performance.now();
    worker = new Worker(live.dataset.scripts + "worker.js");
    worker.onmessage = ({ data }) => HEARD[data.kind](data, time, pressed);
    worker.onerror = () => failed("the virtual board could not be loaded");
    send("load", { folder: new URL(live.dataset.folder, location.href).href });
  }

  function failed(text) {
    loadButton.textContent = "Start the robot";
    if (worker) worker.terminate();
    worker = null;
    unavailable(text);
  }

  const HEARD = {
    loaded(data, time) {
      facts = data.facts;
      loadButton.disabled = false;
      loadButton.textContent = "Start again";
      one("[data-loads]").textContent = "";
      prepare();
      begin(time);
    },
    started(data, _time, pressed) {
      possible = data.possible;
      live.dataset.ready = ((performance.now() - pressed) / 1000).toFixed(2);
      const view = one("[data-view]");
      if (view.hidden && matchMedia("(max-width: 820px)").matches)
        setTimeout(() => view.scrollIntoView(), 0);
      view.hidden = false;
      document.getElementById("recorded").hidden = true;
      fillStopAt();
    },
    again: clearRun,
    snapshot: show,
    refused(data) {
      note(`The simulator cannot execute “${data.text}”: ${data.why}`);
    },
    error(data) {
      if (facts) note(`The run stopped because of an error: ${data.text}. Press Again.`);
      else failed(data.text);
    },
  };

  function note(text) {
    const place = one("[data-note]");
    place.textContent = text;
    place.hidden = !text;
  }

  function begin(time) {
    const name = scenarioField.value;
    const found = facts.scenarios.find((each) => each.name === name);
    scenario = found || { name: "", title: "free drive", says: "", text: FREE, product: "" };
    clearRun();
    note(found ? found.says : "Keep the set-point at 0 for 1.5 s after the start: a product with safety functions is then armed. Then move the set-point.");
    const option = productField.selectedOptions[0];
    one("[data-image]").textContent =
      `firmware image ${option.dataset.hash.slice(0, 7)}, ${Number(option.dataset.size).toLocaleString("en")} bytes, ` +
      ("flashed" in option.dataset
        ? "the firmware image that is flashed: this page cannot show calls that the compiler has inlined"
        : "a firmware image of the same sources, built with other compiler options: this page can show each call");
    resetHands();
    send("start", {
      folder: new URL(live.dataset.folder, location.href).href,
      name: productField.value,
      scenario: { text: scenario.text, name: scenario.name },
      time,
    });
    send("watch", { ids: watchedIds() });
    if (!found) {
      hand("pc").checked = true;
      sendOrder();
    }
    if (!time) send("run");
  }

  function clearRun() {
    history = [];
    seen = {};
    actions = [];
    pose = { x: 0, y: 0, path: [] };
    callAt = -1;
    latest = null;
  }

  /* ---- controls --------------------------------------------------------------------------------------------- */

  const DO = {
    toggle: () => send(running ? "pause" : "run"),
    cycle: () => send("cycle"),
    call: stepCall,
    again: () => begin(0),
    link: copyLink,
  };
  all("[data-do]").forEach((button) =>
    button.addEventListener("click", () => worker && DO[button.dataset.do]()),
  );
  all("[name=speed]").forEach((field) =>
    field.addEventListener("change", () =>
      send("speed", { value: field.value === "max" ? Infinity : Number(field.value) }),
    ),
  );
  live.addEventListener("keydown", (event) => {
    if (!worker || event.ctrlKey || event.metaKey || event.altKey) return;
    if (event.target.closest("select, input:not([type=range], [type=checkbox], [type=radio])")) return;
    const own = event.target.closest("button, a, input");
    if (event.key === " " && own) return;
    const acts = { " ": DO.toggle, ".": DO.cycle, ",": DO.call, s: stop }[event.key];
    if (!acts) return;
    acts();
    event.preventDefault();
    event.stopPropagation();
  });
  document.addEventListener("visibilitychange", () => {
    if (document.hidden && running) send("pause");
  });

  function copyLink() {
    const at = new URL(location.href);
    at.search = new URLSearchParams({
      p: productField.value,
      ...(scenario.name ? { s: scenario.name } : {}),
      t: String(Math.round(latest ? latest.numbers.time_ms : 0)),
    }).toString();
    window.history.replaceState(null, "", at);
    if (navigator.clipboard) navigator.clipboard.writeText(at.href).catch(() => {});
    note(
      actions.length
        ? "The address bar now contains the link. The link repeats the scenario up to this time, but without your actions."
        : "The address bar now contains a link to this time of the run.",
    );
  }

  const timeField = one("[data-time]");
  timeField.addEventListener("change", () => send("seek", { time: Number(timeField.value) * 1000 }));

  one("[data-sheet]").addEventListener("click", (event) => {
    const open = live.classList.toggle("lv-open");
    event.currentTarget.setAttribute("aria-expanded", open);
    if (open) one("#lv-hands").focus();
  });
  all("[data-tab]").forEach((tab) =>
    tab.addEventListener("click", () => {
      live.dataset.shown = tab.dataset.tab;
      all("[data-tab]").forEach((each) => each.toggleAttribute("aria-current", each === tab));
      tab.setAttribute("aria-current", "true");
    }),
  );
  live.dataset.shown = "robot";

  /* ---- manual actions --------------------------------------------------------------------------------------- */

  const hand = (name) => one(`[data-hand=${name}]`);
  const shown = (name, text) => {
    one(`[data-shows=${name}]`).textContent = text;
  };
  const act = (text, mark) => {
    send("act", { how: "act", text });
    actions.push({ t: latest ? latest.numbers.time_ms : 0, text: mark || text });
  };

  function orderText() {
    const quantity = QUANTITY[hand("quantity").value];
    const share = Number(hand("set").value) / 100;
    const value = Math.round(share * quantity.full * quantity.scale);
    const steering = Math.round(Number(hand("steering").value) * 100);
    return `order ${hand("quantity").value} ${value} steering ${steering}`;
  }

  function sendOrder() {
    const quantity = QUANTITY[hand("quantity").value];
    const value = (Number(hand("set").value) / 100) * quantity.full;
    shown("set", `${value.toFixed(quantity.full > 100 ? 0 : 1)} ${quantity.unit}`);
    shown("steering", `${hand("steering").value}°`);
    send("act", { how: "order", text: hand("pc").checked ? orderText() : "" });
  }

  function resetHands() {
    ["pc", "rc"].forEach((name) => {
      hand(name).checked = false;
    });
    ["set", "steering", "rcv", "rcs", "slope"].forEach((name) => {
      hand(name).value = 0;
    });
    hand("enable").value = "";
    all("[data-fault]").forEach((button) => button.setAttribute("aria-pressed", "false"));
    shown("set", "0");
    shown("steering", "0°");
    shown("rcv", "0 rpm");
    shown("rcs", "0°");
    shown("slope", "0 %");
  }

  function stop() {
    hand("set").value = 0;
    act("order stop", "STOP");
    if (hand("pc").checked) {
      sendOrder();
      send("act", { how: "order", text: `${orderText()} stop` });
    }
  }

  hand("pc").addEventListener("change", () => {
    if (hand("pc").checked) act("connect", "PC connects");
    else actions.push({ t: latest ? latest.numbers.time_ms : 0, text: "PC silent" });
    sendOrder();
  });
  ["quantity", "set", "steering"].forEach((name) => hand(name).addEventListener("input", sendOrder));
  all("[data-hand=stop]").forEach((button) => button.addEventListener("click", stop));
  hand("acknowledge").addEventListener("click", () => {
    act(`${orderText()} acknowledge`, "acknowledge");
    sendOrder();
  });
  ["rc", "rcv", "rcs"].forEach((name) =>
    hand(name).addEventListener("input", () => {
      shown("rcv", `${hand("rcv").value} rpm`);
      shown("rcs", `${hand("rcs").value}°`);
      if (!hand("rc").checked) {
        if (name === "rc") act("rc off", "RC off");
        return;
      }
      act(`rc velocity ${Number(hand("rcv").value) * 10} steering ${Number(hand("rcs").value) * 100}`, "RC");
    }),
  );
  hand("enable").addEventListener("change", () => {
    if (hand("enable").value) act(`rc enable ${hand("enable").value}`);
  });
  hand("slope").addEventListener("input", () => {
    shown("slope", `${hand("slope").value} %`);
    act(`slope ${hand("slope").value}`);
  });
  const OF_WHEEL = ["block", "hall", "leads", "current"];
  all("[data-fault]").forEach((button) =>
    button.addEventListener("click", () => {
      const fault = button.dataset.fault;
      const on = button.getAttribute("aria-pressed") !== "true";
      button.setAttribute("aria-pressed", on);
      if (fault === "clock") return act(on ? "clock lost" : "clock back");
      if (fault === "estop") return act(on ? "estop press" : "estop release");
      if (on) button.dataset.of = hand("wheel").value;
      const wheel = OF_WHEEL.includes(fault) ? ` ${button.dataset.of}` : "";
      return act(`${on ? "fault" : "repair"} ${fault}${wheel}`);
    }),
  );

  /* ---- drawings that are prepared once ------------------------------------------------------------------------- */

  let ground, trail, body, wheels, slopeMark, cells, charts;

  function prepare() {
    prepareRobot();
    prepareCharts();
    prepareMap();
  }

  function prepareRobot() {
    const svg = one("[data-robot]");
    svg.replaceChildren();
    const defs = drawn("defs", {}, svg);
    const grid = drawn(
      "pattern",
      { id: "lv-grid", width: 60, height: 60, patternUnits: "userSpaceOnUse" },
      defs,
    );
    drawn("path", { d: "M60 0H0V60", class: "lv-grid" }, grid);
    const world = drawn("g", { transform: "translate(210 150)" }, svg);
    ground = drawn("g", {}, world);
    drawn("rect", { x: -6000, y: -6000, width: 12000, height: 12000, fill: "url(#lv-grid)" }, ground);
    trail = drawn("polyline", { class: "lv-trail" }, ground);
    body = drawn("g", {}, world);
    drawn("rect", { x: -34, y: -62, width: 68, height: 124, rx: 6, class: "lv-body" }, body);
    drawn("path", { d: "M-10 -50L0 -64L10 -50", class: "lv-nose" }, body);
    wheels = [
      [-48, -44],
      [48, -44],
      [-48, 44],
      [48, 44],
    ].map(([x, y], number) => {
      const place = drawn("g", { transform: `translate(${x} ${y})` }, body);
      const turned = drawn("g", { class: "lv-wheel" }, place);
      drawn("rect", { x: -9, y: -22, width: 18, height: 44, rx: 3 }, turned);
      const tread = drawn("path", { d: "M0 -21V21", "stroke-dasharray": "3 5", class: "lv-tread" }, turned);
      const text = drawn("text", { x: x < 0 ? -16 : 16, y: 4, "text-anchor": x < 0 ? "end" : "start" }, place);
      return { turned, tread, text, number };
    });
    slopeMark = drawn("text", { x: 12, y: 22, class: "lv-slope" }, svg);
  }

  function prepareCharts() {
    const place = one("[data-charts]");
    place.replaceChildren();
    charts = [
      ["Velocity [rpm]", "velocity"],
      ["Current [A]", "current"],
      ["Steering [degree]", "steering"],
    ].map(([title, kind]) => {
      const figure = element("figure", { class: "lv-chart" });
      figure.append(element("figcaption", {}, title));
      const svg = drawn("svg", {
        viewBox: "0 0 1000 100",
        preserveAspectRatio: "none",
        role: "img",
        "aria-label": `${title}, the last ${SPAN / 1000} s`,
      });
      const marks = drawn("g", { class: "lv-marks" }, svg);
      drawn("path", { d: "M0 50H1000", class: "lv-zero" }, svg);
      const lines = ["set", "measured", "truth"].map((name) => drawn("path", { class: name }, svg));
      const cross = drawn("path", { class: "lv-cross" }, svg);
      const range = element("span", { class: "lv-range", "aria-hidden": "true" });
      figure.append(svg, range);
      place.append(figure);
      svg.addEventListener("pointermove", (event) => {
        const box = svg.getBoundingClientRect();
        crossAt((event.clientX - box.left) / box.width);
      });
      svg.addEventListener("pointerleave", () => crossAt(null));
      return { kind, svg, lines, marks, cross, range };
    });
  }

  function prepareMap() {
    const place = one("[data-map]");
    place.replaceChildren();
    const groups = new Map();
    facts.modules.forEach((module) => {
      const [top] = module.logic.split("/");
      groups.set(top, [...(groups.get(top) || []), module]);
    });
    cells = new Map();
    groups.forEach((modules, name) => {
      const group = element("div", { class: "lv-group" });
      group.append(element("h3", {}, name.replace(/_/g, " ")));
      const list = element("ul", {});
      modules.forEach((module) => {
        const item = element("li", {});
        const cell = element("a", { href: root + module.page, "aria-label": module.name, tabindex: "-1" });
        cells.set(module.name, { cell, total: 0 });
        item.append(cell);
        list.append(item);
      });
      group.append(list);
      place.append(group);
    });
    const links = all("a", place);
    if (links[0]) links[0].tabIndex = 0;
    const says = one("[data-cell]");
    const showCell = (event) => {
      const cell = event.target.closest("a");
      if (!cell) return;
      const found = cells.get(cell.getAttribute("aria-label"));
      says.textContent = `${cell.getAttribute("aria-label")}: ${found.rate || 0} calls in the last second, ${found.total} calls since the start of the run`;
    };
    place.addEventListener("pointerover", showCell);
    place.addEventListener("focusin", showCell);
    place.addEventListener("keydown", (event) => {
      const step = { ArrowRight: 1, ArrowDown: 1, ArrowLeft: -1, ArrowUp: -1 }[event.key];
      const next = step && links[links.indexOf(event.target) + step];
      if (!next) return;
      event.target.tabIndex = -1;
      next.tabIndex = 0;
      next.focus();
      event.preventDefault();
    });
  }

  function fillStopAt() {
    const field = one("[data-stop-at]");
    const wanted = field.value || asked.get("stop") || "";
    const options = facts.trees.map((tree) => element("option", { value: tree.id }, tree.id));
    field.replaceChildren(element("option", { value: "" }, "never"), ...options);
    field.value = wanted;
    send("watch", { ids: watchedIds() });
  }
  const watchedIds = () => [one("[data-stop-at]").value].filter(Boolean);
  one("[data-stop-at]").addEventListener("change", () => send("watch", { ids: watchedIds() }));

  /* ---- a snapshot ------------------------------------------------------------------------------------------- */

  let shownAt = 0;

  function show(data) {
    const stateChanged = data.moves.length > 0;
    running = data.running;
    data.history.forEach(keep);
    Object.assign(seen, data.seen);
    latest = data;
    if (still.matches && running && performance.now() - shownAt < 500 && !stateChanged) return;
    shownAt = performance.now();
    showControls(data);
    showRobot(data);
    showFacts(data);
    showCharts(null);
    showMachines(data);
    showMap(data);
    showTree(data);
    showSeen(data);
    showFrames(data);
    showTimeLine();
    sayState(data);
    if (data.stopsAt) note(`All calls of ${data.stopsAt} were seen at ${seconds(data.numbers.time_ms)} s. The run is paused.`);
    if (data.finding) note(`The virtual board found an error and stopped: ${data.finding}`);
    else if (data.failures) note(data.failures.split("\n")[0]);
    else if (data.state === "ended") note("The scenario has ended. All its expectations are met.");
  }

  function keep(point) {
    const before = history[history.length - 1];
    const way = before ? point.n.distance - before.n.distance : 0;
    const heading = (point.n.heading / 100 / 180) * Math.PI;
    pose.x += (way / 1000) * Math.cos(heading);
    pose.y += (way / 1000) * Math.sin(heading);
    const last = pose.path[pose.path.length - 1];
    if (!last || Math.hypot(last[0] - pose.x, last[1] - pose.y) > 0.05) pose.path.push([pose.x, pose.y]);
    pose.path.splice(0, Math.max(0, pose.path.length - 600));
    history.push(point);
    history.splice(0, Math.max(0, history.length - MOST));
  }

  const nameOf = (field, number) => {
    const found = facts.frames.find((frame) => frame.name === "Report").fields.find((f) => f.n === field);
    return (found && found.v && found.v[number]) || String(number);
  };
  const hasReport = (data) => data.values && data.values.cycle !== undefined && data.numbers.reports > 0;

  function showControls(data) {
    const { numbers } = data;
    all("[data-do=toggle]").forEach((button) => {
      button.textContent = running ? "Pause" : "Run";
      button.disabled = data.state !== "runs";
    });
    one("[data-clock]").textContent = `${seconds(numbers.time_ms)} s, cycle ${numbers.pulses}`;
    one("[data-clock2]").textContent = `${(numbers.time_ms / 1000).toFixed(1)} s`;
    const state = hasReport(data)
      ? `${nameOf("state", data.values.state)} · ${nameOf("mode", data.values.mode)}`
      : "no report yet";
    one("[data-now]").textContent = state;
    one("[data-cost]").textContent =
      `${(numbers.awake_us / 1000).toFixed(2)} ms of ${(numbers.cycle_us / 1000).toFixed(0)} ms: the processor does not sleep`;
  }

  function sayState(data) {
    if (!hasReport(data) || performance.now() - lastSaid < 2000) return;
    const text = one("[data-now]").textContent;
    if (text === saidState) return;
    saidState = text;
    lastSaid = performance.now();
    one("[data-says]").textContent = `${text}, at ${(data.numbers.time_ms / 1000).toFixed(1)} s`;
  }

  function showRobot({ numbers, values }) {
    const scale = 60;
    const heading = numbers.heading / 100;
    ground.setAttribute(
      "transform",
      `rotate(${heading.toFixed(2)}) translate(${(pose.y * scale).toFixed(1)} ${(pose.x * scale).toFixed(1)})`,
    );
    trail.setAttribute(
      "points",
      pose.path.map(([x, y]) => `${(-y * scale).toFixed(1)},${(-x * scale).toFixed(1)}`).join(" "),
    );
    wheels.forEach(({ turned, tread, text, number }) => {
      const front = number < 2;
      const angle = front ? -numbers.true_steering / 100 : 0;
      turned.setAttribute("transform", `rotate(${angle.toFixed(1)})`);
      const rpm = numbers[`true_velocity${number}`] / 10;
      const kinds = [
        values[`cut_off${number}`] && "cut",
        values[`blind${number}`] && "blind",
        Math.abs(values[`tension${number}`] || 0) > 100 && "driven",
      ];
      turned.setAttribute("class", `lv-wheel ${kinds.find(Boolean) || ""}`);
      if (!still.matches) tread.setAttribute("stroke-dashoffset", ((-numbers.distance / 4) % 8).toFixed(1));
      text.textContent = `${rpm.toFixed(0)} rpm`;
    });
    slopeMark.textContent = Math.abs(numbers.slope) > 0.05 ? `slope ${numbers.slope.toFixed(0)} %` : "";
  }

  function showFacts(data) {
    const { numbers, values } = data;
    const reported = hasReport(data);
    const rows = [
      ["state", reported ? nameOf("state", values.state) : "no report"],
      ["mode", reported ? nameOf("mode", values.mode) : "–"],
      ["armed", reported ? (values.armed ? "yes" : "no") : "–"],
      ["inhibited", reported ? nameOf("inhibit", values.inhibit) : "–"],
      ["speed", `${(numbers.ground_speed / 1000).toFixed(2)} m/s`],
      ["distance", `${(numbers.distance / 1000).toFixed(2)} m`],
      ["steering", `${(numbers.true_steering / 100).toFixed(1)}°`],
      ["supply", `${(numbers.supply / 1000).toFixed(1)} V`],
      ["resets", String(numbers.resets)],
      ["reports", String(numbers.reports)],
    ];
    one("[data-facts]").replaceChildren(
      ...rows.map(([name, value]) => {
        const row = element("div", {});
        row.append(element("dt", {}, name), element("dd", {}, value));
        return row;
      }),
    );
  }

  /* ---- plots ------------------------------------------------------------------------------------------------ */

  const wheelField = one("[data-wheel]");
  wheelField.addEventListener("change", () => latest && showCharts(null));

  function seriesOf(kind, point, wheel) {
    const { v, n } = point;
    const reported = n.reports > 0;
    if (kind === "velocity") {
      const ordered = reported && v[`quantity${wheel}`] === 0;
      return [
        ordered ? v[`set_point${wheel}`] / 10 : null,
        reported ? v[`velocity${wheel}`] / 10 : null,
        n[`true_velocity${wheel}`] / 10,
      ];
    }
    if (kind === "current") {
      const ordered = reported && v[`quantity${wheel}`] === 2;
      return [
        ordered ? v[`set_point${wheel}`] / 1000 : null,
        reported ? v[`current${wheel}`] / 1000 : null,
        n[`true_current${wheel}`] / 1000,
      ];
    }
    return [
      reported ? v.steering_set_point / 100 : null,
      reported ? v.steering / 100 : null,
      n.true_steering / 100,
    ];
  }

  let window20 = [];

  function showCharts() {
    if (!history.length) return;
    const end = history[history.length - 1].t;
    const begin = Math.max(0, end - SPAN);
    window20 = history.slice(-Math.ceil(SPAN / PERIOD) - 1).filter((point) => point.t >= begin);
    const wheel = wheelField.value;
    const xOf = (t) => ((t - begin) / SPAN) * 1000;
    charts.forEach(({ kind, lines, marks, range }) => {
      const values = window20.map((point) => seriesOf(kind, point, wheel));
      const most = Math.max(1, ...values.flat().map((value) => Math.abs(value || 0))) * 1.1;
      lines.forEach((line, number) => {
        let pen = "M";
        const steps = window20.flatMap((point, i) => {
          const value = values[i][number];
          if (value === null || value === undefined) {
            pen = "M";
            return [];
          }
          const step = `${pen}${xOf(point.t).toFixed(1)} ${(50 - (value / most) * 50).toFixed(1)}`;
          pen = "L";
          return [step];
        });
        line.setAttribute("d", steps.join(""));
      });
      range.textContent = `±${most >= 10 ? most.toFixed(0) : most.toFixed(1)}`;
      marks.replaceChildren();
      let state = null;
      window20.forEach((point) => {
        if (point.n.reports > 0 && state !== null && state !== point.v.state)
          drawn("path", { d: `M${xOf(point.t)} 0V100`, class: "state" }, marks);
        if (point.n.reports > 0) state = point.v.state;
      });
      actions
        .filter((action) => action.t >= begin)
        .forEach((action) => drawn("path", { d: `M${xOf(action.t)} 0V100`, class: "hand" }, marks));
    });
  }

  function crossAt(share) {
    const end = history.length ? history[history.length - 1].t : 0;
    const begin = Math.max(0, end - SPAN);
    charts.forEach(({ cross }) =>
      cross.setAttribute("d", share === null ? "" : `M${(share * 1000).toFixed(1)} 0V100`),
    );
    const place = one("[data-cross]");
    if (share === null || !window20.length) {
      place.textContent = "";
      return;
    }
    const time = begin + share * SPAN;
    const point = window20.reduce((best, p) => (Math.abs(p.t - time) < Math.abs(best.t - time) ? p : best));
    const text = charts.map(({ kind }) => {
      const values = seriesOf(kind, point, wheelField.value);
      return `${kind} ${values.map((value) => (value === null ? "–" : value.toFixed(1))).join(" / ")}`;
    });
    place.textContent = `${seconds(point.t)} s: ${text.join(", ")}`;
  }

  /* ---- states ----------------------------------------------------------------------------------------------- */

  all("[name=machine]").forEach((field) =>
    field.addEventListener("change", () =>
      all("[data-machine]").forEach((place) => {
        place.hidden = place.dataset.machine !== field.value;
      }),
    ),
  );

  const lastMoves = {};

  function showMachines(data) {
    const reported = hasReport(data)
      ? { "operation-states": nameOf("state", data.values.state), "reading-modes": nameOf("mode", data.values.mode) }
      : {};
    data.moves.forEach((move) => {
      lastMoves[move.machine] = [...(lastMoves[move.machine] || []).slice(-4), move];
    });
    data.machines.forEach((machine) => {
      const place = one(`[data-machine="${machine.id}"]`);
      if (!place) return;
      const declared = facts.machines.find((each) => each.id === machine.id);
      const state = reported[machine.id] || machine.state;
      const module = declared.states[state] || state;
      all("svg.plant a", place).forEach((link) => {
        const own = (link.getAttribute("href") || "").endsWith(`/${module}.html`);
        link.classList.toggle("lv-present", own);
      });
      const moves = lastMoves[machine.id] || [];
      const last = moves[moves.length - 1];
      all("svg.plant g.edge", place).forEach((edge) => {
        const path = one("path[id]", edge);
        const lit =
          last &&
          data.numbers.time_ms - last.at < 1000 &&
          path &&
          path.id === `machine-${machine.id}-${last.from}-_${last.to}`;
        edge.classList.toggle("lv-last", Boolean(lit));
      });
      const counts = Object.entries(machine.counts).map(
        ([edge, count]) => `${edge.replace(" ", " → ")} ×${count}`,
      );
      const text = last ? `Last change: ${last.from} → ${last.to} at ${seconds(last.at)} s. All changes: ${counts.join(", ")}.` : "";
      one("[data-moves]", place).textContent = `Present state: ${state}. ${text}`;
    });
  }

  /* ---- modules ---------------------------------------------------------------------------------------------- */

  function showMap(data) {
    const product = facts.products.find((each) => each.name === productField.value);
    const now = new Map();
    const rates = new Map();
    product.functions.forEach(([, method], i) => {
      const module = facts.methods[method].split("::")[0];
      now.set(module, (now.get(module) || 0) + data.entries[i]);
      rates.set(module, (rates.get(module) || 0) + data.entries[i] - data.before[i]);
    });
    cells.forEach((cell, name) => {
      cell.total = now.get(name) || 0;
      cell.rate = rates.get(name) || 0;
      const fill = Math.min(1, Math.log10(1 + cell.rate) / 3);
      cell.cell.style.setProperty("--fill", `${Math.round(fill * 100)}%`);
      cell.cell.classList.toggle("absent", !now.has(name));
      cell.cell.classList.toggle("never", cell.total === 0);
    });
  }

  /* ---- calls ------------------------------------------------------------------------------------------------ */

  const MOST_LINES = 240;

  /* Returns the text lines of the call tree. If a caller calls the same method several times in succession, these calls
     share one text line. */
  function linesOf(rows) {
    const lines = [];
    const above = [];
    rows.forEach(([method, depth, activation]) => {
      const last = above[depth];
      if (last && last.method === method && last.activation === activation && last.under === above[depth - 1]) {
        last.count += 1;
        last.again = true;
        above.length = depth + 1;
        return;
      }
      if (above.slice(0, depth).some((line) => line && line.again)) return; // inside a repeated call
      const line = { method, depth, activation, count: 1, under: above[depth - 1] };
      above[depth] = line;
      above.length = depth + 1;
      lines.push(line);
    });
    return lines;
  }

  let shownRows = "";

  function showTree(data) {
    const key = data.rows.map((row) => row[0]).join(" ");
    if (key === shownRows && callAt < 0) return;
    shownRows = key;
    callAt = -1;
    rowLines = linesOf(data.rows);
    const nodes = rowLines.slice(0, MOST_LINES).map((line) => {
      const [module, method] = facts.methods[line.method].split("::");
      const row = element("div", { class: "lv-call", style: `--depth: ${line.depth}` });
      row.append(element("b", {}, module), element("span", {}, `::${method}`));
      if (line.count > 1) row.append(element("i", {}, `×${line.count}`));
      return row;
    });
    if (rowLines.length > MOST_LINES)
      nodes.push(element("div", { class: "mut small" }, `${rowLines.length - MOST_LINES} further calls are not shown`));
    one("[data-tree]").replaceChildren(...nodes);
  }

  function stepCall() {
    if (running) {
      send("pause");
      return;
    }
    const tree = one("[data-tree]");
    const rows = all(".lv-call", tree);
    if (callAt + 1 >= rows.length) {
      shownRows = "";
      callAt = -1;
      send("cycle");
      return;
    }
    if (rows[callAt]) rows[callAt].classList.remove("here");
    callAt += 1;
    rows[callAt].classList.add("here");
    tree.scrollTop = rows[callAt].offsetTop - tree.clientHeight / 2;
    one("[data-says]").textContent = rows[callAt].textContent;
  }

  /* ---- requirements and frames ------------------------------------------------------------------------------ */

  function showSeen(data) {
    const ids = Object.keys(seen).sort((a, b) => seen[b].at - seen[a].at || a.localeCompare(b));
    one("[data-seen-count]").textContent = `${ids.length} of ${possible} invocation trees that this firmware image can show`;
    const list = one("[data-seen]");
    const now = new Set(data.found);
    list.replaceChildren(
      ...ids.map((id) => {
        const { count, at } = seen[id];
        const item = element("li", now.has(id) ? { class: "now" } : {});
        const link = element("a", { href: `${root}requirements/${id}.html` }, id);
        const tree = facts.trees.find((each) => each.id === id);
        link.title = tree ? tree.text.replace(/\s+/g, " ") : id;
        item.append(link, element("span", {}, ` ◉×${count}`), element("small", {}, ` ${(at / 1000).toFixed(1)} s`));
        return item;
      }),
    );
  }

  const hex = (bytes) => bytes.map((byte) => byte.toString(16).padStart(2, "0")).join(" ");

  function showFrames(data) {
    const list = one("[data-frames]");
    data.frames.slice(-12).forEach((frame) => {
      const item = element("li", { class: frame.fromPc ? "pc" : "robot" });
      const button = element("button", { type: "button" });
      button.append(
        element("span", { class: "mut" }, seconds(frame.at)),
        element("b", {}, `${frame.fromPc ? "PC → robot" : "robot → PC"} ${frame.name}`),
        element("code", {}, hex(frame.bytes).slice(0, 60)),
      );
      button.addEventListener("click", () => showFrame(frame));
      item.append(button);
      list.prepend(item);
    });
    while (list.children.length > 12) list.lastChild.remove();
  }

  function showFrame(frame) {
    const place = one("[data-frame]");
    const table = element("table", {});
    const fields = (facts.frames.find((each) => each.name === frame.name) || { fields: [] }).fields;
    const rows = fields.map((field) => {
      const row = element("tr", {});
      const raw = frame.values[field.n];
      const value = field.v ? field.v[raw] || raw : field.s ? `${+(raw * field.s).toFixed(3)} ${field.u}` : raw;
      row.append(element("th", { scope: "row" }, field.n), element("td", {}, String(value)));
      return row;
    });
    table.append(...rows);
    place.replaceChildren(
      element("h3", {}, `${frame.name} at ${seconds(frame.at)} s, ${frame.bytes.length} bytes`),
      element("code", {}, hex(frame.bytes)),
      table,
    );
    place.hidden = false;
  }

  /* ---- time line -------------------------------------------------------------------------------------------- */

  function showTimeLine() {
    const end = history.length ? history[history.length - 1].t : 0;
    const full = Math.max(10000, end);
    timeField.max = (full / 1000).toFixed(1);
    if (document.activeElement !== timeField || running) timeField.value = (end / 1000).toFixed(1);
    const bands = one("[data-bands]");
    bands.replaceChildren();
    const x = (t) => ((t / full) * 1000).toFixed(1);
    let since = 0,
      state = null;
    const band = (to) => {
      if (state === null) return;
      const width = Math.max(1, Number(x(to)) - Number(x(since)));
      drawn("rect", { x: x(since), y: 0, width, height: 12, class: `state${state}` }, bands);
    };
    history.forEach((point) => {
      const now = point.n.reports > 0 ? point.v.state : null;
      if (now === state) return;
      band(point.t);
      since = point.t;
      state = now;
    });
    band(end);
    actions.forEach((action) => drawn("path", { d: `M${x(action.t)} 0V12`, class: "hand" }, bands));
  }

  /* ---- a link to an instant --------------------------------------------------------------------------------- */

  if (!loadButton.disabled && (asked.has("s") || asked.has("t"))) {
    scenarioField.value = asked.get("s") || "";
    const wanted = scenarioField.selectedOptions[0];
    if (wanted && wanted.dataset.product) productField.value = imageOf(wanted.dataset.product);
    if (asked.has("p")) productField.value = asked.get("p");
    load(Number(asked.get("t")) || 0);
  }
})();
