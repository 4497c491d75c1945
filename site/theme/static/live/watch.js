/* The robot on other pages. On that of a requirement it plays scenarios until the calls of its tree are recorded; on
   that of a pattern application it counts the calls of its modules. */
(function () {
  "use strict";
  const place = document.querySelector("[data-watch], [data-count]");
  if (!place || location.protocol === "file:" || typeof Worker === "undefined") return;
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

  place.hidden = false;
  button.addEventListener("click", () => {
    button.disabled = true;
    say("Loading the virtual board.");
    if (worker) return look();
    const folder = new URL(place.dataset.folder, location.href).href;
    worker = new Worker(place.dataset.scripts + "worker.js");
    worker.onerror = () => failed("the module could not be loaded");
    worker.onmessage = ({ data }) => {
      if (data.kind === "loaded") look();
      else if (data.kind === "error") failed(data.text);
      else if (data.kind === "plays") say(`Plays the scenario “${data.title}”.`);
      else if (data.kind === "found") show(data);
      else if (data.kind === "counted") showCounts(data);
    };
    worker.postMessage({ do: "load", folder });
    return undefined;
  });

  function look() {
    const folder = new URL(place.dataset.folder, location.href).href;
    if (id) worker.postMessage({ do: "find", folder, id });
    else worker.postMessage({ do: "count", folder, modules: place.dataset.count.split(" ") });
  }

  function failed(text) {
    say(`The robot cannot run here: ${text}.`);
    worker.terminate();
    worker = null;
    button.disabled = false;
  }

  const runLink = (query) =>
    element(
      "a",
      { href: `${place.dataset.root}run.html?${new URLSearchParams(query)}` },
      "Open in Run the robot",
    );

  function showCounts(data) {
    button.disabled = false;
    button.textContent = "Again";
    say(
      `◉ ${data.seconds.toFixed(1)} s of the scenario “${data.title}” with the image of ${data.product}. `,
      runLink({ p: data.product, s: data.scenario, t: "0" }),
    );
    const list = element("ul", { class: "lv-counts" });
    Object.entries(data.counts).forEach(([name, number]) => {
      const calls = number === 1 ? "1 call" : `${number.toLocaleString("en")} calls`;
      list.append(element("li", {}, element("b", {}, name), `: ${number ? calls : "no call of its own code"}`));
      document.querySelectorAll("svg.plant a").forEach((link) => {
        if ((link.getAttribute("href") || "").endsWith(`/${name}.html`))
          link.classList.toggle("lv-present", number > 0);
      });
    });
    result.append(list);
  }

  function show(data) {
    button.disabled = false;
    button.textContent = "Again";
    if (!data.scenario) {
      say("No scenario of this page makes these calls in an image that keeps their names. See the tests below.");
      return;
    }
    const time = String(Math.round(data.at));
    const link = runLink({ p: data.product, s: data.scenario, t: time, stop: id });
    const list = element("ol", { class: "lv-happened" });
    say(
      `◉ seen at ${(data.at / 1000).toFixed(3)} s, cycle ${data.cycle}, in the scenario “${data.title}” `,
      `with the image of ${data.product}. `,
      link,
    );
    result.append(list);
    data.calls.forEach((call, number) => {
      const item = element("li", { style: `--depth: ${call.depth}` }, call.name);
      if (still.matches) list.append(item);
      else setTimeout(() => list.append(item), number * STEP);
    });
    const edges = data.moves.map((move) => `machine-${move.machine}-${move.from}-_${move.to}`);
    document.querySelectorAll("g.edge path[id]").forEach((path) => {
      path.parentNode.classList.toggle("lv-last", edges.includes(path.id));
    });
  }
})();
