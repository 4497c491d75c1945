/* Shows the parts of the frames that a running robot sends and receives. When the reader points at the bytes of a
   field, the page shows the value of this field. */
(function () {
  "use strict";
  const place = document.querySelector("[data-frames-of]");
  if (!place || !LiveCheck.shows(place)) return;
  const one = (selector) => place.querySelector(selector);
  const [button, kinds, parts, detail] = ["go", "kind", "parts", "detail"].map((name) => one(`[data-${name}]`));
  const PERIOD = 250; // ms between two cycles, so that a reader can follow the bytes
  const folder = new URL(place.dataset.framesOf, location.href).href;
  const newest = new Map(); // name -> the newest frame of this kind
  let layouts = null,
    worker = null,
    timer = 0,
    chosen = 0;

  const element = (name, attributes, ...content) => {
    const made = document.createElement(name);
    Object.entries(attributes).forEach(([key, value]) => made.setAttribute(key, value));
    made.append(...content);
    return made;
  };
  const hex = (bytes) => bytes.map((byte) => byte.toString(16).padStart(2, "0")).join(" ");

  button.addEventListener("click", () => {
    if (worker) return timer ? pause() : go();
    button.disabled = true;
    worker = new Worker(place.dataset.scripts + "worker.js");
    worker.onerror = () => failed("the virtual board could not be loaded");
    worker.onmessage = ({ data }) => {
      if (data.kind === "error") failed(data.text);
      else if (data.kind === "loaded") {
        layouts = data.facts.frames;
        worker.postMessage({ do: "play", folder, modules: [] });
      } else if (data.kind === "plays") go();
      else if (data.kind === "playCycle") take(data);
    };
    worker.postMessage({ do: "load", folder });
    return undefined;
  });
  kinds.addEventListener("change", () => {
    chosen = 0;
    show();
  });

  function failed(text) {
    pause();
    detail.textContent = `The robot cannot run here: ${text}.`;
    worker.terminate();
    worker = null;
  }

  function go() {
    button.disabled = false;
    button.textContent = "Pause";
    timer = setInterval(() => worker.postMessage({ do: "playCycle" }), PERIOD);
  }

  function pause() {
    clearInterval(timer);
    timer = 0;
    button.disabled = false;
    button.textContent = "Continue";
  }

  function take({ frames, goesOn }) {
    frames.forEach((frame) => newest.set(frame.name, frame));
    [...newest.keys()]
      .filter((name) => ![...kinds.options].some((option) => option.value === name))
      .forEach((name) => kinds.append(element("option", {}, name)));
    if (newest.has("Report") && !kinds.dataset.set) {
      kinds.dataset.set = "";
      kinds.value = "Report";
    }
    show();
    if (!goesOn) pause();
  }

  function show() {
    const frame = newest.get(kinds.value);
    if (!frame) return;
    const found = LiveFrames.partsOf(frame.bytes, layouts);
    const old = [...parts.children];
    found.forEach((part, number) => {
      const made = old[number] || parts.appendChild(element("button", { type: "button", class: "lv-part" }));
      const same = made.textContent === hex(part.bytes) + part.name;
      if (!same) made.replaceChildren(element("code", {}, hex(part.bytes)), element("span", {}, part.name));
      made.classList.toggle("lv-new", !same && old.length > 0);
      ["pointerenter", "focus", "click"].forEach((event) => {
        made[`on${event}`] = () => explain(number);
      });
      made.setAttribute("aria-pressed", number === chosen);
    });
    old.slice(found.length).forEach((made) => made.remove());
    const said = found[chosen] || found[0];
    detail.replaceChildren(
      element("b", {}, said.name),
      `: ${hex(said.bytes)}${said.value === undefined ? "" : ` = ${said.value}`}. ${said.meaning}.`,
    );
    one("[data-direction]").textContent =
      `${frame.fromPc ? "PC to robot" : "robot to PC"}, ${(frame.at / 1000).toFixed(4)} s, ${frame.bytes.length} bytes on the serial line`;
  }

  function explain(number) {
    chosen = number;
    show();
  }
})();
