/* Plays the same scenario with two products. Then shows the states of both products over time, and the modules that
   run in only one product. */
(function () {
  "use strict";
  const place = document.querySelector("[data-compare]");
  if (!place || !LiveCheck.shows(place)) return;
  const button = place.querySelector("[data-go]");
  const result = place.querySelector("[data-result]");
  const folder = new URL(place.dataset.folder, location.href).href;
  const root = place.dataset.root;
  const products = place.dataset.compare.split(" ");
  const MOST = 24; // greatest number of rows; later changes of a state are not shown

  const element = (name, attributes, ...content) => {
    const made = document.createElement(name);
    Object.entries(attributes).forEach(([key, value]) => made.setAttribute(key, value));
    made.append(...content);
    return made;
  };
  const linked = (name) => {
    const known = window.PORTAL && window.PORTAL.modules[name];
    return known ? element("a", { class: "mod", href: root + known.url }, name) : name;
  };
  const list = (names) => names.flatMap((name, i) => (i ? [", ", linked(name)] : [linked(name)]));
  const say = (text) => result.replaceChildren(element("p", {}, text));

  button.addEventListener("click", () => {
    button.disabled = true;
    say("Loading the virtual board.");
    const worker = new Worker(place.dataset.scripts + "worker.js");
    const end = (text) => {
      worker.terminate();
      button.disabled = false;
      if (text) say(`The robot cannot run here: ${text}.`);
    };
    worker.onerror = () => end("the virtual board could not be loaded");
    worker.onmessage = ({ data }) => {
      if (data.kind === "error") end(data.text);
      else if (data.kind === "loaded")
        worker.postMessage({ do: "compare", folder, products, scenario: place.dataset.scenario });
      else if (data.kind === "plays") say(`Playing the scenario “${data.title}” with ${data.product}.`);
      else if (data.kind === "compared") {
        end("");
        show(data);
      }
    };
    worker.postMessage({ do: "load", folder });
  });

  /* Returns one row for each cycle in which at least one of the two products changes its state. */
  function rowsOf([one, other]) {
    const now = ({ at, states, speed }) => ({ at, text: states.map((each) => each.state).join(", "), speed });
    const size = Math.min(one.cycles.length, other.cycles.length);
    const rows = [];
    let last = "";
    for (let i = 0; i < size; i += 1) {
      const pair = [now(one.cycles[i]), now(other.cycles[i])];
      const both = pair.map((each) => each.text).join("|");
      if (both !== last) rows.push(pair);
      last = both;
    }
    return rows;
  }

  function show({ title, runs }) {
    const rows = rowsOf(runs);
    const cell = ({ text, speed }, differs) => {
      const state = differs ? element("b", {}, text) : text;
      return element("td", {}, state, element("span", { class: "mut2" }, ` ${(speed / 1000).toFixed(2)} m/s`));
    };
    const body = rows.slice(0, MOST).map(([a, b]) => {
      const differs = a.text !== b.text;
      return element(
        "tr",
        {},
        element("td", { class: "num" }, `${(a.at / 1000).toFixed(1)} s`),
        cell(a, false),
        cell(b, differs),
      );
    });
    const heads = ["time", ...products].map((name, i) =>
      element("th", i ? { scope: "col" } : { scope: "col", class: "num" }, name),
    );
    const table = element("table", {}, element("thead", {}, element("tr", {}, ...heads)), element("tbody", {}, ...body));
    const [before, after] = runs.map((run) => new Set(run.modules));
    const added = [...after].filter((name) => !before.has(name));
    const gone = [...before].filter((name) => !after.has(name));
    const common = [...after].filter((name) => before.has(name)).length;
    result.replaceChildren(
      element("p", {}, `Both products played the scenario “${title}”, with the same orders and the same simulated robot.`),
      element("div", { class: "scroll" }, table),
      element("p", {}, `${common} modules run in both products. Modules that run only in ${products[1]}: `, ...(added.length ? list(added) : ["none"]), "."),
      ...(gone.length ? [element("p", {}, `Modules that run only in ${products[0]}: `, ...list(gone), ".")] : []),
      ...(rows.length > MOST ? [element("p", { class: "mut2" }, `${rows.length - MOST} later changes of state are not shown.`)] : []),
    );
  }
})();
